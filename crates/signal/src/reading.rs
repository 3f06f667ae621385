//! What is read off a channel: which measure, its value, and what that says of the truth.

use dashpot_units::Dimension;
use thiserror::Error;

/// What a value says of the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Truth {
    /// The truth is no further from it than its error.
    #[default]
    Within,
    /// The truth is at least as large, and how large is not known.
    AtLeast,
    /// The truth is at most as large.
    AtMost,
}

impl Truth {
    /// Its word: `at-least` or `at-most`; `None` of a value with an error.
    pub fn word(self) -> Option<&'static str> {
        match self {
            Self::Within => None,
            Self::AtLeast => Some("at-least"),
            Self::AtMost => Some("at-most"),
        }
    }
}

dashpot_units::words! {
    /// What is read off a channel.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Measure, pub fn word(self) {
        /// The largest magnitude.
        Peak = "peak",
        /// How long the magnitude stays at or above 5 % of the peak, about the peak \[s\].
        ContactTime = "contact-time",
        /// The integral of an acceleration over the whole record \[m/s\].
        VelocityChange = "velocity-change",
        /// The integral of a force over the whole record \[N s\].
        Impulse = "impulse",
        /// Head injury criterion over intervals up to 15 ms \[s\].
        Hic15 = "hic15",
        /// The same up to 36 ms.
        Hic36 = "hic36",
        /// The same over any interval.
        Hic = "hic",
        /// Gadd's severity index, `∫ (|a|/g0)^2.5 dt` \[s\].
        SeverityIndex = "severity-index",
        /// The largest magnitude that is exceeded for 3 ms, all times added up.
        Clip3ms = "clip-3ms",
        /// The same within one stretch.
        Clip3msAtOnce = "clip-3ms-at-once",
        /// The largest displacement since the impact began \[m\].
        Displacement = "peak-displacement",
        /// The speed at which a body comes back \[m/s\].
        ReboundVelocity = "rebound-velocity",
        /// The part of the speed of approach with which it comes back.
        Restitution = "coefficient-of-restitution",
        /// The work done until the deepest point \[J\].
        EnergyTaken = "energy-taken",
        /// What comes back of it \[J\].
        EnergyReturned = "energy-returned",
        /// What does not \[J\].
        EnergyAbsorbed = "energy-absorbed",
    }
}

dashpot_units::words! {
    /// Why a measure has no value.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
    pub enum Reason, pub fn code(self) {
        /// The record is shorter than the time of a clip.
        #[error("the record is too short")]
        RecordTooShort = "record-too-short",
        /// It is clipped, and nothing bounds it.
        #[error("clipped, which leaves it open")]
        Clipped = "clipped",
        /// The body does not stop, so that it does not come back.
        #[error("the body does not stop")]
        DoesNotStop = "does-not-stop",
    }
}

/// A number read off a channel, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// What it is.
    pub measure: Measure,
    /// The value, on straight lines between samples and over continuous windows.
    pub value: Result<f64, Reason>,
    /// What it says of the truth.
    pub truth: Truth,
    /// How far it may be off: by what samples do not tell, by the offset, by the resolution, by noise; 0 of a bound.
    pub error: f64,
    /// When it is \[s\], where it is at one time.
    pub time: Option<f64>,
    /// From when to when it is \[s\], where it belongs to an interval.
    pub window: Option<(f64, f64)>,
    /// The value by the samples alone: windows from sample to sample, sums of trapezoids; `None` where it is the same.
    pub on_samples: Option<f64>,
}

impl Reading {
    pub(crate) fn new(measure: Measure, value: f64, error: f64) -> Self {
        let (value, truth) = (Ok(value), Truth::Within);
        Self { measure, value, truth, error, time: None, window: None, on_samples: None }
    }

    /// Its error, where it has a value that is no bound.
    pub fn bar(&self) -> Option<f64> {
        self.value.ok().filter(|_| self.truth == Truth::Within).map(|_| self.error)
    }

    pub(crate) fn over(self, window: (f64, f64)) -> Self {
        Self { window: Some(window), ..self }
    }

    /// The bound that the value and its error leave, at no time and in no window.
    pub(crate) fn bounded(self, truth: Truth) -> Self {
        let value = self.value.map(|value| match truth {
            Truth::Within => value,
            Truth::AtLeast if value >= 0.0 => (value - self.error).max(0.0),
            Truth::AtLeast => value - self.error,
            Truth::AtMost => value + self.error,
        });
        match truth {
            Truth::Within => self,
            _ => Self { value, truth, ..Self::new(self.measure, 0.0, 0.0) },
        }
    }

    /// The same where no bound is left.
    pub(crate) fn open(self) -> Self {
        Self { value: Err(Reason::Clipped), ..Self::new(self.measure, 0.0, 0.0) }
    }
}

impl Measure {
    const READ: [Self; 10] = [
        Self::Peak,
        Self::ContactTime,
        Self::VelocityChange,
        Self::Impulse,
        Self::Hic15,
        Self::Hic36,
        Self::Hic,
        Self::SeverityIndex,
        Self::Clip3ms,
        Self::Clip3msAtOnce,
    ];

    /// The measures of every channel of this dimension; those of motion and work depend on what is known besides.
    pub fn of(dimension: Dimension) -> impl Iterator<Item = Self> {
        let is_one = move |own: &Self| match own {
            Self::Peak | Self::ContactTime => true,
            Self::Impulse => dimension == Dimension::FORCE,
            _ => dimension == Dimension::ACCELERATION,
        };
        Self::READ.into_iter().filter(is_one)
    }

    /// What it is in, of a channel of this dimension.
    pub fn dimension(self, channel: Dimension) -> Dimension {
        match self {
            Self::Peak | Self::Clip3ms | Self::Clip3msAtOnce => channel,
            Self::VelocityChange | Self::ReboundVelocity => Dimension::VELOCITY,
            Self::Displacement => Dimension::LENGTH,
            Self::Restitution => Dimension::NUMBER,
            Self::EnergyTaken | Self::EnergyReturned | Self::EnergyAbsorbed => Dimension::ENERGY,
            Self::Impulse => Dimension::IMPULSE,
            _ => Dimension::TIME,
        }
    }

    /// Whether it is an index that the field writes without a unit.
    pub fn is_index(self) -> bool {
        matches!(self, Self::Hic | Self::Hic15 | Self::Hic36 | Self::SeverityIndex)
    }

    /// Whether a magnitude has it, which has no direction to be added up along.
    pub(crate) fn is_of_magnitudes(self) -> bool {
        !matches!(self, Self::VelocityChange | Self::Impulse)
    }

    /// Whether that of a body is the one of the resultant of its axes, which no axis alone exceeds: peak, HIC, severity
    /// index and clips of an acceleration.
    pub fn is_of_body(self, channel: Dimension) -> bool {
        let is_clip = matches!(self, Self::Peak | Self::Clip3ms | Self::Clip3msAtOnce);
        channel == Dimension::ACCELERATION && (is_clip || self.is_index())
    }

    /// The longest window of a head injury criterion \[s\].
    pub(crate) fn cap(self) -> f64 {
        match self {
            Self::Hic15 => 0.015,
            Self::Hic36 => 0.036,
            _ => f64::INFINITY,
        }
    }
}
