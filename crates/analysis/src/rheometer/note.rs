//! What is special about a model under a test, and why a test cannot be made, as data.

use std::fmt;

use dashpot_dae::SolveError;
use dashpot_network::{NetworkErrors, parameters::InvalidParameter};
use thiserror::Error;

use crate::{RunError, wording::quantity};

/// What is special about a model under a test, or why one of its figures has no value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Note {
    /// It bears no force.
    NoForce,
    /// It is rigid, so it has no stiffness.
    Rigid,
    /// It is rigid, so nothing deforms under a force.
    NothingDeforms,
    /// It is a solid, which has no viscosity.
    Solid,
    /// It has no stiffness at once.
    NoInstantaneousStiffness,
    /// It does not deform at once.
    NoInstantaneousDeformation,
    /// It is a liquid: it flows under a force.
    Flows,
    /// It is a liquid: its force relaxes to nothing.
    RelaxesToNothing,
    /// It is a liquid: its loss factor grows towards low frequencies.
    LiquidLoss,
    /// A dashpot beside all else lets its loss factor grow towards high frequencies.
    DashpotLoss,
    /// Its loss factor has no peak.
    NoLossPeak,
    /// On the way back the force does not come to zero.
    ForceLeft,
    /// The force comes to zero as the motion turns.
    NothingBack,
    /// A dashpot beside all else lets the force jump as the motion begins.
    ForceJumps,
    /// A dashpot beside all else allows no sudden deformation: it rises within this time \[s\] instead.
    Rise(f64),
}

impl Note {
    /// What kind of note it is, in one word that stays the same.
    pub fn code(self) -> &'static str {
        match self {
            Self::NoForce => "no-force",
            Self::Rigid => "rigid",
            Self::NothingDeforms => "nothing-deforms",
            Self::Solid => "solid",
            Self::NoInstantaneousStiffness => "no-instantaneous-stiffness",
            Self::NoInstantaneousDeformation => "no-instantaneous-deformation",
            Self::Flows => "flows",
            Self::RelaxesToNothing => "relaxes-to-nothing",
            Self::LiquidLoss => "liquid-loss",
            Self::DashpotLoss => "dashpot-loss",
            Self::NoLossPeak => "no-loss-peak",
            Self::ForceLeft => "force-left",
            Self::NothingBack => "nothing-back",
            Self::ForceJumps => "force-jumps",
            Self::Rise(_) => "rise",
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::NoForce => "the model bears no force",
            Self::Rigid => "the model is rigid",
            Self::NothingDeforms => "the model is rigid: nothing deforms",
            Self::Solid => "a solid: it comes to rest under a constant force",
            Self::NoInstantaneousStiffness => {
                "no elasticity at once: a sudden deformation would take an infinite force"
            }
            Self::NoInstantaneousDeformation => {
                "no elasticity at once: the deformation does not jump with the force"
            }
            Self::Flows => "a liquid: it flows as long as a force is held, without bound",
            Self::RelaxesToNothing => "a liquid: the force relaxes to nothing",
            Self::LiquidLoss => {
                "a liquid: the loss factor grows without bound towards low frequencies"
            }
            Self::DashpotLoss => {
                "a dashpot beside all else: the loss factor grows without bound towards high \
                 frequencies"
            }
            Self::NoLossPeak => "the loss factor has no peak at a finite frequency",
            Self::ForceLeft => "the force does not come to zero on the way back",
            Self::NothingBack => {
                "the force comes to zero as the motion turns: the model follows more slowly than it is let go"
            }
            Self::ForceJumps => "a dashpot beside all else: the force jumps as the motion begins",
            Self::Rise(time) => {
                let time = quantity(*time, "s");
                return write!(
                    f,
                    "a dashpot beside all else answers a sudden deformation with an infinite \
                     force: the deformation rises within {time} instead"
                );
            }
        };
        f.write_str(text)
    }
}

/// Why an independent computation does not reach further.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Obstacle {
    /// The network of the model does not compile.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// The method does not deliver a trajectory.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The run of the network fails.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Two changes of the test are at one instant.
    #[error("two changes of the test cannot be told apart")]
    ChangesAtOnce,
    /// The force follows from nothing.
    #[error("the force in a rigid link is undetermined")]
    Undetermined,
    /// The times of the model are out of the range of double precision.
    #[error("the times of the model are out of range")]
    OutOfRange,
    /// The exact solution would have no useful bound.
    #[error(
        "{unknowns} unknowns over {decades:.0} decades of time leave the exact solution without a useful \
         bound"
    )]
    TooWide {
        /// How many unknowns there are.
        unknowns: usize,
        /// Over how many decades of time.
        decades: f64,
    },
}

impl Obstacle {
    /// What kind of obstacle it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Network(_) => "network",
            Self::Solve(_) => "solve",
            Self::Run(_) => "run",
            Self::ChangesAtOnce => "changes-at-once",
            Self::Undetermined => "undetermined",
            Self::OutOfRange => "out-of-range",
            Self::TooWide { .. } => "too-wide",
        }
    }
}

/// Why a test has no report.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RheometerError {
    /// There is no such protocol.
    #[error("unknown test `{name}`; known tests: {}", .known.join(", "))]
    UnknownProtocol {
        /// What was asked for.
        name: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// The protocol has no such parameter.
    #[error("`{protocol}` has no `{name}`; it has: {}", .known.join(", "))]
    UnknownParameter {
        /// The protocol.
        protocol: &'static str,
        /// What was given.
        name: String,
        /// What it has.
        known: Vec<&'static str>,
    },
    /// A parameter of the test or of the model is out of its range.
    #[error(transparent)]
    Invalid(#[from] InvalidParameter),
    /// The test is one of linear models only.
    #[error(
        "`{protocol}` needs a linear model, and `{kind}` is not linear: `load-unload` takes any model"
    )]
    NeedsLinear {
        /// The protocol.
        protocol: &'static str,
        /// Word of the first element that is not linear.
        kind: &'static str,
    },
    /// The force at which the test is to turn is not reached.
    #[error(
        "the force does not reach {} up to a deformation of {}: give a lower force, or a deformation",
        quantity(*.force, "N"), quantity(*.deformation, "m")
    )]
    ForceNotReached {
        /// The force \[N\].
        force: f64,
        /// How far was looked \[m\].
        deformation: f64,
    },
    /// The deformation at which the force is reached is not found.
    #[error("the deformation at which the force is reached is not found: {obstacle}")]
    NoTurn {
        /// Why not.
        obstacle: Box<Obstacle>,
    },
    /// The constants of the model or of the test are too far apart for double precision.
    #[error("the constants of the model or the test are too far apart for double precision")]
    OutOfScale,
    /// The model cannot be tested in this way.
    #[error("`{protocol}` is not possible: {reason}")]
    Impossible {
        /// The protocol.
        protocol: &'static str,
        /// Why, in mechanical words, and what is possible.
        reason: &'static str,
    },
}
