//! Runs as the plain numbers that figures are drawn from.

use dashpot_analysis::{
    MeasureKind, RunReport,
    ledger::energy_series,
    measures::{PeakDeformation, PeakForce},
    regular_times, table_at,
};
use dashpot_plot::{ElementSeries, EnergySeries, RunMarker, RunMarkerKind, RunSeries};

use crate::numbers::{digits, quantity};

/// Points that are closer than this part of the run are one.
const SAME: f64 = 1e-4;
/// Digits in a marker's text.
const DIGITS: usize = 3;

/// Forces and deformations of `report` at `count` regular times.
pub(crate) fn curves(report: &RunReport, count: usize) -> RunSeries {
    let times = regular_times(report.trajectory.t_end, count);
    let table = table_at(&report.assembly, &report.trajectory, times);
    let outputs = &report.assembly.system.outputs;
    let values = |output: Option<usize>| {
        let name = output.and_then(|at| outputs.get(at)).map(|output| output.name.as_str());
        let column = name.and_then(|name| table.columns.iter().find(|own| own.name == name));
        column.map_or_else(Vec::new, |column| column.values.clone())
    };
    let connections = report.assembly.connections.iter();
    let elements = connections.map(|connection| ElementSeries {
        name: connection.name.clone(),
        force: values(connection.force),
        deformation: values(Some(connection.deformation)),
        thickness: connection.thickness,
    });
    RunSeries {
        method: report.solver.method.to_owned(),
        elements: elements.collect(),
        energy: Vec::new(),
        markers: markers(report),
        time: table.times,
    }
}

/// The same with the energies.
pub(crate) fn curves_and_energies(report: &RunReport, count: usize) -> RunSeries {
    let series = curves(report, count);
    let energies = energy_series(&report.solution(), &series.time);
    let part = |name: &str, values: Vec<f64>| EnergySeries { name: name.to_owned(), values };
    let mut energy = vec![
        part("kinetic", energies.kinetic),
        part("stored", energies.stored),
        part("dissipated", energies.dissipated),
    ];
    if !report.energy.work_in.is_empty() {
        energy.push(part("put in from outside", energies.work_in));
    }
    RunSeries { energy, ..series }
}

fn markers(report: &RunReport) -> Vec<RunMarker> {
    let peak = |kind: &str, marker: RunMarkerKind, word: &str| -> Vec<RunMarker> {
        let of_kind = report.measures.iter().filter(|measure| measure.kind == kind);
        let marked = of_kind.filter_map(|measure| {
            let (value, time) = (measure.value?, measure.time?);
            let amount = quantity(value, measure.unit, digits(value, measure.error, DIGITS));
            let label = format!("{word} {amount} at {}", quantity(time, "s", DIGITS));
            Some(RunMarker { element: measure.target.clone(), kind: marker, time, label })
        });
        marked.collect()
    };
    let mut markers = peak(PeakForce::KIND, RunMarkerKind::PeakForce, "peak");
    markers.extend(peak(PeakDeformation::KIND, RunMarkerKind::DeepestPoint, "deepest"));
    // Two measures of one kind may have found the same point.
    let mut known: Vec<RunMarker> = Vec::new();
    markers.retain(|marker| {
        let is_known = known.iter().any(|other| {
            other.element == marker.element
                && other.kind == marker.kind
                && (other.time - marker.time).abs() <= SAME * report.trajectory.t_end
        });
        known.push(marker.clone());
        !is_known
    });
    let end = report.trajectory.t_end;
    let released = report.contacts.iter().filter(|contact| {
        contact.impact.contact == dashpot_analysis::Contact::Released && contact.impact.end < end
    });
    markers.extend(released.map(|contact| RunMarker {
        element: contact.element.clone(),
        kind: RunMarkerKind::TensionStart,
        time: contact.impact.end,
        label: format!("pulls from {}", quantity(contact.impact.end, "s", DIGITS)),
    }));
    markers
}
