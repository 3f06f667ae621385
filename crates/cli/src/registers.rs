//! The registers as entries of a list.

use dashpot_analysis::measures::{self, MeasureKind, MeasureVisitor, visit_measures};
use dashpot_analysis::rheometer::{FROM_THE_MODEL, ProtocolKind, ProtocolVisitor, visit_protocols};
use dashpot_dae::methods;
use dashpot_network::{
    composites::{CompositeKind, CompositeVisitor, visit_composites},
    effects::{EffectKind, EffectVisitor, visit_effects},
    elements::{ElementKind, ElementVisitor, visit_elements},
    parameters::{Dimension, Parameter, ParameterKind},
    shifts::{ShiftKind, ShiftVisitor, visit_shifts},
    waveforms::{WaveformKind, WaveformVisitor, visit_waveforms},
};
use dashpot_rheology::{Form, FormVisitor, Part, Role, visit_forms};
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
    let mut collect = Collect(Vec::new());
    match family {
        Family::Elements => visit_elements(&mut collect),
        Family::Forms => visit_forms(&mut collect),
        Family::Composites => visit_composites(&mut collect),
        Family::Shifts => visit_shifts(&mut collect),
        Family::Waveforms => visit_waveforms(&mut collect),
        Family::Effects => visit_effects(&mut collect),
        Family::Measures => visit_measures(&mut collect),
        Family::Methods => collect.0.extend(
            methods::all().iter().map(|method| Entry::plain(method.name(), method.summary())),
        ),
        Family::Tests => visit_protocols(&mut collect),
        Family::Templates | Family::Scenes => {}
    }
    collect.0
}

struct Collect(Vec<Entry>);

impl Collect {
    /// A kind that is written as `example`.
    fn add_kind(&mut self, word: &str, summary: &str, parameters: &[Parameter], example: String) {
        let details = parameters.iter().map(described).collect();
        self.0.push(Entry { example: Some(example), details, ..Entry::plain(word, summary) });
    }
}

impl ElementVisitor for Collect {
    fn visit<E: ElementKind>(&mut self) {
        let sample = E::sample().values();
        let example = write_kind(E::KIND, E::PARAMETERS, &sample, Dimension::FORCE);
        self.add_kind(E::KIND, E::SUMMARY, E::PARAMETERS, example);
    }
}

impl CompositeVisitor for Collect {
    fn visit<C: CompositeKind>(&mut self) {
        let example = write_kind(C::KIND, C::PARAMETERS, &C::sample().values(), C::AMPLITUDE);
        self.add_kind(C::KIND, C::SUMMARY, C::PARAMETERS, example);
    }
}

impl ShiftVisitor for Collect {
    fn visit<S: ShiftKind>(&mut self) {
        let sample = S::sample().values();
        let example = write_kind(S::KIND, S::PARAMETERS, &sample, Dimension::NUMBER);
        self.add_kind(S::KIND, S::SUMMARY, S::PARAMETERS, format!("shift = {{ {example} }}"));
    }
}

impl ProtocolVisitor for Collect {
    fn visit<P: ProtocolKind>(&mut self) {
        let details = P::PARAMETERS.iter().map(described).collect();
        self.0.push(Entry { details, ..Entry::plain(P::KIND, P::SUMMARY) });
    }
}

impl WaveformVisitor for Collect {
    fn visit<W: WaveformKind>(&mut self) {
        let sample = W::sample().values();
        let example = write_kind(W::KIND, W::PARAMETERS, &sample, Dimension::FORCE);
        self.add_kind(W::KIND, W::SUMMARY, W::PARAMETERS, example);
    }
}

impl EffectVisitor for Collect {
    fn visit<E: EffectKind>(&mut self) {
        self.add_kind(E::KIND, E::SUMMARY, E::PARAMETERS, write_effect(&E::sample()));
    }
}

impl FormVisitor for Collect {
    fn visit<F: Form>(&mut self) {
        let example = Some(format!("{} = {}", F::KIND, parts(F::PARTS)));
        let also = format!("also called {}", F::ALIASES.join(", "));
        let details = if F::ALIASES.is_empty() { Vec::new() } else { vec![also] };
        let aliases = F::ALIASES;
        self.0.push(Entry { example, details, aliases, ..Entry::plain(F::KIND, F::SUMMARY) });
    }
}

impl MeasureVisitor for Collect {
    fn visit<M: MeasureKind>(&mut self) {
        let name = if M::BY_DEFAULT { format!("{}*", M::KIND) } else { M::KIND.to_owned() };
        let of = match M::APPLIES_TO {
            measures::Family::Element => "of an element",
            measures::Family::Node => "of a node",
        };
        let is_window = |own: &&Parameter| own.kind == ParameterKind::Window;
        let window = if M::PARAMETERS.iter().any(|own| is_window(&own)) { "; window" } else { "" };
        let summary = format!("{of}: {}{window}", M::SUMMARY);
        let others = M::PARAMETERS.iter().filter(|own| !is_window(own));
        let details = others.map(described).collect();
        self.0.push(Entry { details, ..Entry::plain(&name, &summary) });
    }
}

/// A parameter with what it is, its default and its help.
fn described(parameter: &Parameter) -> String {
    let choice = match parameter.kind {
        ParameterKind::Choice(words) => format!(": {}", words.join(" or ")),
        _ => String::new(),
    };
    // The help of what follows from the model says how.
    let default = parameter.default.filter(|own| *own != FROM_THE_MODEL);
    let word = if parameter.follows { "left out:" } else { "default" };
    let default = default.map(|own| format!(" ({word} {own})")).unwrap_or_default();
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
