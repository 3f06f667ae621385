//! The tests of a design: values of its scene, or scenes of their own that have the numbers that are sought.

use std::path::{Path, PathBuf};

use dashpot_scene::{Scene, Tunables, units::si_unit};

use super::{among::Among, asked::Asked};
use crate::{
    args::{Variant, variant},
    error::{CliError, StudyError},
    input::Input,
    operand::{print_notes, read_scene_of},
    output::{each_once, list},
    terminal::Terminal,
    varied::Varied,
};

const FLAG: &str = "--test";
const ENDING: &str = ".toml";

/// A test as it is asked for: values of the scene, or of another one.
#[derive(Debug, Clone)]
pub(super) struct TestArgument {
    pub(super) name: String,
    file: Option<PathBuf>,
    pub(super) set: Vec<(String, String)>,
}

/// A test: a scene, by its position, with values of its own.
#[derive(Debug, Clone, Default)]
pub(super) struct Test {
    /// Empty where it is the scene as it is.
    pub(super) name: String,
    pub(super) scene: usize,
    pub(super) set: Vec<(String, String)>,
}

impl TestArgument {
    /// As it stands on a page; the values as they are set.
    pub(super) fn in_words(&self, values: String) -> String {
        let file = self.file.as_ref().map(|own| own.display().to_string());
        let all = file.into_iter().chain((!values.is_empty()).then_some(values));
        format!("{}: {}", self.name, list(all).join(", "))
    }
}

/// A scene in which designs are tried. The first one is that of the command.
pub(super) struct TestScene {
    pub(super) input: Input,
    pub(super) scene: Scene,
    pub(super) tunables: Tunables,
    /// Where its text has the numbers with bounds …
    numbers: Vec<usize>,
    /// … and what is chosen, choice by choice.
    among: Vec<Vec<usize>>,
}

/// Where in a test as it is asked for the name of a scene begins: behind the name of the test, if it has one.
pub(super) fn file_at(text: &str) -> Option<usize> {
    let named = text.split_once(':').filter(|own| !own.0.contains(['=', '"']));
    let begin = named.map_or(0, |own| own.0.len() + 1);
    let first = text[begin..].split(',').next().unwrap_or_default();
    let is_scene = !first.contains('=') && first.trim_end().ends_with(ENDING);
    is_scene.then(|| begin + (first.len() - first.trim_start().len()))
}

/// `kerb: drop=1.1 m`, `cold.toml` or `cold: drop.toml, foam=2 MPa`; a scene gives its name where the test has none.
pub(super) fn test(text: &str) -> Result<TestArgument, String> {
    let Some(begin) = file_at(text) else {
        let Variant { name, set } = variant(text)
            .map_err(|fault| format!("{fault}; or name a scene, such as \"cold: cold{ENDING}\""))?;
        return Ok(TestArgument { name, file: None, set });
    };
    let (file, values) = text[begin..].split_once(',').unwrap_or((&text[begin..], ""));
    let path = PathBuf::from(file.trim());
    let name = text[..begin].trim().trim_end_matches(':').trim();
    if begin > 0 && name.is_empty() && text.contains(':') {
        return Err("there is no name before the colon; write \"cold: cold.toml\"".to_owned());
    }
    let stem = path.file_stem().map_or_else(String::new, |own| own.to_string_lossy().into_owned());
    let set = if values.trim().is_empty() {
        Vec::new()
    } else {
        variant(&format!("{stem}: {values}"))?.set
    };
    let name = match (name, values.trim()) {
        ("", "") => stem,
        ("", values) => format!("{stem}, {values}"),
        (name, _) => name.to_owned(),
    };
    Ok(TestArgument { name, file: Some(path), set })
}

/// The tests, and the scenes that they have: the one of the command first, others in the order in which they are named.
pub(super) fn tests(
    asked: &[TestArgument],
    own: &Input,
) -> Result<(Vec<Test>, Vec<PathBuf>), CliError> {
    let mut files = vec![PathBuf::from(&own.file)];
    let mut tests: Vec<Test> = Vec::new();
    for TestArgument { name, file, set } in asked {
        if tests.iter().any(|own| own.name == *name) {
            return Err(wrong(format!("two tests are named `{name}`: write \"NAME: …\"")));
        }
        let scene = file.as_ref().map_or(0, |file| {
            let known = files.iter().position(|own| own == file);
            known.unwrap_or_else(|| {
                files.push(file.clone());
                files.len() - 1
            })
        });
        tests.push(Test { name: name.clone(), scene, set: set.clone() });
    }
    if tests.is_empty() {
        tests.push(Test::default());
    }
    files.remove(0);
    Ok((tests, files))
}

/// Says what there is to say about the models of all scenes, each thing once.
pub(super) fn print_all_notes(scenes: &[TestScene]) {
    print_notes(each_once(scenes.iter().flat_map(|own| &own.scene.notes)));
}

impl TestScene {
    /// The scene of the command.
    pub(super) fn own(input: Input, scene: Scene, asked: &Asked) -> Self {
        let numbers = asked.numbers.iter().filter_map(|own| own.at);
        let among = asked.among.iter().map(|own| list(own.places()));
        let (numbers, among) = (list(numbers), list(among));
        Self { input, scene, tunables: asked.tunables.clone(), numbers, among }
    }

    /// Another one, which has everything that is sought by the same names.
    pub(super) fn other(
        path: &Path,
        asked: &Asked,
        set: &[(String, String)],
        terminal: Terminal,
    ) -> Result<Self, CliError> {
        let input = crate::input::read_input(path)?;
        let scene = read_scene_of(&input, set, terminal)?;
        let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(StudyError::Scene)?;
        let missing = |name: &str, why: String| {
            let file = &input.file;
            wrong(format!("`{name}` is sought, and has to be in {file} by the same name: {why}"))
        };
        let number = |own: &Varied| {
            let at = tunables.find(&own.name);
            let at = at.map_err(|fault| missing(&own.name, fault.to_string()))?;
            let si = tunables.all()[at].dimension.map(si_unit);
            match si.filter(|si| *si != own.si && !own.si.is_empty()) {
                Some(si) => {
                    Err(missing(&own.name, format!("there it is in {si}, not in {}", own.si)))
                }
                None => Ok(at),
            }
        };
        let chosen = |own: &Among| -> Result<Vec<usize>, CliError> {
            let each = own.names.iter().map(|name| {
                tunables.anything(name).map_err(|fault| missing(name, fault.to_string()))
            });
            each.collect()
        };
        let numbers = asked.numbers.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        let among = asked.among.iter().map(chosen).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { input, scene, tunables, numbers, among })
    }

    /// The position of a number with bounds in its text.
    pub(super) fn place(&self, number: usize) -> Option<usize> {
        self.numbers.get(number).copied()
    }

    /// What stands in its text where numbers are written like this, number by number, and a choice is taken.
    pub(super) fn values(
        &self,
        numbers: Vec<String>,
        asked: &Asked,
        choice: &[usize],
    ) -> Vec<(usize, String)> {
        let numbers = self.numbers.iter().copied().zip(numbers);
        let chosen = asked.among.iter().zip(choice).zip(&self.among);
        let chosen =
            chosen.flat_map(|((own, at), places)| places.iter().copied().zip(own.written(*at)));
        list(numbers.chain(chosen))
    }

    /// What is set, by the command or a test, stands above what is sought: it cannot be both.
    pub(super) fn check_set(&self, set: &[(String, String)]) -> Result<(), CliError> {
        let is_sought = |name: &str| {
            self.tunables.anything(name).is_ok_and(|own| {
                self.numbers.contains(&own) || self.among.iter().flatten().any(|at| *at == own)
            })
        };
        match set.iter().map(|own| &own.0).find(|own| is_sought(own)) {
            Some(name) => Err(CliError::SetAndVaried { name: name.clone() }),
            None => Ok(()),
        }
    }
}

fn wrong(reason: String) -> CliError {
    CliError::setting(FLAG, reason)
}

#[cfg(test)]
mod unit_tests {
    use super::*;

    fn read_of(text: &str) -> (String, Option<String>, usize) {
        let own = test(text).unwrap();
        (own.name, own.file.map(|own| own.display().to_string()), own.set.len())
    }

    #[test]
    fn a_test_has_values_a_scene_or_both() {
        let told =
            |name: &str, file: Option<&str>, set| (name.to_owned(), file.map(str::to_owned), set);
        for (text, known) in [
            ("kerb: drop=1.1 m, head.mass=6 kg", told("kerb", None, 2)),
            ("drop=1.1 m", told("drop=1.1 m", None, 1)),
            ("a/drop-cold.toml", told("drop-cold", Some("a/drop-cold.toml"), 0)),
            ("cold: a/drop.toml", told("cold", Some("a/drop.toml"), 0)),
            ("cold: drop.toml, T=2 MPa", told("cold", Some("drop.toml"), 1)),
            ("drop.toml, T=2 MPa", told("drop, T=2 MPa", Some("drop.toml"), 1)),
        ] {
            assert_eq!(read_of(text), known, "{text}");
        }
        assert_eq!(
            (file_at("cold:  a.toml"), file_at("a.toml"), file_at("x=a.toml")),
            (Some(7), Some(0), None)
        );
        assert!(test("drop").unwrap_err().contains("scene") && test(": a.toml").is_err());
    }
}
