//! Force over deformation.

use super::markers::markers;
use super::run_series::{Of, element_curves, thickness_lines};
use super::unit::Unit;
use super::{Figure, RunMarkerKind, RunSeries, curves, largest, note};
use crate::{Chart, Direction};

/// Force of each element over its deformation, both positive in compression: the area in a loop is the energy lost.
#[derive(Debug, Clone, Copy)]
pub struct ForceDeformation;

impl Figure for ForceDeformation {
    fn name(&self) -> &'static str {
        "force-deformation"
    }

    fn title(&self) -> &'static str {
        "Force over deformation"
    }

    fn chart(&self, runs: &[RunSeries]) -> Chart {
        let (shown, left_out) =
            largest(element_curves(runs, Of::Deformation, Of::Force), "elements");
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
        let x = Unit::length(points().map(|p| p.0));
        let y = Unit::force(points().map(|p| p.1));
        let kinds =
            [RunMarkerKind::PeakForce, RunMarkerKind::DeepestPoint, RunMarkerKind::TensionStart];
        Chart {
            title: self.title().into(),
            note: note(runs, &left_out),
            x_label: x.label("deformation"),
            y_label: y.label("force"),
            markers: markers(runs, &shown, &kinds, (Of::Deformation, x), (Of::Force, y)),
            lines: thickness_lines(runs, &shown, Direction::Vertical, x),
            series: curves(runs, &shown, x.factor, y.factor),
            ..Chart::default()
        }
    }
}
