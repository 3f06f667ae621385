//! Limits on what is read off channels.

use dashpot_analysis::{Judgement, Limit, Reason};
use dashpot_network::parameters::Dimension;
use dashpot_scene::{nearest, parse_limits};
use dashpot_signal::{Axis, Defect, Measure, Part, Reading};

use super::{Signal, Signals};
use crate::error::CliError;

/// Words of measures of signals, with those of scenes that say the same.
const SAME: [(&str, &[&str]); 4] = [
    ("peak", &["peak-acceleration", "peak-force", "peak-velocity", "peak-deformation"]),
    ("clip-3ms-at-once", &["clip-3ms"]),
    ("velocity-change", &["end-velocity"]),
    ("transmitted-force", &["peak-force"]),
];

/// A limit on a measure of a channel.
#[derive(Debug, Clone)]
pub(super) struct SignalLimit {
    /// The name of the channel.
    channel: String,
    /// The word of the measure.
    word: String,
    pub(super) limit: Limit,
}

/// Limits that one argument states.
#[derive(Debug, Clone)]
pub(super) struct Parsed {
    pub(super) list: Vec<SignalLimit>,
}

/// What is known of a limit on a channel, or on the mean of several tests.
#[derive(Clone, Copy)]
pub(super) struct Verdict<'s> {
    pub(super) limit: &'s SignalLimit,
    /// The channel; of several tests the first one.
    pub(super) signal: &'s Signal,
    pub(super) measure: Measure,
    /// How many tests it is judged by.
    pub(super) tests: usize,
    pub(super) value: Option<f64>,
    pub(super) error: f64,
    pub(super) judgement: Judgement,
}

impl<'s> Verdict<'s> {
    /// That of the values and errors of some tests, by their mean. What does not hold all of the motion, or is clipped,
    /// tells the least that a measure of the body is.
    fn of(
        limit: &'s SignalLimit,
        tests: &[(&'s Signal, &'s Reading)],
        guided: &[Axis],
    ) -> Option<Self> {
        let (signal, reading) = *tests.first()?;
        let count = tests.len() as f64;
        let values: Option<Vec<f64>> = tests.iter().map(|own| own.1.value.ok()).collect();
        let value = values.map(|own| own.iter().sum::<f64>() / count);
        let error = tests.iter().map(|own| own.1.error).sum::<f64>() / count;
        let is_part = tests.iter().any(|(own, reading)| {
            let own = &own.analysis;
            reading.measure.is_of_body(own.channel.dimension()) && !own.part.covers(guided)
        });
        let is_clipped = |own: &Defect| matches!(own, Defect::Clipped { .. });
        let is_clipped = tests.iter().any(|own| own.0.analysis.defects.iter().any(is_clipped));
        let is_cut = tests.iter().any(|own| own.0.analysis.contact.is_cut);
        let grows = is_part || is_clipped || is_cut;
        let judgement = limit.limit.bound.judge(value.unwrap_or(f64::NAN), Some(error), grows);
        let judgement = match judgement {
            Judgement::Undecided(Reason::Cut) if is_part => Judgement::Undecided(Reason::OtherAxes),
            Judgement::Undecided(Reason::Cut) if is_clipped => {
                Judgement::Undecided(Reason::Clipped)
            }
            own => own,
        };
        let (measure, tests) = (reading.measure, tests.len());
        Some(Self { limit, signal, measure, tests, value, error, judgement })
    }

    pub(super) fn passes(&self) -> bool {
        self.judgement == Judgement::Pass
    }
}

/// The limits of an argument: those of scenes, and on the measures of signals.
pub(super) fn parse(text: &str) -> Result<Parsed, String> {
    let place = text.find(['<', '>', '=']).unwrap_or(text.len());
    let (key, rest) = text.split_at(place);
    let (channel, word) = key.trim().rsplit_once('.').unwrap_or(("", key.trim()));
    let same = SAME.iter().find(|own| own.0 == word).map(|own| own.1);
    let own = |limit: Limit| SignalLimit {
        channel: channel.to_owned(),
        word: word.to_owned(),
        limit: Limit { key: format!("{channel}.{word}"), ..limit },
    };
    let mut fault = None;
    for word in same.unwrap_or(&[word]) {
        match parse_limits(&format!("{channel}.{word}{rest}")) {
            Ok(list) => return Ok(Parsed { list: list.into_iter().map(own).collect() }),
            Err(message) => {
                fault.get_or_insert(message);
            }
        }
    }
    Err(fault.unwrap_or_default())
}

/// Whether a measure of a channel is the one of a limit.
fn is_it(limit: &SignalLimit, measure: Measure, dimension: Dimension) -> bool {
    let peak = match dimension {
        Dimension::ACCELERATION => "peak-acceleration",
        Dimension::FORCE => "peak-force",
        Dimension::VELOCITY => "peak-velocity",
        _ => "peak-deformation",
    };
    let is_force = dimension == Dimension::FORCE && limit.word == "transmitted-force";
    limit.word == measure.word() || measure == Measure::Peak && (limit.word == peak || is_force)
}

impl SignalLimit {
    fn reading<'s>(&self, signal: &'s Signal) -> Option<&'s Reading> {
        let channel = &signal.analysis.channel;
        let mut all = signal.analysis.readings.iter();
        let is_named = channel.name() == self.channel
            || matches!(&signal.analysis.part, Part::Resultant { location, .. } if *location == self.channel);
        all.find(|own| is_named && is_it(self, own.measure, channel.dimension()))
    }
}

/// Refuses a limit on what no channel has.
pub(super) fn known(signals: &Signals) -> Result<(), CliError> {
    for limit in &signals.limits {
        if signals.all.iter().any(|own| limit.reading(own).is_some()) {
            continue;
        }
        let keys = signals.all.iter().flat_map(|own| {
            let name = own.analysis.channel.name();
            own.analysis
                .readings
                .iter()
                .map(move |reading| format!("{name}.{}", reading.measure.word()))
        });
        let mut known: Vec<String> = keys.collect();
        known.sort();
        known.dedup();
        let key = limit.limit.key.clone();
        let meant = nearest(&key, known.iter().map(String::as_str)).map(str::to_owned);
        return Err(CliError::SignalLimit { key, known, meant });
    }
    Ok(())
}

impl Signals {
    /// What is known of every limit: for each channel, or for the mean of all tests.
    pub(super) fn verdicts(&self) -> Vec<Verdict<'_>> {
        let mut verdicts = Vec::new();
        for limit in &self.limits {
            let found = self.all.iter().filter_map(|own| Some((own, limit.reading(own)?)));
            let found: Vec<(&Signal, &Reading)> = found.collect();
            if limit.limit.of_mean {
                verdicts.extend(Verdict::of(limit, &found, &self.guided));
            } else {
                let of_one = |own| Verdict::of(limit, &[own], &self.guided);
                verdicts.extend(found.into_iter().filter_map(of_one));
            }
        }
        verdicts
    }
}
