//! Markers of runs: on their curves, and one for all that happens at one place.

use super::super::unit::Unit;
use super::series::{Quantity, listed};
use super::{Of, RunMarker, RunMarkerKind, RunSeries};
use crate::Marker;
use crate::text_metrics::columns;

/// Points nearer than this part of the curves' extent, half of a disc, are one place.
const NEAR: f64 = 0.004;
/// Columns beyond which texts of one place stay apart.
const LONGEST: usize = 64;
/// Samples this near to a marker in time, relative to it, are of its instant: the two sides of a jump.
const INSTANT: f64 = 1e-11;

/// What is marked at one place.
struct Spot<'a> {
    x: f64,
    y: f64,
    notes: Vec<Note<'a>>,
}

/// One thing that happens at one time to some elements.
#[derive(Clone, PartialEq)]
struct Note<'a> {
    elements: Vec<&'a str>,
    labels: Vec<&'a str>,
    moment: &'a str,
}

/// The first run's markers of these `kinds` on elements whose curves are drawn, at the values of the signals `x` and
/// `y` at their times. Markers at one place have one text, which tells of all of them; it names the elements where
/// several are shown.
pub(super) fn markers(
    runs: &[RunSeries],
    shown: &[Quantity],
    kinds: &[RunMarkerKind],
    x: (Of, Unit),
    y: (Of, Unit),
) -> Vec<Marker> {
    let Some(run) = runs.first() else { return Vec::new() };
    let drawn = |q: &&Quantity| q.curves.first().is_some_and(|curve| !curve.is_empty());
    let points = || shown.iter().flat_map(|q| q.curves.iter().flatten());
    let near = (
        NEAR * extent(points().map(|p| p.0)) / x.1.factor,
        NEAR * extent(points().map(|p| p.1)) / y.1.factor,
    );
    let is_named = shown.iter().filter(drawn).count() > 1;
    let is_drawn = |name: &str| shown.iter().filter(drawn).any(|q| q.name == name);
    let mut spots: Vec<Spot<'_>> = Vec::new();
    for marker in run.markers.iter().filter(|m| kinds.contains(&m.kind) && is_drawn(&m.element)) {
        let Some((at_x, at_y)) = place(run, marker, x.0, y.0) else { continue };
        let (at_x, at_y) = (at_x / x.1.factor, at_y / y.1.factor);
        let note = Note {
            elements: vec![&marker.element],
            labels: vec![&marker.label],
            moment: &marker.moment,
        };
        let joined = spots
            .iter_mut()
            .filter(|spot| (spot.x - at_x).abs() <= near.0 && (spot.y - at_y).abs() <= near.1)
            .find_map(|spot| {
                let notes = joined(&spot.notes, &note);
                let fits =
                    notes.len() == spot.notes.len() || columns(&text(&notes, is_named)) <= LONGEST;
                fits.then(|| spot.notes = notes)
            });
        if joined.is_none() {
            spots.push(Spot { x: at_x, y: at_y, notes: vec![note] });
        }
    }
    let marker =
        |spot: Spot<'_>| Marker { x: spot.x, y: spot.y, label: text(&spot.notes, is_named) };
    spots.into_iter().map(marker).collect()
}

/// Notes with one more: in one with the same labels of other elements, or other labels of the same
/// elements, at the same time.
fn joined<'a>(notes: &[Note<'a>], own: &Note<'a>) -> Vec<Note<'a>> {
    let mut notes = notes.to_vec();
    let at_once = |note: &&mut Note<'a>| note.moment == own.moment;
    if let Some(note) = notes.iter_mut().filter(at_once).find(|note| note.labels == own.labels) {
        note.elements.extend(&own.elements);
        return notes;
    }
    let is_timed = |note: &&mut Note<'a>| note.moment == own.moment && !own.moment.is_empty();
    if let Some(note) = notes.iter_mut().filter(is_timed).find(|n| n.elements == own.elements) {
        note.labels.extend(&own.labels);
        return notes;
    }
    notes.push(own.clone());
    notes
}

fn text(notes: &[Note<'_>], is_named: bool) -> String {
    let one = |note: &Note<'_>| {
        let name = if is_named { format!("{}: ", listed(&note.elements)) } else { String::new() };
        let moment =
            if note.moment.is_empty() { String::new() } else { format!(" at {}", note.moment) };
        format!("{name}{}{moment}", note.labels.join(", "))
    };
    notes.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// Where a marker lies: at the sample of its time, of both sides of a jump at the one that is marked; without such a
/// sample between its neighbours.
fn place(run: &RunSeries, marker: &RunMarker, x: Of, y: Of) -> Option<(f64, f64)> {
    let element = run.elements.iter().find(|e| e.name == marker.element)?;
    let size = |at: &usize| {
        let of = match marker.kind {
            RunMarkerKind::DeepestPoint => Of::Deformation,
            RunMarkerKind::PeakForce | RunMarkerKind::TensionStart => Of::Force,
        };
        run.signal(element, of).get(*at).map_or(0.0, |value| value.abs())
    };
    let reach = INSTANT * (marker.time.abs() + run.first_touch.unwrap_or(0.0));
    let from = run.time.partition_point(|time| *time < marker.time - reach);
    let to = run.time.partition_point(|time| *time <= marker.time + reach);
    let at = match marker.kind {
        RunMarkerKind::TensionStart => (from..to).last(),
        _ => (from..to).max_by(|one, other| size(one).total_cmp(&size(other))),
    };
    let value = |of: Of| match (of, at) {
        (Of::Time, _) => Some(marker.time),
        (_, Some(at)) => run.signal(element, of).get(at).copied(),
        (_, None) => interpolate(&run.time, run.signal(element, of), marker.time),
    };
    let is_shown = at.is_some() || interpolate(&run.time, &run.time, marker.time).is_some();
    Some((value(x)?, value(y)?)).filter(|_| is_shown)
}

/// Distance of the smallest and the largest finite value.
fn extent(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    (high - low).max(0.0)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{FORCE_DEFORMATION, FORCE_TIME, tests::runs};

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

    fn marker(kind: RunMarkerKind, time: f64, label: &str) -> RunMarker {
        let (label, moment) = (label.into(), format!("{} ms", 1e3 * time));
        RunMarker { element: "padding".into(), kind, time, label, moment }
    }

    #[test]
    fn a_marker_lies_on_the_curve_at_its_time() {
        let mut runs = runs();
        let kinds = [RunMarkerKind::PeakForce, RunMarkerKind::DeepestPoint];
        runs[0].markers = vec![marker(kinds[0], 1e-3, "peak"), marker(kinds[1], 5e-3, "deepest")];
        let chart = FORCE_DEFORMATION.chart(&runs);
        let own = &runs[0].elements[0];
        for (marker, at) in chart.markers.iter().zip([10, 50]) {
            assert_eq!((marker.x * 1e-3, marker.y * 1e3), (own.deformation[at], own.force[at]));
            let mut points = chart.series[0].points.iter();
            assert!(points.any(|p| *p == (marker.x, marker.y)), "{marker:?} is off its curve");
        }
        assert_eq!(chart.markers.len(), 2);
    }

    #[test]
    fn at_a_jump_the_peak_is_on_the_side_that_has_it() {
        let mut run = runs().remove(0);
        let (at, time) = (30, 3e-3);
        run.time.insert(at, time * (1.0 - 4e-12));
        for element in &mut run.elements {
            element.force.insert(at, 9e4);
            element.deformation.insert(at, element.deformation[at]);
        }
        run.markers = vec![marker(RunMarkerKind::PeakForce, time, "peak")];
        let chart = FORCE_TIME.chart(&[run]);
        assert!((chart.markers[0].y - 90.0).abs() < 1e-12, "{:?}", chart.markers);
    }

    #[test]
    fn what_happens_at_one_place_is_told_in_one_text_and_elsewhere_in_its_own() {
        let mut runs = runs();
        let labels = |runs: &[RunSeries]| -> Vec<String> {
            FORCE_DEFORMATION.chart(runs).markers.into_iter().map(|marker| marker.label).collect()
        };
        runs[0].markers = vec![
            marker(RunMarkerKind::PeakForce, 1e-3, "peak 38 kN"),
            marker(RunMarkerKind::DeepestPoint, 1e-3, "deepest 8 mm"),
            marker(RunMarkerKind::TensionStart, 8e-3, "pulls"),
        ];
        assert_eq!(
            labels(&runs),
            ["padding: peak 38 kN, deepest 8 mm at 1 ms", "padding: pulls at 8 ms"]
        );
        runs[0].elements.truncate(1);
        assert_eq!(labels(&runs), ["peak 38 kN, deepest 8 mm at 1 ms", "pulls at 8 ms"]);
    }

    #[test]
    fn what_has_no_curve_has_no_marker() {
        let mut runs = runs();
        runs.truncate(1);
        runs[0].elements[1].is_contact = true;
        let on_contact = RunMarker {
            element: runs[0].elements[1].name.clone(),
            ..marker(RunMarkerKind::PeakForce, 1e-3, "peak 18 kN")
        };
        runs[0].markers = vec![on_contact, marker(RunMarkerKind::PeakForce, 1e-3, "peak 38 kN")];
        let chart = FORCE_DEFORMATION.chart(&runs);
        let labels: Vec<&str> = chart.markers.iter().map(|marker| marker.label.as_str()).collect();
        assert_eq!(labels, ["peak 38 kN at 1 ms"]);
    }
}
