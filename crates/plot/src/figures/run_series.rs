//! The plain numbers of one run that figures are drawn from.

use super::Quantity;
use super::unit::Unit;
use crate::{Direction, Marker, ReferenceLine};

/// Sampled results of one run with one method, in SI units.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunSeries {
    /// Name of the method.
    pub method: String,
    /// Sample times \[s\], ascending.
    pub time: Vec<f64>,
    /// Elements to be shown.
    pub elements: Vec<ElementSeries>,
    /// Parts of the energy ledger.
    pub energy: Vec<EnergySeries>,
    /// Points worth a text; of several runs the first one's are drawn.
    pub markers: Vec<RunMarker>,
}

/// One element at the sample times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ElementSeries {
    /// Name.
    pub name: String,
    /// Force \[N\], positive in compression.
    pub force: Vec<f64>,
    /// Deformation \[m\], positive in compression.
    pub deformation: Vec<f64>,
    /// Thickness \[m\] of a pad, drawn as a limit of the deformation.
    pub thickness: Option<f64>,
    /// Whether it is a rigid contact: its force does not belong to its deformation, which is the
    /// width of a gap.
    pub is_contact: bool,
}

/// One part of the energy ledger at the sample times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EnergySeries {
    /// Name, as in `kinetic`.
    pub name: String,
    /// Energy \[J\].
    pub values: Vec<f64>,
}

/// A point of an element's curves that carries a text.
#[derive(Debug, Clone, PartialEq)]
pub struct RunMarker {
    /// Name of the element.
    pub element: String,
    /// What happens there; decides which figures show it.
    pub kind: RunMarkerKind,
    /// Time \[s\].
    pub time: f64,
    /// Text beside the point, as in `peak 38.4 kN at 0.98 ms`.
    pub label: String,
}

/// What a [`RunMarker`] marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RunMarkerKind {
    /// The largest force.
    PeakForce,
    /// The largest deformation.
    DeepestPoint,
    /// The first time at which the element pulls.
    TensionStart,
}

/// A signal of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Time,
    Force,
    Deformation,
}

impl RunSeries {
    fn signal<'a>(&'a self, element: &'a ElementSeries, of: Of) -> &'a [f64] {
        match of {
            Of::Time => &self.time,
            Of::Force => &element.force,
            Of::Deformation => &element.deformation,
        }
    }
}

/// Per element of the first run, one curve of `y` over `x` of each run.
pub(super) fn element_curves(runs: &[RunSeries], x: Of, y: Of) -> Vec<Quantity> {
    let Some(first) = runs.first() else { return Vec::new() };
    let curve = |run: &RunSeries, name: &str| {
        let is_drawn = |e: &&ElementSeries| !(e.is_contact && x == Of::Deformation);
        let element = run.elements.iter().find(|e| e.name == name).filter(is_drawn);
        element.map_or_else(Vec::new, |e| zip(run.signal(e, x), run.signal(e, y)))
    };
    let of_all = |name: &String| runs.iter().map(|run| curve(run, name)).collect();
    let names = first.elements.iter().map(|e| e.name.clone());
    names.map(|name| Quantity { curves: of_all(&name), name }).collect()
}

/// Points of two signals of equal times; the longer one is cut.
pub(super) fn zip(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

/// The first run's markers of these `kinds` on elements that are shown, with the signals `x` and `y` interpolated
/// between the samples. Where several elements are shown, a text begins with the name of its own; one text serves all
/// elements that have it at nearly one point.
pub(super) fn markers(
    runs: &[RunSeries],
    shown: &[Quantity],
    kinds: &[RunMarkerKind],
    x: (Of, Unit),
    y: (Of, Unit),
) -> Vec<Marker> {
    let Some(run) = runs.first() else { return Vec::new() };
    let place = |marker: &RunMarker| {
        let element = run.elements.iter().find(|e| e.name == marker.element)?;
        let at = |of| match of {
            Of::Time => Some(marker.time),
            _ => interpolate(&run.time, run.signal(element, of), marker.time),
        };
        let (x, y) = (at(x.0)? / x.1.factor, at(y.0)? / y.1.factor);
        Some((x, y))
    };
    let placed = run
        .markers
        .iter()
        .filter(|m| kinds.contains(&m.kind) && shown.iter().any(|q| q.name == m.element))
        .filter_map(|marker| place(marker).map(|(x, y)| (marker, x, y)));
    let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
    let near = (
        NEAR * extent(points().map(|p| p.0)) / x.1.factor,
        NEAR * extent(points().map(|p| p.1)) / y.1.factor,
    );
    let mut merged: Vec<(Marker, Vec<&str>)> = Vec::new();
    for (marker, x, y) in placed {
        let is_same = |(other, names): &&mut (Marker, Vec<&str>)| {
            other.label == marker.label
                && !names.contains(&marker.element.as_str())
                && (other.x - x).abs() <= near.0
                && (other.y - y).abs() <= near.1
        };
        match merged.iter_mut().find(is_same) {
            Some((_, names)) => names.push(&marker.element),
            None => {
                merged.push((Marker { x, y, label: marker.label.clone() }, vec![&marker.element]));
            }
        }
    }
    let named = |(marker, names): (Marker, Vec<&str>)| match shown.len() {
        0 | 1 => marker,
        _ => Marker { label: format!("{}: {}", listed(&names), marker.label), ..marker },
    };
    merged.into_iter().map(named).collect()
}

/// Points nearer than this part of the curves' extent carry one text together.
const NEAR: f64 = 0.01;

/// Distance of the smallest and the largest finite value.
fn extent(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    (high - low).max(0.0)
}

/// Names in one text; of many the first ones and how many more there are.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 3;
    match names.len() {
        0..=MOST => names.join(", "),
        count => format!("{} and {} more", names[..MOST - 1].join(", "), count - (MOST - 1)),
    }
}

/// The value at `at`, on the straight line between its neighbours; `None` outside the samples.
fn interpolate(time: &[f64], values: &[f64], at: f64) -> Option<f64> {
    let after = time.iter().position(|t| *t >= at)?;
    let end = *values.get(after)?;
    let Some(before) = after.checked_sub(1) else {
        return (at >= time[0]).then_some(end);
    };
    let part = (at - time[before]) / (time[after] - time[before]);
    Some(values[before] + part * (end - values[before]))
}

/// The thicknesses of the elements that are shown, in the colours of their curves; equal ones are one line.
pub(super) fn thickness_lines(
    runs: &[RunSeries],
    shown: &[Quantity],
    direction: Direction,
    unit: Unit,
) -> Vec<ReferenceLine> {
    let elements = runs.first().map_or(&[][..], |run| &run.elements);
    let mut limits: Vec<(f64, Vec<&str>, Option<usize>)> = Vec::new();
    for element in elements {
        let colour = shown.iter().position(|q| q.name == element.name);
        let (Some(thickness), Some(_)) = (element.thickness, colour) else { continue };
        match limits.iter_mut().find(|limit| limit.0.total_cmp(&thickness).is_eq()) {
            Some((_, names, shared)) => {
                names.push(&element.name);
                *shared = None;
            }
            None => limits.push((thickness, vec![&element.name], colour)),
        }
    }
    let line = |(thickness, names, colour): (f64, Vec<&str>, Option<usize>)| ReferenceLine {
        direction,
        at: thickness / unit.factor,
        label: format!("thickness of {}: {}", listed(&names), unit.print(thickness)),
        colour,
    };
    limits.into_iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markers_are_interpolated_and_outside_the_samples_left_out() {
        let (time, values) = ([0.0, 1.0, 2.0], [0.0, 10.0, 4.0]);
        assert_eq!(interpolate(&time, &values, 0.5), Some(5.0));
        assert_eq!(interpolate(&time, &values, 0.0), Some(0.0));
        assert_eq!(interpolate(&time, &values, 2.5), None);
        assert_eq!(interpolate(&time, &values, -1.0), None);
        assert_eq!(interpolate(&time, &values, f64::NAN), None);
        assert_eq!(interpolate(&[], &[], 0.0), None);
    }
}
