//! Measured curves from files: which columns are meant, and what is told of the file.

use std::path::Path;

use dashpot_network::parameters::Dimension;
use dashpot_scene::{DataTable, LeftOut, TableError, table_text};

use crate::{
    error::{CliError, reason},
    input::bytes_of,
};

/// The text of a file of numbers.
pub(crate) struct MeasuredFile {
    /// The option that names it.
    flag: &'static str,
    name: String,
    text: String,
}

impl MeasuredFile {
    pub(crate) fn read(flag: &'static str, name: &str) -> Result<Self, CliError> {
        let bytes = bytes_of(Path::new(name)).map_err(|error| CliError::MeasuredColumn {
            flag,
            file: name.to_owned(),
            reason: format!("it cannot be read: {}", reason(&error)),
        })?;
        Ok(Self { flag, name: name.to_owned(), text: table_text(&bytes).into_owned() })
    }

    pub(crate) fn table(&self) -> Result<DataTable<'_>, CliError> {
        DataTable::read(&self.text).map_err(|fault| self.fault(fault))
    }

    /// A fault of the file.
    pub(crate) fn fault(&self, fault: TableError) -> CliError {
        CliError::MeasuredTable { file: self.name.clone(), fault: Box::new(fault) }
    }

    /// A column that cannot be told from the others.
    pub(crate) fn unclear(&self, reason: String) -> CliError {
        CliError::MeasuredColumn { flag: self.flag, file: self.name.clone(), reason }
    }

    /// The one column that measures `dimension`; `None` where there is none.
    pub(crate) fn only(
        &self,
        table: &DataTable<'_>,
        dimension: Dimension,
    ) -> Result<Option<usize>, CliError> {
        match table.measuring(dimension)[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            [one, other, ..] => {
                let name = |at: usize| table.heading(at).name;
                let what = dimension.named().map_or("the same", |own| own.0);
                Err(self.unclear(format!(
                    "`{}` and `{}` both measure {what}: leave one of them out",
                    name(one),
                    name(other)
                )))
            }
        }
    }

    /// Two columns row by row, in SI units.
    pub(crate) fn points(
        &self,
        table: &DataTable<'_>,
        columns: [(usize, Dimension); 2],
    ) -> Result<Vec<(f64, f64)>, CliError> {
        let [x, y] = columns.map(|(at, dimension)| table.column(at, dimension));
        let (x, y) = (x.map_err(|own| self.fault(own))?, y.map_err(|own| self.fault(own))?);
        Ok(x.into_iter().zip(y).collect())
    }

    /// Which lines of the file were left out.
    pub(crate) fn notes(&self, table: &DataTable<'_>) -> Option<String> {
        LeftOut::of(table).map(|own| format!("{}: {own}", self.name))
    }
}
