//! Arguments that several verbs have: types, what reads their values, names from the registers.

use std::{
    collections::HashSet,
    ffi::{OsStr, OsString},
    path::{Path, PathBuf},
};

use clap::{
    ArgMatches, Args, Command, CommandFactory, FromArgMatches, ValueEnum,
    builder::{PossibleValue, PossibleValuesParser, TypedValueParser},
    error::{ContextKind, ContextValue, ErrorKind},
};
use dashpot_analysis::{Accuracy, Limit};
use dashpot_dae::methods;
use dashpot_network::parameters::Dimension;
use dashpot_scene::{nearest, parse_limits, units::parse_quantity};
use dashpot_signal::Padding;
pub(crate) use dashpot_studies::operand::MODEL;
use dashpot_studies::{Given, Single, Time, assignment};
use serde::{Deserialize, Serialize};

use crate::{
    error::{CliError, is_unit, unquoted_help},
    host,
    verbs::Arguments,
};

/// What may stand for a scene.
pub(crate) const SCENE: &str = "File of the scene, `-` for standard input, or a built-in scene (reference, \
     reference-stiff, reference-gravity) [default: reference]";

/// Which scene.
#[derive(Debug, Clone, Args, Serialize, Deserialize)]
pub(crate) struct SceneArguments {
    /// The scene.
    #[arg(value_name = "SCENE", help = SCENE)]
    pub(crate) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) values: ValueArguments,
}

/// Which named values.
#[derive(Debug, Clone, Args, Serialize, Deserialize)]
pub(crate) struct ValueArguments {
    /// Sets a value of the scene's table [values], `--set "K=25 MN/m"`, or any number or word by its path,
    /// `--set "head.mass=6 kg"`, `--set liner.material=epp`; repeatable.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    pub(crate) set: Vec<(String, String)>,
}

#[derive(Debug, Clone)]
pub(crate) struct Variant {
    pub(crate) name: String,
    pub(crate) set: Vec<(String, String)>,
}

/// `thick: liner.thickness=28 mm, K=60 kN/m`; without a name before a colon the whole text is its name.
pub(crate) fn variant(text: &str) -> Result<Variant, String> {
    let named = text.split_once(':').filter(|own| !own.0.contains(['=', '"']));
    let (name, values) = named.unwrap_or((text, text));
    if name.trim().is_empty() {
        return Err("there is no name before the colon; write \"thick: K=60 kN/m\"".to_owned());
    }
    let set: Vec<(String, String)> = values.split(',').map(assignment).collect::<Result<_, _>>()?;
    if let Some(twice) = repeated(set.iter().map(|own| &own.0)) {
        return Err(format!("`{twice}` is set twice: only one of both can hold"));
    }
    Ok(Variant { name: name.trim().to_owned(), set })
}

/// Which limits besides those of the scene.
#[derive(Debug, Clone, Args, Serialize, Deserialize)]
pub(crate) struct LimitArguments {
    /// A limit besides those of the scene, such as "head.hic15<=700" or, by a standard,
    /// "head.peak-acceleration=en-1078" (`dashpot list limits`); repeatable.
    #[arg(long, value_name = "LIMIT", value_parser = limits)]
    pub(crate) limit: Vec<Limits>,
}

impl LimitArguments {
    /// All limits, which stand beside those of a scene.
    pub(crate) fn beside(&self, own: &[Limit]) -> Result<Vec<Limit>, CliError> {
        let given = self.limit.iter().flat_map(|own| &own.list);
        let all: Vec<Limit> = own.iter().chain(given.clone()).cloned().collect();
        match Limit::contradiction(&all) {
            Some(pair) => Err(CliError::Contradiction { limits: Box::new(pair.map(Limit::clone)) }),
            None => Ok(given.cloned().collect()),
        }
    }
}

/// Limits that one argument states.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub(crate) struct Limits {
    /// The argument.
    pub(crate) text: String,
    pub(crate) list: Vec<Limit>,
}

fn limits(text: &str) -> Result<Limits, String> {
    Ok(Limits { text: text.trim().to_owned(), list: parse_limits(text)? })
}

impl TryFrom<String> for Limits {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        limits(&text)
    }
}

impl From<Limits> for String {
    fn from(own: Limits) -> Self {
        own.text
    }
}

/// Refuses options that the command line gives where they do nothing, and says `why`.
pub(crate) fn refuse(options: &[&str], why: &str) -> Result<(), CliError> {
    let words = host::arguments();
    let is_given = |option: &&&str| {
        words.iter().filter_map(|own| own.to_str()).any(|own| {
            own.strip_prefix(**option).is_some_and(|rest| rest.is_empty() || rest.starts_with('='))
        })
    };
    match options.iter().find(is_given) {
        None => Ok(()),
        Some(name) => Err(CliError::setting(name, format!("it does nothing here: {why}"))),
    }
}

/// Why numbers of a sample do nothing.
pub(crate) const NO_SCATTER: &str = "no number of the scene has scatter; write one with its standard deviation, such as \"20 ± 2 MN/m\"";

/// When something is done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum When {
    /// On terminals.
    #[default]
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl When {
    /// Whether it is done where a terminal is attended, or not.
    pub(crate) fn is_now(self, attended: bool) -> bool {
        self == Self::Always || self == Self::Auto && attended
    }
}

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Switch {
    /// On.
    On,
    /// Off.
    Off,
}

/// The arguments that these words state, no name twice among those of one option.
pub(crate) fn parsed(words: impl IntoIterator<Item = OsString>) -> Result<Arguments, clap::Error> {
    let mut command = Arguments::command();
    let matches = command.try_get_matches_from_mut(words)?;
    let twice = matches.subcommand().and_then(|own| named_twice(own.1));
    match twice {
        Some((option, name)) => Err(command.error(
            ErrorKind::ArgumentConflict,
            format!("`--{option}` names `{name}` twice: only one of both can hold"),
        )),
        None => Arguments::from_arg_matches(&matches),
    }
}

/// An option that names something twice, and what.
fn named_twice(matches: &ArgMatches) -> Option<(String, String)> {
    matches.ids().find_map(|id| {
        let id = id.as_str();
        let assigned = matches.try_get_many::<(String, String)>(id).ok().flatten();
        let variants = matches.try_get_many::<Variant>(id).ok().flatten();
        let names = assigned.into_iter().flatten().map(|own| &own.0);
        let names = names.chain(variants.into_iter().flatten().map(|own| &own.name));
        Some((id.replace('_', "-"), repeated(names)?))
    })
}

/// The first name that stands there for the second time.
fn repeated<'a>(names: impl Iterator<Item = &'a String>) -> Option<String> {
    let mut known = HashSet::new();
    names.into_iter().find(|own| !known.insert(*own)).cloned()
}

/// The error with what to write: the word that was probably meant, quotes around a unit that stands alone, or an example
/// of what is not whole.
pub(crate) fn explained(mut error: clap::Error) -> clap::Error {
    let command = Arguments::command();
    let verb = host::arguments().iter().find_map(|own| command.find_subcommand(own));
    let word = |kind| match error.get(kind) {
        Some(ContextValue::String(word)) => word.clone(),
        _ => String::new(),
    };
    let (known, unknown): (Vec<String>, String) = match error.kind() {
        ErrorKind::InvalidSubcommand => {
            let verbs = command.get_subcommands().map(|own| own.get_name().to_owned());
            (verbs.collect(), word(ContextKind::InvalidSubcommand))
        }
        ErrorKind::UnknownArgument => {
            let options =
                command.get_arguments().chain(verb.into_iter().flat_map(Command::get_arguments));
            let names = options.filter_map(|own| Some(format!("--{}", own.get_long()?)));
            (names.collect(), word(ContextKind::InvalidArg))
        }
        _ => (Vec::new(), String::new()),
    };
    let unit = unknown.split(',').next().unwrap_or_default();
    let is_scene = |own: &str| Path::new(own).extension().is_some_and(|own| own == "toml");
    let tip = if error.kind() == ErrorKind::UnknownArgument && is_unit(unit) {
        Some(unquoted_help(unit))
    } else if error.kind() == ErrorKind::InvalidSubcommand && is_scene(&unknown) {
        Some(format!("`dashpot run {unknown}` solves a scene"))
    } else if is_scene(&word(ContextKind::InvalidValue)) {
        Some("`--out FILE.toml` says which file is written".to_owned())
    } else if let Some(near) = nearest(&unknown, known.iter().map(String::as_str)) {
        Some(format!("did you mean `{near}`?"))
    } else if error.kind() == ErrorKind::MissingRequiredArgument {
        let examples = verb.and_then(Command::get_after_help).map(ToString::to_string);
        let missing = match error.get(ContextKind::InvalidArg) {
            Some(ContextValue::Strings(missing)) => missing.first().cloned().unwrap_or_default(),
            _ => String::new(),
        };
        let option = missing.split(' ').next().filter(|word| word.starts_with("--"));
        let shows = |line: &&str| {
            line.starts_with("  dashpot")
                && option.is_none_or(|option| line.split(' ').any(|word| word == option))
        };
        let example = examples.as_deref().and_then(|examples| examples.lines().find(shows));
        example.map(|own| {
            format!("for example `{}`", own.trim().split("   ").next().unwrap_or_default())
        })
    } else {
        None
    };
    if let Some(tip) = tip {
        error.remove(ContextKind::SuggestedArg);
        error.remove(ContextKind::SuggestedSubcommand);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

/// What is wrong with a command line and what to do, in sentences, for those who have not written it as one.
pub(crate) fn sentences(error: &clap::Error) -> (String, Option<String>) {
    let text = error.to_string();
    let lines = text.lines().map(|own| own.trim().trim_start_matches("error: "));
    let lines = lines.take_while(|own| !own.starts_with("Usage:") && !own.starts_with("For more"));
    let (advice, told): (Vec<&str>, Vec<&str>) = lines
        .filter(|own| !own.is_empty())
        .partition(|own| own.starts_with("tip: ") || own.starts_with("[possible values"));
    let advice: Vec<&str> = advice
        .iter()
        .map(|own| own.trim_start_matches("tip: ").trim_matches(['[', ']']))
        .rev()
        .collect();
    (told.join(" "), (!advice.is_empty()).then(|| advice.join("; ")))
}

pub(crate) fn share(text: &str) -> Result<f64, String> {
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_number = quantity.dimension.is_none_or(|dimension| dimension == Dimension::NUMBER);
    let value = quantity.value;
    // A bare number of this size may be meant in percent.
    let is_doubtful = quantity.dimension.is_none()
        && !text.contains('%')
        && (0.01..=100.0 * Accuracy::LOOSEST).contains(&value);
    if is_number && value > 0.0 && value <= Accuracy::LOOSEST && !is_doubtful {
        return Ok(value);
    }
    Err(if is_doubtful {
        let percent = 100.0 * value;
        let other =
            if value > Accuracy::LOOSEST { String::new() } else { format!(" or \"{percent}%\"") };
        format!("a bare {value} is {percent}%; write \"{value}%\"{other}")
    } else {
        "it must be more than 0 and at most 20%, such as 0.1% or 1e-3".to_owned()
    })
}

/// A probability, such as 95% or 0.95.
pub(crate) fn probability(text: &str) -> Result<f64, String> {
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_number = quantity.dimension.is_none_or(|dimension| dimension == Dimension::NUMBER);
    if is_number && (0.5..1.0).contains(&quantity.value) {
        return Ok(quantity.value);
    }
    Err("it must be at least 50% and less than 100%, such as 95%".to_owned())
}

/// What stands beyond the ends of a record for a filter.
pub(crate) fn paddings() -> PossibleValuesParser {
    let value = |own: Padding| {
        let [word, summary] = own.words();
        PossibleValue::new(word).help(summary)
    };
    PossibleValuesParser::new(Padding::ALL.map(value))
}

/// A time \[s\] within a run.
pub(crate) fn time(text: &str) -> Result<f64, String> {
    let time = shift(text)?;
    if time >= 0.0 { Ok(time) } else { Err("a run begins at 0 s".to_owned()) }
}

/// A time \[s\], or a difference of times.
pub(crate) fn shift(text: &str) -> Result<f64, String> {
    Ok(single::<Time>(text)?.0)
}

/// The value that a text stands for.
pub(crate) fn single<T: Single>(text: &str) -> Result<T, String> {
    T::of(&Given::Text(text.to_owned()))
}

/// The names of methods, blanks around them allowed.
#[derive(Debug, Clone)]
pub(crate) struct MethodNames(pub(crate) PossibleValuesParser);

impl TypedValueParser for MethodNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let trimmed = value.to_str().map_or(value, |text| OsStr::new(text.trim()));
        self.0.parse_ref(command, argument, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

pub(crate) fn method_names() -> PossibleValuesParser {
    let methods = methods::all();
    PossibleValuesParser::new(methods.iter().map(|method| PossibleValue::new(method.name())))
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::sentences;
    use crate::verbs::Arguments;

    #[test]
    fn faults_of_a_command_line_are_sentences() {
        let of = |words: &str| sentences(&Arguments::try_parse_from(words.split(' ')).unwrap_err());
        let (told, help) = of("dashpot run --method eksact");
        assert_eq!(told, "invalid value 'eksact' for '--method <NAME,…>'");
        let help = help.unwrap();
        assert!(help.contains("'exact'") && help.contains("tr-bdf2") && !help.contains('['));
        let (told, help) = of("dashpot compare");
        assert!(told.ends_with("not provided: <FIRST> <SECOND>"), "{told}");
        assert_eq!(help, None);
    }
}
