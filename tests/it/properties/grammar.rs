//! Valid scenes, or nearly so, made of whatever the registers hold.

use std::{collections::BTreeMap, convert::Infallible};

use dashpot::{
    analysis::measures::{Family, MEASURES, MeasureEntry},
    network::{
        composites::COMPOSITES,
        effects::{EFFECTS, EffectEntry},
        elements::ELEMENTS,
        parameters::{Dimension, Parameter, ParameterKind, Registered, Value},
        shifts::SHIFTS,
        waveforms::WAVEFORMS,
    },
    rheology::{FORMS, Form, Role, forms::build},
    scene::write_kind,
};
use proptest::{prelude::*, sample::Index};

/// A kind of a register, with the values of its sample.
#[derive(Debug, Clone)]
struct Kind {
    word: &'static str,
    parameters: &'static [Parameter],
    values: Vec<Value>,
    /// Whether it belongs to an element rather than to a node or the whole.
    is_per_element: bool,
    /// The dimension of its amplitudes.
    driven: Dimension,
}

/// What the registers hold.
#[derive(Debug)]
struct Words {
    elements: Vec<Kind>,
    composites: Vec<Kind>,
    shifts: Vec<Kind>,
    waveforms: Vec<Kind>,
    effects: Vec<Kind>,
    measures: Vec<Kind>,
    forms: Vec<String>,
}

fn kind<T, A>(own: &Registered<T, A>) -> Kind {
    let (word, parameters, values) = (own.word, own.parameters, (own.sample)());
    Kind { word, parameters, values, is_per_element: false, driven: Dimension::FORCE }
}

fn form(form: &Form) -> String {
    let mut leaves = Vec::new();
    let mut leaf = |path: &[&'static str], role: Role| {
        let value = if matches!(role, Role::Spring) { "2 kN/m" } else { "3 N s/m" };
        leaves.push(format!("{}.{} = \"{value}\"", form.word, path.join(".")));
        Ok::<_, Infallible>(())
    };
    assert!(build(form.parts, form.in_series, &mut leaf).is_ok());
    leaves.join(", ")
}

impl Words {
    fn all() -> Self {
        let effect = |effect_entry: &EffectEntry| Kind {
            is_per_element: effect_entry.about.is_per_element,
            ..kind(effect_entry)
        };
        let measure = |measure_entry: &MeasureEntry| {
            let is_per_element = matches!(measure_entry.about.family, Family::Element);
            Kind { is_per_element, ..kind(measure_entry) }
        };
        let composite = COMPOSITES.iter().map(|own| Kind { driven: own.about, ..kind(own) });
        Self {
            elements: ELEMENTS.iter().map(kind).collect(),
            composites: composite.collect(),
            shifts: SHIFTS.iter().map(kind).collect(),
            waveforms: WAVEFORMS.iter().map(kind).collect(),
            effects: EFFECTS.iter().map(effect).collect(),
            measures: MEASURES.iter().map(measure).collect(),
            forms: FORMS.iter().map(form).collect(),
        }
    }
}

/// A text that is meant to be a scene.
pub(super) fn scene() -> impl Strategy<Value = String> {
    let words = Words::all();
    let nodes = prop::collection::vec(node(&words), 1..4);
    let models = model(&words, false);
    let elements = (model(&words, true), any::<[Index; 2]>(), beside());
    let elements = prop::collection::vec(elements, 1..4);
    let effects = prop::collection::vec((one_of(&words.effects), any::<Index>()), 0..3);
    let measures = prop::collection::vec((one_of(&words.measures), any::<Index>()), 0..4);
    let loads = prop::collection::vec((one_of(&words.waveforms), any::<Index>()), 0..2);
    let run = (quantity("s", -3.0..1.0), prop::option::of(name()));
    (nodes, models, elements, effects, measures, loads, run).prop_map(
        |(nodes, models, elements, effects, measures, loads, (duration, title))| {
            let mut text = String::new();
            let mut line = |own: String| {
                text.push_str(&own);
                text.push('\n');
            };
            if let Some(title) = title {
                line(format!("title = \"{title}\""));
            }
            line("[values]\nK = \"20 kN/m\"\nunused = 3".to_owned());
            line(format!("[models.m0]\n{}", models.replace(", shift", "\nshift")));
            line(MATERIAL.to_owned());
            line("[nodes]".to_owned());
            for (at, node) in nodes.iter().enumerate() {
                line(format!("n{at} = {{ {node} }}"));
            }
            let node = |index: &Index| match index.index(nodes.len() + 1) {
                at if at < nodes.len() => format!("n{at}"),
                _ => "ground".to_owned(),
            };
            line("[elements]".to_owned());
            for (at, (model, [a, b], beside)) in elements.iter().enumerate() {
                let (a, b) = (node(a), node(b));
                line(format!("e{at} = {{ between = [\"{a}\", \"{b}\"], {model}{beside} }}"));
            }
            line("[effects]".to_owned());
            for ((own, is_per_element, written), target) in &effects {
                line(match is_per_element {
                    true => {
                        let rest = &written[own.len()..];
                        format!("{own}.e{}{rest}", target.index(elements.len()))
                    }
                    false => written.clone(),
                });
            }
            for (at, ((_, _, written), target)) in loads.iter().enumerate() {
                let on = node(target);
                line(format!("[loads.l{at}]\non = \"{on}\"\nforce = {{ {written} }}"));
            }
            let mut wishes: BTreeMap<String, Vec<String>> = BTreeMap::new();
            for ((own, is_per_element, written), target) in &measures {
                let of = match is_per_element {
                    true => format!("e{}", target.index(elements.len())),
                    false => format!("n{}", target.index(nodes.len())),
                };
                let inner = written.strip_prefix(&format!("{own} = {{")).unwrap_or("}");
                let comma = if inner.trim() == "}" { "" } else { "," };
                wishes.entry(of).or_default().push(format!("{{ kind = \"{own}\"{comma}{inner}"));
            }
            line("[measures]".to_owned());
            for (of, wishes) in wishes {
                line(format!("{of} = [{}]", wishes.join(", ")));
            }
            line(format!("[run]\nduration = {duration}"));
            text
        },
    )
}

fn name() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(vec!["a", "ü", "-", " ", "9", "\\n", "🦀"]), 0..6)
        .prop_map(|parts| parts.concat())
}

/// What may stand beside the law of an element.
fn beside() -> impl Strategy<Value = String> {
    let size = prop_oneof![
        3 => Just(String::new()),
        1 => Just(", thickness = \"2 cm\"".to_owned()),
        1 => Just(", thickness = \"2 cm\", area = \"50 cm^2\"".to_owned()),
    ];
    size.boxed()
}

fn node(words: &Words) -> impl Strategy<Value = String> + use<> {
    let motions = words
        .waveforms
        .iter()
        .cloned()
        .map(|waveform| Kind { driven: Dimension::LENGTH, ..waveform });
    let motion = one_of(&motions.collect::<Vec<_>>());
    prop_oneof![
        3 => (quantity("kg", -6.0..6.0), quantity("m/s", -3.0..3.0))
            .prop_map(|(mass, velocity)| format!("mass = {mass}, velocity = {velocity}")),
        2 => quantity("kg", -6.0..6.0).prop_map(|mass| format!("mass = {mass}")),
        1 => quantity("m", -3.0..2.0).prop_map(|drop| format!("mass = 1, drop = {drop}")),
        1 => Just(String::new()),
        1 => Just("fixed = true".to_owned()),
        1 => motion.prop_map(|(_, _, written)| format!("motion = {{ {written} }}")),
    ]
}

fn quantity(unit: &'static str, decades: std::ops::Range<f64>) -> impl Strategy<Value = String> {
    (decades, any::<bool>()).prop_map(move |(exponent, has_unit)| {
        let value = 10f64.powf(exponent);
        if has_unit { format!("\"{value:e} {unit}\"") } else { format!("{value}") }
    })
}

/// What the grammar's scenes may refer to.
const MATERIAL: &str = "[materials.foam]\nzener = { spring = \"1 MPa\", maxwell = { spring = \"3 MPa\", \
                        dashpot = \"9 kPa s\" } }";

/// The law of an element or a model, as `word = value`; it may refer to others.
fn model(words: &Words, refers: bool) -> BoxedStrategy<String> {
    let only = |(_, _, written): (&'static str, bool, String)| written;
    let leaf = prop_oneof![
        4 => one_of(&words.elements).prop_map(only),
        1 => one_of(&words.composites).prop_map(only),
        2 => prop::sample::select(words.forms.clone()),
        1 => Just("spring = \"K\"".to_owned()),
        1 => Just(if refers { "model = \"m0\"" } else { "spring = 1" }.to_owned()),
        1 => Just("material = \"foam\", thickness = \"1 cm\", area = \"20 cm^2\"".to_owned()),
    ];
    let shift = prop::option::weighted(0.1, one_of(&words.shifts));
    let shifted = move |inner: BoxedStrategy<String>| {
        (inner, shift.clone()).prop_map(|(law, shift)| match shift {
            Some((_, _, shift)) => format!("{law}, shift = {{ {shift} }}"),
            None => law,
        })
    };
    let tree = leaf.prop_recursive(4, 16, 3, |inner| {
        (any::<bool>(), prop::collection::vec(inner, 1..4)).prop_map(|(is_series, branches)| {
            let word = if is_series { "series" } else { "parallel" };
            format!("{word} = [{{ {} }}]", branches.join(" }, { "))
        })
    });
    shifted(tree.boxed()).boxed()
}

/// A kind with values some decades around those of its sample: word, whether it belongs to an
/// element, and as it is written.
fn one_of(kinds: &[Kind]) -> impl Strategy<Value = (&'static str, bool, String)> + Clone + use<> {
    let factors = prop::collection::vec(prop_oneof![12 => Just(0.0), 1 => -6.0..6.0], 8);
    (prop::sample::select(kinds.to_vec()), factors).prop_map(move |(kind, exponents)| {
        let mut values = kind.values.clone();
        for ((value, parameter), exponent) in values.iter_mut().zip(kind.parameters).zip(exponents)
        {
            if let (Value::Number(number), ParameterKind::Quantity(_) | ParameterKind::Amplitude) =
                (value, parameter.kind)
            {
                *number *= 10f64.powf(exponent);
            }
        }
        let written = write_kind(kind.word, kind.parameters, &values, kind.driven);
        // Samples speak of a node of this name.
        (kind.word, kind.is_per_element, written.replace("\"head\"", "\"n0\""))
    })
}
