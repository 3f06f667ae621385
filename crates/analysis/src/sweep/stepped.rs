//! The impact of one scene whose laws are not all linear, by explicit steps of order 8.
//!
//! Each step hands on polynomials of the force, the deformation and its rate, until the force falls through
//! zero. Everything else is read off these, and how far it may be off from a second solution at a coarser
//! tolerance.

use dashpot_dae::{Extremum, Panel, Signal};
use dashpot_network::{CurveRow, Instance};
use dashpot_numerics::{
    chebyshev::Interpolation,
    dop853::{DEGREE, Step},
    small::{apply, apply_left, dot},
};

/// The first step in parts of the time in which the unknowns change by themselves.
const FIRST: f64 = 0.01;
/// Part of the step that the estimate of its error allows which is taken.
const SAFETY: f64 = 0.9;
/// What a step may be longer and shorter by than the one before.
const GROWTH: (f64, f64) = (0.2, 6.0);
/// Steps, with those that were rejected, after which a scene is left to other methods.
const MOST: usize = 2000;
/// By what part of itself the last step goes beyond the release, at most twice that.
const OVERSHOOT: f64 = 0.02;
/// A law may be stretched beyond its range by this part of it.
const BEYOND: f64 = 1e-6;

/// What a solution shows of an impact, over dimensionless time.
#[derive(Debug, Clone)]
pub(super) struct Course {
    /// The force \[N\], from the start to the release.
    pub(super) force: Signal,
    /// The rate of the deformation \[m/s\].
    pub(super) speed: Signal,
    /// When the force falls through zero.
    pub(super) release: f64,
    /// The largest force up to then …
    pub(super) strongest: Extremum,
    /// … and the largest deformation \[m\].
    pub(super) deepest: Extremum,
}

/// A scene to be followed up to the dimensionless time `end`.
pub(super) struct Stepped<'s, const N: usize> {
    pub(super) instance: &'s Instance<N>,
    /// How many unknowns stand before the slots.
    pub(super) unknowns: usize,
    pub(super) end: f64,
}

/// What is looked at: force, deformation and its rate, over the unknowns and slots.
type Looks<const N: usize> = [[f64; 3]; N];

impl<const N: usize> Stepped<'_, N> {
    /// Follows it at a relative tolerance. `None` where the impact is not of the plain kind: the force does not
    /// push from the start, or does not fall through zero within the run; and where a law leaves its range,
    /// or the steps are too many.
    pub(super) fn follow(&self, rtol: f64) -> Option<Course> {
        let Instance { matrix, start, curves, .. } = self.instance;
        let mut slopes = |z: &[f64; N]| apply(matrix, &filled(curves, z));
        let looks = self.looks();
        let mut step = Step::from(*start, &mut slopes);
        let mut most = start.map(f64::abs);
        let (mut length, mut time) = (self.first_step(step.first_slopes()), 0.0);
        let mut course: [Vec<Panel>; 3] = Default::default();
        let mut strongest = 0.0_f64;
        if self.end.is_nan() || self.end <= 0.0 {
            return None;
        }
        for _ in 0..MOST {
            length = length.min(self.end - time);
            step.attempt(length, &mut slopes);
            let unit = |at: usize, size: f64| {
                if at < self.unknowns { rtol * size.max(most[at]) } else { 0.0 }
            };
            let mut error = step.error(unit);
            let mut seen = Seen::default();
            if error <= 1.0 {
                step.fit(&mut slopes);
                seen = Seen::of(&step, curves, &looks);
                let force = &seen.coefficients[0];
                strongest = strongest.max(force[0].abs());
                error = error.max(force[DEGREE].abs() / (rtol * strongest));
            }
            let factor = if error.is_finite() {
                (SAFETY * error.powf(-0.125)).clamp(GROWTH.0, GROWTH.1)
            } else {
                GROWTH.0
            };
            if error.is_nan() || error > 1.0 {
                length *= factor.min(SAFETY);
                continue;
            }
            // Beyond the release laws may have kinks that the step would smear.
            let until = seen.release(length);
            let is_far = |until: &f64| *until > 0.0 && until * (1.0 + 2.0 * OVERSHOOT) < length;
            if let Some(until) = until.filter(is_far) {
                length = until * (1.0 + OVERSHOOT);
                continue;
            }
            if seen.is_beyond || until.is_some_and(|until| until <= 0.0) {
                return None;
            }
            for (panels, coefficients) in course.iter_mut().zip(seen.coefficients) {
                let coefficients = coefficients.into();
                panels.push(Panel { start: time, end: time + length, coefficients });
            }
            if until.is_some() {
                return released(course);
            }
            time += length;
            if time.is_nan() || time >= self.end {
                return None;
            }
            most.iter_mut().zip(step.end()).for_each(|(most, own)| *most = most.max(own.abs()));
            length *= factor;
            step.go_on();
        }
        None
    }

    fn looks(&self) -> Looks<N> {
        let Instance { matrix, force, deformation, .. } = self.instance;
        let speed = apply_left(deformation, matrix);
        std::array::from_fn(|at| [force[at], deformation[at], speed[at]])
    }

    /// A first step that is short beside the time in which the unknowns change.
    fn first_step(&self, slopes: &[f64; N]) -> f64 {
        let sum = |own: &[f64; N]| own[..self.unknowns].iter().map(|own| own.abs()).sum::<f64>();
        (FIRST * sum(&self.instance.start) / sum(slopes)).min(self.end)
    }
}

/// The unknowns, with the forces of the laws in their slots.
#[inline]
fn filled<const N: usize>(curves: &[CurveRow<N>], z: &[f64; N]) -> [f64; N] {
    let mut all = *z;
    for curve in curves {
        let force = curve.law.force(dot(&curve.deformation, z), dot(&curve.rate, z));
        all[curve.slot] = force;
    }
    all
}

/// What a step shows.
#[derive(Debug, Default)]
struct Seen {
    /// The polynomials of what is looked at.
    coefficients: [[f64; DEGREE + 1]; 3],
    /// The force at the places that they pass through.
    force: [f64; DEGREE + 1],
    /// Whether a law is followed beyond where it holds.
    is_beyond: bool,
}

impl Seen {
    fn of<const N: usize>(step: &Step<N>, curves: &[CurveRow<N>], looks: &Looks<N>) -> Self {
        let nodes = Interpolation::of_degree(DEGREE);
        let (mut values, mut is_beyond) = ([[0.0; DEGREE + 1]; 3], false);
        for (at, &node) in nodes.nodes().iter().enumerate() {
            let z = filled(curves, &step.at(0.5 * (1.0 + node)));
            let own = apply(looks, &z);
            (0..3).for_each(|look| values[look][at] = own[look]);
            is_beyond |= curves.iter().any(|curve| is_outside(curve, &z));
        }
        let coefficients = values.map(|values| {
            let mut own = [0.0; DEGREE + 1];
            nodes.coefficients(&values, &mut own);
            own
        });
        Self { coefficients, force: values[0], is_beyond }
    }

    /// When the force falls through zero in a step of this length, as far as its places tell; at the very start
    /// of the first one it may be zero.
    fn release(&self, length: f64) -> Option<f64> {
        let at = 1 + self.force[1..].iter().position(|force| *force <= 0.0)?;
        let nodes = Interpolation::of_degree(DEGREE);
        let place = |at: usize| 0.5 * (1.0 + nodes.nodes()[at]);
        let (before, after) = (self.force[at - 1], self.force[at]);
        let part = if before > after { before / (before - after) } else { 0.0 };
        Some(length * (place(at - 1) + part * (place(at) - place(at - 1))))
    }
}

/// Whether a law does not hold where it is.
fn is_outside<const N: usize>(curve: &CurveRow<N>, z: &[f64; N]) -> bool {
    let place = dot(&curve.deformation, z);
    curve.law.range().is_some_and(|(from, to)| {
        let room = if from.is_finite() { BEYOND * (to - from) } else { 0.0 };
        place < from - room || place > to
    })
}

/// The course up to the release, which lies in the last panel.
fn released([force, depth, speed]: [Vec<Panel>; 3]) -> Option<Course> {
    let [force, depth, speed] = [force, depth, speed].map(|panels| Signal::new(panels, None, 0.0));
    let release = force.first_crossing(0.0, (0.0, force.end()), Some(false))?.time;
    let (strongest, deepest) = (force.maximum((0.0, release)), depth.maximum((0.0, release)));
    (release > 0.0).then_some(Course { force, speed, release, strongest, deepest })
}
