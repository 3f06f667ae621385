//! The registers as tables *word → parser*, made once by visitors.

pub(crate) mod parameters;

use std::sync::{Arc, LazyLock};

use dashpot_analysis::measures::{Family, Measure, MeasureKind, MeasureVisitor, visit_measures};
use dashpot_dae::{
    Waveform,
    methods::{MethodKind, MethodVisitor, visit_methods},
};
use dashpot_network::{
    Effect, Element,
    composites::{Composed, CompositeKind, CompositeVisitor, visit_composites},
    effects::{EffectKind, EffectVisitor, visit_effects},
    elements::{ElementKind, ElementVisitor, visit_elements},
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value},
    shifts::{ShiftKind, ShiftVisitor, visit_shifts},
    waveforms::{WaveformKind, WaveformVisitor, visit_waveforms},
};
use dashpot_rheology::{Form, FormVisitor, Part, Role, visit_forms};

use crate::quantities::{basis::Basis, words::example_text};

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

impl<T> Kind<T> {
    /// Whether it is a table of amplitudes over time.
    pub(crate) fn is_table(&self) -> bool {
        matches!(self.parameters, [first, ..] if first.kind == ParameterKind::TimeTable)
    }
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

/// A composite kind.
pub(crate) struct CompositeEntry {
    /// How it is read.
    pub(crate) kind: Kind<Composed>,
    /// Dimension of what stands beside the times in its tables, in a model.
    pub(crate) amplitude: Dimension,
}

/// Makes an effect on an element of its values.
type MakeEffect = fn(&str, &[Value]) -> Result<Arc<dyn Effect>, InvalidParameter>;

/// An effect kind.
pub(crate) struct EffectEntry {
    /// Its word.
    pub(crate) word: &'static str,
    /// One line of help.
    pub(crate) summary: &'static str,
    /// Its parameters.
    pub(crate) parameters: &'static [Parameter],
    /// Whether it acts on one element.
    pub(crate) is_per_element: bool,
    /// Makes the effect on an element, whose name is empty for one that acts on the network.
    pub(crate) make: MakeEffect,
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
    /// Models from a description.
    pub(crate) composites: Vec<CompositeEntry>,
    /// Time-temperature shifts, which become a factor of times.
    pub(crate) shifts: Vec<Kind<f64>>,
    /// Driving functions.
    pub(crate) waveforms: Vec<Kind<Waveform>>,
    /// Effects.
    pub(crate) effects: Vec<EffectEntry>,
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
            composites: Vec::new(),
            shifts: Vec::new(),
            waveforms: Vec::new(),
            effects: Vec::new(),
            measures: Vec::new(),
            methods: Vec::new(),
        };
        visit_elements(&mut registers);
        visit_forms(&mut registers);
        visit_composites(&mut registers);
        visit_shifts(&mut registers);
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

    /// The composite of this word.
    pub(crate) fn composite(&self, word: &str) -> Option<&CompositeEntry> {
        self.composites.iter().find(|entry| entry.kind.word == word)
    }

    /// The effect of this word.
    pub(crate) fn effect(&self, word: &str) -> Option<&EffectEntry> {
        self.effects.iter().find(|entry| entry.word == word)
    }

    /// The words with which a model begins.
    pub(crate) fn model_words(&self) -> Vec<&'static str> {
        let composed = ["series", "parallel", "model", "material"];
        let elements = self.elements.iter().map(|kind| kind.word);
        let forms = self.forms.iter().flat_map(|form| [&[form.word], form.aliases].concat());
        let composites = self.composites.iter().map(|entry| entry.kind.word);
        elements.chain(composed).chain(forms).chain(composites).collect()
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

impl CompositeVisitor for Registers {
    fn visit<C: CompositeKind>(&mut self) {
        let kind = Kind {
            word: C::KIND,
            summary: C::SUMMARY,
            parameters: C::PARAMETERS,
            make: |values| C::from_values(values).and_then(|kind| kind.compose()),
        };
        self.composites.push(CompositeEntry { kind, amplitude: C::AMPLITUDE });
    }
}

impl ShiftVisitor for Registers {
    fn visit<S: ShiftKind>(&mut self) {
        self.shifts.push(Kind {
            word: S::KIND,
            summary: S::SUMMARY,
            parameters: S::PARAMETERS,
            make: |values| S::from_values(values).and_then(|shift| shift.factor()),
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
        self.effects.push(EffectEntry {
            word: E::KIND,
            summary: E::SUMMARY,
            parameters: E::PARAMETERS,
            is_per_element: E::PER_ELEMENT,
            make: |target, values| E::from_values(target, values).map(|own| Arc::new(own) as _),
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

/// How values are written in an example.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Example {
    /// Whether they belong to a model or to a material.
    pub(crate) basis: Basis,
    /// Dimension of amplitudes in a model; `None` where it is not known.
    pub(crate) driven: Option<Dimension>,
}

impl Example {
    /// For kinds that have no amplitudes, or amplitudes of anything.
    pub(crate) const PLAIN: Self = Self { basis: Basis::Model, driven: None };

    /// How a kind with these parameters is written after its word and `=`.
    pub(crate) fn value(self, parameters: &[Parameter]) -> String {
        let required = parameters.iter().filter(|parameter| parameter.default.is_none());
        let required = required.collect::<Vec<_>>();
        match required.as_slice() {
            [] => "{}".to_owned(),
            [only] => self.parameter(only.kind),
            several => {
                let pair = |parameter: &&Parameter| {
                    format!("{} = {}", parameter.name, self.parameter(parameter.kind))
                };
                format!("{{ {} }}", several.iter().map(pair).collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// How one parameter is written.
    pub(crate) fn parameter(self, kind: ParameterKind) -> String {
        match kind {
            ParameterKind::Quantity(dimension) => self.quantity(dimension),
            ParameterKind::TemperatureDifference => "\"50 K\"".to_owned(),
            ParameterKind::Amplitude => self.amplitude(),
            ParameterKind::TimeTable => {
                let value = self.amplitude();
                format!("[[\"1 ms\", {value}], [\"5 ms\", {value}]]")
            }
            ParameterKind::Curve(first, second) => {
                let point = format!("[{}, {}]", self.quantity(first), self.quantity(second));
                format!("[{point}, …]")
            }
            ParameterKind::Choice(words) => format!("\"{}\"", words.first().unwrap_or(&"")),
            ParameterKind::Flag => "true".to_owned(),
            ParameterKind::Window => "\"impact\"".to_owned(),
            ParameterKind::Node => "\"head\"".to_owned(),
            ParameterKind::Model => "{ spring = \"4 kN/m\" }".to_owned(),
        }
    }

    fn amplitude(self) -> String {
        self.driven.map_or_else(|| "\"…\"".to_owned(), |driven| self.quantity(driven))
    }

    fn quantity(self, dimension: Dimension) -> String {
        format!("\"{}\"", example_text(self.basis.dimension(dimension)))
    }

    /// How the parts of a form are written: `{ spring = "20 MN/m", dashpot = "6 kN s/m" }`.
    pub(crate) fn parts(self, parts: &[Part]) -> String {
        let value = |part: &Part| match part.role {
            Role::Spring => self.quantity(Dimension::STIFFNESS),
            Role::Dashpot => self.quantity(Dimension::DAMPING),
            Role::Form { parts, .. } => self.parts(parts),
        };
        let pairs = parts.iter().map(|part| format!("{} = {}", part.name, value(part)));
        format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
    }
}
