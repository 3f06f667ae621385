//! How the runs were solved.

use std::time::Duration;

use dashpot_analysis::RunReport;
use dashpot_plot::Table;

use super::Answer;
use crate::numbers::{duration, tolerance};

/// What the columns of times mean.
const TIMES: &str = "`time`: integration alone (of `exact`: its set-up); `in all`: everything";

/// Work and time of each run.
pub(super) fn solving_table(answer: &Answer) -> Table {
    let header =
        ["method", "rtol", "steps", "rejected", "Jac.", "LU", "time", "for errors", "in all"];
    let row = |(run, elapsed): (&RunReport, &Duration)| {
        let (solver, work) = (&run.solver, &run.solver.statistics);
        let stepwise = solver.rtol.is_some();
        let count = |count: usize| if stepwise { count.to_string() } else { "–".to_owned() };
        let further = match solver.solves_for_error {
            0 => "–".to_owned(),
            solves => {
                format!("{solves} in {}", duration(solver.wall_for_error))
            }
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
            duration(*elapsed),
        ]
    };
    let rows: Vec<Vec<String>> = answer.runs.iter().zip(&answer.elapsed).map(row).collect();
    let says_something = |column: usize| rows.iter().any(|row| row[column] != "–");
    let shown: Vec<usize> = (0..header.len()).filter(|&column| says_something(column)).collect();
    Table {
        caption: "Solved".to_owned(),
        header: shown.iter().map(|&column| header[column].to_owned()).collect(),
        rows: rows
            .iter()
            .map(|row| shown.iter().map(|&column| row[column].clone()).collect())
            .collect(),
    }
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
        count => format!(", {count} algebraic unknowns"),
    };
    let effects = match system.effects.as_slice() {
        [] => "every effect is off".to_owned(),
        effects => format!("with {}", effects.join(", ")),
    };
    format!("{} states{algebraic}, {effects}", system.states)
}
