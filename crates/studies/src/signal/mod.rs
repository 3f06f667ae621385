//! Measured channels: offset, filter, peak, HIC, clips, with the errors of sampling.

mod error;
mod limits;
pub mod mme;
mod object;
mod read;
mod report;
mod words;

use dashpot_analysis::measures::STANDARD_GRAVITY;
use dashpot_network::parameters::Dimension;
use dashpot_report::Report;
use dashpot_signal::{
    Analysis, Approach, Axis, Cfc, Channel, Padding, Part, Place, Removal, Settings,
};
use serde::{Serialize, Serializer};

pub use self::{
    error::SignalError,
    limits::ChannelLimits,
    object::{number, warning},
    words::{shown, unit_of},
};
use self::{
    limits::{Stated, Verdict},
    read::{MeasuredChannel, Record},
};
use crate::{
    Amount, Answer, Context, DataTable, Frequency, Given, Kind, Mass, Operands, OptionValue,
    Outcome, Progress, Remark, Single, Speed, Study, StudyError, Time, Whole, request,
    study::about_study,
};

request! {
    /// How channels are read, and what is asked of them.
    pub SignalRequest {
        /// A channel by the name or the number of its column [default: all accelerations and forces]; repeatable. `acc1=Head X`
        /// says what it is: an axis of a location, or, as `acc1=Head`, all that moves there.
        channel "NAME[=WHAT]": Vec<Whole>;
        /// Units of the columns where the file says none, in their order: "s, g".
        units "UNIT,…": Vec<String>;
        /// Sampling rate: of a file without times; or at which the line between its samples is read.
        rate "FREQUENCY": Option<Frequency>;
        /// What is taken off: `auto`, the reading at rest before the pulse, or a value such as "0.3 g".
        offset "VALUE": Option<Amount>;
        /// Turns the signs.
        invert "": bool;
        /// Filters by a channel frequency class of SAE J211: 60, 180, 600 or 1000.
        cfc "CLASS": Option<Cfc>, alias "filter";
        /// What stands beyond the ends of the record for the filter [default: odd].
        padding "MODE": Padding, requires "cfc";
        /// Reads the record from this time on, behind the filter.
        from "TIME": Option<Time>;
        /// Reads it up to this time.
        to "TIME": Option<Time>;
        /// Speed of approach of the body that an accelerometer is on when its contact begins: gives its displacement, its
        /// rebound and the coefficient of restitution. Before, it flies freely. A force needs `--mass` as well: that of a free
        /// striker.
        velocity "SPEED": Option<Speed>;
        /// Its mass: gives energy taken, returned and absorbed.
        mass "MASS": Option<Mass>, requires "velocity";
        /// When its contact begins [default: where the record leaves what it reads at rest].
        touch "TIME": Option<Time>, requires "velocity";
        /// It falls: its weight acts along the impact.
        falls "": bool, requires "velocity";
        /// The rig guides the body along this axis, or in the plane of two, as in `xz`: what those axes say is then all of its
        /// motion. By default limits on the acceleration of a body are judged on the resultant of x, y and z.
        guided "AXES": Option<Guided>;
        /// The displacement over which a force does its work, by the name or number of its column [default: the only
        /// one of the file].
        displacement "NAME": Option<String>;
        /// A limit such as "acc.hic15<=700", "acc.peak<=250 g" or "acc.peak=en-1078" (`dashpot list limits`); repeatable.
        limit "LIMIT": Vec<ChannelLimits>;
        /// Ends with exit code 4 unless every limit is kept for certain.
        enforce "": bool;
    }
}

/// Axes along which a body may move.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guided(Vec<Axis>);

impl Single for Guided {
    const KIND: Kind = Kind::Text;

    fn of(given: &Given) -> Result<Self, String> {
        let axes: Option<Vec<Axis>> = String::of(given)?.trim().chars().map(Axis::of).collect();
        let axes = axes.filter(|axes| (1..Axis::ALL.len()).contains(&axes.len()));
        axes.filter(|axes| axes.first() != axes.get(1))
            .map(Self)
            .ok_or_else(|| "it is one axis or two of x, y and z, as in `z` or `xz`".to_owned())
    }
}

impl Single for Cfc {
    const KIND: Kind = Kind::Count;

    fn of(given: &Given) -> Result<Self, String> {
        let text = String::of(given)?;
        let text = text.trim();
        let number = text.strip_prefix("CFC").or(text.strip_prefix("cfc")).unwrap_or(text).trim();
        let class = number
            .parse()
            .map_err(|_| format!("`{text}` is no class: write 60, 180, 600 or 1000"))?;
        Self::new(class).map_err(|error| error.to_string())
    }
}

impl OptionValue for Padding {
    const KIND: Kind = Kind::Words(|| Self::ALL.map(|mode| mode.words().into()).to_vec());

    fn take(&mut self, given: &Given) -> Result<(), String> {
        let word = String::of(given)?;
        let known = Self::ALL.into_iter().find(|mode| mode.words()[0] == word.trim());
        *self = known.ok_or_else(|| format!("there is no mode `{word}`"))?;
        Ok(())
    }
}

/// A channel of a file as it was read.
#[derive(Debug)]
#[non_exhaustive]
pub struct Signal {
    /// Its file.
    pub file: String,
    /// What files of results are named by.
    stem: String,
    /// What was read off it.
    pub analysis: Analysis,
}

/// What some files say.
#[derive(Debug)]
#[non_exhaustive]
pub struct Signals {
    /// The channels, file by file, each file's resultants behind its channels.
    pub all: Vec<Signal>,
    limits: Vec<Stated>,
    /// Along which axes bodies may move.
    guided: Vec<Axis>,
    /// Whether limits are enforced.
    is_enforced: bool,
    /// What may be of interest about the files.
    pub notes: Vec<String>,
}

impl SignalRequest {
    /// Refuses what says something of a channel that the record does not have.
    fn apply_to(&self, record: &Record) -> Result<(), StudyError> {
        let wrong = |name: &str, reason: String| {
            Err(StudyError::setting(name, format!("`{}`: {reason}", record.file)))
        };
        let is_of = |of: Dimension| record.channels.iter().any(|own| own.channel.dimension() == of);
        if self.displacement.is_some() && !is_of(Dimension::FORCE) {
            return wrong(
                "--displacement",
                "no channel that is read is a force, which alone does work over one".to_owned(),
            );
        }
        if self.velocity.is_none() || record.channels.iter().any(|own| self.moves(record, own)) {
            return Ok(());
        }
        let reason = if is_of(Dimension::ACCELERATION) {
            let names: Vec<&str> = record.channels.iter().map(|own| own.channel.name()).collect();
            format!(
                "it has one direction, and {} are axes of one body: `--guided z` says which of them is along the impact, or \
                 `--channel` names it",
                names.join(", ")
            )
        } else if is_of(Dimension::FORCE) {
            "a force moves what has a mass: say it, `--mass \"5 kg\"`, where it acts on a free striker".to_owned()
        } else {
            "no channel that is read is an acceleration or a force, which alone tell a motion"
                .to_owned()
        };
        wrong("--velocity", reason)
    }

    /// Whether a channel tells the motion of a body that comes with `--velocity`: an acceleration, or a force on a known
    /// mass; of several axes of one location the one along which the body is guided.
    fn moves(&self, record: &Record, own: &MeasuredChannel) -> bool {
        let is_along = |place: &Place| {
            let places = record.channels.iter().filter_map(|other| other.place.as_ref());
            let is_alone = places.filter(|other| other.is_beside(place)).all(|own| own == place);
            self.guided.as_ref().map_or(is_alone, |guided| guided.0 == [place.axis])
        };
        let has_mass = match own.channel.dimension() {
            Dimension::FORCE => self.mass.is_some(),
            dimension => dimension == Dimension::ACCELERATION,
        };
        has_mass && own.place.as_ref().is_none_or(is_along)
    }

    fn removal(&self, dimension: Dimension) -> Result<Removal, StudyError> {
        Ok(match &self.offset {
            None => Removal::Nothing,
            Some(Amount::Text(text)) if text == "auto" => Removal::Found,
            Some(Amount::Text(text)) if !text.contains(|own: char| own.is_ascii_digit()) => {
                let reason = format!("`{text}` is neither `auto` nor a value, such as \"0.3 g\"");
                return Err(StudyError::setting("--offset", reason));
            }
            Some(amount) => Removal::Given(amount.read("--offset", dimension)?),
        })
    }

    fn settings(&self, record: &Record) -> Settings {
        let or = |time: Option<Time>, none: f64| time.map_or(none, |time| time.0);
        let window = (self.from.is_some() || self.to.is_some())
            .then(|| (or(self.from, f64::NEG_INFINITY), or(self.to, f64::INFINITY)));
        Settings {
            is_inverted: self.invert,
            rate: self.rate.filter(|_| record.has_times).map(|rate| rate.0),
            cfc: self.cfc,
            padding: self.padding,
            window,
            approach: self.velocity.map(|velocity| Approach {
                velocity: velocity.0,
                mass: self.mass.map(|mass| mass.0),
                gravity: if self.falls { STANDARD_GRAVITY } else { 0.0 },
                touch: self.touch.map(|touch| touch.0),
            }),
            ..Settings::default()
        }
    }
}

/// Reads the channels of files.
///
/// # Errors
///
/// [`StudyError::Signal`], and what is wrong with the request.
pub fn signal(
    files: &[String],
    request: &SignalRequest,
    context: &mut dyn Context,
) -> Result<Signals, StudyError> {
    let limits: Vec<Stated> = request.limit.iter().flat_map(|limits| limits.0.clone()).collect();
    if request.enforce && limits.is_empty() {
        return Err(StudyError::NoLimits);
    }
    let (mut all, mut notes) = (Vec::new(), Vec::new());
    for (done, (file, stem)) in files.iter().zip(report::stems(files)).enumerate() {
        if context.progress(Progress::Count { done, of: files.len() }).is_break() {
            return Err(StudyError::Ended);
        }
        let record = read::read(file, request, context)?;
        notes.extend(record.notes.iter().map(|note| format!("{}: {note}", record.file)));
        all.extend(signals(request, &record, &stem)?);
    }
    let guided = request.guided.as_ref().map_or(Axis::ALL.to_vec(), |guided| guided.0.clone());
    let signals = Signals { all, limits, guided, is_enforced: request.enforce, notes };
    limits::known(&signals)?;
    signals.guided_are_read()?;
    context.prepare(report::files(&signals))?;
    signals.notes.iter().for_each(|note| context.remark(Remark::Note(note.clone())));
    Ok(signals)
}

/// The channels of a record as they are read.
fn signals(
    request: &SignalRequest,
    record: &Record,
    stem: &str,
) -> Result<Vec<Signal>, StudyError> {
    request.apply_to(record)?;
    let settings = request.settings(record);
    let analyse = |settings: Settings, channel: &Channel| {
        settings.analyse(channel.clone()).map_err(|fault| SignalError::Channel {
            file: record.file.clone(),
            channel: channel.name().to_owned(),
            fault: Box::new(fault),
        })
    };
    // It has an offset and a sign of its own.
    let still = Settings { approach: None, ..settings };
    let displacement = record.displacement.as_ref().map(|own| analyse(still, own)).transpose()?;
    let mut all = Vec::new();
    for own in &record.channels {
        let channel = &own.channel;
        let approach = settings.approach.filter(|_| request.moves(record, own));
        let offset = request.removal(channel.dimension())?;
        let rest = record.rest_beside(own);
        let mut analysis = analyse(Settings { approach, offset, rest, ..settings }, channel)?;
        analysis.part = own.place.clone().map_or(Part::Whole, Part::Axis);
        analysis.beside.clone_from(&own.beside);
        if let Some(displacement) =
            displacement.as_ref().filter(|_| channel.dimension() == Dimension::FORCE)
        {
            analysis.add_work(displacement).map_err(|fault| SignalError::File {
                file: record.file.clone(),
                reason: format!(
                    "`{}` and `{}`: {fault}",
                    channel.name(),
                    displacement.channel.name()
                ),
            })?;
        }
        all.push(analysis);
    }
    let resultants = Analysis::resultants(&mut all);
    let signal =
        |analysis: Analysis| Signal { file: record.file.clone(), stem: stem.to_owned(), analysis };
    Ok(all.into_iter().chain(resultants).map(signal).collect())
}

/// The channels of one name in several files.
struct Group<'s> {
    name: &'s str,
    tests: Vec<&'s Signal>,
}

impl Group<'_> {
    fn analyses(&self) -> Vec<&Analysis> {
        self.tests.iter().map(|own| &own.analysis).collect()
    }
}

impl Signals {
    /// Refuses to guide bodies along what no channel is an axis of.
    fn guided_are_read(&self) -> Result<(), StudyError> {
        let is_read =
            |axis: &Axis| self.all.iter().any(|own| own.analysis.part.axes().contains(axis));
        let missing = self.guided.iter().find(|own| self.guided.len() < 3 && !is_read(own));
        missing.map_or(Ok(()), |axis| {
            let reason = format!(
                "no channel that is read is an axis {0} by its name, as `Head {0}`",
                axis.letter()
            );
            Err(StudyError::setting("--guided", reason))
        })
    }

    /// The channels of the same name, for each name in the order in which it comes.
    fn groups(&self) -> Vec<Group<'_>> {
        let mut groups: Vec<Group<'_>> = Vec::new();
        for own in &self.all {
            let name = own.analysis.channel.name();
            match groups.iter_mut().find(|group| group.name == name) {
                Some(group) => group.tests.push(own),
                None => groups.push(Group { name, tests: vec![own] }),
            }
        }
        groups
    }
}

impl Answer for Signals {
    fn report(&self) -> Report {
        report::report(self)
    }

    fn warnings(&self) -> Vec<String> {
        words::warnings(self)
    }

    fn tables(&self) -> Vec<DataTable<'_>> {
        report::tables(self)
    }

    fn outcome(&self) -> Outcome {
        let is_kept = || self.verdicts().iter().all(Verdict::passes);
        if self.is_enforced && !is_kept() { Outcome::LimitNotKept } else { Outcome::Done }
    }
}

impl Serialize for Signals {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        object::of(self).serialize(serializer)
    }
}

/// The study.
pub(crate) struct ReadSignals;

impl Study for ReadSignals {
    about_study! {
        "signal", SignalRequest,
        Operands::Files("Tables with columns of time and of what was measured; or tests in ISO-MME: an `.mme` file, its folder, or a zip of it"),
        "Reads measured channels: offset, CFC filter, peak, HIC, clips, with the errors of sampling",
        "Examples:\n  \
         dashpot signal drop.csv\n  \
         dashpot signal drop.csv --cfc 180 --offset auto --limit \"acc.hic15<=700\"\n  \
         dashpot signal drop.csv --channel force --out drop\n  \
         dashpot signal logger.csv --units \"s, g\" --channel 2\n\n\
         Between samples a signal is a straight line, and windows are continuous; each number has the error of what samples do \
         not tell, and beside it stands the value on the samples alone. Nothing is filtered and no offset taken off unless asked \
         for.",
        |files, _set, request, context| signal(files, &request, context)?
    }
}
