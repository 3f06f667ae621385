use std::sync::Arc;

use dashpot_rheology::Tree;

use super::{Effect, EffectKind, Face, Gravity, GravityStart, Separation, Stop, Touch};
use crate::{
    Network, NetworkError, Node, Start,
    elements::{Dashpot, HuntCrossley, HystereticFoam, Rigid, Spring},
    parameters::{Described as _, Kind as _, Value},
    part,
    rewrite::rewrite,
};

/// A head on a pad on a sprung panel.
fn impact() -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let pad = Tree::series([part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 6e3 })]);
    network.connect("padding", head, panel, pad).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), part(Spring { stiffness: 5e7 }));
    network
}

fn separation() -> Separation {
    Separation { element: "padding".to_owned(), at: None, restitution: 0.0 }
}

fn face(mass: f64) -> Face {
    Face { element: "padding".to_owned(), mass, at: None, touch: Touch::Impact }
}

fn stop(at: Option<f64>) -> Stop {
    let element = "padding".to_owned();
    Stop { element, at, restitution: 0.0, stiffness: None, damping: 0.0 }
}

/// One line for each connection: name, ends, and its elements with their values.
fn outline(network: &Network) -> Vec<String> {
    let elements = |own: &crate::Model| {
        let (mut open, mut found) = (vec![own], Vec::new());
        while let Some(tree) = open.pop() {
            if let Tree::Part(element) = tree {
                let values = element.values();
                let values = values.iter().filter_map(Value::number).map(|own| own.to_string());
                let values = values.collect::<Vec<_>>().join(" ");
                found.push(format!("{} {values}", element.kind()).trim().to_owned());
            }
            open.extend(tree.branches().iter().rev().map(|branch| &branch.tree));
        }
        found.join(", ")
    };
    let line = |own: &crate::Connection| {
        let [from, to] = own.between.map(|id| &network.node(id).name);
        format!("{}: {from} → {to}: {}", own.name, elements(&own.model))
    };
    network.connections().iter().map(line).collect()
}

fn rewritten(effects: Vec<Arc<dyn Effect>>) -> Result<Network, NetworkError> {
    let mut network = impact();
    for effect in effects {
        network.add_shared_effect(effect);
    }
    rewrite(&mut network).map(|()| network)
}

fn refusal(effect: impl Effect + 'static) -> String {
    rewritten(vec![Arc::new(effect)]).unwrap_err().to_string()
}

const PAD: &str = "spring 20000000, dashpot 6000";
const MOUNT: &str = "mount: panel → ground: spring 50000000";

#[test]
fn separation_puts_a_massless_face_and_a_contact_at_the_impactors_side() {
    let network = rewritten(vec![Arc::new(separation())]).unwrap();
    let expected = [
        &format!("padding: padding.face → panel: {PAD}"),
        MOUNT,
        "padding.contact: head → padding.face: contact 0 0",
    ];
    assert_eq!(outline(&network), expected);
    let face = network.node(network.node_named("padding.face").unwrap());
    assert_eq!(*face, Node::massless("padding.face"));
    assert_eq!(network.connections()[0].thickness, Some(0.02));
}

#[test]
fn an_element_that_opens_at_the_support_keeps_compression_positive() {
    let at = Some("panel".to_owned());
    let network = rewritten(vec![Arc::new(Separation { at, restitution: 0.5, ..separation() })]);
    let network = network.unwrap();
    assert_eq!(outline(&network)[0], format!("padding: head → padding.face: {PAD}"));
    assert_eq!(outline(&network)[2], "padding.contact: padding.face → panel: contact 0 0.5");
}

#[test]
fn what_never_pulls_is_its_own_contact() {
    let foam = || part(HystereticFoam::sample());
    let contact = || part(HuntCrossley::sample());
    let damped = || Tree::parallel([foam(), part(Dashpot { damping: 1.0 })]);
    let count = |model: &crate::Model, effects: Vec<Arc<dyn Effect>>| {
        let mut network = impact();
        network.connections[0].model = model.clone();
        for effect in effects {
            network.add_shared_effect(effect);
        }
        rewrite(&mut network).unwrap();
        network.connections().len()
    };
    let cases = [
        (foam(), 2),
        (contact(), 2),
        (Tree::series([damped(), foam()]), 2),
        (Tree::series([part(Spring { stiffness: 1.0 }), contact()]), 2),
        (Tree::parallel([foam(), contact()]), 2),
        // A dashpot beside it pulls.
        (damped(), 3),
        (Tree::series([damped(), damped()]), 3),
    ];
    for (model, expected) in cases {
        assert_eq!(count(&model, vec![Arc::new(separation())]), expected, "{model:?}");
        // What has a face with mass can part from it.
        let both: Vec<Arc<dyn Effect>> = vec![Arc::new(separation()), Arc::new(face(0.2))];
        assert_eq!(count(&model, both), 3, "{model:?}");
        let none: Vec<Arc<dyn Effect>> = vec![Arc::new(separation()), Arc::new(face(0.0))];
        assert_eq!(count(&model, none), expected, "{model:?}");
    }
}

#[test]
fn a_face_with_mass_that_cannot_separate_moves_with_its_node() {
    let network = rewritten(vec![Arc::new(face(0.2))]).unwrap();
    assert_eq!(outline(&network)[0], format!("padding: padding.face → panel: {PAD}"));
    assert_eq!(outline(&network)[2], "padding.contact: head → padding.face: rigid");
    let node = network.node(network.node_named("padding.face").unwrap());
    assert_eq!(*node, Node::mass("padding.face", 0.2).moving(10.0));
    let mut network = impact();
    network.add_effect(face(0.2));
    let assembly = network.compile(0.02).unwrap();
    assert!(assembly.output("padding.contact.force").is_some());
    assert_eq!(assembly.system.states(), impact().compile(0.02).unwrap().system.states());
}

#[test]
fn a_face_that_separates_is_struck_at_rest_or_moves() {
    for (touch, start) in [(Touch::Impact, Start::Rest), (Touch::Moving, Start::Velocity(10.0))] {
        // The face stands before the separation, which makes no difference.
        let face = Face { touch, ..face(0.2) };
        let network = rewritten(vec![Arc::new(face), Arc::new(separation())]).unwrap();
        assert_eq!(outline(&network)[2], "padding.contact: head → padding.face: contact 0 0");
        let face = network.node(network.node_named("padding.face").unwrap());
        assert_eq!(*face, Node { start, ..Node::mass("padding.face", 0.2) });
        assert_eq!(network.connections().len(), 3);
    }
}

#[test]
fn a_face_without_mass_is_no_face() {
    let network = rewritten(vec![Arc::new(face(0.0))]).unwrap();
    assert_eq!(outline(&network), outline(&impact()));
    let network = rewritten(vec![Arc::new(face(0.0)), Arc::new(separation())]).unwrap();
    assert_eq!(outline(&network), outline(&rewritten(vec![Arc::new(separation())]).unwrap()));
}

#[test]
fn a_stop_is_beside_the_element_at_its_thickness() {
    let network = rewritten(vec![Arc::new(stop(None))]).unwrap();
    assert_eq!(outline(&network)[2], "padding.stop: head → panel: contact 0.02 0");
    let network = rewritten(vec![Arc::new(stop(Some(0.015))), Arc::new(separation())]).unwrap();
    assert_eq!(outline(&network)[3], "padding.stop: padding.face → panel: contact 0.015 0");
}

#[test]
fn a_stop_with_stiffness_is_a_contact_in_series_with_spring_and_dashpot() {
    let last = |stiffness: f64, damping: f64| {
        let stiffness = Some(stiffness);
        let stop = Stop { stiffness, damping, ..stop(None) };
        outline(&rewritten(vec![Arc::new(stop)]).unwrap()).split_off(2)
    };
    let from = "padding.stop: head → panel: contact 0.02 0";
    assert_eq!(last(1e8, 500.0), [format!("{from}, spring 100000000, dashpot 500")]);
    assert_eq!(last(1e8, 0.0), [format!("{from}, spring 100000000")]);
    assert_eq!(last(0.0, 0.0), [""; 0]);
}

#[test]
fn what_has_no_place_is_refused_by_name() {
    let element = "pading".to_owned();
    assert_eq!(
        refusal(Separation { element, ..separation() }),
        "`separation.pading` acts on no element: there is none named `pading`"
    );
    let at = Some("ground".to_owned());
    assert_eq!(
        refusal(Separation { at, ..separation() }),
        "`separation.padding` is at `ground`, but `padding` is between `head` and `panel`"
    );
    let element = "mount".to_owned();
    assert_eq!(
        refusal(Stop { element, ..stop(None) }),
        "`stop.mount` has no `at`, and `mount` has no thickness from which it follows"
    );
    let face = Face { at: Some("panel".to_owned()), ..face(0.2) };
    let error = rewritten(vec![Arc::new(face), Arc::new(separation())]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "`face.padding` is at `panel`, but `separation.padding` opens at `head`: they are to be at \
         one node"
    );
}

#[test]
fn values_that_contradict_each_other_are_out_of_range() {
    let soft = Stop { stiffness: Some(1e8), ..stop(None) };
    assert!(soft.validate().is_ok());
    assert_eq!(Stop { restitution: 0.5, ..soft }.validate().unwrap_err().parameter, "restitution");
    let damped = Stop { damping: 1.0, ..stop(None) };
    assert_eq!(damped.validate().unwrap_err().parameter, "damping");
    assert_eq!(stop(Some(f64::NAN)).validate().unwrap_err().parameter, "at");
    let separation = Separation { restitution: 1.1, ..separation() };
    assert_eq!(separation.validate().unwrap_err().parameter, "restitution");
    assert_eq!(face(-1.0).validate().unwrap_err().parameter, "mass");
}

#[test]
fn values_left_out_come_back() {
    fn same<E: EffectKind>(effect: &E) {
        let again = E::from_values(&effect.values()).unwrap().on(effect.target().unwrap()).unwrap();
        assert_eq!(format!("{again:?}"), format!("{effect:?}"));
    }
    same(&separation());
    same(&face(0.2));
    same(&stop(None));
    same(&Stop::sample());
}

#[test]
fn a_rigid_support_has_no_unknowns() {
    let on = |rigid: bool| {
        let mut network = impact();
        if rigid {
            network.set_model(1, part(Rigid));
        }
        network.compile(0.02).unwrap().system.unknowns.len()
    };
    let mut alone = Network::new();
    let head = alone.add_node(Node::mass("head", 10.0).moving(10.0));
    alone.connect("padding", head, alone.ground(), impact().connections()[0].model.clone());
    assert_eq!(on(true), alone.compile(0.02).unwrap().system.unknowns.len());
    assert_eq!(on(false), on(true) + 2);
}

/// Place and speed of the head at the start, dropped from 1.5 m.
fn dropped(effects: Vec<Arc<dyn Effect>>) -> [f64; 2] {
    let mut network = impact();
    network.nodes[1].start = Start::Drop(1.5);
    for effect in effects {
        network.add_shared_effect(effect);
    }
    let assembly = network.compile(0.01).unwrap();
    let phased = assembly.switching.clone().unwrap();
    let interval = dashpot_dae::Switching::first(phased.as_ref(), 1e-12).unwrap();
    ["head.position", "head.velocity"].map(|name| {
        let output = interval.system.outputs.at(assembly.output(name).unwrap());
        let mut inputs = vec![0.0; interval.system.inputs.len()];
        interval.system.inputs_at(0.0, 0.0, &mut inputs);
        output.scale * (output.unknowns.at(&interval.system.initial) + output.inputs.at(&inputs))
    })
}

#[test]
fn a_drop_is_a_flight_where_gravity_and_separation_are_on() {
    let gravity = |acceleration| -> Arc<dyn Effect> {
        Arc::new(Gravity { acceleration, start: GravityStart::Unloaded })
    };
    let speed = |gravity: f64| (2.0 * gravity * 1.5).sqrt();
    let case = |effects: Vec<Arc<dyn Effect>>, expected: [f64; 2]| {
        let found = dropped(effects);
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
    };
    case(vec![gravity(9.81), Arc::new(separation())], [-1.5, 0.0]);
    case(vec![Arc::new(separation()), Arc::new(face(0.2)), gravity(9.81)], [-1.5, 0.0]);
    case(vec![Arc::new(separation())], [0.0, speed(9.806_65)]);
    case(vec![Arc::new(separation()), gravity(-9.81)], [0.0, speed(9.81)]);
}

#[test]
fn a_face_stays_where_it_is_without_its_separation() {
    let mut network = impact();
    let at = Some("panel".to_owned());
    network.add_effect(face(0.2));
    network.add_effect(Separation { at, ..separation() });
    let place = |network: &Network| {
        let mut made = network.clone();
        rewrite(&mut made).unwrap();
        outline(&made).split_off(2)
    };
    let [with, without] = [place(&network), place(&network.without(&[crate::Detail::Effect(1)]))];
    assert_eq!(with, ["padding.contact: padding.face → panel: contact 0 0"]);
    let [link] = without.as_slice() else { panic!("{without:?}") };
    assert!(link.starts_with("padding.contact: padding.face → panel: rigid"), "{link}");
}
