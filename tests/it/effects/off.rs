//! Off means off: what is not called for leaves no trace in the equations, and its code is not reached.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering::Relaxed},
};

use dashpot::{
    dae::{Run, Silent, methods},
    network::{
        Network, NetworkError, Node,
        effects::Effect,
        elements::{Element, Law, Tangent},
        parameters::Described,
        part,
    },
};

use crate::random_networks::{Dice, Recipe};

/// Order of a network of springs, dashpots and masses, counted on its graph: 2 for each mass and 1 for
/// each massless node, but for each group of massless nodes that dashpots join with none leaving it.
fn order(recipe: &Recipe) -> usize {
    let count = recipe.nodes.len();
    let is_massless = |at: usize| at < count && recipe.nodes[at].0 == 0.0;
    let mut group: Vec<usize> = (0..count).collect();
    let dashpots = || recipe.elements.iter().filter(|element| !element.2);
    for _ in 0..count {
        for &(a, b, ..) in dashpots() {
            if is_massless(a) && is_massless(b) {
                let least = group[a].min(group[b]);
                (group[a], group[b]) = (least, least);
            }
        }
    }
    let is_left = |own: usize| {
        dashpots().any(|&(a, b, ..)| {
            [(a, b), (b, a)]
                .iter()
                .any(|&(from, to)| is_massless(from) && group[from] == own && !is_massless(to))
        })
    };
    let massive = (0..count).filter(|&at| !is_massless(at)).count();
    let algebraic =
        (0..count).filter(|&at| is_massless(at) && group[at] == at && !is_left(at)).count();
    2 * massive + (count - massive) - algebraic
}

#[test]
fn a_network_without_effects_has_the_order_of_its_graph_and_nothing_that_switches() {
    let mut dice = Dice(11);
    let mut networks = 0;
    while networks < 60 {
        let recipe = Recipe::draw(&mut dice, 4.0);
        let Ok(assembly) = recipe.build().compile(recipe.duration()) else { continue };
        networks += 1;
        let system = &assembly.system;
        assert_eq!(system.states(), order(&recipe), "{recipe:?}");
        assert!(system.terms.is_empty() && assembly.switching.is_none());
    }
}

/// What has been asked of something.
#[derive(Debug, Default)]
struct Calls {
    law: AtomicUsize,
    force: AtomicUsize,
    rewritten: AtomicUsize,
}

/// A linear spring that counts how often its force is evaluated.
#[derive(Debug)]
struct Counted(Arc<Calls>);

impl Described for Counted {
    fn kind(&self) -> &'static str {
        "counted"
    }
}

impl Element for Counted {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.0.force.fetch_add(1, Relaxed);
        2e5 * deformation
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        self.0.force.fetch_add(1, Relaxed);
        Tangent { stiffness: 2e5, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        0.5 * 2e5 * deformation * deformation
    }

    fn law(&self) -> Law {
        self.0.law.fetch_add(1, Relaxed);
        Law::Spring(2e5)
    }
}

/// An effect that does nothing to a network, and counts whether it is asked to.
#[derive(Debug)]
struct Idle(Arc<Calls>);

impl Described for Idle {
    fn kind(&self) -> &'static str {
        "idle"
    }
}

impl Effect for Idle {
    fn rewrite(&self, _network: &mut Network) -> Result<(), NetworkError> {
        self.0.rewritten.fetch_add(1, Relaxed);
        Ok(())
    }
}

#[test]
fn no_code_of_laws_that_are_not_linear_or_of_effects_that_rewrite_is_reached_without_them() {
    for method in ["exact", "bdf", "esdirk34"] {
        let calls = Arc::new(Calls::default());
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
        network.connect("pad", head, network.ground(), part(Counted(Arc::clone(&calls))));
        network.add_effect(Idle(Arc::clone(&calls)));
        let assembly = network.compile(0.01).unwrap();
        assert!(calls.law.load(Relaxed) > 0);
        assert_eq!(calls.rewritten.load(Relaxed), 0);
        let run = Run::to(0.01);
        let before = calls.law.load(Relaxed);
        let method = methods::by_name(method).unwrap();
        method.integrate(&assembly.system, &run, &mut Silent).unwrap();
        // The methods know the matrices only.
        assert_eq!(calls.force.load(Relaxed), 0);
        assert_eq!(calls.law.load(Relaxed), before);
    }
}
