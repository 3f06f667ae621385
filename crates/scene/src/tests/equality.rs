//! The builder and the text give the same network.

use dashpot_network::{
    Network, Node,
    effects::{Gravity, GravityStart},
    elements::{Dashpot, Rigid, Spring},
    part,
    waveforms::{HalfSine, Sine, WaveformKind},
};
use dashpot_rheology::{Branch, Tree};

use super::{contents, scene};

const TEXT: &str = r#"
[values]
K = "20 MN/m"

[models.pad]
burgers = { maxwell = { spring = "K", dashpot = "6 kN s/m" }, kelvin = { spring = "K", dashpot = "4 kN s/m" } }

[nodes]
head  = { mass = "10 kg", drop = "1.5 m" }
panel = { mass = "100 kg" }
floor = { motion = { sine = { amplitude = "2 mm", frequency = "50 Hz" } } }
wall  = { fixed = true }
face  = {}

[elements]
skin    = { between = ["head", "face"], rigid = true }
padding = { between = ["face", "panel"], model = "pad", thickness = "2 cm" }
mount   = { between = ["panel", "floor"], parallel = [{ spring = 5e7 }, { dashpot = "10 kN s/m" }, { spring = "1 N/m" }] }
tie     = { between = ["panel", "wall"], spring = "1 kN/m" }

[effects]
gravity = { start = "unloaded" }

[loads.push]
on = "panel"
force = { half-sine = { peak = "2 kN", duration = "10 ms" } }

[run]
duration = "20 ms"
"#;

#[test]
fn builder_and_text_give_the_same_network() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).dropped(1.5));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let shake = Sine { amplitude: 2e-3, frequency: 50.0, phase: 0.0 };
    let floor = network.add_node(Node::prescribed("floor", shake.waveform().unwrap()));
    let wall = network.add_node(Node::fixed("wall"));
    let face = network.add_node(Node::massless("face"));

    let spring = |stiffness| Branch::new("spring", part(Spring { stiffness }));
    let dashpot = |damping| Branch::new("dashpot", part(Dashpot { damping }));
    network.connect("skin", head, face, part(Rigid));
    let pad = Tree::Series(vec![
        Branch::new("maxwell", Tree::Series(vec![spring(2e7), dashpot(6e3)])),
        Branch::new("kelvin", Tree::Parallel(vec![spring(2e7), dashpot(4e3)])),
    ]);
    network.connect("padding", face, panel, pad).thickness = Some(0.02);
    let second = Branch::new("spring-2", part(Spring { stiffness: 1.0 }));
    let mount = Tree::Parallel(vec![spring(5e7), dashpot(1e4), second]);
    network.connect("mount", panel, floor, mount);
    network.connect("tie", panel, wall, part(Spring { stiffness: 1e3 }));
    network.add_effect(Gravity { acceleration: 9.806_65, start: GravityStart::Unloaded });
    let push = HalfSine { peak: 2e3, duration: 0.01, start: 0.0 };
    network.add_load("push", panel, push.waveform().unwrap());

    let read = scene(TEXT);
    assert_eq!(contents(&read.network), contents(&network));
}

#[test]
fn a_tree_and_its_form_have_the_same_parts() {
    let tree = super::model(
        "series = [{ series = [{ spring = 1 }, { dashpot = 2 }], name = \"maxwell\" }, \
         { parallel = [{ spring = 3 }, { dashpot = 4 }], name = \"kelvin\" }]",
    );
    let form = super::model(
        "burgers = { maxwell = { spring = 1, dashpot = 2 }, kelvin = { spring = 3, dashpot = 4 } }",
    );
    assert_eq!(super::shape(&tree), super::shape(&form));
}
