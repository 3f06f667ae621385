//! Which column or channel of a file measured an output of a scene.

use dashpot_network::{Assembly, parameters::Dimension};
use dashpot_plot::Of;
use dashpot_scene::DataTable;
use dashpot_signal::iso_mme::MmeChannel;
use dashpot_units::si_unit;

use super::beside::{Output, dimension};
use crate::error::{CliError, StudyError};

/// What can be measured over time.
const MEASURABLE: [Of; 4] = [Of::Force, Of::Acceleration, Of::Velocity, Of::Deformation];

/// A column of a table, or a channel of a test.
struct Column {
    name: String,
    code: Option<String>,
    unit: Option<String>,
    /// What it may measure by its unit.
    measures: Vec<Dimension>,
}

/// Columns of a table, or channels of a test, one of which measured an output.
pub(super) struct Columns<'f> {
    /// The option that names the file, and the file.
    place: (&'static str, &'f str),
    columns: Vec<Column>,
}

impl<'f> Columns<'f> {
    pub(super) fn of_table(place: (&'static str, &'f str), table: &DataTable<'_>) -> Self {
        let column = |at: usize| Column {
            name: table.heading(at).name.to_owned(),
            code: None,
            unit: table.heading(at).unit.map(str::to_owned),
            measures: MEASURABLE
                .map(dimension)
                .into_iter()
                .filter(|own| table.measuring(*own).contains(&at))
                .collect(),
        };
        Self { place, columns: (0..table.columns()).map(column).collect() }
    }

    pub(super) fn of_test(place: (&'static str, &'f str), channels: &[MmeChannel]) -> Self {
        let column = |own: &MmeChannel| Column {
            name: own.channel.name().to_owned(),
            code: own.code.as_ref().map(|code| code.text().to_owned()),
            unit: Some(si_unit(own.channel.dimension())),
            measures: vec![own.channel.dimension()],
        };
        Self { place, columns: channels.iter().map(column).collect() }
    }

    /// The name of one, or else its number.
    pub(super) fn title(&self, at: usize) -> String {
        match &*self.columns[at].name {
            "" => format!("column {}", at + 1),
            name => name.to_owned(),
        }
    }

    /// All of them with their units.
    pub(super) fn all(&self) -> String {
        let one = |at: usize| {
            let unit = self.columns[at].unit.as_ref();
            let unit = unit.map_or(String::new(), |unit| format!(" [{unit}]"));
            format!("`{}{unit}`", self.title(at))
        };
        (0..self.columns.len()).map(one).collect::<Vec<_>>().join(", ")
    }

    fn unclear(&self, reason: String) -> CliError {
        let (flag, file) = self.place;
        StudyError::MeasuredColumn { flag, file: file.to_owned(), reason }.into()
    }

    /// The only one of some; `None` where there is none.
    fn only(&self, is_one: impl Fn(&Column) -> bool) -> Result<Option<usize>, CliError> {
        let all = (0..self.columns.len()).filter(|at| is_one(&self.columns[*at]));
        match all.collect::<Vec<_>>()[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            [one, other, ..] => Err(self.unclear(format!(
                "columns {} and {}, `{}` and `{}`, may both be meant: say which, as in `{}:{}=…`",
                one + 1,
                other + 1,
                self.title(one),
                self.title(other),
                self.place.1,
                self.title(one)
            ))),
        }
    }

    fn named(&self, name: &str) -> Result<Option<usize>, CliError> {
        self.only(|own| own.name == name || own.code.as_deref() == Some(name))
    }

    /// The one that measured an output: the one that is named, or has its name, or the only one of its dimension.
    pub(super) fn measuring(
        &self,
        named: Option<&str>,
        output: &Output,
    ) -> Result<usize, CliError> {
        let (key, word, has) = (output.key(), a_word(output.of), self.all());
        let is_like = |own: &Column| own.measures.contains(&dimension(output.of));
        let Some(name) = named else {
            if let Ok(Some(at)) = self.named(&key) {
                return Ok(at);
            }
            let none = format!("no column is {word} by its unit, as `{key}` is; it has {has}");
            return self.only(is_like)?.ok_or_else(|| self.unclear(none));
        };
        let Some(at) = self.named(name)? else {
            return Err(self.unclear(format!("there is no column `{name}`; it has {has}")));
        };
        match self.columns[at].unit {
            Some(_) if is_like(&self.columns[at]) => Ok(at),
            Some(_) => Err(self.unclear(format!(
                "the column `{name}` is not {word} by its unit, as `{key}` is; it has {has}"
            ))),
            None => Err(self.unclear(format!(
                "the column `{name}` has no unit; write it into the header, as in `{name} [{}]`",
                output.unit()
            ))),
        }
    }

    /// The only one that measured what can be measured, and the output that it tells of.
    pub(super) fn only_one(
        &self,
        assembly: &Assembly,
        known: &[Output],
    ) -> Result<(usize, Output), CliError> {
        let found: Vec<(usize, Of)> = MEASURABLE
            .into_iter()
            .flat_map(|of| {
                let is_like = move |at: &usize| self.columns[*at].measures.contains(&dimension(of));
                (0..self.columns.len()).filter(is_like).map(move |at| (at, of))
            })
            .collect();
        let [(at, of)] = found[..] else {
            let which = match found.len() {
                0 => "no column is a force, deformation, acceleration or velocity by its unit",
                _ => "several columns may be meant: say which, as in `drop.csv:Kraft=pad.force`",
            };
            return Err(self.unclear(format!("{which}; it has {}", self.all())));
        };
        let title = self.title(at);
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
            self.unclear(match of_kind.len() {
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
}

fn a_word(of: Of) -> String {
    let word = of.word();
    format!("{} {word}", if word.starts_with('a') { "an" } else { "a" })
}
