//! What the command line changed about a scene, and the text of the scene with it.

use std::fmt::Write as _;

use dashpot_scene::{Scene, read};
use toml_edit::{Array, DocumentMut, Item, Table, Value};

use super::RunArguments;
use crate::{args::Switch, input::options};

/// What the command line says in place of the scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Changes {
    /// Named values and their texts, each name once.
    pub(super) set: Vec<(String, String)>,
    methods: Vec<String>,
    accuracy: Option<f64>,
    neglect: Option<f64>,
    rtol: Option<f64>,
    unestimated: bool,
    budget: Option<u64>,
    /// Limits as the command line states them.
    limits: Vec<String>,
}

impl Changes {
    /// Those of a command line.
    pub(super) fn of(arguments: &RunArguments, given: &[(String, String)]) -> Self {
        let mut set: Vec<(String, String)> = Vec::new();
        for (name, text) in given {
            match set.iter_mut().find(|(known, _)| known == name) {
                // The last one counts.
                Some((_, known)) => known.clone_from(text),
                None => set.push((name.clone(), text.clone())),
            }
        }
        Self {
            set,
            methods: arguments.method.clone(),
            accuracy: arguments.accuracy,
            neglect: arguments.neglect,
            rtol: arguments.rtol,
            unestimated: arguments.estimate == Switch::Off,
            budget: arguments.budget.map(|budget| budget.0),
            limits: arguments.limits.limit.iter().map(|own| own.text.clone()).collect(),
        }
    }

    /// The values that were set, for people; `None` if none were.
    pub(super) fn description(&self) -> Option<String> {
        let pairs: Vec<String> =
            self.set.iter().map(|(name, text)| format!("{name} = {text}")).collect();
        (!pairs.is_empty()).then(|| format!("with {}", pairs.join(", ")))
    }

    /// As options of the command; empty if there are none.
    fn options(&self) -> String {
        let mut options: Vec<String> =
            self.set.iter().map(|(name, text)| format!("--set \"{name}={text}\"")).collect();
        if !self.methods.is_empty() {
            options.push(format!("--method {}", self.methods.join(",")));
        }
        options.extend(self.accuracy.map(|accuracy| format!("--accuracy {accuracy:?}")));
        options.extend(self.neglect.map(|neglect| format!("--neglect {neglect:?}")));
        options.extend(self.rtol.map(|rtol| format!("--rtol {rtol:?}")));
        if self.unestimated {
            options.push("--estimate off".to_owned());
        }
        options.extend(self.budget.map(|budget| format!("--budget {budget}")));
        options.extend(self.limits.iter().map(|limit| format!("--limit \"{limit}\"")));
        options.join(" ")
    }
}

/// The text of `scene` with the changes written into it, below a comment that names them. What
/// cannot be written there stands in the comment as the options that repeat the run.
pub(super) fn text(scene: &Scene, changes: &Changes) -> String {
    let options = changes.options();
    if options.is_empty() {
        return scene.text.to_string();
    }
    let (text, rest) =
        written(scene, changes).unwrap_or_else(|| (scene.text.to_string(), changes.clone()));
    let mut comment = format!("# as run with {options}\n");
    let rest = rest.options();
    if !rest.is_empty() {
        let _ = writeln!(comment, "# not all of that stands below; add: {rest}");
    }
    below_directive(&text, &comment)
}

/// A directive for editors holds in the first line only.
fn below_directive(text: &str, comment: &str) -> String {
    match text.split_inclusive('\n').next().filter(|line| line.starts_with("#:")) {
        Some(line) => format!("{line}{comment}{}", &text[line.len()..]),
        None => format!("{comment}{text}"),
    }
}

/// The text with the changes, and those that could not be written. `None` where the text then says
/// something else than what was run.
fn written(scene: &Scene, changes: &Changes) -> Option<(String, Changes)> {
    let mut document: DocumentMut = scene.text.parse().ok()?;
    let mut rest = changes.clone();
    // What is set by a path stands in the text already.
    let is_named = |name: &str| scene.values.iter().any(|known| known.name == name);
    rest.set.retain(|(name, value)| {
        is_named(name) && !replace(&mut document, "values", name, &value.as_str().into())
    });
    // One accuracy for all measures goes where the scene says nothing that it would override.
    let run = document.get("run").and_then(Item::as_table_like);
    let has_tolerance = run.is_some_and(|run| run.contains_key("rtol"));
    let has_accuracy = document.contains_key("accuracy");
    if !(changes.accuracy.is_some() && has_tolerance || has_accuracy) {
        let wishes = [("default", changes.accuracy), ("neglect-below", changes.neglect)];
        for (key, wish) in wishes {
            if let Some(wish) = wish {
                let accuracy = document.entry("accuracy").or_insert(Item::Table(Table::new()));
                accuracy[key] = Item::Value(number(wish)?);
            }
        }
        (rest.accuracy, rest.neglect) = (None, None);
    }
    let methods: Array = changes.methods.iter().map(String::as_str).collect();
    if !methods.is_empty() && put_in_run(&mut document, "methods", methods.into()) {
        rest.methods.clear();
    }
    if let Some(rtol) = changes.rtol
        && put_in_run(&mut document, "rtol", number(rtol)?)
    {
        rest.rtol = None;
    }
    let text = document.to_string();
    let read = read(&text, &options(scene.file.as_deref(), &rest.set)).ok()?.value;
    let methods_agree = changes.methods.is_empty()
        || !rest.methods.is_empty()
        || read.run.methods == changes.methods;
    (read.values == scene.values && methods_agree).then_some((text, rest))
}

/// A number as it is written on the command line.
fn number(value: f64) -> Option<Value> {
    format!("{value:?}").parse().ok()
}

/// Replaces a value that is there; what stands around it is kept.
fn replace(document: &mut DocumentMut, section: &str, key: &str, value: &Value) -> bool {
    let section = document.get_mut(section).and_then(Item::as_table_like_mut);
    let old = section.and_then(|section| section.get_mut(key)).and_then(Item::as_value_mut);
    let Some(old) = old else { return false };
    let decor = old.decor().clone();
    *old = value.clone();
    *old.decor_mut() = decor;
    true
}

/// Replaces a value of `[run]`, or adds it there, unless that is an inline table.
fn put_in_run(document: &mut DocumentMut, key: &str, value: Value) -> bool {
    if replace(document, "run", key, &value) {
        return true;
    }
    let Some(run) = document.get_mut("run").and_then(Item::as_table_mut) else { return false };
    run.insert(key, Item::Value(value));
    true
}

#[cfg(test)]
mod tests {
    use dashpot_scene::ReadOptions;

    use super::*;

    const SCENE: &str = "#:schema ./scene.schema.json\n[values]\nK = '50 kN/m' # soft\n[nodes]\n\
        head = { mass = \"5 kg\", velocity = \"6 m/s\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], spring = \"K\" }\n[run]\nduration = \"40 ms\"\n";

    fn resolved_scene(scene: &str, changes: &Changes) -> String {
        let options = ReadOptions { set: &changes.set, ..ReadOptions::default() };
        text(&read(scene, &options).unwrap().value, changes)
    }

    fn set_k(text: &str) -> Vec<(String, String)> {
        vec![("K".to_owned(), text.to_owned())]
    }

    #[test]
    fn changes_are_written_into_the_scene() {
        let changes = Changes {
            set: set_k("80 kN/m"),
            methods: vec!["exact".to_owned(), "bdf".to_owned()],
            accuracy: Some(1e-4),
            neglect: Some(5e-3),
            ..Changes::default()
        };
        let text = resolved_scene(&SCENE.replace("K = '", "  K='"), &changes);
        let first: Vec<&str> = text.lines().take(2).collect();
        let comment = "# as run with --set \"K=80 kN/m\" --method exact,bdf --accuracy 0.0001 --neglect 0.005";
        assert_eq!(first, ["#:schema ./scene.schema.json", comment]);
        assert!(text.contains("  K=\"80 kN/m\" # soft\n") && !text.contains("add:"), "{text}");
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        assert_eq!(scene.run.methods, ["exact", "bdf"]);
        assert!((scene.values[0].value - 8e4).abs() < 1e-9);
        assert!((scene.accuracy.default - 1e-4).abs() < 1e-18);
        assert_eq!(scene.accuracy.neglect_below, Some(5e-3));
    }

    #[test]
    fn what_has_no_place_in_the_scene_is_named_for_the_command_line() {
        let changes = Changes { unestimated: true, rtol: Some(1e-6), ..Changes::default() };
        let inline = SCENE.replace("[run]\nduration = \"40 ms\"\n", "");
        let inline = format!("run = {{ duration = \"40 ms\" }}\n{inline}");
        let text = resolved_scene(&inline, &changes);
        assert!(text.contains("add: --rtol 1e-6 --estimate off\n"), "{text}");
        assert!(text.ends_with(&inline));
    }

    #[test]
    fn nothing_changes_where_nothing_was_asked() {
        assert_eq!(resolved_scene(SCENE, &Changes::default()), SCENE);
        let set = vec![("head.mass".to_owned(), "6 kg".to_owned())];
        let text = resolved_scene(SCENE, &Changes { set, ..Changes::default() });
        assert!(text.contains("# as run with --set \"head.mass=6 kg\"\n"), "{text}");
        assert!(text.contains("mass = \"6 kg\"") && !text.contains("add:"), "{text}");
        let changes = Changes { set: set_k("1 N/m"), ..Changes::default() };
        assert_eq!(changes.description().as_deref(), Some("with K = 1 N/m"));
    }
}
