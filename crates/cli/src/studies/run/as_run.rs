//! What the command line changed about a scene, and the text of the scene with it.

use std::{fmt::Write as _, ops::Range};

use dashpot_scene::{ReadOptions, Scene, read};
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::{
    args::{RunArguments, Switch},
    input::load,
};

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
}

impl Changes {
    /// Those of a command line.
    pub(super) fn of(arguments: &RunArguments) -> Self {
        let mut set: Vec<(String, String)> = Vec::new();
        for (name, text) in &arguments.scene.values.set {
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
            budget: arguments.budget,
        }
    }

    /// The values that were set, for people; `None` if none were.
    pub(super) fn told(&self) -> Option<String> {
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
        options.extend(self.accuracy.map(|own| format!("--accuracy {own:?}")));
        options.extend(self.neglect.map(|own| format!("--neglect {own:?}")));
        options.extend(self.rtol.map(|own| format!("--rtol {own:?}")));
        if self.unestimated {
            options.push("--estimate off".to_owned());
        }
        options.extend(self.budget.map(|own| format!("--budget {own}")));
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
    let table = DeTable::parse(&scene.text).ok()?;
    let mut edits = Edits { text: &scene.text, table: table.get_ref(), list: Vec::new() };
    let mut rest = changes.clone();
    rest.set.retain(|(name, value)| !edits.replace("values", name, &quoted(value)));
    let methods: Vec<String> = changes.methods.iter().map(|own| quoted(own)).collect();
    if !methods.is_empty() && edits.put_in_run("methods", &format!("[{}]", methods.join(", "))) {
        rest.methods.clear();
    }
    if changes.rtol.is_some_and(|rtol| edits.put_in_run("rtol", &format!("{rtol:?}"))) {
        rest.rtol = None;
    }
    if edits.append_accuracy(changes.accuracy, changes.neglect) {
        (rest.accuracy, rest.neglect) = (None, None);
    }
    let text = edits.applied();
    let options = ReadOptions { file: scene.file.as_deref(), set: &rest.set, loader: Some(&load) };
    let read = read(&text, &options).ok()?.value;
    let methods_agree = changes.methods.is_empty()
        || !rest.methods.is_empty()
        || read.run.methods == changes.methods;
    (read.values == scene.values && methods_agree).then_some((text, rest))
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Changes of a text at places that its tables give.
struct Edits<'t> {
    text: &'t str,
    table: &'t DeTable<'t>,
    list: Vec<(Range<usize>, String)>,
}

impl Edits<'_> {
    /// Replaces a value that is there.
    fn replace(&mut self, section: &str, key: &str, value: &str) -> bool {
        let Some(DeValue::Table(entries)) = self.table.get(section).map(Spanned::get_ref) else {
            return false;
        };
        let Some(old) = entries.get(key) else { return false };
        self.list.push((old.span(), value.to_owned()));
        true
    }

    /// Replaces a value of `[run]`, or adds a line for it before the first one.
    fn put_in_run(&mut self, key: &str, value: &str) -> bool {
        if self.replace("run", key, value) {
            return true;
        }
        let Some(DeValue::Table(entries)) = self.table.get("run").map(Spanned::get_ref) else {
            return false;
        };
        let Some(first) = entries.keys().map(|key| key.span().start).min() else { return false };
        let line = self.text[..first].rfind('\n').map_or(0, |at| at + 1);
        // Neither in an inline table nor behind a dotted key.
        let is_free = self.text[line..first].trim().is_empty();
        if is_free {
            self.list.push((line..line, format!("{key} = {value}\n")));
        }
        is_free
    }

    /// Adds one accuracy for all measures, and a bound for what may be left out, where the scene
    /// says nothing that they would override.
    fn append_accuracy(&mut self, accuracy: Option<f64>, neglect: Option<f64>) -> bool {
        let has_tolerance = matches!(
            self.table.get("run").map(Spanned::get_ref),
            Some(DeValue::Table(entries)) if entries.contains_key("rtol")
        );
        if accuracy.is_some() && has_tolerance || self.table.contains_key("accuracy") {
            return false;
        }
        let default = accuracy.map(|own| format!("default = {own:?}\n"));
        let neglect = neglect.map(|own| format!("neglect-below = {own:?}\n"));
        let lines: String = default.into_iter().chain(neglect).collect();
        if !lines.is_empty() {
            let end = self.text.len();
            self.list.push((end..end, format!("\n[accuracy]\n{lines}")));
        }
        true
    }

    fn applied(mut self) -> String {
        let mut text = self.text.to_owned();
        self.list.sort_by_key(|(place, _)| std::cmp::Reverse(place.start));
        for (place, value) in self.list {
            text.replace_range(place, &value);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "#:schema ./scene.schema.json\n[values]\nK = '50 kN/m' # soft\n[nodes]\n\
        head = { mass = \"5 kg\", velocity = \"6 m/s\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], spring = \"K\" }\n[run]\nduration = \"40 ms\"\n";

    fn as_run(scene: &str, changes: &Changes) -> String {
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
        let text = as_run(&SCENE.replace("K = '", "  K='"), &changes);
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
        let text = as_run(&inline, &changes);
        assert!(text.contains("add: --rtol 1e-6 --estimate off\n"), "{text}");
        assert!(text.ends_with(&inline));
    }

    #[test]
    fn nothing_changes_where_nothing_was_asked() {
        assert_eq!(as_run(SCENE, &Changes::default()), SCENE);
        let changes = Changes { set: set_k("1 N/m"), ..Changes::default() };
        assert_eq!(changes.told().as_deref(), Some("with K = 1 N/m"));
    }
}
