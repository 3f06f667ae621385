//! The impact of one scene whose laws are not all linear, by explicit steps of order 8.
//!
//! Each step hands on polynomials of the force, the deformation and its rate, until the force falls through
//! zero, and the unknowns at the nodes of these. Everything else is read off them, and how far it may be off from
//! a second solution at a coarser tolerance.

use std::convert::Infallible;

use dashpot_dae::{Extremum, Panel, Signal};
use dashpot_network::{CurveRow, Instance};
use dashpot_numerics::{
    chebyshev::Interpolation,
    dop853::{Controller, DEGREE, Step},
    small::{apply, apply_left, dot},
};

/// The first step in parts of the time in which the unknowns change by themselves.
const FIRST: f64 = 0.01;
/// Steps, with those that were rejected, after which a scene is left to other methods.
const MOST: usize = 2000;
/// By what part of itself the last step goes beyond the release, at most twice that.
const OVERSHOOT: f64 = 0.02;
/// Part of the largest force below which one that does not fall on for good may have ended the impact.
const SLIGHT: f64 = 1e-2;
/// Errors are taken for so many times the defects of the steps.
const SAFE: f64 = 3.0;
/// A law may be stretched beyond its range by this part of it.
const BEYOND: f64 = 1e-6;
/// A polynomial goes no further beyond what it is at the nodes than this part of the room between these values.
const BETWEEN: f64 = 0.25;

/// The unknowns, and what stands in their slots, at the nodes of a step.
#[derive(Debug, Clone)]
pub(crate) struct Nodes<const N: usize> {
    start: f64,
    pub(crate) end: f64,
    pub(crate) values: [[f64; N]; DEGREE + 1],
}

impl<const N: usize> Nodes<N> {
    fn of(step: &Step<[f64; N]>, (start, end): (f64, f64), instance: &Instance<N>) -> Self {
        let nodes = Interpolation::of_degree(DEGREE);
        let place = |at: usize| 0.5 * (1.0 + nodes.nodes()[at]);
        let mut values = [[0.0; N]; DEGREE + 1];
        for (at, own) in values.iter_mut().enumerate() {
            step.look(place(at), own);
            *own = instance.completed(own);
        }
        Self { start, end, values }
    }

    /// The integrated defect of the step: by how much the unknowns at its nodes differ at most from the integral of their
    /// slopes there, each in the unit that is given of its number and magnitude. These slopes are not those that the step
    /// was made of, so it tells of what these have missed.
    fn defect(&self, instance: &Instance<N>, unit: impl Fn(usize, f64) -> f64) -> f64 {
        let mut sums = [[0.0; N]; DEGREE + 1];
        let half = 0.5 * (self.end - self.start);
        let nodes = Interpolation::of_degree(DEGREE);
        for (z, weights) in self.values.iter().zip(nodes.integrals()) {
            let slopes = apply(&instance.matrix, z);
            for (sum, weight) in sums.iter_mut().zip(weights) {
                sum.iter_mut().zip(&slopes).for_each(|(sum, slope)| *sum += weight * slope);
            }
        }
        let [first, .., last] = &self.values;
        let relative = |at: usize| {
            let unit = unit(at, first[at].abs().max(last[at].abs()));
            let off = |(sum, z): (&[f64; N], &[f64; N])| (first[at] + half * sum[at] - z[at]).abs();
            let most = sums.iter().zip(&self.values).map(off).fold(0.0, f64::max);
            if unit > 0.0 { most / unit } else { 0.0 }
        };
        (0..N).map(relative).fold(0.0, f64::max)
    }

    /// Whether a law is pressed beyond where it holds, up to a time within.
    pub(crate) fn leave(&self, curves: &[CurveRow<N>], until: f64) -> bool {
        curves.iter().any(|curve| {
            let Some((from, to)) = curve.law.range() else { return false };
            let places = self.values.map(|z| dot(&curve.deformation, &z));
            let [low, high] = [f64::min, f64::max].map(|most| places.into_iter().reduce(most));
            let (low, high) = (low.unwrap_or(from), high.unwrap_or(to));
            let from = from - if from.is_finite() { BEYOND * (to - from) } else { 0.0 };
            let between = BETWEEN * (high - low);
            if low - between >= from && high + between <= to {
                return false;
            }
            let path = Signal::new(vec![self.panel(&|z| dot(&curve.deformation, z))], None, 0.0);
            let window = (self.start, until);
            path.minimum(window).value < from || path.maximum(window).value > to
        })
    }

    /// The unknowns at a time within.
    pub(crate) fn at(&self, time: f64) -> [f64; N] {
        std::array::from_fn(|at| self.panel(&|z| z[at]).value(time))
    }

    /// The polynomial of what is looked at over it.
    pub(crate) fn panel(&self, look: &dyn Fn(&[f64; N]) -> f64) -> Panel {
        let (mut values, mut own) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        values.iter_mut().zip(&self.values).for_each(|(own, z)| *own = look(z));
        Interpolation::of_degree(DEGREE).coefficients(&values, &mut own);
        Panel { start: self.start, end: self.end, coefficients: own.into() }
    }
}

/// What a solution shows of an impact, over dimensionless time.
#[derive(Debug, Clone)]
pub(crate) struct Course<const N: usize> {
    /// The last step, which goes beyond the release.
    pub(crate) last: Nodes<N>,
    /// The sum of the [defects](Nodes::defect) of its steps.
    defect: f64,
    /// The largest last coefficient of the force in a step \[N\].
    truncation: f64,
    /// The force \[N\], from the start to the release.
    pub(crate) force: Signal,
    /// The rate of the deformation \[m/s\].
    pub(crate) speed: Signal,
    /// When the force falls through zero.
    pub(crate) release: f64,
    /// The largest force up to then …
    pub(crate) strongest: Extremum,
    /// … and the largest deformation \[m\].
    pub(crate) deepest: Extremum,
}

impl<const N: usize> Course<N> {
    /// An estimate of the relative error of forces, deformations, speeds and times that are read off it, from the defects
    /// of its steps.
    pub(crate) fn relative_error(&self) -> f64 {
        SAFE * self.defect * self.sensitivity().max(1.0) + self.truncation / self.strongest.value
    }

    /// The relative change of the largest force over that of the speed at the start. Where energy is kept this is `v₀² |F̈| / (F ÿ²)` at the peak: 1 for a linear spring, less on a plateau, more where it stiffens.
    fn sensitivity(&self) -> f64 {
        let Self { force, speed, strongest: peak, .. } = self;
        let bend = force.panels[force.panel_at(peak.time)].derivative().slope(peak.time);
        (speed.value(0.0) / speed.slope(peak.time)).powi(2) * bend.abs() / peak.value
    }

    /// Whether the force comes so near to zero, and goes on, that the impact may have ended there.
    fn lingers(&self) -> bool {
        let slight = SLIGHT * self.strongest.value;
        let (mut has_risen, mut before) = (false, f64::INFINITY);
        for panel in &self.force.panels {
            for place in [-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0] {
                let time = panel.time(place);
                if time > self.release {
                    return false;
                }
                let force = panel.value(time);
                has_risen |= force > slight;
                if has_risen && before < slight && force > before {
                    return true;
                }
                before = if has_risen { force } else { f64::INFINITY };
            }
        }
        false
    }
}

/// A scene to be followed up to the dimensionless time `end`.
pub(crate) struct Stepped<'s, const N: usize> {
    pub(crate) instance: &'s Instance<N>,
    /// How many unknowns stand before the slots.
    pub(crate) unknowns: usize,
    pub(crate) end: f64,
}

/// What is looked at: force, deformation and its rate, over the unknowns and slots.
type Looks<const N: usize> = [[f64; 3]; N];

impl<const N: usize> Stepped<'_, N> {
    /// Follows it at a relative tolerance. `None` where the impact is not of the plain kind: the force does not
    /// push from the start, lingers near zero, or does not fall through it within the run; and where a law leaves its
    /// range, or the steps are too many.
    pub(crate) fn follow(&self, rtol: f64) -> Option<Course<N>> {
        let Instance { start, curves, .. } = self.instance;
        let looks = self.looks();
        let mut paths: [Vec<Panel>; 3] = Default::default();
        let (mut strongest, mut defect, mut truncation) = (0.0_f64, 0.0, 0.0_f64);
        let mut last = None;
        self.steps(start, rtol, &mut |nodes, most| {
            let seen = Seen::of(&nodes, &looks);
            let force = &seen.coefficients[0];
            strongest = strongest.max(force[0].abs());
            let cut = force[DEGREE].abs();
            let off = nodes.defect(self.instance, self.unit(1.0, most));
            let error = (cut / (rtol * strongest)).max(off / rtol);
            if error > 1.0 {
                return Some(Next::GoOn(error));
            }
            // Beyond the release laws may have kinks that the step would smear.
            let part = seen.release();
            let is_far = |part: &f64| *part > 0.0 && part * (1.0 + 2.0 * OVERSHOOT) < 1.0;
            if let Some(part) = part.filter(is_far) {
                return Some(Next::Shorter(part * (1.0 + OVERSHOOT)));
            }
            // What strikes is gone behind the release, however far the step reaches.
            let Nodes { start, end, .. } = nodes;
            let held = part.map_or(end, |part| start + part.min(1.0) * (end - start));
            if nodes.leave(curves, held) || part.is_some_and(|part| part <= 0.0) {
                return None;
            }
            for (panels, coefficients) in paths.iter_mut().zip(seen.coefficients) {
                panels.push(Panel { start, end, coefficients: coefficients.into() });
            }
            defect += off;
            truncation = truncation.max(cut);
            if part.is_some() {
                last = Some(nodes);
                return Some(Next::Over);
            }
            Some(Next::GoOn(error))
        })?;
        let last = last?;
        let [force, depth, speed] = paths.map(|panels| Signal::new(panels, None, 0.0));
        let release = force.first_crossing(0.0, (0.0, force.end()), Some(false))?.time;
        let (strongest, deepest) = (force.maximum((0.0, release)), depth.maximum((0.0, release)));
        let course = Course { last, defect, truncation, force, speed, release, strongest, deepest };
        (release > 0.0 && !course.lingers()).then_some(course)
    }

    /// Follows it from some unknowns on, without looking at its force, up to its end or until it `is_over`: its steps.
    /// `None` where they are too many.
    pub(crate) fn settle(
        &self,
        from: &[f64; N],
        rtol: f64,
        is_over: &dyn Fn(&Nodes<N>) -> bool,
    ) -> Option<Vec<Nodes<N>>> {
        let mut all = Vec::new();
        self.steps(from, rtol, &mut |nodes, _| {
            let is_last = is_over(&nodes);
            all.push(nodes);
            Some(if is_last { Next::Over } else { Next::GoOn(0.0) })
        })?;
        Some(all)
    }

    /// Takes steps from some unknowns on up to its end, or as `take` tells of each, which is also shown the largest magnitudes
    /// before it. `None` where they are too many, or `take` gives up.
    fn steps(
        &self,
        from: &[f64; N],
        rtol: f64,
        take: &mut dyn FnMut(Nodes<N>, &[f64; N]) -> Option<Next>,
    ) -> Option<()> {
        let instance = self.instance;
        let mut slopes = |_: f64, z: &[f64; N], own: &mut [f64; N]| {
            *own = apply(&instance.matrix, &instance.completed(z));
            Ok::<(), Infallible>(())
        };
        let mut step = Step::new(*from);
        let Ok(()) = step.begin(&mut slopes);
        let (mut controller, mut most) = (Controller::default(), from.map(f64::abs));
        let (mut length, mut time) = (self.first_step(from, &step.slopes()[0]), 0.0_f64);
        for _ in 0..MOST {
            let left = self.end - time;
            if left.is_nan() || left <= 0.0 {
                return (left <= 0.0).then_some(());
            }
            length = length.min(left);
            let Ok(()) = step.attempt(length, &mut slopes);
            let mut error = step.error(1.0, self.unit(rtol, &most));
            let end = if length < left { time + length } else { self.end };
            if error <= 1.0 {
                let Ok(()) = step.close(&mut slopes);
                let Ok(()) = step.fit(&mut slopes);
                match take(Nodes::of(&step, (time, end), instance), &most)? {
                    Next::GoOn(own) => error = error.max(own),
                    Next::Shorter(part) => {
                        length *= part;
                        continue;
                    }
                    Next::Over => return Some(()),
                }
            }
            length *= controller.factor(error);
            if error <= 1.0 {
                time = end;
                most.iter_mut().zip(step.end()).for_each(|(most, own)| *most = most.max(own.abs()));
                step.go_on();
            }
        }
        None
    }

    /// What errors of an unknown are counted in.
    fn unit(&self, rtol: f64, most: &[f64; N]) -> impl Fn(usize, f64) -> f64 {
        let unknowns = self.unknowns;
        move |at, size| if at < unknowns { rtol * size.max(most[at]) } else { 0.0 }
    }

    fn looks(&self) -> Looks<N> {
        let Instance { matrix, force, deformation, .. } = self.instance;
        let speed = apply_left(deformation, matrix);
        std::array::from_fn(|at| [force[at], deformation[at], speed[at]])
    }

    /// A first step that is short beside the time in which the unknowns change.
    fn first_step(&self, from: &[f64; N], slopes: &[f64; N]) -> f64 {
        let sum = |own: &[f64; N]| own[..self.unknowns].iter().map(|own| own.abs()).sum::<f64>();
        (FIRST * sum(from) / sum(slopes)).min(self.end)
    }
}

/// What comes behind a step.
enum Next {
    /// The next one, where its error, in parts of what it may be, is not too large.
    GoOn(f64),
    /// A shorter one in its place, by this factor.
    Shorter(f64),
    /// None.
    Over,
}

/// What a step shows.
#[derive(Debug, Default)]
struct Seen {
    /// The polynomials of what is looked at.
    coefficients: [[f64; DEGREE + 1]; 3],
    /// The force at the places that they pass through.
    force: [f64; DEGREE + 1],
}

impl Seen {
    fn of<const N: usize>(nodes: &Nodes<N>, looks: &Looks<N>) -> Self {
        let mut values = [[0.0; DEGREE + 1]; 3];
        for (at, z) in nodes.values.iter().enumerate() {
            let own = apply(looks, z);
            (0..3).for_each(|look| values[look][at] = own[look]);
        }
        let interpolation = Interpolation::of_degree(DEGREE);
        let coefficients = values.map(|values| {
            let mut own = [0.0; DEGREE + 1];
            interpolation.coefficients(&values, &mut own);
            own
        });
        Self { coefficients, force: values[0] }
    }

    /// At which part of the step the force falls through zero, as far as its places tell.
    fn release(&self) -> Option<f64> {
        // At the very start it may be zero.
        let at = 1 + self.force[1..].iter().position(|force| *force <= 0.0)?;
        let nodes = Interpolation::of_degree(DEGREE);
        let place = |at: usize| 0.5 * (1.0 + nodes.nodes()[at]);
        let (before, after) = (self.force[at - 1], self.force[at]);
        let part = if before > after { before / (before - after) } else { 0.0 };
        Some(place(at - 1) + part * (place(at) - place(at - 1)))
    }
}
