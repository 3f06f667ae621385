//! What a record that is clipped leaves of each measure: a bound, where it is on the stretch that is clipped.

use dashpot_units::Dimension;

use crate::{Channel, Measure, Motion, Reading, Reason};

/// So many equal samples in a row are no chance.
pub(crate) const EQUAL: usize = 3;
/// What stands out of equal samples by so many steps of resolution is no slope of a coarse curve.
const COARSE_STEPS: f64 = 4.0;

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

/// Runs of equal samples of which both neighbours differ by more than the resolution: first sample and length.
pub(crate) fn runs(channel: &Channel) -> impl Iterator<Item = (usize, usize)> + '_ {
    let values = channel.values();
    let slope = COARSE_STEPS * channel.resolution();
    let chunks = values.chunk_by(|one, other| one.total_cmp(other).is_eq());
    let starts = chunks.scan(0, |at, chunk| {
        let start = *at;
        *at += chunk.len();
        Some((start, chunk.len()))
    });
    starts.filter(move |&(start, length)| {
        let stands_out = |neighbour: Option<&f64>| {
            neighbour.is_none_or(|own| (own - values[start]).abs() > slope)
        };
        let before = start.checked_sub(1).and_then(|at| values.get(at));
        let is_part = length >= EQUAL && length < values.len();
        is_part && stands_out(before) && stands_out(values.get(start + length))
    })
}

/// How many rows of a record, by time and value, are clipped as by a sensor or amplifier at the end of its range.
pub fn clipped_rows(rows: &[(f64, f64)]) -> usize {
    let (times, values) = rows.iter().copied().unzip();
    let Ok(record) = Channel::new("", Dimension::NUMBER, times, values) else { return 0 };
    let stretches = stretches(&record);
    let is_clipped =
        |row: &&(f64, f64)| stretches.iter().any(|own| own.0 <= row.0 && row.0 <= own.1);
    rows.iter().filter(is_clipped).count()
}

/// The stretches \[s\] in which a record is at the end of the range of a sensor or amplifier: runs at its largest magnitude.
pub(crate) fn stretches(raw: &Channel) -> Vec<(f64, f64)> {
    let (times, peak) = (raw.times(), raw.largest().1);
    let all = runs(raw).filter(|own| raw.values()[own.0].abs() >= peak);
    all.map(|(start, length)| (times[start], times[start + length - 1])).collect()
}

/// What is clipped of a channel as it is read.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Clipping {
    /// No sample in a clipped stretch is smaller in magnitude; 0 behind a filter, which spreads what is missing.
    level: f64,
    /// When the first stretch begins \[s\]; before all behind a filter.
    from: f64,
    /// Whether samples are clipped above, and below.
    ends: [bool; 2],
}

impl Clipping {
    /// That of a channel with these stretches; `None` where none of them is read.
    pub(crate) fn of(
        channel: &Channel,
        stretches: &[(f64, f64)],
        is_filtered: bool,
    ) -> Option<Self> {
        let is_inside = |time: f64| stretches.iter().any(|own| own.0 <= time && time <= own.1);
        let all = channel.times().iter().zip(channel.values()).filter(|own| is_inside(*own.0));
        all.fold(None, |known, (time, value)| {
            let Self { level, from, ends } =
                known.unwrap_or(Self { level: f64::INFINITY, from: *time, ends: [false; 2] });
            let ends = [ends[0] || *value > 0.0, ends[1] || *value < 0.0];
            Some(Self { level: level.min(value.abs()), from, ends })
        })
        .map(|own| {
            if is_filtered { Self { level: 0.0, from: f64::NEG_INFINITY, ..own } } else { own }
        })
    }

    /// What is left of a reading. The true signal is further out by an unknown amount: whatever grows with that is at least
    /// what is read. The contact is above a part of the peak, and so at most as long. A body is slowed down by more, so that
    /// it turns earlier and comes back faster; where it turns, all of its energy is taken.
    pub(crate) fn left(&self, reading: Reading, motion: Option<(&Motion, f64)>) -> Reading {
        let is_before = reading.time.is_some_and(|time| time < self.from);
        let is_below = reading.value.is_ok_and(|value| value + reading.error < self.level);
        let turns = motion.is_some_and(|own| own.0.turns());
        let has_weight = motion.is_some_and(|own| own.1 != 0.0);
        let truth = match reading.measure {
            Measure::Clip3ms | Measure::Clip3msAtOnce if is_below => Truth::Within,
            Measure::Peak | Measure::SeverityIndex | Measure::Clip3ms | Measure::Clip3msAtOnce => {
                Truth::AtLeast
            }
            Measure::ContactTime => Truth::AtMost,
            _ if is_before => Truth::Within,
            _ if self.ends == [true; 2] => return reading.open(),
            Measure::VelocityChange | Measure::Impulse if self.ends[1] => Truth::AtMost,
            Measure::Displacement => Truth::AtMost,
            Measure::EnergyTaken if turns && !has_weight => Truth::Within,
            Measure::EnergyTaken | Measure::EnergyAbsorbed if turns => Truth::AtMost,
            Measure::EnergyTaken if !has_weight => Truth::AtLeast,
            Measure::EnergyTaken | Measure::EnergyAbsorbed => return reading.open(),
            _ => Truth::AtLeast,
        };
        reading.bounded(truth)
    }
}

impl Reading {
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
