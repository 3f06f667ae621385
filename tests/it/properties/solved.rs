//! A scene solved by a method, and how the answers of two methods compare.

use std::ops::ControlFlow;

use dashpot::{
    analysis::{MeasureReport, RunError, RunReport, Solve, SolveSettings},
    dae::{Observer, Progress},
    scene::{ReadOptions, Scene, read},
};

/// The scene in a text, or nothing if it is refused.
pub(crate) fn scene(text: &str) -> Option<Scene> {
    read(text, &ReadOptions::default()).ok().map(|checked| checked.value)
}

/// Ends what takes too many steps: explicit methods where the scene is stiff.
struct Patience(usize);

impl Observer for Patience {
    fn progress(&mut self, _: Progress) -> ControlFlow<()> {
        self.0 = self.0.saturating_sub(1);
        if self.0 == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The report on a scene by what is chosen for it.
pub(crate) fn by_auto(scene: &Scene) -> Result<RunReport, RunError> {
    scene.network.solve_watched(&scene.settings("auto").unwrap(), &mut Patience(5_000))
}

/// The report on a scene by a method, at tolerances from 1e-4 to 1e-6.
pub(super) fn by(scene: &Scene, method: &str) -> Result<RunReport, RunError> {
    let settings = SolveSettings { rtol: Some(1e-6), ..scene.settings(method).unwrap() };
    scene.network.solve_watched(&settings, &mut Patience(1_500))
}

/// Part of the size of a measure that rounding makes where two networks are written down
/// differently: their coefficients differ by a few roundings, which stiff scenes magnify.
const ROUNDING: f64 = 1e-9;

/// Measures that are not compared: where a force dies out without passing zero, their end depends on
/// the tolerance, and severities count in parts of the acceleration of gravity, whatever the units.
const OPEN: &[&str] = &["contact-time", "coefficient-of-restitution", "severity-index", "hic"];

/// What is said where two reports tell different things, although neither says that it might.
/// `bars` is how many times their errors they may differ by.
pub(super) fn disagreement(one: &RunReport, other: &RunReport, bars: f64) -> Option<String> {
    one.measures.iter().filter(|measure| !OPEN.contains(&measure.kind)).find_map(|first| {
        let second = other.measure(&first.key)?;
        (sums_apart(first, second, 1.0) > bars).then(|| {
            format!(
                "{}: {:?} ± {:?} by {}, {:?} ± {:?} by {} ({:?}, {:?})",
                first.key,
                first.value,
                first.error,
                one.solver.method,
                second.value,
                second.error,
                other.solver.method,
                first.notes,
                second.notes,
            )
        })
    })
}

/// How far apart the measures of two reports are that can be compared, in sums of their errors.
pub(crate) fn apart(
    one: &RunReport,
    other: &RunReport,
    factor: impl Fn(&str) -> f64,
) -> Vec<(String, f64)> {
    let own = one.measures.iter().filter(|measure| !OPEN.contains(&measure.kind));
    let pairs = own.filter_map(|first| Some((first, other.measure(&first.key)?)));
    let apart = |(first, second): (&MeasureReport, &MeasureReport)| {
        let factor = factor(first.unit);
        // What is nothing beside others of its unit is made of their rounding.
        let values = one.measures.iter().filter(|measure| measure.unit == first.unit);
        let largest =
            values.filter_map(|value| value.value).fold(0.0, |most: f64, own| most.max(own.abs()));
        let is_nothing = |own: Option<f64>, factor: f64| {
            own.is_none_or(|own| factor * own.abs() <= ROUNDING * ROUNDING * largest)
        };
        let none = is_nothing(first.value, 1.0) && is_nothing(second.value, factor.recip());
        let sums = if none { 0.0 } else { sums_apart(first, second, factor) };
        (first.key.clone(), sums)
    };
    pairs.map(apart).collect()
}

/// The distance of two values in sums of their errors, less what rounding makes; infinite where only one
/// of them has a value, and nothing where one says that it is not known.
fn sums_apart(one: &MeasureReport, other: &MeasureReport, factor: f64) -> f64 {
    let is_open = |measure_report: &MeasureReport| {
        // Of work that is left out within a jump no error is known.
        let is_left_out = measure_report.unit == "J" && measure_report.error.is_none();
        measure_report.is_undetermined
            || is_left_out
            || measure_report.error.is_some_and(f64::is_infinite)
    };
    if is_open(one) || is_open(other) {
        return 0.0;
    }
    match (one.value, other.value) {
        (None, None) => 0.0,
        (Some(first), Some(second)) => {
            let sum = factor * one.error.unwrap_or(0.0) + other.error.unwrap_or(0.0);
            let size = (factor * one.size).max(other.size);
            // Where a mirror exchanges the ways, magnitudes are what stays.
            let off = (factor * first.abs() - second.abs()).abs() - ROUNDING * size;
            if off > 0.0 { off / sum } else { 0.0 }
        }
        _ => f64::INFINITY,
    }
}
