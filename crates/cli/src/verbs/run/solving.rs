//! How the runs were solved, and with which settings.

use dashpot_analysis::{RunReport, Stop};
use dashpot_dae::Direction;
use dashpot_report::Table;
use dashpot_scene::{
    NamedValue,
    units::{parse_quantity, si_unit},
};

use super::Answer;
use dashpot_report::numbers::{constant, counted, duration, share, tolerance};
use dashpot_studies::origin;

/// What the columns of times mean.
const TIMES: &str = "`time`: integration alone (of `exact`: its set-up); `in all`: everything";

/// Work and time of each run.
pub(super) fn solving_table(answer: &Answer) -> Table {
    let header =
        ["method", "rtol", "steps", "rejected", "Jac.", "LU", "time", "for errors", "in all"];
    let row = |run: &RunReport| {
        let (solver, work) = (&run.solver, &run.solver.statistics);
        let stepwise = solver.rtol.is_some();
        let count = |count: usize| if stepwise { count.to_string() } else { "–".to_owned() };
        let further = match solver.solves_for_error {
            0 => "–".to_owned(),
            solves => format!("{solves} in {}", duration(solver.wall_for_error)),
        };
        vec![
            solver.method.to_owned(),
            solver.rtol.map_or("–".to_owned(), tolerance),
            count(work.accepted),
            count(work.rejected),
            count(work.jacobian_calls),
            count(work.factorizations),
            duration(work.wall),
            further,
            duration(solver.wall_in_all),
        ]
    };
    let rows: Vec<Vec<String>> = answer.runs.iter().map(row).collect();
    let says_something = |column: usize| rows.iter().any(|row| row[column] != "–");
    let shown: Vec<usize> = (0..header.len()).filter(|&column| says_something(column)).collect();
    let pick = |row: &Vec<String>| shown.iter().map(|&column| row[column].clone()).collect();
    Table::new("Solved", shown.iter().map(|&column| header[column]), rows.iter().map(pick))
}

/// What was solved, and why each method was used.
pub(super) fn reasons(answer: &Answer) -> Vec<(String, String)> {
    let system = answer.runs.first().map(|run| ("system".to_owned(), size(run)));
    let why = answer.runs.iter().map(|run| (run.solver.method.to_owned(), run.solver.why.clone()));
    let times = ("times".to_owned(), TIMES.to_owned());
    system.into_iter().chain(why).chain([times]).collect()
}

fn size(run: &RunReport) -> String {
    let system = &run.system;
    let algebraic = match system.algebraic {
        0 => String::new(),
        count => format!(", {}", counted(count, "algebraic unknown")),
    };
    let effects = match system.effects.as_slice() {
        [] => "every effect is off".to_owned(),
        effects => format!("with {}", effects.join(", ")),
    };
    format!("{} states{algebraic}, {effects}", system.states)
}

/// The settings, one a row.
pub(super) fn settings_table(answer: &Answer) -> Table {
    let Some(asked) = answer.asked.first() else { return Table::default() };
    let run = &answer.scene.run;
    let methods: Vec<&str> = answer.asked.iter().map(|own| own.method.name()).collect();
    let rtol = asked.rtol.map(|rtol| format!("{rtol:e}"));
    let errors = if asked.estimate { "estimated" } else { "not estimated" };
    let mut rows = vec![
        ("duration".to_owned(), constant(asked.duration, "s")),
        ("samples".to_owned(), run.samples.to_string()),
        ("methods".to_owned(), methods.join(", ")),
        ("rtol".to_owned(), rtol.unwrap_or_else(|| "found by accuracy".to_owned())),
        ("errors".to_owned(), errors.to_owned()),
        ("accuracy".to_owned(), share(asked.accuracy.default)),
    ];
    let by_measure = asked.accuracy.by_measure.iter();
    rows.extend(by_measure.map(|(key, own)| (format!("accuracy of {key}"), share(*own))));
    rows.extend(asked.accuracy.neglect_below.map(|own| ("neglect below".to_owned(), share(own))));
    rows.extend(asked.stops.iter().map(|own| (format!("stop at {}", own.output), stop_text(own))));
    let values = answer.scene.values.iter();
    rows.extend(values.map(|own| (format!("value {}", own.name), value_text(own))));
    let rows = rows.into_iter().map(|(name, value)| vec![name, value]);
    Table::plain("Settings", rows.chain(origin::rows(&answer.scene, &crate::input::load)))
}

/// A named value as it is written; of what is computed its value besides.
fn value_text(own: &NamedValue) -> String {
    if parse_quantity(&own.text).is_ok() {
        return own.text.clone();
    }
    let unit = own.dimension.map_or_else(|| "1".to_owned(), si_unit);
    format!("{} = {}", own.text, constant(own.value, &unit))
}

fn stop_text(stop: &Stop) -> String {
    format!("{} {}", direction(stop), stop.level)
}

/// Which crossings of its level a condition counts.
pub(super) fn direction(stop: &Stop) -> &'static str {
    match stop.direction {
        Direction::Rising => "rises above",
        Direction::Falling => "falls below",
        Direction::Either => "crosses",
    }
}
