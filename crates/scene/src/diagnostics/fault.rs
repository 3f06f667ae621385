//! What can be wrong with a scene, in words.

use std::mem;

use dashpot_formula::FormulaFault;
use dashpot_network::{
    NetworkError,
    parameters::{Dimension, InvalidParameter},
};
use dashpot_signal::{ChannelFault, SettingsFault};
use dashpot_units::UnitError;
use thiserror::Error;

use super::fault_help::{bad_value_help, unknown_name_help, unreadable_help};
use crate::{
    curves::CurveChange,
    quantities::{
        bare::BareNumber,
        scatter::ScatterFault,
        words::{described, example, in_both_units, with_units},
    },
    tables::TableFault,
    text::nearest::{list, suggestion},
};

/// One thing that is wrong, or odd, in a scene.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum Fault {
    /// The text is larger than the limit.
    #[error("the text has {bytes} bytes; the limit is 64 MB")]
    TooLarge { bytes: usize },
    /// The bytes are not UTF-8, of which this is the first that cannot be read, counted from 0.
    #[error("the text is not UTF-8: byte {at} cannot be read (line {line})")]
    NotUtf8 { at: usize, line: usize },
    /// There is nothing in the text.
    #[error("the scene is empty")]
    Empty,
    /// A table of numbers in the place of a scene.
    #[error("this is a table of numbers, and no scene")]
    TableForScene { name: String },
    /// Brackets or dotted keys nest too deeply.
    #[error("the text nests {levels} levels deep; the limit is {limit}")]
    TooDeep { levels: usize, limit: usize },
    /// The text is not TOML.
    #[error("{message}")]
    Syntax { message: String },
    /// A string is not quoted.
    #[error("text and quantities with units are written in quotes")]
    NotQuoted { text: String },
    /// A key stands twice.
    #[error("`{key}` is given twice")]
    DuplicateKey { key: String },
    /// A key that has no meaning where it stands.
    #[error("unknown key `{key}` in {owner}")]
    UnknownKey { key: String, owner: String, known: Vec<&'static str> },
    /// A required key is missing.
    #[error("{owner} has no `{key}`")]
    MissingKey { key: String, owner: String, example: String },
    /// A value of a wrong type.
    #[error("{what} is {expected}, but this is {found}")]
    WrongType { what: String, expected: String, found: String },
    /// A value of another type where a quantity is expected.
    #[error("{} is expected here, but this is {found}", described(*.expected))]
    NoQuantity { found: String, expected: Dimension },
    /// A quantity that cannot be read.
    #[error("{error}")]
    Unreadable { error: UnitError, expected: Dimension },
    /// A named value that cannot be read.
    #[error("{error}")]
    BadValue { error: UnitError, example: &'static str },
    /// A formula that has no value.
    #[error("{0}")]
    Formula(FormulaFault),
    /// A number with scatter that cannot be read, or cannot have any.
    #[error("{0}")]
    Scatter(ScatterFault),
    /// A quantity of a wrong dimension.
    #[error("`{text}` is {}; {} is expected here", described(*.found), described(*.expected))]
    WrongDimension { text: String, found: Dimension, expected: Dimension },
    /// An angular frequency in place of a frequency, and the same as a frequency \[Hz\].
    #[error("`{text}` is an angular frequency; a frequency (Hz) is expected here")]
    AngularFrequency { text: String, frequency: f64 },
    /// A temperature in place of a difference of temperatures.
    #[error("`{text}` is a temperature; a difference of temperatures (K) is expected here")]
    CelsiusDifference { text: String },
    /// A path that leads to several numbers or words.
    #[error("`{name}` may be {}", .names.join(" or "))]
    AmbiguousPath { name: String, names: Vec<String> },
    /// A name that stands for nothing in its family: node, model, value …
    #[error("there is no {family} named `{name}`")]
    UnknownName { family: &'static str, name: String, known: Vec<String> },
    /// A word that is none of those that may stand there.
    #[error("`{word}` is not {family}")]
    UnknownWord { family: String, word: String, known: Vec<&'static str> },
    /// A name that cannot be used.
    #[error("`{name}` cannot be a name: {reason}")]
    BadName { name: String, reason: &'static str },
    /// A value that refers to itself.
    #[error("the value `{}` refers to itself ({})", .names.first().map_or("", String::as_str), .names.join(" → "))]
    SelfReference { names: Vec<String> },
    /// A variable of a formula that is the name of a value, too.
    #[error("`{name}` is a variable of this formula, and a value under [values]")]
    VariableAndValue { name: String },
    /// Values that refer to others, too many in a row.
    #[error("this value refers to others in a chain of more than {limit}")]
    ValuesTooDeep { limit: usize },
    /// A model or material that contains itself.
    #[error("the {family} `{}` contains itself ({})", .names.first().map_or("", String::as_str), .names.join(" → "))]
    ModelInItself { family: &'static str, names: Vec<String> },
    /// A model within others, too many.
    #[error(
        "the models around this one are nested {limit} levels deep already, which is the limit"
    )]
    ModelTooDeep { limit: usize },
    /// A table that says nothing about its law.
    #[error("{owner} has no law")]
    NoLaw { owner: String, known: Vec<&'static str> },
    /// Several laws in one table.
    #[error("{owner} has several laws ({}) and does not say how they are composed", list(.words))]
    SeveralLaws { owner: String, words: Vec<String> },
    /// A model within a material.
    #[error("`model` cannot stand in a material: models are in N/m, materials in Pa")]
    ModelInMaterial,
    /// A contact within a material.
    #[error("`{word}` cannot stand in a material: it acts across a gap")]
    ElementInMaterial { word: &'static str },
    /// Two sizes of one pad: thicknesses or areas.
    #[error("`{key}` is {found} here, but {expected} in {place}")]
    SizesDiffer { key: &'static str, found: String, expected: String, place: String },
    /// The size of a pad where there is none.
    #[error("`{key}` goes with a material or foam, which {owner} is not")]
    SizeWithoutMaterial { key: &'static str, owner: String },
    /// The size of a pad within a material.
    #[error("a material has no `{key}`; the pads that are made of it have one")]
    SizeInMaterial { key: &'static str },
    /// A text with several models, or none, and no word on which is meant.
    #[error("{}", if .known.is_empty() { "there is no model here" } else { "there are several models here" })]
    WhichModel { known: Vec<String> },
    /// A driving function that is not given.
    #[error("{owner} names no function of time")]
    NoFunction { owner: String, known: Vec<&'static str> },
    /// Several driving functions in one place.
    #[error("one function of time is expected, but there are several ({})", list(.words))]
    SeveralFunctions { words: Vec<String> },
    /// A section that every scene has.
    #[error("the scene has no [{section}]")]
    MissingSection { section: &'static str },
    /// A list without entries.
    #[error("`{key}` is an empty list")]
    EmptyList { key: String },
    /// Models that expand to more bytes of memory than it should hold.
    #[error(
        "{model} expands to {parts} parts, about {:.0} GB of memory; the limit is {:.0} GB",
        *.bytes as f64 * 1e-9,
        *.limit as f64 * 1e-9
    )]
    TooManyParts { model: String, parts: u64, bytes: u64, limit: u64 },
    /// Two keys that contradict each other.
    #[error("`{first}` and `{second}` exclude each other")]
    Exclusive { first: &'static str, second: &'static str },
    /// A parameter out of its range.
    #[error("{0}")]
    Invalid(InvalidParameter),
    /// A network that cannot be turned into a system.
    #[error("{0}")]
    Network(NetworkError),
    /// Another file cannot be read.
    #[error("`{path}` cannot be read: {reason}")]
    Unloadable { path: String, reason: String },
    /// A file of numbers that is no table.
    #[error("{0}")]
    Table(TableFault),
    /// Rows that are no record.
    #[error("the rows are no record that can be filtered or have an offset: {0}")]
    Samples(ChannelFault),
    /// A record of which cannot be made what is asked for.
    #[error("{0}")]
    Record(SettingsFault),
    /// A file of numbers without numbers.
    #[error("`{path}` has no row of numbers")]
    NoRows { path: String },
    /// A measured curve that was changed by more than noise.
    #[error("{0}")]
    CurveChanged(CurveChange),
    /// A number without a unit in place of one that has one.
    #[error("{0}")]
    BareNumber(BareNumber),
    /// A number without a unit where one is expected, and what it is read as in SI units.
    #[error("`{text}` has no unit: it is read as {}", in_both_units(*.value, *.expected))]
    NoUnit { text: String, value: f64, expected: Dimension },
    /// Something that is odd but not wrong.
    #[error("{message}")]
    Odd { message: String, help: Option<String> },
    /// A fault about which its surroundings tell more; without help here it has its own.
    #[error("{fault}")]
    Explained { fault: Box<Self>, help: Option<String>, note: Option<String> },
}

impl From<InvalidParameter> for Fault {
    fn from(invalid: InvalidParameter) -> Self {
        Self::Invalid(invalid)
    }
}

impl Fault {
    /// The fault with other help.
    #[must_use]
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self::Explained { fault: Box::new(self), help: Some(help.into()), note: None }
    }

    /// The fault with other help, where there is some.
    #[must_use]
    pub(crate) fn with_any_help(self, help: Option<String>) -> Self {
        match help {
            Some(help) => self.with_help(help),
            None => self,
        }
    }

    /// The fault with a remark.
    #[must_use]
    pub(crate) fn with_note(self, note: impl Into<String>) -> Self {
        Self::Explained { fault: Box::new(self), help: None, note: Some(note.into()) }
    }

    /// Whether it is of the same kind, and the same is to be done about it.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let (own, other_bare) = (self.bare(), other.bare());
        mem::discriminant(own) == mem::discriminant(other_bare)
            && (matches!(own, Self::NoUnit { .. }) || self.help() == other.help())
    }

    /// The fault without what its surroundings tell.
    fn bare(&self) -> &Self {
        match self {
            Self::Explained { fault, .. } => fault.bare(),
            own => own,
        }
    }

    /// Something odd, and what to do about it.
    pub(crate) fn odd(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Odd { message: message.into(), help: Some(help.into()) }
    }

    /// What else there is to know.
    pub fn note(&self) -> Option<String> {
        match self {
            Self::Explained { fault, note, .. } => note.clone().or_else(|| fault.note()),
            _ => None,
        }
    }

    /// How to put it right, where that can be said.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Odd { help, .. } => help.clone(),
            Self::Explained { fault, help, .. } => help.clone().or_else(|| fault.help()),
            Self::Formula(fault) => fault.help(),
            Self::Scatter(fault) => Some(fault.help()),
            Self::Table(fault) => fault.help(),
            Self::BareNumber(bare) => Some(bare.help()),
            Self::UnknownKey { key, known, .. } => suggestion(key, "keys", known),
            Self::UnknownName { family, name, known } => unknown_name_help(family, name, known),
            Self::UnknownWord { word, known, .. } => suggestion(word, "words", known),
            _ => self
                .help_on_the_text()
                .or_else(|| self.help_on_quantities())
                .or_else(|| self.help_on_models()),
        }
    }

    /// What to do about files, sections, keys and quotes.
    fn help_on_the_text(&self) -> Option<String> {
        let help = match self {
            Self::Empty => "`dashpot new` writes a commented scene to start from",
            Self::TableForScene { name } => {
                return Some(format!(
                    "name it in a scene where points may stand: `table-spring = \"{name}\"` for a measured curve, \
                     `force = {{ table = \"{name}\" }}` for a force over time; `dashpot new` writes a scene to start from"
                ));
            }
            Self::NotUtf8 { .. } => "save the file with the encoding UTF-8",
            Self::NotQuoted { text } if text.is_empty() => "a value is missing after `=`",
            Self::NotQuoted { text } => return Some(format!("write \"{text}\"")),
            Self::DuplicateKey { .. } => {
                "names and keys are unique within their table; remove or rename one"
            }
            Self::MissingKey { example, .. } => {
                return (!example.is_empty()).then(|| format!("for example `{example}`"));
            }
            Self::MissingSection { section: "run" } => {
                "for example:\n\n[run]\nduration = \"20 ms\""
            }
            Self::MissingSection { .. } => {
                "for example:\n\n[elements]\npadding = { between = [\"head\", \"ground\"], spring = \"20 MN/m\" }"
            }
            Self::EmptyList { .. } => "leave the key out, or give an entry",
            _ => return None,
        };
        Some(help.to_owned())
    }

    /// What to write in place of a quantity, a value or a curve.
    fn help_on_quantities(&self) -> Option<String> {
        Some(match self {
            Self::Unreadable { error, expected } => unreadable_help(error, *expected),
            Self::BadValue { error, example } => bad_value_help(error, example),
            Self::WrongDimension { expected, .. } | Self::NoQuantity { expected, .. } => {
                example(*expected)
            }
            Self::NoUnit { text, .. } if text.parse::<f64>().is_err() => {
                "give the numbers in it their units".to_owned()
            }
            Self::NoUnit { text, expected, .. } => format!("write {}", with_units(text, *expected)),
            Self::AngularFrequency { frequency, .. } => {
                format!("divide by 2 pi: \"{frequency:.6} Hz\"")
            }
            Self::CelsiusDifference { .. } => {
                "write the same number with `K`: a difference of 1 degree Celsius is 1 K".to_owned()
            }
            Self::VariableAndValue { .. } => "give the value another name".to_owned(),
            Self::CurveChanged(_) => {
                "look at these rows: a law of the deformation alone never falls, so a drop after yield, a slip or \
                 rows of another test are averaged"
                    .to_owned()
            }
            _ => return None,
        })
    }

    /// How to write a model, a material or its size.
    fn help_on_models(&self) -> Option<String> {
        Some(match self {
            Self::TooDeep { .. } | Self::ModelTooDeep { .. } => {
                "write branches in series, or in parallel, into one list: `series = [a, b, c]`"
                    .to_owned()
            }
            Self::NoLaw { known, .. } | Self::NoFunction { known, .. } => {
                format!("give one of: {}", known.join(", "))
            }
            Self::SeveralLaws { words, .. } => {
                let branches =
                    words.iter().map(|word| format!("{{ {word} = … }}")).collect::<Vec<_>>();
                format!("for example `parallel = [{}]`", branches.join(", "))
            }
            Self::ModelInMaterial => {
                "write `material = \"…\"` for another material; to join both, compose them in [models] \
                 with `{ material = \"…\", thickness = \"2 cm\", area = \"100 cm^2\" }`"
                    .to_owned()
            }
            Self::ElementInMaterial { .. } => {
                "write it in [models] or [elements], with the values of the pad".to_owned()
            }
            Self::SizeWithoutMaterial { .. } => {
                "leave it out, or write it beside the material or foam whose size it is".to_owned()
            }
            Self::SizeInMaterial { key } => format!(
                "leave `{key}` out here, and write it beside `material = \"…\"` in [models] or [elements]"
            ),
            Self::WhichModel { known } if known.is_empty() => {
                "[models], [materials] and [elements] hold models".to_owned()
            }
            Self::WhichModel { known } => format!("name one of: {}", list(known)),
            _ => return None,
        })
    }

    /// A few words for directly under the place.
    pub fn label(&self) -> Option<String> {
        match self {
            Self::DuplicateKey { .. } => Some("second one".to_owned()),
            Self::AngularFrequency { .. } => Some("in radians".to_owned()),
            Self::Explained { fault, .. } => fault.label(),
            _ => None,
        }
    }
}
