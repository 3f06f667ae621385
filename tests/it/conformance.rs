//! Every kind of every register keeps its contract. The registers are the only lists.

use dashpot::{
    analysis::{
        SolveSettings,
        measures::{Family, MeasureKind, MeasureVisitor, PeakStrain, PeakStress, visit_measures},
        solve,
    },
    dae::{
        Run, Silent,
        methods::{MethodKind, MethodVisitor, visit_methods},
        problems,
    },
    network::{
        Model, Network, Node,
        composites::{CompositeKind, CompositeVisitor, visit_composites},
        effects::{EffectKind, EffectVisitor, visit_effects},
        elements::{ElementKind, ElementVisitor, visit_elements},
        parameters::{Dimension, Parameter, ParameterKind, Value},
        shifts::{ShiftKind, ShiftVisitor, shifted, visit_shifts},
        waveforms::{WaveformKind, WaveformVisitor, visit_waveforms},
    },
    rheology::{Branch, Form, FormVisitor, Role, Tree, visit_forms},
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
        assert!(!parameter.help.is_empty(), "{kind}.{} has no help", parameter.name);
    }
}

#[derive(Default)]
struct Elements(usize);

impl ElementVisitor for Elements {
    fn visit<E: ElementKind>(&mut self) {
        self.0 += 1;
        describes(E::KIND, E::SUMMARY, E::PARAMETERS);
        let element = E::sample();
        assert_eq!(element.kind(), E::KIND);
        assert!(element.validate().is_ok());
        let again = E::from_values(&element.values()).unwrap();
        assert_eq!(again.values(), element.values());
        let text = write_kind(E::KIND, E::PARAMETERS, &element.values(), Dimension::FORCE);
        let text = format!(
            "nodes.m = {{ mass = 1, velocity = 1 }}\nnodes.n = {{ mass = 1, velocity = 1 }}\n\
             [elements.e]\nbetween = [\"m\", \"n\"]\n{text}\n[run]\nduration = 1\n"
        );
        let scene = scene(&text);
        let Some(Tree::Part(found)) = scene.network.connections().first().map(|c| &c.model) else {
            panic!("{} does not come back as one part", E::KIND);
        };
        assert_eq!((found.kind(), found.values()), (E::KIND, element.values()));
    }
}

#[test]
fn elements_come_back_from_toml() {
    let mut visitor = Elements::default();
    visit_elements(&mut visitor);
    assert!(visitor.0 >= 3);
}

#[derive(Default)]
struct Waveforms(usize);

impl WaveformVisitor for Waveforms {
    fn visit<W: WaveformKind>(&mut self) {
        self.0 += 1;
        describes(W::KIND, W::SUMMARY, W::PARAMETERS);
        let sample = W::sample();
        let waveform = sample.waveform().unwrap();
        assert_eq!(W::from_values(&sample.values()).unwrap().waveform().unwrap(), waveform);
        for at in 0..40 {
            let (t, step) = (0.013 + 0.037 * f64::from(at), 1e-5);
            if waveform.piece_at(t - step) == waveform.piece_at(t + step) {
                let slope = (waveform.value(t + step) - waveform.value(t - step)) / (2.0 * step);
                let exact = waveform.piece_at(t).derivative(1, t);
                assert!((slope - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{} at {t}", W::KIND);
            }
        }
        for (driven, place) in [
            (Dimension::FORCE, "nodes.m = { mass = 1 }\n[loads.f]\non = \"m\"\nforce = { KIND }\n"),
            (Dimension::LENGTH, "nodes.m = { motion = { KIND } }\n"),
        ] {
            let text = write_kind(W::KIND, W::PARAMETERS, &sample.values(), driven);
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
            assert_eq!(found, waveform, "{}", W::KIND);
        }
    }
}

#[test]
fn driving_functions_have_true_rates_and_come_back_from_toml() {
    let mut visitor = Waveforms::default();
    visit_waveforms(&mut visitor);
    assert!(visitor.0 >= 5);
}

#[derive(Default)]
struct Effects(usize);

impl EffectVisitor for Effects {
    fn visit<E: EffectKind>(&mut self) {
        self.0 += 1;
        describes(E::KIND, E::SUMMARY, E::PARAMETERS);
        let sample = E::sample();
        assert!(sample.validate().is_ok());
        assert_eq!(sample.target().is_some(), E::PER_ELEMENT, "{}", E::KIND);
        let again = E::from_values(sample.target().unwrap_or(""), &sample.values()).unwrap();
        assert_eq!((again.target(), again.values()), (sample.target(), sample.values()));
        let text = format!(
            "nodes.head = {{ mass = 1, velocity = 1 }}\n[elements]\n\
             padding = {{ between = [\"head\", \"ground\"], spring = 1 }}\n\
             [effects]\n{}\n[run]\nduration = 1\n",
            write_effect(&sample)
        );
        let scene = scene(&text);
        let effect = &scene.network.effects()[0];
        assert_eq!((effect.target(), effect.values()), (sample.target(), sample.values()));
    }
}

#[test]
fn effects_come_back_from_toml() {
    let mut visitor = Effects::default();
    visit_effects(&mut visitor);
    assert!(visitor.0 >= 1);
}

#[derive(Default)]
struct Forms(usize);

impl FormVisitor for Forms {
    fn visit<F: Form>(&mut self) {
        self.0 += 1;
        describes(F::KIND, F::SUMMARY, &[]);
        let mut constant = 0.0;
        let tree = dashpot::rheology::forms::build(F::PARTS, F::IN_SERIES, &mut |_, role| {
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
        let keys = written(F::PARTS, &mut constant);
        for word in std::iter::once(&F::KIND).chain(F::ALIASES) {
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
    let mut visitor = Forms::default();
    visit_forms(&mut visitor);
    assert!(visitor.0 >= 4);
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
        open.extend(branches.map(|own| (format!("{path}.{}", own.name), &own.tree)));
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

#[derive(Default)]
struct Composites(usize);

impl CompositeVisitor for Composites {
    fn visit<C: CompositeKind>(&mut self) {
        self.0 += 1;
        describes(C::KIND, C::SUMMARY, C::PARAMETERS);
        let sample = C::sample();
        let again = C::from_values(&sample.values()).unwrap();
        assert_eq!(again.values(), sample.values());
        let composed = sample.compose().unwrap();
        assert_eq!(parts(&again.compose().unwrap().model), parts(&composed.model), "{}", C::KIND);
        assert!(parts(&composed.model).len() > 1, "{} has one part only", C::KIND);
        if let Some(note) = &composed.note {
            assert!(!note.is_empty() && !note.ends_with('.'), "{}: {note}", C::KIND);
        }
        let law = write_kind(C::KIND, C::PARAMETERS, &sample.values(), C::AMPLITUDE);
        assert_eq!(parts(&model_of(&law)), parts(&composed.model), "{law}");
        let written = write_model(&composed.model);
        let law = written.trim_start_matches("{ ").trim_end_matches(" }");
        assert_eq!(parts(&model_of(law)), parts(&composed.model), "{law}");
        for own in C::PARAMETERS {
            // A default in N/m is the same in Pa only where it is zero.
            if let (ParameterKind::Quantity(dimension), Some(default)) = (own.kind, own.default)
                && dimension.length == 0
                && dimension.mass != 0
            {
                let zero = dashpot::scene::units::parse_quantity(default).unwrap().value == 0.0;
                assert!(zero, "{}.{} is {default} by default", C::KIND, own.name);
            }
        }
    }
}

#[test]
fn composites_come_back_from_toml_as_the_models_that_they_describe() {
    let mut visitor = Composites::default();
    visit_composites(&mut visitor);
    assert!(visitor.0 >= 2);
}

#[derive(Default)]
struct Shifts(usize);

impl ShiftVisitor for Shifts {
    fn visit<S: ShiftKind>(&mut self) {
        self.0 += 1;
        describes(S::KIND, S::SUMMARY, S::PARAMETERS);
        let sample = S::sample();
        assert_eq!(S::from_values(&sample.values()).unwrap().values(), sample.values());
        let factor = sample.factor().unwrap();
        assert!(factor > 0.0 && factor.is_finite());
        let shift = write_kind(S::KIND, S::PARAMETERS, &sample.values(), Dimension::NUMBER);
        let law = "burgers = { maxwell = { spring = 2, dashpot = 3 }, \
                   kelvin = { spring = 5, dashpot = 7 } }";
        let found = model_of(&format!("{law}, shift = {{ {shift} }}"));
        assert_eq!(parts(&found), parts(&shifted(&model_of(law), factor).unwrap()), "{shift}");
    }
}

#[test]
fn shifts_come_back_from_toml_and_multiply_the_times() {
    let mut visitor = Shifts::default();
    visit_shifts(&mut visitor);
    assert!(visitor.0 >= 2);
}

struct Measures(dashpot::analysis::RunReport, usize);

impl MeasureVisitor for Measures {
    fn visit<M: MeasureKind>(&mut self) {
        self.1 += 1;
        describes(M::KIND, M::SUMMARY, M::PARAMETERS);
        let sample = M::sample();
        assert_eq!(M::from_values(&sample.values()).unwrap().values(), sample.values());
        let solution = self.0.solution();
        let target = match M::APPLIES_TO {
            Family::Element => 0,
            Family::Node => 1,
        };
        let reading = sample.read(&solution, target);
        // The padding of the thesis has no area; it may have no thickness.
        if [PeakStrain::KIND, PeakStress::KIND].contains(&M::KIND) && reading.value.is_none() {
            assert!(reading.note.is_some_and(|note| note.contains("is not known")));
            return;
        }
        assert!(reading.value.is_some_and(f64::is_finite), "{}: {reading:?}", M::KIND);
        assert!(
            reading.error.is_some_and(|error| error >= 0.0 && error.is_finite()),
            "{}",
            M::KIND
        );
        if let Some((from, to)) = reading.window {
            assert!(0.0 <= from && from <= to && to <= 0.02, "{}", M::KIND);
        }
        if let Value::Window(_) = sample.values().first().cloned().unwrap_or(Value::Flag) {
            assert!(M::PARAMETERS.iter().any(|parameter| parameter.name == "window"));
        }
    }
}

#[test]
fn measures_read_the_reference_impact() {
    let report = solve(
        &reference(1e4),
        &SolveSettings::lasting(0.02).by_name("exact").unwrap(),
        &mut Silent,
    )
    .unwrap();
    let mut visitor = Measures(report, 0);
    visit_measures(&mut visitor);
    assert!(visitor.1 >= 15);
}

#[derive(Default)]
struct Methods(usize);

impl MethodVisitor for Methods {
    fn visit<M: MethodKind>(&mut self) {
        self.0 += 1;
        let method = M::default();
        assert_eq!(method.name(), M::KIND);
        describes(M::KIND, method.summary(), &[]);
        let mut solved = 0;
        for problem in problems::all() {
            let run = Run::to(problem.t_end);
            if method.applies(&problem.system, &run).is_err() {
                assert!(method.integrate(&problem.system, &run, &mut Silent).is_err());
                continue;
            }
            if problem.stiff && M::KIND == "tsit45" {
                continue;
            }
            let end = problem.t_end / problem.system.time_scale;
            let error = |rtol: f64| {
                let trajectory = method
                    .integrate(&problem.system, &run.clone().with_rtol(rtol), &mut Silent)
                    .unwrap();
                let found = trajectory.dense.sample(&problem.system, &[end]);
                let truth = problem.exact(problem.t_end);
                found.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let [coarse, fine] = [1e-4, 1e-8].map(error);
            // Every method converges: four decades of tolerance gain two of error at least, down to
            // the rounding of the problem.
            assert!(
                fine <= (1e-2 * coarse).max(1e-9),
                "{} on {}: {coarse:e}, {fine:e}",
                M::KIND,
                problem.name
            );
            solved += 1;
        }
        assert!(solved >= 5, "{} solves only {solved} problems", M::KIND);
    }
}

#[test]
fn methods_converge_on_every_problem_that_they_claim() {
    let mut visitor = Methods::default();
    visit_methods(&mut visitor);
    assert!(visitor.0 >= 6);
}

#[test]
fn the_builder_and_a_scene_give_the_same_network() {
    let text = include_str!("../../scenes/reference.toml");
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

struct Orders(usize);

impl MethodVisitor for Orders {
    fn visit<M: MethodKind>(&mut self) {
        let Some(order) = M::ORDER else { return };
        self.0 += 1;
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
        network.connect("pad", head, network.ground(), kelvin(1.0, 0.2));
        let (decay, end) = (0.1, 12.0);
        let root = f64::sqrt(1.0 - decay * decay);
        let truth = f64::exp(-decay * end) * f64::sin(root * end) / root;
        let [(coarse, few), (fine, many)] = [1e-9, 1e-11].map(|rtol| {
            let solved = crate::thesis::solve(&network, M::KIND, end, rtol);
            let error = (solved.signal("head.position").value(end) - truth).abs();
            (error, solved.trajectory.statistics.accepted as f64)
        });
        let slope = (coarse / fine).ln() / (many / few).ln();
        let order = f64::from(order);
        // Step control may gain up to an order on the smooth problem, never lose one.
        assert!(
            (order - 0.2..order + 1.2).contains(&slope),
            "{}: {slope:.2}, not {order}",
            M::KIND
        );
    }
}

#[test]
fn methods_have_the_order_that_they_claim() {
    let mut visitor = Orders(0);
    visit_methods(&mut visitor);
    assert!(visitor.0 >= 4);
}
