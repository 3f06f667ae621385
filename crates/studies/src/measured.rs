//! Measured curves from files: which columns are meant, and what is told of the file.

use dashpot_network::parameters::Dimension;
use dashpot_scene::{DataTable, LeftOut, Loader, TableError, table_text};

use crate::StudyError;

/// The text of a file of numbers.
pub struct MeasuredFile {
    /// The option that names it.
    flag: &'static str,
    name: String,
    text: String,
}

impl MeasuredFile {
    /// The file `name`, which the option `flag` names.
    ///
    /// # Errors
    ///
    /// That it cannot be read.
    pub fn read(flag: &'static str, name: &str, load: Loader<'_>) -> Result<Self, StudyError> {
        let bytes = load(name).map_err(|reason| StudyError::MeasuredColumn {
            flag,
            file: name.to_owned(),
            reason: format!("it cannot be read: {reason}"),
        })?;
        Ok(Self { flag, name: name.to_owned(), text: table_text(&bytes).into_owned() })
    }

    /// Its table.
    ///
    /// # Errors
    ///
    /// That it is none.
    pub fn table(&self) -> Result<DataTable<'_>, StudyError> {
        DataTable::read(&self.text).map_err(|fault| self.fault(fault))
    }

    /// A fault of the file.
    pub fn fault(&self, fault: TableError) -> StudyError {
        StudyError::MeasuredTable { file: self.name.clone(), fault: Box::new(fault) }
    }

    /// A column that cannot be told from the others.
    pub fn unclear(&self, reason: String) -> StudyError {
        StudyError::MeasuredColumn { flag: self.flag, file: self.name.clone(), reason }
    }

    /// The one column that measures `dimension`; `None` where there is none.
    ///
    /// # Errors
    ///
    /// That there are several.
    pub fn only(
        &self,
        table: &DataTable<'_>,
        dimension: Dimension,
    ) -> Result<Option<usize>, StudyError> {
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
    ///
    /// # Errors
    ///
    /// What is no number, with its line.
    pub fn points(
        &self,
        table: &DataTable<'_>,
        columns: [(usize, Dimension); 2],
    ) -> Result<Vec<(f64, f64)>, StudyError> {
        let [x, y] = columns.map(|(at, dimension)| table.column(at, dimension));
        let (x, y) = (x.map_err(|own| self.fault(own))?, y.map_err(|own| self.fault(own))?);
        Ok(x.into_iter().zip(y).collect())
    }

    /// Which lines of the file were left out.
    pub fn notes(&self, table: &DataTable<'_>) -> Option<String> {
        LeftOut::of(table).map(|own| format!("{}: {own}", self.name))
    }
}
