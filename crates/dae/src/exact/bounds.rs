//! Bounds of what the modal form still gets wrong.

use super::{block::Block, modes::Modes};

/// Safety factor that covers the terms of second order in the defect.
const SECOND_ORDER: f64 = 2.0;

/// The error that the defect `Δ = X⁻¹ Ā X − D` may cause in each modal coordinate within `length`
/// after a state whose coordinates have these `sizes`.
///
/// To first order it is `∫₀ᵗ e^{D_i (t−s)} Δ_ij e^{D_j s} c_j ds`, which is at most the largest value
/// of one exponential times the integral of the other; the smaller of the two products counts.
/// Growth that all modes are granted is taken out first, so that it does not count twice.
pub(super) fn coupling_error(modes: &Modes, sizes: &[f64], length: f64) -> Vec<f64> {
    let growth = modes.blocks.iter().map(Block::growth_rate).fold(0.0, f64::max);
    let largest = |block: &Block, sizes: &[f64]| block.largest_discounted(length, sizes, growth);
    let integral = |block: &Block, sizes: &[f64]| block.integral(length, sizes, growth);
    let factor = SECOND_ORDER * (growth * length).exp();
    let mut tops = Vec::with_capacity(sizes.len());
    let mut areas = Vec::with_capacity(sizes.len());
    for block in &modes.blocks {
        tops.extend(largest(block, &sizes[block.range()]));
        areas.extend(integral(block, &sizes[block.range()]));
    }
    let mut error = vec![0.0; sizes.len()];
    for target in &modes.blocks {
        for source in &modes.blocks {
            let pushed = |sizes: &[f64]| -> Vec<f64> {
                let push = |i| source.range().map(|j| modes.defect[(i, j)] * sizes[j]).sum();
                target.range().map(push).collect()
            };
            let first = integral(target, &pushed(&tops));
            let second = largest(target, &pushed(&areas));
            for (i, (a, b)) in target.range().zip(first.iter().zip(&second)) {
                error[i] += factor * a.min(*b);
            }
        }
    }
    error
}
