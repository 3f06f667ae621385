//! Values of a kind's parameters, read as the kind declares them.

use dashpot_network::parameters::{
    Dimension, Formula, InvalidParameter, Parameter, ParameterKind, Registered, Value, WindowWish,
};

use super::{Example, is_points};
use crate::{
    diagnostics::fault::Fault,
    quantities::{
        basis::{Basis, EnclosingPad, SIZE, Size, is_size},
        quantity::{Definition, Quantities, Values},
    },
    text::{
        document::{Content, Entry, Item},
        library::names_file,
        source::Place,
        table::{Table, text_of, wrong_type},
    },
    units::parse_quantity,
};

/// What makes a thing of its values.
pub(crate) type Make<'m, T> = dyn Fn(&[Value]) -> Result<T, InvalidParameter> + 'm;

/// Where a parameter's value stands, and the value where it is given.
type Given<'i> = (Place, Option<&'i Item>);

fn given(entry: Option<&Entry>, place: Place) -> Given<'_> {
    entry.map_or((place, None), |entry| (entry.item.place, Some(&entry.item)))
}

/// Whether a file may stand for the values of these parameters: alone, where all that is required is points.
fn takes_file(parameters: &[Parameter], item: &Item) -> bool {
    let mut required = parameters.iter().filter(|own| own.default.is_none());
    parameters.iter().any(is_points) && (item.text().is_none() || required.all(is_points))
}

/// Reads things of the kinds in the registers.
#[derive(Clone, Copy)]
pub(crate) struct KindReader<'d> {
    /// Reads their quantities.
    pub(crate) quantities: Quantities<'d>,
    /// Dimension of amplitudes.
    pub(crate) driven: Dimension,
    /// What is said about the size of a pad around it.
    pub(crate) size: EnclosingPad,
    /// Keys of their tables that others read.
    pub(crate) other_keys: &'static [&'static str],
}

impl<'d> KindReader<'d> {
    /// A reader for kinds that drive a force.
    pub(crate) fn new(quantities: Quantities<'d>) -> Self {
        let size = EnclosingPad::default();
        Self { quantities, driven: Dimension::FORCE, size, other_keys: &[] }
    }

    fn example(self) -> Example {
        Example { basis: self.quantities.basis, driven: Some(self.driven) }
    }

    /// Reads the thing of `kind` that `item` describes; its word stands at `place`.
    ///
    /// A kind with one required parameter takes the value alone; all others take a table.
    pub(crate) fn read<T, A>(
        self,
        kind: &Registered<T, A>,
        item: &Item,
        place: Place,
    ) -> Option<T> {
        self.read_as((kind.word, kind.parameters), &kind.make, item, place)
    }

    /// Reads what `make` makes of parameters, which `item` gives for the word at `place`.
    pub(crate) fn read_as<T>(
        self,
        (word, parameters): (&str, &[Parameter]),
        make: &Make<'_, T>,
        item: &Item,
        place: Place,
    ) -> Option<T> {
        let (values, places) = self.values(word, parameters, item, place)?;
        match self.made(parameters, make, &values) {
            Ok(made) => Some(made),
            Err(invalid) => {
                let at = parameters.iter().position(|known| known.name == invalid.parameter);
                let found = at.and_then(|at| places.get(at).copied());
                let (place, item) = found.unwrap_or((item.place, Some(item)));
                let name = invalid.parameter;
                let fits = |part: f64| {
                    let mut values = values.clone();
                    if let Some(value) = at.and_then(|at| values.get_mut(at)) {
                        *value = Value::Number(part);
                    }
                    let again = self.made(parameters, make, &values);
                    again.map_or_else(|other| other.parameter != name, |_| true)
                };
                let fault = Fault::Invalid(invalid);
                let fault = match item {
                    Some(item) => {
                        let fault = self.helped(fault, item);
                        self.quantities.traced(item, self.as_part(fault, item, fits))
                    }
                    None => fault,
                };
                self.quantities.faults.error(place, fault);
                None
            }
        }
    }

    /// `fault`, which is about the value `item`, with the part of one that was probably meant by a
    /// number of percent.
    fn as_part(self, fault: Fault, item: &Item, fits: impl Fn(f64) -> bool) -> Fault {
        match self.quantities.peek(item) {
            Some(value) if self.quantities.is_bare(item) && value > 1.0 && fits(value / 100.0) => {
                let part = value / 100.0;
                fault.with_help(format!("write {part}, or \"{value} %\""))
            }
            _ => fault,
        }
    }

    /// The quantity `item` of a parameter.
    fn quantity(self, name: &'static str, item: &Item, dimension: Dimension) -> Option<f64> {
        let value = self.quantities.of(name).read(item, dimension)?;
        self.fitting(name, item, dimension, value)
    }

    /// The quantity `value`, with an error where no pad can have it.
    fn fitting(
        self,
        name: &'static str,
        item: &Item,
        dimension: Dimension,
        value: f64,
    ) -> Option<f64> {
        let basis = self.quantities.basis;
        let Err(invalid) = basis.check(name, dimension, value) else { return Some(value) };
        let fits = |part| basis.check(name, dimension, part).is_ok();
        let fault = self.as_part(Fault::Invalid(invalid), item, fits);
        self.quantities.faults.error(item.place, self.quantities.traced(item, fault));
        None
    }

    /// `fault`, which is about the value `item`, with the unit that was probably meant.
    fn helped(self, fault: Fault, item: &Item) -> Fault {
        let is_temperature = matches!(
            &fault,
            Fault::Invalid(invalid) if ["temperature", "reference"].contains(&invalid.parameter)
        );
        match self.quantities.peek(item) {
            Some(value) if is_temperature && self.quantities.is_bare(item) => fault.with_help(
                format!("a bare number is in K; write it with its unit: \"{value} degC\""),
            ),
            _ => fault,
        }
    }

    /// What `make` makes of the written `values`, for the pad where they are those of a material.
    fn made<T>(
        self,
        parameters: &[Parameter],
        make: &Make<'_, T>,
        values: &[Value],
    ) -> Result<T, InvalidParameter> {
        let basis = self.quantities.basis;
        if !basis.is_material() {
            return make(values);
        }
        let of_pad = basis.of_pad_all(parameters, values, self.driven);
        let of_pad = of_pad.and_then(|of_pad| make(&of_pad));
        // A value that is out of range as it is written is told as it is written.
        of_pad.or_else(|invalid| make(values).and(Err(invalid)))
    }

    /// The thing of `kind` with all keys left out.
    pub(crate) fn defaults<T, A>(self, kind: &Registered<T, A>, place: Place) -> Option<T> {
        self.read(kind, &Item { value: Content::Table(Box::default()), place }, place)
    }

    fn values<'i>(
        self,
        word: &str,
        parameters: &[Parameter],
        item: &'i Item,
        place: Place,
    ) -> Option<(Vec<Value>, Vec<Given<'i>>)>
    where
        'd: 'i,
    {
        let faults = self.quantities.faults;
        let required = parameters.iter().filter(|known| known.default.is_none()).count();
        let is_table = item.table().is_some();
        if required == 1 && (!is_table || parameters.len() == 1) {
            let read = |parameter: &Parameter| {
                if parameter.default.is_none() {
                    self.value(parameter, item)
                } else {
                    self.default(parameter)
                }
            };
            let values = parameters.iter().map(read).collect::<Option<Vec<_>>>()?;
            return Some((values, vec![(item.place, Some(item)); parameters.len()]));
        }
        if names_file(item) && takes_file(parameters, item) {
            return self.with_file((word, parameters), item, place);
        }
        if !is_table {
            let expected = format!("a table, for example `{}`", self.example().value(parameters));
            wrong_type(item, &format!("`{word}`"), &expected, faults);
            return None;
        }
        let table = Table::new(item, format!("`{word}`"), place, faults)?;
        for key in self.other_keys {
            table.take(key);
        }
        let mut places = Vec::with_capacity(parameters.len());
        let mut values = Vec::with_capacity(parameters.len());
        for parameter in parameters {
            let entry = match parameter.default {
                None => {
                    let value = self.example().value(std::slice::from_ref(parameter));
                    let entry =
                        table.require(parameter.name, &format!("{} = {value}", parameter.name));
                    places.push(given(entry, place));
                    let before = values.last().and_then(Option::as_ref);
                    let value =
                        entry.and_then(|entry| self.value_after(parameter, &entry.item, before));
                    values.push(value);
                    continue;
                }
                Some(_) => table.take(parameter.name),
            };
            places.push(given(entry, place));
            if is_size(parameter) {
                let size = self.size_of(parameter, entry, (word, place));
                values.push(size.map(Value::Number));
                continue;
            }
            values.push(match entry {
                Some(entry) => self.value(parameter, &entry.item),
                None => self.default(parameter),
            });
        }
        table.finish();
        Some((values.into_iter().collect::<Option<Vec<_>>>()?, places))
    }

    /// The values of a kind whose points are in the file that `item` names. A kind with two curves takes a record
    /// that goes out and back.
    fn with_file<'i>(
        self,
        (word, parameters): (&str, &[Parameter]),
        item: &'i Item,
        place: Place,
    ) -> Option<(Vec<Value>, Vec<Given<'i>>)>
    where
        'd: 'i,
    {
        let curve = parameters.iter().find(|own| is_points(own))?;
        let others = parameters.iter().filter(|own| !is_points(own));
        let (rows, others) = if item.text().is_some() {
            let default = |own| (self.default(own), given(None, place));
            (self.rows_of(item, curve), others.map(default).collect::<Vec<_>>())
        } else {
            let table = Table::new(item, format!("`{word}`"), place, self.quantities.faults)?;
            for key in self.other_keys {
                table.take(key);
            }
            let rows = self.rows_in(&table, curve);
            let others = others.map(|own| self.beside_file(own, &table, place)).collect();
            table.finish();
            (rows, others)
        };
        let mut others = others.into_iter();
        let rows = rows?;
        let rows = match parameters.iter().filter(|own| is_points(own)).count() {
            1 => vec![rows],
            _ => self.branches(&rows)?.into(),
        };
        let mut rows = rows.iter();
        let (mut values, mut places) = (Vec::new(), Vec::new());
        for parameter in parameters {
            let (value, place) = if is_points(parameter) {
                let value = self.of_rows(parameter, rows.next()?, values.last());
                (value, (item.place, Some(item)))
            } else {
                others.next()?
            };
            values.push(value?);
            places.push(place);
        }
        Some((values, places))
    }

    /// A value that stands beside the name of a file.
    fn beside_file<'i>(
        self,
        parameter: &Parameter,
        table: &Table<'i>,
        place: Place,
    ) -> (Option<Value>, Given<'i>) {
        let entry = match parameter.default {
            None => {
                let value = self.example().value(std::slice::from_ref(parameter));
                table.require(parameter.name, &format!("{} = {value}", parameter.name))
            }
            Some(_) => table.take(parameter.name),
        };
        let value = match (entry, parameter.default) {
            (Some(entry), _) => self.value(parameter, &entry.item),
            (None, None) => None,
            (None, Some(_)) => self.default(parameter),
        };
        (value, given(entry, place))
    }

    /// A value that may depend on that of the parameter before it, as unloading does on loading.
    fn value_after(
        self,
        parameter: &Parameter,
        item: &Item,
        before: Option<&Value>,
    ) -> Option<Value> {
        if !is_points(parameter) || !names_file(item) {
            return self.value(parameter, item);
        }
        let rows = self.rows_of(item, parameter)?;
        self.of_rows(parameter, &rows, before)
    }

    pub(crate) fn value(self, parameter: &Parameter, item: &Item) -> Option<Value> {
        if is_points(parameter) && names_file(item) {
            return self.value_after(parameter, item, None);
        }
        let faults = self.quantities.faults;
        let what = || format!("`{}`", parameter.name);
        match parameter.kind {
            ParameterKind::Quantity(dimension) => {
                self.quantity(parameter.name, item, dimension).map(Value::Number)
            }
            ParameterKind::TemperatureDifference => {
                self.quantities.read_difference(item).map(Value::Number)
            }
            ParameterKind::Amplitude => self.amplitude(item).map(Value::Number),
            ParameterKind::TimeTable => {
                self.points(item, parameter, [Dimension::TIME, self.driven]).map(Value::Table)
            }
            ParameterKind::Curve(first, second) => {
                self.points(item, parameter, [first, second]).map(Value::Table)
            }
            ParameterKind::LawFormula => {
                let expected = Dimension::FORCE;
                self.formula(parameter, item, expected).map(Value::Formula)
            }
            ParameterKind::TimeFormula => {
                self.formula(parameter, item, self.driven).map(Value::Formula)
            }
            ParameterKind::Choice(words) => {
                let word = text_of(item, &what(), faults)?;
                if words.contains(&word) {
                    return Some(Value::Word(word.to_owned()));
                }
                let (word, known) = (word.to_owned(), words.to_vec());
                let family = format!("a value of {}", what());
                faults.error(item.place, Fault::UnknownWord { family, word, known });
                None
            }
            ParameterKind::Flag => {
                if matches!(item.value, Content::Switch(true)) {
                    return Some(Value::Flag);
                }
                wrong_type(item, &what(), "`true`, or left out", faults);
                None
            }
            ParameterKind::Window => self.window(item).map(Value::Window),
            ParameterKind::Node => {
                text_of(item, &what(), faults).map(|name| Value::Word(name.to_owned()))
            }
            // Whoever has one reads it with the models of the scene at hand.
            ParameterKind::Model => {
                wrong_type(item, &what(), "a model of the scene", faults);
                None
            }
        }
    }

    /// The thickness or area of the pad that the thing of the word at `place` is.
    fn size_of(
        self,
        parameter: &Parameter,
        entry: Option<&Entry>,
        (word, place): (&str, Place),
    ) -> Option<f64> {
        let (key, faults) = (parameter.name, self.quantities.faults);
        if let Basis::Material(pad) = self.quantities.basis {
            if let Some(entry) = entry {
                faults.error(entry.key_place, Fault::SizeInMaterial { key });
            }
            return Some(if key == SIZE[0] { pad.thickness } else { pad.area });
        }
        let size = match (entry, self.size.beside(key)) {
            (Some(entry), _) => {
                let value = self.value(parameter, &entry.item)?.number()?;
                Size { value, place: entry.item.place }
            }
            (None, Some(beside)) => beside,
            (None, None) => {
                let fault = self.size.missing(key, &format!("`{word}`"));
                if let Some(fault) = fault {
                    faults.missing(place, fault);
                }
                return None;
            }
        };
        self.size.check(key, size, faults);
        Some(size.value)
    }

    /// A formula over the variables of the parameter, with the named values in it replaced.
    fn formula(self, parameter: &Parameter, item: &Item, expected: Dimension) -> Option<Formula> {
        let what = format!("`{}`", parameter.name);
        let text = text_of(item, &what, self.quantities.faults)?;
        let variables = parameter.kind.variables();
        let own = Definition { text: text.to_owned(), place: item.place };
        self.quantities.formula(&own, variables, expected)
    }

    fn amplitude(self, item: &Item) -> Option<f64> {
        let is_motion = self.driven == Dimension::LENGTH;
        Quantities { is_motion, ..self.quantities }.read(item, self.driven)
    }

    fn points(
        self,
        item: &Item,
        parameter: &Parameter,
        dimensions: [Dimension; 2],
    ) -> Option<Vec<(f64, f64)>> {
        let (faults, kind) = (self.quantities.faults, parameter.kind);
        let quiet = Self { quantities: self.quantities.unwatched(), ..self };
        let Content::List(points) = &item.value else {
            let example = self.example().parameter(kind);
            let expected = format!("a list of pairs, for example `{example}`");
            wrong_type(item, &format!("`{}`", parameter.name), &expected, faults);
            return None;
        };
        let point = |item: &Item| {
            let pair: Option<&[Item; 2]> = match &item.value {
                Content::List(pair) => (**pair).try_into().ok(),
                _ => None,
            };
            if pair.is_none() {
                let pair = if kind == ParameterKind::TimeTable {
                    "a pair [time, value]"
                } else {
                    "a pair of quantities"
                };
                wrong_type(item, "a point", pair, faults);
            }
            let [first, second] = pair?;
            let first = quiet.coordinate(parameter, first, dimensions[0]);
            let second = match kind {
                ParameterKind::TimeTable => quiet.amplitude(second),
                _ => quiet.coordinate(parameter, second, dimensions[1]),
            };
            first.zip(second)
        };
        // Every point is read, so that all faults are found.
        let read = points.iter().map(point).collect::<Vec<_>>();
        let read = read.into_iter().collect::<Option<Vec<_>>>()?;
        self.check_largest(points, &read, dimensions);
        Some(read)
    }

    fn coordinate(self, parameter: &Parameter, item: &Item, dimension: Dimension) -> Option<f64> {
        let value = self.quantities.read(item, dimension)?;
        self.fitting(parameter.name, item, dimension, value)
    }

    /// Looks whether points are unusual, by the largest of their values in each place.
    fn check_largest(self, points: &[Item], read: &[(f64, f64)], dimensions: [Dimension; 2]) {
        let sizes = |at: usize| {
            let size = move |own: &(f64, f64)| if at == 0 { own.0 } else { own.1 };
            read.iter().map(size).zip(points)
        };
        for (at, dimension) in dimensions.into_iter().enumerate() {
            let largest = sizes(at).max_by(|first, other| first.0.abs().total_cmp(&other.0.abs()));
            if let Some((value, Item { value: Content::List(pair), .. })) = largest {
                let dimension = self.quantities.basis.dimension(dimension);
                self.quantities.warn(&pair[at], dimension, value);
            }
        }
    }

    fn window(self, item: &Item) -> Option<WindowWish> {
        match &item.value {
            Content::Text(word) if word == "impact" => Some(WindowWish::Impact),
            Content::Text(word) if word == "run" => Some(WindowWish::Run),
            Content::List(pair) if pair.len() == 2 => {
                let from = self.quantities.read(&pair[0], Dimension::TIME);
                let to = self.quantities.read(&pair[1], Dimension::TIME);
                from.zip(to).map(|(from, to)| WindowWish::Times(from, to))
            }
            Content::Text(word) => {
                let (family, word) = ("a window".to_owned(), word.to_string());
                let fault = Fault::UnknownWord { family, word, known: vec!["impact", "run"] };
                let fault = fault.with_help(
                    "write \"impact\", \"run\" for the whole run, or a pair of times such as \
                     [\"0 ms\", \"15 ms\"]",
                );
                self.quantities.faults.error(item.place, fault);
                None
            }
            _ => {
                let expected = "\"impact\", \"run\" or a pair of times";
                wrong_type(item, "a window", expected, self.quantities.faults);
                None
            }
        }
    }

    /// The value that stands for a key that is left out. The registers write it as a scene would.
    fn default(self, parameter: &Parameter) -> Option<Value> {
        let text = parameter.default?;
        if parameter.follows {
            return Some(Value::LeftOut);
        }
        let content = match parameter.kind {
            ParameterKind::Flag => Content::Switch(text == "true"),
            _ => Content::Text(text.into()),
        };
        let place = Place { source: u32::MAX, start: 0, end: 0 };
        let without_names =
            Quantities { values: &Values::new(), basis: Basis::Model, ..self.quantities };
        let reader = KindReader { quantities: without_names, ..self };
        match parameter.kind {
            ParameterKind::Amplitude => parse_quantity(text).ok().map(|q| Value::Number(q.value)),
            _ => reader.value(parameter, &Item { value: content, place }),
        }
    }
}
