//! What a form is read from: places, forces, and the order of elimination.

use super::{Eliminated, Part};
use crate::compile::{expand::Shape, row::Combination, unknowns::Places};

/// The difference of the places of two bodies over the unknowns; `None` where it is not one of whole positions.
pub(super) fn difference(places: &Places, [a, b]: [usize; 2]) -> Option<Vec<(usize, f64)>> {
    let row = places.position.row(a).plus(-1.0, &places.position.row(b));
    if !row.inputs.is_zero() {
        return None;
    }
    Some(row.unknowns.terms().iter().map(|&(at, factor)| (at, factor.high())).collect())
}

/// Parts whose forces add up to that of a connection: of a series the member of the fewest parts,
/// springs before dashpots.
pub(super) fn force_parts(
    shapes: &[Shape],
    number_of: &[Option<usize>],
    parts: &[Part],
) -> Option<Vec<usize>> {
    let mut found: Vec<Option<Vec<usize>>> = vec![None; shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => number_of[*primitive].map(|part| vec![part]),
            Shape::Parallel(children) => {
                let all: Option<Vec<&Vec<usize>>> =
                    children.iter().map(|&child| found[child].as_ref()).collect();
                all.map(|all| all.into_iter().flatten().copied().collect())
            }
            Shape::Series(children) => {
                let known = children.iter().filter_map(|&child| found[child].clone());
                known.min_by_key(|own| {
                    let dashpots = own.iter().filter(|&&part| parts[part].is_dashpot()).count();
                    (dashpots, own.len())
                })
            }
            Shape::Row(_) => None,
        };
    }
    found.into_iter().next().flatten()
}

/// The order in which massless bodies are eliminated, those that wait for it: the one with the fewest links first.
pub(super) fn order(mut waits: Vec<bool>, parts: &[Part]) -> Vec<Eliminated> {
    let bodies = waits.len();
    let mut links = vec![vec![false; bodies]; bodies];
    for part in parts.iter().filter(|part| part.is_dashpot()) {
        let [a, b] = part.ends;
        (links[a][b], links[b][a]) = (true, true);
    }
    let mut order = Vec::new();
    while let Some(body) = (0..bodies)
        .filter(|&at| waits[at])
        .min_by_key(|&at| links[at].iter().filter(|own| **own).count())
    {
        waits[body] = false;
        let star: Vec<usize> = (0..bodies).filter(|&other| links[body][other]).collect();
        for &a in &star {
            links[a][body] = false;
            for &b in star.iter().filter(|&&b| b != a) {
                links[a][b] = true;
            }
        }
        let neighbours = star.into_iter().map(|other| (other, waits[other])).collect();
        order.push(Eliminated { body, neighbours });
    }
    order
}
