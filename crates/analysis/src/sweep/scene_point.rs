//! An impact that is to be solved, and what becomes known of it.

use dashpot_dae::Signal;
use dashpot_numerics::small::Square;

/// An impact, ready to be solved: `ż = A z` in any unit of time, and what is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct ScenePoint<'s, const N: usize> {
    /// `A` by its columns.
    pub(super) matrix: &'s Square<N>,
    /// The state at the start.
    pub(super) start: &'s [f64; N],
    /// The contact force \[N\] over the states.
    pub(super) force: &'s [f64; N],
    /// The deformation \[m\] of the same element.
    pub(super) deformation: &'s [f64; N],
    /// Length of the run.
    pub(super) end: f64,
    /// Whether what strikes is let go for good where the force falls through zero.
    pub(super) opens: bool,
}

/// A number and how far it may be off.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Figure {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Figure {
    /// One that is not known.
    pub(super) const UNKNOWN: Self = Self { value: f64::NAN, error: f64::NAN };
}

/// What is known of an impact; times in the unit of the matrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Impact {
    /// The largest force \[N\].
    pub(super) force: Figure,
    /// When it is reached, where the force rises up to then, if it does, and falls behind.
    pub(super) top: Option<f64>,
    /// The largest deformation \[m\].
    pub(super) depth: Figure,
    /// When it is reached.
    pub(super) deepest_at: f64,
    /// When the force falls through zero.
    pub(super) release: Figure,
    /// The rate at which the deformation ends over that at which it began, with the sign turned.
    pub(super) restitution: Figure,
    /// `∫ F^n dt`.
    pub(super) power: Figure,
    /// `∫ F dt`.
    pub(super) impulse: Figure,
    /// `∫ F ẏ dt` \[J\].
    pub(super) work: Figure,
    /// The same up to the end of the run \[J\].
    pub(super) work_at_end: Figure,
    /// The force \[N\] over time, up to some time after the release.
    pub(super) course: Option<Signal>,
}
