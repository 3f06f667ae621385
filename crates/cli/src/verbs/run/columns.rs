//! Which column or channel of a file measured an output of a scene.

use std::path::Path;

use dashpot_network::{Assembly, parameters::Dimension};
use dashpot_plot::Of;
use dashpot_scene::DataTable;
use dashpot_signal::{
    Cfc,
    iso_mme::{ChannelCode, MmeChannel},
};
use dashpot_units::si_unit;

use super::beside::{Output, dimension};
use crate::{error::CliError, measured::MeasuredFile, verbs::signal::mme};

/// What can be measured over time.
const MEASURABLE: [Of; 4] = [Of::Force, Of::Acceleration, Of::Velocity, Of::Deformation];

/// Columns of a table, or channels of a test, one of which measured an output.
pub(super) trait Columns {
    /// How many there are.
    fn count(&self) -> usize;

    /// The name of one, or else its number.
    fn title(&self, at: usize) -> String;

    /// Its unit, where it says one.
    fn unit(&self, at: usize) -> Option<String>;

    /// Those of a dimension.
    fn measuring(&self, dimension: Dimension) -> Vec<usize>;

    /// The one of this name; `None` where there is none.
    ///
    /// # Errors
    ///
    /// A name that several have.
    fn named(&self, name: &str) -> Result<Option<usize>, CliError>;

    /// The only one that measures `dimension`; `None` where there is none.
    ///
    /// # Errors
    ///
    /// Several that do.
    fn only(&self, dimension: Dimension) -> Result<Option<usize>, CliError>;

    /// What cannot be told from the file.
    fn unclear(&self, reason: String) -> CliError;

    /// All of them with their units.
    fn all(&self) -> String {
        let one = |at: usize| {
            let unit = self.unit(at).map_or(String::new(), |unit| format!(" [{unit}]"));
            format!("`{}{unit}`", self.title(at))
        };
        (0..self.count()).map(one).collect::<Vec<_>>().join(", ")
    }
}

/// Columns of a table.
pub(super) struct OfTable<'t> {
    pub(super) file: &'t MeasuredFile,
    pub(super) table: &'t DataTable<'t>,
}

impl Columns for OfTable<'_> {
    fn count(&self) -> usize {
        self.table.columns()
    }

    fn title(&self, at: usize) -> String {
        match self.table.heading(at).name {
            "" => format!("column {}", at + 1),
            name => name.to_owned(),
        }
    }

    fn unit(&self, at: usize) -> Option<String> {
        self.table.heading(at).unit.map(str::to_owned)
    }

    fn measuring(&self, dimension: Dimension) -> Vec<usize> {
        self.table.measuring(dimension)
    }

    fn named(&self, name: &str) -> Result<Option<usize>, CliError> {
        if (0..self.count()).all(|at| self.table.heading(at).name != name) {
            return Ok(None);
        }
        self.table.position(name).map(Some).map_err(|own| self.file.fault(own))
    }

    fn only(&self, dimension: Dimension) -> Result<Option<usize>, CliError> {
        self.file.only(self.table, dimension)
    }

    fn unclear(&self, reason: String) -> CliError {
        self.file.unclear(reason)
    }
}

/// Channels of a test in ISO-MME.
pub(super) struct OfTest {
    flag: &'static str,
    file: String,
    channels: Vec<MmeChannel>,
}

impl OfTest {
    /// Reads a test; `None` of a file that is none.
    pub(super) fn read(flag: &'static str, name: &str) -> Result<Option<Self>, CliError> {
        let path = Path::new(name);
        if !mme::is_one(path) {
            return Ok(None);
        }
        Ok(Some(Self { flag, file: name.to_owned(), channels: mme::read(path)? }))
    }

    /// (Time \[s\], value in SI units) of a channel.
    pub(super) fn rows(&self, at: usize) -> Vec<(f64, f64)> {
        let channel = &self.channels[at].channel;
        channel.times().iter().copied().zip(channel.values().iter().copied()).collect()
    }

    /// The filter that a channel went through, as its code says.
    pub(super) fn cfc(&self, at: usize) -> Option<Cfc> {
        let class = self.channels[at].code.as_ref().and_then(ChannelCode::filter_class)?;
        Cfc::new(class).ok()
    }
}

impl Columns for OfTest {
    fn count(&self) -> usize {
        self.channels.len()
    }

    fn title(&self, at: usize) -> String {
        self.channels[at].channel.name().to_owned()
    }

    fn unit(&self, at: usize) -> Option<String> {
        Some(si_unit(self.channels[at].channel.dimension()))
    }

    fn measuring(&self, dimension: Dimension) -> Vec<usize> {
        let all = self.channels.iter().enumerate();
        all.filter(|own| own.1.channel.dimension() == dimension).map(|own| own.0).collect()
    }

    fn named(&self, name: &str) -> Result<Option<usize>, CliError> {
        let is_it = |own: &MmeChannel| {
            own.channel.name() == name || own.code.as_ref().is_some_and(|code| code.text() == name)
        };
        let mut all = (0..self.count()).filter(|&at| is_it(&self.channels[at]));
        match (all.next(), all.next()) {
            (Some(_), Some(_)) => {
                Err(self.unclear(format!("several channels are `{name}`: name one by its code")))
            }
            (found, _) => Ok(found),
        }
    }

    fn only(&self, dimension: Dimension) -> Result<Option<usize>, CliError> {
        match self.measuring(dimension)[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            [one, other, ..] => Err(self.unclear(format!(
                "`{}` and `{}` may both be meant: say which, as in `{}:{}=…`",
                self.title(one),
                self.title(other),
                self.file,
                self.title(one)
            ))),
        }
    }

    fn unclear(&self, reason: String) -> CliError {
        CliError::MeasuredColumn { flag: self.flag, file: self.file.clone(), reason }
    }
}

/// The one that measured an output: the one that is named, or has its name, or the only one of its dimension.
pub(super) fn column_of(
    all: &dyn Columns,
    named: Option<&str>,
    output: &Output,
) -> Result<usize, CliError> {
    let key = output.key();
    if let Some(name) = named {
        let Some(at) = all.named(name)? else {
            let has = all.all();
            return Err(all.unclear(format!("there is no column `{name}`; it has {has}")));
        };
        if all.unit(at).is_none() {
            return Err(all.unclear(format!(
                "the column `{name}` has no unit; write it into the header, as in `{name} [{}]`",
                output.unit()
            )));
        }
        if !all.measuring(dimension(output.of)).contains(&at) {
            let (word, has) = (a_word(output.of), all.all());
            return Err(all.unclear(format!(
                "the column `{name}` is not {word} by its unit, as `{key}` is; it has {has}"
            )));
        }
        return Ok(at);
    }
    if let Ok(Some(at)) = all.named(&key) {
        return Ok(at);
    }
    let found = all.only(dimension(output.of))?;
    found.ok_or_else(|| {
        all.unclear(format!(
            "no column is {} by its unit, as `{key}` is; it has {}",
            a_word(output.of),
            all.all()
        ))
    })
}

/// The only one that measured what can be measured, and the output that it tells of.
pub(super) fn only_one(
    all: &dyn Columns,
    assembly: &Assembly,
    known: &[Output],
) -> Result<(usize, Output), CliError> {
    let found: Vec<(usize, Of)> = MEASURABLE
        .into_iter()
        .flat_map(|of| all.measuring(dimension(of)).into_iter().map(move |at| (at, of)))
        .collect();
    let [(at, of)] = found[..] else {
        let which = match found.len() {
            0 => "no column is a force, deformation, acceleration or velocity by its unit",
            _ => "several columns may be meant: say which, as in `drop.csv:Kraft=pad.force`",
        };
        return Err(all.unclear(format!("{which}; it has {}", all.all())));
    };
    let title = all.title(at);
    if let Some(own) = known.iter().find(|own| own.key() == title) {
        return Ok((at, own.clone()));
    }
    let of_kind: Vec<&Output> = known.iter().filter(|own| own.of == of).collect();
    let only = match of_kind[..] {
        [one] => Some(one.clone()),
        _ => Output::foremost(assembly, of),
    };
    let names = || of_kind.iter().map(|own| own.key()).collect::<Vec<_>>().join(", ");
    let output = only.ok_or_else(|| {
        all.unclear(match of_kind.len() {
            0 => format!("`{title}` is {}, which the scene has none of", a_word(of)),
            _ => format!(
                "`{title}` may be any of {}; say which, as in `drop.csv:{}`",
                names(),
                of_kind[0].key()
            ),
        })
    })?;
    Ok((at, output))
}

fn a_word(of: Of) -> String {
    let word = of.word();
    format!("{} {word}", if word.starts_with('a') { "an" } else { "a" })
}
