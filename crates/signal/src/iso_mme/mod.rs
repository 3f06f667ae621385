//! Measured channels as ISO/TS 13499 keeps them: a test `.mme`, an index `.chn`, and one text for each channel.
//!
//! Each text begins with lines `name :value`; behind them a channel has one sample a line. Names are read whatever their
//! case and the blanks around them.

mod header;

use dashpot_units::{Dimension, UnitError, parse_quantity};
use thiserror::Error;

use self::header::Header;
use crate::{Channel, ChannelFault};

/// A test has at most so many samples.
const MOST_SAMPLES: usize = 10_000_000;
/// What stands where nothing is known.
const NO_VALUE: &str = "NOVALUE";
/// Units as they are written in such files, and as they are read here.
const SPELLINGS: [(&str, &str); 6] = [
    ("m/sec2", "m/s^2"),
    ("m/sec^2", "m/s^2"),
    ("m/sec", "m/s"),
    ("sec", "s"),
    ("G", "g"),
    ("Nm", "N m"),
];

/// A code of 16 characters: test object, position, main location (4), fine locations (3 of 2), physical dimension (2),
/// direction, filter class.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChannelCode {
    text: String,
}

impl ChannelCode {
    /// A code as it is written.
    pub(crate) fn new(text: &str) -> Self {
        Self { text: text.to_owned() }
    }

    /// The code.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where it was measured: `HEAD`; `None` where the code is not of 16 characters.
    pub fn location(&self) -> Option<&str> {
        self.part(2, 6)
    }

    /// The letter of the direction: `X`, `Y` or `Z` of an axis, `R` of a resultant.
    pub fn direction(&self) -> Option<char> {
        self.part(14, 15)?.chars().next()
    }

    /// The channel frequency class that it went through: none for `0`, the class for `A` to `D`.
    pub fn filter_class(&self) -> Option<f64> {
        match self.part(15, 16)? {
            "A" => Some(1000.0),
            "B" => Some(600.0),
            "C" => Some(180.0),
            "D" => Some(60.0),
            _ => None,
        }
    }

    fn part(&self, from: usize, to: usize) -> Option<&str> {
        if self.text.chars().count() == 16 { self.text.get(from..to) } else { None }
    }
}

/// A channel of a test.
#[derive(Debug, Clone, PartialEq)]
pub struct MmeChannel {
    /// Its code, where the text has one.
    pub code: Option<ChannelCode>,
    /// Its samples, in SI units.
    pub channel: Channel,
    /// The filter class that it went through before, as the text says it.
    pub prefilter: Option<String>,
}

/// What is wrong with a text, and in which line from 1.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("line {line}: {fault}")]
pub struct MmeError {
    /// The line.
    pub line: usize,
    /// What is wrong.
    pub fault: MmeFault,
}

/// What is wrong with a text of a channel.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum MmeFault {
    /// A line that has no colon and is no number.
    #[error("`{text}` is neither `name :value` nor a number")]
    NoEntry { text: String },
    /// An entry that is missing.
    #[error("there is no entry `{name}`")]
    Missing { name: &'static str },
    /// An entry that is no number.
    #[error("`{name}` is `{text}`, where a positive number is wanted")]
    NoNumber { name: &'static str, text: String },
    /// A unit that cannot be read.
    #[error("`Unit`: {0}")]
    Unit(UnitError),
    /// A sample that is none.
    #[error("`{text}` is not a number")]
    NoSample { text: String },
    /// A sample that is not finite.
    #[error("`{text}` is not finite: every sample is a finite number")]
    NotFinite { text: String },
    /// More or fewer samples than the header says.
    #[error("there are {found} samples, and `Number of samples` is {stated}")]
    Count { found: usize, stated: usize },
    /// A channel whose times are another channel.
    #[error("its times are those of channel `{name}`, which is not here")]
    NoReference { name: String },
    /// More samples than are read of one test.
    #[error("up to here the test has more than {} samples, which is the limit", MOST_SAMPLES)]
    TooMany,
    /// Samples that are no signal.
    #[error("{0}")]
    Samples(ChannelFault),
}

/// The samples of a text, before their times are known.
struct Samples {
    name: String,
    code: Option<ChannelCode>,
    dimension: Dimension,
    prefilter: Option<String>,
    values: Vec<f64>,
    /// Where each sample stands.
    lines: Vec<usize>,
    times: Times,
}

/// Where the times are from.
enum Times {
    /// Even steps.
    Even { start: f64, step: f64 },
    /// Another channel, named in this line.
    Of { name: String, line: usize },
}

/// Reads the channels of a test from their texts; those of times that others refer to are no channels themselves.
///
/// # Errors
///
/// The first fault with the number of its text.
pub fn read(texts: &[&str]) -> Result<Vec<MmeChannel>, (usize, MmeError)> {
    let mut lines = 0;
    for (at, text) in texts.iter().enumerate() {
        let count = text.lines().count();
        lines += count;
        if lines > MOST_SAMPLES {
            return Err((at, MmeError { line: count, fault: MmeFault::TooMany }));
        }
    }
    let all = texts.iter().enumerate();
    let all: Vec<Samples> =
        all.map(|(at, text)| samples(text).map_err(|own| (at, own))).collect::<Result<_, _>>()?;
    let mut channels = Vec::new();
    for (at, own) in all.iter().enumerate() {
        if own.dimension == Dimension::TIME {
            continue;
        }
        channels.push(channel(own, &all).map_err(|own| (at, own))?);
    }
    Ok(channels)
}

fn samples(text: &str) -> Result<Samples, MmeError> {
    let header = Header::read(text)?;
    let (unit, line) = header.wanted("Unit")?;
    let code = header.value("Channel code").map(|own| ChannelCode::new(own.0));
    // `g` is standard gravity, unless the code says that a mass is measured.
    let one = quantity(unit).map_err(|own| MmeError { line, fault: MmeFault::Unit(own) })?;
    let one = one.meant(Dimension::ACCELERATION);
    let dimension = one.dimension.unwrap_or(Dimension::NUMBER);
    let (mut values, mut lines) = (Vec::new(), Vec::new());
    for (line, text) in header.samples() {
        let number = text.replacen(',', ".", 1).parse::<f64>();
        let text = text.to_owned();
        let value = number
            .map_err(|_| MmeError { line, fault: MmeFault::NoSample { text: text.clone() } })?;
        if !value.is_finite() {
            return Err(MmeError { line, fault: MmeFault::NotFinite { text } });
        }
        values.push(value * one.value);
        lines.push(line);
    }
    if let Some((stated, line)) = header.count("Number of samples")?
        && stated != values.len()
    {
        return Err(MmeError { line, fault: MmeFault::Count { found: values.len(), stated } });
    }
    let name = header.value("Name of the channel").or(header.value("Channel code"));
    let reference = header.value("Reference channel name");
    let is_explicit =
        header.value("Reference channel").is_some_and(|own| own.0.eq_ignore_ascii_case("explicit"));
    let times = match reference.filter(|_| is_explicit) {
        Some((name, line)) => Times::Of { name: name.to_owned(), line },
        None if dimension == Dimension::TIME => Times::Even { start: 0.0, step: 1.0 },
        None => Times::Even {
            start: header.number("Time of first sample")?.unwrap_or(0.0),
            step: header.positive("Sampling interval")?,
        },
    };
    Ok(Samples {
        name: name.map_or_else(|| "channel".to_owned(), |own| own.0.to_owned()),
        code,
        dimension,
        prefilter: header.value("Pre-filter type").map(|own| own.0.to_owned()),
        values,
        lines,
        times,
    })
}

/// One of a unit as it is written in such files.
fn quantity(unit: &str) -> Result<dashpot_units::Quantity, UnitError> {
    let spelled = SPELLINGS.iter().find(|own| own.0 == unit).map_or(unit, |own| own.1);
    let spelled = spelled.replace("**", "^");
    if matches!(spelled.as_str(), "-" | "1") {
        return Ok(dashpot_units::Quantity::of(1.0, Dimension::NUMBER));
    }
    parse_quantity(&format!("1 {spelled}"))
}

fn channel(own: &Samples, all: &[Samples]) -> Result<MmeChannel, MmeError> {
    let times = match &own.times {
        Times::Even { start, step } => {
            (0..own.values.len()).map(|at| start + at as f64 * step).collect()
        }
        Times::Of { name, line } => {
            let is_it = |other: &&Samples| {
                let by_code = other.code.as_ref().is_some_and(|code| code.text() == name);
                other.dimension == Dimension::TIME && (by_code || other.name == *name)
            };
            let fault = MmeFault::NoReference { name: name.clone() };
            let found = all.iter().find(is_it).ok_or(MmeError { line: *line, fault })?;
            found.values.clone()
        }
    };
    let channel = Channel::new(&own.name, own.dimension, times, own.values.clone());
    let channel = channel.map_err(|fault| MmeError {
        line: fault.sample().and_then(|at| own.lines.get(at).copied()).unwrap_or(1),
        fault: MmeFault::Samples(fault),
    })?;
    Ok(MmeChannel { code: own.code.clone(), channel, prefilter: own.prefilter.clone() })
}

#[cfg(test)]
mod tests;
