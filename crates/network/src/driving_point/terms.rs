//! The receptance as a sum of terms, one for each pole or group of poles that belong together.

use dashpot_numerics::DoubleDouble;

use super::{
    circuit::{Circuit, shift},
    complex::Complex,
    modes::Mode,
};
use crate::compile::bodies::Groups;

/// `N(s − p)/D(s − p)`: `D` is monic of degree `residues.len()` and `spread` has its other
/// coefficients, the constant first; `residues` are those of `N`.
#[derive(Debug, Clone)]
pub(super) struct Term {
    pub(super) at: Complex,
    pub(super) spread: Vec<Complex>,
    pub(super) residues: Vec<Complex>,
    /// How many poles of the circuit it stands for.
    pub(super) count: usize,
    /// Bound on its relative error, from the condition of its poles.
    pub(super) error: f64,
}

/// Poles closer than this, relative, belong together.
const SAME: f64 = 1e-12;
/// Poles whose condition is worse than this belong to their neighbours within [`NEAR`].
const ILL: f64 = 1e3;
const NEAR: f64 = 1e-2;
/// Coefficients below this part of the largest do not exist.
const NOTHING: f64 = 1e-22;
/// Rounding of one value of the receptance.
const ROUNDING: f64 = 1e-31;

impl Term {
    /// How far the poles of a group are from their mean, by a bound on the zeros of its polynomial.
    pub(super) fn reach(&self) -> f64 {
        let order = self.spread.len();
        let root =
            |(k, coefficient): (usize, &Complex)| coefficient.size().powf(1.0 / (order - k) as f64);
        2.0 * self.spread.iter().enumerate().map(root).fold(0.0, f64::max)
    }

    /// `strength/(s − p)`.
    pub(super) fn simple(at: Complex, strength: Complex) -> Self {
        Self { at, spread: vec![Complex::zero()], residues: vec![strength], count: 1, error: 0.0 }
    }

    /// Its value at a rate.
    pub(super) fn value(&self, s: Complex) -> Complex {
        let t = s - self.at;
        let horner = |start: Complex, coefficients: &[Complex]| {
            coefficients.iter().rev().fold(start, |sum, &c| sum * t + c)
        };
        horner(Complex::zero(), &self.residues).over(horner(Complex::one(), &self.spread))
    }

    /// Size of its strengths in units of a compliance.
    pub(super) fn compliance(&self) -> f64 {
        self.compliance_at(self.at.size())
    }

    /// Size of its strengths as a compliance at a distance from the pole.
    pub(super) fn compliance_at(&self, size: f64) -> f64 {
        let order = self.residues.len();
        let part = |(k, n): (usize, &Complex)| n.size() / size.powi(power(order - k));
        self.residues.iter().enumerate().map(part).fold(0.0, f64::max)
    }

    /// The moments `Σ residue·(pole − p)^k` about a point, `k < count`.
    pub(super) fn moments(&self, about: Complex, count: usize) -> Vec<Complex> {
        let order = self.residues.len();
        // Division of N by D in powers of 1/t about the own centre.
        let mut own = Vec::with_capacity(count);
        for k in 0..count {
            let mut rest = if k < order { self.residues[order - 1 - k] } else { Complex::zero() };
            for (j, &moment) in own.iter().enumerate() {
                let drop = k - j;
                if drop <= order {
                    rest = rest - self.spread[order - drop] * moment;
                }
            }
            own.push(rest);
        }
        // Shift of the centre by the binomial theorem.
        let by = self.at - about;
        let mut moments = Vec::with_capacity(count);
        let mut row = vec![Complex::one()];
        for k in 0..count {
            let sum = (0..=k).fold(Complex::zero(), |sum, j| sum + row[j] * own[j]);
            moments.push(sum);
            let mut next = vec![Complex::zero(); k + 2];
            for (j, &weight) in row.iter().enumerate() {
                next[j] = next[j] + weight * by;
                next[j + 1] = next[j + 1] + weight;
            }
            row = next;
        }
        moments
    }

    /// The same term in units of time and of compliance that are powers of two.
    pub(super) fn scale(&mut self, time: i32, force: i32) {
        let order = power(self.residues.len());
        let times = |value: &mut Complex, exponent: i32| {
            shift(&mut value.re, exponent);
            shift(&mut value.im, exponent);
        };
        times(&mut self.at, -time);
        for (k, value) in self.spread.iter_mut().enumerate() {
            times(value, -time * (order - power(k)));
        }
        for (k, value) in self.residues.iter_mut().enumerate() {
            times(value, -time * (order - power(k)) - force);
        }
    }

    fn conjugate(&self) -> Self {
        let all = |values: &[Complex]| values.iter().map(|value| value.conjugate()).collect();
        Self {
            at: self.at.conjugate(),
            spread: all(&self.spread),
            residues: all(&self.residues),
            ..*self
        }
    }
}

/// A small count as an exponent.
fn power(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

/// The terms of all poles.
pub(super) fn terms(circuit: &Circuit, modes: &[Mode]) -> Vec<Term> {
    let mut groups = Groups::new(modes.len());
    for (i, first) in modes.iter().enumerate() {
        for (j, second) in modes.iter().enumerate().skip(i + 1) {
            let gap = (first.pole - second.pole).size() / first.pole.size();
            let is_ill = first.condition.min(second.condition) > ILL;
            if gap <= SAME || (is_ill && gap <= NEAR) {
                groups.join(i, j);
            }
        }
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); modes.len()];
    for at in 0..modes.len() {
        members[groups.of(at)].push(at);
    }
    let mut terms = Vec::new();
    for group in members.iter().filter(|group| !group.is_empty()) {
        let poles: Vec<Complex> = group.iter().map(|&at| modes[at].pole).collect();
        let has =
            |pole: Complex| poles.iter().any(|other| (*other - pole).size() <= SAME * pole.size());
        let is_own_mirror = poles.iter().all(|pole| has(pole.conjugate()));
        if !is_own_mirror && poles.iter().all(|pole| pole.im < 0.0) {
            continue;
        }
        let term = if let [at] = group[..] {
            let Mode { pole, residue, condition } = modes[at];
            Term { error: condition * ROUNDING, ..Term::simple(pole, residue) }
        } else {
            let others: Vec<Complex> = (0..modes.len())
                .filter(|at| !group.contains(at))
                .map(|at| modes[at].pole)
                .collect();
            together(circuit, &poles, &others, is_own_mirror)
        };
        if !is_own_mirror {
            terms.push(term.conjugate());
        }
        terms.push(term);
    }
    terms
}

/// The term of poles that stand too close for residues of their own: the coefficients of the
/// denominator are those of their polynomial, the numerator follows from integrals of the
/// receptance around all of them. Both are well determined where the single poles are not.
fn together(circuit: &Circuit, poles: &[Complex], others: &[Complex], is_real: bool) -> Term {
    let order = poles.len();
    let share = DoubleDouble::from(1.0 / order as f64);
    let mut at = poles[1..].iter().fold(poles[0], |sum, pole| sum + *pole).times(share);
    // 1/order is rounded to a double where order is no power of two; what remains is put right.
    let rest = poles.iter().fold(Complex::zero(), |sum, pole| sum + (*pole - at)).times(share);
    at = at + rest;
    if is_real {
        at.im = DoubleDouble::ZERO;
    }
    let mut spread = vec![Complex::one()];
    for pole in poles {
        let root = *pole - at;
        let mut next = vec![Complex::zero(); spread.len() + 1];
        for (k, &coefficient) in spread.iter().enumerate() {
            next[k + 1] = next[k + 1] + coefficient;
            next[k] = next[k] - coefficient * root;
        }
        spread = next;
    }
    spread.truncate(order);

    let width = poles.iter().map(|pole| (*pole - at).size()).fold(0.0, f64::max);
    let clear = others.iter().map(|pole| (*pole - at).size()).fold(at.size(), f64::min);
    let radius = (width * clear).sqrt().max(0.03 * clear);
    let ratio = (radius / clear).max(width / radius);
    let points = around(ratio);
    let values: Vec<(Complex, Complex)> = points
        .iter()
        .map(|&point| {
            let step = point.times(DoubleDouble::from(radius));
            (step, circuit.receptance(at + step))
        })
        .collect();
    let count = DoubleDouble::from(1.0 / points.len() as f64);
    let mut moments = Vec::with_capacity(order);
    for k in 0..order {
        let sum = values.iter().fold(Complex::zero(), |sum, &(step, value)| {
            sum + (0..=k).fold(value, |product, _| product * step)
        });
        moments.push(sum.times(count));
    }
    if is_real {
        moments.iter_mut().for_each(|moment| moment.im = DoubleDouble::ZERO);
    }
    let size = at.size();
    let sizes: Vec<f64> =
        moments.iter().enumerate().map(|(k, m)| m.size() / size.powi(power(k))).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let seen = sizes.iter().rposition(|&part| part > NOTHING * largest).map_or(1, |k| k + 1);
    if seen < order {
        moments.truncate(seen);
        spread = vec![Complex::zero(); seen];
    }
    let strength = |i: usize| {
        (i + 1..seen).fold(moments[seen - 1 - i], |sum, j| sum + spread[j] * moments[j - i - 1])
    };
    let residues = (0..seen).map(strength).collect();
    let truncation = ratio.powi(power(points.len()) - power(order));
    let rounding = ROUNDING * (size / radius).powi(power(order));
    Term { at, spread, residues, count: order, error: truncation + rounding }
}

/// Points on the unit circle, as many as a convergence by `ratio` for each asks for; a power of
/// two, from halved angles.
fn around(ratio: f64) -> Vec<Complex> {
    let wanted = (70.0 / -ratio.min(0.8).ln()).ceil() + 4.0;
    let mut root = Complex::new(-1.0, 0.0);
    let mut count = 2_usize;
    while (count as f64) < wanted {
        let cosine = ((root.re + 1.0) * 0.5).sqrt();
        root = if count == 2 {
            Complex::new(0.0, 1.0)
        } else {
            Complex { re: cosine, im: root.im / (cosine * 2.0) }
        };
        count *= 2;
    }
    let mut points = vec![Complex::one()];
    for at in 1..count {
        points.push(points[at - 1] * root);
    }
    points
}
