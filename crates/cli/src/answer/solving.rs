//! How the runs were solved.

use dashpot_analysis::RunReport;
use dashpot_plot::Table;

use super::Answer;
use crate::numbers::quantity;

/// Work and time of each run.
pub(crate) fn solving_table(answer: &Answer) -> Table {
    let header = [
        "method", "rtol", "steps", "rejected", "Jacobians", "factorised", "time", "for the errors",
    ];
    let row = |run: &RunReport| {
        let (solver, work) = (&run.solver, &run.solver.statistics);
        let stepwise = solver.rtol.is_some();
        let count = |count: usize| if stepwise { count.to_string() } else { "–".to_owned() };
        let further = match solver.solves_for_error {
            0 => "–".to_owned(),
            solves => {
                let time = quantity(solver.wall_for_error.as_secs_f64(), "s", 2);
                format!("{solves} solves, {time}")
            }
        };
        vec![
            solver.method.to_owned(),
            solver.rtol.map_or("–".to_owned(), |rtol| format!("{rtol:e}")),
            count(work.accepted),
            count(work.rejected),
            count(work.jacobian_calls),
            count(work.factorizations),
            quantity(work.wall.as_secs_f64(), "s", 2),
            further,
        ]
    };
    Table {
        caption: "Solved".to_owned(),
        header: header.map(str::to_owned).to_vec(),
        rows: answer.runs.iter().map(row).collect(),
    }
}

/// Why each method was used, and what it solved.
pub(crate) fn reasons(answer: &Answer) -> Vec<(String, String)> {
    let reason = |run: &RunReport| {
        let system = &run.system;
        let algebraic = match system.algebraic {
            0 => String::new(),
            count => format!(" and {count} algebraic unknowns"),
        };
        let effects = match system.effects.as_slice() {
            [] => "no effects".to_owned(),
            effects => format!("with {}", effects.join(", ")),
        };
        let size = format!("{} states{algebraic}, {effects}", system.states);
        (run.solver.method.to_owned(), format!("{} ({size})", run.solver.why))
    };
    answer.runs.iter().map(reason).collect()
}
