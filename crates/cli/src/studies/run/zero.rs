//! Which measures are nothing but rounding.

use dashpot_analysis::{MeasureReport, RunReport};

use crate::numbers::Unit;

/// What is smaller than this part of its size is what rounding leaves of zero.
const ROUNDING: f64 = 1e-12;

/// The sizes that the measures of some runs have, by unit; what vanishes beside them is zero.
pub(super) struct Zeros {
    /// Each SI unit with the largest value that is measured in it.
    largest: Vec<(&'static str, f64)>,
    /// The coarsest relative tolerance: without errors, digits beyond it are not to be told from zero.
    tolerance: f64,
}

impl Zeros {
    /// Looks at all measures of these runs, and at the energy that they turn over.
    pub(super) fn of(runs: &[RunReport]) -> Self {
        let mut zeros = Self { largest: Vec::new(), tolerance: 0.0 };
        for run in runs {
            zeros.tolerance = zeros.tolerance.max(run.solver.rtol.unwrap_or(0.0));
            for measure in &run.measures {
                zeros.add(measure.unit, measure.value.unwrap_or(0.0).abs());
            }
            zeros.add("J", run.energy.turned_over);
        }
        zeros
    }

    fn add(&mut self, unit: &'static str, value: f64) {
        match self.largest.iter_mut().find(|(known, _)| *known == unit) {
            Some((_, largest)) => *largest = largest.max(value),
            None => self.largest.push((unit, value)),
        }
    }

    fn largest(&self, unit: &str) -> f64 {
        self.largest.iter().find(|(known, _)| *known == unit).map_or(0.0, |own| own.1)
    }

    /// Whether a measure has a value that cannot be told from zero.
    pub(super) fn has(&self, measure: &MeasureReport) -> bool {
        let error = measure.error.filter(|error| error.is_finite()).unwrap_or(0.0);
        // A time, an index or a ratio is not small because another one is large.
        let of_unit = match measure.unit {
            "J" | "N" | "m" | "N s" => self.largest(measure.unit),
            _ => 0.0,
        };
        let tolerance = if measure.error.is_none() { self.tolerance } else { 0.0 };
        let rounding = tolerance.max(ROUNDING) * measure.size.max(of_unit);
        measure.value.is_some_and(|value| value.abs() <= error.max(rounding))
    }

    /// The unit of a zero: that of its size, or of what else is measured so. A value that is lost in
    /// its error has that of the error instead, which may be far below its size.
    pub(super) fn unit(&self, measure: &MeasureReport) -> Unit {
        let error = measure.error.filter(|error| error.is_finite()).unwrap_or(0.0);
        let own = if error > ROUNDING * measure.size { error } else { measure.size };
        match self.largest(measure.unit).max(own) {
            0.0 => Unit::plain(measure.unit),
            size => Unit::suiting(size, measure.unit),
        }
    }
}
