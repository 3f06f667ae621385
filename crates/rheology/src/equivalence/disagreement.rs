//! Where two models differ most.

use dashpot_numerics::extrema::largest_on_half_line;
use nalgebra::Complex;

use super::{Aligned, aligned};
use crate::{
    LinearModel,
    linear::{Fractions, Line},
};

/// Points per factor e at which the disagreement is looked at before its maximum is refined: 12 in a
/// decade. The responses of a mode change over about a decade.
const PER_FACTOR: f64 = 5.2;
/// Least distance of two points, as a logarithm.
const ROOM: f64 = 0.01;
/// How far beyond the fastest and the slowest mode there are such points, as a logarithm.
const BEYOND: f64 = 7.0;
/// How far beyond them there is one more, which stands for the limit, as a logarithm.
const LIMIT: f64 = 30.0;
/// Steps of the golden section: to 10⁻⁶ of the distance of two points.
const STEPS: usize = 30;

/// The largest relative differences of the responses of two models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disagreement {
    /// Angular frequency of the largest difference of the complex stiffnesses \[rad/s\]; 0 and
    /// infinity stand for the limits.
    pub omega: f64,
    /// That difference, `|Q₁(iω) − Q₂(iω)|` over the larger of the two.
    pub stiffness: f64,
    /// Time of the largest difference of the creep compliances \[s\]; 0 and infinity stand for the limits.
    pub time: f64,
    /// That difference, `|J₁(t) − J₂(t)|` over the larger of the two.
    pub creep: f64,
}

impl Disagreement {
    /// Of two models that have both forms.
    pub(super) fn of(first: &LinearModel, second: &LinearModel) -> Option<Self> {
        let (a, b) = first.maxwell().zip(second.maxwell()).map(|(a, b)| (&a.0, &b.0))?;
        let pairs: Vec<Aligned<'_>> = aligned(&a.lines, &b.lines).collect();
        let (omega, stiffness) =
            largest_on_half_line(&places([a, b], |rate| rate), STEPS, |omega| {
                let difference = difference(a, b, &pairs, omega).norm();
                difference / stiffness_at(a, omega).norm().max(stiffness_at(b, omega).norm())
            });
        let (a, b) = first.kelvin().zip(second.kelvin()).map(|(a, b)| (&a.0, &b.0))?;
        let pairs: Vec<Aligned<'_>> = aligned(&a.lines, &b.lines).collect();
        let (time, creep) = largest_on_half_line(&places([a, b], f64::recip), STEPS, |time| {
            creep_difference(a, b, &pairs, time).abs() / first.creep(time).max(second.creep(time))
        });
        Some(Self { omega, stiffness, time, creep })
    }
}

/// Places on a logarithmic scale, from far below to far beyond what `place` makes of all rates and
/// of those at which a single spring and a single dashpot are as stiff as something else.
fn places(forms: [&Fractions; 2], place: fn(f64) -> f64) -> Vec<f64> {
    let lines = || forms.into_iter().flat_map(|form| &form.lines);
    let mut all: Vec<f64> = lines().map(|line| line.rate.high()).collect();
    for form in forms {
        let (at_zero, constant) = (form.at_zero.high(), form.constant.high());
        all.extend(forms.map(|other| at_zero / other.constant.high()));
        all.extend(lines().map(|line| at_zero * (line.rate / line.strength).high()));
        all.extend(lines().map(|line| line.strength.high() / constant));
    }
    all.retain(|rate| rate.is_normal());
    // Logarithms, because the places may be farther apart than numbers reach.
    let mut all: Vec<f64> = all.into_iter().map(|rate| place(rate).ln()).collect();
    all.sort_by(f64::total_cmp);
    let ends = all.first().zip(all.last()).map(|(low, high)| (low - BEYOND, high + BEYOND));
    // Where only springs are, or only dashpots, nothing depends on the place.
    let Some((low, high)) = ends else { return vec![1.0] };
    let count = ((high - low) * PER_FACTOR).ceil();
    let mut at = 0.0;
    while at <= count {
        all.push(low + (high - low) * (at / count));
        at += 1.0;
    }
    all.extend([low - LIMIT, high + LIMIT]);
    all.sort_by(f64::total_cmp);
    // Neighbours enclose a maximum only if there is room between them.
    all.dedup_by(|next, kept| *next - *kept < ROOM);
    all.iter_mut().for_each(|place| *place = place.exp());
    all.retain(|place| place.is_normal());
    all
}

/// `iω/(iω + r)`.
fn share(rate: f64, omega: f64) -> Complex<f64> {
    let ratio = rate / omega;
    if ratio > 1.0 {
        // Both numerator and denominator over the square of the ratio, which may overflow.
        let inverse = ratio.recip();
        Complex::new(inverse * inverse, inverse) / inverse.mul_add(inverse, 1.0)
    } else {
        Complex::new(1.0, ratio) / ratio.mul_add(ratio, 1.0)
    }
}

/// `Q(iω)` of a Maxwell form.
fn stiffness_at(form: &Fractions, omega: f64) -> Complex<f64> {
    let singles = Complex::new(form.at_zero.high(), form.constant.high() * omega);
    form.lines
        .iter()
        .fold(singles, |sum, line| sum + share(line.rate.high(), omega) * line.strength.high())
}

/// `Q₁(iω) − Q₂(iω)`, mode by mode, so that what agrees does not hide what differs.
fn difference(
    first: &Fractions,
    second: &Fractions,
    pairs: &[Aligned<'_>],
    omega: f64,
) -> Complex<f64> {
    let alone = |line: &Line| share(line.rate.high(), omega) * line.strength.high();
    let singles = Complex::new(
        (first.at_zero - second.at_zero).high(),
        (first.constant - second.constant).high() * omega,
    );
    pairs.iter().fold(singles, |sum, pair| {
        sum + match pair {
            (Some(a), Some(b)) => {
                let [u, v] = [a, b].map(|own| share(own.rate.high(), omega));
                // u − v = (r₂ − r₁)/(iω) u v.
                let apart = (b.rate - a.rate).high() / omega;
                u * (a.strength - b.strength).high()
                    + Complex::new(0.0, -apart) * u * v * b.strength.high()
            }
            (Some(a), None) => alone(a),
            (None, Some(b)) => -alone(b),
            (None, None) => Complex::default(),
        }
    })
}

/// `J₁(t) − J₂(t)` of two Kelvin forms, mode by mode.
fn creep_difference(first: &Fractions, second: &Fractions, pairs: &[Aligned<'_>], t: f64) -> f64 {
    let yielded = |line: &Line| -(-line.rate.high() * t).exp_m1();
    let compliance = |line: &Line| line.strength / line.rate;
    let singles =
        (first.constant - second.constant).high() + (first.at_zero - second.at_zero).high() * t;
    pairs.iter().fold(singles, |sum, pair| {
        sum + match pair {
            (Some(a), Some(b)) => {
                let apart = (a.rate - b.rate).high() * t;
                let later = -(-b.rate.high() * t).exp() * (-apart).exp_m1();
                // Where the exponents are large, both have yielded in full.
                let later = if later.is_finite() { later } else { yielded(a) - yielded(b) };
                (compliance(a) - compliance(b)).high() * yielded(a) + compliance(b).high() * later
            }
            (Some(a), None) => compliance(a).high() * yielded(a),
            (None, Some(b)) => -compliance(b).high() * yielded(b),
            (None, None) => 0.0,
        }
    })
}
