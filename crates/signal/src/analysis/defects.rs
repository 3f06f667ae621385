//! What is wrong with a record, and what a reader of its numbers must know.

use dashpot_analysis::measures::STANDARD_GRAVITY;
use dashpot_units::{Dimension, percent, quantity, si_unit};
use thiserror::Error;

use super::{Analysis, Removal};
use crate::{
    Axis, CONTACT_LEVEL, Cfc, Channel, Measure, Motion, Offset, Part, Truth,
    clipping::{EQUAL, runs},
    offset::{IMPACT, IN_A_ROW},
};

/// Shares of the peak: an offset, a rest behind the pulse, a resolution, a sample out of line.
const OFFSET_SHARE: f64 = 0.001;
const REST_SHARE: f64 = 0.02;
const RESOLUTION_SHARE: f64 = 0.01;
const SPIKE_SHARE: f64 = 0.3;
/// A pulse of fewer samples is hardly seen.
const FEW: usize = 10;
/// Peaks of accelerations and lengths of pulses that impact tests have.
const ACCELERATIONS: (f64, f64) = (0.5 * STANDARD_GRAVITY, 2e4 * STANDARD_GRAVITY);
const LENGTHS: (f64, f64) = (2e-5, 2.0);
/// The standards want a sampling rate of so many times the class of a filter.
const LEAST_RATE: f64 = 10.0;
/// Rounding of an energy, in parts of it.
const ROUNDING: f64 = 1e-9;
/// Digits of numbers in messages.
const DIGITS: usize = 3;

dashpot_units::words! {
    /// What is wrong with a channel, or with how it is read. Values are in SI units, times in s.
    #[derive(Debug, Clone, Copy, PartialEq, Error)]
    #[non_exhaustive]
    #[expect(missing_docs, reason = "the messages say what the fields are")]
    pub enum Defect, pub fn code(&self) {
        /// Every sample is the same.
        #[error("every sample is {}: nothing was measured", shown(*.value, *.unit))]
        Flat { value: f64, unit: Dimension } = "flat",
        /// A reading at rest that is not taken off.
        #[error(
            "reads {}{} at rest before the pulse ({} of the peak), which is not taken off: `--offset auto`",
            shown(*.value, *.unit),
            .error.map_or(String::new(), |error| format!(" ± {}", shown(error, *.unit))),
            percent(*.share, 2)
        )]
        Offset { value: f64, error: Option<f64>, share: f64, unit: Dimension } = "offset",
        /// A record in which no rest before the pulse tells the zero, and that does not read zero behind it, or at both its ends.
        #[error(
            "no rest before its pulse tells its zero, and {level} is read where it ends ({part} of the peak): it may be \
             off by that, which the errors hold; record some ms before the impact, or say what to take off, \
             `--offset \"{level}\"`",
            level = shown(*.value, *.unit), part = percent(*.share, 2)
        )]
        UnknownZero { value: f64, error: f64, share: f64, unit: Dimension } = "unknown-zero",
        /// A reading at rest that changes, before the pulse or from before it to behind it.
        #[error(
            "its reading at rest drifts by {} ({} of the peak): integrals over it are wrong",
            shown(*.change, *.unit), percent(*.share, 2)
        )]
        Drift { change: f64, share: f64, unit: Dimension } = "drift",
        /// A record that reads the other way at the end of its pulse, and comes back as behind a high-pass.
        #[error(
            "reads {} at the end of its pulse ({} of the peak) and comes back to zero as an AC-coupled sensor does, or a \
             body that is braked: the errors hold that; record with a DC-coupled sensor",
            shown(*.value, *.unit), percent(*.share, 2)
        )]
        Sag { value: f64, share: f64, unit: Dimension } = "sag",
        /// The end of the range of a sensor or amplifier; of a resultant that of one of its axes.
        #[error(
            "{}is clipped at {}: {samples} equal samples at its largest value, from {} on; what depends on them is \
             a bound",
            .axis.map_or(String::new(), |axis| format!("its axis {} ", axis.letter())),
            shown(*.level, *.unit), seconds(*.time)
        )]
        Clipped { axis: Option<Axis>, level: f64, samples: usize, time: f64, unit: Dimension } = "clipped",
        /// The same value again and again within the pulse.
        #[error(
            "holds one value for {samples} samples within the pulse, from {} on: samples were dropped", seconds(*.time)
        )]
        Held { samples: usize, time: f64 } = "held",
        /// Steps in which samples are missing.
        #[error(
            "samples are missing in {gaps} {}, the first one at {}; the longest is {} beside steps of {}",
            if *.gaps == 1 { "place" } else { "places" }, seconds(*.time), seconds(*.longest), seconds(*.usual)
        )]
        Dropped { gaps: usize, time: f64, longest: f64, usual: f64 } = "dropped-samples",
        /// Single samples out of line.
        #[error(
            "{count} {} out of line with both neighbours, the first one at {}",
            if *.count == 1 { "sample is" } else { "samples are" }, seconds(*.time)
        )]
        Spikes { count: usize, time: f64 } = "spikes",
        /// Steps that differ.
        #[error(
            "its steps are uneven, from {} to {}; a line between samples takes them as they are",
            seconds(.range.0), seconds(.range.1)
        )]
        UnevenSteps { range: (f64, f64) } = "uneven-steps",
        /// A resolution that is coarse beside the peak.
        #[error("its values come in steps of {}, {} of the peak", shown(*.step, *.unit), percent(*.share, 2))]
        Coarse { step: f64, share: f64, unit: Dimension } = "coarse",
        /// A pulse of few samples.
        #[error("its pulse has {samples} samples: the sampling rate is too low")]
        FewSamples { samples: usize } = "few-samples",
        /// A record that begins or ends within the pulse.
        #[error("the record begins or ends within the pulse: its numbers are those of a part")]
        Cut = "cut",
        /// Another impact than the one with the peak.
        #[error(
            "holds another impact, of {} at {}: severity index, clips and integrals are those of both, the contact time \
             is that of the larger one; `--from` and `--to` read one alone",
            shown(*.value, *.unit), seconds(*.time)
        )]
        SecondImpact { value: f64, time: f64, unit: Dimension } = "second-impact",
        /// A filter that smears the pulse beyond an end of the record, so that what stood there counts.
        #[error(
            "begins or ends where its filter still smears the pulse: samples change by {} with what stood beyond, which \
             the errors hold (record some ms of rest)",
            shown(*.change, *.unit)
        )]
        SmearedBeyond { change: f64, unit: Dimension } = "smeared-beyond",
        /// A sampling rate below ten times the class of the filter.
        #[error(
            "is sampled at {}, and CFC {class} wants at least {} (SAE J211-1)",
            quantity(*.rate, "Hz", DIGITS), quantity(*.least, "Hz", DIGITS)
        )]
        SlowForClass { rate: f64, class: f64, least: f64 } = "slow-for-class",
        /// A class that the standards do not name.
        #[error("CFC {class} is none of the classes 60, 180, 600 and 1000 of SAE J211-1")]
        OddClass { class: f64 } = "odd-class",
        /// A peak that no impact test has: the unit may be another.
        #[error("a peak of {} is not that of an impact: is the unit right?", shown(*.peak, Dimension::ACCELERATION))]
        OddPeak { peak: f64 } = "odd-peak",
        /// A length of a pulse that no impact test has: the unit of time may be another.
        #[error("a pulse of {} is not that of an impact: is the unit of time right?", seconds(*.length))]
        OddLength { length: f64 } = "odd-length",
        /// A body that comes back faster than it came, or from which more energy comes than was taken.
        #[error(
            "{}, which no impact does: what is integrated is a magnitude or has the wrong sign, or the impact begins \
             elsewhere or at another velocity",
            .restitution.map_or("gives back more energy than it takes".to_owned(), |own| format!(
                "comes back with {} times the velocity with which it came", dashpot_units::significant(own, DIGITS)
            ))
        )]
        GainsEnergy { restitution: Option<f64> } = "gains-energy",
        /// A body that still moves in when the pulse is over.
        #[error(
            "does not stop: it still moves in at {} when the {} is over: the record, its unit or the velocity is wrong",
            quantity(*.velocity, "m/s", DIGITS), if *.is_cut { "record" } else { "pulse" }
        )]
        DoesNotStop { velocity: f64, is_cut: bool } = "does-not-stop",
        /// An axis beside others that went through another filter class, so that they have no resultant.
        #[error(
            "went through another filter class than other axes of its location, and is no part of their resultant"
        )]
        OtherFilter = "other-filter",
        /// Axes of a location one of which has two channels, so that it is not clear which one is part of the resultant.
        #[error(
            "is an axis, or beside one, that has two channels: no resultant is formed; `--channel` names one of \
             each axis"
        )]
        AxisTwice = "axis-twice",
        /// An axis whose times, or whose peak, are not within those of the others.
        #[error(
            "was not recorded at the times at which the other axes of its location were: no resultant is formed"
        )]
        AxesApart = "axes-apart",
    }
}

fn seconds(time: f64) -> String {
    quantity(time, "s", DIGITS)
}

/// A value as the field writes it: accelerations in g.
fn shown(value: f64, unit: Dimension) -> String {
    if unit == Dimension::ACCELERATION {
        return format!("{} g", dashpot_units::significant(value / STANDARD_GRAVITY, DIGITS));
    }
    quantity(value, &si_unit(unit), DIGITS)
}

/// What is wrong with a channel that was read.
pub(crate) fn defects(own: &Analysis) -> Vec<Defect> {
    let peak = own.channel.largest().1;
    let unit = own.raw.dimension();
    let first = own.raw.values()[0];
    if own.raw.values().iter().all(|value| value.total_cmp(&first).is_eq()) {
        return vec![Defect::Flat { value: first, unit }];
    }
    let mut all = Vec::new();
    all.extend(clipped(own, unit));
    all.extend(held(own));
    all.extend(dropped(own));
    all.extend(spikes(&own.raw));
    if own.contact.is_cut {
        all.push(Defect::Cut);
    }
    if own.beyond > 0.0 {
        all.push(Defect::SmearedBeyond { change: own.beyond, unit });
    }
    all.extend(second(own, unit));
    all.extend(offset(own, peak, unit));
    all.extend(drift(own, peak, unit));
    all.extend(sag(own, peak, unit));
    let step = own.raw.resolution();
    let share = step / own.raw.largest().1;
    if share > RESOLUTION_SHARE {
        all.push(Defect::Coarse { step, share, unit });
    }
    all.extend(of_pulse(own, peak, unit));
    all.extend(of_filter(own));
    all.extend(gain(own));
    // What is clipped would slow it down by more.
    let onward = own.motion.as_ref().filter(|_| own.clipped.is_empty()).and_then(Motion::onward);
    let is_cut = own.contact.is_cut;
    all.extend(onward.map(|velocity| Defect::DoesNotStop { velocity, is_cut }));
    all
}

/// An impact apart from that with the peak: beyond a tenth of it, where nothing was beyond what counts as contact for half of
/// the length of the contact in between.
fn second(own: &Analysis, unit: Dimension) -> Option<Defect> {
    if !matches!(unit, Dimension::ACCELERATION | Dimension::FORCE) {
        return None;
    }
    let (times, values) = (own.channel.times(), own.channel.values());
    let (peak, contact) = (own.channel.largest().1, own.contact);
    let value = |at: usize| (values[at] - own.uncertainty.rest).abs();
    let least = (IMPACT * peak).max(own.uncertainty.noise.extreme(values.len()));
    let first = times.partition_point(|time| *time < contact.window.0);
    let last = times.partition_point(|time| *time <= contact.window.1);
    let apart = |all: &mut dyn Iterator<Item = usize>, end: f64| {
        let (mut since, mut pause, mut row) = (end, 0.0_f64, 0);
        for at in all {
            if value(at) >= CONTACT_LEVEL * peak {
                since = times[at];
            }
            pause = pause.max((times[at] - since).abs());
            row = if value(at) > least { row + 1 } else { 0 };
            if row == IN_A_ROW && pause > 0.5 * contact.length() {
                return Some(at);
            }
        }
        None
    };
    let found = apart(&mut (0..first).rev(), contact.window.0)
        .or_else(|| apart(&mut (last..times.len()), contact.window.1))?;
    let beyond = |at: &usize| value(*at) > least;
    let all = (found..times.len()).take_while(beyond).chain((0..found).rev().take_while(beyond));
    let top = all.max_by(|one, other| value(*one).total_cmp(&value(*other)))?;
    Some(Defect::SecondImpact { value: values[top].abs(), time: times[top], unit })
}

/// Energy that an impact would have made.
pub(crate) fn gain(own: &Analysis) -> Option<Defect> {
    let beyond = |measure: Measure, sign: f64| {
        let reading = own.reading(measure)?;
        let value = reading.value.ok().filter(|_| reading.truth == Truth::Within)?;
        Some((value, sign * value - reading.error))
    };
    let restitution = beyond(Measure::Restitution, 1.0).filter(|own| own.1 > 1.0 + ROUNDING);
    let restitution = restitution.map(|own| own.0);
    let absorbed = beyond(Measure::EnergyAbsorbed, -1.0);
    let taken = own.reading(Measure::EnergyTaken).and_then(|own| own.value.ok()).unwrap_or(0.0);
    let is_gain = absorbed.is_some_and(|own| own.1 > ROUNDING * taken.abs());
    (is_gain || restitution.is_some()).then_some(Defect::GainsEnergy { restitution })
}

/// What is clipped of a channel of its own, or of the axes of a resultant.
fn clipped(own: &Analysis, unit: Dimension) -> Option<Defect> {
    let is_recorded = !matches!(own.part, Part::Resultant { .. });
    let (from, _) = *own.clipped.first().filter(|_| is_recorded)?;
    let times = own.raw.times();
    let count = |(from, to): &(f64, f64)| {
        times.partition_point(|time| time <= to) - times.partition_point(|time| time < from)
    };
    let samples = own.clipped.iter().map(count).sum();
    Some(Defect::Clipped { axis: None, level: own.raw.value(from), samples, time: from, unit })
}

fn held(own: &Analysis) -> Option<Defect> {
    let (times, values) = (own.raw.times(), own.raw.values());
    let peak = own.raw.largest().1;
    let (from, to) = own.contact.window;
    let (start, samples) = runs(&own.raw).find(|&(start, length)| {
        values[start].abs() < peak && times[start] > from && times[start + length - 1] < to
    })?;
    Some(Defect::Held { samples, time: times[start] })
}

fn dropped(own: &Analysis) -> Option<Defect> {
    let steps = own.steps;
    if steps.gaps == 0 {
        let is_read = own.settings.rate.is_none() && !steps.are_even;
        return is_read.then_some(Defect::UnevenSteps { range: steps.range });
    }
    let times = own.raw.times();
    let mut all: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let unsorted = all.clone();
    all.sort_by(f64::total_cmp);
    let usual = all[all.len() / 2];
    let first = unsorted.iter().position(|step| *step > 1.5 * usual)?;
    Some(Defect::Dropped { gaps: steps.gaps, time: times[first], longest: steps.range.1, usual })
}

fn spikes(channel: &Channel) -> Option<Defect> {
    let values = channel.values();
    let peak = channel.largest().1;
    let is_one = |at: &usize| {
        let [one, own, other] = [values[at - 1], values[*at], values[at + 1]];
        (own - 0.5 * (one + other)).abs() > SPIKE_SHARE * peak
            && (other - one).abs() < 0.3 * SPIKE_SHARE * peak
    };
    let mut all = (1..values.len() - 1).filter(is_one).peekable();
    let first = *all.peek()?;
    Some(Defect::Spikes { count: all.count(), time: channel.times()[first] })
}

fn offset(own: &Analysis, peak: f64, unit: Dimension) -> Option<Defect> {
    if let Some(Offset { value, error, .. }) = own.behind {
        let share = value.abs() / peak;
        let own = Defect::UnknownZero { value, error, share, unit };
        return (share > OFFSET_SHARE).then_some(own);
    }
    let rest = own.offset.filter(|_| own.settings.offset == Removal::Nothing)?;
    let share = rest.value.abs() / peak;
    (rest.is_there() && share > OFFSET_SHARE).then_some(Defect::Offset {
        value: rest.value,
        error: rest.uncertainty(),
        share,
        unit,
    })
}

/// The change of the reading at rest before the pulse, or to what is read in the last fiftieth of the record, where
/// that lies far behind the pulse.
fn drift(own: &Analysis, peak: f64, unit: Dimension) -> Option<Defect> {
    let rest = own.offset?;
    let change = 0.5 * rest.drift * (rest.window.1 - rest.window.0);
    let (times, values) = (own.raw.times(), own.raw.values());
    let last = values.len() - (values.len() / 50).max(EQUAL);
    let behind = values[last..].iter().sum::<f64>() / (values.len() - last) as f64;
    let is_far = times[last] > own.contact.window.1 + 2.0 * own.contact.length();
    let to_end = if is_far { behind - rest.value } else { 0.0 };
    let change = if rest.is_drifting && change.abs() > to_end.abs() { change } else { to_end };
    let is_one = change.abs() > REST_SHARE * peak && change.abs() > 5.0 * rest.noise
        || rest.is_drifting && change.abs() > OFFSET_SHARE * peak;
    is_one.then_some(Defect::Drift { change, share: change.abs() / peak, unit })
}

fn sag(own: &Analysis, peak: f64, unit: Dimension) -> Option<Defect> {
    let value = own.sag?;
    let share = value.abs() / peak;
    (share > OFFSET_SHARE).then_some(Defect::Sag { value, share, unit })
}

fn of_pulse(own: &Analysis, peak: f64, unit: Dimension) -> Vec<Defect> {
    let mut all = Vec::new();
    let (from, to) = own.contact.window;
    let inside = |time: &&f64| **time >= from && **time <= to;
    let samples = own.raw.times().iter().filter(inside).count();
    if samples < FEW && !own.contact.is_cut {
        all.push(Defect::FewSamples { samples });
    }
    let is_odd = |range: (f64, f64), value: f64| !(range.0..=range.1).contains(&value);
    if unit == Dimension::ACCELERATION && is_odd(ACCELERATIONS, peak) {
        all.push(Defect::OddPeak { peak });
    }
    if is_odd(LENGTHS, own.contact.length()) {
        all.push(Defect::OddLength { length: own.contact.length() });
    }
    all
}

fn of_filter(own: &Analysis) -> Vec<Defect> {
    let Some(cfc) = own.settings.cfc else { return Vec::new() };
    let (rate, class, least) = (own.rate(), cfc.class(), LEAST_RATE * cfc.class());
    let mut all = Vec::new();
    if rate < least * (1.0 - 1e-6) {
        all.push(Defect::SlowForClass { rate, class, least });
    }
    if !Cfc::STANDARD.iter().any(|own| (own - class).abs() < 1e-9 * own) {
        all.push(Defect::OddClass { class });
    }
    all
}
