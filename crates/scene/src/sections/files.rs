//! Driving functions from files: `table = "pulse.csv"`.

use std::ops::Range;

use dashpot_dae::Waveform;
use dashpot_network::parameters::{Dimension, Registered, Value};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    kinds::parameters::KindReader,
    quantities::quantity::Quantities,
    tables::{DataTable, Field, Scale, TableError, TableFault},
    text::{
        document::{Content, Item},
        library::TableFile,
        source::Place,
        table::{Table, text_of, wrong_type},
    },
    units::{parse_quantity, si_unit},
};

/// What a scene says of a file beside its name.
#[derive(Default)]
struct Wishes<'d> {
    columns: Option<[&'d Item; 2]>,
    units: Option<[&'d Item; 2]>,
    outside: Option<&'d Item>,
}

impl<'d> Reading<'d> {
    /// The function of `kind`, which takes a table, from the file that `item` names; `place` is that
    /// of its word. `key` is what it drives, in `driven`.
    pub(super) fn read_file(
        &self,
        kind: &Registered<Waveform>,
        item: &'d Item,
        place: Place,
        (key, driven): (&str, Dimension),
    ) -> Option<Waveform> {
        let (name, wishes) = self.file_and_wishes(kind.word, item, place)?;
        let path = text_of(name, "`file`", self.faults)?;
        // Where there is none, a fault has been noted.
        let file = self.library.table_file(path)?;
        let note = format!(
            "the scene's `{key}`, {}, is read from this file",
            self.faults.origin(name.place)
        );
        let tell = |span: Range<usize>, fault: Fault| {
            self.faults.error(Place::new(file.number, &span), fault.with_note(&*note));
        };
        let is_empty = || {
            let fault = TableError::new("", 0..0, TableFault::Empty).fault;
            self.faults.error(name.place, Fault::Table(fault));
        };
        let tell_error = |error: TableError| tell(error.span, Fault::Table(error.fault));
        let csv = match DataTable::read(&file.source.text) {
            Ok(csv) => csv,
            Err(error) if error.fault == TableFault::Empty => {
                is_empty();
                return None;
            }
            Err(error) => {
                tell_error(error);
                return None;
            }
        };
        if csv.columns() < 2 {
            tell(0..0, Fault::Table(TableFault::OneColumn));
            return None;
        }
        let columns = self.columns(&csv, &wishes, name.place)?;
        let dimensions = [Dimension::TIME, driven];
        let quantities = Quantities { is_motion: driven == Dimension::LENGTH, ..self.quantities() };
        let [time, value] = [0, 1].map(|at| {
            let given = wishes.units.map(|units| units[at]);
            self.unit(file, csv.unit(columns[at]), given, dimensions[at], quantities)
        });
        let units = [time?, value?];
        let scales =
            units.map(|factor| factor.map_or(Scale::SI, |factor| Scale { factor, offset: 0.0 }));
        let points = csv.samples(columns, scales, tell_error)?.points;
        if points.is_empty() {
            is_empty();
            return None;
        }
        if points.len() == 1 {
            let message = "a table with one point is a constant for ever";
            let help = "give at least two rows, or write `constant`";
            self.faults.warning(name.place, Fault::odd(message, help));
        }
        self.without_units(units.map(|factor| factor.is_none()), dimensions, name.place);
        let reader = KindReader { driven, ..KindReader::new(self.quantities()) };
        // All that is said of points in a scene is said of those of a file beside its name.
        let others = kind.parameters[1..].iter().map(|parameter| match wishes.outside {
            Some(item) => reader.value(parameter, item),
            None => Some(Value::LeftOut),
        });
        let others = others.collect::<Option<Vec<Value>>>()?;
        match (kind.make)(&[vec![Value::Table(points)], others].concat()) {
            Ok(waveform) => Some(waveform),
            Err(invalid) => {
                tell(0..0, Fault::Invalid(invalid));
                None
            }
        }
    }

    /// Warns of numbers whose unit nothing says, so that they are read in SI units.
    fn without_units(&self, missing: [bool; 2], dimensions: [Dimension; 2], place: Place) {
        let [time, value] = dimensions.map(si_unit);
        let read = match missing {
            [false, false] => return,
            [true, true] => format!("times are read in {time}, values in {value}"),
            [true, false] => format!("times are read in {time}"),
            [false, true] => format!("values are read in {value}"),
        };
        let message = format!("the file does not say all its units: {read}");
        let help = format!(
            "write a header line `time [{time}], value [{value}]`, or \
             `table = {{ file = \"…\", units = [\"{time}\", \"{value}\"] }}`"
        );
        self.faults.warning(place, Fault::odd(message, help));
    }

    /// The columns of time and value, counted from 0; `place` is that of the file's name.
    fn columns(
        &self,
        csv: &DataTable<'_>,
        wishes: &Wishes<'_>,
        place: Place,
    ) -> Option<[usize; 2]> {
        match wishes.columns {
            None if csv.columns() > 2 => {
                let fault = TableFault::WhichColumns {
                    count: csv.columns(),
                    wanted: "time and value".to_owned(),
                    names: Vec::new(),
                };
                self.faults.error(place, Fault::Table(fault));
                None
            }
            None => Some([0, 1]),
            Some(wanted) => {
                let [time, value] = wanted.map(|wanted| self.column(csv, wanted));
                Some([time?, value?])
            }
        }
    }

    /// The name of the file, and what is said of it.
    fn file_and_wishes(
        &self,
        word: &str,
        item: &'d Item,
        place: Place,
    ) -> Option<(&'d Item, Wishes<'d>)> {
        if item.table().is_none() {
            return Some((item, Wishes::default()));
        }
        let table = Table::new(item, format!("`{word}`"), place, self.faults)?;
        let file = table.require("file", "file = \"pulse.csv\"");
        let outside = table.take("outside").map(|entry| &entry.item);
        let pair = |key: &'static str, expected: &str| {
            let Some(entry) = table.take(key) else { return Some(None) };
            if let Content::List(items) = &entry.item.value
                && let [time, value] = &**items
            {
                return Some(Some([time, value]));
            }
            wrong_type(&entry.item, &format!("`{key}`"), expected, self.faults);
            None
        };
        let columns = pair("columns", "a pair of numbers or names, for example `[1, 2]`");
        let units = pair("units", "a pair of units, for example `[\"ms\", \"kN\"]`");
        table.finish();
        Some((&file?.item, Wishes { columns: columns?, units: units?, outside }))
    }

    /// The column that `wanted` names or counts from 1.
    fn column(&self, csv: &DataTable<'_>, wanted: &Item) -> Option<usize> {
        match &wanted.value {
            Content::Number(digits) => {
                let number = digits.parse::<usize>().ok().and_then(|own| own.checked_sub(1));
                let found = number.filter(|number| *number < csv.columns());
                if found.is_none() {
                    let (wanted_text, count) = (digits.to_string(), csv.columns());
                    let fault = TableFault::NoColumn { wanted: wanted_text, count };
                    self.faults.error(wanted.place, Fault::Table(fault));
                }
                found
            }
            Content::Text(name) => {
                let names = || (0..csv.columns()).map(|at| csv.heading(at).name);
                let found = names().position(|own| own == name.trim());
                if found.is_none() {
                    let known = names().map(str::to_owned).collect();
                    let (family, name) = ("column", name.to_string());
                    self.faults.error(wanted.place, Fault::UnknownName { family, name, known });
                }
                found
            }
            _ => {
                wrong_type(wanted, "a column", "a number from 1, or a name", self.faults);
                None
            }
        }
    }

    /// What the numbers of a column are multiplied by: the unit in the scene or else in the header,
    /// `Some(None)` where there is neither.
    #[expect(clippy::option_option, reason = "a fault, no unit, or the factor of one")]
    fn unit(
        &self,
        file: &TableFile,
        header: Option<Field<'_>>,
        given: Option<&Item>,
        expected: Dimension,
        reader: Quantities<'_>,
    ) -> Option<Option<f64>> {
        let one = |unit: &str, place| {
            let item = Item { value: Content::Text(format!("1 {unit}").into()), place };
            reader.read(&item, expected)
        };
        let Some(given) = given else {
            let Some(header) = header else { return Some(None) };
            return one(header.text, Place::new(file.number, &header.span())).map(Some);
        };
        let text = text_of(given, "a unit", self.faults)?;
        let factor = one(text, given.place)?;
        if let Some(header) = header
            && let Ok(said) = parse_quantity(&format!("1 {}", header.text))
            && said.dimension == Some(expected)
            && (said.value - factor).abs() > 1e-12 * factor.abs()
        {
            let (header, text) = (header.text.to_owned(), text.to_owned());
            let fault = TableFault::Contradiction { header, given: text };
            self.faults.error(given.place, Fault::Table(fault));
            return None;
        }
        Some(Some(factor))
    }
}
