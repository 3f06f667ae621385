//! What a network without effects compiles to, counted on its graph, and what the code of each effect is
//! asked.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering::Relaxed},
};

use dashpot::{
    analysis::{Solve, SolveSettings},
    dae::Waveform,
    network::{
        Detail, Influence, Network, NetworkError, Node, NodeId, Situation,
        effects::{EFFECTS, Effect},
        parameters::{Described, InvalidParameter, Parameter, Value},
    },
};

use crate::{
    random_networks::Dice,
    thesis::{dashpot, kelvin, spring},
};

/// Masses that hang on the ground or on each other without loops, so that every number of the compiled
/// system can be counted.
#[derive(Debug)]
struct Hanging {
    links: Vec<Link>,
}

/// Masses up to which deformations are unknowns, as `docs/decisions/004-unknowns-and-scaling.md` has it
/// of bodies.
const LARGE: usize = 100;

/// What holds a mass.
#[derive(Debug)]
struct Link {
    /// The mass behind it; the ground where there is none.
    behind: Option<usize>,
    has_spring: bool,
    has_dashpot: bool,
}

impl Hanging {
    fn draw(dice: &mut Dice, count: usize) -> Self {
        let links = (0..count).map(|at| {
            let what = dice.below(3);
            let behind = dice.below(at + 1).checked_sub(1);
            Link { behind, has_spring: what != 1, has_dashpot: what != 2 }
        });
        Self { links: links.collect() }
    }

    /// The head on a padding on the first of two masses in a row.
    fn impact() -> Self {
        let link = |behind| Link { behind, has_spring: true, has_dashpot: true };
        Self { links: vec![link(None), link(Some(0)), link(Some(1))] }
    }

    fn build(&self) -> Network {
        let mut network = Network::new();
        let mut masses = Vec::new();
        let last = self.links.len() - 1;
        for (at, link) in self.links.iter().enumerate() {
            let [node, name] = if at == last {
                ["head".to_owned(), "padding".to_owned()]
            } else {
                [format!("m{at}"), format!("link {at}")]
            };
            let node = Node::mass(node, 1.0 + at as f64);
            let mass = network.add_node(if at == last { node.moving(3.0) } else { node });
            let model = match (link.has_spring, link.has_dashpot) {
                (true, true) => kelvin(1e4, 3.0),
                (true, false) => spring(1e4),
                _ => dashpot(3.0),
            };
            let behind = link.behind.map_or(network.ground(), |at| masses[at]);
            network.connect(name, mass, behind, model);
            masses.push(mass);
        }
        network
    }

    /// Entries of the Jacobian. The unknowns beside velocities are deformations of springs, and where no
    /// spring holds a mass, and in large networks, its place.
    fn entries(&self) -> usize {
        let count = self.links.len();
        // The masses that a spring or a dashpot joins to each one, itself among them.
        let joined = |has: fn(&Link) -> bool| {
            let mut own = vec![0; count];
            let mut held = vec![false; count];
            for (at, link) in self.links.iter().enumerate().filter(|(_, link)| has(link)) {
                held[at] = true;
                if let Some(behind) = link.behind {
                    held[behind] = true;
                    own[at] += 1;
                    own[behind] += 1;
                }
            }
            own.iter().sum::<usize>() + held.iter().filter(|own| **own).count()
        };
        let velocities = joined(|own| own.has_dashpot);
        if count > LARGE {
            return count + joined(|own| own.has_spring) + velocities;
        }
        // The rate of a deformation has the velocities at both ends, and the rate of a velocity the
        // deformations of the springs at the mass.
        let ends = |link: &Link| 1 + usize::from(link.behind.is_some());
        let springs: usize = self.links.iter().filter(|link| link.has_spring).map(ends).sum();
        let places = self.links.iter().filter(|link| !link.has_spring).count();
        2 * springs + places + velocities
    }

    /// Holds what a network compiles to against the count.
    fn is_all_of(&self, network: &Network) {
        let assembly = network.compile(1.0).unwrap();
        let system = &assembly.system;
        let count = self.links.len();
        assert_eq!((system.states(), system.algebraic(), system.len()), (2 * count, 0, 2 * count));
        assert_eq!(system.jacobian.nnz(), self.entries(), "{self:?}");
        assert_eq!((system.input_matrix.nnz(), system.waveforms.len()), (0, 0));
        assert!(system.terms.is_empty(), "{:?}", system.terms);
        // Guards belong to what switches, besides those that a scene asks for.
        assert!(assembly.switching.is_none());
        let parts = |link: &Link| usize::from(link.has_spring) + usize::from(link.has_dashpot);
        assert_eq!(assembly.primitives.len(), self.links.iter().map(parts).sum::<usize>());
        assert_eq!((assembly.nodes.len(), assembly.connections.len()), (count + 1, count));
        assert!(assembly.drives.is_empty(), "{:?}", assembly.drives);
    }
}

#[test]
fn masses_that_hang_on_each_other_have_the_unknowns_and_entries_of_their_graph() {
    let mut dice = Dice(29);
    let small = (0..60).map(|_| 1 + dice.below(60)).collect::<Vec<_>>();
    for count in small.into_iter().chain([LARGE + 50, 4 * LARGE]) {
        let hanging = Hanging::draw(&mut dice, count);
        hanging.is_all_of(&hanging.build());
    }
}

/// An effect that counts how often anything is asked of it.
#[derive(Debug)]
struct Watched {
    own: Arc<dyn Effect>,
    calls: Arc<AtomicUsize>,
}

impl Watched {
    fn asked(&self) -> &dyn Effect {
        self.calls.fetch_add(1, Relaxed);
        self.own.as_ref()
    }
}

impl Described for Watched {
    fn kind(&self) -> &'static str {
        self.asked().kind()
    }

    fn parameters(&self) -> &'static [Parameter] {
        self.asked().parameters()
    }

    fn values(&self) -> Vec<Value> {
        self.asked().values()
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        self.asked().validate()
    }
}

impl Effect for Watched {
    fn body_forces(&self, network: &Network) -> Vec<(NodeId, Waveform)> {
        self.asked().body_forces(network)
    }

    fn starts_in_balance(&self) -> bool {
        self.asked().starts_in_balance()
    }

    fn gravity(&self) -> Option<f64> {
        self.asked().gravity()
    }

    fn target(&self) -> Option<&str> {
        self.asked().target()
    }

    fn rewrites(&self) -> bool {
        self.asked().rewrites()
    }

    fn rewrite(&self, network: &mut Network) -> Result<(), NetworkError> {
        self.asked().rewrite(network)
    }

    fn influences(&self, situation: &Situation<'_>) -> Vec<Influence> {
        self.asked().influences(situation)
    }

    fn leave(&self, network: &mut Network) {
        self.asked().leave(network);
    }
}

/// An example of each effect, on the head and its padding.
struct All {
    effects: Vec<(&'static str, Arc<dyn Effect>, Arc<AtomicUsize>)>,
}

impl All {
    fn registered() -> Self {
        let watched = EFFECTS.iter().map(|kind| {
            let calls = Arc::<AtomicUsize>::default();
            let watched = Watched { own: kind.example().unwrap(), calls: Arc::clone(&calls) };
            (kind.word, Arc::new(watched) as Arc<dyn Effect>, calls)
        });
        let all = Self { effects: watched.collect() };
        assert!(all.effects.len() > 3);
        all
    }

    fn counts(&self) -> Vec<usize> {
        self.effects.iter().map(|effect| effect.2.load(Relaxed)).collect()
    }

    fn add_to(&self, network: &mut Network) {
        self.effects.iter().for_each(|effect| network.add_shared_effect(Arc::clone(&effect.1)));
    }
}

#[test]
fn every_effect_that_is_taken_off_leaves_what_the_graph_has() {
    let impact = Hanging::impact();
    for (kind, effect, _) in All::registered().effects {
        let mut network = impact.build();
        network.add_shared_effect(effect);
        let on = network.compile(1.0).unwrap();
        let has_more = on.switching.is_some()
            || on.nodes.len() > impact.links.len() + 1
            || on.connections.len() > impact.links.len()
            || !on.system.waveforms.is_empty();
        assert!(has_more, "{kind} adds nothing, so taking it off proves nothing");
        impact.is_all_of(&network.without(&[Detail::Effect(0)]));
    }
}

#[test]
fn no_code_of_an_effect_that_is_off_is_reached_in_a_whole_run() {
    let all = All::registered();
    let mut network = Hanging::impact().build();
    all.add_to(&mut network);
    let settings = SolveSettings::lasting(0.02);
    for (at, (kind, ..)) in all.effects.iter().enumerate() {
        let off = network.without(&[Detail::Effect(at)]);
        let before = all.counts();
        off.solve_with(&settings).unwrap();
        for (other, (before, after)) in before.into_iter().zip(all.counts()).enumerate() {
            assert_eq!(after == before, other == at, "without {kind}: {}", all.effects[other].0);
        }
    }
    let details: Vec<Detail> = (0..all.effects.len()).map(Detail::Effect).collect();
    let off = network.without(&details);
    let before = all.counts();
    for method in ["exact", "bdf", "esdirk34", "tr-bdf2"] {
        off.solve_with(&settings.clone().by_name(method).unwrap()).unwrap();
    }
    assert_eq!(all.counts(), before);
}
