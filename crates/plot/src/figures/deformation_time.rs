//! Deformation over time.

use super::markers::markers;
use super::run_series::{Of, element_curves, thickness_lines};
use super::unit::Unit;
use super::{Figure, Quantity, RunMarkerKind, RunSeries, curves, largest, note};
use crate::{Chart, Direction};

/// The widest gap that is shown, as a part of the largest deformation.
const WIDEST: f64 = 0.5;

/// Deformation of each element over time, positive in compression, with the thickness of pads as a limit. Gaps at
/// contacts that are wide beside the deformations are cut off.
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
        let mut all = element_curves(runs, Of::Time, Of::Deformation);
        let widest = cut_off(runs, &mut all);
        let (shown, left_out) = largest(all, "elements");
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
        let x = Unit::time(points().map(|p| p.0));
        let y = Unit::length(points().map(|p| p.1));
        let kinds = [RunMarkerKind::DeepestPoint, RunMarkerKind::TensionStart];
        Chart {
            title: self.title().into(),
            note: note(runs, &both(&left_out, widest.map(|widest| gaps(widest, y)))),
            x_label: x.label("time"),
            y_label: y.label("deformation"),
            markers: markers(runs, &shown, &kinds, (Of::Time, x), (Of::Deformation, y)),
            lines: thickness_lines(runs, &shown, Direction::Horizontal, y),
            series: curves(runs, &shown, x.factor, y.factor),
            ..Chart::default()
        }
    }
}

/// Leaves out the parts of flights in which a contact is wide open, so that they do not flatten the curves of what
/// deforms. Returns the widest gap that is shown \[m\] where any is wider.
fn cut_off(runs: &[RunSeries], all: &mut [Quantity]) -> Option<f64> {
    let is_contact = |quantity: &Quantity| {
        let elements = runs.iter().flat_map(|run| &run.elements);
        elements.filter(|element| element.name == quantity.name).any(|element| element.is_contact)
    };
    let deforming = all.iter().filter(|own| !is_contact(own));
    let sizes = deforming.flat_map(|own| own.curves.iter().flatten()).map(|point| point.1.abs());
    let widest = WIDEST * sizes.filter(|siz| siz.is_finite()).fold(0.0, f64::max);
    if widest <= 0.0 {
        return None;
    }
    let mut is_cut = false;
    for quantity in all.iter_mut().filter(|own| is_contact(own)) {
        for point in quantity.curves.iter_mut().flatten().filter(|point| point.1 < -widest) {
            (point.1, is_cut) = (f64::NAN, true);
        }
    }
    is_cut.then_some(widest)
}

fn gaps(widest: f64, unit: Unit) -> String {
    format!("gaps wider than {} are cut off", unit.print(widest))
}

fn both(one: &str, other: Option<String>) -> String {
    let said = [one.to_owned(), other.unwrap_or_default()];
    said.into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::tests::runs;

    #[test]
    fn wide_gaps_do_not_flatten_what_deforms() {
        let mut runs = runs();
        runs.truncate(1);
        let deepest = runs[0].elements[0].deformation.iter().copied().fold(0.0, f64::max);
        let contact = &mut runs[0].elements[1];
        contact.is_contact = true;
        let last = contact.deformation.len() - 1;
        for (at, gap) in contact.deformation.iter_mut().enumerate() {
            *gap = -(at as f64) / last as f64;
        }
        let chart = DeformationTime.chart(&runs);
        let shown = chart.series[1].points.iter().map(|point| point.1);
        let lowest = shown.clone().filter(|shown| shown.is_finite()).fold(0.0, f64::min);
        assert!(lowest < 0.0 && lowest >= -500.0 * deepest, "{lowest}");
        assert!(shown.clone().any(f64::is_nan));
        assert!(chart.note.contains("gaps wider than 8.75 mm are cut off"), "{}", chart.note);
        let whole = DeformationTime.chart(&crate::figures::tests::runs());
        assert!(!whole.note.contains("gaps"), "{}", whole.note);
    }
}
