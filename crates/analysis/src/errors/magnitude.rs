//! How large the quantities of a run are.

use crate::{Ledger, Reading, Solution, measures::STANDARD_GRAVITY};

/// How many outputs are looked at, of those that were kept; fewer can only make a quantity seem
/// smaller.
const MOST_OUTPUTS: usize = 1000;
/// An error so many times the largest of its kind tells nothing.
const FAR_BEYOND: f64 = 10.0;
/// The exponent of the injury measures.
const INJURY: f64 = 2.5;

/// The largest magnitude of any signal of this unit in the run, or for units that no signal has,
/// what the largest signals would add up to; of impulses the largest momentum. It is 1 for what has no unit.
pub(crate) fn largest(solution: &Solution<'_>, energy: &Ledger, unit: &str) -> f64 {
    match unit {
        "J" => energy.turned_over,
        "N s" => largest_momentum(solution),
        "s" => {
            let highest = largest_signal(solution, "m/s^2") / STANDARD_GRAVITY;
            highest.powf(INJURY) * solution.end()
        }
        "1" => 1.0,
        unit => largest_signal(solution, unit),
    }
}

/// The largest momentum of a mass \[N s\]; 0 where none moves.
fn largest_momentum(solution: &Solution<'_>) -> f64 {
    let nodes = solution.assembly().nodes.iter().filter(|node| node.mass > 0.0);
    let speeds = nodes.filter_map(|node| Some((node.mass, node.velocity?)));
    let kept = speeds.filter(|(_, speed)| solution.keeps(*speed)).take(MOST_OUTPUTS);
    kept.map(|(mass, speed)| mass * solution.glance(speed).bound()).fold(0.0, f64::max)
}

/// Whether a value is not known at all: its error exceeds it, and what is wanted, and is far beyond the
/// largest of its kind.
pub(crate) fn is_open(
    reading: &Reading,
    error: Option<f64>,
    wish: f64,
    largest: impl FnOnce() -> f64,
) -> bool {
    let Some((value, error)) = reading.value.zip(error.filter(|error| error.is_finite())) else {
        return false;
    };
    error > value.abs() && error > wish * reading.size && error > FAR_BEYOND * largest()
}

fn largest_signal(solution: &Solution<'_>, unit: &str) -> f64 {
    let outputs = solution.assembly().system.outputs.iter().enumerate();
    let kept = outputs.filter(|(at, _)| solution.keeps(*at)).take(MOST_OUTPUTS);
    let alike = kept.filter(|(_, output)| output.unit == unit);
    alike.map(|(at, _)| solution.glance(at).bound()).fold(0.0, f64::max)
}
