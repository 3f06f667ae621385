//! `dashpot list`: the registers as entries.

use std::fmt::Write as _;

use clap::{Args, ValueEnum};
use dashpot_analysis::{
    Bound, Limit,
    limits::standards::{STANDARDS, Standard},
    measures::{self, MEASURES, MeasureEntry},
    rheometer::{FROM_THE_MODEL, PROTOCOLS},
};
use dashpot_dae::methods;
use dashpot_network::{
    composites::COMPOSITES,
    effects::{EFFECTS, EffectEntry},
    elements::ELEMENTS,
    parameters::{Dimension, Parameter, ParameterKind, Registered},
    shifts::SHIFTS,
    waveforms::WAVEFORMS,
};
use dashpot_rheology::{FORMS, Form, Part, Role};
use dashpot_scene::{Shipped, references, templates, write_effect, write_kind};

use crate::{
    error::{CliError, Status},
    terminal::{Terminal, Tone, WIDTH, print},
    verbs::run::level,
};
use dashpot_report::Tones as _;
use dashpot_report::layout::{columns, wrapped};

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Family {
    /// Primitive laws of elements.
    Elements,
    /// Named models composed of them.
    Forms,
    /// Models that a few numbers describe as a whole.
    Composites,
    /// Shifts of the times of a model.
    Shifts,
    /// Functions of time for loads and motions.
    Waveforms,
    /// What acts on a network besides its elements.
    Effects,
    /// Numbers read off a run.
    Measures,
    /// Limits that standards state.
    Limits,
    /// Ways to solve.
    Methods,
    /// Tests of a model alone.
    Tests,
    /// Scenes to start from.
    Templates,
    /// Scenes that are built in.
    Scenes,
}

/// All families, in the order in which they are listed.
const FAMILIES: [(Family, &str); 12] = [
    (Family::Elements, "Elements: laws between two nodes, composed by `series` and `parallel`"),
    (Family::Forms, "Forms: models by name, composed of springs and dashpots"),
    (Family::Composites, "Composites: models that a few numbers describe as a whole"),
    (Family::Shifts, "Shifts: for `shift` beside the law of a model; they multiply all its times"),
    (Family::Waveforms, "Waveforms: functions of time for `force`, `motion` and `acceleration`"),
    (Family::Effects, "Effects: off unless they are named in [effects]"),
    (Family::Measures, "Measures: numbers read off a run; * marks those that every run reports"),
    (Family::Limits, "Limits: of standards, for [limits] and `--limit KEY=NAME`"),
    (Family::Methods, "Methods: ways to solve, for `--method` and `methods` in [run]"),
    (Family::Tests, "Tests: of a model alone, by `dashpot rheometer --test NAME`"),
    (Family::Templates, "Templates: scenes to start from, by `dashpot new NAME`"),
    (Family::Scenes, "Scenes: built in, for `dashpot run NAME`"),
];

/// What the parameter of that name is, which most measures have.
const WINDOW: &str = "`impact` (default), `run`, or a pair of times";

/// `list`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  dashpot list\n  dashpot list measures\n  dashpot list zener")]
pub(crate) struct ListArguments {
    /// One family alone (elements, forms, composites, shifts, waveforms, effects, measures,
    /// limits, methods, tests, templates, scenes), or one kind, by any of its names.
    #[arg(value_name = "FAMILY|KIND")]
    what: Option<String>,
}

/// Prints every kind of one family, or of all, or one kind alone.
pub(crate) fn list(arguments: &ListArguments, terminal: Terminal) -> Result<Status, CliError> {
    let word = arguments.what.as_deref();
    let only = word.and_then(|word| Family::from_str(word, true).ok());
    let kind = word.filter(|_| only.is_none());
    let mut text = String::new();
    for (family, title) in FAMILIES.into_iter().filter(|own| only.is_none_or(|only| only == own.0))
    {
        let mut entries = match family {
            Family::Templates => templates().iter().map(shipped).collect(),
            Family::Scenes => references().iter().map(shipped).collect(),
            family => entries(family),
        };
        if let Some(kind) = kind {
            entries.retain(|entry| is_called(entry, kind));
            if entries.is_empty() {
                continue;
            }
        }
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, title));
        let widest = entries.iter().map(|entry| columns(&entry.name)).max().unwrap_or(0);
        entries.iter().for_each(|entry| text += &entry_text(entry, widest));
        if family == Family::Measures {
            let _ = writeln!(text, "  A `window` is {WINDOW}.");
        }
    }
    match kind.filter(|_| text.is_empty()) {
        Some(kind) => {
            let all = FAMILIES.iter().flat_map(|own| entries(own.0)).collect::<Vec<_>>();
            let names = all.iter().map(|own| own.name.trim_end_matches('*'));
            Err(CliError::unknown_kind(
                kind,
                names.chain(all.iter().flat_map(|own| own.aliases).copied()),
            ))
        }
        None => print(&text).map(|()| Status::Done),
    }
}

/// Whether this is a word for the entry; the mark of those that every run reports is none of it.
fn is_called(entry: &Entry, word: &str) -> bool {
    entry.name.trim_end_matches('*') == word || entry.aliases.contains(&word)
}

fn shipped(shipped: &Shipped) -> Entry {
    Entry::plain(shipped.name, shipped.summary)
}

/// The text of a scene in lines of at most `room` columns, broken behind commas, where it may be read in so.
fn parted(example: &str, room: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in example.split_inclusive(", ") {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && columns(&lines[last]) + columns(part.trim_end()) > room {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last] += part;
    }
    lines.iter().map(|line| line.trim_end().to_owned()).collect()
}

fn entry_text(entry: &Entry, widest: usize) -> String {
    let mut text = String::new();
    let room = WIDTH - widest - 4;
    for (at, line) in wrapped(&entry.summary, room).iter().enumerate() {
        let name = if at == 0 { entry.name.as_str() } else { "" };
        let _ = writeln!(text, "  {name:widest$}  {line}");
    }
    let example = entry.example.iter().map(|own| parted(own, WIDTH - 10));
    let details = entry.details.iter().map(|own| wrapped(own, WIDTH - 10));
    for lines in example.chain(details) {
        for (at, line) in lines.iter().enumerate() {
            let indent = if at == 0 { "" } else { "  " };
            let _ = writeln!(text, "      {indent}{line}");
        }
    }
    text
}

/// A kind in a list.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Entry {
    name: String,
    /// One line on what it is.
    summary: String,
    /// How it is written, where that needs an example.
    example: Option<String>,
    /// Its parameters, one line each.
    details: Vec<String>,
    /// Other words for it.
    aliases: &'static [&'static str],
}

impl Entry {
    /// An entry without example and parameters.
    fn plain(name: &str, summary: &str) -> Self {
        let (name, summary) = (name.to_owned(), summary.to_owned());
        Self { name, summary, example: None, details: Vec::new(), aliases: &[] }
    }
}

/// The entries of a register; none for families that are no register.
fn entries(family: Family) -> Vec<Entry> {
    match family {
        Family::Elements => ELEMENTS.iter().map(|own| written(own, Dimension::FORCE)).collect(),
        Family::Forms => FORMS.iter().map(form).collect(),
        Family::Composites => COMPOSITES.iter().map(|own| written(own, own.about)).collect(),
        Family::Shifts => SHIFTS.iter().map(shift).collect(),
        Family::Waveforms => WAVEFORMS.iter().map(|own| written(own, Dimension::FORCE)).collect(),
        Family::Effects => EFFECTS.iter().map(effect).collect(),
        Family::Measures => MEASURES.iter().map(measure).collect(),
        Family::Limits => STANDARDS.iter().map(limits).collect(),
        Family::Methods => {
            let all = methods::all();
            all.iter().map(|method| Entry::plain(method.name(), method.summary())).collect()
        }
        Family::Tests => PROTOCOLS.iter().map(of_kind).collect(),
        Family::Templates | Family::Scenes => Vec::new(),
    }
}

fn limits(standard: &Standard) -> Entry {
    let kinds = standard.kinds.join(" or ");
    let bound = |&(most, of_mean): &(f64, bool)| {
        let limit = Limit::new("", Bound::Max(most));
        let unit = MEASURES.iter().find(|own| own.word == standard.kinds[0]);
        let unit = unit.map_or("1", |own| own.about.unit);
        let of_mean = if of_mean { " in the mean of several tests" } else { "" };
        format!("{kinds} at most {}{of_mean}", level(&limit, standard.kinds[0], unit))
    };
    let bounds = standard.bounds.iter().map(bound);
    let source = format!("read from: {}", standard.source);
    let summary = format!("{}: {}", standard.edition, standard.test);
    Entry { details: bounds.chain([source]).collect(), ..Entry::plain(standard.word, &summary) }
}

/// A kind with its parameters.
fn of_kind<T, A>(kind: &Registered<T, A>) -> Entry {
    let details = kind.parameters.iter().map(described).collect();
    Entry { details, ..Entry::plain(kind.word, kind.summary) }
}

/// A kind with its sample, whose amplitudes are of this dimension.
fn written<T, A>(kind: &Registered<T, A>, driven: Dimension) -> Entry {
    let example = write_kind(kind.word, kind.parameters, &(kind.sample)(), driven);
    Entry { example: Some(example), ..of_kind(kind) }
}

fn shift(kind: &Registered<f64>) -> Entry {
    let own = written(kind, Dimension::NUMBER);
    Entry { example: own.example.map(|example| format!("shift = {{ {example} }}")), ..own }
}

fn effect(kind: &EffectEntry) -> Entry {
    let example = kind.example().ok().map(|own| write_effect(own.as_ref()));
    Entry { example, ..of_kind(kind) }
}

fn form(form: &Form) -> Entry {
    let example = Some(format!("{} = {}", form.word, parts(form.parts)));
    let also = format!("also called {}", form.aliases.join(", "));
    let details = if form.aliases.is_empty() { Vec::new() } else { vec![also] };
    Entry { example, details, aliases: form.aliases, ..Entry::plain(form.word, form.summary) }
}

fn measure(kind: &MeasureEntry) -> Entry {
    let mark = if kind.about.by_default { "*" } else { "" };
    let of = match kind.about.family {
        measures::Family::Element => "of an element",
        measures::Family::Node => "of a node",
    };
    let is_window = |parameter: &&Parameter| parameter.kind == ParameterKind::Window;
    let window =
        if kind.parameters.iter().any(|parameter| is_window(&parameter)) { "; window" } else { "" };
    let others = kind.parameters.iter().filter(|parameter| !is_window(parameter));
    let details = others.map(described).collect();
    let (name, summary) =
        (format!("{}{mark}", kind.word), format!("{of}: {}{window}", kind.summary));
    Entry { details, ..Entry::plain(&name, &summary) }
}

/// A parameter with what it is, its default and its help.
fn described(parameter: &Parameter) -> String {
    let choice = match parameter.kind {
        ParameterKind::Choice(words) => format!(": {}", words.join(" or ")),
        kind if kind.is_points() => "; or the name of a file, such as \"curve.csv\"".to_owned(),
        _ => String::new(),
    };
    // The help of what follows from the model says how.
    let default = parameter.default.filter(|default| *default != FROM_THE_MODEL);
    let word = if parameter.follows { "left out:" } else { "default" };
    let default = default.map(|default| format!(" ({word} {default})")).unwrap_or_default();
    format!("{}: {}{choice}{default}", parameter.name, parameter.help)
}

/// How the parts of a form are written.
fn parts(parts: &[Part]) -> String {
    let value = |part: &Part| match part.role {
        Role::Spring => "\"20 MN/m\"".to_owned(),
        Role::Dashpot => "\"6 kN s/m\"".to_owned(),
        Role::Form { parts, .. } => self::parts(parts),
    };
    let pairs: Vec<String> =
        parts.iter().map(|part| format!("{} = {}", part.name, value(part))).collect();
    format!("{{ {} }}", pairs.join(", "))
}
