//! The impact of one scene whose laws are not all linear, by explicit steps of order 8.
//!
//! Each step hands on polynomials of the force, the deformation and its rate, until the force falls through
//! zero, and the unknowns at the nodes of these. Everything else is read off them, and how far it may be off from
//! a second solution at a coarser tolerance.

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
    end: f64,
    pub(crate) values: [[f64; N]; DEGREE + 1],
}

impl<const N: usize> Nodes<N> {
    fn of(step: &Step<N>, (start, end): (f64, f64), instance: &Instance<N>) -> Self {
        let nodes = Interpolation::of_degree(DEGREE);
        let place = |at: usize| 0.5 * (1.0 + nodes.nodes()[at]);
        let mut values = [[0.0; N]; DEGREE + 1];
        for (at, own) in values.iter_mut().enumerate() {
            *own = instance.completed(&step.at(place(at)));
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

    pub(crate) fn end(&self) -> f64 {
        self.end
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

    /// The polynomial of what is looked at over it.
    pub(crate) fn panel(&self, look: &dyn Fn(&[f64; N]) -> f64) -> Panel {
        let (mut values, mut own) = ([0.0; DEGREE + 1], [0.0; DEGREE + 1]);
        values.iter_mut().zip(&self.values).for_each(|(own, z)| *own = look(z));
        Interpolation::of_degree(DEGREE).coefficients(&values, &mut own);
        Panel { start: self.start, end: self.end, coefficients: own.into() }
    }
}

/// The steps of a solution, over dimensionless time.
#[derive(Debug, Clone)]
pub(crate) struct Track<const N: usize> {
    pub(crate) steps: Vec<Nodes<N>>,
    /// The sum of the [defects](Nodes::defect) of its steps.
    defect: f64,
    /// The largest last coefficient of the force in a step \[N\].
    truncation: f64,
}

impl<const N: usize> Track<N> {
    fn new() -> Self {
        Self { steps: Vec::new(), defect: 0.0, truncation: 0.0 }
    }

    /// The unknowns at a time in the last step.
    pub(crate) fn late(&self, time: f64) -> Option<[f64; N]> {
        let last = self.steps.last()?;
        let mut all = [0.0; N];
        for (at, own) in all.iter_mut().enumerate() {
            *own = last.panel(&|z| z[at]).value(time);
        }
        Some(all)
    }
}

/// What a solution shows of an impact, over dimensionless time.
#[derive(Debug, Clone)]
pub(crate) struct Course<const N: usize> {
    /// The steps, of which the last one goes beyond the release.
    pub(crate) track: Track<N>,
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
        let Self { track, strongest, .. } = self;
        SAFE * track.defect * self.sensitivity().max(1.0) + track.truncation / strongest.value
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
        let mut slopes = self.slopes();
        let looks = self.looks();
        let mut step = Step::from(*start, &mut slopes);
        let mut most = start.map(f64::abs);
        let (mut length, mut time) = (self.first_step(start, step.first_slopes()), 0.0);
        let mut course: [Vec<Panel>; 3] = Default::default();
        let mut track = Track::new();
        let mut strongest = 0.0_f64;
        if self.end.is_nan() || self.end <= 0.0 {
            return None;
        }
        for _ in 0..MOST {
            length = length.min(self.end - time);
            step.attempt(length, &mut slopes);
            let mut error = step.error(self.unit(rtol, &most));
            let mut seen = Seen::default();
            let mut nodes = None;
            let (mut defect, mut truncation) = (0.0, 0.0_f64);
            if error <= 1.0 {
                step.fit(&mut slopes);
                let own = Nodes::of(&step, (time, time + length), self.instance);
                seen = Seen::of(&own, &looks);
                let force = &seen.coefficients[0];
                strongest = strongest.max(force[0].abs());
                truncation = force[DEGREE].abs();
                defect = own.defect(self.instance, self.unit(1.0, &most));
                error = error.max(truncation / (rtol * strongest)).max(defect / rtol);
                nodes = Some(own);
            }
            let factor = factor(error);
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
            // What strikes is gone behind the release, however far the step reaches.
            let held = until.map_or(time + length, |until| time + until.min(length));
            let is_beyond = nodes.as_ref().is_some_and(|own| own.leave(curves, held));
            if is_beyond || until.is_some_and(|until| until <= 0.0) {
                return None;
            }
            for (panels, coefficients) in course.iter_mut().zip(seen.coefficients) {
                let coefficients = coefficients.into();
                panels.push(Panel { start: time, end: time + length, coefficients });
            }
            track.steps.extend(nodes);
            track.defect += defect;
            track.truncation = track.truncation.max(truncation);
            if until.is_some() {
                return released(course, track);
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

    /// Follows it from some unknowns on, without looking at its force, up to its end or until it `is_over`.
    /// `None` where the steps are too many.
    pub(crate) fn settle(
        &self,
        from: &[f64; N],
        rtol: f64,
        is_over: &dyn Fn(&Nodes<N>) -> bool,
    ) -> Option<Track<N>> {
        let mut slopes = self.slopes();
        let mut step = Step::from(*from, &mut slopes);
        let mut most = from.map(f64::abs);
        let (mut length, mut time) = (self.first_step(from, step.first_slopes()), 0.0_f64);
        let mut track = Track::new();
        for _ in 0..MOST {
            if time.is_nan() || time >= self.end {
                return Some(track);
            }
            length = length.min(self.end - time);
            step.attempt(length, &mut slopes);
            let error = step.error(self.unit(rtol, &most));
            let factor = factor(error);
            if error.is_nan() || error > 1.0 {
                length *= factor.min(SAFETY);
                continue;
            }
            step.fit(&mut slopes);
            let end = if length < self.end - time { time + length } else { self.end };
            let nodes = Nodes::of(&step, (time, end), self.instance);
            let is_last = is_over(&nodes);
            track.steps.push(nodes);
            if is_last {
                return Some(track);
            }
            time = end;
            most.iter_mut().zip(step.end()).for_each(|(most, own)| *most = most.max(own.abs()));
            length *= factor;
            step.go_on();
        }
        None
    }

    /// How fast the unknowns change.
    fn slopes(&self) -> impl FnMut(&[f64; N]) -> [f64; N] {
        let instance = self.instance;
        move |z| apply(&instance.matrix, &instance.completed(z))
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

/// What the next step may be longer by than one of this error.
fn factor(error: f64) -> f64 {
    if error.is_finite() {
        (SAFETY * error.powf(-0.125)).clamp(GROWTH.0, GROWTH.1)
    } else {
        GROWTH.0
    }
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

    /// The first of the places at which the force no longer pushes; at the very start it may be zero.
    fn opening(&self) -> Option<usize> {
        Some(1 + self.force[1..].iter().position(|force| *force <= 0.0)?)
    }

    /// When the force falls through zero in a step of this length, as far as its places tell.
    fn release(&self, length: f64) -> Option<f64> {
        let at = self.opening()?;
        let nodes = Interpolation::of_degree(DEGREE);
        let place = |at: usize| 0.5 * (1.0 + nodes.nodes()[at]);
        let (before, after) = (self.force[at - 1], self.force[at]);
        let part = if before > after { before / (before - after) } else { 0.0 };
        Some(length * (place(at - 1) + part * (place(at) - place(at - 1))))
    }
}

/// The course up to the release, which lies in the last panel.
fn released<const N: usize>(
    [force, depth, speed]: [Vec<Panel>; 3],
    track: Track<N>,
) -> Option<Course<N>> {
    let [force, depth, speed] = [force, depth, speed].map(|panels| Signal::new(panels, None, 0.0));
    let release = force.first_crossing(0.0, (0.0, force.end()), Some(false))?.time;
    let (strongest, deepest) = (force.maximum((0.0, release)), depth.maximum((0.0, release)));
    let course = Course { track, force, speed, release, strongest, deepest };
    (release > 0.0 && !course.lingers()).then_some(course)
}
