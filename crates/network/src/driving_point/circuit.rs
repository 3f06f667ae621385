//! The part of a network that a pair of forces at two nodes sets in motion.

use std::collections::BTreeSet;

use dashpot_numerics::DoubleDouble;

use super::{DrivingPointError, links::Links};
use crate::{
    Network, NetworkError, NetworkErrors, NodeId,
    compile::{
        bodies::{Bodies, Groups, Role},
        expand::Expansion,
        validate,
    },
    elements::Law,
};

/// The two ends of a link or of the pair of forces; `None` is what is held.
pub(super) type Ends = [Option<usize>; 2];

/// A spring or a dashpot between two bodies.
#[derive(Debug, Clone)]
pub(super) struct Link {
    pub(super) ends: Ends,
    pub(super) constant: DoubleDouble,
}

/// Free bodies with springs and dashpots between them; all that is held is one point.
#[derive(Debug, Clone)]
pub(super) struct Circuit {
    /// Mass of each body, 0 for a massless one.
    pub(super) masses: Vec<DoubleDouble>,
    pub(super) springs: Vec<Link>,
    pub(super) dashpots: Vec<Link>,
    /// Where the pair of forces acts.
    pub(super) forces: Ends,
    /// How many bodies there are.
    pub(super) bodies: usize,
}

/// Constants of one scaled circuit lie between this and 1, so that products stay in range.
const SMALLEST: f64 = 1e-90;

impl Circuit {
    /// The circuit between two nodes; `None` where they are rigidly linked or both held.
    pub(super) fn of(
        network: &Network,
        a: NodeId,
        b: NodeId,
    ) -> Result<Option<Self>, DrivingPointError> {
        let expansion = Expansion::of(network);
        let faults = validate::faults(network, &expansion);
        if !faults.is_empty() {
            return Err(NetworkErrors(faults).into());
        }
        let bodies = Bodies::of(network, &expansion).map_err(NetworkErrors)?;
        let body = |node: NodeId| {
            let at = *bodies.of_joint.get(node.index())?;
            let is_held = matches!(bodies.all[at].role, Role::Fixed | Role::Prescribed(_));
            (!is_held).then_some(at)
        };
        let forces = [body(a), body(b)];
        if forces[0] == forces[1] {
            return Ok(None);
        }
        let masses = bodies.all.iter().map(|body| match body.role {
            Role::Mass(mass) => DoubleDouble::from(mass),
            _ => DoubleDouble::ZERO,
        });
        let mut whole = Self {
            bodies: bodies.all.len(),
            masses: masses.collect(),
            springs: Vec::new(),
            dashpots: Vec::new(),
            forces,
        };
        for primitive in &expansion.primitives {
            let ends = primitive.ends.map(|joint| {
                let at = bodies.of_joint[joint];
                let is_held = matches!(bodies.all[at].role, Role::Fixed | Role::Prescribed(_));
                (!is_held).then_some(at)
            });
            let (list, constant) = match primitive.law {
                Law::Spring(stiffness) => (&mut whole.springs, stiffness),
                Law::Dashpot(damping) => (&mut whole.dashpots, damping),
                Law::Rigid => continue,
                Law::Nonlinear { .. } | Law::Phased if ends[0] == ends[1] => continue,
                Law::Nonlinear { .. } | Law::Phased => {
                    return Err(DrivingPointError::NotLinear {
                        element: primitive.name.to_string(),
                        kind: primitive.element.kind(),
                    });
                }
            };
            if constant > 0.0 && ends[0] != ends[1] {
                list.push(Link { ends, constant: DoubleDouble::from(constant) });
            }
        }
        whole.moved(network, [a, b]).map(Some)
    }

    /// The parts that the forces set in motion, one end held where nothing else holds them.
    fn moved(mut self, network: &Network, nodes: [NodeId; 2]) -> Result<Self, DrivingPointError> {
        self.prune();
        let mut groups = Groups::new(self.bodies);
        for link in self.springs.iter().chain(&self.dashpots) {
            if let [Some(p), Some(q)] = link.ends {
                groups.join(p, q);
            }
        }
        let mut firm = vec![false; self.bodies];
        for link in self.springs.iter().chain(&self.dashpots) {
            if let [Some(body), None] | [None, Some(body)] = link.ends {
                firm[groups.of(body)] = true;
            }
        }
        for body in (0..self.bodies).filter(|&body| self.masses[body] > 0.0) {
            firm[groups.of(body)] = true;
        }
        let parts = self.forces.map(|end| end.map(|body| groups.of(body)));
        if let [Some(a), Some(b)] = parts
            && a == b
            && !firm[a]
        {
            self.pin();
        } else {
            for (part, node) in parts.into_iter().zip(nodes) {
                if part.is_some_and(|part| !firm[part]) {
                    let node = network.node(node).name.clone();
                    return Err(DrivingPointError::NothingResists { node });
                }
            }
        }
        let keep: Vec<bool> = (0..self.bodies)
            .map(|body| parts.contains(&Some(groups.of(body))) && self.is_touched(body))
            .collect();
        Ok(self.only(&keep))
    }

    /// Whether anything acts on a body.
    fn is_touched(&self, body: usize) -> bool {
        self.masses[body] > 0.0
            || self.forces.contains(&Some(body))
            || self.springs.iter().chain(&self.dashpots).any(|link| link.ends.contains(&Some(body)))
    }

    /// Holds the second end of the pair of forces: the response depends on differences only.
    fn pin(&mut self) {
        let Some(pinned) = self.forces[1] else { return };
        let hold = |ends: &mut Ends| {
            for end in ends.iter_mut() {
                *end = end.filter(|&body| body != pinned);
            }
        };
        hold(&mut self.forces);
        self.springs.iter_mut().chain(&mut self.dashpots).for_each(|link| hold(&mut link.ends));
    }

    /// Removes massless bodies that hang on one other body only, again and again.
    fn prune(&mut self) {
        let mut neighbours = vec![BTreeSet::new(); self.bodies];
        for link in self.springs.iter().chain(&self.dashpots) {
            for (from, to) in [(0, 1), (1, 0)] {
                if let Some(body) = link.ends[from] {
                    neighbours[body].insert(link.ends[to]);
                }
            }
        }
        let mut gone = vec![false; self.bodies];
        let mut pending: Vec<usize> = (0..self.bodies).collect();
        while let Some(body) = pending.pop() {
            let hangs = !gone[body]
                && neighbours[body].len() <= 1
                && self.masses[body] <= 0.0
                && !self.forces.contains(&Some(body));
            if hangs {
                gone[body] = true;
                for other in std::mem::take(&mut neighbours[body]).into_iter().flatten() {
                    neighbours[other].remove(&Some(body));
                    pending.push(other);
                }
            }
        }
        let stays = |link: &Link| link.ends.iter().flatten().all(|&body| !gone[body]);
        self.springs.retain(stays);
        self.dashpots.retain(stays);
    }

    /// The circuit of some of the bodies, numbered anew.
    fn only(self, keep: &[bool]) -> Self {
        let mut number = vec![None; self.bodies];
        let kept: Vec<usize> = (0..self.bodies).filter(|&body| keep[body]).collect();
        for (new, &old) in kept.iter().enumerate() {
            number[old] = Some(new);
        }
        let stays = |link: &Link| link.ends.iter().flatten().all(|&body| keep[body]);
        let renumber = |links: Vec<Link>| -> Vec<Link> {
            let kept = links.into_iter().filter(stays);
            kept.map(|link| Link {
                ends: link.ends.map(|end| end.and_then(|body| number[body])),
                ..link
            })
            .filter(|link| link.ends[0] != link.ends[1])
            .collect()
        };
        Self {
            masses: kept.iter().map(|&body| self.masses[body]).collect(),
            springs: renumber(self.springs),
            dashpots: renumber(self.dashpots),
            forces: self.forces.map(|end| end.and_then(|body| number[body])),
            bodies: kept.len(),
        }
    }

    pub(super) fn is_massless(&self) -> bool {
        self.masses.iter().all(|mass| *mass <= 0.0)
    }

    /// The links with the masses as links to a fixed point: the stiffness at the rate 1.
    pub(super) fn stiffness_at_one(&self) -> Links {
        let mut links = Links::of(self.bodies, self.springs.iter().chain(&self.dashpots));
        for (body, &mass) in self.masses.iter().enumerate() {
            links.add([Some(body), None], mass);
        }
        links
    }

    /// Sum over links of constant times squared difference at its ends.
    pub(super) fn energy(links: &[Link], shape: &[DoubleDouble]) -> DoubleDouble {
        links.iter().fold(DoubleDouble::ZERO, |sum, link| {
            let stretch = Self::stretch(link.ends, shape);
            sum + link.constant * stretch * stretch
        })
    }

    /// Difference of the displacements of two ends.
    pub(super) fn stretch(ends: Ends, shape: &[DoubleDouble]) -> DoubleDouble {
        let [p, q] = ends.map(|end| end.map_or(DoubleDouble::ZERO, |body| shape[body]));
        p - q
    }

    /// A rate in the middle of those that the constants at single bodies suggest \[1/s\].
    pub(super) fn middle_rate(&self) -> f64 {
        let total = |links: &[Link]| {
            let mut sums = vec![0.0; self.bodies];
            for link in links {
                link.ends.iter().flatten().for_each(|&body| sums[body] += link.constant.high());
            }
            sums
        };
        let (springs, dashpots) = (total(&self.springs), total(&self.dashpots));
        let mut extent: Option<(f64, f64)> = None;
        for body in 0..self.bodies {
            let (k, c, m) =
                (springs[body].ln(), dashpots[body].ln(), self.masses[body].high().ln());
            for rate in [k - c, 0.5 * (k - m), c - m] {
                if rate.is_finite() {
                    let (low, high) = extent.unwrap_or((rate, rate));
                    extent = Some((low.min(rate), high.max(rate)));
                }
            }
        }
        extent.map_or(1.0, |(low, high)| (0.5 * (low + high)).exp())
    }

    /// The same circuit with `2^time` s as unit of time and forces such that the largest constant
    /// is near 1; with it the exponent of the unit of force per length \[N/m\].
    pub(super) fn scaled(&self, time: i32) -> Result<(Self, i32), DrivingPointError> {
        let unit = f64::from(time);
        let size = |value: DoubleDouble, order: f64| value.high().log2() - order * unit;
        let sizes: Vec<f64> = self
            .springs
            .iter()
            .map(|link| size(link.constant, 0.0))
            .chain(self.dashpots.iter().map(|link| size(link.constant, 1.0)))
            .chain(self.masses.iter().filter(|m| **m > 0.0).map(|&mass| size(mass, 2.0)))
            .collect();
        let largest = sizes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let smallest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
        if smallest - largest < SMALLEST.log2() || !largest.is_finite() {
            return Err(NetworkErrors(vec![NetworkError::OutOfScale {
                what: "the ratio of the largest to the smallest constant",
                value: (largest - smallest).exp2(),
                unit: "1",
            }])
            .into());
        }
        #[expect(clippy::cast_possible_truncation, reason = "the exponent of a double")]
        let force = largest.ceil() as i32;
        let mut scaled = self.clone();
        scaled.springs.iter_mut().for_each(|link| shift(&mut link.constant, -force));
        scaled.dashpots.iter_mut().for_each(|link| shift(&mut link.constant, -force - time));
        scaled.masses.iter_mut().for_each(|mass| shift(mass, -force - 2 * time));
        Ok((scaled, force))
    }

    /// The same circuit with its bodies in the opposite order, so that roundings differ.
    pub(super) fn reversed(&self) -> Self {
        let mut reversed = self.clone();
        let turn = |ends: &mut Ends| *ends = ends.map(|end| end.map(|at| self.bodies - 1 - at));
        reversed.masses.reverse();
        turn(&mut reversed.forces);
        let links = reversed.springs.iter_mut().chain(&mut reversed.dashpots);
        links.for_each(|link| turn(&mut link.ends));
        reversed.springs.reverse();
        reversed.dashpots.reverse();
        reversed
    }

    /// The same circuit with every constant changed by a few units of the last place of a double,
    /// up or down as `pattern` says.
    pub(super) fn rounded(&self, pattern: u64) -> Self {
        let mut state = pattern;
        let mut factor = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let size = 1.0 + ((state >> 40) & 7) as f64;
            let sign = if state >> 63 == 0 { 1.0 } else { -1.0 };
            DoubleDouble::from_parts(1.0, sign * size * f64::EPSILON)
        };
        let mut rounded = self.clone();
        let links = rounded.springs.iter_mut().chain(&mut rounded.dashpots);
        let constants = links.map(|link| &mut link.constant).chain(&mut rounded.masses);
        constants.for_each(|constant| *constant *= factor());
        rounded
    }

    /// For each body the number of its part, where the links of one kind count as rigid; the last
    /// entry is what is held.
    pub(super) fn parts(&self, links: &[Link]) -> Vec<usize> {
        let mut groups = Groups::new(self.bodies + 1);
        for link in links {
            let [p, q] = link.ends.map(|end| end.unwrap_or(self.bodies));
            groups.join(p, q);
        }
        (0..=self.bodies).map(|body| groups.of(body)).collect()
    }
}

/// Multiplies by a power of two in steps that stay in the range of doubles.
pub(super) fn shift(value: &mut DoubleDouble, exponent: i32) {
    let mut left = exponent;
    while left != 0 {
        let step = left.clamp(-500, 500);
        *value *= f64::from(step).exp2();
        left -= step;
    }
}

#[cfg(test)]
mod tests {
    use dashpot_rheology::Tree;

    use super::*;
    use crate::{
        Node,
        elements::{ELEMENTS, Spring},
        part,
    };

    /// The response of a mass that hangs on a spring and one more element is asked for.
    #[test]
    fn elements_that_are_not_linear_are_refused_by_name() {
        let mut refused = 0;
        for kind in ELEMENTS {
            let sample = || Tree::Part(kind.example().unwrap());
            let mut network = Network::new();
            let ground = network.ground();
            let [head, held] =
                [Node::mass("head", 1.0), Node::fixed("held")].map(|node| network.add_node(node));
            network.connect("spring", head, ground, part(Spring { stiffness: 1.0 }));
            // Between what is held it does not matter.
            network.connect("aside", held, ground, sample());
            assert!(kind.word == "rigid" || Circuit::of(&network, head, ground).is_ok());
            network.connect("pad", head, ground, sample());
            let found = Circuit::of(&network, head, ground);
            let law = kind.example().unwrap().law();
            if matches!(law, Law::Nonlinear { .. } | Law::Phased) {
                let element = format!("pad.{}", kind.word);
                let expected = DrivingPointError::NotLinear { element, kind: kind.word };
                assert_eq!(found.unwrap_err(), expected);
                refused += 1;
            } else {
                assert!(found.is_ok(), "{}", kind.word);
            }
        }
        assert!(refused >= 10);
    }
}
