//! Where parts without start speed stand in balance under the forces of the effects.

use std::collections::BTreeMap;

use super::{
    bodies::{Bodies, Groups, Role, joint_name},
    expand::{Expansion, Primitive},
    mesh::Mesh,
    structure::{Edge, Structure},
};
use crate::{Network, NetworkError};

/// Two bodies between which nothing acts as long as they are apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub(super) ends: [usize; 2],
    /// Distance of the places of the bodies \[m\], first less second, at the start: what it was unloaded.
    pub(super) distance: f64,
}

/// What bodies hang on and meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings<'a> {
    /// Displacement \[m\] of bodies whose motion is prescribed.
    pub(super) given: &'a [f64],
    /// Where bodies may touch.
    pub(super) touches: &'a [Touch],
    /// What the forces on a body may sum up to, in parts of their magnitudes.
    pub(super) unbalanced: f64,
}

/// Displacement of each body \[m\] at the start, counted from unloaded.
///
/// Springs carry `weights` \[N\] (one for each body), linear or not; dashpots carry nothing, and keep
/// the place of what only they hold. What nothing holds goes with what it can touch.
/// Errors: [`NetworkError::NoBalance`] for each part that would sink.
pub(super) fn positions(
    network: &Network,
    expansion: &Expansion,
    bodies: &Bodies,
    structure: &Structure,
    weights: &[f64],
    surroundings: &Surroundings<'_>,
) -> Result<Vec<f64>, Vec<NetworkError>> {
    let &Surroundings { given, touches, unbalanced } = surroundings;
    let count = bodies.all.len();
    let is_given = |body: usize| matches!(bodies.all[body].role, Role::Fixed | Role::Prescribed(_));
    let name = |body: &usize| joint_name(network, expansion, bodies.all[*body].joints[0]);
    let mut groups = Groups::new(count);
    for spring in &structure.springs {
        groups.join(spring.ends[0], spring.ends[1]);
    }
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for body in 0..count {
        members.entry(groups.of(body)).or_default().push(body);
    }
    let mut errors = Vec::new();
    let mut free = Vec::new();
    let mut is_placed = vec![false; count];
    for group in members.values() {
        let is_anchored = group.iter().any(|&body| is_given(body));
        if is_anchored {
            free.extend(group.iter().copied().filter(|&body| !is_given(body)));
            group.iter().for_each(|&body| is_placed[body] = true);
        } else if group.iter().any(|&body| weights[body] != 0.0) {
            let sinking = group.iter().filter(|&&body| weights[body] != 0.0).map(name);
            errors.push(NetworkError::NoBalance { nodes: sinking.collect() });
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let load =
        Load { structure, primitives: &expansion.primitives, free: &free, weights, unbalanced };
    let values = load.carried(given.to_vec());
    let mut values = values.map_err(|sinking| {
        vec![NetworkError::NoBalance { nodes: sinking.iter().map(name).collect() }]
    })?;
    place_by_dashpots(structure, &mut groups, &members, &mut values, &mut is_placed);
    while let Some((body, value)) = next_by_touch(bodies, touches, &values, &is_placed) {
        for &member in &members[&groups.of(body)] {
            values[member] = value;
            is_placed[member] = true;
        }
        place_by_dashpots(structure, &mut groups, &members, &mut values, &mut is_placed);
    }
    Ok(values)
}

/// Springs under weights.
struct Load<'a> {
    structure: &'a Structure,
    primitives: &'a [Primitive],
    /// The bodies that springs hold.
    free: &'a [usize],
    /// Force on each body \[N\].
    weights: &'a [f64],
    /// What the forces on a body may sum up to, in parts of their magnitudes.
    unbalanced: f64,
}

/// Most steps of Newton's iteration.
const SWEEPS: usize = 400;
/// Most times that a step is halved.
const HALVINGS: usize = 200;
/// Slopes are taken to be no smaller than this part of a law's typical slope; a law that begins
/// without a slope would send the first step to infinity.
const FLATTEST: f64 = 1e-9;
/// What the forces on a body may sum up to, in parts of their magnitudes, where rounding ends the iteration.
pub(super) const UNBALANCED: f64 = 1e-9;

impl Load<'_> {
    /// The places of all bodies in balance, from those of the bodies that are given; else the bodies that would sink.
    ///
    /// Linear springs need one elimination. Others need Newton's iteration from the unloaded network: each step solves
    /// the mesh of tangents, and is halved as long as it goes beyond the lowest point along its way.
    fn carried(&self, given: Vec<f64>) -> Result<Vec<f64>, Vec<usize>> {
        let springs = &self.structure.springs;
        let as_it_is = |spring: &Edge| (spring.constant, spring.offset);
        if springs.iter().all(|spring| !self.primitives[spring.primitive].is_nonlinear()) {
            return Ok(self.solved(given, 1.0, as_it_is));
        }
        let mut places = self.solved(given, 0.0, as_it_is);
        for _ in 0..SWEEPS {
            let tangent = |spring: &Edge| {
                let (deformation, element) = self.at(spring, &places);
                let slope = element.tangent(deformation, 0.0).stiffness;
                // What has no slope in numbers is as flat as can be.
                let slope = slope.max(FLATTEST * spring.constant).min(f64::MAX);
                let force = self.force(spring, &places);
                (slope, spring.offset - deformation + force / slope)
            };
            let next = self.solved(places.clone(), 1.0, tangent);
            let way: Vec<f64> = next.iter().zip(&places).map(|(to, from)| to - from).collect();
            let largest = way.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            let size = places.iter().fold(largest, |most, own| most.max(own.abs()));
            if !size.is_finite() || largest <= 2.0 * f64::EPSILON * size {
                break;
            }
            let Some(reached) = self.along(&places, &way) else { break };
            places = reached;
        }
        let sinking = self.sinking(&places);
        if sinking.is_empty() { Ok(places) } else { Err(sinking) }
    }

    /// The places where springs of the slopes and offsets that `line` gives carry `part` of the weights.
    fn solved(&self, values: Vec<f64>, part: f64, line: impl Fn(&Edge) -> (f64, f64)) -> Vec<f64> {
        let mut mesh = Mesh::<f64>::new(values.len());
        for spring in &self.structure.springs {
            let (slope, offset) = line(spring);
            mesh.link(spring.ends[0], spring.ends[1], slope, &offset);
        }
        for (body, weight) in self.weights.iter().enumerate() {
            mesh.load(body, part, weight);
        }
        let mut values = values;
        let solution = mesh.eliminate(self.free, usize::MAX).solve(values.clone());
        for &body in self.free {
            values[body] = *solution.value(body);
        }
        values
    }

    fn at(&self, spring: &Edge, places: &[f64]) -> (f64, &dyn crate::Element) {
        let [p, q] = spring.ends;
        let deformation = places[p] - places[q] + spring.offset;
        (deformation, self.primitives[spring.primitive].element.as_ref())
    }

    fn force(&self, spring: &Edge, places: &[f64]) -> f64 {
        let (deformation, element) = self.at(spring, places);
        element.force(deformation, 0.0)
    }

    /// The places at the end of a step that goes this way, or no further than it should; `None` where
    /// rounding leaves no way down.
    fn along(&self, places: &[f64], way: &[f64]) -> Option<Vec<f64>> {
        let at = |part: f64| -> Vec<f64> {
            places.iter().zip(way).map(|(from, step)| from + part * step).collect()
        };
        // The slope of the potential energy along the way.
        let slope = |places: &[f64]| -> f64 {
            let springs = self.structure.springs.iter().map(|spring| {
                let [p, q] = spring.ends;
                self.force(spring, places) * (way[p] - way[q])
            });
            let weights = self.free.iter().map(|&body| self.weights[body] * way[body]);
            springs.sum::<f64>() - weights.sum::<f64>()
        };
        let first = slope(places);
        if first.is_nan() || first >= 0.0 {
            return None;
        }
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let reached = at(part);
            if slope(&reached) <= -0.5 * first {
                return Some(reached);
            }
            part *= 0.5;
        }
        None
    }

    /// The bodies on which the forces are not in balance.
    fn sinking(&self, places: &[f64]) -> Vec<usize> {
        let mut sums = vec![(0.0, 0.0); places.len()];
        let mut add = |body: usize, force: f64| {
            let (sum, size) = sums[body];
            sums[body] = (sum + force, size + f64::abs(force));
        };
        for spring in &self.structure.springs {
            let force = self.force(spring, places);
            add(spring.ends[0], -force);
            add(spring.ends[1], force);
        }
        self.free.iter().for_each(|&body| add(body, self.weights[body]));
        let most = sums.iter().map(|sum| sum.1).fold(0.0, f64::max);
        let is_unbalanced = |&&body: &&usize| {
            let (sum, size) = sums[body];
            sum.is_nan() || sum.abs() > self.unbalanced * size.max(f64::EPSILON * most)
        };
        self.free.iter().filter(is_unbalanced).copied().collect()
    }
}

/// Puts groups that no spring anchors where their dashpots are undeformed.
fn place_by_dashpots(
    structure: &Structure,
    groups: &mut Groups,
    members: &BTreeMap<usize, Vec<usize>>,
    values: &mut [f64],
    is_placed: &mut [bool],
) {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); values.len()];
    for dashpot in &structure.dashpots {
        neighbours[dashpot.ends[0]].push(dashpot.ends[1]);
        neighbours[dashpot.ends[1]].push(dashpot.ends[0]);
    }
    let mut reached: Vec<usize> = (0..values.len()).filter(|&body| is_placed[body]).collect();
    while let Some(body) = reached.pop() {
        for &next in &neighbours[body] {
            if is_placed[next] {
                continue;
            }
            let group = groups.of(next);
            for &member in &members[&group] {
                values[member] = values[body];
                is_placed[member] = true;
                reached.push(member);
            }
        }
    }
}

/// The next body that touches what is placed, and its place: where it has come to that which it meets
/// first on its way, or else where it leaves what is behind it.
fn next_by_touch(
    bodies: &Bodies,
    touches: &[Touch],
    values: &[f64],
    is_placed: &[bool],
) -> Option<(usize, f64)> {
    let reaches = |touch: &Touch| {
        let [a, b] = touch.ends;
        match [is_placed[a], is_placed[b]] {
            [false, true] => Some((a, true, values[b] + touch.distance)),
            [true, false] => Some((b, false, values[a] - touch.distance)),
            _ => None,
        }
    };
    let body = touches.iter().find_map(reaches)?.0;
    let goes_up = bodies.all[body].velocity < 0.0;
    let places = |is_below: bool| {
        let of_body = touches.iter().filter_map(reaches).filter(move |own| own.0 == body);
        let places = of_body.filter(move |of_body| of_body.1 == is_below).map(|of_body| of_body.2);
        // The nearest of them.
        places.reduce(if is_below { f64::min } else { f64::max })
    };
    places(!goes_up).or_else(|| places(goes_up)).map(|place| (body, place))
}
