//! From which other mass the velocity of each mass is counted.
//!
//! A mass that several dashpots hold has the sum of their constants in its row. Rounding of that sum
//! acts like a dashpot to the ground: beside one of 10¹⁰ N s/m it has 10⁻⁶ N s/m and slows down
//! what the two masses do together. With the velocity of one counted from the other each constant stands for
//! itself, and their common velocity has no part in the forces between them.

use super::{
    bodies::{Bodies, Groups, Role},
    mesh::Mesh,
    structure::Structure,
    tree::MOST_RELATIVE,
};

/// Up to so many times the momentum of a mass, dashpots may take up within the run at its velocity and
/// their rounding does no harm: six bits.
const HARMLESS: f64 = 64.0;
/// Beyond so many times, what rounding leaves of the velocity between two masses makes a force between them
/// that is worth mentioning, though no other dashpot holds them: twenty bits.
const STRONG: f64 = 1_048_576.0;

/// For each mass the one that its velocity is counted from, if any.
///
/// Masses that dashpots join, the strongest first, become one group; the lighter group's velocity is
/// counted from the heavier one, so that what moves a group as a whole is no small difference of
/// large terms. What is fixed or moved from outside is the heaviest, and nothing is counted from it. Where
/// no mass is held by more than one dashpot, or they are weak for a run of `duration` \[s\], all
/// velocities stand for themselves; those of two masses that a single one makes as good as one do not.
pub(super) fn parents(bodies: &Bodies, structure: &Structure, duration: f64) -> Vec<Option<usize>> {
    let count = bodies.all.len();
    let mut parents = vec![None; count];
    if count > MOST_RELATIVE {
        return parents;
    }
    let mut mesh = Mesh::<f64>::new(count);
    for dashpot in &structure.dashpots {
        let [a, b] = dashpot.ends;
        mesh.link(a, b, dashpot.constant, &0.0);
    }
    let massless: Vec<usize> = (0..count)
        .filter(|&body| structure.cluster_of[body].is_some() && mesh.links(body).next().is_some())
        .collect();
    let mesh = mesh.eliminate(&massless, usize::MAX).rest;
    // What is fixed or moved from outside is as heavy as can be.
    let mass = |body: usize| match bodies.all[body].role {
        Role::Mass(mass) => mass,
        Role::Fixed | Role::Prescribed(_) => f64::INFINITY,
        Role::Massless => 0.0,
    };
    let masses = (0..count).filter(|&body| mass(body) > 0.0);
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for body in masses {
        let others = mesh.links(body).filter(|&(other, _)| other > body);
        pairs.extend(others.map(|(other, link)| (link.conductance.high(), [body, other])));
    }
    let is_mixed = |body: usize| {
        let damping: f64 = mesh.links(body).map(|(_, link)| link.conductance.high()).sum();
        let harmless = if mesh.links(body).count() > 1 { HARMLESS } else { STRONG };
        damping * duration > harmless * mass(body)
    };
    pairs.retain(|(_, ends)| ends.iter().any(|&end| is_mixed(end)));
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut groups = Groups::new(count);
    let mut heaviest: Vec<usize> = (0..count).collect();
    for (_, [a, b]) in pairs {
        let [one, other] = [a, b].map(|body| heaviest[groups.of(body)]);
        if !groups.join(a, b) {
            continue;
        }
        let (light, heavy) = if mass(one) < mass(other) { (one, other) } else { (other, one) };
        if mass(heavy).is_finite() {
            parents[light] = Some(heavy);
        }
        heaviest[groups.of(a)] = heavy;
    }
    parents
}
