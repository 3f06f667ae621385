//! How large the quantities of a run are.

use crate::{Ledger, Solution, measures::STANDARD_GRAVITY};

/// How many outputs are looked at, of those that were kept; fewer can only make a quantity seem
/// smaller.
const MOST_OUTPUTS: usize = 1000;
/// The exponent of the injury measures.
const INJURY: f64 = 2.5;

/// The largest magnitude of any signal of this unit in the run, or for units that no signal has,
/// what the largest signals would add up to. It is 0 for what has no unit.
pub(crate) fn largest(solution: &Solution<'_>, energy: &Ledger, unit: &str) -> f64 {
    match unit {
        "J" => energy.turned_over,
        "N s" => largest_signal(solution, "N") * solution.end(),
        "s" => {
            let highest = largest_signal(solution, "m/s^2") / STANDARD_GRAVITY;
            highest.powf(INJURY) * solution.end()
        }
        unit => largest_signal(solution, unit),
    }
}

fn largest_signal(solution: &Solution<'_>, unit: &str) -> f64 {
    let outputs = solution.assembly().system.outputs.iter().enumerate();
    let kept = outputs.filter(|(at, _)| solution.keeps(*at)).take(MOST_OUTPUTS);
    let alike = kept.filter(|(_, output)| output.unit == unit);
    alike.map(|(at, _)| solution.signal(at).bound()).fold(0.0, f64::max)
}
