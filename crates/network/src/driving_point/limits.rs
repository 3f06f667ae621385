//! What a circuit does at infinite and at vanishing rates, from its graph.

use dashpot_numerics::DoubleDouble;

use super::{
    circuit::{Circuit, Link},
    links::{Links, dot, pair},
};

/// Leading terms of the receptance at the rate 0: `double/s² + simple/s`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    pub(super) double: DoubleDouble,
    pub(super) simple: DoubleDouble,
}

/// A circuit in which parts that move as one are one body.
struct Merged {
    /// Number of each body's part; `None` for parts that are held.
    part: Vec<Option<usize>>,
    parts: usize,
}

impl Merged {
    fn of(circuit: &Circuit, rigid: &[Link], holds_masses: bool) -> Self {
        let roots = circuit.parts(rigid);
        let mut is_held = vec![false; circuit.bodies + 1];
        is_held[roots[circuit.bodies]] = true;
        for body in 0..circuit.bodies {
            if holds_masses && circuit.masses[body] > 0.0 {
                is_held[roots[body]] = true;
            }
        }
        // The parts that the forces act on come last: of two bodies that are left, the balance is free of cancellation.
        let ends: Vec<usize> = circuit.forces.iter().flatten().map(|&body| roots[body]).collect();
        let mut parts: Vec<usize> =
            roots[..circuit.bodies].iter().copied().filter(|&root| !is_held[root]).collect();
        parts.sort_unstable_by_key(|root| (ends.contains(root), *root));
        parts.dedup();
        let mut number = vec![None; circuit.bodies + 1];
        for (at, &root) in parts.iter().enumerate() {
            number[root] = Some(at);
        }
        let part = roots[..circuit.bodies].iter().map(|&root| number[root]).collect();
        Self { part, parts: parts.len() }
    }

    fn ends(&self, ends: [Option<usize>; 2]) -> [Option<usize>; 2] {
        ends.map(|end| end.and_then(|body| self.part[body]))
    }

    fn links(&self, links: &[Link]) -> Links {
        let mut all = Links::new(self.parts);
        links.iter().for_each(|link| all.add(self.ends(link.ends), link.constant));
        all
    }
}

impl Circuit {
    /// The compliance at infinite rate: dashpots are rigid and masses stay where they are.
    pub(super) fn instantaneous_compliance(&self) -> DoubleDouble {
        let merged = Merged::of(self, &self.dashpots, true);
        let mut forces = pair(merged.parts, merged.ends(self.forces));
        merged.links(&self.springs).factor().solve_lower(&mut forces);
        dot(&forces, &forces)
    }

    /// How many parts follow their springs without delay: massless, and no dashpot leaves them.
    pub(super) fn algebraic_parts(&self) -> usize {
        Merged::of(self, &self.dashpots, true).parts
    }

    /// How many parts no spring holds: each adds a pole at zero.
    pub(super) fn creeping_parts(&self) -> usize {
        Merged::of(self, &self.springs, false).parts
    }

    /// How many parts move freely as rigid bodies: each adds another pole at zero.
    pub(super) fn free_parts(&self) -> usize {
        let all: Vec<Link> = self.springs.iter().chain(&self.dashpots).cloned().collect();
        Merged::of(self, &all, false).parts
    }

    /// What the receptance is at vanishing rates: springs are rigid.
    ///
    /// With `C` of the dashpots between the parts, `M` of their masses and `e` the pair of forces, the free motion `X₂`
    /// is that of the total mass, and `C X₁ = e − M X₂` leaves `X₁` open by a common motion of each free part only. Its
    /// moment `Σ m X₁` is zero, so `e·X₁` is `(e − M X₂)·X₁`, which that motion does not change.
    pub(super) fn origin(&self) -> Origin {
        let zero = DoubleDouble::ZERO;
        let merged = Merged::of(self, &self.springs, false);
        let all: Vec<Link> = self.springs.iter().chain(&self.dashpots).cloned().collect();
        let free = Merged::of(self, &all, false);
        let mut mass = vec![zero; merged.parts];
        let mut total = vec![zero; free.parts];
        let mut whole = vec![None; merged.parts];
        for body in 0..self.bodies {
            if let Some(part) = merged.part[body] {
                mass[part] += self.masses[body];
                whole[part] = free.part[body];
            }
            if let Some(part) = free.part[body] {
                total[part] += self.masses[body];
            }
        }
        let ends = pair(free.parts, free.ends(self.forces));
        let drift: Vec<DoubleDouble> = ends.iter().zip(&total).map(|(e, m)| *e / *m).collect();
        let double = dot(&ends, &drift);

        let mut creep = pair(merged.parts, merged.ends(self.forces));
        for (part, load) in creep.iter_mut().enumerate() {
            if let Some(whole) = whole[part] {
                *load -= mass[part] * drift[whole];
            }
        }
        merged.links(&self.dashpots).factor().solve_lower(&mut creep);
        Origin { double, simple: dot(&creep, &creep) }
    }
}
