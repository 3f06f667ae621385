//! Which columns of a file are times and channels.

use std::path::Path;

use dashpot_network::parameters::Dimension;
use dashpot_scene::{DataTable, LeftOut, TableError, table_text, units::parse_quantity};
use dashpot_signal::{
    Channel, Offset, Place,
    iso_mme::{ChannelCode, MmeChannel},
};

use super::mme;
use crate::{
    error::{CliError, reason},
    input::bytes_of,
};

/// What is measured in impact tests, in the order in which it is looked for.
const MEASURED: [Dimension; 2] = [Dimension::ACCELERATION, Dimension::FORCE];
/// What is read as well, where nothing of that is there.
const OTHERS: [Dimension; 3] = [Dimension::VELOCITY, Dimension::LENGTH, Dimension::PRESSURE];

/// The channels of a file.
pub(super) struct Record {
    pub(super) file: String,
    pub(super) channels: Vec<Channel>,
    /// Where each of them is, where it is one axis.
    pub(super) places: Vec<Option<Place>>,
    /// The displacement over which forces do work, where it is asked for, or there is one alone.
    pub(super) displacement: Option<Channel>,
    /// Whether the file says when its samples are.
    pub(super) has_times: bool,
    pub(super) notes: Vec<String>,
}

impl Record {
    /// When an axis is at rest \[s\]: before the pulse of that one of its location with the highest peak. One across the blow
    /// has no pulse that tells it.
    pub(super) fn rest_beside(&self, at: usize) -> Option<(f64, f64)> {
        let place = self.places.get(at)?.as_ref()?;
        let is_beside = |own: &(&Channel, &Option<Place>)| {
            own.1.as_ref().is_some_and(|own| own.is_beside(place))
        };
        let axes = self.channels.iter().zip(&self.places).filter(is_beside);
        let height = |own: &Channel| own.largest().1;
        let highest = axes.max_by(|one, other| height(one.0).total_cmp(&height(other.0)))?;
        Some(Offset::before_pulse(highest.0)?.window)
    }
}

/// What is wanted of a file.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// Names or numbers of columns.
    pub(super) channels: &'a [String],
    /// Units of columns that say none.
    pub(super) units: &'a [String],
    pub(super) rate: Option<f64>,
    pub(super) displacement: Option<&'a str>,
}

/// A file that is being read.
struct Reading<'r, 't> {
    file: &'r str,
    table: DataTable<'t>,
    units: &'r [String],
}

/// Reads a file.
pub(super) fn read(path: &Path, wanted: &Wanted<'_>) -> Result<Record, CliError> {
    let Wanted { units, rate, .. } = *wanted;
    let file = path.to_string_lossy().into_owned();
    if mme::is_one(path) {
        if !units.is_empty() {
            return Err(no_units(&file));
        }
        return of_test(&file, &mme::read(path)?, wanted);
    }
    let unreadable = |reason: String| CliError::SignalFile { file: file.clone(), reason };
    let bytes = bytes_of(path)
        .map_err(|error| unreadable(format!("it cannot be read: {}", reason(&error))))?;
    let text = table_text(&bytes);
    let table = DataTable::read(&text).map_err(|fault| in_table(&file, fault))?;
    let notes = LeftOut::of(&table).map(|own| own.to_string()).into_iter().collect();
    let reading = Reading { file: &file, table, units };
    reading.units_are_wanted()?;
    let time = reading.time_column(rate.is_some())?;
    let columns = reading.channels(wanted.channels, time)?;
    let places = columns.iter().map(|own| reading.place(*own, time)).collect();
    let mut channels = Vec::new();
    for (column, dimension) in columns {
        channels.push(reading.channel(time, rate, column, dimension)?);
    }
    let has_force = channels.iter().any(|own| own.dimension() == Dimension::FORCE);
    let displacement = reading.displacement(wanted.displacement, time)?.filter(|_| has_force);
    let displacement = displacement
        .map(|column| reading.channel(time, rate, column, Dimension::LENGTH))
        .transpose()?;
    drop(reading);
    Ok(Record { file, channels, places, displacement, has_times: time.is_some(), notes })
}

/// The channels of a test in ISO-MME, by their names, codes or numbers.
fn of_test(file: &str, all: &[MmeChannel], wanted: &Wanted<'_>) -> Result<Record, CliError> {
    let is_it = |own: &MmeChannel, name: &str| {
        own.channel.name() == name || own.code.as_ref().is_some_and(|code| code.text() == name)
    };
    let find = |name: &str| {
        let by_name = all.iter().find(|own| is_it(own, name.trim()));
        let number = name.trim().parse::<usize>().ok().and_then(|own| own.checked_sub(1));
        by_name.or(number.and_then(|at| all.get(at))).ok_or_else(|| {
            let names: Vec<String> =
                all.iter().map(|own| format!("`{}`", own.channel.name())).collect();
            let reason = format!("there is no channel `{name}`: there are {}", names.join(", "));
            CliError::SignalFile { file: file.to_owned(), reason }
        })
    };
    let of = |dimensions: &[Dimension]| -> Vec<&MmeChannel> {
        all.iter().filter(|own| dimensions.contains(&own.channel.dimension())).collect()
    };
    let chosen: Vec<&MmeChannel> = if wanted.channels.is_empty() {
        let measured = of(&MEASURED);
        if measured.is_empty() { all.iter().collect() } else { measured }
    } else {
        wanted.channels.iter().map(|own| find(own)).collect::<Result<_, _>>()?
    };
    let notes = chosen.iter().filter_map(|own| {
        let class = own.code.as_ref().and_then(ChannelCode::filter_class);
        let before = class.map(|class| format!("CFC {class}")).or(own.prefilter.clone())?;
        Some(format!("`{}` was filtered before: {before}", own.channel.name()))
    });
    let displacement = match wanted.displacement {
        Some(name) => Some(find(name)?.channel.clone()),
        None => match of(&[Dimension::LENGTH])[..] {
            [alone] => Some(alone.channel.clone()),
            _ => None,
        },
    };
    let place = |own: &&MmeChannel| {
        let like = of(&[own.channel.dimension()]);
        let names: Vec<_> =
            like.iter().map(|own| (own.channel.name(), own.code.as_ref())).collect();
        let at = like.iter().position(|other| std::ptr::eq(*other, *own))?;
        Place::of_channels(&names).swap_remove(at)
    };
    Ok(Record {
        notes: notes.collect(),
        places: chosen.iter().map(place).collect(),
        channels: chosen.iter().map(|own| own.channel.clone()).collect(),
        displacement,
        has_times: true,
        file: file.to_owned(),
    })
}

/// `--units` of a file that says them all.
fn no_units(file: &str) -> CliError {
    let reason = format!("`{file}` says the units of all its channels");
    CliError::WrongSetting { name: "--units".to_owned(), reason }
}

fn in_table(file: &str, fault: TableError) -> CliError {
    CliError::MeasuredTable { file: file.to_owned(), fault: Box::new(fault) }
}

impl Reading<'_, '_> {
    fn unclear(&self, reason: String) -> CliError {
        CliError::SignalFile { file: self.file.to_owned(), reason }
    }

    /// The name of a column, or its number.
    fn name(&self, column: usize) -> String {
        match self.table.heading(column).name {
            "" => (column + 1).to_string(),
            name => name.to_owned(),
        }
    }

    /// Where a channel is, by its name among those of the same quantity.
    fn place(&self, (column, dimension): (usize, Dimension), time: Option<usize>) -> Option<Place> {
        let columns = (0..self.table.columns()).filter(|at| Some(*at) != time);
        let like: Vec<usize> = columns.filter(|at| self.is_of(*at, dimension)).collect();
        let names: Vec<String> = like.iter().map(|at| self.name(*at)).collect();
        let names: Vec<_> = names.iter().map(|own| (&**own, None)).collect();
        let at = like.iter().position(|own| *own == column)?;
        Place::of_channels(&names).swap_remove(at)
    }

    /// Refuses units of columns that say another one, or that are not there, and of a file that says them all.
    fn units_are_wanted(&self) -> Result<(), CliError> {
        let said = |at: usize| (at < self.table.columns()).then(|| self.table.heading(at).unit);
        let given = self.units.iter().map(|own| own.trim()).enumerate();
        for (at, given) in given.filter(|own| !own.1.is_empty()) {
            let reason = match said(at) {
                None => format!(
                    "`{given}` is for column {}, and there are {}",
                    at + 1,
                    self.table.columns()
                ),
                Some(Some(unit)) if unit != given => {
                    format!(
                        "the file says `{unit}` of `{}`, not `{given}`: leave its place empty",
                        self.name(at)
                    )
                }
                Some(_) => continue,
            };
            let reason = format!("`{}`: {reason}", self.file);
            return Err(CliError::WrongSetting { name: "--units".to_owned(), reason });
        }
        let is_known = (0..self.table.columns()).all(|at| self.table.heading(at).unit.is_some());
        if is_known && !self.units.is_empty() { Err(no_units(self.file)) } else { Ok(()) }
    }

    /// The unit of a column: that of the file, or the one given.
    fn unit(&self, column: usize) -> Option<&str> {
        let given = self.units.get(column).map(|own| own.trim()).filter(|own| !own.is_empty());
        self.table.heading(column).unit.or(given)
    }

    /// Whether a column is in a unit of this dimension.
    fn is_of(&self, column: usize, dimension: Dimension) -> bool {
        self.one(column, dimension).is_some()
    }

    /// One of a column's unit in SI units, where it is of this dimension.
    fn one(&self, column: usize, dimension: Dimension) -> Option<f64> {
        let one = parse_quantity(&format!("1 {}", self.unit(column)?)).ok()?.meant(dimension);
        (one.dimension == Some(dimension)).then_some(one.value)
    }

    fn time_column(&self, has_rate: bool) -> Result<Option<usize>, CliError> {
        let mut all = (0..self.table.columns()).filter(|&at| self.is_of(at, Dimension::TIME));
        if let Some(first) = all.next() {
            return Ok(Some(first));
        }
        if has_rate {
            return Ok(None);
        }
        let columns = self.columns();
        Err(self.unclear(format!(
            "no column has a unit of time: there are {columns}; say the units of all columns, `--units \"s, g\"`, or \
             `--rate \"20 kHz\"` where the file has no times"
        )))
    }

    /// The columns with their units, for messages.
    fn columns(&self) -> String {
        let one = |at: usize| match self.unit(at) {
            Some(unit) => format!("`{}` in `{unit}`", self.name(at)),
            None => format!("`{}` without a unit", self.name(at)),
        };
        let all: Vec<String> = (0..self.table.columns()).map(one).collect();
        all.join(", ")
    }

    /// The columns that are asked for, or all accelerations and forces.
    fn channels(
        &self,
        wanted: &[String],
        time: Option<usize>,
    ) -> Result<Vec<(usize, Dimension)>, CliError> {
        if !wanted.is_empty() {
            return wanted.iter().map(|own| self.wanted(own, time)).collect();
        }
        for dimensions in [&MEASURED[..], &OTHERS[..]] {
            let of = |at: usize| {
                let found = dimensions.iter().find(|own| self.is_of(at, **own));
                found.map(|own| (at, *own))
            };
            let all = (0..self.table.columns()).filter(|at| Some(*at) != time);
            let found: Vec<_> = all.filter_map(of).collect();
            if !found.is_empty() {
                return Ok(found);
            }
        }
        let columns = self.columns();
        Err(self.unclear(format!(
            "no column is an acceleration or a force: there are {columns}; write the units into the file, \
             `force [kN]`, or say them: `--units \"s, kN\"`"
        )))
    }

    fn wanted(&self, name: &str, time: Option<usize>) -> Result<(usize, Dimension), CliError> {
        let count = self.table.columns();
        let by_number = name.trim().parse::<usize>().ok().and_then(|own| own.checked_sub(1));
        let column = match self.table.position(name) {
            Ok(column) => column,
            Err(fault) => match by_number.filter(|own| *own < count) {
                Some(column) => column,
                None if by_number.is_some() => return Err(in_table(self.file, fault)),
                None => {
                    let columns = self.columns();
                    return Err(self.unclear(format!("{}: there are {columns}", fault.fault)));
                }
            },
        };
        if Some(column) == time {
            return Err(self.unclear(format!("`{name}` is the column of times")));
        }
        let Some(unit) = self.unit(column) else {
            return Err(self.unclear(format!(
                "`{name}` has no unit: write it into the file, as in `{name} [kN]`, or say the units of all columns: \
                 `--units \"s, kN\"`"
            )));
        };
        // `g` is standard gravity here.
        let known = MEASURED.into_iter().chain(OTHERS).find(|own| self.is_of(column, *own));
        let dimension = known.or_else(|| parse_quantity(&format!("1 {unit}")).ok()?.dimension);
        let Some(dimension) = dimension else {
            return Err(self.unclear(format!("`{unit}` of `{name}` is no unit that can be read")));
        };
        Ok((column, dimension))
    }

    /// The column of displacements: the one that is asked for, or the only one.
    fn displacement(
        &self,
        wanted: Option<&str>,
        time: Option<usize>,
    ) -> Result<Option<usize>, CliError> {
        if let Some(name) = wanted {
            let (column, dimension) = self.wanted(name, time)?;
            return if dimension == Dimension::LENGTH {
                Ok(Some(column))
            } else {
                Err(self.unclear(format!("`{name}` is no displacement: its unit is no length")))
            };
        }
        let mut all = (0..self.table.columns()).filter(|&at| self.is_of(at, Dimension::LENGTH));
        let first = all.next();
        Ok(first.filter(|_| all.next().is_none()))
    }

    fn values(&self, column: usize, dimension: Dimension) -> Result<Vec<f64>, CliError> {
        let values =
            self.table.column(column, dimension).map_err(|own| in_table(self.file, own))?;
        if self.table.heading(column).unit.is_some() {
            return Ok(values);
        }
        let one = self.one(column, dimension).unwrap_or(1.0);
        Ok(values.into_iter().map(|own| own * one).collect())
    }

    fn channel(
        &self,
        time: Option<usize>,
        rate: Option<f64>,
        column: usize,
        dimension: Dimension,
    ) -> Result<Channel, CliError> {
        let values = self.values(column, dimension)?;
        let times = match (time, rate) {
            (Some(time), _) => self.values(time, Dimension::TIME)?,
            (None, rate) => {
                let step = rate.map_or(1.0, f64::recip);
                (0..values.len()).map(|at| at as f64 * step).collect()
            }
        };
        let name = self.name(column);
        Channel::new(&name, dimension, times, values).map_err(|fault| {
            let line = fault.sample().and_then(|at| self.table.lines().get(at).copied());
            let fault = Box::new(fault);
            CliError::SignalSamples { file: self.file.to_owned(), line, channel: name, fault }
        })
    }
}
