//! How the form of a network comes about: its rows are assembled as those of any network, of traced numbers.

use std::{collections::BTreeMap, iter::repeat_n};

use dashpot_dae::UnknownKind;

use super::{
    Curve, ParametricSystem, Weighed,
    first_phases::FirstPhases,
    numbered::Numbered,
    tape::{Pattern, Tape},
    traced::{Recorder, Traced},
};
use crate::{
    NodeId,
    compile::{
        assemble::Graph,
        bodies::Bodies,
        motion::Motion,
        outputs::{composed, softest},
        row::{Combination, Row, RowSum},
        structure::Numbers,
        unknowns::{self, Draft, Inputs, Places},
    },
    elements::Law,
};

impl Numbered {
    /// The rows of a network of these numbers.
    fn rows<'r>(
        &self,
        graph: &Graph<'_>,
        recorder: &'r Recorder,
    ) -> (Places<Traced<'r>>, Motion<Traced<'r>>) {
        let mut inputs = Inputs::default();
        let mut loads = vec![RowSum::default(); graph.bodies.all.len()];
        for (&body, number) in self.of_body.iter().filter(|_| self.fingerprint.has_forces) {
            loads[body].add(recorder.number(number + 2), &inputs.constant(1.0));
        }
        let numbers = Numbers {
            // The whole force of a law stands in its slot.
            slope: &|edge| match edge.primitive {
                own if graph.expansion.primitives[own].is_nonlinear() => Traced::default(),
                own => recorder.number(self.of_primitive[own]),
            },
            mass: &|body, _| recorder.number(self.of_body[&body]),
        };
        graph.equations(numbers, loads, &BTreeMap::new(), &mut inputs)
    }
}

impl ParametricSystem {
    /// The form of a network with its graph; `None` where it is of another kind.
    pub(super) fn assembled(
        first: &FirstPhases<'_>,
        numbered: Numbered,
        graph: &Graph<'_>,
    ) -> Option<Self> {
        let Graph { expansion, scales, .. } = graph;
        let recorder = Recorder::default();
        let (places, motion) = numbered.rows(graph, &recorder);
        let Numbered { fingerprint, of_primitive, of_body, .. } = numbered;
        let one = fingerprint.has_forces.then_some(places.drafts.len());
        if one.is_some() && !(of_body.len() == 1 && first.forces_act_on_masses(&graph.bodies)) {
            return None;
        }
        let struck = Struck::of(first, &graph.bodies)?;

        let is_followed = |draft: &&Draft| draft.kind == UnknownKind::Differential;
        let unknowns = places.drafts.iter().filter(is_followed).count();
        let (followed, laws) = places.drafts.split_at(unknowns);
        let columns = followed.iter().map(|draft| draft.scale / scales.lift);
        let slots = laws.len() + usize::from(one.is_some());
        let columns: Vec<f64> = columns.chain(repeat_n(1.0, slots)).collect();
        let scaled = |factor: f64, row: &Row<Traced<'_>>| {
            Pattern::of(row, &recorder, (factor, &columns), places.drafts.len())
        };
        let pattern = |row: Option<Row<Traced<'_>>>| scaled(1.0, &row?);
        let rate = |at: usize| scaled(scales.time / columns[at], &places.rows.row(at));
        let curve = |draft: &Draft| {
            let Some(unknowns::Law::Force(own)) = draft.law else { return None };
            let rows = [pattern(motion.deformation.get(own))?, pattern(motion.rate.get(own))?];
            Curve::of(&expansion.primitives[own], of_primitive[own], rows)
        };
        let spring = |own: usize| Some((of_primitive[own], pattern(motion.deformation.get(own))?));
        let springs = graph.structure.springs.iter().map(|edge| edge.primitive);
        let springs = springs.filter(|&own| !expansion.primitives[own].is_nonlinear());
        let whole =
            |at: usize| (expansion.primitives[at].law != Law::Rigid).then(|| motion.force.row(at));
        let prefer = softest(&expansion.primitives, &motion);
        let mut forces = composed(&expansion.shapes[struck.element], &whole, &prefer);
        let [a, b] = struck.ends.map(|end| motion.position.row(end));
        let weighed = |(&body, &number): (&usize, &usize)| {
            let base = places.velocity_base[body].map(|base| of_body[&base] + 1);
            let unknown = places.velocity[body]?;
            Some(Weighed { unknown, base, numbers: [number, number + 1, number + 2] })
        };
        let own = Self {
            rates: (0..unknowns).map(rate).collect::<Option<_>>()?,
            curves: laws.iter().map(curve).collect::<Option<_>>()?,
            springs: springs.map(spring).collect::<Option<_>>()?,
            force: pattern(forces.swap_remove(0))?,
            deformation: pattern(Some(a.plus(-1.0, &b)))?,
            speed: pattern(motion.velocity.get(struck.body))?,
            tape: Tape::of(&recorder),
            weighed: of_body.iter().map(weighed).collect::<Option<_>>()?,
            fingerprint,
            one,
            unknowns,
            opens: first.opens(),
            time: scales.time,
            element: struck.element,
            impactor: struck.impactor,
            mass: *of_body.get(&struck.body)?,
            scales: columns,
        };
        own.is_explicit().then_some(own)
    }

    /// Whether forces of laws follow one from the other.
    fn is_explicit(&self) -> bool {
        self.curves.iter().enumerate().all(|(at, curve)| {
            let laws = self.unknowns + at..self.unknowns + self.curves.len();
            let rate = curve.has_rate.then_some(&curve.rate);
            let rows = rate.into_iter().chain([&curve.deformation]);
            rows.flat_map(|row| &row.terms).all(|term| !laws.contains(&term.column))
        })
    }
}

/// What strikes, and the element that it strikes.
struct Struck {
    impactor: NodeId,
    /// The body of the impactor.
    body: usize,
    element: usize,
    /// The bodies between which the element stands.
    ends: [usize; 2],
}

impl Struck {
    /// `None` where there are several, or the element opens otherwise than by letting go what strikes.
    fn of(first: &FirstPhases<'_>, bodies: &Bodies) -> Option<Self> {
        let network = &first.network;
        let impactor = only(network.nodes().filter(|(_, node)| node.is_impactor()))?.0;
        let body = bodies.of_joint[impactor.0];
        let ends_of =
            |element: usize| network.connections[element].between.map(|end| bodies.of_joint[end.0]);
        let touches = |&element: &usize| {
            let ends = ends_of(element);
            ends[0] != ends[1] && ends.contains(&body)
        };
        let element = only((0..network.connections.len()).filter(touches))?;
        let ends = ends_of(element);
        let never_pulls = network.connections[element].never_pulls(0);
        let is_covered = ends[0] == body && !never_pulls && first.opens_at(bodies, body);
        is_covered.then_some(Self { impactor, body, element, ends })
    }
}

/// What is alone in a list.
fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.next().is_none().then_some(first)
}
