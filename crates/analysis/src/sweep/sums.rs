//! Integrals over an impact, as Gauss's sums over the steps of its solution, and its force over time.

use dashpot_dae::Panel;
use dashpot_numerics::{
    chebyshev::{Coefficients, Interpolation},
    quadrature::GaussLegendre,
    small::{Square, apply, apply_left, dot},
};

use super::{
    plain::shown::Wanted,
    scene_point::{Figure, Impact, ScenePoint},
};
use crate::measures::powers::{ENDS, raised};

/// Terms of the series of a force within a step.
const TERMS: usize = 24;
/// Points of Gauss's rule in the midst; see [`ENDS`].
const GAUSS: usize = 6;
/// What a Gauss sum may be off by, in parts of the integral; see the tests.
const QUADRATURE: f64 = 1e-9;

/// The integrals so far.
pub(super) struct Integrals<const N: usize> {
    wanted: Wanted,
    step: f64,
    /// Places on 0…1 and weights of both rules.
    rule: ([f64; GAUSS], [f64; GAUSS]),
    end_rule: ([f64; ENDS], [f64; ENDS]),
    /// Force and rate of deformation at Gauss's points of a step, over the state at its start.
    force_at: [[f64; GAUSS]; N],
    speed_at: [[f64; GAUSS]; N],
    /// `F Aʲ/j!` and `ẏ Aʲ/j!`.
    force_terms: [[f64; N]; TERMS],
    speed_terms: [[f64; N]; TERMS],
    /// Up to the step before the last one …
    sure: Amounts,
    /// … and that step, with the state at its beginning.
    last: Amounts,
    before: [f64; N],
    /// The work up to the end of the run, and `∫ |F ẏ| dt` of it.
    whole: [f64; 2],
}

/// What is summed up over a time.
#[derive(Debug, Clone, Copy, Default)]
struct Amounts {
    /// `∫ F^n dt`.
    power: f64,
    /// `∫ F^(n−1) dt`, by which its error grows.
    slope: f64,
    /// `∫ F dt`.
    impulse: f64,
    /// `∫ F ẏ dt`.
    work: f64,
    /// `∫ |ẏ| dt`.
    way: f64,
}

impl Amounts {
    /// The sums over Gauss's points. `None` where the force is below `floor` at one of them.
    fn of<const K: usize>(
        (force, speed): (&[f64; K], &[f64; K]),
        weights: &[f64; K],
        power: Option<f64>,
        floor: f64,
    ) -> Option<Self> {
        let mut own = Self::default();
        for ((force, speed), weight) in force.iter().zip(speed).zip(weights) {
            if *force < floor {
                return None;
            }
            let force = force.max(0.0);
            own.impulse += weight * force;
            own.work += weight * force * speed;
            own.way += weight * speed.abs();
            if let Some(exponent) = power {
                let (power, slope) = raised(force, exponent);
                own.power += weight * power;
                own.slope += weight * slope;
            }
        }
        Some(own)
    }

    fn plus(self, other: Self) -> Self {
        Self {
            power: self.power + other.power,
            slope: self.slope + other.slope,
            impulse: self.impulse + other.impulse,
            work: self.work + other.work,
            way: self.way + other.way,
        }
    }
}

impl<const N: usize> Integrals<N> {
    pub(super) fn new(
        scene_point: &ScenePoint<'_, N>,
        wanted: Wanted,
        step: f64,
        speed: &[f64; N],
    ) -> Self {
        let rule = GaussLegendre::on_unit();
        let force_terms = terms(scene_point.force, scene_point.matrix);
        let needs_speed = wanted.work || wanted.work_at_end;
        let speed_terms =
            if needs_speed { terms(speed, scene_point.matrix) } else { [[0.0; N]; TERMS] };
        Self {
            wanted,
            step,
            rule,
            end_rule: GaussLegendre::on_unit(),
            force_at: rows(&force_terms, &rule.0, step),
            speed_at: if needs_speed {
                rows(&speed_terms, &rule.0, step)
            } else {
                [[0.0; GAUSS]; N]
            },
            force_terms,
            speed_terms,
            sure: Amounts::default(),
            last: Amounts::default(),
            before: *scene_point.start,
            whole: [0.0; 2],
        }
    }

    /// Adds a step from the state `z`: the first one, one in the midst, or the last one, which ends
    /// after a time and is taken together with the one before. `None` where the force pulls within, or
    /// the last step is one of the first two.
    pub(super) fn add(
        &mut self,
        scene_point: &ScenePoint<'_, N>,
        z: &[f64; N],
        at: u32,
        until: Option<f64>,
    ) -> Option<()> {
        let floor = -1e-9 * dot(&scene_point.force.map(f64::abs), &z.map(f64::abs));
        let amounts = match until {
            None if at > 0 => {
                let seen = (&apply(&self.force_at, z), &apply(&self.speed_at, z));
                let weights = self.rule.1.map(|own| own * self.step);
                Amounts::of(seen, &weights, self.wanted.power, floor)?
            }
            None => {
                let times = self.end_rule.0.map(|u| self.step * u * u);
                self.in_roots(z, &times, self.step, floor)?
            }
            Some(_) if at < 2 => return None,
            Some(time) => {
                let length = self.step + time;
                let times = self.end_rule.0.map(|u| length * (1.0 - u * u));
                self.last = Amounts::default();
                self.in_roots(&self.before, &times, length, floor)?
            }
        };
        self.sure = self.sure.plus(self.last);
        (self.last, self.before) = (amounts, *z);
        Some(())
    }

    /// The sums over a time in which the force is zero at one end, in the root of the time from there.
    fn in_roots(
        &self,
        z: &[f64; N],
        times: &[f64; ENDS],
        length: f64,
        floor: f64,
    ) -> Option<Amounts> {
        let (places, mut weights) = self.end_rule;
        for (weight, u) in weights.iter_mut().zip(places) {
            *weight *= 2.0 * u * length;
        }
        let seen = (&self.force_terms, &self.speed_terms);
        let [force, speed] = [seen.0, seen.1].map(|terms| {
            let own = terms.map(|row| dot(&row, z));
            times.map(|time| polynomial(&own, time))
        });
        Amounts::of((&force, &speed), &weights, self.wanted.power, floor)
    }

    /// Adds up the work from the state `z` at the beginning of a step to the end of the run, which lies so far ahead.
    pub(super) fn complete(&mut self, carry: &Square<N>, z: &[f64; N], ahead: f64) {
        let (mut state, mut left) = (*z, ahead);
        let work = self.sure.plus(self.last).work;
        self.whole = [work, work.abs()];
        while left > 0.0 {
            let (force, speed, length) = if left >= self.step {
                (apply(&self.force_at, &state), apply(&self.speed_at, &state), self.step)
            } else {
                let at = |terms: &[[f64; N]; TERMS]| {
                    let own = terms.map(|row| dot(&row, &state));
                    self.rule.0.map(|place| polynomial(&own, place * left))
                };
                (at(&self.force_terms), at(&self.speed_terms), left)
            };
            for at in 0..GAUSS {
                let power = force[at] * speed[at];
                self.whole[0] += self.rule.1[at] * length * power;
                self.whole[1] += self.rule.1[at] * length * power.abs();
            }
            state = apply(carry, &state);
            left -= self.step;
        }
    }

    /// What is known in the end of a run of the length `end`, where the force may be off by `force` and
    /// the rate by `speed`.
    pub(super) fn finish(&self, impact: &mut Impact, end: f64, force: f64, speed: f64) {
        let sum = self.sure.plus(self.last);
        let exponent = self.wanted.power.unwrap_or(1.0);
        let error = exponent * sum.slope * force + QUADRATURE * sum.power;
        impact.power = Figure { value: sum.power, error };
        let error = force * impact.release.value + QUADRATURE * sum.impulse;
        impact.impulse = Figure { value: sum.impulse, error };
        let size = impact.force.value * sum.way;
        let error = force * sum.way + speed * sum.impulse + QUADRATURE * size;
        impact.work = Figure { value: sum.work, error };
        // What is off at the end of the impact is so beyond it, by the time that passes.
        let error = error * (end / impact.release.value).max(1.0) + QUADRATURE * self.whole[1];
        impact.work_at_end = Figure { value: self.whole[0], error };
    }
}

/// Degree of the polynomials of a force: in steps of three times the shortest time they are right to rounding.
const DEGREE: usize = 15;

/// The force over time, as polynomials of the steps.
pub(super) struct Recorder<const N: usize> {
    step: f64,
    /// The coefficients over the state at the start of a step.
    rows: [[f64; DEGREE + 1]; N],
    pub(super) panels: Vec<Panel>,
}

impl<const N: usize> Recorder<N> {
    pub(super) fn new(scene_point: &ScenePoint<'_, N>, step: f64) -> Self {
        let nodes = Interpolation::of_degree(DEGREE);
        let places: [f64; DEGREE + 1] = std::array::from_fn(|at| 0.5 * (1.0 + nodes.nodes()[at]));
        let values = rows(&terms(scene_point.force, scene_point.matrix), &places, step);
        let of_state = |values: [f64; DEGREE + 1]| {
            let mut row = [0.0; DEGREE + 1];
            nodes.coefficients(&values, &mut row);
            row
        };
        Self { step, rows: values.map(of_state), panels: Vec::new() }
    }

    /// Adds a step from the state `z` at a time.
    pub(super) fn add(&mut self, z: &[f64; N], time: f64) {
        let coefficients = Coefficients::from(apply(&self.rows, z));
        self.panels.push(Panel { start: time, end: time + self.step, coefficients });
    }
}

/// `row · Aʲ/j!`.
fn terms<const N: usize>(row: &[f64; N], matrix: &Square<N>) -> [[f64; N]; TERMS] {
    let mut all = [*row; TERMS];
    for at in 1..TERMS {
        let factor = 1.0 / at as f64;
        all[at] = apply_left(&all[at - 1], matrix).map(|own| own * factor);
    }
    all
}

/// The rows at these places of a step.
fn rows<const K: usize, const N: usize>(
    terms: &[[f64; N]; TERMS],
    places: &[f64; K],
    step: f64,
) -> [[f64; K]; N] {
    let mut all = [[0.0; K]; N];
    for (place, share) in places.iter().enumerate() {
        let time = share * step;
        for (at, own) in all.iter_mut().enumerate() {
            own[place] = terms.iter().rev().fold(0.0, |sum, row| sum * time + row[at]);
        }
    }
    all
}

fn polynomial(coefficients: &[f64; TERMS], time: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, own| sum * time + own)
}
