//! Channels as objects for programs.

use dashpot_analysis::Bound;
use dashpot_signal::{Axis, Cfc, Defect, Part, Reading, Reason, Removal, Repeated};
use dashpot_units::{Dimension, si_unit};
use serde::Serialize;

use super::{Group, Signal, Signals, limits::Verdict, words::polarity};
use crate::{Pairs, VERSION, list, object};

pub(super) fn of(signals: &Signals) -> impl Serialize {
    object! {
        dashpot: VERSION,
        channels: list(signals.all.iter().map(channel)),
        repeats: list(signals.groups().iter().filter(|own| own.tests.len() > 1).map(repeats)),
        limits: list(signals.verdicts().into_iter().map(verdict)),
        notes: &signals.notes,
    }
}

fn channel(signal: &Signal) -> impl Serialize {
    let own = &signal.analysis;
    let settings = own.settings;
    let name = own.channel.name();
    let readings = own.readings.iter();
    let measures: Pairs<String, _> = readings
        .map(|reading| {
            (format!("{name}.{}", reading.measure.word()), number(own.channel.dimension(), reading))
        })
        .collect();
    object! {
        file: &signal.file,
        name,
        axes: list(own.part.axes().into_iter().map(Axis::letter)),
        beside: own.beside.clone(),
        resultant_of: match &own.part {
            Part::Resultant { of, .. } => list(of.iter().map(|own| own.1.clone())),
            _ => Vec::new(),
        },
        unit: si_unit(own.channel.dimension()),
        samples: own.channel.times().len(),
        rate: own.rate(),
        span: own.channel.span(),
        polarity: polarity(&own.channel),
        inverted: settings.is_inverted,
        cfc: settings.cfc.map(Cfc::class),
        filter: settings.cfc.map(|cfc| object! {
            class: cfc.class(),
            padding: settings.padding.words()[0],
            design_frequency: cfc.design_frequency(),
            gain_at_class: cfc.gain(cfc.class(), own.rate()),
            gain_at_design_frequency: cfc.gain(cfc.design_frequency(), own.rate()),
        }),
        offset: own.offset,
        noise: own.uncertainty.noise,
        removed: own.removed,
        removal: match settings.offset {
            Removal::Nothing => "nothing",
            Removal::Found => "auto",
            Removal::Given(_) => "given",
        },
        measures,
        warnings: list(own.defects.iter().map(warning)),
    }
}

/// What is wrong with a channel.
pub fn warning(own: &Defect) -> impl Serialize + use<> {
    object! { code: own.code(), text: own.to_string() }
}

/// A number read off a channel of this dimension; one that is a bound, `at-least` or `at-most`, has no error.
pub fn number(channel: Dimension, reading: &Reading) -> impl Serialize + use<> {
    object! {
        value: reading.value.ok(),
        unit: si_unit(reading.measure.dimension(channel)),
        time: reading.time,
        window: reading.window,
        error: reading.bar(),
        bound: reading.truth.word(),
        on_samples: reading.on_samples,
        note_code: reading.value.err().map(Reason::code),
    }
}

fn repeats(group: &Group<'_>) -> impl Serialize + use<> {
    let (name, tests) = (group.name, group.analyses());
    let dimension = tests.first().map_or(Dimension::NUMBER, |own| own.channel.dimension());
    let measures: Pairs<String, _> = Repeated::of(&tests)
        .into_iter()
        .map(|own| {
            let value = object! {
                tests: own.tests,
                mean: own.mean,
                error: own.error,
                deviation: own.deviation,
                variation: own.variation(),
                repeatability: own.repeatability(),
                range: own.range,
                unit: si_unit(own.measure.dimension(dimension)),
            };
            (format!("{name}.{}", own.measure.word()), value)
        })
        .collect();
    object! { name: name.to_owned(), tests: tests.len(), measures }
}

fn verdict(own: Verdict<'_>) -> impl Serialize {
    let limit = own.limit;
    let bound = limit.bound;
    let dimension = own.known.measure.dimension(own.signal.analysis.channel.dimension());
    object! {
        file: (own.tests == 1).then(|| own.signal.file.clone()),
        key: limit.key.clone(),
        max: matches!(bound, Bound::Max(_)).then_some(bound.level()),
        min: matches!(bound, Bound::Min(_)).then_some(bound.level()),
        from: limit.from.clone(),
        of_mean: limit.of_mean,
        tests: own.tests,
        unit: si_unit(dimension),
        value: own.known.value.ok(),
        error: own.known.bar(),
        bound: own.known.truth.word(),
        verdict: own.judgement.word(),
        reason: own.judgement.reason().map(dashpot_analysis::Reason::word),
        margin: own.margin(),
    }
}
