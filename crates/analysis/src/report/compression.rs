//! How far something of known thickness is pressed in.

use dashpot_dae::Signal;

/// Closure in parts of the energy turned over, and deformation in parts of a thickness, that rounding may leave.
pub(crate) const ROUNDING: f64 = 1e-10;

/// Two thicknesses that differ by less, in parts of themselves, are one.
const SAME: f64 = 1e-9;

/// Whether a part of a pad is as thick as the whole: then it lies between the same ends.
pub(crate) fn is_as_thick(part: f64, whole: f64) -> bool {
    part >= (1.0 - SAME) * whole
}

/// The largest deformation of something of known thickness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compression {
    /// How far it is pressed in \[m\].
    pub deepest: f64,
    /// When \[s\].
    pub time: f64,
    /// Its thickness \[m\].
    pub thickness: f64,
    /// Part of that below which the depth is not known \[1\], at least that of rounding.
    noise: f64,
}

impl Compression {
    /// Of a depth with its absolute error \[m\], if that is known.
    pub(crate) fn new([deepest, time]: [f64; 2], error: Option<f64>, thickness: f64) -> Self {
        let noise = ROUNDING.max(error.unwrap_or(0.0) / thickness);
        Self { deepest, time, thickness, noise }
    }

    /// The largest within a window \[s\].
    pub(crate) fn of(deformation: &Signal, window: (f64, f64), thickness: f64) -> Self {
        let deepest = deformation.maximum(window);
        Self::new([deepest.value, deepest.time], deformation.error, thickness)
    }

    /// What is left of the thickness \[m\], below zero where it is pressed further.
    pub fn left(&self) -> f64 {
        self.thickness - self.deepest
    }

    /// The depth in parts of the thickness \[1\].
    pub fn strain(&self) -> f64 {
        self.deepest / self.thickness
    }

    /// Whether it is pressed in by more than its thickness, beyond the error.
    pub fn is_through(&self) -> bool {
        self.strain() > 1.0 + self.noise
    }
}
