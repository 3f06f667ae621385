//! Things of the registers, made of the values that stand in a scene.

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, Registered, Value};

use super::Example;
use crate::{
    diagnostics::fault::Fault,
    quantities::{quantity::Quantities, sizes::EnclosingPad},
    text::{
        document::{Content, Item},
        source::Place,
    },
};

/// What makes a thing of its values.
pub(crate) type Make<'m, T> = dyn Fn(&[Value]) -> Result<T, InvalidParameter> + 'm;

/// Reads things of the kinds in the registers.
#[derive(Clone, Copy)]
pub(crate) struct KindReader<'d> {
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

    pub(super) fn example(self) -> Example {
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

    /// `fault`, which is about the value `item`, with the part of one that was probably meant by a number of percent.
    pub(super) fn as_part(self, fault: Fault, item: &Item, fits: impl Fn(f64) -> bool) -> Fault {
        match self.quantities.peek(item) {
            Some(value) if self.quantities.is_bare(item) && value > 1.0 && fits(value / 100.0) => {
                let part = value / 100.0;
                fault.with_help(format!("write {part}, or \"{value} %\""))
            }
            _ => fault,
        }
    }

    /// `fault`, which is about the value `item`, with the unit that was probably meant.
    fn helped(self, fault: Fault, item: &Item) -> Fault {
        let is_temperature = matches!(
            &fault,
            Fault::Invalid(invalid) if ["temperature", "reference"].contains(&invalid.parameter)
        );
        let is_stiffness =
            matches!(&fault, Fault::Invalid(invalid) if invalid.parameter == "stiffness");
        match self.quantities.peek(item) {
            Some(0.0) if is_stiffness => fault.with_help(
                "a part without stiffness is left out; a force that is the same at every deformation is a load on \
                 each of its ends, `force = { constant = … }`",
            ),
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
}
