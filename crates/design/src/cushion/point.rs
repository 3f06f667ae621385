//! A drop, and how far it is known.

dashpot_units::words! {
    /// How far a point is known.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Known, pub fn word(self) {
        /// All of it is within what is known of the cushion.
        Whole = "whole",
        /// The cushion meets its stop.
        OnStop = "on-stop",
        /// Masses meet, as on a rigid stop, so that the peak is infinite.
        Infinite = "infinite",
        /// A measured law is followed beyond its last point.
        BeyondLaw = "beyond-law",
        /// The cushion is pressed by more than its thickness.
        PressedThrough = "pressed-through",
        /// The drop could not be solved.
        Unsolved = "unsolved",
    }
}

impl Known {
    /// Whether the peak may be used: a stop is a part of the scene, what lies beyond a law or a thickness is not.
    pub fn is_usable(self) -> bool {
        matches!(self, Self::Whole | Self::OnStop)
    }
}

/// A drop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CushionPoint {
    /// Static stress \[Pa\].
    pub stress: f64,
    /// Peak acceleration \[m/s²\]; not a number where it could not be solved, or is infinite.
    pub peak: f64,
    /// Its error \[m/s²\]; not a number where it is not known.
    pub error: f64,
    /// The largest deformation in parts of the thickness.
    pub strain: f64,
    /// How far it is known.
    pub known: Known,
}

impl CushionPoint {
    /// Whether its peak may be used.
    pub fn is_usable(&self) -> bool {
        self.known.is_usable() && self.peak.is_finite()
    }

    /// Whether it certainly keeps a limit \[m/s²\].
    pub fn keeps(&self, limit: f64) -> bool {
        self.excess(limit) <= 0.0
    }

    /// By how much it may exceed a limit \[m/s²\]: zero or less where it certainly keeps it, infinite where its peak
    /// cannot be used.
    pub(super) fn excess(&self, limit: f64) -> f64 {
        let error = if self.error.is_finite() { self.error } else { 0.0 };
        if self.is_usable() { self.peak + error - limit } else { f64::INFINITY }
    }
}

/// How far a drop is known that strains the cushion by so much, with the strain of its stop.
pub(super) fn known(
    (peak, is_infinite): (f64, bool),
    strain: f64,
    stop: Option<f64>,
    is_beyond: bool,
) -> Known {
    if is_infinite {
        Known::Infinite
    } else if peak.is_nan() {
        Known::Unsolved
    } else if is_beyond && strain >= 1.0 {
        Known::PressedThrough
    } else if is_beyond {
        Known::BeyondLaw
    } else if stop.is_some_and(|stop| strain > stop) {
        Known::OnStop
    } else {
        Known::Whole
    }
}
