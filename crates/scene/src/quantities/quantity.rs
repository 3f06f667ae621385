//! Quantities where they stand: numbers, texts with units, and named values.

use dashpot_formula::{Formula, FormulaError, Variable};
use dashpot_network::parameters::{Dimension, Range};
use dashpot_units::{Quantity, UnitError, format_short, parse_quantity, si_unit};

use super::{
    arithmetic::{self, formula},
    basis::{Basis, powers},
    named::{Definition, Values},
    plausible,
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    text::{
        document::{Content, Item},
        source::Place,
        table_file::Files,
    },
};

/// What to do where only an acceleration is known.
const MOTION_HELP: &str = "a motion is a displacement: write `acceleration` in place of `motion`";

/// What to do with the values of a material in a model.
const MATERIAL_IN_MODEL_HELP: &str = "stresses and strains belong in [materials]; a pad is made of one by \
                                      `material = \"…\", thickness = \"2 cm\", area = \"100 cm^2\"`";

/// What to do with the values of a pad in a material.
fn pad_in_material_help(in_model: Dimension) -> String {
    let [forces, lengths] = powers(in_model);
    let factor = |power: i32, name: &str| match power.abs() {
        0 => None,
        1 => Some(name.to_owned()),
        power => Some(format!("{name}^{power}")),
    };
    let both = [factor(forces, "area"), factor(lengths, "thickness")];
    let [area, thickness] = both.each_ref().map(|own| own.clone().unwrap_or_default());
    let what = match (forces.signum(), lengths.signum()) {
        (1, -1) => format!("multiply them by {thickness} / {area}"),
        (-1, 1) => format!("multiply them by {area} / {thickness}"),
        (sign, other) => {
            let verb = if sign + other > 0 { "divide" } else { "multiply" };
            let names: Vec<String> = both.into_iter().flatten().collect();
            format!("{verb} them by the {}", names.join(" and the "))
        }
    };
    format!(
        "values in {} belong in [models]; for a material, {what} of the specimen",
        si_unit(in_model)
    )
}

/// Reads quantities with the names that hold in one document.
#[derive(Clone, Copy)]
pub(crate) struct Quantities<'d> {
    pub(crate) values: &'d Values,
    pub(crate) faults: &'d Faults,
    /// Whether they are displacements of a node over time.
    pub(crate) is_motion: bool,
    /// Whether they belong to a model or to a material.
    pub(crate) basis: Basis,
    /// The element that they are about, where an effect on one is read.
    pub(crate) element: Option<Target<'d>>,
    /// What is said of those that are unusual.
    pub(crate) subject: Subject<'d>,
    /// The files of numbers that stand beside their document.
    pub(crate) files: Files<'d>,
}

/// What a quantity is called where it is unusual.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Subject<'d> {
    /// By its own text.
    Value,
    /// By its key.
    Key(&'d str),
    /// Nothing is said: it may have any size, or others look at it.
    Unwatched,
    /// By its key, as an angle \[rad\].
    Angle(&'d str),
    /// Nothing is said of an index either, which is a number to people, whatever its dimension is.
    Index,
}

/// An element whose thickness may be what a share is meant of.
#[derive(Clone, Copy)]
pub(crate) struct Target<'d> {
    pub(crate) name: &'d str,
    /// Its thickness \[m\], where it has one.
    pub(crate) thickness: Option<f64>,
}

impl Target<'_> {
    /// What to write in place of `text`, the `share` of a length.
    fn help(self, text: &str, share: f64) -> String {
        let name = self.name;
        match self.thickness {
            Some(thickness) => {
                let length = format_short(share * thickness, Dimension::LENGTH, SHARE_DIGITS);
                format!("write \"{length}\", which is {text} of the thickness of `{name}`")
            }
            None => format!(
                "write a length such as \"10 mm\": `{name}` has no `thickness` to take a share of"
            ),
        }
    }
}

/// Digits of a length that a share was meant for.
const SHARE_DIGITS: usize = 7;

/// How a level of an index is written.
pub(crate) const INDEX_HELP: &str = "an index is written without a unit, for example `700`";

impl<'d> Quantities<'d> {
    /// Those of a key that are angles.
    pub(crate) fn of_angle(self, key: &'d str) -> Self {
        Self { subject: Subject::Angle(key), ..self }
    }

    pub(crate) fn of(self, key: &'d str) -> Self {
        Self { subject: Subject::Key(key), ..self }
    }

    /// Those of which nothing is said where they are unusual.
    pub(crate) fn unwatched(self) -> Self {
        Self { subject: Subject::Unwatched, ..self }
    }

    /// Those that are levels of an index.
    pub(crate) fn index(self) -> Self {
        Self { subject: Subject::Index, ..self }
    }

    /// The quantity `item` as written, in SI units, with an error where it does not have the
    /// dimension that is `expected` in a model, and a warning where it is unusual.
    pub(crate) fn read(self, item: &Item, expected: Dimension) -> Option<f64> {
        self.read_checked(item, expected, |_| Ok::<(), Fault>(()))
    }

    fn read_quietly(self, item: &Item, expected: Dimension) -> Option<Quantity> {
        let in_model = expected;
        let expected = self.basis.dimension(in_model);
        let quantity = match &item.value {
            Content::Number(digits) => self.parsed(digits, item.place, expected)?,
            Content::Text(text) => match self.values.get(text.trim()) {
                Some(known) => {
                    known.is_used.set(true);
                    // Where a value is named, nothing tells that `g` is not the gram.
                    Quantity { is_gram: false, ..known.quantity? }
                }
                None => match formula(text, &|name| self.values.contains_key(name)) {
                    Some(formula) => {
                        let text = text.to_string();
                        let own = Definition { text, place: item.place };
                        self.computed(formula, &own, expected)?
                    }
                    None => self.parsed(text, item.place, expected)?,
                },
            },
            _ => {
                let fault = Fault::NoQuantity { found: item.type_name(), expected };
                self.faults.error(item.place, fault);
                return None;
            }
        };
        self.checked(quantity, item, in_model)
    }

    /// The quantity of a key whose numbers have a range.
    pub(crate) fn within(
        self,
        range: Range,
        key: &'static str,
        item: &Item,
        expected: Dimension,
    ) -> Option<f64> {
        let check = |value| range.check(key, value);
        Quantities { subject: Subject::Key(key), ..self }.read_checked(item, expected, check)
    }

    /// The quantity that passes `check`, which says what is wrong with it.
    pub(crate) fn read_checked<E: Into<Fault>>(
        self,
        item: &Item,
        expected: Dimension,
        check: impl FnOnce(f64) -> Result<(), E>,
    ) -> Option<f64> {
        let quantity = self.read_quietly(item, expected)?;
        let value = quantity.value;
        match check(value) {
            Ok(()) => {
                self.warn(
                    item,
                    quantity.dimension.is_none(),
                    self.basis.dimension(expected),
                    value,
                );
                Some(value)
            }
            Err(fault) => {
                self.faults.error(item.place, self.traced(item, fault.into()));
                None
            }
        }
    }

    /// The difference of temperatures `item` \[K\]. Degrees Celsius are an error: they say a temperature.
    pub(crate) fn read_difference(self, item: &Item) -> Option<f64> {
        let quantity = self.read_quietly(item, Dimension::TEMPERATURE)?;
        if quantity.is_celsius {
            let fault = Fault::CelsiusDifference { text: self.shown(item) };
            self.faults.error(item.place, self.traced(item, fault));
            return None;
        }
        Some(quantity.value)
    }

    /// The quantity `item` as written, in SI units, where it is one of any dimension.
    pub(crate) fn peek(self, item: &Item) -> Option<f64> {
        self.meant(item).map(|quantity| quantity.value)
    }

    /// Whether `item` gives a number without a unit.
    pub(crate) fn is_bare(self, item: &Item) -> bool {
        self.meant(item).is_some_and(|quantity| quantity.dimension.is_none())
    }

    /// What `item` stands for, of any dimension.
    fn meant(self, item: &Item) -> Option<Quantity> {
        match &item.value {
            Content::Number(digits) => parse_quantity(digits).ok(),
            Content::Text(text) => arithmetic::quietly(text, self.values),
            _ => None,
        }
    }

    /// `item` as it is written.
    pub(crate) fn shown(self, item: &Item) -> String {
        match &item.value {
            Content::Text(text) => text.trim().to_owned(),
            Content::Number(digits) => digits.to_string(),
            _ => self.faults.text(item.place),
        }
    }

    /// The quantity that `item` stands for as it is written, where it has a name under that.
    pub(crate) fn written(self, item: &Item) -> String {
        let known = self.values.get(item.text().map_or("", str::trim));
        let definition = known.and_then(|known| known.definition.as_ref());
        definition.map_or_else(|| self.shown(item), |definition| definition.text.clone())
    }

    /// Where the number stands that `item` gives: under [values], where it is the name of one.
    fn origin(self, item: &Item) -> Place {
        let known = self.values.get(item.text().map_or("", str::trim));
        let definition = known.and_then(|known| known.definition.as_ref());
        definition.map_or(item.place, |definition| definition.place)
    }

    /// Notes that `item` has no unit; it is read as this in SI units, which is odd where another is usual.
    pub(crate) fn without_unit(self, item: &Item, value: f64, expected: Dimension, is_odd: bool) {
        let fault = || Fault::NoUnit { text: self.written(item), value, expected };
        self.faults.bare(self.origin(item), is_odd, fault);
    }

    /// `fault`, which is about `item`, with the definitions of the names that stand there.
    pub(crate) fn traced(self, item: &Item, fault: Fault) -> Fault {
        let text = item.text().map_or("", str::trim);
        let names = if self.values.contains_key(text) {
            vec![text.to_owned()]
        } else {
            arithmetic::names(text, self.values)
        };
        arithmetic::told_with(fault, &names, self.values, self.faults)
    }

    /// Warns of the value of `item`, in SI units, where it is unusual; `is_bare` where it has no unit.
    pub(crate) fn warn(self, item: &Item, is_bare: bool, dimension: Dimension, value: f64) {
        let key = match self.subject {
            Subject::Unwatched | Subject::Index => return,
            Subject::Key(key) | Subject::Angle(key) => key,
            Subject::Value => "",
        };
        if !is_bare {
            if let Some(fault) = plausible::slip(&self.written(item), dimension, value) {
                self.faults.warning(item.place, self.traced(item, fault));
            }
            return;
        }
        let subject = if key.is_empty() { self.shown(item) } else { key.to_owned() };
        match plausible::bare(key, &subject, dimension, value) {
            Some(fault) if dimension == Dimension::NUMBER => {
                self.faults.warning(item.place, self.traced(item, fault));
            }
            Some(fault) => self.faults.bare(self.origin(item), true, || fault),
            None => {}
        }
    }

    /// The formula `own` over `variables`, with the named values in it replaced; `expected` is the dimension of its
    /// value in a model, as those of the variables are.
    pub(crate) fn formula(
        self,
        own: &Definition,
        variables: &[Variable],
        expected: Dimension,
    ) -> Option<Formula> {
        let expected = self.basis.dimension(expected);
        let variables: Vec<Variable> =
            variables.iter().map(|own| (own.0, self.basis.dimension(own.1))).collect();
        let is_variable = |name: &str| variables.iter().any(|own| own.0 == name);
        let is_name = |name: &str| is_variable(name) || self.values.contains_key(name);
        let found = Formula::parse(&own.text, &is_name).and_then(|formula| {
            for name in formula.names() {
                if let Some(known) = self.values.get(name) {
                    known.is_used.set(true);
                    if is_variable(name) {
                        let fault = Fault::VariableAndValue { name: name.to_owned() };
                        self.faults.error(own.place, fault);
                        return Ok(None);
                    }
                    // What is wrong with a value has been told where it stands.
                    if known.quantity.is_none() {
                        return Ok(None);
                    }
                }
            }
            let formula = formula.with(&|name| arithmetic::constant(self.values, name));
            formula.law(&variables, expected).map(|_| Some(formula))
        });
        found.unwrap_or_else(|error| {
            let known = variables.iter().map(|own| own.0.to_owned()).chain(self.known());
            arithmetic::note(error, own, expected, (self.values, known.collect()), self.faults);
            None
        })
    }

    /// The value of a formula.
    fn computed(
        self,
        formula: Result<Formula, FormulaError>,
        own: &Definition,
        expected: Dimension,
    ) -> Option<Quantity> {
        let found = formula.and_then(|formula| {
            for known in formula.names().iter().filter_map(|&name| self.values.get(name)) {
                known.is_used.set(true);
            }
            let is_known =
                |name: &&str| self.values.get(*name).is_none_or(|own| own.quantity.is_some());
            if formula.names().iter().all(is_known) {
                formula.quantity(&|name| arithmetic::constant(self.values, name)).map(Some)
            } else {
                // What is wrong with a value has been told where it stands.
                Ok(None)
            }
        });
        found.unwrap_or_else(|error| {
            let names = (self.values, self.known());
            arithmetic::note(error, own, expected, names, self.faults);
            None
        })
    }

    /// The names of values, sorted.
    fn known(self) -> Vec<String> {
        let mut known: Vec<String> = self.values.keys().cloned().collect();
        known.sort();
        known
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
            Fault::UnknownName { family: "value", name: name.to_owned(), known: self.known() }
        } else {
            match self.subject {
                Subject::Index => Fault::Unreadable { error, expected }.with_help(INDEX_HELP),
                _ => Fault::Unreadable { error, expected },
            }
        };
        self.faults.error(place, fault);
        None
    }

    fn checked(self, quantity: Quantity, item: &Item, in_model: Dimension) -> Option<Quantity> {
        let expected = self.basis.dimension(in_model);
        let is_index = matches!(self.subject, Subject::Index);
        let quantity = quantity.meant(if is_index { Dimension::ACCELERATION } else { expected });
        let found = quantity.dimension.unwrap_or(expected);
        let text = item.text().map_or("", str::trim);
        let is_named =
            || self.values.contains_key(text) || !text.is_empty() && parse_quantity(text).is_err();
        let shown = || self.shown(item);
        if found != expected {
            let told = if is_index { Dimension::NUMBER } else { expected };
            let fault = Fault::WrongDimension { text: shown(), found, expected: told };
            let fault = match found {
                _ if is_index => fault.with_help(INDEX_HELP),
                Dimension::ACCELERATION if self.is_motion => fault.with_help(MOTION_HELP),
                Dimension::MASS if expected == Dimension::ACCELERATION && is_named() => fault
                    .with_help("in [values] and in arithmetic `g` is the gram: write `g0` there"),
                Dimension::VELOCITY if self.is_motion => fault
                    .with_help("a motion is a displacement: write `velocity` in place of `motion`"),
                Dimension::NUMBER if expected == Dimension::LENGTH && self.element.is_some() => {
                    let help = self.element.map(|element| element.help(&shown(), quantity.value));
                    fault.with_help(help.unwrap_or_default())
                }
                _ if found == in_model => fault.with_help(pad_in_material_help(in_model)),
                _ if found == Basis::MATERIAL.dimension(in_model) => {
                    fault.with_help(MATERIAL_IN_MODEL_HELP)
                }
                _ => fault,
            };
            self.faults.error(item.place, self.traced(item, fault));
            return None;
        }
        let is_angle = quantity.angle != 0 && !matches!(self.subject, Subject::Angle(_));
        if expected == Dimension::NUMBER && (is_angle || quantity.amount != 0) {
            let what = if is_angle { "an angle" } else { "an amount of substance" };
            let message = format!("`{}` is {what}; a pure number is expected here", shown());
            let fault = Fault::odd(message, "write the number without a unit");
            self.faults.error(item.place, self.traced(item, fault));
            return None;
        }
        if expected == Dimension::FREQUENCY && quantity.angle != 0 {
            let frequency = quantity.value / std::f64::consts::TAU;
            let fault = Fault::AngularFrequency { text: shown(), frequency };
            self.faults.error(item.place, self.traced(item, fault));
            return None;
        }
        let is_bare = quantity.dimension.is_none() && quantity.value != 0.0;
        if is_bare && expected != Dimension::NUMBER && !is_index {
            self.without_unit(item, quantity.value, expected, false);
        }
        Some(quantity)
    }
}

/// Whether a text that is no number can be meant as the name of a value.
fn could_be_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_alphabetic() || first == '_')
        && !text.contains(char::is_whitespace)
}
