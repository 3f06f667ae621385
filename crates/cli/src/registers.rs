//! The registers as entries of a list.

use dashpot_analysis::{
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
use dashpot_scene::{write_effect, write_kind};

use crate::args::Family;

/// A kind in a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Its word.
    pub(crate) name: String,
    /// One line on what it is.
    pub(crate) summary: String,
    /// How it is written, where that needs an example.
    pub(crate) example: Option<String>,
    /// Its parameters, one line each.
    pub(crate) details: Vec<String>,
    /// Other words for it.
    pub(crate) aliases: &'static [&'static str],
}

impl Entry {
    /// An entry without example and parameters.
    pub(crate) fn plain(name: &str, summary: &str) -> Self {
        let (name, summary) = (name.to_owned(), summary.to_owned());
        Self { name, summary, example: None, details: Vec::new(), aliases: &[] }
    }
}

/// The entries of a register; none for families that are no register.
pub(crate) fn entries(family: Family) -> Vec<Entry> {
    match family {
        Family::Elements => ELEMENTS.iter().map(|own| written(own, Dimension::FORCE)).collect(),
        Family::Forms => FORMS.iter().map(form).collect(),
        Family::Composites => COMPOSITES.iter().map(|own| written(own, own.about)).collect(),
        Family::Shifts => SHIFTS.iter().map(shift).collect(),
        Family::Waveforms => WAVEFORMS.iter().map(|own| written(own, Dimension::FORCE)).collect(),
        Family::Effects => EFFECTS.iter().map(effect).collect(),
        Family::Measures => MEASURES.iter().map(measure).collect(),
        Family::Methods => {
            let all = methods::all();
            all.iter().map(|method| Entry::plain(method.name(), method.summary())).collect()
        }
        Family::Tests => PROTOCOLS.iter().map(of_kind).collect(),
        Family::Templates | Family::Scenes => Vec::new(),
    }
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
