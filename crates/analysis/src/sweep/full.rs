//! Points of a sweep that are solved in full, each as a single run.

use dashpot_dae::Silent;

use super::{Column, Gap, Grid, Pose};
use crate::{Warning, solve};

/// How points are solved in full.
#[derive(Clone, Copy)]
pub(super) struct Full<'f> {
    pub(super) grid: &'f Grid,
    pub(super) pose: &'f Pose<'f>,
    pub(super) columns: &'f [Column],
}

impl Full<'_> {
    /// Writes the columns of a point and their errors, notes why values are missing, and returns what the
    /// run is warned of.
    pub(super) fn write(
        &self,
        point: usize,
        values: &mut [f64],
        errors: &mut [f64],
        gaps: &mut Vec<Gap>,
    ) -> Vec<Warning> {
        values.fill(f64::NAN);
        errors.fill(f64::NAN);
        let solved = (self.pose)(&self.grid.places(point)).and_then(|posed| {
            solve(&posed.network, &posed.settings, &mut Silent).map_err(|error| error.to_string())
        });
        let report = match solved {
            Ok(report) => report,
            Err(reason) => {
                gaps.push(Gap { point, column: None, reason });
                return Vec::new();
            }
        };
        for (at, column) in self.columns.iter().enumerate() {
            let gap = |reason: String| Gap { point, column: Some(at), reason };
            let Some(measure) = report.measure(&column.key) else {
                gaps.push(gap("it is not reported at this point".to_owned()));
                continue;
            };
            let thickness =
                report.assembly.connection(&measure.target).and_then(|own| own.thickness);
            let unit = if column.is_share { thickness } else { Some(1.0) };
            match measure.value.zip(unit) {
                Some((value, unit)) => {
                    values[at] = value / unit;
                    errors[at] = measure.error.map_or(f64::NAN, |error| error / unit);
                }
                None => gaps.push(gap(measure.note().unwrap_or_default())),
            }
        }
        report.warnings
    }
}
