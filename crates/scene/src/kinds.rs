//! The registers as tables *word → parser*, made once by visitors.

use std::sync::{Arc, LazyLock};

use dashpot_analysis::measures::{Family, Measure, MeasureKind, MeasureVisitor, visit_measures};
use dashpot_dae::{
    Waveform,
    methods::{MethodKind, MethodVisitor, visit_methods},
};
use dashpot_network::{
    Effect, Element,
    effects::{EffectKind, EffectVisitor, visit_effects},
    elements::{ElementKind, ElementVisitor, visit_elements},
    parameters::{InvalidParameter, Parameter, ParameterKind, Value},
    waveforms::{WaveformKind, WaveformVisitor, visit_waveforms},
};
use dashpot_rheology::{Form, FormVisitor, Part, Role, visit_forms};

use crate::fault::example_text;

/// What a reader needs to know about a kind that becomes a `T`.
pub(crate) struct Kind<T> {
    /// Its word.
    pub(crate) word: &'static str,
    /// One line of help.
    pub(crate) summary: &'static str,
    /// Its parameters.
    pub(crate) parameters: &'static [Parameter],
    /// Makes the thing.
    pub(crate) make: fn(&[Value]) -> Result<T, InvalidParameter>,
}

/// A named form.
pub(crate) struct FormKind {
    /// Its word.
    pub(crate) word: &'static str,
    /// Other words for it.
    pub(crate) aliases: &'static [&'static str],
    /// One line of help.
    pub(crate) summary: &'static str,
    /// Its parts.
    pub(crate) parts: &'static [Part],
    /// Whether they stand in series.
    pub(crate) in_series: bool,
}

/// A measure kind.
pub(crate) struct MeasureEntry {
    /// How it is read.
    pub(crate) kind: Kind<Arc<dyn Measure>>,
    /// What it is a measure of.
    pub(crate) family: Family,
}

/// All that scenes know by a word of its own.
pub(crate) struct Registers {
    /// Primitive elements.
    pub(crate) elements: Vec<Kind<Arc<dyn Element>>>,
    /// Named forms.
    pub(crate) forms: Vec<FormKind>,
    /// Driving functions.
    pub(crate) waveforms: Vec<Kind<Waveform>>,
    /// Effects.
    pub(crate) effects: Vec<Kind<Arc<dyn Effect>>>,
    /// Measures.
    pub(crate) measures: Vec<MeasureEntry>,
    /// Methods.
    pub(crate) methods: Vec<&'static str>,
}

/// The registers.
pub(crate) fn registers() -> &'static Registers {
    static REGISTERS: LazyLock<Registers> = LazyLock::new(Registers::collect);
    &REGISTERS
}

impl Registers {
    fn collect() -> Self {
        let mut registers = Self {
            elements: Vec::new(),
            forms: Vec::new(),
            waveforms: Vec::new(),
            effects: Vec::new(),
            measures: Vec::new(),
            methods: Vec::new(),
        };
        visit_elements(&mut registers);
        visit_forms(&mut registers);
        visit_waveforms(&mut registers);
        visit_effects(&mut registers);
        visit_measures(&mut registers);
        visit_methods(&mut registers);
        registers
    }

    /// The form of this word or alias.
    pub(crate) fn form(&self, word: &str) -> Option<&FormKind> {
        self.forms.iter().find(|form| form.word == word || form.aliases.contains(&word))
    }

    /// The element of this word.
    pub(crate) fn element(&self, word: &str) -> Option<&Kind<Arc<dyn Element>>> {
        self.elements.iter().find(|kind| kind.word == word)
    }

    /// The words with which a model begins.
    pub(crate) fn model_words(&self) -> Vec<&'static str> {
        let composed = ["series", "parallel", "model"];
        let elements = self.elements.iter().map(|kind| kind.word);
        let forms = self.forms.iter().flat_map(|form| [&[form.word], form.aliases].concat());
        elements.chain(composed).chain(forms).collect()
    }
}

impl ElementVisitor for Registers {
    fn visit<E: ElementKind>(&mut self) {
        self.elements.push(Kind {
            word: E::KIND,
            summary: E::SUMMARY,
            parameters: E::PARAMETERS,
            make: |values| E::from_values(values).map(|element| Arc::new(element) as _),
        });
    }
}

impl FormVisitor for Registers {
    fn visit<F: Form>(&mut self) {
        self.forms.push(FormKind {
            word: F::KIND,
            aliases: F::ALIASES,
            summary: F::SUMMARY,
            parts: F::PARTS,
            in_series: F::IN_SERIES,
        });
    }
}

impl WaveformVisitor for Registers {
    fn visit<W: WaveformKind>(&mut self) {
        self.waveforms.push(Kind {
            word: W::KIND,
            summary: W::SUMMARY,
            parameters: W::PARAMETERS,
            make: |values| W::from_values(values).and_then(|kind| kind.waveform()),
        });
    }
}

impl EffectVisitor for Registers {
    fn visit<E: EffectKind>(&mut self) {
        self.effects.push(Kind {
            word: E::KIND,
            summary: E::SUMMARY,
            parameters: E::PARAMETERS,
            make: |values| E::from_values(values).map(|effect| Arc::new(effect) as _),
        });
    }
}

impl MeasureVisitor for Registers {
    fn visit<M: MeasureKind>(&mut self) {
        let kind = Kind {
            word: M::KIND,
            summary: M::SUMMARY,
            parameters: M::PARAMETERS,
            make: |values| M::from_values(values).map(|measure| Arc::new(measure) as _),
        };
        self.measures.push(MeasureEntry { kind, family: M::APPLIES_TO });
    }
}

impl MethodVisitor for Registers {
    fn visit<M: MethodKind>(&mut self) {
        self.methods.push(M::KIND);
    }
}

/// How a kind with these parameters is written after its word and `=`.
pub(crate) fn example_value(parameters: &[Parameter]) -> String {
    let required = parameters.iter().filter(|parameter| parameter.default.is_none());
    let required = required.collect::<Vec<_>>();
    match required.as_slice() {
        [] => "{}".to_owned(),
        [only] => example_parameter(only.kind),
        several => {
            let pair = |parameter: &&Parameter| {
                format!("{} = {}", parameter.name, example_parameter(parameter.kind))
            };
            format!("{{ {} }}", several.iter().map(pair).collect::<Vec<_>>().join(", "))
        }
    }
}

fn example_parameter(kind: ParameterKind) -> String {
    match kind {
        ParameterKind::Quantity(dimension) => format!("\"{}\"", example_text(dimension)),
        ParameterKind::Amplitude => "\"…\"".to_owned(),
        ParameterKind::TimeTable => "[[\"0 ms\", \"…\"], [\"5 ms\", \"…\"]]".to_owned(),
        ParameterKind::Choice(words) => format!("\"{}\"", words.first().unwrap_or(&"")),
        ParameterKind::Flag => "true".to_owned(),
        ParameterKind::Window => "\"impact\"".to_owned(),
    }
}

/// How the parts of a form are written: `{ spring = "20 MN/m", dashpot = "6 kN s/m" }`.
pub(crate) fn example_parts(parts: &[Part]) -> String {
    let value = |part: &Part| match part.role {
        Role::Spring => "\"20 MN/m\"".to_owned(),
        Role::Dashpot => "\"6 kN s/m\"".to_owned(),
        Role::Form { parts, .. } => example_parts(parts),
    };
    let pairs = parts.iter().map(|part| format!("{} = {}", part.name, value(part)));
    format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
}
