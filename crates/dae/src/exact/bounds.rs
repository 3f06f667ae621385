//! Bounds of what the modal form still gets wrong.

use super::{block::Block, modes::Modes};

/// Factor by which a bound is widened at each step of the search for one that confirms itself.
const INFLATION: f64 = 1.1;
/// Most steps of that search.
const STEPS: usize = 30;

/// A bound `e` that confirms itself: `first + apply(e) ≤ e`, entry by entry, for a linear `apply`
/// that keeps order. Every quantity `x ≤ first + apply(x)` that is known to be finite lies below it.
///
/// Infinite where no such bound is found: then `apply` does not contract, and nothing is known.
pub(super) fn enclose(first: &[f64], apply: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut bound = first.to_vec();
    for _ in 0..STEPS {
        let mut next = apply(&bound);
        let mut confirmed = true;
        for ((next, bound), first) in next.iter_mut().zip(&bound).zip(first) {
            *next += first;
            confirmed &= *next <= *bound;
            *next *= INFLATION;
        }
        if confirmed {
            return bound;
        }
        bound = next;
    }
    vec![f64::INFINITY; first.len()]
}

/// The error that the defect `Δ = X⁻¹ Ā X − D` may cause in each modal coordinate within `length`
/// after a state whose coordinates have these `sizes`.
///
/// To first order it is `∫₀ᵗ e^{D_i (t−s)} Δ_ij e^{D_j s} c_j ds`, which is at most the largest value
/// of one exponential times the integral of the other; the smaller of the two products counts. The
/// error drives itself in the same way. Growth that all modes are granted is taken out first, so
/// that it does not count twice.
pub(super) fn coupling_error(modes: &Modes, sizes: &[f64], length: f64) -> Vec<f64> {
    let growth = modes.blocks.iter().map(Block::growth_rate).fold(0.0, f64::max);
    let largest = |block: &Block, sizes: &[f64]| block.largest_discounted(length, sizes, growth);
    let integral = |block: &Block, sizes: &[f64]| block.integral(length, sizes, growth);
    let mut tops = Vec::with_capacity(sizes.len());
    let mut areas = Vec::with_capacity(sizes.len());
    for block in &modes.blocks {
        tops.extend(largest(block, &sizes[block.range()]));
        areas.extend(integral(block, &sizes[block.range()]));
    }
    let mut first = vec![0.0; sizes.len()];
    for target in &modes.blocks {
        for source in &modes.blocks {
            let pushed = |sizes: &[f64]| -> Vec<f64> {
                let push = |i| source.range().map(|j| modes.defect[(i, j)] * sizes[j]).sum();
                target.range().map(push).collect()
            };
            let held = integral(target, &pushed(&tops));
            let spread = largest(target, &pushed(&areas));
            for (i, (a, b)) in target.range().zip(held.iter().zip(&spread)) {
                first[i] += a.min(*b);
            }
        }
    }
    let again = |error: &[f64]| -> Vec<f64> {
        let pushed: Vec<f64> = (0..error.len())
            .map(|i| error.iter().enumerate().map(|(j, e)| modes.defect[(i, j)] * e).sum())
            .collect();
        modes.blocks.iter().flat_map(|block| integral(block, &pushed[block.range()])).collect()
    };
    let factor = (growth * length).exp();
    enclose(&first, again).iter().map(|error| factor * error).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bound_confirms_itself_where_there_is_one() {
        // e₀ = 1 + e₁/2, e₁ = e₀/4: e₀ = 8/7, e₁ = 2/7.
        let bound = enclose(&[1.0, 0.0], |e| vec![0.5 * e[1], 0.25 * e[0]]);
        assert!((8.0 / 7.0..2.0).contains(&bound[0]) && (2.0 / 7.0..0.6).contains(&bound[1]));
        assert_eq!(enclose(&[0.0], |e| vec![9.0 * e[0]]), [0.0]);
        assert_eq!(enclose(&[1.0], |e| vec![1.5 * e[0]]), [f64::INFINITY]);
        assert_eq!(enclose(&[f64::NAN], <[f64]>::to_vec), [f64::INFINITY]);
    }
}
