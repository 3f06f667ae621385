//! What columns show of an impact, and how it is read off a solution.

use dashpot_network::{
    ParametricSystem,
    parameters::{Value, WindowWish},
};

use super::{
    instantiated::Plan,
    report::Notice,
    scene_point::{Figure, Impact, Wanted},
    stepped::Course,
    sums::power_of,
    table::Besides,
};
use crate::{
    Compression,
    measures::{
        STANDARD_GRAVITY,
        hic_search::{optimum, optimum_of_hump},
        selection::Selected,
    },
};

/// What a column shows of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shown {
    Force,
    Depth,
    Share,
    Acceleration,
    ContactTime,
    Restitution,
    Impulse,
    Work,
    WorkAtEnd,
    Severity,
    /// Over intervals of at most so many seconds.
    Hic(f64),
}

impl Shown {
    /// What the accuracy of a value is counted in parts of.
    pub(super) fn size(self, value: f64) -> f64 {
        match self {
            Self::Restitution => 1.0,
            _ => value.abs(),
        }
    }
}

/// The figure that is a measure; `None` where it has to be read off the full solution.
pub(super) fn shown_by(
    selected: &Selected,
    parametric: &ParametricSystem,
    wanted: &mut Wanted,
) -> Option<Shown> {
    let mut numbers = Vec::new();
    let general = selected.measure.general();
    let measure = general.as_ref().unwrap_or(&selected.measure);
    for value in measure.values() {
        match value {
            Value::Window(WindowWish::Impact) => {}
            Value::Number(number) => numbers.push(number),
            _ => return None,
        }
    }
    let target = match selected.measure.kind() {
        "peak-force"
        | "peak-deformation"
        | "peak-strain"
        | "contact-time"
        | "impulse"
        | "energy"
        | "energy-at-end"
        | "coefficient-of-restitution" => parametric.element(),
        _ => parametric.impactor().index(),
    };
    if selected.target != target {
        return None;
    }
    match (measure.kind(), numbers.as_slice()) {
        ("peak-force", []) => Some(Shown::Force),
        ("peak-deformation", []) => Some(Shown::Depth),
        ("peak-acceleration", []) => Some(Shown::Acceleration),
        ("contact-time", []) => Some(Shown::ContactTime),
        ("coefficient-of-restitution", []) => Some(Shown::Restitution),
        ("impulse", []) => {
            wanted.work = true;
            Some(Shown::Impulse)
        }
        ("energy", []) => {
            wanted.work = true;
            Some(Shown::Work)
        }
        // What happens after the impact is another story where it parts, or is not linear.
        ("energy-at-end", []) if parametric.is_linear() && !parametric.opens() => {
            wanted.work_at_end = true;
            Some(Shown::WorkAtEnd)
        }
        ("peak-strain", []) => Some(Shown::Share),
        ("hic", &[cap]) => {
            wanted.course = true;
            Some(Shown::Hic(cap))
        }
        // Below one, a power is too steep where the force is zero.
        ("severity-index", &[exponent])
            if exponent >= 1.0
                && wanted.power.is_none_or(|power| power.to_bits() == exponent.to_bits()) =>
        {
            wanted.power = Some(exponent);
            Some(Shown::Severity)
        }
        _ => None,
    }
}

impl Plan<'_> {
    /// What is to be said of an impact whose largest deformation \[m\], with its error, is reached so long \[s\]
    /// after the touch, and whose force falls through zero so long after it.
    pub(super) fn notice(
        &self,
        (depth, deepest): (Figure, f64),
        release: f64,
        numbers: &[f64],
    ) -> Notice {
        let Besides { thickness, fall, .. } = Besides::of(numbers);
        let is_glued = !self.parametric.opens();
        let [deepest, release] = [deepest, release].map(|own| fall + own);
        let compression = Compression::new([depth.value, deepest], Some(depth.error), thickness);
        Notice {
            pulls: (is_glued && release < self.duration).then_some(release),
            pressed: Some(compression).filter(Compression::is_through),
        }
    }

    /// How long a run with these numbers goes on after the touch, dimensionless.
    pub(super) fn end(&self, numbers: &[f64]) -> f64 {
        (self.duration - Besides::of(numbers).fall) / self.parametric.time_scale()
    }

    pub(super) fn figure(&self, shown: Shown, impact: &Impact, numbers: &[f64]) -> Figure {
        let time = self.parametric.time_scale();
        let mass = self.parametric.impactor_mass(numbers);
        let thickness = Besides::of(numbers).thickness;
        let times = |own: Figure, factor: f64| Figure {
            value: own.value * factor,
            error: own.error * factor,
        };
        match shown {
            Shown::Force => impact.force,
            Shown::Depth => impact.depth,
            Shown::Share => times(impact.depth, thickness.recip()),
            Shown::Acceleration => times(impact.force, mass.recip()),
            Shown::ContactTime => times(impact.release, time),
            Shown::Restitution => impact.restitution,
            Shown::Impulse => times(impact.impulse, time),
            Shown::Work => impact.work,
            Shown::WorkAtEnd => impact.work_at_end,
            Shown::Severity => {
                let exponent = self.wanted.power.unwrap_or(1.0);
                times(impact.power, time / (mass * STANDARD_GRAVITY).powf(exponent))
            }
            Shown::Hic(cap) => {
                let Some(force) = &impact.course else { return Figure::UNKNOWN };
                let unit = mass * STANDARD_GRAVITY;
                let (window, cap) = ((0.0, impact.release.value), cap / time);
                let found = match impact.top {
                    Some(top) => optimum_of_hump(force, window, top, cap),
                    None => optimum(force, window, cap),
                };
                let length = found.interval.1 - found.interval.0;
                let growth = 2.5 * (found.value / length).powf(0.6) * length;
                let error = growth * impact.force.error + found.threshold;
                times(Figure { value: found.value, error }, time / unit.powf(2.5))
            }
        }
    }

    /// The same of a solution in steps.
    fn read(&self, shown: Shown, course: &Course, numbers: &[f64]) -> f64 {
        let time = self.parametric.time_scale();
        let unit = self.parametric.impactor_mass(numbers) * STANDARD_GRAVITY;
        let thickness = Besides::of(numbers).thickness;
        let Course { force, speed, release, strongest, deepest, .. } = course;
        let impact = (0.0, *release);
        match shown {
            Shown::Force => strongest.value,
            Shown::Depth => deepest.value,
            Shown::Share => deepest.value / thickness,
            Shown::Acceleration => strongest.value * STANDARD_GRAVITY / unit,
            Shown::ContactTime => release * time,
            Shown::Restitution => -speed.value(*release) / speed.value(0.0),
            Shown::Impulse => force.integral(impact) * time,
            Shown::Work => force.integral_of_product(speed, impact),
            Shown::WorkAtEnd => f64::NAN,
            Shown::Severity => {
                let exponent = self.wanted.power.unwrap_or(1.0);
                power_of(force, *release, exponent) * time / unit.powf(exponent)
            }
            Shown::Hic(cap) => optimum(force, impact, cap / time).value * time / unit.powf(2.5),
        }
    }

    /// What is looked at over the steps of a scene that is not linear.
    pub(super) fn seen(&self, course: &Course, numbers: &[f64]) -> Vec<f64> {
        self.shown.iter().map(|&shown| self.read(shown, course, numbers)).collect()
    }
}
