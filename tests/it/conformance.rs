//! Every kind of every register keeps its contract. The registers are the only lists.

use dashpot::{
    analysis::{
        Solve, SolveSettings,
        measures::{Family, MEASURES, PeakStrain, PeakStress},
    },
    dae::methods::METHODS,
    network::{
        Model, Network, Node,
        composites::COMPOSITES,
        effects::EFFECTS,
        elements::ELEMENTS,
        parameters::{Dimension, Kind as _, Parameter, ParameterKind, Range, Value},
        shifts::{SHIFTS, shifted},
        waveforms::WAVEFORMS,
    },
    rheology::{Branch, FORMS, Role, Tree},
    scene::{ReadOptions, Scene, read, write_effect, write_kind, write_model},
};

use crate::thesis::{dashpot, impact, kelvin, reference, spring};

fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}")).value
}

fn describes(kind: &str, summary: &str, parameters: &[Parameter]) {
    let is_word =
        |word: &str| word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
    assert!(is_word(kind) && !kind.is_empty(), "`{kind}` is not kebab-case");
    assert!(!summary.is_empty() && summary.len() <= 100, "{kind}: summary of {}", summary.len());
    for parameter in parameters {
        assert!(is_word(parameter.name), "{kind}: `{}`", parameter.name);
        let help = parameter.help;
        assert!(!help.is_empty(), "{kind}.{} has no help", parameter.name);
        let said = words_of(parameter.range).iter().any(|words| help.contains(words));
        assert!(said, "{kind}.{}: `{help}` does not say its range", parameter.name);
    }
}

/// What help may say of a range; an order beside another parameter says more than the range does.
fn words_of(range: Range) -> &'static [&'static str] {
    match range {
        Range::Finite => &[""],
        Range::Angle => &["rad"],
        Range::NotZero => &["not zero"],
        Range::NonNegative => &["zero or positive"],
        Range::Positive => &["positive", "longer than", "later than", "above"],
        Range::AtLeastOne => &["1 or more"],
        Range::Part => &["0 to 1"],
        Range::PositivePart => &["above 0"],
        Range::PartBelowOne => &["below 1"],
        Range::Count => &["2 to"],
        Range::AboveAbsoluteZero => &["above absolute zero", "above T_ref"],
    }
}

#[test]
fn elements_come_back_from_toml() {
    assert!(ELEMENTS.len() >= 3);
    for kind in ELEMENTS {
        describes(kind.word, kind.summary, kind.parameters);
        let element = kind.example().unwrap();
        assert_eq!(element.kind(), kind.word);
        assert!(element.validate().is_ok());
        assert_eq!((kind.again)(&element.values()).unwrap(), element.values());
        let text = write_kind(kind.word, kind.parameters, &element.values(), Dimension::FORCE);
        let text = format!(
            "nodes.m = {{ mass = 1, velocity = 1 }}\nnodes.n = {{ mass = 1, velocity = 1 }}\n\
             [elements.e]\nbetween = [\"m\", \"n\"]\n{text}\n[run]\nduration = 1\n"
        );
        let scene = scene(&text);
        let Some(Tree::Part(found)) = scene.network.connections().first().map(|c| &c.model) else {
            panic!("{} does not come back as one part", kind.word);
        };
        assert_eq!((found.kind(), found.values()), (kind.word, element.values()));
    }
}

#[test]
fn driving_functions_have_true_rates_and_come_back_from_toml() {
    assert!(WAVEFORMS.len() >= 5);
    for kind in WAVEFORMS {
        describes(kind.word, kind.summary, kind.parameters);
        let values = (kind.sample)();
        let waveform = kind.example().unwrap();
        assert_eq!((kind.again)(&values).unwrap(), values);
        for at in 0..40 {
            let (t, step) = (0.013 + 0.037 * f64::from(at), 1e-5);
            if waveform.piece_at(t - step) == waveform.piece_at(t + step) {
                let slope = (waveform.value(t + step) - waveform.value(t - step)) / (2.0 * step);
                let exact = waveform.piece_at(t).derivative(1, t);
                assert!((slope - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{} at {t}", kind.word);
            }
        }
        for (driven, place) in [
            (Dimension::FORCE, "nodes.m = { mass = 1 }\n[loads.f]\non = \"m\"\nforce = { KIND }\n"),
            (Dimension::LENGTH, "nodes.m = { motion = { KIND } }\n"),
        ] {
            let text = write_kind(kind.word, kind.parameters, &values, driven);
            let text = format!(
                "{}\n[elements]\nk = {{ between = [\"m\", \"ground\"], spring = 1 }}\n\
                 [run]\nduration = 1\n",
                place.replace("KIND", &text)
            );
            let scene = scene(&text);
            let found = match scene.network.loads().first() {
                Some(load) => load.force.clone(),
                None => match &scene.network.nodes().nth(1).unwrap().1.support {
                    dashpot::network::Support::Prescribed(motion) => motion.clone(),
                    other => panic!("{other:?}"),
                },
            };
            assert_eq!(found, waveform, "{}", kind.word);
        }
    }
}

#[test]
fn effects_come_back_from_toml() {
    assert!(EFFECTS.len() >= 4);
    for kind in EFFECTS {
        describes(kind.word, kind.summary, kind.parameters);
        let sample = kind.example().unwrap();
        assert!(sample.validate().is_ok());
        assert_eq!(sample.target().is_some(), kind.about.is_per_element, "{}", kind.word);
        assert_eq!((kind.again)(&sample.values()).unwrap(), sample.values());
        let text = format!(
            "nodes.head = {{ mass = 1, velocity = 1 }}\n[elements]\n\
             padding = {{ between = [\"head\", \"ground\"], spring = 1 }}\n\
             [effects]\n{}\n[run]\nduration = 1\n",
            write_effect(sample.as_ref())
        );
        let scene = scene(&text);
        let effect = &scene.network.effects()[0];
        assert_eq!((effect.target(), effect.values()), (sample.target(), sample.values()));
    }
}

fn written(parts: &[dashpot::rheology::Part], constant: &mut f64) -> String {
    let keys = parts.iter().map(|part| {
        if let Role::Form { parts, .. } = part.role {
            format!("{} = {{ {} }}", part.name, written(parts, constant))
        } else {
            *constant += 3.0;
            format!("{} = {constant}", part.name)
        }
    });
    keys.collect::<Vec<_>>().join(", ")
}

#[test]
fn forms_are_what_their_parts_say() {
    assert!(FORMS.len() >= 4);
    for kind in FORMS {
        describes(kind.word, kind.summary, &[]);
        let mut constant = 0.0;
        let tree = dashpot::rheology::forms::build(kind.parts, kind.in_series, &mut |_, role| {
            constant += 3.0;
            Ok::<_, ()>(match role {
                Role::Dashpot => {
                    std::sync::Arc::new(dashpot::network::elements::Dashpot { damping: constant })
                        as std::sync::Arc<dyn dashpot::network::Element>
                }
                _ => {
                    std::sync::Arc::new(dashpot::network::elements::Spring { stiffness: constant })
                }
            })
        })
        .unwrap();
        let build = |model: Model| {
            let mut network = Network::new();
            let head = network.add_node(Node::mass("head", 2.0).moving(1.0));
            network.connect("pad", head, network.ground(), model);
            network
        };
        let mut constant = 0.0;
        let keys = written(kind.parts, &mut constant);
        for word in std::iter::once(&kind.word).chain(kind.aliases) {
            let text = format!(
                "nodes.head = {{ mass = 2, velocity = 1 }}\n[elements]\n\
                 pad = {{ between = [\"head\", \"ground\"], {word} = {{ {keys} }} }}\n[run]\nduration = 1\n"
            );
            let found = scene(&text).network.compile(1.0).unwrap();
            let expected = build(tree.clone()).compile(1.0).unwrap();
            assert_eq!(found.system.jacobian, expected.system.jacobian, "{word}");
            assert_eq!(found.system.initial, expected.system.initial, "{word}");
        }
        let text = format!(
            "nodes.head = {{ mass = 2, velocity = 1 }}\n[models]\npad = {}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], model = \"pad\" }}\n[run]\nduration = 1\n",
            write_model(&tree)
        );
        let found = scene(&text).network.compile(1.0).unwrap();
        assert_eq!(found.system.jacobian, build(tree).compile(1.0).unwrap().system.jacobian);
    }
}

/// The parts of a model in the order of the text: path, kind and values.
fn parts(model: &Model) -> Vec<String> {
    let mut parts = Vec::new();
    let mut open = vec![(String::new(), model)];
    while let Some((path, tree)) = open.pop() {
        if let Tree::Part(element) = tree {
            parts.push(format!("{path} {} {:?}", element.kind(), element.values()));
        }
        let branches = tree.branches().iter().rev();
        open.extend(branches.map(|branch| (format!("{path}.{}", branch.name), &branch.tree)));
    }
    parts
}

/// The model of the element with this law.
fn model_of(law: &str) -> Model {
    let text = format!(
        "nodes.head = {{ mass = 2, velocity = 1 }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], {law} }}\n[run]\nduration = 1\n"
    );
    scene(&text).network.connections()[0].model.clone()
}

#[test]
fn composites_come_back_from_toml_as_the_models_that_they_describe() {
    assert!(COMPOSITES.len() >= 2);
    for kind in COMPOSITES {
        describes(kind.word, kind.summary, kind.parameters);
        let values = (kind.sample)();
        assert_eq!((kind.again)(&values).unwrap(), values);
        let composed = kind.example().unwrap();
        let again = kind.example().unwrap();
        assert_eq!(parts(&again.model), parts(&composed.model), "{}", kind.word);
        assert!(parts(&composed.model).len() > 1, "{} has one part only", kind.word);
        if let Some(note) = composed.note.as_ref().map(ToString::to_string) {
            assert!(!note.is_empty() && !note.ends_with('.'), "{}: {note}", kind.word);
        }
        let law = write_kind(kind.word, kind.parameters, &values, kind.about);
        assert_eq!(parts(&model_of(&law)), parts(&composed.model), "{law}");
        let written = write_model(&composed.model);
        let law = written.trim_start_matches("{ ").trim_end_matches(" }");
        assert_eq!(parts(&model_of(law)), parts(&composed.model), "{law}");
        for parameter in kind.parameters {
            // A default in N/m is the same in Pa only where it is zero.
            if let (ParameterKind::Quantity(dimension), Some(default)) =
                (parameter.kind, parameter.default)
                && dimension.length == 0
                && dimension.mass != 0
            {
                let zero = dashpot::scene::units::parse_quantity(default).unwrap().value == 0.0;
                assert!(zero, "{}.{} is {default} by default", kind.word, parameter.name);
            }
        }
    }
}

#[test]
fn shifts_come_back_from_toml_and_multiply_the_times() {
    assert!(SHIFTS.len() >= 2);
    for kind in SHIFTS {
        describes(kind.word, kind.summary, kind.parameters);
        let values = (kind.sample)();
        assert_eq!((kind.again)(&values).unwrap(), values);
        let factor = kind.example().unwrap();
        assert!(factor > 0.0 && factor.is_finite());
        let shift = write_kind(kind.word, kind.parameters, &values, Dimension::NUMBER);
        let law = "burgers = { maxwell = { spring = 2, dashpot = 3 }, \
                   kelvin = { spring = 5, dashpot = 7 } }";
        let found = model_of(&format!("{law}, shift = {{ {shift} }}"));
        assert_eq!(parts(&found), parts(&shifted(&model_of(law), factor).unwrap()), "{shift}");
    }
}

#[test]
fn measures_read_the_reference_impact() {
    let settings = SolveSettings::lasting(0.02).by_name("exact").unwrap();
    let report = reference(1e4).solve_with(&settings).unwrap();
    assert!(MEASURES.len() >= 15);
    for kind in MEASURES {
        describes(kind.word, kind.summary, kind.parameters);
        let sample = kind.example().unwrap();
        assert_eq!((kind.again)(&sample.values()).unwrap(), sample.values());
        let solution = report.solution();
        let target = match kind.about.family {
            Family::Element => 0,
            Family::Node => 1,
        };
        let reading = sample.read(&solution, target);
        // The padding of the thesis has no area; it may have no thickness.
        if [PeakStrain::KIND, PeakStress::KIND].contains(&kind.word) && reading.value.is_none() {
            assert!(["no-thickness", "no-area"].contains(&reading.notes[0].code()));
            continue;
        }
        assert!(reading.value.is_some_and(f64::is_finite), "{}: {reading:?}", kind.word);
        assert!(
            reading.error.is_some_and(|error| error >= 0.0 && error.is_finite()),
            "{}",
            kind.word
        );
        if let Some((from, to)) = reading.window {
            assert!(0.0 <= from && from <= to && to <= 0.02, "{}", kind.word);
        }
        if let Value::Window(_) = sample.values().first().cloned().unwrap_or(Value::Flag) {
            assert!(kind.parameters.iter().any(|parameter| parameter.name == "window"));
        }
    }
}

#[test]
fn methods_say_what_they_are() {
    assert!(METHODS.len() >= 6);
    for kind in METHODS {
        let method = (kind.make)();
        assert_eq!(method.name(), kind.name);
        describes(kind.name, method.summary(), &[]);
    }
}

#[test]
fn the_builder_and_a_scene_give_the_same_network() {
    let text = include_str!("../../crates/scene/templates/reference.toml");
    let from_text = scene(text);
    let pad = Tree::Series(vec![
        Branch::new("maxwell", Tree::series([spring(2e7), dashpot(6e3)])),
        Branch::new("kelvin", kelvin(2e7, 4e3)),
    ]);
    let built = impact(10.0, 10.0, pad, [100.0, 5e7, 1e4]);
    let (one, other) = (built.compile(0.02).unwrap(), from_text.network.compile(0.02).unwrap());
    assert_eq!(one.system.jacobian, other.system.jacobian);
    assert_eq!(one.system.initial, other.system.initial);
}

#[test]
fn methods_have_the_order_that_they_claim() {
    assert!(METHODS.len() >= 4);
    for kind in METHODS {
        let Some(order) = kind.order else { continue };
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
        network.connect("pad", head, network.ground(), kelvin(1.0, 0.2));
        let (decay, end) = (0.1, 12.0);
        let root = f64::sqrt(1.0 - decay * decay);
        let truth = f64::exp(-decay * end) * f64::sin(root * end) / root;
        let [(coarse, few), (fine, many)] = [1e-9, 1e-11].map(|rtol| {
            let solved = crate::thesis::solve(&network, kind.name, end, rtol);
            let error = (solved.signal("head.position").value(end) - truth).abs();
            (error, solved.trajectory.statistics.accepted as f64)
        });
        let slope = (coarse / fine).ln() / (many / few).ln();
        let order = f64::from(order);
        // Step control may gain up to an order on the smooth problem, never lose one.
        assert!(
            (order - 0.2..order + 1.2).contains(&slope),
            "{}: {slope:.2}, not {order}",
            kind.name
        );
    }
}
