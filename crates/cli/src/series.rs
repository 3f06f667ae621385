//! Runs as the plain numbers that figures are drawn from.

use dashpot_analysis::{
    MeasureKind, RunReport,
    ledger::energy_series,
    measures::{PeakDeformation, PeakForce},
    regular_times, table_at,
};
use dashpot_network::elements::{Contact, ElementKind};
use dashpot_plot::{ElementSeries, EnergySeries, RunMarker, RunMarkerKind, RunSeries};

use crate::numbers::{digits, quantity};

/// Points that are closer than this part of the run are one, and forces than this of the largest.
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
    let mut elements: Vec<ElementSeries> = connections
        .map(|connection| ElementSeries {
            name: connection.name.clone(),
            force: values(connection.force),
            deformation: values(Some(connection.deformation)),
            thickness: connection.thickness,
            is_contact: is_contact(report, &connection.name),
        })
        .collect();
    leave_out_repetitions(&mut elements);
    RunSeries {
        method: report.solver.method.to_owned(),
        elements,
        energy: Vec::new(),
        markers: markers(report),
        time: table.times,
    }
}

/// Whether the element `name` is nothing but a rigid contact.
fn is_contact(report: &RunReport, name: &str) -> bool {
    let assembly = &report.assembly;
    let own = assembly.connections.iter().find(|connection| connection.name == name);
    let parts = own.and_then(|own| assembly.primitives.get(own.primitives.clone()));
    matches!(parts, Some([part]) if part.element.kind() == Contact::KIND)
}

/// Leaves out the force of a contact that has, all the time, that of the element to which it belongs.
fn leave_out_repetitions(elements: &mut [ElementSeries]) {
    for at in 0..elements.len() {
        let (contact, others) = (&elements[at], &*elements);
        let owner = others.iter().find(|own| {
            let rest = contact.name.strip_prefix(own.name.as_str());
            contact.is_contact && rest.is_some_and(|rest| rest.starts_with('.'))
        });
        let Some(owner) = owner else { continue };
        let largest = owner.force.iter().fold(0.0_f64, |largest, force| largest.max(force.abs()));
        let mut pairs = contact.force.iter().zip(&owner.force);
        if pairs.all(|(one, other)| (one - other).abs() <= SAME * largest) {
            elements[at].force.clear();
        }
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
    let mut deepest = peak(PeakDeformation::KIND, RunMarkerKind::DeepestPoint, "deepest");
    // Nothing gets deeper into a rigid contact than its gap, and a stop is as deep as its element.
    let all = deepest.clone();
    deepest.retain(|marker| {
        let is_repeated = all.iter().any(|own| {
            let rest = marker.element.strip_prefix(own.element.as_str());
            rest.is_some_and(|rest| rest.starts_with('.')) && own.label == marker.label
        });
        !is_repeated && !is_contact(report, &marker.element)
    });
    markers.append(&mut deepest);
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
        contact.is_glued
            && contact.impact.contact == dashpot_analysis::Contact::Released
            && contact.impact.end < end
    });
    markers.extend(released.map(|contact| RunMarker {
        element: contact.element.clone(),
        kind: RunMarkerKind::TensionStart,
        time: contact.impact.end,
        label: format!("pulls from {}", quantity(contact.impact.end, "s", DIGITS)),
    }));
    markers
}
