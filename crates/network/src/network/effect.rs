//! What acts on a network besides its elements.

use std::{any::Any, sync::Arc};

use dashpot_dae::Waveform;

use super::{Network, NodeId, Situation};
use crate::{error::NetworkError, parameters::Described};

/// Something that acts on a network without being a two-terminal law.
///
/// An effect states only what it does; the defaults do nothing and cost nothing.
pub trait Effect: Any + Described {
    /// Body forces on nodes \[N\] as functions of time \[s\], positive towards the support. An
    /// accelerometer on the node does not feel them.
    fn body_forces(&self, _network: &Network) -> Vec<(NodeId, Waveform)> {
        Vec::new()
    }

    /// Whether parts without start speed begin in balance under the forces of the effects.
    fn starts_in_balance(&self) -> bool {
        false
    }

    /// Gravitational acceleration that the effect brings \[m/s²\], for heights of fall.
    fn gravity(&self) -> Option<f64> {
        None
    }

    /// Name of the element that it acts on, where it acts on one.
    fn target(&self) -> Option<&str> {
        None
    }

    /// The same on the element of this name; `None` for what acts on no element.
    fn on(&self, _element: &str) -> Option<Arc<dyn Effect>> {
        None
    }

    /// Whether it puts nodes and elements into the network; those on one element do.
    fn rewrites(&self) -> bool {
        self.target().is_some()
    }

    /// Puts the nodes and elements that the effect is made of into the network.
    ///
    /// # Errors
    ///
    /// [`NetworkError`] where the network has no place for them.
    fn rewrite(&self, _network: &mut Network) -> Result<(), NetworkError> {
        Ok(())
    }

    /// The dimensionless numbers that measure how much it matters; none where the scales do not
    /// tell. The effect need not be one of the network.
    fn influences(&self, _situation: &Situation<'_>) -> Vec<Influence> {
        Vec::new()
    }

    /// Keeps what else of the network rests on the effect, which is about to be left out of it.
    fn leave(&self, _network: &mut Network) {}
}

/// A dimensionless number that measures how much a detail of a network matters.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// What it is, as a formula, for instance `A = g δ/V0²`.
    pub formula: String,
    /// Its value \[1\], ≥ 0; the detail matters little where it is far below 1.
    pub value: f64,
}

impl Influence {
    /// The number of this formula.
    pub fn new(formula: impl Into<String>, value: f64) -> Self {
        Self { formula: formula.into(), value }
    }

    /// The largest of several.
    pub fn largest(all: Vec<Self>) -> Option<Self> {
        all.into_iter().max_by(|one, other| one.value.total_cmp(&other.value))
    }

    /// The part of `reach` that lies beyond `limit`, both ≥ 0: `1 − limit/reach`, 0 where the limit is not reached.
    pub(crate) fn beyond(formula: impl Into<String>, reach: f64, limit: f64) -> Self {
        Self::new(formula, if reach > limit { 1.0 - limit / reach } else { 0.0 })
    }
}
