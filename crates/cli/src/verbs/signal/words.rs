//! Channels in words.

use dashpot_analysis::{Bound, Judgement, Reason, measures::STANDARD_GRAVITY};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use dashpot_signal::{Analysis, Axis, CONTACT_LEVEL, Measure, Part, Reading, Repeated};
use dashpot_units::si_unit;

use super::{Group, Signal, Signals, limits::Verdict};
use crate::{
    numbers::{MOST_DIGITS, Unit, bound, digits, percent_signed, quantity, share, significant},
    output::Text,
};

/// Digits of times and rates.
const DIGITS: usize = 4;
/// Noise below this part of the peak is not mentioned.
const UNSEEN: f64 = 1e-5;
/// Digits of errors.
const ERROR_DIGITS: usize = 1;

/// The unit of a quantity of about this value: accelerations are in g.
pub(super) fn unit(value: f64, dimension: Dimension) -> Unit {
    if dimension == Dimension::ACCELERATION {
        return Unit::new("g", STANDARD_GRAVITY);
    }
    Unit::suiting(value, &si_unit(dimension))
}

pub(in crate::verbs) fn unit_of(measure: Measure, value: f64, channel: Dimension) -> Unit {
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

pub(super) fn text(signals: &Signals, text: &mut Text) {
    text.warnings(&warnings(signals));
    let verdicts = signals.verdicts();
    for (at, own) in signals.all.iter().enumerate() {
        if at > 0 {
            text.blank();
        }
        text.title(&heading(own));
        treatment(&own.analysis).iter().for_each(|line| text.faint(line));
        let lines: Vec<(&str, String)> = verdicts
            .iter()
            .filter(|verdict| std::ptr::eq(verdict.signal, own))
            .map(judged)
            .collect();
        if !lines.is_empty() {
            text.blank();
            let width = lines.iter().map(|own| own.0.len()).max().unwrap_or(0);
            lines.iter().for_each(|(label, words)| text.labelled(label, width, words));
        }
        text.figures(&table(&own.analysis));
    }
    signals.groups().iter().for_each(|own| text.table(&repeats(own)));
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
        format!(
            "{} ± {} at rest from {} to {}",
            value(offset.value, shown),
            value(offset.error, ERROR_DIGITS),
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
                own.settings.padding
            )
        }
    };
    let turned = if own.settings.is_inverted { ", after its signs were turned" } else { "" };
    let polarity = format!("its peak is {}{turned}", own.polarity.word());
    let noise = own.doubt.noise;
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
        let Ok(value) = reading.value else {
            return vec![
                word,
                "–".to_owned(),
                String::new(),
                String::new(),
                String::new(),
                "the record is too short".to_owned(),
            ];
        };
        let unit = unit_of(reading.measure, value, dimension);
        let relative = if value == 0.0 { 0.0 } else { reading.error / value.abs() };
        let shown = |own: f64| unit.number(own, digits(value, Some(reading.error), MOST_DIGITS));
        let on_samples = reading.on_samples.map_or(String::new(), shown);
        vec![
            word,
            shown(value),
            format!("±{}", bound(relative)),
            unit.symbol.clone(),
            on_samples,
            when(reading),
        ]
    };
    let header = ["measure", "value", "error", "unit", "samples", "when"];
    Table::new("", &header, own.readings.iter().map(row))
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
fn undecided(own: &Verdict<'_>, reason: Reason) -> String {
    let axes: String = own.signal.analysis.part.axes().into_iter().map(Axis::letter).collect();
    match reason {
        Reason::OtherAxes => format!(
            "; {axes} alone is measured, and the limit is one on the resultant of x, y and z; `--guided {axes}` where the \
             rig lets the body move along no other"
        ),
        Reason::Clipped => "; the record is clipped, and its peak was higher".to_owned(),
        Reason::Cut => "; the record begins or ends within the pulse".to_owned(),
        _ => String::new(),
    }
}

/// What is known of a limit, with its word.
pub(super) fn judged(own: &Verdict<'_>) -> (&'static str, String) {
    let label = match own.judgement {
        Judgement::Pass => "PASS",
        Judgement::Fail => "FAIL",
        Judgement::Undecided(_) => "UNDECIDED",
    };
    let limit = &own.limit.limit;
    let level = limit.bound.level();
    let unit = unit_of(own.measure, level, own.signal.analysis.channel.dimension());
    let found = match own.value {
        Some(value) => {
            let shown = digits(value, Some(own.error), MOST_DIGITS);
            format!("{} ± {}", unit.text(value, shown), unit.text(own.error, ERROR_DIGITS))
        }
        None => "is not determined".to_owned(),
    };
    let word = match limit.bound {
        Bound::Max(_) => "at most",
        Bound::Min(_) => "at least",
    };
    let from = limit.from.as_ref().map_or(String::new(), |from| format!(" ({from})"));
    let margin = own.value.and_then(|value| limit.bound.margin(value));
    let margin = margin.map_or(String::new(), |own| format!("; margin {}", percent_signed(own)));
    let mean = match (limit.of_mean, own.tests) {
        (false, _) => String::new(),
        (true, 1) => "; one test stands for the mean".to_owned(),
        (true, tests) => format!("; the mean of {tests} tests"),
    };
    let level = unit.text(level, DIGITS);
    let why = own.judgement.reason().map_or(String::new(), |reason| undecided(own, reason));
    let text = format!("{} {found}, {word} {level}{from}{margin}{mean}{why}", limit.key);
    (label, text)
}
