//! Sections such as `[fit]` and `[design]` of a scene: the options of a verb by their names. Those of the command line
//! stand above them.

use std::{ffi::OsString, path::Path};

use clap::{ArgAction, Args, Command, FromArgMatches};
use dashpot_scene::{Wish, wishes};
use toml_edit::{DocumentMut, Item, Value};

use crate::{
    error::{CliError, StudyError},
    host,
    input::Input,
    output::list,
};

/// Options of a call, which no scene has.
const OF_THE_CALL: [&str; 4] = ["out", "force", "json", "set"];
/// Global options, which may stand among those of a verb.
const COLOR: &str = "color";
const STRICT: &str = "strict";

/// Where in a value the name of a file begins, if it has one.
type FileAt = fn(&str) -> Option<usize>;

/// A verb that has a section.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Verb {
    pub(crate) name: &'static str,
    /// Its options whose values may name a file, and where in a value that begins.
    pub(crate) files: &'static [(&'static str, FileAt)],
}

impl Verb {
    /// The command with what the scene sets; `None` where it sets nothing.
    pub(crate) fn merged<A: Args + FromArgMatches>(
        self,
        input: &Input,
    ) -> Result<Option<A>, CliError> {
        let wishes =
            wishes(self.name, input.text()?, Some(&input.file)).map_err(StudyError::Scene)?;
        if wishes.is_empty() {
            return Ok(None);
        }
        let given: Vec<OsString> =
            list(host::arguments().into_iter().skip_while(|own| own != self.name).skip(1));
        self.with(&wishes, given, &input.file).map(Some)
    }

    /// What the words of a command line are with these wishes before them.
    fn with<A: Args + FromArgMatches>(
        self,
        wishes: &[Wish],
        given: Vec<OsString>,
        file: &str,
    ) -> Result<A, CliError> {
        let command = A::augment_args(Command::new(self.name).no_binary_name(true));
        let command = command.arg(clap::Arg::new(COLOR).long(COLOR).num_args(1));
        let command = command.arg(clap::Arg::new(STRICT).long(STRICT).action(ArgAction::SetTrue));
        let mut words: Vec<OsString> = Vec::new();
        for wish in wishes {
            words.extend(self.words(&command, wish, &given, file)?);
        }
        words.extend(given);
        let matches = command.try_get_matches_from(words);
        let found = matches.and_then(|own| A::from_arg_matches(&own));
        found.map_err(|fault| {
            let text = fault.to_string();
            let reason =
                text.trim_start_matches("error: ").split("\n\n").next().unwrap_or_default();
            CliError::setting(&format!("[{}] of {file}", self.name), reason)
        })
    }

    /// The words of a command line that say what a scene wishes; none where the command line says otherwise.
    fn words(
        self,
        command: &Command,
        wish: &Wish,
        given: &[OsString],
        file: &str,
    ) -> Result<Vec<OsString>, CliError> {
        let wrong = |reason: String| {
            CliError::setting(&format!("{file}, line {}, {}", wish.line, wish.key), reason)
        };
        let known = command.get_arguments().filter_map(|own| Some((own.get_long()?, own)));
        let known =
            known.filter(|own| ![COLOR, STRICT].contains(&own.0) && !OF_THE_CALL.contains(&own.0));
        let known: Vec<_> = list(known);
        let Some((name, own)) = known.iter().find(|own| own.0 == wish.key) else {
            let names = list(known.iter().map(|own| own.0)).join(", ");
            let verb = self.name;
            return Err(wrong(format!("`[{verb}]` has no such option; it has {names}")));
        };
        let option = format!("--{name}");
        let is_it = |word: &OsString| {
            word.to_str().is_some_and(|word| {
                word == option || word.strip_prefix(&option).is_some_and(|own| own.starts_with('='))
            })
        };
        // What one option leaves no room for, the command line has put aside as well.
        let is_given = |own: &&clap::Arg| {
            let long = own.get_long().map(|own| format!("--{own}"));
            given.iter().any(|word| long.as_deref().is_some_and(|own| word == own))
        };
        let is_aside = |own: &clap::Arg| {
            let excludes = |one: &clap::Arg, other: &clap::Arg| {
                let mut all = command.get_arg_conflicts_with(one).into_iter();
                all.any(|own| own.get_id() == other.get_id())
            };
            let mut all = command.get_arguments().filter(is_given);
            all.any(|other| excludes(own, other) || excludes(other, own))
        };
        if given.iter().any(is_it) || is_aside(own) {
            return Ok(Vec::new());
        }
        match own.get_action() {
            ArgAction::SetTrue if !wish.is_switch => Err(wrong("it is true or false".to_owned())),
            ArgAction::SetTrue => Ok(list(wish.values.iter().map(|_| option.clone().into()))),
            _ if wish.is_switch => {
                let value = if wish.values.is_empty() { "off" } else { "on" };
                Ok(vec![format!("{option}={value}").into()])
            }
            _ => Ok(list(wish.values.iter().map(|value| {
                let named = self.files.iter().find(|own| own.0 == *name);
                let value = match named.and_then(|own| own.1(value)) {
                    Some(at) => format!("{}{}", &value[..at], beside(file, &value[at..])),
                    None => value.clone(),
                };
                format!("{option}={value}").into()
            }))),
        }
    }
}

/// The text of a scene where the files that the sections of these verbs name are in the folders that `led` gives for
/// theirs, unless they are absolute.
pub(crate) fn with_paths(
    text: &str,
    verbs: &[Verb],
    led: &dyn Fn(&str) -> Option<String>,
) -> String {
    let Ok(mut document) = text.parse::<DocumentMut>() else { return text.to_owned() };
    for verb in verbs {
        let Some(section) = document.get_mut(verb.name).and_then(Item::as_table_like_mut) else {
            continue;
        };
        for (option, begin) in verb.files {
            let Some(value) = section.get_mut(option).and_then(Item::as_value_mut) else {
                continue;
            };
            let lead = |own: &mut Value| {
                let led = own.as_str().and_then(|own| {
                    let at = begin(own).filter(|at| !Path::new(&own[*at..]).has_root())?;
                    let file = own[at..].split(':').next().unwrap_or_default();
                    let end = at + file.rfind('/').map_or(0, |own| own + 1);
                    Some(format!("{}{}{}", &own[..at], led(&own[at..end])?, &own[end..]))
                });
                if let Some(led) = led {
                    let decor = own.decor().clone();
                    *own = Value::from(led);
                    *own.decor_mut() = decor;
                }
            };
            match value {
                Value::Array(all) => all.iter_mut().for_each(lead),
                own => lead(own),
            }
        }
    }
    document.to_string()
}

/// A file that is named in a scene is one beside it.
fn beside(scene: &str, value: &str) -> String {
    let folder = Path::new(scene).parent().filter(|own| !own.as_os_str().is_empty());
    folder.map_or_else(|| value.to_owned(), |own| own.join(value).display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Switch;

    #[derive(Debug, Args)]
    struct Own {
        scene: Option<String>,
        #[arg(long)]
        to: Vec<String>,
        #[arg(long, conflicts_with = "alone")]
        vary: Vec<String>,
        #[arg(long)]
        alone: Option<String>,
        #[arg(long, default_value_t = 5)]
        starts: usize,
        #[arg(long)]
        profile: bool,
        #[arg(long, default_value = "on")]
        shift: Switch,
        #[arg(long)]
        out: Option<String>,
    }

    const VERB: Verb = Verb { name: "fit", files: &[("to", |_| Some(0))] };

    fn words(all: &[&str]) -> Vec<OsString> {
        list(all.iter().map(OsString::from))
    }

    fn with(text: &str, given: &[&str], file: &str) -> Result<Own, CliError> {
        VERB.with(&wishes("fit", text, None).unwrap(), words(given), file)
    }

    #[test]
    fn the_command_stands_above_the_scene() {
        let text = "[fit]\nto = [\"a.csv:F=pad.force\", \"b.csv:F=pad.force\"]\nvary = \"K=1..9 kN/m\"\n\
                    profile = true\nshift = false\nstarts = 9\n";
        let own = with(text, &["s/pad.toml", "--starts", "3"], "s/pad.toml").unwrap();
        assert_eq!((own.scene.as_deref(), own.starts, own.profile), (Some("s/pad.toml"), 3, true));
        assert_eq!(own.to, ["s/a.csv:F=pad.force", "s/b.csv:F=pad.force"]);
        assert!(own.shift == Switch::Off && own.out.is_none());
        let given = ["pad.toml", "--color=never", "--to", "c.csv:F=pad.force"];
        let own = with(text, &given, "pad.toml").unwrap();
        assert_eq!((own.to.len(), own.starts, own.vary.len()), (1, 9, 1));
        // What an option of the command excludes is not taken from the scene.
        let own = with(text, &["pad.toml", "--alone", "K"], "pad.toml").unwrap();
        assert_eq!((own.vary.len(), own.alone.as_deref()), (0, Some("K")));
    }

    #[test]
    fn what_no_option_is_and_wrong_values_are_told() {
        let fault = |text: &str| with(text, &["pad.toml"], "pad.toml").unwrap_err().to_string();
        assert!(fault("[fit]\nvari = \"K=1..9\"\n").contains("line 2, vari"));
        assert!(fault("[fit]\nout = \"a.toml\"\n").contains("no such option"));
        assert!(fault("[fit]\nstarts = \"loud\"\n").contains("[fit] of pad.toml"));
        assert!(fault("[fit]\nprofile = 1\n").contains("true or false"));
    }
}
