//! Channels in words.

use dashpot_analysis::{Bound, Judgement, Reason, measures::STANDARD_GRAVITY};
use dashpot_network::parameters::Dimension;
use dashpot_report::Table;
use dashpot_signal::{
    Analysis, Axis, CONTACT_LEVEL, Channel, Measure, Part, Reading, Repeated, Truth,
};
use dashpot_units::si_unit;

use super::{Group, Signal, Signals, limits::Verdict};
use crate::list;
use dashpot_report::numbers::{
    MOST_DIGITS, Unit, bound, digits, percent_signed, quantity, share, significant,
};

/// Digits of times and rates.
const DIGITS: usize = 4;
/// Noise below this part of the peak is not mentioned.
const UNSEEN: f64 = 1e-5;
/// Rounding of a bound, in parts of its last digit.
const ROUNDING: f64 = 1e-6;
/// Digits of errors.
const ERROR_DIGITS: usize = 1;

/// The unit of a quantity of about this value: accelerations are in g.
pub(super) fn unit(value: f64, dimension: Dimension) -> Unit {
    if dimension == Dimension::ACCELERATION {
        return Unit::new("g", STANDARD_GRAVITY);
    }
    Unit::suiting(value, &si_unit(dimension))
}

/// The unit in which a measure of about this value is shown; `channel` is what the channel measures.
pub fn unit_of(measure: Measure, value: f64, channel: Dimension) -> Unit {
    if measure.is_index() { Unit::plain("1") } else { unit(value, measure.dimension(channel)) }
}

/// What is wrong, each with the channel.
pub(super) fn warnings(signals: &Signals) -> Vec<String> {
    let of = |own: &Signal| {
        let place = format!("{}, {}", own.file, own.analysis.channel.name());
        let all = own.analysis.defects.iter();
        all.map(move |defect| format!("{place}: {defect}")).collect::<Vec<_>>()
    };
    signals.all.iter().flat_map(of).collect()
}

/// Mean and scatter of several tests.
pub(super) fn repeats(group: &Group<'_>) -> Table {
    let tests = group.analyses();
    let dimension = tests.first().map_or(Dimension::NUMBER, |own| own.channel.dimension());
    let row = |own: Repeated| {
        let unit = unit_of(own.measure, own.mean, dimension);
        let shown = |value: f64| unit.number(value, DIGITS);
        vec![
            own.measure.word().to_owned(),
            shown(own.mean),
            unit.number(own.deviation, 2),
            own.variation().map_or(String::new(), share),
            shown(own.range.0),
            shown(own.range.1),
            unit.number(own.repeatability(), 2),
            unit.symbol.clone(),
        ]
    };
    let header = ["measure", "mean", "std dev", "of it", "least", "most", "repeatability", "unit"];
    let caption = format!("{}: {} tests", group.name, tests.len());
    Table::new(caption, &header, Repeated::of(&tests).into_iter().map(row))
}

pub(super) fn heading(own: &Signal) -> String {
    let (channel, steps) = (&own.analysis.channel, own.analysis.steps);
    let (start, end) = channel.span();
    format!(
        "{}: {}, {} samples at {}, {} to {}",
        own.file,
        channel.name(),
        own.analysis.raw.times().len(),
        quantity(steps.rate, "Hz", DIGITS),
        quantity(start, "s", DIGITS),
        quantity(end, "s", DIGITS),
    )
}

/// Which way the peak of a channel points.
pub(super) fn polarity(channel: &Channel) -> &'static str {
    if channel.sign() < 0.0 { "negative" } else { "positive" }
}

/// What was done with a channel.
pub(super) fn treatment(own: &Analysis) -> Vec<String> {
    let contact = format!("contact is where it exceeds {} of its peak", share(CONTACT_LEVEL));
    if let Part::Resultant { of, .. } = &own.part {
        let names: Vec<&str> = of.iter().map(|own| &*own.1).collect();
        return vec![format!("magnitude of {}, as they are read", names.join(", ")), contact];
    }
    let dimension = own.channel.dimension();
    let value = |value: f64, digits: usize| unit(value, dimension).text(value, digits);
    let rest = own.offset.map(|offset| {
        let shown = digits(offset.value, Some(offset.error), DIGITS);
        let (from, to) = offset.window;
        let error = offset.uncertainty();
        let error = error.map(|own| format!(" ± {}", value(own, ERROR_DIGITS)));
        format!(
            "{}{} at rest from {} to {}",
            value(offset.value, shown),
            error.unwrap_or_default(),
            quantity(from, "s", DIGITS),
            quantity(to, "s", DIGITS)
        )
    });
    let offset = match (own.removed, rest) {
        (None, Some(rest)) => format!("reads {rest}; no offset taken off"),
        (None, None) => "no offset taken off: nothing is at rest before the pulse".to_owned(),
        (Some(removed), Some(rest)) => {
            format!("{} taken off; reads {rest}", value(removed, DIGITS))
        }
        (Some(removed), None) => format!("{} taken off", value(removed, DIGITS)),
    };
    let filter = match own.settings.cfc {
        None => "not filtered".to_owned(),
        Some(cfc) => {
            let decibels = |frequency: f64| {
                let gain = 20.0 * cfc.gain(frequency, own.rate()).log10();
                format!("{} dB at {}", significant(gain, 3), quantity(frequency, "Hz", DIGITS))
            };
            format!(
                "CFC {}: {}, {}, sampled at {}; beyond its ends: {}",
                cfc.class(),
                decibels(cfc.class()),
                decibels(cfc.design_frequency()),
                quantity(own.rate(), "Hz", DIGITS),
                own.settings.padding.words()[0]
            )
        }
    };
    let turned = if own.settings.is_inverted { ", after its signs were turned" } else { "" };
    let polarity = format!("its peak is {}{turned}", polarity(&own.channel));
    let noise = own.uncertainty.noise;
    let from = if noise.is_of_rest { "at rest" } else { "of its fourth differences" };
    let deviation = value(noise.deviation, 2);
    let noise = (noise.deviation > UNSEEN * own.channel.largest().1)
        .then(|| format!("noise of {deviation} ({from}), which is part of every error"));
    [filter, offset].into_iter().chain(noise).chain([polarity, contact]).collect()
}

/// All that was read off a channel.
pub(super) fn table(own: &Analysis) -> Table {
    let dimension = own.channel.dimension();
    let row = |reading: &Reading| {
        let word = reading.measure.word().to_owned();
        let value = match reading.value {
            Ok(value) => value,
            Err(reason) => {
                let [one, two, three] = [const { String::new() }; 3];
                return vec![word, "–".to_owned(), one, two, three, reason.to_string()];
            }
        };
        let unit = unit_of(reading.measure, value, dimension);
        let (shown, error) = shown(reading, value, &unit);
        let digits = digits(value, Some(reading.error), MOST_DIGITS);
        let on_samples = reading.on_samples.map_or(String::new(), |own| unit.number(own, digits));
        vec![word, shown, error, unit.symbol.clone(), on_samples, when(reading)]
    };
    let header = ["measure", "value", "error", "unit", "samples", "when"];
    Table::new("", &header, own.readings.iter().map(row))
}

/// Value and error of a reading in a unit, or a bound and its word.
pub fn shown(reading: &Reading, value: f64, unit: &Unit) -> (String, String) {
    match reading.truth.word() {
        None => {
            let relative = if value == 0.0 { 0.0 } else { reading.error / value.abs() };
            let shown = unit.number(value, digits(value, Some(reading.error), MOST_DIGITS));
            (shown, format!("±{}", bound(relative)))
        }
        Some(word) => {
            let value = cautious(value, reading.truth, unit);
            (unit.number(value, DIGITS), word.replace('-', " "))
        }
    }
}

fn when(reading: &Reading) -> String {
    match (reading.time, reading.window) {
        (Some(at), _) => quantity(at, "s", DIGITS),
        (None, Some((from, to))) => {
            let unit = Unit::suiting(from.abs().max(to.abs()), "s");
            format!("{} to {}", unit.number(from, DIGITS), unit.text(to, DIGITS))
        }
        (None, None) => String::new(),
    }
}

/// Why a limit is not decided, and what decides it.
fn undecided(own: &Verdict<'_>, reason: Reason, found: impl Fn(&Reading) -> String) -> String {
    match reason {
        Reason::OtherAxes => other_axes(own, found),
        Reason::Clipped => "the record is clipped".to_owned(),
        Reason::Unit => "no impact is like that: is the unit right?".to_owned(),
        Reason::Cut => "the record begins or ends within the pulse".to_owned(),
        Reason::NoValue => own.known.value.err().map_or(String::new(), |own| own.to_string()),
        _ => "the limit is within the error".to_owned(),
    }
}

/// Which axes are not judged.
fn other_axes(own: &Verdict<'_>, found: impl Fn(&Reading) -> String) -> String {
    let analysis = &own.signal.analysis;
    let name = analysis.channel.name();
    let axes = analysis.part.axes();
    let joined =
        |axes: &[Axis]| list(axes.iter().map(|own| own.letter().to_string())).join(" and ");
    let are = |count: usize| if count == 1 { "is" } else { "are" };
    let beside = list(analysis.beside.iter().map(|own| format!("`{own}`")));
    let (others, count) = (beside.join(", "), beside.len());
    if let Some((other, reading)) = own.against {
        let other = other.analysis.channel.name();
        return format!("`{other}` of the same body is {}: one of them is wrong", found(reading));
    }
    if let Some(resultant) = own.resultant {
        let further = resultant.analysis.part.axes().into_iter().filter(|own| !axes.contains(own));
        let (one, further) = (joined(&axes), joined(&further.collect::<Vec<_>>()));
        return match own.contradiction.as_ref().map(found) {
            Some(known) => {
                format!("guided along {one} by declaration, but with {further} it is {known}")
            }
            None => format!(
                "it is that of {one} alone, and the limit is one on the resultant: with {further} it is that of `{}`",
                resultant.analysis.channel.name()
            ),
        };
    }
    match (&axes[..], count) {
        ([], _) => format!(
            "{others} may be of the same body, on whose resultant the limit is: `--channel \"{name}=Head X\"` says which \
             axis of what each is, `--channel \"{name}=Head\"` that one holds all of its motion"
        ),
        (_, 0) => format!(
            "{} alone {} measured, and the limit is one on the resultant of x, y and z; `--guided {}` where the rig lets the \
             body move along no other",
            joined(&axes),
            are(axes.len()),
            axes.iter().map(|own| own.letter()).collect::<String>()
        ),
        _ => format!(
            "{others} of the file may be of the same body and {} no part of this, and the limit is one on the resultant of \
             all",
            are(count)
        ),
    }
}

/// What is known of a limit, with its word.
pub(super) fn judged(own: &Verdict<'_>) -> (&'static str, String) {
    let label = match own.judgement {
        Judgement::Pass => "PASS",
        Judgement::Fail => "FAIL",
        Judgement::Undecided(_) => "UNDECIDED",
    };
    let limit = own.limit;
    let level = limit.bound.level();
    let unit = unit_of(own.known.measure, level, own.signal.analysis.channel.dimension());
    let found = |known: &Reading| match (known.value, known.truth) {
        (Err(_), _) => "is not determined".to_owned(),
        (Ok(value), Truth::Within) => {
            let shown = digits(value, Some(known.error), MOST_DIGITS);
            format!("{} ± {}", unit.text(value, shown), unit.text(known.error, ERROR_DIGITS))
        }
        (Ok(value), truth) => {
            let sign = if truth == Truth::AtLeast { "≥" } else { "≤" };
            format!("{sign} {}", unit.text(cautious(value, truth, &unit), DIGITS))
        }
    };
    let word = match limit.bound {
        Bound::Max(_) => "at most",
        Bound::Min(_) => "at least",
    };
    let from = limit.from.as_ref().map_or(String::new(), |from| format!(" ({from})"));
    let margin =
        own.margin().map_or(String::new(), |own| format!("; margin {}", percent_signed(own)));
    let mean = match (limit.of_mean, own.tests) {
        (false, _) => String::new(),
        (true, 1) => "; one test stands for the mean".to_owned(),
        (true, tests) => format!("; the mean of {tests} tests"),
    };
    let level = unit.text(level, DIGITS);
    let why = own.judgement.reason().map(|reason| format!("; {}", undecided(own, reason, found)));
    let (found, why) = (found(&own.known), why.unwrap_or_default());
    (label, format!("{} {found}, {word} {level}{from}{margin}{mean}{why}", limit.key))
}

/// A bound in digits that say no more than it does: rounded to the side on which the truth is not.
fn cautious(bound: f64, truth: Truth, unit: &Unit) -> f64 {
    let shown = unit.of(bound);
    let step = 10_f64.powf(shown.abs().log10().floor() + 1.0 - DIGITS as f64);
    let rounded = match truth {
        Truth::Within => return bound,
        Truth::AtLeast => (shown / step + ROUNDING).floor(),
        Truth::AtMost => (shown / step - ROUNDING).ceil(),
    };
    if shown == 0.0 { bound } else { bound * (rounded * step / shown) }
}
