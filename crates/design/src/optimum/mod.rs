//! The best numbers of a scene within its limits.
//!
//! Numbers may vary between bounds; what is made least is one of them, or a measure, in the worst of several tests.
//! Every limit has to be kept in every test, and no pad or law may be pressed further than is known of it. Designs
//! spread over the bounds are solved first: all points of a grid for one or two numbers, a Latin hypercube for more.
//! From the best of them the optimum is sought by sequential quadratic programming with differences of solutions as
//! gradients; where none of them keeps everything, the least excess is sought first. What is found is solved once more
//! with its errors, and moved inwards where these reach across a limit.

mod aims;
mod evaluate;
mod programme;
mod search;
mod spread;

#[cfg(test)]
mod tests;

use dashpot_analysis::{
    RunError, RunReport,
    sweep::{PoseAt, SweepError},
};
use thiserror::Error;

pub use self::evaluate::{Required, Requirement};
use self::{evaluate::Evaluator, search::Search, spread::Place};

/// A number that may vary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Variable {
    /// The least value, in SI units.
    pub low: f64,
    /// The largest, above it.
    pub high: f64,
    /// Where the scene has it.
    pub start: f64,
}

/// What is made least.
#[derive(Debug, Clone, PartialEq)]
pub enum Aim {
    /// One of the variables, by its position.
    Number(usize),
    /// A measure, by its key; the largest of all tests.
    Measure(String),
    /// A number that does not vary here: whatever keeps everything is as good.
    Given(f64),
}

/// How much is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Designs that are spread over the bounds; with none of them the search begins where the scene is.
    pub designs: usize,
    /// From how many of them the optimum is sought.
    pub starts: usize,
    /// Threads that share the designs.
    pub threads: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self { designs: 400, starts: 4, threads: 1 }
    }
}

/// Why there is no design.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum DesignError {
    /// The scene cannot be posed.
    #[error("{0}")]
    NotPosed(String),
    /// It cannot be solved.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A measure is none of its own.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A variable has no room.
    #[error("a number has no room between its bounds")]
    NoRoom,
    /// No design could be solved.
    #[error("no design between the bounds can be solved: {0}")]
    Nothing(String),
}

/// What a requirement comes to in a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The requirement.
    pub required: Required,
    /// The measure in SI units, or the part of what is known to which the pad or law is pressed.
    pub value: f64,
    /// What is left, in parts of the bound; negative where it is exceeded.
    pub margin: f64,
    /// Whether it holds the design where it is.
    pub is_active: bool,
    /// By how much the aim would change per unit of the bound \[SI units\]; of what is active alone.
    pub price: Option<f64>,
}

/// A design.
#[derive(Debug)]
pub struct Design {
    /// The numbers, in SI units.
    pub values: Vec<f64>,
    /// The aim, in the worst test.
    pub aim: f64,
    /// What is required, test by test.
    pub kept: Vec<Kept>,
    /// For each number the change of the aim and of what is required, per unit of it.
    pub slopes: Vec<Slope>,
    /// Which numbers are at a bound.
    pub at_bound: Vec<Option<Side>>,
    /// Whether everything is kept; else it is the design that exceeds the least, in parts of the bounds.
    pub is_feasible: bool,
    /// How it was found.
    pub search: Searched,
    /// Its runs, one for each test, with their errors.
    pub runs: Vec<RunReport>,
}

impl Design {
    /// The least that is left to anything, in parts of its bound; negative where it is exceeded.
    pub fn least_margin(&self) -> f64 {
        self.kept.iter().map(|own| own.margin).fold(f64::INFINITY, f64::min)
    }
}

/// Derivatives with respect to one number.
#[derive(Debug, Clone, PartialEq)]
pub struct Slope {
    /// Of the aim in the worst test.
    pub aim: f64,
    /// Of each requirement's value.
    pub values: Vec<f64>,
}

/// A bound of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The least value.
    Low,
    /// The largest.
    High,
}

/// How a design was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Searched {
    /// Designs that were spread over the bounds.
    pub designs: usize,
    /// Whether those are all points of a grid.
    pub is_grid: bool,
    /// Starts of the search …
    pub starts: usize,
    /// … and how many of them ended there.
    pub agree: usize,
    /// Designs of which everything is kept, among those that were spread.
    pub feasible: usize,
    /// Designs that were solved in all.
    pub solved: usize,
}

/// Searches the best numbers within what is required in all tests; without variables it is the scene that is judged.
///
/// # Errors
///
/// [`DesignError`]; a design that does not keep everything is none: see [`Design::is_feasible`].
///
/// # Examples
///
/// The softest spring on which 4 kg at 2 m/s come in by 20 mm at most: `K = m v²/x²`.
///
/// ```
/// use dashpot_analysis::{Bound, Limit, SolveSettings, sweep::ScenePoint};
/// use dashpot_design::optimum::{Aim, Effort, Variable, design};
/// use dashpot_network::{Network, Node, spring};
///
/// let pose = |values: &[f64]| {
///     let mut network = Network::new();
///     let head = network.add_node(Node::mass("head", 4.0).moving(2.0));
///     network.connect("pad", head, network.ground(), spring(values[0]));
///     let mut settings = SolveSettings::lasting(0.1);
///     settings.limits = vec![Limit::new("pad.peak-deformation", Bound::Max(0.02))];
///     Ok(ScenePoint { network, settings })
/// };
/// let variable = Variable { low: 1e3, high: 1e6, start: 1e5 };
/// let found = design(&[variable], &Aim::Number(0), &[&pose], Effort::default())?;
/// assert!(found.is_feasible && (found.values[0] / 4e4 - 1.0).abs() < 1e-5);
/// # Ok::<(), dashpot_design::optimum::DesignError>(())
/// ```
pub fn design(
    variables: &[Variable],
    aim: &Aim,
    tests: &[&PoseAt<'_>],
    effort: Effort,
) -> Result<Design, DesignError> {
    let is_one = |own: &Variable| own.low < own.high && own.low.is_finite() && own.high.is_finite();
    if !variables.iter().all(is_one) {
        return Err(DesignError::NoRoom);
    }
    let places: Vec<Place> = variables.iter().map(Place::of).collect();
    let begin: Vec<f64> = variables.iter().map(|own| own.start.clamp(own.low, own.high)).collect();
    let evaluator = Evaluator::new(tests, aim, &begin)?;
    Search::new(evaluator, places, effort).found(&begin)
}
