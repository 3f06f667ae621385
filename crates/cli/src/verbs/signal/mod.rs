//! `dashpot signal`.

mod files;
mod limits;
pub(super) mod mme;
pub(super) mod object;
mod read;
pub(super) mod words;

use std::path::PathBuf;

use clap::Args;
use dashpot_analysis::measures::STANDARD_GRAVITY;
use dashpot_network::parameters::Dimension;
use dashpot_signal::{
    Analysis, Approach, Axis, Cfc, Channel, Padding, Part, Place, Removal, Settings,
};
use serde::Serialize;

use self::{
    limits::{Stated, Verdict},
    read::{MeasuredChannel, Record},
};
use crate::{
    args::{frequency_class, paddings, positive, shift},
    error::{CliError, Status, StudyError},
    folder::{Folder, Staged},
    input::{argument, setting},
    output::{Study, Text, emit},
    progress::Bar,
    terminal::{Terminal, note},
};

/// `signal`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot signal drop.csv\n  \
    dashpot signal drop.csv --cfc 180 --offset auto --limit \"acc.hic15<=700\"\n  \
    dashpot signal drop.csv --channel force --out drop\n  \
    dashpot signal logger.csv --units \"s, g\" --channel 2\n\n\
    Between samples a signal is a straight line, and windows are continuous; each number has the error of what samples do \
    not tell, and beside it stands the value on the samples alone. Nothing is filtered and no offset taken off unless asked \
    for.")]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub(crate) struct SignalArguments {
    /// Tables with columns of time and of what was measured; or tests in ISO-MME: an `.mme` file, its folder, or a zip of it.
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// A channel by the name or the number of its column [default: all accelerations and forces]; repeatable. `acc1=Head X`
    /// says what it is: an axis of a location, or, as `acc1=Head`, all that moves there.
    #[arg(long, value_name = "NAME[=WHAT]")]
    channel: Vec<String>,
    /// Units of the columns where the file says none, in their order: "s, g".
    #[arg(long, value_name = "UNIT,…", value_delimiter = ',')]
    units: Vec<String>,
    /// Sampling rate: of a file without times; or at which the line between its samples is read.
    #[arg(long, value_name = "FREQUENCY", value_parser = |text: &str| positive("rate", text, Dimension::FREQUENCY))]
    rate: Option<f64>,
    /// What is taken off: `auto`, the reading at rest before the pulse, or a value such as "0.3 g".
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    offset: Option<String>,
    /// Turns the signs.
    #[arg(long)]
    invert: bool,
    /// Filters by a channel frequency class of SAE J211: 60, 180, 600 or 1000.
    #[arg(long, value_name = "CLASS", alias = "filter", value_parser = frequency_class)]
    cfc: Option<Cfc>,
    /// What stands beyond the ends of the record for the filter.
    #[arg(long, value_name = "MODE", default_value = "odd", requires = "cfc", value_parser = paddings())]
    padding: String,
    /// Reads the record from this time on, behind the filter.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = shift)]
    from: Option<f64>,
    /// Reads it up to this time.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = shift)]
    to: Option<f64>,
    /// Speed of approach of the body that an accelerometer is on when its contact begins: gives its displacement, its
    /// rebound and the coefficient of restitution. Before, it flies freely. A force needs `--mass` as well: that of a free
    /// striker.
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true, value_parser = speed)]
    velocity: Option<f64>,
    /// Its mass: gives energy taken, returned and absorbed.
    #[arg(long, value_name = "MASS", value_parser = |text: &str| positive("mass", text, Dimension::MASS), requires = "velocity")]
    mass: Option<f64>,
    /// When its contact begins [default: where the record leaves what it reads at rest].
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, requires = "velocity", value_parser = shift)]
    touch: Option<f64>,
    /// It falls: its weight acts along the impact.
    #[arg(long, requires = "velocity")]
    falls: bool,
    /// The rig guides the body along this axis, or in the plane of two, as in `xz`: what those axes say is then all of its
    /// motion. By default limits on the acceleration of a body are judged on the resultant of x, y and z.
    #[arg(long, value_name = "AXES", value_parser = axes)]
    guided: Option<Guided>,
    /// The displacement over which a force does its work, by the name or number of its column [default: the only
    /// one of the file].
    #[arg(long, value_name = "NAME")]
    displacement: Option<String>,
    /// A limit such as "acc.hic15<=700", "acc.peak<=250 g" or "acc.peak=en-1078" (`dashpot list limits`); repeatable.
    #[arg(long, value_name = "LIMIT", value_parser = limits::parse)]
    limit: Vec<limits::Parsed>,
    /// Ends with exit code 4 unless every limit is kept for certain.
    #[arg(long)]
    enforce: bool,
    /// Folder for CSV, JSON, SVG and report.html with all on one page; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

/// Axes along which a body may move.
#[derive(Debug, Clone)]
struct Guided(Vec<Axis>);

fn axes(text: &str) -> Result<Guided, String> {
    let found: Option<Vec<Axis>> = text.trim().chars().map(Axis::of).collect();
    let found = found.filter(|own| (1..Axis::ALL.len()).contains(&own.len()));
    let found = found.filter(|own| own.first() != own.get(1));
    found
        .map(Guided)
        .ok_or_else(|| "it is one axis or two of x, y and z, as in `z` or `xz`".to_owned())
}

fn speed(text: &str) -> Result<f64, String> {
    let value = argument("velocity", text, Dimension::VELOCITY)?;
    let why = "it must be positive: it is that along the impact, whichever way the peak points";
    if value > 0.0 { Ok(value) } else { Err(why.to_owned()) }
}

/// A channel of a file as it was read.
struct Signal {
    /// Its file, and what files of results are named by.
    file: String,
    stem: String,
    analysis: Analysis,
}

/// What some files say.
struct Signals {
    all: Vec<Signal>,
    limits: Vec<Stated>,
    /// Along which axes bodies may move.
    guided: Vec<Axis>,
    notes: Vec<String>,
}

impl SignalArguments {
    /// Refuses what says something of a channel that the record does not have.
    fn apply_to(&self, record: &Record) -> Result<(), CliError> {
        let wrong = |name: &str, reason: String| {
            let reason = format!("`{}`: {reason}", record.file);
            Err(StudyError::WrongSetting { name: name.to_owned(), reason }.into())
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

    fn removal(&self, dimension: Dimension) -> Result<Removal, CliError> {
        Ok(match self.offset.as_deref().map(str::trim) {
            None => Removal::Nothing,
            Some("auto") => Removal::Found,
            Some(text) if !text.contains(|own: char| own.is_ascii_digit()) => {
                let reason = format!("`{text}` is neither `auto` nor a value, such as \"0.3 g\"");
                return Err(CliError::setting("--offset", reason));
            }
            Some(text) => Removal::Given(setting("--offset", text, dimension)?),
        })
    }

    fn settings(&self, record: &Record) -> Settings {
        let window = (self.from.is_some() || self.to.is_some())
            .then(|| (self.from.unwrap_or(f64::NEG_INFINITY), self.to.unwrap_or(f64::INFINITY)));
        let padding = Padding::ALL.into_iter().find(|own| own.words()[0] == self.padding);
        Settings {
            is_inverted: self.invert,
            rate: self.rate.filter(|_| record.has_times),
            cfc: self.cfc,
            padding: padding.unwrap_or_default(),
            window,
            approach: self.velocity.map(|velocity| Approach {
                velocity,
                mass: self.mass,
                gravity: if self.falls { STANDARD_GRAVITY } else { 0.0 },
                touch: self.touch,
            }),
            ..Settings::default()
        }
    }
}

/// Reads files.
pub(crate) fn signal(arguments: &SignalArguments, terminal: Terminal) -> Result<Status, CliError> {
    let limits: Vec<Stated> = arguments.limit.iter().flat_map(|own| own.0.clone()).collect();
    if arguments.enforce && limits.is_empty() {
        return Err(CliError::NoLimits);
    }
    let stems = files::stems(&arguments.files);
    let (mut all, mut notes) = (Vec::new(), Vec::new());
    let mut bar = Bar::new("signal", 0.0, terminal.error.attended);
    for (at, (path, stem)) in arguments.files.iter().zip(stems).enumerate() {
        if bar.count(at, arguments.files.len()).is_break() {
            return Err(StudyError::Ended.into());
        }
        let record = read::read(path, arguments)?;
        notes.extend(record.notes.iter().map(|own| format!("{}: {own}", record.file)));
        all.extend(signals(arguments, &record, &stem)?);
    }
    let guided = arguments.guided.as_ref().map_or(Axis::ALL.to_vec(), |own| own.0.clone());
    let signals = Signals { all, limits, guided, notes };
    limits::known(&signals)?;
    signals.guided_are_read()?;
    let folder = Folder::wanted(arguments.out.as_deref(), files::names(&signals))?;
    signals.notes.iter().for_each(|own| note(own));
    let is_kept = signals.verdicts().iter().all(Verdict::passes);
    emit(&signals, arguments.json, folder, terminal)?;
    Ok(if arguments.enforce && !is_kept { Status::LimitNotKept } else { Status::Done })
}

/// The channels of a record as they are read.
fn signals(
    arguments: &SignalArguments,
    record: &Record,
    stem: &str,
) -> Result<Vec<Signal>, CliError> {
    arguments.apply_to(record)?;
    let settings = arguments.settings(record);
    let analyse = |settings: Settings, channel: &Channel| {
        settings.analyse(channel.clone()).map_err(|fault| CliError::Signal {
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
        let approach = settings.approach.filter(|_| arguments.moves(record, own));
        let offset = arguments.removal(channel.dimension())?;
        let rest = record.rest_beside(own);
        let mut analysis = analyse(Settings { approach, offset, rest, ..settings }, channel)?;
        analysis.part = own.place.clone().map_or(Part::Whole, Part::Axis);
        analysis.beside.clone_from(&own.beside);
        if let Some(displacement) =
            displacement.as_ref().filter(|_| channel.dimension() == Dimension::FORCE)
        {
            analysis.add_work(displacement).map_err(|fault| CliError::SignalFile {
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
    fn guided_are_read(&self) -> Result<(), CliError> {
        let is_read =
            |axis: &Axis| self.all.iter().any(|own| own.analysis.part.axes().contains(axis));
        let missing = self.guided.iter().find(|own| self.guided.len() < 3 && !is_read(own));
        missing.map_or(Ok(()), |axis| {
            let reason = format!(
                "no channel that is read is an axis {0} by its name, as `Head {0}`",
                axis.letter()
            );
            Err(StudyError::WrongSetting { name: "--guided".to_owned(), reason }.into())
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

impl Study for Signals {
    fn text(&self, text: &mut Text) {
        words::text(self, text);
    }

    fn object(&self) -> impl Serialize {
        object::of(self)
    }

    fn warnings(&self) -> Vec<String> {
        words::warnings(self)
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}
