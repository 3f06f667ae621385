//! The values of a kind where they are written together: alone, in a table, or with a file for points.

use dashpot_network::parameters::{Parameter, Value};

use super::{are_file, is_points, parameters::KindReader};
use crate::{
    diagnostics::fault::Fault,
    quantities::basis::{Basis, SIZE, is_size},
    quantities::sizes::Size,
    text::{
        document::{Entry, Item},
        library::tables::names_file,
        source::Place,
        table::{Table, wrong_type},
    },
};

/// Where a parameter's value stands, and the value where it is given.
pub(super) type Given<'i> = (Place, Option<&'i Item>);

fn given(entry: Option<&Entry>, place: Place) -> Given<'_> {
    entry.map_or((place, None), |entry| (entry.item.place, Some(&entry.item)))
}

/// Whether a file may stand for the values of these parameters: in a table, or alone.
fn takes_file(parameters: &[Parameter], item: &Item) -> bool {
    if item.text().is_some() { are_file(parameters) } else { parameters.iter().any(is_points) }
}

impl<'d> KindReader<'d> {
    pub(super) fn values<'i>(
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
            let read = |parameter: &Parameter| match parameter.default {
                None => self.value(parameter, item),
                Some(_) => self.default(parameter),
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
            let entry = self.entry(parameter, &table);
            places.push(given(entry, place));
            let before = values.last().and_then(Option::as_ref);
            let value = match entry {
                _ if parameter.default.is_some() && is_size(parameter) => {
                    self.size_of(parameter, entry, (word, place)).map(Value::Number)
                }
                Some(entry) if parameter.default.is_none() => {
                    self.value_after(parameter, &entry.item, before)
                }
                Some(entry) => self.value(parameter, &entry.item),
                None => parameter.default.as_ref().and_then(|_| self.default(parameter)),
            };
            values.push(value);
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
        let entry = self.entry(parameter, table);
        let value = match (entry, parameter.default) {
            (Some(entry), _) => self.value(parameter, &entry.item),
            (None, None) => None,
            (None, Some(_)) => self.default(parameter),
        };
        (value, given(entry, place))
    }

    /// What a table says of a parameter; one without a default has to be there.
    fn entry<'i>(self, parameter: &Parameter, table: &Table<'i>) -> Option<&'i Entry> {
        if parameter.default.is_some() {
            return table.take(parameter.name);
        }
        let value = || self.example().value(std::slice::from_ref(parameter));
        table.require_with(parameter.name, || format!("{} = {}", parameter.name, value()))
    }

    /// A value that may depend on that of the parameter before it, as unloading does on loading.
    pub(super) fn value_after(
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
        let around = || self.size.around(key, place);
        let size = match (entry, self.size.beside(key).or_else(around)) {
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
}
