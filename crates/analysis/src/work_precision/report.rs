//! What is known in the end.

use dashpot_dae::Statistics;
use serde::Serialize;

use crate::RunError;

/// What accuracy costs in one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct CostReport {
    /// What errors are taken from.
    pub reference: ReferenceSolution,
    /// The method that `auto` chooses.
    pub auto: &'static str,
    /// The measures and their true values.
    pub measures: Vec<TrueMeasure>,
    /// Places in [`measures`](Self::measures) of those that were asked for.
    pub asked: Vec<usize>,
    /// The solutions, by method in the order asked, then by tolerance, the coarsest first.
    pub points: Vec<CostPoint>,
    /// Methods that decline, and solutions that failed.
    pub failures: Vec<CostFailure>,
    /// Errors that a run does not tell of, and contradictions between the solutions that errors are taken from.
    pub underestimates: Vec<Underestimate>,
}

/// What errors are taken from, and how well it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceSolution {
    /// The method whose solution counts as true.
    pub method: &'static str,
    /// Its relative tolerance; `None` for `exact`.
    pub rtol: Option<f64>,
    /// Why `exact` does not apply, where it does not.
    pub why_not_exact: Option<RunError>,
    /// The second solution, by a method of another family, and its tolerance; `None` if no other
    /// method solves what `exact` does.
    pub witness: Option<(&'static str, f64)>,
    /// How far the two differ in the state, relative as [`CostPoint::state`].
    pub state_agreement: Option<f64>,
    /// How far they differ in the times of events, relative as [`CostPoint::events`]; `None` where there are none.
    pub event_agreement: Option<f64>,
    /// The largest relative difference of any measure.
    pub measure_agreement: Option<f64>,
}

/// A measure and its true value.
#[derive(Debug, Clone, PartialEq)]
pub struct TrueMeasure {
    /// `<target>.<kind>`.
    pub key: String,
    /// SI unit of the value.
    pub unit: &'static str,
    /// The value; `None` where it is infinite or undefined.
    pub value: Option<f64>,
    /// The size to which errors are relative.
    pub size: f64,
    /// How far the true value may be off, relative: the bound of `exact`, else the difference between both solutions.
    pub known_within: f64,
}

/// An error that was measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviation {
    /// The relative difference from the truth; infinite where one of both has no value.
    #[serde(rename = "error")]
    pub value: f64,
    /// How well the truth is known, relative; infinite where nothing tells.
    pub known_within: f64,
}

impl Deviation {
    /// Whether the difference is one of this solution, not of the truth.
    pub fn is_resolved(self) -> bool {
        self.value > self.known_within
    }

    /// The error, or where it is not resolved, what it does not exceed.
    pub fn at_most(self) -> f64 {
        self.value.max(self.known_within)
    }
}

/// One solution: a method at a tolerance.
#[derive(Debug, Clone, PartialEq)]
pub struct CostPoint {
    /// Name of the method.
    pub method: &'static str,
    /// Its relative tolerance; `None` for `exact`, which has none.
    pub rtol: Option<f64>,
    /// Its work, which repeats to the bit; `wall` is zero, as [`time`](Self::time) tells.
    pub work: Statistics,
    /// Time to solve and to read all measures \[s\], without compiling the network and without the
    /// further solutions that an error bar takes.
    pub time: Spread,
    /// The part of it until the integration has ended \[s\]; `exact` computes nothing before it is asked for.
    pub integration: Spread,
    /// Number of repeats.
    pub repeats: usize,
    /// Largest error of any differential unknown at any time, relative to the largest magnitude of
    /// that unknown. In scenes that switch, of the position, velocity and acceleration, or deformation,
    /// rate and force, of whatever has a measure. `None` where nothing moves.
    pub state: Option<Deviation>,
    /// Times of events.
    pub events: Timing,
    /// The measures in the order of [`CostReport::measures`].
    pub measures: Vec<MeasureDeviation>,
}

/// How well the times of events are met.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Timing {
    /// The largest error of the time of an event, relative to the length of the run, the first of a
    /// kind compared with the first, and so on; `None` where there is none to compare.
    #[serde(flatten)]
    pub deviation: Option<Deviation>,
    /// Number of true events that do not occur in the solution.
    pub missed: usize,
    /// Number of events that do not occur in truth.
    pub extra: usize,
}

/// The error of one measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasureDeviation {
    /// The error; `None` where the measure has no value, in truth as well.
    pub deviation: Option<Deviation>,
    /// The error bar that the run reports with it, relative: a bound of `exact`, else from solutions at
    /// 100 and 10 times the tolerance. `None` where it reports none.
    pub bar: Option<f64>,
    /// Whether the run warns that the accuracy wanted of this measure is not reached.
    pub warned: bool,
}

/// A time that was measured several times \[s\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The lower quartile.
    #[serde(rename = "lower_quartile")]
    pub lower: f64,
    /// The upper quartile.
    #[serde(rename = "upper_quartile")]
    pub upper: f64,
}

impl Spread {
    /// The interquartile range relative to the median; 0 where the median is.
    pub fn relative(self) -> f64 {
        if self.median > 0.0 { (self.upper - self.lower) / self.median } else { 0.0 }
    }
}

/// A method that did not deliver a solution.
#[derive(Debug, Clone, PartialEq)]
pub struct CostFailure {
    /// Name of the method.
    pub method: &'static str,
    /// The tolerance at which it failed; `None` if it declines the scene at any.
    pub rtol: Option<f64>,
    /// What it says.
    pub error: RunError,
    /// Whether finer tolerances were not tried, because this one takes too many steps.
    pub ends: bool,
}

/// What an error is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The state.
    State,
    /// The time of an event, or whether it occurs at all.
    Events,
    /// The measure at this place in [`CostReport::measures`].
    Measure(usize),
}

/// An error that the run does not tell of: larger than its error bar, or where it states none and does
/// not warn of any measure, than 1 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Underestimate {
    /// Name of the method.
    pub method: &'static str,
    /// Its tolerance; `None` for `exact`.
    pub rtol: Option<f64>,
    /// What is wrong.
    pub subject: Subject,
    /// By how much, relative; infinite where an event or a value is missing.
    pub error: f64,
    /// The bar that was stated, relative.
    pub bar: Option<f64>,
    /// Whether the run at least warns that the accuracy wanted is not reached; if not, it is wrong and silent.
    pub warned: bool,
}

impl CostPoint {
    /// What the error of none of the measures at these places exceeds; 0 if none of them has a value.
    pub fn worst(&self, places: &[usize]) -> f64 {
        self.largest(places).map_or(0.0, Deviation::at_most)
    }

    /// The largest error of the measures at these places; `None` if none has a value.
    pub fn largest(&self, places: &[usize]) -> Option<Deviation> {
        let all = places.iter().filter_map(|&place| self.measures.get(place)?.deviation);
        all.max_by(|one, other| one.at_most().total_cmp(&other.at_most()))
    }
}

impl CostReport {
    /// The quickest solution of which no asked measure is off by more than `target`, relative; `None`
    /// where none is, or where the truth is not known so well.
    pub fn cheapest(&self, target: f64) -> Option<&CostPoint> {
        self.cheapest_of(&self.asked, target)
    }

    /// The same for the measures at these places.
    pub fn cheapest_of(&self, places: &[usize], target: f64) -> Option<&CostPoint> {
        let good = self.points.iter().filter(|point| point.worst(places) <= target);
        good.min_by(|one, other| one.time.median.total_cmp(&other.time.median))
    }

    /// How many times as long the quickest solution takes that is ten times as good as `target`;
    /// `None` where there is none.
    pub fn next_digit(&self, target: f64) -> Option<f64> {
        let (now, then) = (self.cheapest(target)?, self.cheapest(0.1 * target)?);
        (now.time.median > 0.0).then(|| then.time.median / now.time.median)
    }
}
