//! Deformation over time.

use super::markers::markers;
use super::run_series::{Of, element_curves, thickness_lines};
use super::unit::Unit;
use super::{Figure, RunMarkerKind, RunSeries, curves, largest, note};
use crate::{Chart, Direction};

/// Deformation of each element over time, positive in compression, with the thickness of pads as a limit.
#[derive(Debug, Clone, Copy)]
pub struct DeformationTime;

impl Figure for DeformationTime {
    fn name(&self) -> &'static str {
        "deformation-time"
    }

    fn title(&self) -> &'static str {
        "Deformation over time"
    }

    fn chart(&self, runs: &[RunSeries]) -> Chart {
        let (shown, left_out) =
            largest(element_curves(runs, Of::Time, Of::Deformation), "elements");
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
        let x = Unit::time(points().map(|p| p.0));
        let y = Unit::length(points().map(|p| p.1));
        let kinds = [RunMarkerKind::DeepestPoint, RunMarkerKind::TensionStart];
        Chart {
            title: self.title().into(),
            note: note(runs, &left_out),
            x_label: x.label("time"),
            y_label: y.label("deformation"),
            markers: markers(runs, &shown, &kinds, (Of::Time, x), (Of::Deformation, y)),
            lines: thickness_lines(runs, &shown, Direction::Horizontal, y),
            series: curves(runs, &shown, x.factor, y.factor),
            ..Chart::default()
        }
    }
}
