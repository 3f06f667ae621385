//! Quantities where they stand: numbers, texts with units, and named values.

use std::collections::HashMap;

use dashpot_network::parameters::Dimension;

use crate::{
    diagnostics::Faults,
    document::{Content, Item},
    fault::Fault,
    source::Place,
    units::{Quantity, UnitError, parse_quantity},
};

/// The named values of one document, `None` for those that are faulty.
pub(crate) type Values = HashMap<String, Option<Quantity>>;

/// Reads quantities with the names that hold in one document.
#[derive(Clone, Copy)]
pub(crate) struct Quantities<'d> {
    /// Named values.
    pub(crate) values: &'d Values,
    /// Where errors go.
    pub(crate) faults: &'d Faults,
}

impl Quantities<'_> {
    /// The quantity `item`, in SI units, with an error where it does not have this dimension.
    pub(crate) fn read(self, item: &Item, expected: Dimension) -> Option<f64> {
        let quantity = match &item.value {
            Content::Number(digits) => self.parsed(digits, item.place, expected)?,
            Content::Text(text) => match self.values.get(text.trim()) {
                Some(known) => (*known)?,
                None => self.parsed(text, item.place, expected)?,
            },
            _ => {
                let fault = Fault::NoQuantity { found: item.type_name(), expected };
                self.faults.error(item.place, fault);
                return None;
            }
        };
        self.checked(quantity, item, expected)
    }

    /// The quantity that passes `check`, which says what is wrong with it.
    pub(crate) fn read_checked<E: Into<Fault>>(
        self,
        item: &Item,
        expected: Dimension,
        check: impl FnOnce(f64) -> Result<(), E>,
    ) -> Option<f64> {
        let value = self.read(item, expected)?;
        match check(value) {
            Ok(()) => Some(value),
            Err(fault) => {
                self.faults.error(item.place, fault.into());
                None
            }
        }
    }

    fn parsed(self, text: &str, place: Place, expected: Dimension) -> Option<Quantity> {
        let error = match parse_quantity(text) {
            Ok(quantity) => return Some(quantity),
            Err(error) => error,
        };
        let name = text.trim();
        if name.is_empty() && self.faults.damaged() {
            return None;
        }
        let fault = if matches!(error, UnitError::NoNumber { .. }) && could_be_name(name) {
            let mut known: Vec<String> = self.values.keys().cloned().collect();
            known.sort();
            Fault::UnknownName { family: "value", name: name.to_owned(), known }
        } else {
            Fault::Unreadable { error, expected }
        };
        self.faults.error(place, fault);
        None
    }

    fn checked(self, quantity: Quantity, item: &Item, expected: Dimension) -> Option<f64> {
        let found = quantity.dimension.unwrap_or(expected);
        let shown = || match &item.value {
            Content::Text(text) => text.trim().to_owned(),
            _ => self.faults.text(item.place),
        };
        if found != expected {
            let fault = Fault::WrongDimension { text: shown(), found, expected };
            self.faults.error(item.place, fault);
            return None;
        }
        if expected == Dimension::FREQUENCY && quantity.angle != 0 {
            let frequency = quantity.value / std::f64::consts::TAU;
            self.faults.error(item.place, Fault::AngularFrequency { text: shown(), frequency });
            return None;
        }
        Some(quantity.value)
    }
}

/// Whether a text that is no number can be meant as the name of a value.
fn could_be_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_alphabetic() || first == '_')
        && !text.contains(char::is_whitespace)
}
