//! What columns show of an impact, as it is read off a solution.

use super::{
    instantiated::Plan,
    plain::{
        shown::{Scales, Shown},
        stepped::Course,
    },
    report::Notice,
    scene_point::{Figure, Impact},
    table::Besides,
};
use crate::{
    Compression,
    measures::{
        STANDARD_GRAVITY,
        hic_search::{optimum, optimum_of_hump},
    },
};

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

    /// What is looked at over the steps of a scene that is not linear, and what the errors are parts of.
    pub(super) fn seen<const N: usize>(
        &self,
        course: &Course<N>,
        numbers: &[f64],
    ) -> Vec<[f64; 2]> {
        let scales = Scales {
            time: self.parametric.time_scale(),
            mass: self.parametric.impactor_mass(numbers),
            thickness: Besides::of(numbers).thickness,
            exponent: self.wanted.power.unwrap_or(1.0),
        };
        self.shown.iter().map(|&shown| scales.figure(shown, course)).collect()
    }
}
