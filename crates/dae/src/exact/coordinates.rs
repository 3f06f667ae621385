//! The solution in modal coordinates, span by span.

use dashpot_numerics::Accumulator;
use nalgebra::DMatrix;

use super::{
    Augmented, Complex, augmented::Span, block::Block, bounds::enclose, modes::Modes,
    refinement::enclose_matrix,
};

/// Unit roundoff, with the few operations that a modal coordinate goes through.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The modal coordinates of one span.
#[derive(Debug, Clone)]
pub(super) struct SpanCoordinates {
    /// `c = X⁻¹ z` at the start of the span.
    pub(super) start: Vec<Complex>,
    /// Bounds of the errors of `e^{D t} c`, the largest over the span.
    pub(super) error: Vec<f64>,
}

/// The coordinates of all spans, each continued from the one before: only what the generators jump
/// by is added at a breakpoint, so nothing is lost in going to and fro between `c` and `z`.
pub(super) fn follow(system: &Augmented, modes: &Modes) -> Vec<SpanCoordinates> {
    let waves = waves(system, modes);
    let (mut start, mut inherited) = solve(modes, &system.initial);
    if let Some(first) = system.spans.first() {
        silence(&waves, first, &mut start, &mut inherited);
    }
    let kept =
        if system.spans.len() > 1 { kept_errors(system, modes) } else { DMatrix::zeros(0, 0) };
    let mut all = Vec::with_capacity(system.spans.len());
    for (at, span) in system.spans.iter().enumerate() {
        let (largest, last) = span_errors(modes, &start, &inherited, span.length());
        all.push(SpanCoordinates { start: start.clone(), error: largest });
        inherited = last;
        if let Some(next) = system.spans.get(at + 1) {
            inherited = forget(&kept, &inherited);
            cross(system, modes, span, next, &mut start, &mut inherited);
            silence(&waves, next, &mut start, &mut inherited);
        }
    }
    all
}

/// The two modes that alone hold the wave of a driving function.
struct Wave {
    /// Index of its first generator; the second one follows.
    generator: usize,
    modes: [usize; 2],
}

/// The waves that two modes hold alone: no other mode has a part in their generators.
fn waves(system: &Augmented, modes: &Modes) -> Vec<Wave> {
    let has_part = |row: usize, mode: usize| {
        let place = (row, mode);
        let zero = Complex::default();
        modes.basis[place] != zero || modes.basis_low[place] != zero
    };
    let of_wave = |(generator, _): (usize, f64)| {
        let row = system.states + generator;
        let holds = |&mode: &usize| has_part(row, mode) || has_part(row + 1, mode);
        let held: Vec<usize> = (0..modes.len()).filter(holds).collect();
        let modes = <[usize; 2]>::try_from(held).ok()?;
        Some(Wave { generator, modes })
    };
    system.generators.waves().filter_map(of_wave).collect()
}

/// Sets the modes of waves that are not there in `span` to the zero that they are, without any error:
/// what rounding leaves of a short pulse would be followed through all of its periods.
fn silence(waves: &[Wave], span: &Span, c: &mut [Complex], error: &mut [f64]) {
    for wave in waves {
        let here = &span.generators[wave.generator..wave.generator + 2];
        if here.iter().all(|&value| value == 0.0) {
            for mode in wave.modes {
                (c[mode], error[mode]) = (Complex::default(), 0.0);
            }
        }
    }
}

/// `|1 − X⁻¹ P X|`, where `P` picks the generators: what is left of an error at a breakpoint, where
/// the generators are set anew without any.
fn kept_errors(system: &Augmented, modes: &Modes) -> DMatrix<f64> {
    let (size, states) = (modes.len(), system.states);
    let generators = size - states;
    let dual = modes.dual.columns(states, generators);
    let lost = dual * modes.basis.rows(states, generators);
    let missed = &modes.dual_defect * lost.map(Complex::norm);
    let kept = DMatrix::from_fn(size, size, |i, j| {
        (Complex::new(if i == j { 1.0 } else { 0.0 }, 0.0) - lost[(i, j)]).norm()
    });
    kept + enclose_matrix(&modes.dual_defect, &missed)
}

fn forget(kept: &DMatrix<f64>, error: &[f64]) -> Vec<f64> {
    let sum = |i| error.iter().enumerate().map(|(j, e)| kept[(i, j)] * e).sum();
    (0..error.len()).map(sum).collect()
}

/// `X⁻¹ z`, improved until `X c = z` to rounding, and the bound of its error.
fn solve(modes: &Modes, z: &[f64]) -> (Vec<Complex>, Vec<f64>) {
    let size = modes.len();
    let mut c = vec![Complex::default(); size];
    let mut missing: Vec<Complex> = z.iter().map(|&z| Complex::new(z, 0.0)).collect();
    for _ in 0..4 {
        for (i, c) in c.iter_mut().enumerate() {
            let change: Complex = (0..size).map(|k| modes.dual[(i, k)] * missing[k]).sum();
            *c += change;
        }
        for (i, missing) in missing.iter_mut().enumerate() {
            *missing = defect(modes, i, z[i], &c);
        }
    }
    let rest = |i| (0..size).map(|k| modes.dual[(i, k)].norm() * missing[k].norm()).sum();
    let rest: Vec<f64> = (0..size).map(rest).collect();
    let mut error = enclose_matrix(&modes.dual_defect, &DMatrix::from_vec(size, 1, rest));
    for (error, c) in error.iter_mut().zip(&c) {
        *error += ROUNDING * c.norm();
    }
    // Only one mode of a pair is evaluated.
    for (i, j) in modes.pairs.iter().map(|&(i, j)| (modes.blocks[i].start, modes.blocks[j].start)) {
        error[i] += (c[i] - c[j].conj()).norm();
    }
    (c, error.as_slice().to_vec())
}

/// `z_i − (X c)_i`.
fn defect(modes: &Modes, i: usize, z: f64, c: &[Complex]) -> Complex {
    let (mut re, mut im) = (Accumulator::default(), Accumulator::default());
    re.add(z);
    for (k, c) in c.iter().enumerate() {
        let (x, low) = (modes.basis[(i, k)], modes.basis_low[(i, k)]);
        re.add_product(-x.re, c.re);
        re.add_product(x.im, c.im);
        im.add_product(-x.re, c.im);
        im.add_product(-x.im, c.re);
        let small = low * c;
        re.add_small(-small.re);
        im.add_small(-small.im);
    }
    Complex::new(re.value(), im.value())
}

/// Errors of the coordinates over a span of the given length: the largest, and those at its end.
fn span_errors(
    modes: &Modes,
    start: &[Complex],
    inherited: &[f64],
    length: f64,
) -> (Vec<f64>, Vec<f64>) {
    let sizes: Vec<f64> = start.iter().map(|c| c.norm()).collect();
    let coupled = coupling_error(modes, &sizes, length);
    let (mut largest, mut last) = (coupled.clone(), coupled);
    for block in &modes.blocks {
        let range = block.range();
        let top = block.largest(length, &inherited[range.clone()]);
        let end = block.last(length, &inherited[range.clone()]);
        let size = block.largest(length, &sizes[range.clone()]);
        let strain = block.strain(length, &sizes[range.clone()]);
        for (k, i) in range.enumerate() {
            largest[i] += top[k] + ROUNDING * size[k] + 0.5 * ROUNDING * strain[k];
            last[i] += end[k] + ROUNDING * size[k] + 0.5 * ROUNDING * strain[k];
        }
    }
    (largest, last)
}

/// The error that the defect `Δ = X⁻¹ Ā X − D` may cause in each modal coordinate within `length`
/// after a state whose coordinates have these `sizes`.
///
/// To first order it is `∫₀ᵗ e^{D_i (t−s)} Δ_ij e^{D_j s} c_j ds`, which is at most the largest value of one
/// exponential times the integral of the other; the smaller of the two products counts. The error drives itself in the
/// same way. Growth that all modes are granted is taken out first, so that it does not count twice.
fn coupling_error(modes: &Modes, sizes: &[f64], length: f64) -> Vec<f64> {
    let growth = modes.blocks.iter().map(Block::growth_rate).fold(0.0, f64::max);
    let largest = |block: &Block, sizes: &[f64]| block.largest_discounted(length, sizes, growth);
    let integral = |block: &Block, sizes: &[f64]| block.integral(length, sizes, growth);
    // Of a single mode what it answers to one tells all.
    let answer = |block: &Block| {
        let answer = || (integral(block, &[1.0])[0], largest(block, &[1.0])[0]);
        (block.len() == 1).then(answer)
    };
    let answers: Vec<Option<(f64, f64)>> = modes.blocks.iter().map(answer).collect();
    let times = |push: f64, answer: f64| if push == 0.0 { 0.0 } else { push * answer };
    let mut tops = Vec::with_capacity(sizes.len());
    let mut areas = Vec::with_capacity(sizes.len());
    for (block, answer) in modes.blocks.iter().zip(&answers) {
        if let Some((held, spread)) = answer {
            tops.push(times(sizes[block.start], *spread));
            areas.push(times(sizes[block.start], *held));
        } else {
            tops.extend(largest(block, &sizes[block.range()]));
            areas.extend(integral(block, &sizes[block.range()]));
        }
    }
    let mut first = vec![0.0; sizes.len()];
    for (target, answer) in modes.blocks.iter().zip(&answers) {
        for source in &modes.blocks {
            if let Some((held, spread)) = answer {
                let i = target.start;
                let push = |all: &[f64]| -> f64 {
                    source.range().map(|j| modes.defect[(i, j)] * all[j]).sum()
                };
                first[i] += times(push(&tops), *held).min(times(push(&areas), *spread));
                continue;
            }
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
        let mut pushed: Vec<f64> = (0..error.len())
            .map(|i| error.iter().enumerate().map(|(j, e)| modes.defect[(i, j)] * e).sum())
            .collect();
        for (block, answer) in modes.blocks.iter().zip(&answers) {
            if let Some((held, _)) = answer {
                pushed[block.start] = times(pushed[block.start], *held);
            } else {
                let own = integral(block, &pushed[block.range()]);
                pushed[block.range()].copy_from_slice(&own);
            }
        }
        pushed
    };
    let factor = (growth * length).exp();
    enclose(&first, again).iter().map(|error| factor * error).collect()
}

/// Goes from the start of one span to that of the next.
fn cross(
    system: &Augmented,
    modes: &Modes,
    span: &Span,
    next: &Span,
    c: &mut [Complex],
    error: &mut [f64],
) {
    for block in &modes.blocks {
        block.advance(span.length(), &mut c[block.range()]);
    }
    let mut jump = vec![0.0; system.states];
    let jumps = next.generators.iter().enumerate();
    jump.extend(jumps.map(|(k, &value)| defect(modes, system.states + k, value, c).re));
    let (change, missed) = solve(modes, &jump);
    for (i, (c, error)) in c.iter_mut().zip(error.iter_mut()).enumerate() {
        *c += change[i];
        *error += missed[i] + ROUNDING * c.norm();
    }
}
