//! Limits on what is read off channels.

use dashpot_analysis::{Bound, Judgement, Limit, Reason, limits::standards::standard};
use dashpot_network::parameters::Dimension;
use dashpot_scene::{nearest, parse_limits, units::parse_quantity};
use dashpot_signal::{
    Analysis, Defect, Measure, Part, Reading, Reason as Open, Truth, location_of_resultant,
};
use dashpot_units::{parse_dimension, si_unit};

use super::SignalError;
use super::{Signal, Signals};
use crate::{Given, Kind, Single, StudyError};

/// Words of measures of signals, with those of scenes that say the same.
const SAME: [(&str, &[&str]); 4] = [
    ("peak", &["peak-acceleration", "peak-force", "peak-velocity", "peak-deformation"]),
    ("clip-3ms-at-once", &["clip-3ms"]),
    ("velocity-change", &["end-velocity"]),
    ("transmitted-force", &["peak-force"]),
];

/// Limits that one argument states, each with the channel and the measure of signals in its key.
#[derive(Debug, Clone, PartialEq)]
pub struct ChannelLimits(pub(super) Vec<Stated>);

impl Single for ChannelLimits {
    const KIND: Kind = Kind::Text;
    const IS_DIVIDED: bool = false;

    fn of(given: &Given) -> Result<Self, String> {
        parse(&String::of(given)?)
    }
}

/// A limit as it is stated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stated {
    limit: Limit,
    /// The quantity or the standard, as it is written.
    level: String,
    /// What that is in; `None` of a plain zero.
    dimension: Option<Dimension>,
}

/// The channel and the measure in a key.
fn parts(key: &str) -> (&str, &str) {
    key.rsplit_once('.').unwrap_or(("", key))
}

/// What is known of a limit on a channel, or on the mean of several tests.
#[derive(Clone, Copy)]
pub(super) struct Verdict<'s> {
    pub(super) limit: &'s Limit,
    /// The channel; of several tests the first one.
    pub(super) signal: &'s Signal,
    /// How many tests it is judged by.
    pub(super) tests: usize,
    pub(super) known: Reading,
    pub(super) judgement: Judgement,
    /// The resultant of more axes of its location, of a measure of bodies.
    pub(super) resultant: Option<&'s Signal>,
    /// What that says, where it contradicts that the rig lets nothing move along its further axes.
    pub(super) contradiction: Option<Reading>,
    /// A channel of the same body that exceeds what this one keeps, and what it reads.
    pub(super) against: Option<(&'s Signal, &'s Reading)>,
}

impl Verdict<'_> {
    pub(super) fn passes(&self) -> bool {
        self.judgement == Judgement::Pass
    }

    /// What is left of the bound, in parts of it; `None` of what is only bounded.
    pub(super) fn margin(&self) -> Option<f64> {
        self.known.bar()?;
        self.limit.bound.margin(self.known.value.ok()?)
    }
}

/// The mean of a measure over several tests.
fn mean(all: &[&Reading]) -> Option<Reading> {
    let count = all.len() as f64;
    let values: Result<Vec<f64>, _> = all.iter().map(|own| own.value).collect();
    let bounds = || all.iter().map(|own| own.truth).filter(|own| *own != Truth::Within);
    let truth = bounds().next().unwrap_or_default();
    let value = if bounds().all(|own| own == truth) {
        values.map(|own| own.iter().sum::<f64>() / count)
    } else {
        Err(Open::Clipped)
    };
    let error = all.iter().map(|own| own.error).sum::<f64>() / count;
    Some(Reading { value, truth, error, ..**all.first()? })
}

/// What a reading says of a bound; of a measure that may be larger by a `reason` what is sure all the same.
fn judge(own: &Reading, bound: Bound, reason: Option<Reason>) -> Judgement {
    let value = own.value.unwrap_or(f64::NAN);
    let judgement = match (own.truth, bound) {
        (Truth::AtMost, _) if reason.is_some() => Judgement::Undecided(Reason::Cut),
        // A value that may be smaller is judged as its negative that may be larger.
        (Truth::AtMost, Bound::Max(level)) => Bound::Min(-level).judge(-value, Some(0.0), true),
        (Truth::AtMost, Bound::Min(level)) => Bound::Max(-level).judge(-value, Some(0.0), true),
        (truth, _) => {
            let grows = reason.is_some() || truth == Truth::AtLeast;
            bound.judge(value, Some(own.error), grows)
        }
    };
    match judgement {
        Judgement::Undecided(Reason::Cut) => {
            Judgement::Undecided(reason.unwrap_or(Reason::Clipped))
        }
        own => own,
    }
}

/// The limits of an argument: those of scenes, and on the measures of signals.
fn parse(text: &str) -> Result<ChannelLimits, String> {
    let place = text.find(['<', '>', '=']).unwrap_or(text.len());
    let (key, rest) = text.split_at(place);
    let (key, level) = (key.trim(), rest.trim_start_matches(['<', '>', '=']).trim());
    let (channel, word) = parts(key);
    if !rest.starts_with('=') && standard(level).is_some() {
        return Err(format!("`{level}` is a standard: write `{key}={level}`"));
    }
    let stated = |limit: Limit, dimension: Option<Dimension>| {
        let is_zero = limit.unit.is_none() && limit.bound.level() == 0.0;
        let dimension = dimension.filter(|_| !is_zero);
        Stated { limit: Limit { key: key.to_owned(), ..limit }, level: level.to_owned(), dimension }
    };
    let own = |limit: Limit| {
        let dimension = limit.measure().and_then(|own| parse_dimension(own.about.unit).ok());
        stated(limit, dimension)
    };
    let is_index = |own: Measure| own.is_index() && own.word() == word;
    if Measure::of(Dimension::ACCELERATION).any(is_index)
        && parse_quantity(level).is_ok_and(|own| own.dimension.is_some())
    {
        return Err(format!(
            "`{word}` is an index, which has no unit; `{level}` has one: write a plain number"
        ));
    }
    let same = SAME.iter().find(|own| own.0 == word).map(|own| own.1);
    let mut fault = None;
    for word in same.unwrap_or(&[word]) {
        match parse_limits(&format!("{channel}.{word}{rest}")) {
            Ok(list) => return Ok(ChannelLimits(list.into_iter().map(own).collect())),
            Err(message) => {
                let bare = || parse_limits(&format!("{word}{rest}")).err();
                let bare = if channel.is_empty() { bare() } else { None };
                fault.get_or_insert(bare.unwrap_or(message));
            }
        }
    }
    // A channel may be of what no measure of scenes is in.
    let bound = match rest.get(..2) {
        Some("<=") => Some(Bound::Max as fn(f64) -> Bound),
        Some(">=") => Some(Bound::Min as fn(f64) -> Bound),
        _ => None,
    };
    let other = parse_quantity(level).ok().filter(|own| own.dimension.is_some());
    match bound.zip(other).filter(|_| word == Measure::Peak.word() && !channel.is_empty()) {
        Some((bound, own)) => {
            Ok(ChannelLimits(vec![stated(Limit::new(key, bound(own.value)), own.dimension)]))
        }
        None => Err(fault.unwrap_or_default()),
    }
}

/// A dimension in words, with its units.
fn told(dimension: Dimension) -> (String, String) {
    let units = match dimension {
        Dimension::ACCELERATION => "g or m/s^2".to_owned(),
        Dimension::FORCE => "N or kN".to_owned(),
        Dimension::LENGTH => "m or mm".to_owned(),
        Dimension::TIME => "s or ms".to_owned(),
        other => si_unit(other),
    };
    let name = dimension.named().map_or("quantity", |own| own.0);
    let article = if name.starts_with(['a', 'e', 'i']) { "an" } else { "a" };
    (format!("{article} {name}"), units)
}

/// Whether a measure of a channel is the one of a limit.
fn is_it(limit: &Limit, measure: Measure, dimension: Dimension) -> bool {
    let peak = match dimension {
        Dimension::ACCELERATION => "peak-acceleration",
        Dimension::FORCE => "peak-force",
        Dimension::VELOCITY => "peak-velocity",
        _ => "peak-deformation",
    };
    let (_, word) = parts(&limit.key);
    let is_force = dimension == Dimension::FORCE && word == "transmitted-force";
    word == measure.word() || measure == Measure::Peak && (word == peak || is_force)
}

/// Refuses a limit on what no channel has, or in what its measure is not.
pub(super) fn known(signals: &Signals) -> Result<(), StudyError> {
    for Stated { limit, level, dimension } in &signals.limits {
        let found = signals.readings(limit);
        let of =
            |own: &(&Signal, &Reading)| own.1.measure.dimension(own.0.analysis.channel.dimension());
        let other = found.iter().map(of).find(|own| dimension.is_some_and(|given| given != *own));
        if let Some((own, given)) = other.zip(*dimension) {
            let ((own, units), given) = (told(own), told(given));
            let given = match &limit.from {
                Some(edition) => format!("`{level}` ({edition}) limits {}", given.0),
                None => format!("`{level}` is {}, in {}", given.0, given.1),
            };
            let reason = format!("`{}` is {own}, in {units}, and {given}", limit.key);
            return Err(StudyError::setting("--limit", reason));
        }
        if !found.is_empty() {
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
        let key = limit.key.clone();
        let has_word = |own: &&String| parts(own).1 == key;
        let meant = if parts(&key).0.is_empty() {
            known.iter().find(has_word).cloned()
        } else {
            nearest(&key, known.iter().map(String::as_str)).map(str::to_owned)
        };
        return Err(SignalError::Limit { key, known, meant }.into());
    }
    Ok(())
}

impl Signals {
    /// What channels say of the measure of a limit: those of its name, and of a location its resultant, or its only axis.
    fn readings(&self, limit: &Limit) -> Vec<(&Signal, &Reading)> {
        let (name, _) = parts(&limit.key);
        let is_named = |own: &&Signal| {
            own.analysis.channel.name() == name
                || own.analysis.part.location() == Some(name) && self.fuller(own).is_none()
        };
        let reading = |own| Some((own, reading(own, limit)?));
        self.all.iter().filter(is_named).filter_map(reading).collect()
    }

    /// The resultant of an axis, or of fewer axes of the same location.
    fn fuller(&self, own: &Signal) -> Option<&Signal> {
        let part = &own.analysis.part;
        self.all.iter().find(|other| {
            let is_resultant = matches!(other.analysis.part, Part::Resultant { .. });
            let is_there =
                other.file == own.file && other.analysis.part.location() == part.location();
            let is_alike = other.analysis.channel.dimension() == own.analysis.channel.dimension();
            is_resultant
                && is_there
                && is_alike
                && other.analysis.part.axes().len() > part.axes().len()
        })
    }

    /// What is known of every limit: for each channel, or for the mean of all tests.
    pub(super) fn verdicts(&self) -> Vec<Verdict<'_>> {
        let mut verdicts = Vec::new();
        for Stated { limit, .. } in &self.limits {
            let found = self.readings(limit);
            let tests = if limit.of_mean { found.len().max(1) } else { 1 };
            verdicts.extend(found.chunks(tests).filter_map(|own| self.verdict(limit, own)));
        }
        verdicts
    }

    /// That of some tests, by their mean. What does not hold all of the motion of a body tells the least that its measure is.
    fn verdict<'s>(
        &'s self,
        limit: &'s Limit,
        tests: &[(&'s Signal, &'s Reading)],
    ) -> Option<Verdict<'s>> {
        let (signal, reading) = *tests.first()?;
        let measure = reading.measure;
        let is_of_body = measure.is_of_body(signal.analysis.channel.dimension());
        let is_part = |own: &Analysis| !own.beside.is_empty() || !own.part.covers(&self.guided);
        let is_part = is_of_body && tests.iter().any(|own| is_part(&own.0.analysis));
        let is_cut = tests.iter().any(|own| own.0.analysis.contact.is_cut);
        let reason = [(is_part, Reason::OtherAxes), (is_cut, Reason::Cut)];
        let reason = reason.into_iter().find(|own| own.0).map(|own| own.1);
        let bound = limit.bound;
        let known = mean(&tests.iter().map(|own| own.1).collect::<Vec<_>>())?;
        let mut judgement = judge(&known, bound, reason);
        // A rig that guides the body leaves other axes nothing that would change what is said.
        let of_all = |own: &(&'s Signal, &'s Reading)| {
            let all = self.fuller(own.0).and_then(|all| all.analysis.reading(measure));
            all.unwrap_or(own.1)
        };
        let is_kept_by_less = match bound {
            Bound::Max(_) => judgement == Judgement::Pass,
            Bound::Min(_) => judgement == Judgement::Fail,
        };
        let resultant = self.fuller(signal).filter(|_| is_of_body);
        let contradiction = resultant.filter(|_| is_kept_by_less).and_then(|_| {
            let known = mean(&tests.iter().map(of_all).collect::<Vec<_>>())?;
            (judge(&known, bound, reason) != judgement).then_some(known)
        });
        let against = match (judgement, bound) {
            (Judgement::Pass, Bound::Max(_)) if is_of_body => self.against(tests, bound),
            _ => None,
        };
        if contradiction.is_some() || against.is_some() {
            judgement = Judgement::Undecided(Reason::OtherAxes);
        }
        let is_odd =
            |own: &Defect| matches!(own, Defect::OddPeak { .. } | Defect::OddLength { .. });
        if tests.iter().any(|own| own.0.analysis.defects.iter().any(is_odd)) {
            judgement = Judgement::Undecided(Reason::Unit);
        }
        let tests = tests.len();
        Some(Verdict { limit, signal, tests, known, judgement, resultant, contradiction, against })
    }

    /// A channel of the same body that was recorded and exceeds a bound: no axis is larger than the resultant of all, and one
    /// that was recorded is the same.
    fn against<'s>(
        &'s self,
        tests: &[(&'s Signal, &'s Reading)],
        bound: Bound,
    ) -> Option<(&'s Signal, &'s Reading)> {
        let of = |(own, reading): &(&'s Signal, &'s Reading)| {
            let place = location(own)?;
            let is_of_it = |other: &&Signal| {
                other.file == own.file
                    && !matches!(other.analysis.part, Part::Resultant { .. })
                    && other.analysis.channel.dimension() == own.analysis.channel.dimension()
                    && location(other).is_some_and(|other| other.eq_ignore_ascii_case(&place))
            };
            self.all.iter().filter(is_of_it).find_map(|other| {
                let further = other.analysis.reading(reading.measure)?;
                (judge(further, bound, None) == Judgement::Fail).then_some((other, further))
            })
        };
        tests.iter().find_map(of)
    }
}

/// The location that the name of a channel tells, of an axis or of a resultant.
fn location(own: &Signal) -> Option<String> {
    let of_part = own.analysis.part.location().map(str::to_owned);
    of_part.or_else(|| location_of_resultant(own.analysis.channel.name()))
}

/// The reading of a channel that a limit is on.
fn reading<'s>(signal: &'s Signal, limit: &Limit) -> Option<&'s Reading> {
    let dimension = signal.analysis.channel.dimension();
    signal.analysis.readings.iter().find(|own| is_it(limit, own.measure, dimension))
}
