//! Elements whose law changes at switchings: small state machines.
//!
//! A phase has a law and exits. An exit watches one quantity of the element and leads to another phase where that
//! quantity passes a level in one direction. Which phases hold after an instant at which exits are reached is decided
//! for all elements together: none of them may be on its way out again.

use std::{fmt::Debug, sync::Arc};

use super::{Element, Law};

/// One phase of an element, with what it remembers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phase {
    /// Its number in [`Phases::names`].
    pub index: usize,
    /// A deformation \[m\] that was noted when a phase was entered: where a slider got stuck, how
    /// far a foam had been pressed.
    pub memory: f64,
}

/// The law that holds in a phase.
#[derive(Debug, Clone)]
pub enum PhaseLaw {
    /// No force.
    Open,
    /// This deformation \[m\], whatever the force.
    Held(f64),
    /// This force \[N\], whatever the motion.
    Force(f64),
    /// The law of another element: a spring, a dashpot or one that is not linear.
    Element(Arc<dyn Element>),
}

/// The quantity that an exit watches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Watched {
    /// The deformation \[m\].
    Deformation,
    /// The deformation rate \[m/s\].
    Rate,
    /// The force \[N\].
    Force,
}

/// A way out of a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exit {
    /// What is watched.
    pub watched: Watched,
    /// The level at which the phase ends, in the unit of what is watched.
    pub level: f64,
    /// Whether it ends where the level is passed from below; else from above.
    pub rising: bool,
    /// Number of the phase that follows.
    pub to: usize,
    /// Whether the deformation at that instant is noted; else the memory is kept.
    pub remembers: bool,
}

/// The phases of an element.
pub trait Phases: Debug + Send + Sync {
    /// A word for each phase, for instance `open` and `closed`.
    fn names(&self) -> &'static [&'static str];

    /// The phase in which the element begins a run at this deformation \[m\].
    fn first(&self, deformation: f64) -> Phase;

    /// The law in a phase.
    fn law(&self, phase: Phase) -> PhaseLaw;

    /// The ways out of a phase.
    fn exits(&self, phase: Phase) -> Vec<Exit>;

    /// The phase in place of one that only goes deeper, where an event leaves an element less deep than it was. Within an
    /// interval a rate tells that.
    fn less_deep(&self, _phase: Phase) -> Option<usize> {
        None
    }

    /// The force \[N\] at which it slides, of a dry slider. Those between the same two places share a
    /// force in this proportion.
    fn capacity(&self) -> Option<f64> {
        None
    }

    /// The force up to which a dry slider sticks, in parts of that at which it slides; 1 or more.
    fn static_to_kinetic(&self) -> f64 {
        1.0
    }

    /// The law as the compiler of networks sees it, of an element whose force is one of the deformation
    /// alone whatever its phase. Balances at the start need the whole of it.
    fn at_rest(&self) -> Option<Law> {
        None
    }

    /// The part of the speed of approach with which masses part that meet as a phase of
    /// [`PhaseLaw::Held`] begins, from 0 to 1.
    fn restitution(&self) -> f64 {
        0.0
    }
}
