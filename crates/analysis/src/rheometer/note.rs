//! What is special about a model under a test, and why a test cannot be made, as data.

use dashpot_dae::SolveError;
use dashpot_network::{NetworkErrors, parameters::InvalidParameter};
use thiserror::Error;

use crate::{RunError, wording::quantity};

dashpot_units::words! {
    /// What is special about a model under a test, or why one of its figures has no value.
    #[derive(Debug, Clone, Copy, PartialEq, Error)]
    pub enum Note, pub fn code(self) {
        /// It bears no force.
        #[error("the model bears no force")]
        NoForce = "no-force",
        /// It is rigid, so it has no stiffness.
        #[error("the model is rigid")]
        Rigid = "rigid",
        /// It is rigid, so nothing deforms under a force.
        #[error("the model is rigid: nothing deforms")]
        NothingDeforms = "nothing-deforms",
        /// It is a solid, which has no viscosity.
        #[error("a solid: it comes to rest under a constant force")]
        Solid = "solid",
        /// It has no stiffness at once.
        #[error("no elasticity at once: a sudden deformation would take an infinite force")]
        NoInstantaneousStiffness = "no-instantaneous-stiffness",
        /// It does not deform at once.
        #[error("no elasticity at once: the deformation does not jump with the force")]
        NoInstantaneousDeformation = "no-instantaneous-deformation",
        /// It is a liquid: it flows under a force.
        #[error("a liquid: it flows as long as a force is held, without bound")]
        Flows = "flows",
        /// It is a liquid: its force relaxes to nothing.
        #[error("a liquid: the force relaxes to nothing")]
        RelaxesToNothing = "relaxes-to-nothing",
        /// It is a liquid: its loss factor grows towards low frequencies.
        #[error("a liquid: the loss factor grows without bound towards low frequencies")]
        LiquidLoss = "liquid-loss",
        /// A dashpot beside all else lets its loss factor grow towards high frequencies.
        #[error("a dashpot beside all else: the loss factor grows without bound towards high frequencies")]
        DashpotLoss = "dashpot-loss",
        /// Its loss factor has no peak.
        #[error("the loss factor has no peak at a finite frequency")]
        NoLossPeak = "no-loss-peak",
        /// On the way back the force does not come to zero.
        #[error("the force does not come to zero on the way back")]
        ForceLeft = "force-left",
        /// The force comes to zero as the motion turns.
        #[error("the force comes to zero as the motion turns: the model follows more slowly than it is let go")]
        NothingBack = "nothing-back",
        /// A dashpot beside all else lets the force jump as the motion begins.
        #[error("a dashpot beside all else: the force jumps as the motion begins")]
        ForceJumps = "force-jumps",
        /// A dashpot beside all else allows no sudden deformation: it rises within this time \[s\] instead.
        #[error(
            "a dashpot beside all else answers a sudden deformation with an infinite force: the deformation rises within \
             {} instead", quantity(*.0, "s")
        )]
        Rise(f64) = "rise",
    }
}

dashpot_units::words! {
    /// Why an independent computation does not reach further.
    #[derive(Debug, Clone, PartialEq, Error)]
    pub enum Obstacle, pub fn code(&self) {
        /// The network of the model does not compile.
        #[error(transparent)]
        Network(#[from] NetworkErrors) = "network",
        /// The method does not deliver a trajectory.
        #[error(transparent)]
        Solve(#[from] SolveError) = "solve",
        /// The run of the network fails.
        #[error(transparent)]
        Run(#[from] RunError) = "run",
        /// Two changes of the test are at one instant.
        #[error("two changes of the test cannot be told apart")]
        ChangesAtOnce = "changes-at-once",
        /// The force follows from nothing.
        #[error("the force in a rigid link is undetermined")]
        Undetermined = "undetermined",
        /// The times of the model are out of the range of double precision.
        #[error("the times of the model are out of range")]
        OutOfRange = "out-of-range",
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
        } = "too-wide",
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
