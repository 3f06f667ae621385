//! `[fit]` of a scene: the options of the command by their names. Those of the command line stand above them.

use std::{env, ffi::OsString, path::Path};

use clap::{ArgAction, Args as _, Command, FromArgMatches as _};
use dashpot_scene::{FitWish, fit_wishes};

use super::FitArguments;
use crate::{error::CliError, input::Input, output::list};

/// Options of a call, which no scene has.
const OF_THE_CALL: [&str; 4] = ["out", "force", "json", "set"];
/// A global option, which may stand among those of a verb.
const COLOR: &str = "color";

/// The command with what the scene sets; `None` where it sets nothing.
pub(super) fn merged(input: &Input) -> Result<Option<FitArguments>, CliError> {
    let wishes = fit_wishes(input.text()?, Some(&input.file)).map_err(CliError::Scene)?;
    if wishes.is_empty() {
        return Ok(None);
    }
    let given: Vec<OsString> = list(env::args_os().skip_while(|own| own != "fit").skip(1));
    with(&wishes, given, &input.file).map(Some)
}

/// What the words of a command line are with these wishes before them.
fn with(wishes: &[FitWish], given: Vec<OsString>, file: &str) -> Result<FitArguments, CliError> {
    let command = FitArguments::augment_args(Command::new("fit").no_binary_name(true));
    let command = command.arg(clap::Arg::new(COLOR).long(COLOR).num_args(1));
    let mut words: Vec<OsString> = Vec::new();
    for wish in wishes {
        let wrong = |reason: String| CliError::WrongSetting {
            name: format!("{file}, line {}, {}", wish.line, wish.key),
            reason,
        };
        let known = command.get_arguments().filter_map(|own| Some((own.get_long()?, own)));
        let known = known.filter(|own| own.0 != COLOR && !OF_THE_CALL.contains(&own.0));
        let known: Vec<_> = list(known);
        let Some((name, own)) = known.iter().find(|own| own.0 == wish.key) else {
            let names: Vec<&str> = list(known.iter().map(|own| own.0));
            return Err(wrong(format!("`[fit]` has no such option; it has {}", names.join(", "))));
        };
        let option = format!("--{name}");
        let is_it = |word: &OsString| {
            word.to_str().is_some_and(|word| {
                word == option || word.strip_prefix(&option).is_some_and(|own| own.starts_with('='))
            })
        };
        if given.iter().any(is_it) {
            continue;
        }
        match own.get_action() {
            ArgAction::SetTrue if !wish.is_switch => {
                return Err(wrong("it is true or false".to_owned()));
            }
            ArgAction::SetTrue => words.extend(wish.values.iter().map(|_| option.clone().into())),
            _ if wish.is_switch => {
                let value = if wish.values.is_empty() { "off" } else { "on" };
                words.push(format!("{option}={value}").into());
            }
            _ => words.extend(wish.values.iter().map(|value| {
                let value = if *name == "to" { beside(file, value) } else { value.clone() };
                format!("{option}={value}").into()
            })),
        }
    }
    words.extend(given);
    let matches = command.try_get_matches_from(words);
    let found = matches.and_then(|own| FitArguments::from_arg_matches(&own));
    found.map_err(|fault| {
        let text = fault.to_string();
        let reason = text.trim_start_matches("error: ").split("\n\n").next().unwrap_or_default();
        CliError::WrongSetting { name: format!("[fit] of {file}"), reason: reason.to_owned() }
    })
}

/// A file that is named in a scene is one beside it.
fn beside(scene: &str, value: &str) -> String {
    let folder = Path::new(scene).parent().filter(|own| !own.as_os_str().is_empty());
    folder.map_or_else(|| value.to_owned(), |own| own.join(value).display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(all: &[&str]) -> Vec<OsString> {
        list(all.iter().map(OsString::from))
    }

    #[test]
    fn the_command_stands_above_the_scene() {
        let text = "[fit]\nto = [\"a.csv:F=pad.force\", \"b.csv:F=pad.force\"]\nvary = \"K=1..9 kN/m\"\n\
                    cfc = 180\nprofile = true\nshift = false\nstarts = 9\n";
        let wishes = fit_wishes(text, None).unwrap();
        let own = with(&wishes, words(&["s/pad.toml", "--starts", "3"]), "s/pad.toml").unwrap();
        assert_eq!((own.to.len(), own.starts, own.profile), (2, 3, true));
        assert_eq!(own.to[1].file, "s/b.csv");
        assert_eq!(own.shift, crate::args::Switch::Off);
        let given = words(&["pad.toml", "--color=never", "--to", "c.csv:F=pad.force"]);
        let own = with(&wishes, given, "pad.toml").unwrap();
        assert_eq!((own.to.len(), own.starts), (1, 9));
        assert!((own.cfc.unwrap().class() - 180.0).abs() < f64::EPSILON);
    }

    #[test]
    fn what_no_option_is_and_wrong_values_are_told() {
        let fault = |text: &str| {
            let wishes = fit_wishes(text, None).unwrap();
            with(&wishes, words(&["pad.toml"]), "pad.toml").unwrap_err().to_string()
        };
        assert!(fault("[fit]\nvari = \"K=1..9\"\n").contains("line 2, vari"));
        assert!(fault("[fit]\nout = \"a.toml\"\n").contains("no such option"));
        assert!(fault("[fit]\ncfc = \"loud\"\n").contains("[fit] of pad.toml"));
        assert!(fault("[fit]\nprofile = 1\n").contains("true or false"));
    }
}
