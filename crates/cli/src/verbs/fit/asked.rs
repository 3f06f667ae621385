//! What is fitted to what: `--to "relax.csv:G=felt"`, and the records in the files.

use std::fmt::Display;

use dashpot_fit::linear::Record;
use dashpot_network::parameters::Dimension;
use dashpot_scene::{DataTable, Tunables};
use dashpot_signal::Cfc;

use super::{pressed::times, target::is_output};
use crate::{
    args::{share, single},
    error::CliError,
    input::setting,
    output::list,
    varied::Varied,
};
use dashpot_studies::assignment;
use dashpot_studies::measured::MeasuredFile;

/// The option, for messages.
pub(super) const FLAG: &str = "--to";
/// Signs before a standard deviation.
const SCATTER: [&str; 2] = ["±", "+-"];
/// Rows that differ by no more are of one temperature \[K\].
const ONE_TEMPERATURE: f64 = 2.0;
/// A compliance of a material, 1/Pa.
const MATERIAL_COMPLIANCE: Dimension = Dimension::new(-1, 1, 2);

/// One `--to`.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    /// As it was written.
    pub(super) text: String,
    pub(super) file: String,
    /// The columns that answered, by name or symbol.
    columns: Vec<String>,
    /// A model, or an output of a scene.
    pub(super) target: String,
    /// What is set for this test alone.
    set: Vec<(String, String)>,
    /// How it was recorded, where that is said of this test alone.
    pub(super) cfc: Option<Cfc>,
    pub(super) gain: Option<f64>,
    pub(super) noise: Option<String>,
    /// How fast a model alone was pressed, where the file has no times.
    pub(super) rate: Option<String>,
    /// What the columns are multiplied by.
    pub(super) scale: f64,
}

/// Reads one.
pub(super) fn asked(text: &str) -> Result<Asked, String> {
    let help = "write a file, its columns and a model, such as \"relax.csv:G=felt\" or \
                \"dma.csv:E',E''=felt\", or an output of a scene, such as \"drop.csv:force=pad.force\"";
    let (left, right) = text.split_once('=').ok_or(help)?;
    let mut right = right.split(',');
    let target = right.next().unwrap_or_default();
    let mut set: Vec<(String, String)> = right.map(assignment).collect::<Result<_, _>>()?;
    let is_model = !is_output(target.trim());
    let mut take = |word: &str| {
        let at = set.iter().position(|own| own.0 == word)?;
        Some(set.remove(at).1)
    };
    let cfc = take("cfc").map(|own| single::<Cfc>(&own)).transpose()?;
    let gain = take("gain").map(|own| share(&own)).transpose()?;
    let noise = take("noise");
    let scale = take("scale").map_or(Ok(1.0), |own| own.trim().parse::<f64>().map_err(|_| own));
    let scale = scale.and_then(|own| if own.is_normal() { Ok(own) } else { Err(own.to_string()) });
    let scale =
        scale.map_err(|own| format!("a scale is a number, such as -1, and `{own}` is none"))?;
    // Else it may be a number of the scene.
    let rate = if is_model { take("rate") } else { None };
    let (file, columns) = left.rsplit_once(':').ok_or(help)?;
    let columns = list(columns.split(',').map(|own| own.trim().to_owned()));
    let (file, target) = (file.trim(), target.trim());
    if file.is_empty() || target.is_empty() || columns.iter().any(String::is_empty) {
        return Err(help.to_owned());
    }
    let (file, target) = (file.to_owned(), target.to_owned());
    let text = text.trim().to_owned();
    Ok(Asked { text, file, columns, target, set, cfc, gain, noise, rate, scale })
}

/// A record of a file.
pub(super) struct Measured {
    pub(super) file: String,
    pub(super) record: Record,
    /// Whether it is that of a material, in Pa, or of a pad, in N and m.
    pub(super) is_material: bool,
    /// What was done, and what answered, in words.
    pub(super) what: String,
    /// Which lines of the file were left out.
    pub(super) note: Option<String>,
    /// The line of each row, from 1.
    pub(super) lines: Vec<usize>,
}

impl Measured {
    /// What is wrong with the record, in a row of it.
    pub(super) fn fault(&self, asked: &Asked, row: Option<usize>, fault: &dyn Display) -> CliError {
        let line = row.and_then(|row| self.lines.get(row));
        let line = line.map_or(String::new(), |line| format!("line {line}: "));
        asked.wrong(format!("{line}{fault}"))
    }
}

impl Asked {
    /// What is wrong with it.
    pub(super) fn wrong(&self, reason: impl Into<String>) -> CliError {
        CliError::Fit { text: self.text.clone(), reason: reason.into() }
    }

    /// What is said of it that only fits of numbers take into account.
    pub(super) fn of_numbers(&self) -> Option<&str> {
        let given = [
            ("cfc", self.cfc.is_some()),
            ("gain", self.gain.is_some()),
            ("noise", self.noise.is_some()),
        ];
        let given = given.into_iter().find(|own| own.1).map(|own| own.0);
        self.set.first().map(|own| own.0.as_str()).or(given)
    }

    /// What is set with a standard deviation.
    pub(super) fn scattered(&self) -> impl Iterator<Item = &(String, String)> {
        self.set.iter().filter(|own| SCATTER.iter().any(|sign| own.1.contains(sign)))
    }

    /// Whether what is set is there in the scene.
    pub(super) fn check(&self, tunables: &Tunables) -> Result<(), CliError> {
        let is_rate =
            |own: &(String, String)| own.0 == "rate" && tunables.anything("rate").is_err();
        if self.set.iter().any(is_rate) {
            return Err(
                self.wrong("a rate is that at which a model alone is pressed, such as `pad`")
            );
        }
        let known = self.set.iter().map(|own| tunables.anything(&own.0).map(|_| ()));
        let known: Result<(), _> = known.collect();
        known.map_err(|fault| CliError::Tunable { flag: FLAG, fault })
    }

    /// What is set but for the numbers that are known more or less.
    pub(super) fn plain(&self, known: &[Varied]) -> Vec<(String, String)> {
        let is_known = |name: &String| known.iter().any(|own| own.name == *name);
        list(self.set.iter().filter(|own| !is_known(&own.0)).cloned())
    }

    /// All but the file and its columns: what was measured, and what is said of it.
    pub(super) fn what(&self) -> &str {
        self.text.split_once('=').map_or("", |own| own.1)
    }

    /// File, column and output, as for a curve beside a run.
    pub(super) fn measured_as(&self) -> String {
        format!("{}:{}={}", self.file, self.columns.join(","), self.target)
    }

    /// What to write in place of an output where the file has a force over a deformation, and no times.
    pub(super) fn of_model(&self) -> Option<String> {
        let file = MeasuredFile::read(FLAG, &self.file, &crate::input::load).ok()?;
        let table = file.table().ok()?;
        let has = |dimension| !table.measuring(dimension).is_empty();
        let is_curve = !has(Dimension::TIME) && has(Dimension::LENGTH) && has(Dimension::FORCE);
        let name = self.target.split_once('.').map_or("", |own| own.0);
        let columns = self.columns.join(",");
        is_curve.then(|| format!("{}:{columns}={name},rate=10 mm/min", self.file))
    }

    /// The record in the file, without rows behind a time \[s\].
    pub(super) fn measured(&self, until: Option<f64>) -> Result<Measured, CliError> {
        let file = MeasuredFile::read(FLAG, &self.file, &crate::input::load)?;
        let table = file.table()?;
        let columns = self.positions(&file, &table)?;
        let found = Columns { file: &file, table: &table, answers: columns, scale: self.scale };
        let frequency = file.only(&table, Dimension::FREQUENCY)?;
        let time = file.only(&table, Dimension::TIME)?;
        found.check_temperature(time.filter(|_| frequency.is_none()).zip(until))?;
        let (mut record, is_material, what) = match (frequency, time) {
            (Some(frequency), _) if found.answers.len() == 2 || time.is_none() => {
                found.oscillation(frequency, &self.columns)?
            }
            (_, Some(_)) if self.rate.is_some() => {
                let reason =
                    "it has times: the rate is theirs, and none is to be stated".to_owned();
                return Err(file.unclear(reason).into());
            }
            (_, Some(time)) => found.over_time(time)?,
            _ => return self.pressed(&file, &found),
        };
        let mut lines = table.lines();
        if let Some(until) = until.filter(|_| record.has_times()) {
            let times = record.columns().swap_remove(0).places;
            let is_behind = |at: usize| times.get(at).is_some_and(|own| *own > until);
            record = record.without(is_behind);
            let mut at = 0..;
            lines.retain(|_| !at.next().is_some_and(is_behind));
        }
        let (note, file) = (file.notes(&table), self.file.clone());
        Ok(Measured { file, record, is_material, what, note, lines })
    }

    /// A force over a deformation, or a stress over a strain, at the rate that is stated.
    fn pressed(&self, file: &MeasuredFile, found: &Columns<'_, '_>) -> Result<Measured, CliError> {
        let &[column] = &found.answers[..] else {
            found.check_units()?;
            return Err(file.unclear("over a deformation one column answers".to_owned()).into());
        };
        let (way, speed, unit, is_material) = match found.dimension(column)? {
            Dimension::FORCE => (Dimension::LENGTH, Dimension::VELOCITY, "10 mm/min", false),
            Dimension::PRESSURE => (Dimension::NUMBER, Dimension::FREQUENCY, "0.01 1/s", true),
            _ => {
                found.check_units()?;
                let wanted = "a column of times, as in `t [s]`, or frequencies, as in `f [Hz]`, is wanted; a force \
                              over a deformation, or a stress over a strain, goes without";
                return Err(file.unclear(wanted.to_owned()).into());
            }
        };
        let Some(driven) = file.only(found.table, way)? else {
            let wanted = way.named().map_or("a strain, as in `strain [%]`", |own| own.0);
            return Err(file.unclear(format!(
                "`{}` stands beside no column of times, of frequencies, or of what was done: {wanted}",
                found.name(column)
            )).into());
        };
        let Some(rate) = &self.rate else {
            return Err(file
                .unclear(format!(
                    "it has no times: state how fast it was pressed, \"{},rate={unit}\"",
                    self.text
                ))
                .into());
        };
        let rate = setting("rate", rate, speed)?;
        if rate.is_nan() || rate <= 0.0 {
            return Err(file.unclear("a rate is above zero".to_owned()).into());
        }
        let (ways, answers) =
            (found.numbers(driven, way)?, found.numbers(column, found.dimension(column)?)?);
        let rows = times(&ways, rate).into_iter().zip(ways).zip(answers).zip(found.table.lines());
        let rows =
            rows.filter_map(|(((time, way), answer), line)| Some(([time?, way, answer], line)));
        let (rows, lines) = rows.unzip();
        let what = format!("`{}` over `{}`", found.name(column), found.name(driven));
        let note = file.notes(found.table);
        let (file, record) = (self.file.clone(), Record::Strained(rows));
        Ok(Measured { file, record, is_material, what, note, lines })
    }

    /// The columns that are named; a symbol that no column has stands for the only one that measures it.
    fn positions(
        &self,
        file: &MeasuredFile,
        table: &DataTable<'_>,
    ) -> Result<Vec<usize>, CliError> {
        let moduli = [Dimension::PRESSURE, Dimension::STIFFNESS];
        let compliances = [Dimension::COMPLIANCE, MATERIAL_COMPLIANCE];
        let measuring = |all: [Dimension; 2]| -> Vec<usize> {
            list(all.into_iter().flat_map(|own| table.measuring(own)))
        };
        let is_named = |own: &String| table.position(own).is_ok();
        if !self.columns.iter().any(is_named) {
            let symbols: Vec<&str> = list(self.columns.iter().map(String::as_str));
            let meant = match symbols[..] {
                ["J" | "D"] => measuring(compliances),
                ["G" | "E" | "K"] | ["G'" | "E'" | "K'", "G''" | "E''" | "K''"] => {
                    measuring(moduli)
                }
                _ => Vec::new(),
            };
            if meant.len() == self.columns.len() {
                return Ok(meant);
            }
        }
        let found = self.columns.iter().map(|own| table.position(own));
        found.collect::<Result<_, _>>().map_err(|fault| file.fault(fault).into())
    }
}

/// Columns of a file that answered.
struct Columns<'f, 't> {
    file: &'f MeasuredFile,
    table: &'f DataTable<'t>,
    answers: Vec<usize>,
    /// What these are multiplied by.
    scale: f64,
}

/// A record, whether it is that of a material, and what it is.
type Found = (Record, bool, String);

impl Columns<'_, '_> {
    fn name(&self, column: usize) -> &str {
        self.table.heading(column).name
    }

    fn dimension(&self, column: usize) -> Result<Dimension, CliError> {
        let name = self.name(column);
        self.table.heading(column).dimension.ok_or_else(|| {
            let wanted = format!("column `{name}` has no unit: write `{name} [MPa]`, say");
            self.file.unclear(wanted).into()
        })
    }

    fn numbers(&self, column: usize, dimension: Dimension) -> Result<Vec<f64>, CliError> {
        let values = self.table.column(column, dimension).map_err(|own| self.file.fault(own))?;
        let scale = if self.answers.contains(&column) { self.scale } else { 1.0 };
        Ok(list(values.into_iter().map(|own| scale * own)))
    }

    /// Whether all units can be read.
    fn check_units(&self) -> Result<(), CliError> {
        let all = (0..self.table.columns()).map(|at| (at, self.table.heading(at)));
        let mut unread = all.filter(|own| own.1.unit.is_some() && own.1.dimension.is_none());
        unread.next().map_or(Ok(()), |own| self.numbers(own.0, Dimension::NUMBER).map(|_| ()))
    }

    /// Whether all rows, up to a time if one is given, are of one temperature, where a column tells it.
    fn check_temperature(&self, until: Option<(usize, f64)>) -> Result<(), CliError> {
        let is_one = |at: &usize| {
            let own = self.table.heading(*at);
            own.dimension == Some(Dimension::TEMPERATURE)
                || own.unit.is_none() && own.name.to_lowercase().starts_with("temp")
        };
        let Some(column) = (0..self.table.columns()).find(is_one) else { return Ok(()) };
        let mut all = self.numbers(column, Dimension::TEMPERATURE)?;
        if let Some((time, until)) = until {
            let mut times = self.numbers(time, Dimension::TIME)?.into_iter();
            all.retain(|_| times.next().is_some_and(|own| own <= until));
        }
        let (low, high) = all
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |own, at| (own.0.min(*at), own.1.max(*at)));
        if high - low <= ONE_TEMPERATURE {
            return Ok(());
        }
        let zero = if self.table.heading(column).unit.is_some() { 273.15 } else { 0.0 };
        Err(self.file.unclear(format!(
            "its rows are of several temperatures, from {:.1} to {:.1} °C in column `{}`, and a curve is of one: keep the \
             rows of one, in a file of their own, or shift all to one before",
            low - zero,
            high - zero,
            self.name(column)
        )).into())
    }

    /// Angular frequencies \[rad/s\]: turns a second, or angles, by their unit; where that is 1/s, by their name.
    fn omegas(&self, column: usize) -> Result<Vec<f64>, CliError> {
        let heading = self.table.heading(column);
        let (name, unit) = (heading.name, heading.unit.unwrap_or_default());
        let word = name.to_lowercase();
        let is_angular = ["angular", "ang.", "ang ", "omega", "ω", "kreisfrequenz"]
            .iter()
            .any(|own| word.starts_with(own) || word.contains("angular"));
        let has = |own: &str| unit.to_lowercase().contains(own);
        let (is_turns, is_angle) = (has("hz"), ["rad", "deg", "°"].into_iter().any(has));
        let factor = match (is_angular, is_turns, is_angle) {
            (_, false, true) | (false, true, _) => std::f64::consts::TAU,
            (true, false, false) => 1.0,
            _ => {
                return Err(self.file.unclear(format!(
                    "`{name} [{unit}]` may be turns a second or rad/s, which differ by 2π: write `{name} [Hz]` or \
                     `{name} [rad/s]` into the file, whichever it is"
                )).into());
            }
        };
        let values = self.numbers(column, Dimension::FREQUENCY)?;
        Ok(list(values.into_iter().map(|own| factor * own)))
    }

    /// Moduli over frequency.
    fn oscillation(&self, frequency: usize, symbols: &[String]) -> Result<Found, CliError> {
        let dimension = self.dimension(self.answers[0])?;
        for column in &self.answers {
            self.dimension(*column)?;
        }
        if ![Dimension::PRESSURE, Dimension::STIFFNESS].contains(&dimension) {
            let name = self.name(self.answers[0]);
            return Err(self
                .file
                .unclear(format!(
                    "column `{name}` over frequency is neither a modulus (Pa) nor a stiffness (N/m)"
                ))
                .into());
        }
        let is_material = dimension == Dimension::PRESSURE;
        let omegas = self.omegas(frequency)?;
        let values = self.answers.iter().map(|own| self.numbers(*own, dimension));
        let values = values.collect::<Result<Vec<_>, _>>()?;
        let names: Vec<&str> = list(self.answers.iter().map(|own| self.name(*own)));
        let pairs = |values: &[f64]| list(omegas.iter().copied().zip(values.iter().copied()));
        let record = match &values[..] {
            [storage, loss] => {
                let rows = omegas.iter().zip(storage).zip(loss);
                Record::Oscillation(list(rows.map(|((omega, one), other)| [*omega, *one, *other])))
            }
            [one] if symbols[0].ends_with("''") => Record::Loss(pairs(one)),
            [one] if symbols[0].ends_with('\'') => Record::Storage(pairs(one)),
            _ => {
                return Err(self.file.unclear(
                    "over frequency name storage and loss, as in \"dma.csv:E',E''=felt\", or one of \
                     them by a symbol with one or two strokes"
                        .to_owned(),
                ).into());
            }
        };
        let what = match record {
            Record::Loss(_) => format!("loss `{}`", names[0]),
            Record::Storage(_) => format!("storage `{}`", names[0]),
            _ => format!("storage `{}` and loss `{}`", names[0], names[1]),
        };
        Ok((record, is_material, what))
    }

    /// What answers over time: a modulus or compliance after a step, or a stress, strain, force or deformation with
    /// the history that another column has.
    fn over_time(&self, time: usize) -> Result<Found, CliError> {
        let &[column] = &self.answers[..] else {
            return Err(self.file.unclear("over time one column answers".to_owned()).into());
        };
        let (name, dimension) = (self.name(column), self.dimension(column)?);
        let (driver, is_material, is_driven_by_strain) = match dimension {
            Dimension::PRESSURE => (Dimension::NUMBER, true, true),
            Dimension::FORCE => (Dimension::LENGTH, false, true),
            Dimension::NUMBER => (Dimension::PRESSURE, true, false),
            Dimension::LENGTH => (Dimension::FORCE, false, false),
            Dimension::STIFFNESS => (Dimension::STIFFNESS, false, true),
            Dimension::COMPLIANCE => (Dimension::COMPLIANCE, false, false),
            MATERIAL_COMPLIANCE => (MATERIAL_COMPLIANCE, true, false),
            _ => {
                return Err(self.file.unclear(format!(
                    "column `{name}` is no modulus, compliance, stress, strain, force or deformation"
                )).into());
            }
        };
        let times = self.numbers(time, Dimension::TIME)?;
        let values = self.numbers(column, dimension)?;
        let driven = if driver == dimension { None } else { self.file.only(self.table, driver)? };
        let Some(driven) = driven else {
            if dimension != driver && dimension != Dimension::PRESSURE {
                let wanted = driver.named().map_or("what was done", |own| own.0);
                return Err(self.file.unclear(format!(
                    "`{name}` over time needs a column of what was done, {wanted}, with its unit"
                )).into());
            }
            let rows = list(times.into_iter().zip(values));
            return Ok(if is_driven_by_strain {
                (Record::Relaxation(rows), is_material, format!("relaxation `{name}`"))
            } else {
                (Record::Creep(rows), is_material, format!("creep `{name}`"))
            });
        };
        let history = self.numbers(driven, driver)?;
        let rows = times.into_iter().zip(history).zip(values);
        let rows = list(rows.map(|((time, done), answer)| [time, done, answer]));
        let what = format!("`{name}` under the history of `{}`", self.name(driven));
        let record =
            if is_driven_by_strain { Record::Strained(rows) } else { Record::Stressed(rows) };
        Ok((record, is_material, what))
    }
}
