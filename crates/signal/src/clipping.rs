//! What a record that is clipped leaves of each measure: a bound, where it is on the stretch that is clipped.

use dashpot_units::Dimension;

use crate::{Channel, Measure, Motion, Noise, Reading, Truth};

/// So many equal samples in a row are no chance.
pub(crate) const EQUAL: usize = 3;
/// Noise on the end of a range stays within so many of its standard deviations, and shows on so many samples.
const DEVIATIONS: f64 = 6.0;
const NOISY: usize = 6;
/// The part of its length behind which a clipped stretch has been left by so many times what it varies by: a top that is as
/// flat as a sixth power leaves its own by less.
const BESIDE: usize = 8;
const LEFT: f64 = 3.0;

/// First sample and length of each stretch in which neighbours are alike.
fn alike<'v>(
    values: &'v [f64],
    is_alike: impl Fn(&f64, &f64) -> bool + 'v,
) -> impl Iterator<Item = (usize, usize)> + 'v {
    values.chunk_by(is_alike).scan(0, |at, chunk| {
        let start = *at;
        *at += chunk.len();
        Some((start, chunk.len()))
    })
}

/// Runs of equal samples that no parabola explains whose values were rounded to the step in which they are written:
/// first sample and length. Within `n` samples it changes by less than a step, and from there to the neighbours by less
/// than `((n + 1)/(n − 1))²` of them, but for rounding.
pub(crate) fn runs(channel: &Channel) -> impl Iterator<Item = (usize, usize)> + '_ {
    let (values, step) = (channel.values(), channel.step());
    let equal = alike(values, |one, other| one.total_cmp(other).is_eq());
    equal.filter(move |&(start, length)| {
        let wider = (length + 1) as f64 / length.saturating_sub(1) as f64;
        let stands_out = |neighbour: Option<&f64>| {
            neighbour.is_none_or(|own| (own - values[start]).abs() > (1.0 + wider * wider) * step)
        };
        let before = start.checked_sub(1).and_then(|at| values.get(at));
        let is_part = length >= EQUAL && length < values.len();
        is_part && stands_out(before) && stands_out(values.get(start + length))
    })
}

/// Stretches that stay at the largest magnitude of a channel within its noise, and begin and end with a corner: first
/// sample and length.
fn plateaus(channel: &Channel) -> impl Iterator<Item = (usize, usize)> + '_ {
    let (values, peak) = (channel.values(), channel.largest().1);
    let band = DEVIATIONS * Noise::of(channel, None, None).deviation + channel.step();
    let is_top = move |own: &f64| own.abs() >= peak - band;
    let is_alike = move |one: &f64, other: &f64| is_top(one) == is_top(other) && one * other > 0.0;
    alike(values, is_alike).filter(move |&(start, length)| {
        let is_left = |at: Option<usize>| {
            let beside = at.and_then(|at| values.get(at));
            beside.is_some_and(|own| own.abs() < peak - (1.0 + LEFT) * band)
        };
        let reach = length.div_ceil(BESIDE);
        length >= NOISY
            && is_top(&values[start])
            && is_left(start.checked_sub(reach))
            && is_left(Some(start + length - 1 + reach))
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

/// The stretches \[s\] in which a record is at the end of the range of a sensor or amplifier: at its largest magnitude,
/// to the bit or within noise that was added behind it.
pub(crate) fn stretches(raw: &Channel) -> Vec<(f64, f64)> {
    let (times, peak) = (raw.times(), raw.largest().1);
    let equal: Vec<_> = runs(raw).filter(|own| raw.values()[own.0].abs() >= peak).collect();
    let all = if equal.is_empty() { plateaus(raw).collect() } else { equal };
    all.into_iter().map(|(start, length)| (times[start], times[start + length - 1])).collect()
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
