//! Runs as the plain numbers that figures are drawn from.

use dashpot_analysis::{
    ContactReport, Judged, RunReport, excerpt,
    ledger::energy_series,
    measures::{PeakAcceleration, PeakDeformation, PeakForce},
    resolving_times, table_at, touching,
};
use dashpot_network::parameters::Kind as _;
use dashpot_network::{NodeOutputs, elements::Contact};
use dashpot_plot::{
    ElementSeries, EnergySeries, NodeSeries, Of, RunLimit, RunMarker, RunMarkerKind, RunSeries,
};

use super::limits::level;
use dashpot_report::numbers::{digits, quantity};

/// Points that are closer than this part of the run are one, and forces than this of the largest.
const SAME: f64 = 1e-4;
/// Digits in a marker's text.
const DIGITS: usize = 3;
/// How long before a switch its left side is looked at, relative to its time.
const JUMP: f64 = 4e-12;

/// Forces and deformations of `report` at `count` times of its [`excerpt`], or a few more.
pub(super) fn curves(report: &RunReport, count: usize) -> RunSeries {
    let (from, to) = excerpt(&report.solution());
    let origin = first_touch(&report.contacts, report.trajectory.t_end).unwrap_or(0.0);
    curves_within(report, (from - origin, to - origin), count)
}

/// The same of several runs with their energies, over the same time, which counts from the first touch of each.
pub(super) fn curves_and_energies<'r>(
    reports: impl Iterator<Item = &'r RunReport> + Clone,
    count: usize,
) -> Vec<RunSeries> {
    let windows = reports.clone().map(|report| {
        let (from, to) = excerpt(&report.solution());
        let origin = first_touch(&report.contacts, report.trajectory.t_end).unwrap_or(0.0);
        (from - origin, to - origin)
    });
    let window = windows.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
    let window = window.unwrap_or_default();
    reports.map(|report| with_energies(report, window, count)).collect()
}

/// When the first impactor that falls or flies first touches something in a run of such a length \[s\]; `None` where all
/// do from the start.
pub(super) fn first_touch(contacts: &[ContactReport], length: f64) -> Option<f64> {
    let is_struck = |contact: &&ContactReport| {
        use dashpot_analysis::Contact::{Lasting, Parted, Released};
        matches!(contact.impact.contact, Released | Parted | Lasting)
    };
    let struck = contacts.iter().filter(is_struck);
    let first = struck.min_by(|one, other| one.impact.start.total_cmp(&other.impact.start))?;
    let start = first.impact.start;
    (!first.is_glued && start > SAME * length).then_some(start)
}

/// Of a window that counts from the first touch, where there is one.
fn curves_within(report: &RunReport, window: (f64, f64), count: usize) -> RunSeries {
    let first_touch = first_touch(&report.contacts, report.trajectory.t_end);
    let origin = first_touch.unwrap_or(0.0);
    let end = report.trajectory.t_end;
    let window = ((window.0 + origin).max(0.0), (window.1 + origin).min(end));
    let markers = markers(report, origin);
    let times = times(report, window, &markers, count);
    let table = table_at(&report.assembly, &report.trajectory, times);
    let outputs = &report.assembly.system.outputs;
    let values = |output: Option<usize>| {
        let name = output.and_then(|at| outputs.get(at)).map(|output| output.name);
        let column = name.and_then(|name| table.columns.iter().find(|column| name == *column.name));
        column.map_or_else(Vec::new, |column| column.values.clone())
    };
    let connections = report.assembly.connections.iter();
    // Of a large network only what the measures need is kept.
    let is_kept = |output: usize| report.trajectory.keeps(&report.assembly.system, output);
    let mut elements: Vec<ElementSeries> = connections
        .filter(|connection| is_kept(connection.deformation))
        .map(|connection| ElementSeries {
            name: connection.name.clone(),
            force: values(connection.force),
            deformation: values(Some(connection.deformation)),
            thickness: connection.thickness,
            is_contact: is_contact(report, &connection.name),
        })
        .collect();
    leave_out_repetitions(&mut elements);
    let is_shown = |own: &&NodeOutputs| {
        let outputs = [own.acceleration, own.velocity];
        own.mass > 0.0 && own.free && outputs.into_iter().flatten().all(is_kept)
    };
    let nodes = report.assembly.nodes.iter().filter(is_shown).map(|own| NodeSeries {
        name: own.name.clone(),
        acceleration: values(own.acceleration),
        velocity: values(own.velocity),
    });
    RunSeries {
        name: report.solver.method.to_owned(),
        is_design: false,
        rank: None,
        elements,
        nodes: nodes.collect(),
        energy: Vec::new(),
        excerpt_of: (window.0 > 0.0 || window.1 < end).then_some(end),
        first_touch,
        markers: markers
            .into_iter()
            .map(|own| RunMarker { time: own.time - origin, ..own })
            .collect(),
        limits: limits(report),
        measured: Vec::new(),
        time: table.times.into_iter().map(|time| time - origin).collect(),
    }
}

/// About `count` times that resolve short contacts, and those at which something is marked or
/// switches; these last ones twice, since values may jump there.
fn times(report: &RunReport, window: (f64, f64), markers: &[RunMarker], count: usize) -> Vec<f64> {
    let mut times = resolving_times(window, &touching(&report.solution()), count);
    times.extend(markers.iter().map(|marker| marker.time));
    let switches = report.trajectory.switches.iter().map(|switch| switch.time);
    times.extend(switches.flat_map(|time| [time * (1.0 - JUMP), time]));
    times.retain(|time| (window.0..=window.1).contains(time));
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
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
        let owner = others.iter().find(|other| {
            let rest = contact.name.strip_prefix(other.name.as_str());
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

fn with_energies(report: &RunReport, window: (f64, f64), count: usize) -> RunSeries {
    let series = curves_within(report, window, count);
    if report.trajectory.digest().is_some() {
        return series;
    }
    let origin = series.first_touch.unwrap_or(0.0);
    let end = report.trajectory.t_end;
    let times: Vec<f64> = series.time.iter().map(|time| (time + origin).clamp(0.0, end)).collect();
    let energies = energy_series(&report.solution(), &times);
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

/// Whether what is marked on an element has a negative sign.
fn pulls(report: &RunReport, element: &str, kind: RunMarkerKind, time: f64) -> bool {
    let Some(own) = report.assembly.connection(element) else { return false };
    let output = match kind {
        RunMarkerKind::DeepestPoint => Some(own.deformation),
        RunMarkerKind::PeakForce | RunMarkerKind::TensionStart => own.force,
    };
    output.is_some_and(|output| {
        let signal = report.trajectory.signal(&report.assembly.system, output);
        let (left, right) = (signal.left_value(time), signal.value(time));
        if left.abs() > right.abs() { left < 0.0 } else { right < 0.0 }
    })
}

/// The limits on what a figure shows over time.
fn limits(report: &RunReport) -> Vec<RunLimit> {
    let limit = |judged: Judged<'_>| {
        let (limit, measure) = (judged.limit, judged.measure?);
        let of = match measure.kind {
            PeakForce::KIND => Of::Force,
            PeakDeformation::KIND => Of::Deformation,
            PeakAcceleration::KIND => Of::Acceleration,
            _ => return None,
        };
        let (name, label) = (measure.target.clone(), level(limit, measure.kind, measure.unit));
        let from = limit.from.as_ref().map_or(String::new(), |from| format!(" ({from})"));
        let label = format!("{} {label}{from}", limit.bound.word());
        Some(RunLimit { name, of, at: limit.bound.level(), label })
    };
    report.judged().into_iter().filter_map(limit).collect()
}

/// What is marked, at times of the run; texts tell them from `origin` \[s\].
fn markers(report: &RunReport, origin: f64) -> Vec<RunMarker> {
    let peak = |kind: &str, marker: RunMarkerKind, word: &str| -> Vec<RunMarker> {
        let of_kind = report.measures.iter().filter(|measure| measure.kind == kind);
        let marked = of_kind.filter_map(|measure| {
            let (value, time) = (measure.value?, measure.time?);
            let amount = quantity(value, measure.unit, digits(value, measure.error, DIGITS));
            // Measures tell magnitudes; a figure has the sign too.
            let sign = if pulls(report, &measure.target, marker, time) { "−" } else { "" };
            let (element, label) = (measure.target.clone(), format!("{word} {sign}{amount}"));
            let moment = quantity(time - origin, "s", DIGITS);
            Some(RunMarker { element, kind: marker, time, label, moment })
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
            let is_part = rest.is_some_and(|rest| rest.starts_with('.'));
            is_part && (&own.label, &own.moment) == (&marker.label, &marker.moment)
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
        label: format!("tension from {}", quantity(contact.impact.end - origin, "s", DIGITS)),
        moment: String::new(),
    }));
    markers
}

#[cfg(test)]
mod tests {
    use dashpot_analysis::Solve;
    use dashpot_plot::figures::{FORCE_DEFORMATION, FORCE_TIME};
    use dashpot_scene::{ReadOptions, read};

    use super::*;

    /// 4 kg fall 1 m, in √(2/9.81) s, onto a spring that they leave again.
    const DROP: &str = "[nodes]\nhead = { mass = \"4 kg\", drop = \"1 m\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], spring = \"1 MN/m\", thickness = \"2 cm\" }\n\
        [effects]\nseparation.pad = {}\ngravity = { value = \"9.81 m/s^2\" }\n\
        [run]\nduration = \"600 ms\"\n";

    fn report() -> RunReport {
        let scene = read(DROP, &ReadOptions::default()).unwrap().value;
        scene.network.solve_with(&scene.settings("exact").unwrap()).unwrap()
    }

    #[test]
    fn curves_of_a_drop_are_those_of_its_impact() {
        let report = report();
        let series = curves(&report, 4001);
        let met = (2.0_f64 / 9.81).sqrt();
        let length = std::f64::consts::PI * (4.0_f64 / 1e6).sqrt();
        let (first, last) = (series.time[0], *series.time.last().unwrap());
        assert!(first < 0.0 && -first < 0.2 * length, "{first}");
        assert!(last > length && last - length < 0.2 * length, "{last}");
        assert_eq!(series.excerpt_of, Some(0.6));
        assert!((series.first_touch.unwrap() - met).abs() < 1e-12, "{:?}", series.first_touch);
        // From the touch on the spring is m a = m g − k y: half a period and the time that gravity adds.
        let [peak, ..] = &series.markers[..] else { panic!("{:?}", series.markers) };
        let (omega, speed) = ((1e6_f64 / 4.0).sqrt(), 9.81 * met);
        let quarter = (std::f64::consts::FRAC_PI_2 + (9.81 / omega / speed).atan()) / omega;
        assert!((peak.time - quarter).abs() < 1e-9, "{} {quarter}", peak.time);
        assert_eq!(peak.moment, "3.15 ms");
        let chart = FORCE_TIME.chart(&[series]);
        assert_eq!(chart.note, "first touch at 451.52 ms of 600 ms");
        assert_eq!(chart.x_label, "time from first touch (ms)");
    }

    #[test]
    fn markers_lie_where_the_solution_is_at_their_times() {
        let report = report();
        let chart = FORCE_DEFORMATION.chart(&[curves(&report, 50)]);
        let [marker] = &chart.markers[..] else { panic!("{:?}", chart.markers) };
        let own = report.assembly.connection("pad").unwrap();
        let solution = report.solution();
        let time = report.measure("pad.peak-force").unwrap().time.unwrap();
        // On the axes in kN and mm.
        let (force, depth) =
            (solution.signal(own.force.unwrap()), solution.signal(own.deformation));
        assert!(
            (1e3 * marker.y - force.value(time)).abs() < 1e-9 * force.value(time),
            "{marker:?}"
        );
        assert!(
            (1e-3 * marker.x - depth.value(time)).abs() < 1e-9 * depth.value(time),
            "{marker:?}"
        );
        assert!(marker.label.contains("peak") && marker.label.contains("deepest"), "{marker:?}");
    }

    #[test]
    fn what_pulls_is_marked_with_its_sign() {
        let pulled = "[nodes]\nhead = { mass = \"4 kg\" }\n[elements]\n\
            pad = { between = [\"head\", \"ground\"], spring = \"1 MN/m\" }\n\
            [loads.pull]\non = \"head\"\nforce = { constant = \"-1 kN\" }\n\
            [run]\nduration = \"10 ms\"\n";
        let scene = read(pulled, &ReadOptions::default()).unwrap().value;
        let report = scene.network.solve_with(&scene.settings("exact").unwrap()).unwrap();
        let labels: Vec<String> =
            markers(&report, 0.0).into_iter().map(|marker| marker.label).collect();
        assert!(labels.iter().any(|label| label == "peak −2.00 kN"), "{labels:?}");
    }
}
