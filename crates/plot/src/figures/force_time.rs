//! Force over time.

use super::markers::markers;
use super::run_series::{Of, element_curves};
use super::unit::Unit;
use super::{Figure, RunMarkerKind, RunSeries, curves, largest, note};
use crate::Chart;

/// Force of each element over time, positive in compression.
#[derive(Debug, Clone, Copy)]
pub struct ForceTime;

impl Figure for ForceTime {
    fn name(&self) -> &'static str {
        "force-time"
    }

    fn title(&self) -> &'static str {
        "Force over time"
    }

    fn chart(&self, runs: &[RunSeries]) -> Chart {
        let (shown, left_out) = largest(element_curves(runs, Of::Time, Of::Force), "elements");
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
        let x = Unit::time(points().map(|p| p.0));
        let y = Unit::force(points().map(|p| p.1));
        let kinds = [RunMarkerKind::PeakForce, RunMarkerKind::TensionStart];
        Chart {
            title: self.title().into(),
            note: note(runs, &left_out),
            x_label: x.label("time"),
            y_label: y.label("force"),
            markers: markers(runs, &shown, &kinds, (Of::Time, x), (Of::Force, y)),
            lines: Vec::new(),
            series: curves(runs, &shown, x.factor, y.factor),
            ..Chart::default()
        }
    }
}
