//! The value of one parameter, as its kind says.

use dashpot_network::parameters::{
    Dimension, Formula, Parameter, ParameterKind, Range, Value, WindowWish,
};
use dashpot_units::parse_quantity;

use super::{is_points, parameters::KindReader};
use crate::{
    diagnostics::fault::Fault,
    quantities::{
        basis::Basis,
        named::{Definition, Values},
        quantity::Quantities,
    },
    text::{
        document::{Content, Item},
        library::tables::names_file,
        source::Place,
        table::{text_of, wrong_type},
    },
};

impl KindReader<'_> {
    pub(crate) fn value(self, parameter: &Parameter, item: &Item) -> Option<Value> {
        if is_points(parameter) && names_file(item) {
            return self.value_after(parameter, item, None);
        }
        let faults = self.quantities.faults;
        let what = || format!("`{}`", parameter.name);
        match parameter.kind {
            ParameterKind::Quantity(dimension) if parameter.range == Range::Angle => {
                self.quantities.of_angle(parameter.name).read(item, dimension).map(Value::Number)
            }
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

    /// The quantity `item` of a parameter.
    fn quantity(self, name: &'static str, item: &Item, dimension: Dimension) -> Option<f64> {
        let value = self.quantities.of(name).read(item, dimension)?;
        self.fitting(name, item, dimension, value)
    }

    /// The quantity `value`, with an error where no pad can have it.
    pub(super) fn fitting(
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

    /// A formula over the variables of the parameter, with the named values in it replaced.
    fn formula(self, parameter: &Parameter, item: &Item, expected: Dimension) -> Option<Formula> {
        let what = format!("`{}`", parameter.name);
        let text = text_of(item, &what, self.quantities.faults)?;
        let variables = parameter.kind.variables();
        let own = Definition { text: text.to_owned(), place: item.place };
        self.quantities.formula(&own, variables, expected)
    }

    pub(super) fn amplitude(self, item: &Item) -> Option<f64> {
        let is_motion = self.driven == Dimension::LENGTH;
        Quantities { is_motion, ..self.quantities }.read(item, self.driven)
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
    pub(super) fn default(self, parameter: &Parameter) -> Option<Value> {
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
