//! The best numbers of a scene within its limits.
//!
//! Numbers may vary between bounds; what is made least is one of them, or a measure, in the worst of several tests.
//! Every limit has to be kept in every test, no pad may be pressed by more than its thickness, and no law beyond its
//! last point. Designs spread over the bounds are solved first: all points of a grid for one or two numbers, a Latin
//! hypercube for more. From the best of them the optimum is sought by sequential quadratic programming with differences
//! of solutions as gradients; where none of them keeps everything, the least excess is sought first. What is found is
//! solved once more with its errors, and moved inwards where these reach across a limit.

mod aims;
mod along;
mod evaluate;
mod found;
mod front;
mod programme;
mod robust;
mod search;
mod settled;
mod spread;

#[cfg(test)]
mod tests;

use dashpot_analysis::{
    RunError, Unevaluated,
    sweep::{PoseAt, SweepError},
};
use thiserror::Error;

use self::search::Search;
pub use self::{
    along::along,
    evaluate::{DepthOf, Required, Requirement},
    found::{Borne, Design, Front, FrontPoint, Kept, Looked, Lost, Searched, Side, Slope},
    front::{front, undominated},
    robust::{PoseScattered, Scattered, robust},
};

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

/// Numbers with a given sum, such as layers that share a thickness. The last one follows from the others.
#[derive(Debug, Clone, PartialEq)]
pub struct Total {
    /// The variables, by their positions; each is in one sum at most.
    pub of: Vec<usize>,
    /// Their sum, in SI units.
    pub sum: f64,
}

/// What is searched.
#[derive(Clone, Copy)]
pub struct Problem<'p> {
    /// What may vary.
    pub variables: &'p [Variable],
    /// Which of that has a given sum.
    pub totals: &'p [Total],
    /// What is made least.
    pub aim: &'p Aim,
    /// What poses the scene of each test.
    pub tests: &'p [&'p PoseAt<'p>],
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
    /// A sum that its numbers cannot have.
    #[error("their bounds allow sums from {low} to {high} in SI units alone")]
    #[expect(missing_docs, reason = "the message says what the fields are")]
    NoSum { low: f64, high: f64 },
    /// So few scattered designs show no such probability.
    #[error(
        "{designs} scattered designs cannot show that probability: {least} that all keep everything are the least"
    )]
    #[expect(missing_docs, reason = "the message says what the fields are")]
    TooFew { designs: usize, least: f64 },
    /// No design could be evaluated.
    #[error("no design between the bounds can be evaluated: {}", first(.0))]
    Nothing(Unevaluated),
}

/// Why the first of them could not.
fn first(all: &Unevaluated) -> &str {
    all.causes.first().map_or("there is none", |own| &own.cause.message)
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
/// use dashpot_design::optimum::{Aim, Effort, Problem, Variable, design};
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
/// let variables = [Variable { low: 1e3, high: 1e6, start: 1e5 }];
/// let (aim, tests) = (Aim::Number(0), [&pose as _]);
/// let problem = Problem { variables: &variables, totals: &[], aim: &aim, tests: &tests };
/// let found = design(&problem, Effort::default())?;
/// assert!(found.is_feasible && (found.values[0] / 4e4 - 1.0).abs() < 1e-5);
/// # Ok::<(), dashpot_design::optimum::DesignError>(())
/// ```
pub fn design(problem: &Problem<'_>, effort: Effort) -> Result<Design, DesignError> {
    let search = Search::of(problem, None, effort)?;
    let known = search.known(&problem.begin())?;
    let slack = search.no_slack();
    let (best, searched) = search.best(&known, &slack);
    search.settled(best, searched, &known, slack)
}

impl<'p> Problem<'p> {
    /// Where the scene has its numbers, within the bounds.
    fn begin(&self) -> Vec<f64> {
        self.variables.iter().map(|own| own.start.clamp(own.low, own.high)).collect()
    }

    /// Whether there is room between all bounds, and for each sum.
    fn check(&self) -> Result<(), DesignError> {
        let is_one =
            |own: &Variable| own.low < own.high && own.low.is_finite() && own.high.is_finite();
        if !self.variables.iter().all(is_one) {
            return Err(DesignError::NoRoom);
        }
        for own in self.totals {
            let of = |end: fn(&Variable) -> f64| -> f64 {
                own.of.iter().map(|at| end(&self.variables[*at])).sum()
            };
            let (low, high) = (of(|own| own.low), of(|own| own.high));
            if !(low..=high).contains(&own.sum) {
                return Err(DesignError::NoSum { low, high });
            }
        }
        Ok(())
    }

    /// The same with another aim.
    fn with_aim(self, aim: &'p Aim) -> Self {
        Self { aim, ..self }
    }
}
