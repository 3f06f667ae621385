//! Which columns of a file are times and channels.

use dashpot_network::parameters::Dimension;
use dashpot_scene::{DataTable, LeftOut, TableError, table_text, units::parse_quantity};
use dashpot_signal::{
    Channel, Label, Offset, Place, Places,
    iso_mme::{ChannelCode, MmeChannel},
};

use super::{SignalError, SignalRequest, mme};
use crate::{Context, StudyError};

/// What is measured in impact tests, in the order in which it is looked for.
const MEASURED: [Dimension; 2] = [Dimension::ACCELERATION, Dimension::FORCE];
/// What is read as well, where nothing of that is there.
const OTHERS: [Dimension; 3] = [Dimension::VELOCITY, Dimension::LENGTH, Dimension::PRESSURE];

/// The channels of a file.
pub(super) struct Record {
    pub(super) file: String,
    pub(super) channels: Vec<MeasuredChannel>,
    /// The displacement over which forces do work, where it is asked for, or there is one alone.
    pub(super) displacement: Option<Channel>,
    /// Whether the file says when its samples are.
    pub(super) has_times: bool,
    pub(super) notes: Vec<String>,
}

/// A channel that is read.
pub(super) struct MeasuredChannel {
    pub(super) channel: Channel,
    /// Where it is, where it is one axis.
    pub(super) place: Option<Place>,
    /// Channels of the file that may hold more of the motion of the same body, and form no resultant with it.
    pub(super) beside: Vec<String>,
}

impl Record {
    /// When an axis is at rest \[s\]: before the pulse of that one of its location with the highest peak. One across the impact
    /// has no pulse that tells it.
    pub(super) fn rest_beside(&self, own: &MeasuredChannel) -> Option<(f64, f64)> {
        let place = own.place.as_ref()?;
        let is_beside = |other: &&MeasuredChannel| {
            other.place.as_ref().is_some_and(|other| other.is_beside(place))
        };
        let axes = self.channels.iter().filter(is_beside).map(|own| &own.channel);
        let highest = axes.max_by(|one, other| one.largest().1.total_cmp(&other.largest().1))?;
        Some(Offset::before_pulse(highest)?.window)
    }
}

/// A column of a table, or a channel of a test.
struct Column {
    name: String,
    code: Option<ChannelCode>,
    /// Its unit, as a table says it or it is given.
    unit: Option<String>,
    /// What it measures; `None` where its unit is not known.
    dimension: Option<Dimension>,
    /// The filter that it went through before.
    filter: Option<String>,
}

/// A file that is being read.
struct Source<'r, 't> {
    file: &'r str,
    columns: Vec<Column>,
    samples: Samples<'t>,
}

enum Samples<'t> {
    /// A table, the column of its times, and else the step between them.
    Table { table: DataTable<'t>, time: Option<usize>, step: f64 },
    /// The channels of a test.
    Test(Vec<MmeChannel>),
}

/// A column that is chosen, with the name that it was given.
type Chosen = (usize, Option<String>);

/// Reads a file.
pub(super) fn read(
    file: &str,
    wanted: &SignalRequest,
    context: &dyn Context,
) -> Result<Record, StudyError> {
    if mme::is_one(file, context) {
        if !wanted.units.is_empty() {
            return Err(no_units(file));
        }
        let all = mme::read(file, context)?;
        let columns = all.iter().map(Column::of_test).collect();
        let source = Source { file, columns, samples: Samples::Test(all) };
        return source.record(wanted, Vec::new());
    }
    let unreadable = |reason| SignalError::File {
        file: file.to_owned(),
        reason: format!("it cannot be read: {reason}"),
    };
    let bytes = context.load(file).map_err(unreadable)?;
    let text = table_text(&bytes);
    let table = DataTable::read(&text).map_err(|fault| in_table(file, fault))?;
    let notes = LeftOut::of(&table).map(|own| own.to_string()).into_iter().collect();
    units_are_wanted(file, &table, &wanted.units)?;
    let columns: Vec<Column> =
        (0..table.columns()).map(|at| Column::of_table(&table, at, &wanted.units)).collect();
    let time = columns.iter().position(|own| own.dimension == Some(Dimension::TIME));
    let step = wanted.rate.map_or(1.0, |rate| rate.0.recip());
    let source = Source { file, columns, samples: Samples::Table { table, time, step } };
    if time.is_none() && wanted.rate.is_none() {
        return Err(source.unclear(format!(
            "no column has a unit of time: there are {}; say the units of all columns, `--units \"s, g\"`, or \
             `--rate \"20 kHz\"` where the file has no times",
            source.names()
        )));
    }
    source.record(wanted, notes)
}

/// `--units` of a file that says them all.
fn no_units(file: &str) -> StudyError {
    let reason = format!("`{file}` says the units of all its channels");
    StudyError::setting("--units", reason)
}

fn in_table(file: &str, fault: TableError) -> StudyError {
    StudyError::MeasuredTable { file: file.to_owned(), fault: Box::new(fault) }
}

/// Refuses units of columns that say another one, or that are not there, and of a file that says them all.
fn units_are_wanted(file: &str, table: &DataTable<'_>, units: &[String]) -> Result<(), StudyError> {
    let count = table.columns();
    let given = units.iter().map(|own| own.trim()).enumerate();
    for (at, given) in given.filter(|own| !own.1.is_empty()) {
        let said = (at < count).then(|| table.heading(at));
        let reason = match said.map(|own| (own.name, own.unit)) {
            None => format!("`{given}` is for column {}, and there are {count}", at + 1),
            Some((name, Some(unit))) if unit != given => {
                format!("the file says `{unit}` of `{name}`, not `{given}`: leave its place empty")
            }
            Some(_) => continue,
        };
        let reason = format!("`{file}`: {reason}");
        return Err(StudyError::setting("--units", reason));
    }
    let is_known = (0..count).all(|at| table.heading(at).unit.is_some());
    if is_known && !units.is_empty() { Err(no_units(file)) } else { Ok(()) }
}

/// One of a unit in SI units, where it is of this dimension.
fn one(unit: &str, dimension: Dimension) -> Option<f64> {
    let one = parse_quantity(&format!("1 {unit}")).ok()?.meant(dimension);
    (one.dimension == Some(dimension)).then_some(one.value)
}

impl Column {
    fn of_table(table: &DataTable<'_>, at: usize, units: &[String]) -> Self {
        let heading = table.heading(at);
        let given = units.get(at).map(|own| own.trim()).filter(|own| !own.is_empty());
        let unit = heading.unit.or(given).map(str::to_owned);
        let name =
            if heading.name.is_empty() { (at + 1).to_string() } else { heading.name.to_owned() };
        // `g` is standard gravity here.
        let all = MEASURED.into_iter().chain(OTHERS).chain([Dimension::TIME]);
        let known =
            unit.as_ref().and_then(|unit| all.into_iter().find(|own| one(unit, *own).is_some()));
        let other = || parse_quantity(&format!("1 {}", unit.as_ref()?)).ok()?.dimension;
        Self { dimension: known.or_else(other), name, code: None, unit, filter: None }
    }

    fn of_test(own: &MmeChannel) -> Self {
        let class = own.code.as_ref().and_then(ChannelCode::filter_class);
        Self {
            name: own.channel.name().to_owned(),
            code: own.code.clone(),
            unit: None,
            dimension: Some(own.channel.dimension()),
            filter: class.map(|class| format!("CFC {class}")).or_else(|| own.prefilter.clone()),
        }
    }
}

impl Source<'_, '_> {
    fn unclear(&self, reason: String) -> StudyError {
        SignalError::File { file: self.file.to_owned(), reason }.into()
    }

    /// The columns, with the units of a table, for messages.
    fn names(&self) -> String {
        let is_table = matches!(self.samples, Samples::Table { .. });
        let one = |own: &Column| match &own.unit {
            Some(unit) => format!("`{}` in `{unit}`", own.name),
            None if is_table => format!("`{}` without a unit", own.name),
            None => format!("`{}`", own.name),
        };
        self.columns.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// The channels that are wanted, or all accelerations and forces, with what stands beside them.
    fn record(&self, wanted: &SignalRequest, mut notes: Vec<String>) -> Result<Record, StudyError> {
        let chosen = if wanted.channel.is_empty() {
            self.measured()?
        } else {
            wanted.channel.iter().map(|own| self.wanted(&own.0)).collect::<Result<_, _>>()?
        };
        let mut channels = Vec::new();
        for (at, name) in &chosen {
            let own = &self.columns[*at];
            let (place, beside) = placed(&self.columns, &chosen, *at);
            let channel = self.channel(*at, name.as_deref().unwrap_or(&own.name))?;
            channels.push(MeasuredChannel { channel, place, beside });
            let note = |filter| format!("`{}` was filtered before: {filter}", own.name);
            notes.extend(own.filter.as_ref().map(note));
        }
        let lengths = of(&self.columns, &[Dimension::LENGTH]);
        let displacement = match (&wanted.displacement, &lengths[..]) {
            (Some(name), _) => Some(self.wanted(name)?.0),
            (None, [(alone, _)]) => Some(*alone),
            (None, _) => None,
        };
        if displacement.is_some_and(|at| self.columns[at].dimension != Some(Dimension::LENGTH)) {
            let name = wanted.displacement.as_deref().unwrap_or_default();
            let reason = format!("`{name}` is no displacement: its unit is no length");
            return Err(self.unclear(reason));
        }
        let has_force = channels.iter().any(|own| own.channel.dimension() == Dimension::FORCE);
        let displacement = displacement.filter(|_| has_force);
        let displacement =
            displacement.map(|at| self.channel(at, &self.columns[at].name)).transpose()?;
        let has_times = !matches!(self.samples, Samples::Table { time: None, .. });
        Ok(Record { file: self.file.to_owned(), channels, displacement, has_times, notes })
    }

    /// What there is of accelerations and forces, or else of other things.
    fn measured(&self) -> Result<Vec<Chosen>, StudyError> {
        let [measured, others] = [of(&self.columns, &MEASURED), of(&self.columns, &OTHERS)];
        match self.samples {
            _ if !measured.is_empty() => Ok(measured),
            Samples::Test(_) => Ok((0..self.columns.len()).map(|at| (at, None)).collect()),
            Samples::Table { .. } if !others.is_empty() => Ok(others),
            Samples::Table { .. } => Err(self.unclear(format!(
                "no column is an acceleration or a force: there are {}; write the units into the file, `force [kN]`, or \
                 say them: `--units \"s, kN\"`",
                self.names()
            ))),
        }
    }

    /// A column by its name, code or number, and the name that it is given behind `=`.
    fn wanted(&self, text: &str) -> Result<Chosen, StudyError> {
        let (name, given) = match text.rsplit_once('=') {
            Some((name, given)) if self.find(text).is_err() => (name.trim(), Some(given.trim())),
            _ => (text.trim(), None),
        };
        let at = self.find(name)?;
        let own = &self.columns[at];
        let reason = match (&own.unit, own.dimension) {
            (_, Some(Dimension::TIME)) => format!("`{name}` is the column of times"),
            (_, Some(_)) => return Ok((at, given.map(str::to_owned))),
            (None, None) => format!(
                "`{name}` has no unit: write it into the file, as in `{name} [kN]`, or say the units of all columns: \
                 `--units \"s, kN\"`"
            ),
            (Some(unit), None) => format!("`{unit}` of `{name}` is no unit that can be read"),
        };
        Err(self.unclear(reason))
    }

    fn find(&self, name: &str) -> Result<usize, StudyError> {
        let is_it = |own: &Column| {
            own.name == name || own.code.as_ref().is_some_and(|code| code.text() == name)
        };
        let all: Vec<usize> =
            (0..self.columns.len()).filter(|at| is_it(&self.columns[*at])).collect();
        let number = name.parse::<usize>().ok().and_then(|own| own.checked_sub(1));
        match (&all[..], number.filter(|own| *own < self.columns.len())) {
            ([one], _) => Ok(*one),
            ([], Some(one)) => Ok(one),
            ([], None) => {
                Err(self
                    .unclear(format!("there is no column `{name}`: there are {}", self.names())))
            }
            _ => Err(self.unclear(format!("several columns are `{name}`: name one by its number"))),
        }
    }

    fn channel(&self, at: usize, name: &str) -> Result<Channel, StudyError> {
        let (table, time, step) = match &self.samples {
            Samples::Table { table, time, step } => (table, *time, *step),
            Samples::Test(all) => return Ok(all[at].channel.clone().named(name)),
        };
        let dimension = self.columns[at].dimension.unwrap_or(Dimension::NUMBER);
        let values = |at: usize, dimension: Dimension| {
            let values = table.column(at, dimension).map_err(|own| in_table(self.file, own))?;
            let given = self.columns[at].unit.as_ref().filter(|_| table.heading(at).unit.is_none());
            let factor = given.and_then(|unit| one(unit, dimension)).unwrap_or(1.0);
            Ok::<_, StudyError>(values.into_iter().map(|own| own * factor).collect::<Vec<_>>())
        };
        let (of_time, values) =
            (time.map(|at| values(at, Dimension::TIME)), values(at, dimension)?);
        let even = || Ok((0..values.len()).map(|at| at as f64 * step).collect());
        let times = of_time.unwrap_or_else(even)?;
        Channel::new(name, dimension, times, values).map_err(|fault| {
            let line = fault.sample().and_then(|at| table.lines().get(at).copied());
            let (file, channel, fault) = (self.file.to_owned(), name.to_owned(), Box::new(fault));
            SignalError::Samples { file, line, channel, fault }.into()
        })
    }
}

/// The columns of some dimensions.
fn of(columns: &[Column], dimensions: &[Dimension]) -> Vec<Chosen> {
    let is_one = |own: &Column| own.dimension.is_some_and(|own| dimensions.contains(&own));
    let all = columns.iter().enumerate().filter(|own| is_one(own.1));
    all.map(|own| (own.0, None)).collect()
}

/// Where a column is, among those of the same quantity, and what may be further axes of the same body: of axes of its
/// location those that are not read.
fn placed(columns: &[Column], chosen: &[Chosen], at: usize) -> (Option<Place>, Vec<String>) {
    let like: Vec<usize> =
        (0..columns.len()).filter(|own| columns[*own].dimension == columns[at].dimension).collect();
    let chosen = |at: usize| chosen.iter().find(|own| own.0 == at);
    let given = |at: usize| chosen(at).and_then(|own| own.1.as_deref());
    let label = |at: &usize| Label {
        name: given(*at).unwrap_or(&columns[*at].name),
        code: columns[*at].code.as_ref().filter(|_| given(*at).is_none()),
        is_declared: given(*at).is_some(),
    };
    let labels: Vec<Label<'_>> = like.iter().map(label).collect();
    let places = Places::of(&labels);
    let Some(own) = like.iter().position(|other| *other == at) else { return (None, Vec::new()) };
    let is_apart = |other: &usize| {
        let are_axes = places.get(own).is_some() && places.get(*other).is_some();
        !(are_axes && chosen(like[*other]).is_some())
    };
    let beside = places.beside(own).into_iter().filter(is_apart);
    (places.get(own).cloned(), beside.map(|other| labels[other].name.to_owned()).collect())
}
