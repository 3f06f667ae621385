//! Points from files: `table = "pulse.csv"`, `table-spring = { file = "curve.csv", units = ["%", "kPa"] }`.

use std::ops;

use dashpot_network::parameters::{CurveRole, Dimension, Parameter, ParameterKind, Range, Value};

use super::{
    file_units::{misread_unit, unit},
    parameters::KindReader,
    records::{CHANNEL, FileRows, Treatment},
};
use crate::{
    curves::{CurveChange, Difference, Fitted, Row, fit, outward, split, turning_row, unloading},
    diagnostics::fault::Fault,
    models::notes::Remark,
    quantities::quantity::Quantities,
    tables::{DataTable, LeftOut, Samples, Scale, TableError, TableFault},
    text::{
        document::{Content, Item},
        library::tables::{FILE, SCALE},
        source::Place,
        table::{Table, text_of, wrong_type},
        table_file::TableFile,
    },
};

/// What a scene says of a file beside its name.
#[derive(Default)]
struct Wishes<'i> {
    columns: Option<[&'i Item; 2]>,
    units: Option<[&'i Item; 2]>,
    /// By what the values are multiplied.
    scale: Option<f64>,
    /// Which channel of a test in ISO-MME.
    channel: Option<&'i Item>,
}

/// What tells of faults in a file.
struct Teller<'d> {
    quantities: Quantities<'d>,
    file: &'d TableFile,
    /// Where the file is named.
    named: Place,
}

impl Teller<'_> {
    /// A fault at the bytes `span` of the file, and what is said of it besides.
    fn tell(&self, span: ops::Range<usize>, fault: Fault, more: Vec<String>) {
        let faults = self.quantities.faults;
        let named = format!("the file is named in {}", faults.whereabouts(self.named));
        let note = more.into_iter().chain([named]).collect::<Vec<_>>().join("; ");
        faults.error(Place::new(self.file.number, &span), fault.with_note(note));
    }

    fn refuse(&self, error: TableError) {
        let column = error.column.as_deref().map(in_column);
        let likewise = error.likewise.map(|own| own.to_string());
        let more = column.into_iter().chain(likewise).collect();
        self.tell(error.span, Fault::Table(*error.fault), more);
    }
}

fn in_column(name: &str) -> String {
    format!("in column `{name}`")
}

impl<'d> KindReader<'d> {
    /// The rows of the file that `item` names, by its name alone or in a table of its own.
    pub(super) fn rows_of(self, item: &Item, parameter: &Parameter) -> Option<FileRows<'d>> {
        if item.text().is_some() {
            let rows = self.rows(item, &Wishes::default(), parameter)?;
            return self.treated(rows, Treatment::none(parameter));
        }
        let owner = format!("`{}`", parameter.name);
        let table = Table::new(item, owner, item.place, self.quantities.faults)?;
        let rows = self.rows_in(&table, parameter);
        table.finish();
        rows
    }

    /// The rows of the file that a table names with its key `file`.
    pub(super) fn rows_in(self, table: &Table<'_>, parameter: &Parameter) -> Option<FileRows<'d>> {
        let name = table.require(FILE, "file = \"curve.csv\"");
        let pair = |key: &'static str, expected: &str| {
            let Some(entry) = table.take(key) else { return Some(None) };
            if let Content::List(items) = &entry.item.value
                && let [first, second] = &**items
            {
                return Some(Some([first, second]));
            }
            wrong_type(&entry.item, &format!("`{key}`"), expected, self.quantities.faults);
            None
        };
        let columns = pair("columns", "a pair of numbers or names, for example `[1, 2]`");
        let units = pair("units", "a pair of units, for example `[\"mm\", \"kN\"]`");
        let scale = match table.take(SCALE) {
            Some(own) => {
                let number = Dimension::NUMBER;
                let is_record = parameter.kind == ParameterKind::TimeTable;
                let range = if is_record { Range::NotZero } else { Range::Positive };
                Some(self.quantities.within(range, SCALE, &own.item, number)?)
            }
            None => None,
        };
        let treatment = self.treatment(table, parameter)?;
        let channel = table.take(CHANNEL).map(|own| &own.item);
        let wishes = Wishes { columns: columns?, units: units?, scale, channel };
        self.treated(self.rows(&name?.item, &wishes, parameter)?, treatment)
    }

    fn rows(self, name: &Item, wishes: &Wishes<'_>, parameter: &Parameter) -> Option<FileRows<'d>> {
        let faults = self.quantities.faults;
        let path = text_of(name, &format!("`{FILE}`"), faults)?;
        let file = self.quantities.files.get(path, name.place, faults)?;
        if let Some(channels) = &file.channels {
            if parameter.kind != ParameterKind::TimeTable {
                let help = "write its points into a table, such as a CSV file".to_owned();
                let fault = Fault::odd("a test in ISO-MME is a function of time".to_owned(), help);
                faults.error(name.place, fault);
                return None;
            }
            let wanted = (wishes.channel, wishes.scale.unwrap_or(1.0));
            return self.of_channel(file, channels, wanted, name.place);
        }
        if let Some(item) = wishes.channel {
            let help = "of a table write `columns = [\"t\", \"acc\"]`".to_owned();
            let message = "`channel` is one of a test in ISO-MME, an `.mme` file".to_owned();
            faults.error(item.place, Fault::odd(message, help));
            return None;
        }
        let teller = Teller { quantities: self.quantities, file, named: name.place };
        let table = match DataTable::read(&file.source.text) {
            Ok(table) => table,
            Err(error) if *error.fault == TableFault::Empty => {
                return self.without_rows(path, name.place);
            }
            Err(error) => {
                teller.refuse(error);
                return None;
            }
        };
        if let Some(lines) = LeftOut::of(&table) {
            file.remark(Remark::LeftOut(lines));
        }
        if table.columns() < 2 {
            teller.tell(0..0, Fault::Table(TableFault::OneColumn), Vec::new());
            return None;
        }
        let columns = self.columns(&table, wishes, parameter, name.place)?;
        let units = self.units(&table, columns, wishes, parameter, &teller)?;
        let mut scales =
            units.map(|own| own.map_or(Scale::SI, |factor| Scale { factor, offset: 0.0 }));
        scales[1].factor *= wishes.scale.unwrap_or(1.0);
        let samples = table.samples(columns, scales, |error| teller.refuse(error))?;
        if samples.points.is_empty() {
            return self.without_rows(path, name.place);
        }
        let largest = |of: fn(&(f64, f64)) -> f64| {
            samples.points.iter().map(of).max_by(|one, other| one.abs().total_cmp(&other.abs()))
        };
        let largest = [largest(|own| own.0), largest(|own| own.1)];
        let missing = [0, 1].map(|at| largest[at].filter(|_| units[at].is_none()));
        self.without_units(missing, parameter, name.place);
        self.odd_units([0, 1].map(|at| largest[at].zip(units[at])), parameter, name.place);
        if parameter.kind == ParameterKind::TimeTable
            && let Some(error) = out_of_order(&table, columns[0], &samples)
        {
            teller.refuse(error);
            return None;
        }
        let points = samples.points.into_iter().zip(samples.starts);
        let rows: Vec<Row> = points.map(|((at, value), start)| Row { at, value, start }).collect();
        for row in &rows {
            let (basis, first) = (self.quantities.basis, self.dimensions(parameter)[0]);
            if let Err(invalid) = basis.check(parameter.name, first, row.at) {
                let help = "give its unit: `[%]` in the header, or `units = [\"%\", \"kPa\"]` in the scene";
                let fault = Fault::Invalid(invalid).with_help(help);
                teller.tell(file.row(row.start), fault, Vec::new());
                return None;
            }
        }
        Some(FileRows { file, rows, place: name.place })
    }

    /// What one of the unit of each of two columns is in SI units; nothing where none says a unit.
    fn units(
        self,
        table: &DataTable<'_>,
        columns: [usize; 2],
        wishes: &Wishes<'_>,
        parameter: &Parameter,
        teller: &Teller<'_>,
    ) -> Option<[Option<f64>; 2]> {
        let dimensions = self.dimensions(parameter);
        let is_motion =
            parameter.kind == ParameterKind::TimeTable && self.driven == Dimension::LENGTH;
        let [first, second] = [0, 1].map(|at| {
            let quantities = Quantities { is_motion: is_motion && at == 1, ..self.quantities };
            let given = wishes.units.map(|units| units[at]);
            let misread = misread_unit(table, columns[at]).filter(|_| given.is_none());
            if let Some((error, span)) = misread {
                let expected = self.quantities.basis.dimension(dimensions[at]);
                let column = table.name(columns[at]).map(|own| in_column(own.0));
                let fault = Fault::Unreadable { error, expected };
                teller.tell(span, fault, column.into_iter().collect());
                return None;
            }
            let written = table.unit(columns[at]);
            unit(teller.file, written, given, dimensions[at], quantities.unwatched())
        });
        Some([first?, second?])
    }

    fn without_rows<T>(self, path: &str, place: Place) -> Option<T> {
        let fault = Fault::NoRows { path: path.to_owned() };
        self.quantities.faults.error(place, fault);
        None
    }

    /// What the two columns measure, in a model.
    fn dimensions(self, parameter: &Parameter) -> [Dimension; 2] {
        match parameter.kind {
            ParameterKind::Curve(first, second) => [first, second],
            _ => [Dimension::TIME, self.driven],
        }
    }

    /// What the two columns measure, as they are written here.
    pub(super) fn written(self, parameter: &Parameter) -> [Dimension; 2] {
        self.dimensions(parameter).map(|own| self.quantities.basis.dimension(own))
    }

    /// What the two columns are called.
    fn columns_in_words(parameter: &Parameter) -> &'static str {
        match parameter.kind {
            ParameterKind::TimeTable => "time and value",
            _ => "deformation and force, or strain and stress",
        }
    }

    /// The two columns, counted from 0: those that the scene names, those that their units tell, or the only two.
    fn columns(
        self,
        table: &DataTable<'_>,
        wishes: &Wishes<'_>,
        parameter: &Parameter,
        place: Place,
    ) -> Option<[usize; 2]> {
        if let Some(wanted) = wishes.columns {
            let [first, second] = wanted.map(|wanted| self.column(table, wanted));
            return Some([first?, second?]);
        }
        let found = self.written(parameter).map(|own| table.measuring(own));
        if let [[first], [second]] = found.each_ref().map(Vec::as_slice) {
            return Some([*first, *second]);
        }
        if table.columns() == 2 {
            return Some([0, 1]);
        }
        let names = (0..table.columns()).map(|at| table.heading(at).name.to_owned());
        let fault = TableFault::WhichColumns {
            count: table.columns(),
            wanted: Self::columns_in_words(parameter).to_owned(),
            names: names.filter(|name| !name.is_empty()).collect(),
        };
        self.quantities.faults.error(place, Fault::Table(fault));
        None
    }

    /// The column that `wanted` names or counts from 1.
    fn column(self, table: &DataTable<'_>, wanted: &Item) -> Option<usize> {
        let faults = self.quantities.faults;
        match &wanted.value {
            Content::Number(digits) => {
                let number = digits.parse::<usize>().ok().and_then(|own| own.checked_sub(1));
                let found = number.filter(|number| *number < table.columns());
                if found.is_none() {
                    let (wanted_text, count) = (digits.to_string(), table.columns());
                    let fault = TableFault::NoColumn { wanted: wanted_text, count };
                    faults.error(wanted.place, Fault::Table(fault));
                }
                found
            }
            Content::Text(name) => match table.position(name) {
                Ok(found) => Some(found),
                Err(error) if matches!(*error.fault, TableFault::SharedName { .. }) => {
                    faults.error(wanted.place, Fault::Table(*error.fault));
                    None
                }
                Err(_) => {
                    let names = (0..table.columns()).map(|at| table.heading(at).name.to_owned());
                    let known = names.filter(|name| !name.is_empty()).collect();
                    let (family, name) = ("column", name.to_string());
                    faults.error(wanted.place, Fault::UnknownName { family, name, known });
                    None
                }
            },
            _ => {
                wrong_type(wanted, "a column", "a number from 1, or a name", faults);
                None
            }
        }
    }

    /// The value of a parameter from the rows of a file; `before` is that of the parameter before it.
    pub(super) fn of_rows(
        self,
        parameter: &Parameter,
        found: &FileRows<'_>,
        before: Option<&Value>,
    ) -> Option<Value> {
        let FileRows { file, rows, place } = found;
        let faults = self.quantities.faults;
        if parameter.kind == ParameterKind::TimeTable {
            return Some(Value::Table(self.over_time(found)));
        }
        let name = parameter.name;
        let tell = |start: usize, fault: TableFault| {
            let note = format!("the file is named in {}", faults.whereabouts(*place));
            let place = Place::new(file.number, &file.row(start));
            faults.error(place, Fault::Table(fault).with_note(note));
        };
        let largest =
            rows.iter().max_by(|one, other| one.value.abs().total_cmp(&other.value.abs()));
        if let Some(row) = largest.filter(|row| row.value < 0.0) {
            tell(row.start, TableFault::Negative { curve: name });
            return None;
        }
        let rows = if parameter.curve == CurveRole::Unloading {
            &rows[..]
        } else {
            let Some(out) = outward(rows) else {
                tell(turning_row(rows)?.start, TableFault::TurnsBack { curve: name });
                return None;
            };
            if let [first, .., last] | [first @ last] = &rows[out.len()..] {
                let lines = [first, last].map(|own| file.line(own.start));
                file.remark(Remark::WayBack { curve: name, lines });
            }
            out
        };
        let fitted = match (parameter.curve, before) {
            (CurveRole::Unloading, Some(Value::Table(loading))) => unloading(loading, rows),
            (role, _) => Some(fit(rows, role)),
        };
        let Some(Fitted { points, difference }) = fitted else {
            tell(rows[0].start, TableFault::NoCurve { curve: name });
            return None;
        };
        self.change(parameter, found, &points, difference);
        Some(Value::Table(points))
    }

    /// Tells how far the points of a curve are from the rows, as a note or, where it is no noise, as a warning.
    fn change(
        self,
        parameter: &Parameter,
        found: &FileRows<'_>,
        points: &[(f64, f64)],
        own: Difference,
    ) {
        let change = CurveChange {
            curve: parameter.name,
            rows: own.rows,
            points: points.len(),
            largest: own.largest,
            line: found.file.line(own.start),
            mean: own.mean,
            peak: own.peak,
            dimension: self.written(parameter)[1],
            begins: own.begins,
        };
        if change.is_large() {
            self.quantities.faults.warning(found.place, Fault::CurveChanged(change));
        } else if change.is_any() {
            found.file.remark(Remark::Curve(change));
        }
    }

    /// The loading and the unloading of a record that goes out and back.
    pub(super) fn branches(self, found: &FileRows<'d>) -> Option<[FileRows<'d>; 2]> {
        let FileRows { file, rows, place } = found;
        match split(rows) {
            Ok((loading, unloading)) => {
                Some([loading, unloading].map(|rows| FileRows { file, rows, place: *place }))
            }
            Err(at) => {
                let fault = match rows.get(at) {
                    Some(_) => TableFault::SecondCycle,
                    None => TableFault::NoUnloading,
                };
                let row = rows.get(at).or(rows.last())?;
                let place = Place::new(file.number, &file.row(row.start));
                self.quantities.faults.error(place, Fault::Table(fault));
                None
            }
        }
    }

    /// The points of rows in order of time.
    fn over_time(self, FileRows { rows, place, .. }: &FileRows<'_>) -> Vec<(f64, f64)> {
        if rows.len() == 1 {
            let message = "a table with one point is a constant for ever";
            let help = "give at least two rows, or write `constant`";
            self.quantities.faults.warning(*place, Fault::odd(message, help));
        }
        rows.iter().map(|row| (row.at, row.value)).collect()
    }
}

/// The first time that stands after a later one, with the lines of all others.
fn out_of_order(table: &DataTable<'_>, column: usize, samples: &Samples) -> Option<TableError> {
    let (mut before, mut first) = (0, None::<TableError>);
    for (at, point) in samples.points.iter().enumerate() {
        if point.0 >= samples.points[before].0 {
            before = at;
        } else if let [Some(own), Some(earlier)] =
            [at, before].map(|row| table.cell(samples.starts[row], column))
        {
            let (found, before) = (own.text.to_owned(), earlier.text.to_owned());
            let fault = TableFault::OutOfOrder { found, before };
            let error = table.error(own.span(), column, fault);
            match &mut first {
                Some(known) => known.likewise.get_or_insert_default().add(error.line),
                None => first = Some(error),
            }
        }
    }
    first
}
