//! Models that are the same: certified by their poles and strengths, and the same in an impact.

mod certificates;
mod impacts;
mod materials;
mod random_graphs;
mod random_trees;
mod whole_networks;

use dashpot::{
    network::{
        Model, Network, Node, NodeId,
        driving_point::{Massless, Response},
        model_of,
    },
    rheology::{Canonical, LinearModel, Primitive, Tree},
    scene::{ReadOptions, Scene, read},
};

use Primitive::{Dashpot, Spring};

pub(crate) fn linear(tree: &Tree<Primitive>) -> LinearModel {
    LinearModel::of(tree, |&part| part)
}

/// The spring and dashpot of a form's element.
fn pair(stiffness: f64, damping: f64) -> [Tree<Primitive>; 2] {
    [Spring(stiffness).into(), Dashpot(damping).into()]
}

/// K2 and C2 of the thesis' pad, in a row.
fn maxwell() -> Tree<Primitive> {
    Tree::series(pair(2e7, 6e3))
}

/// K1 and C1 of the thesis' pad, side by side.
fn kelvin() -> Tree<Primitive> {
    Tree::parallel(pair(2e7, 4e3))
}

/// The same with all constants multiplied.
fn scaled(tree: &Tree<Primitive>, factor: f64) -> Tree<Primitive> {
    match tree {
        Tree::Part(Spring(stiffness)) => Spring(stiffness * factor).into(),
        Tree::Part(Dashpot(damping)) => Dashpot(damping * factor).into(),
        Tree::Part(Primitive::Rigid) => Primitive::Rigid.into(),
        Tree::Series(all) => Tree::series(all.iter().map(|own| scaled(&own.tree, factor))),
        Tree::Parallel(all) => Tree::parallel(all.iter().map(|own| scaled(&own.tree, factor))),
    }
}

fn canonical(model: &LinearModel, form: Canonical) -> Tree<Primitive> {
    model.tree(form).unwrap()
}

fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}")).value
}

/// Springs and dashpots one by one between nodes, with a massless node at every joint.
fn lay(network: &mut Network, ends: [NodeId; 2], tree: &Tree<Primitive>, name: &str) {
    match tree {
        Tree::Part(_) => {
            network.connect(name, ends[0], ends[1], model_of(tree));
        }
        Tree::Parallel(branches) => {
            for (at, branch) in branches.iter().enumerate() {
                lay(network, ends, &branch.tree, &format!("{name}-{at}"));
            }
        }
        Tree::Series(branches) => {
            let mut from = ends[0];
            for (at, branch) in branches.iter().enumerate() {
                let name = format!("{name}-{at}");
                let to = if at + 1 == branches.len() {
                    ends[1]
                } else {
                    network.add_node(Node::massless(format!("after-{name}")))
                };
                lay(network, [from, to], &branch.tree, &name);
                from = to;
            }
        }
    }
}

/// A bridge that does what `above` and `below` do in a row: its halves are shares of the whole, so
/// that its midpoints move together, and what is across them bears nothing.
fn lay_bridge(network: &mut Network, ends: [NodeId; 2], halves: [&Tree<Primitive>; 2]) {
    let middles = ["left", "right"].map(|name| network.add_node(Node::massless(name)));
    for ((middle, side), share) in middles.into_iter().zip(["left", "right"]).zip([0.25, 0.75]) {
        let [above, below] = halves.map(|half| scaled(half, share));
        lay(network, [ends[0], middle], &above, &format!("above-{side}"));
        lay(network, [middle, ends[1]], &below, &format!("below-{side}"));
    }
    lay(network, middles, &Dashpot(5e3).into(), "across");
}

/// A network between `top` and the ground.
fn alone(fill: impl FnOnce(&mut Network, [NodeId; 2])) -> Network {
    let mut network = Network::new();
    let top = network.add_node(Node::massless("top"));
    let ends = [top, network.ground()];
    fill(&mut network, ends);
    network
}

fn massless(network: &Network) -> Massless {
    let [top, ground] = [network.node_named("top").unwrap(), network.ground()];
    match network.driving_point(top, ground).unwrap() {
        Response::Massless(found) => found,
        Response::Massive(found) => panic!("{found:?}"),
    }
}

/// The network of a scene with `fill` between the ends of its `padding`.
fn padded_by(scene: &Scene, fill: impl FnOnce(&mut Network, [NodeId; 2])) -> Network {
    let mut network = Network::new();
    let old = &scene.network;
    let mut ids = vec![network.ground(); old.nodes().count()];
    for (id, node) in old.nodes().filter(|(id, _)| *id != old.ground()) {
        ids[id.index()] = network.add_node(node.clone());
    }
    for connection in old.connections() {
        let ends = connection.between.map(|end| ids[end.index()]);
        if connection.name != "padding" {
            network.connect(connection.name.clone(), ends[0], ends[1], connection.model.clone());
        }
    }
    for effect in old.effects() {
        network.add_shared_effect(effect.clone());
    }
    let [a, b] =
        old.connections().iter().find(|connection| connection.name == "padding").unwrap().between;
    fill(&mut network, [ids[a.index()], ids[b.index()]]);
    network
}

/// The network of a scene with another model as its `padding`.
fn padded(scene: &Scene, model: Model) -> Network {
    let mut network = scene.network.clone();
    let at =
        network.connections().iter().position(|connection| connection.name == "padding").unwrap();
    network.set_model(at, model);
    network
}
