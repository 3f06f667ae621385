//! Cushion curves: the peak acceleration of a platen over its static stress, for heights of the drop and thicknesses
//! of the cushion, in the layout of ASTM D1596.
//!
//! A flat platen of mass `m` is guided onto a cushion of area `A` and thickness `t` from the height `h`. Its weight over
//! the area is the static stress `σ = m g/A`; it is varied by the mass, as the standard does, and the area stays. Gravity
//! acts during the impact, and the platen comes with `√(2 g h)`.
//!
//! A cushion of modulus `E` that is linear and loses nothing has a closed form. The balance of energy at the deepest
//! point `y` is `m g (h + y) = E A y²/(2 t)`, so that the force there, `E A y/t = G m g`, is
//!
//! ```text
//! G = 1 + √(1 + 2 E h/(σ t))
//! ```
//!
//! times the weight: that is what an accelerometer on the platen reads, and what a sensor does that is zeroed in free
//! fall. Nothing stops such a cushion from being pressed through, `y/t = G σ/E`; where one is, its curve ends.
//!
//! # References
//!
//! `astm-d1596` in `docs/references.bib`.

mod batches;
mod best;
mod creep;
mod curves;
mod edge;
mod platen;
mod point;
mod repeated;
mod stress_energy;
mod thinnest;

#[cfg(test)]
mod tests;

use dashpot_analysis::{RunError, Unevaluated, sweep::SweepError};
use dashpot_network::NetworkErrors;
use serde::Serialize;
use thiserror::Error;

pub use self::{
    batches::{Sure, with_scatter},
    best::{Best, Passing, Place, Reach},
    creep::{Creep, Trust},
    curves::Curve,
    platen::{Assumed, Platen, PoseOfThickness},
    point::{CushionPoint, Known},
    repeated::{Repeated, Row},
    stress_energy::{Collapse, StressEnergy},
    thinnest::{Thinnest, Unmet},
};
use self::{curves::Tests, thinnest::Question};
use crate::shared::shared;

/// What curves are asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// Heights of the drop \[m\], rising.
    pub heights: Vec<f64>,
    /// Thicknesses \[m\], rising.
    pub thicknesses: Vec<f64>,
    /// Static stresses \[Pa\], rising; of none, a range about the best ones.
    pub stresses: Vec<f64>,
    /// The most that the peak may be \[m/s²\].
    pub limit: Option<f64>,
    /// Over which static stresses \[Pa\] the thinnest cushion has to keep it.
    pub over: Option<[f64; 2]>,
    /// Drops in a row on the same cushion.
    pub row: Option<Row>,
    /// Times \[s\], rising, after which the compression under the weight is told.
    pub creep: Vec<f64>,
    /// How many threads share the work; the results are the same.
    pub threads: usize,
}

/// Cushion curves and what they say.
#[derive(Debug, Clone, PartialEq)]
pub struct Cushion {
    /// The platen and the cushion.
    pub platen: Platen,
    /// One for each height and thickness, the thicknesses of a height one after the other.
    pub curves: Vec<Curve>,
    /// What holds the limit over the range, for each height; none where there is no such question.
    pub thinnest: Vec<Thinnest>,
    /// The compression under the weight: at the ends of the range of the question, else at the least and the largest of
    /// the best stresses.
    pub creep: Vec<Creep>,
    /// The stress–energy method beside them; `None` of a single curve.
    pub stress_energy: Option<StressEnergy>,
    /// What could not be evaluated, of the points of the curves and of drops between them; those have their height,
    /// thickness and static stress.
    pub unevaluated: Unevaluated,
    /// How it was solved.
    pub work: Work,
}

impl Cushion {
    /// Whether a cushion keeps the limit from each height: over the whole range where there is one, and no thinner one is
    /// left open; else at any stress.
    pub fn is_kept(&self) -> bool {
        if !self.thinnest.is_empty() {
            return self.thinnest.iter().all(|own| own.over_all.is_ok() && !own.is_open);
        }
        self.of_heights().all(|own| own.iter().any(|own| own.passing.is_some()))
    }

    /// The curves of each height.
    pub fn of_heights(&self) -> impl Iterator<Item = &[Curve]> {
        self.curves.chunk_by(|one, next| one.height.to_bits() == next.height.to_bits())
    }
}

/// How curves were solved.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Work {
    /// Points of the curves.
    pub points: usize,
    /// Those of them that were instantiated; all others were solved in full.
    pub instantiated: usize,
    /// Those at which errors were estimated by further solutions.
    pub estimated: usize,
    /// Drops besides them, from which the best stresses and the ends of ranges were found.
    pub probes: usize,
    /// Drops of scattered designs.
    pub scattered: usize,
    /// Those of them that were instantiated.
    pub scattered_instantiated: usize,
}

/// Why there are no cushion curves.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoCushion {
    /// The network is at fault.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// Not one body falls.
    #[error("one body has to fall onto the cushion; here {}", words(names))]
    NotOneBody {
        /// Those that move at first.
        names: Vec<String>,
    },
    /// Something has no such name.
    #[error("there is no {what} `{name}`; there are {}", known.join(", "))]
    Unknown {
        /// What is wanted, in a word.
        what: &'static str,
        /// The name.
        name: String,
        /// What there is.
        known: Vec<String>,
    },
    /// Not one pad is under the body.
    #[error("one element with a `thickness` has to be under `{body}`; here {}", words(names))]
    NotOnePad {
        /// The body.
        body: String,
        /// The elements with a thickness that touch it.
        names: Vec<String>,
    },
    /// The body is more than a platen.
    #[error(
        "`{element}` touches `{body}` as well: a static stress is that of a body which rests on its cushion alone"
    )]
    Hangs {
        /// The body.
        body: String,
        /// The element.
        element: String,
    },
    /// The cushion has no area.
    #[error("`{pad}` has no `area`, over which its static stress could be told")]
    NoArea {
        /// The cushion.
        pad: String,
    },
    /// Gravity does not press the platen onto the cushion.
    #[error(
        "gravity is {gravity} m/s² in this scene: a static stress wants it to pull towards the support"
    )]
    NoWeight {
        /// Its acceleration \[m/s²\].
        gravity: f64,
    },
    /// Nothing says how high the drop is.
    #[error("`{body}` does not fall, and no height is given")]
    NoHeight {
        /// The body.
        body: String,
    },
    /// A cushion does not answer to a force that stays.
    #[error("the creep of `{pad}` cannot be told: {reason}")]
    NoCreep {
        /// The cushion.
        pad: String,
        /// Why.
        reason: String,
    },
    /// The scene at a thickness cannot be made.
    #[error("{0}")]
    NotPosed(String),
    /// A run or a sweep fails as a whole.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The sweep over the curves fails.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// No drop near what the scene has was solved, from which a range of stresses could be found.
    #[error("no drop between {} and {} Pa could be solved: {reason}", range[0], range[1])]
    NoStress {
        /// The range that was looked at \[Pa\].
        range: [f64; 2],
        /// Why the first of them could not.
        reason: String,
    },
}

fn words(names: &[String]) -> String {
    if names.is_empty() {
        "there is none".to_owned()
    } else {
        format!("there are {}", names.join(", "))
    }
}

/// The curves of a platen on a cushion, which `pose` poses at a thickness; `watch` is told how far they are.
///
/// # Errors
///
/// [`NoCushion`] where the scene is none of that kind, or nothing could be solved. Single points that fail are
/// [unsolved](Known::Unsolved).
///
/// # Examples
///
/// The closed form of a linear cushion:
///
/// ```
/// use std::ops::ControlFlow;
/// use dashpot_analysis::{SolveSettings, sweep::ScenePoint};
/// use dashpot_design::cushion::{Asked, Platen, cushion};
/// use dashpot_network::{Network, Node, spring};
///
/// let modulus = 1e5;
/// let pose = |thickness: f64| {
///     let mut network = Network::new();
///     let platen = network.add_node(Node::mass("platen", 8.0).dropped(0.6));
///     let ground = network.ground();
///     let pad = network.connect("pad", platen, ground, spring(modulus * 0.04 / thickness));
///     (pad.thickness, pad.area) = (Some(thickness), Some(0.04));
///     Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
/// };
/// let own = pose(0.05)?;
/// let platen = Platen::of(&own.network, None, None)?;
/// let asked = Asked {
///     heights: vec![0.6],
///     thicknesses: vec![0.05],
///     stresses: vec![1e3, 2e3],
///     limit: None,
///     over: None,
///     row: None,
///     creep: Vec::new(),
///     threads: 1,
/// };
/// let curves = cushion(&platen, &asked, &pose, &mut |_, _| ControlFlow::Continue(()))?.curves;
/// let right = 9.80665 * (1.0 + (1.0 + 2.0 * modulus * 0.6 / (2e3 * 0.05_f64)).sqrt());
/// assert!((curves[0].points[1].peak / right - 1.0).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cushion(
    platen: &Platen,
    asked: &Asked,
    pose: &PoseOfThickness<'_>,
    watch: &mut dashpot_analysis::sweep::Watch<'_>,
) -> Result<Cushion, NoCushion> {
    let tests = Tests::new(platen, asked, pose)?;
    let stresses = match &asked.stresses[..] {
        [] => best::range(&tests)?,
        given => given.to_vec(),
    };
    let (mut curves, mut work) = tests.curves(&stresses, watch)?;
    let found = shared(asked.threads, &curves, &|own| best::find(&tests, own, asked.limit));
    for (curve, (best, passing)) in curves.iter_mut().zip(found) {
        (curve.best, curve.passing) = (best, passing);
    }
    if let Some(row) = asked.row {
        tests.in_a_row(row, &mut curves, watch)?;
    }
    let creep = tests.creep(&curves)?;
    let thinnest = match (asked.limit, asked.over) {
        (Some(limit), Some(over)) => {
            let question = Question { tests: &tests, limit, over };
            shared(asked.threads, &asked.heights, &|height| question.answer(*height))
        }
        _ => Vec::new(),
    };
    work.probes = tests.probes();
    let stress_energy = StressEnergy::of(&curves, dashpot_units::STANDARD_GRAVITY);
    let unevaluated = tests.missing.told(work.points + work.probes);
    let platen = platen.clone();
    Ok(Cushion { platen, curves, thinnest, creep, stress_energy, unevaluated, work })
}
