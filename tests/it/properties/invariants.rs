//! What holds in each solution of each network.

use dashpot::{
    analysis::{MeasureReport, RunReport, Solution},
    network::elements::Law as Seen,
};

/// The first invariant that a report breaks; one that determines nothing promises none.
pub(super) fn broken(report: &RunReport) -> Option<String> {
    let is_open = |measure_report: &MeasureReport| measure_report.is_undetermined;
    if !report.measures.is_empty() && report.measures.iter().all(is_open) {
        return None;
    }
    let threshold = threshold(report);
    energy(report)
        .or_else(|| momentum(report, threshold))
        .or_else(|| pulls(report, threshold))
        .or_else(|| given_back(report, threshold))
        .map(|what| format!("by {}: {what}", report.solver.method))
}

/// The relative error that the report itself admits: that of its measures, and of its energy.
fn threshold(report: &RunReport) -> f64 {
    let measures = report.worst_relative_error().filter(|error| error.is_finite());
    measures.unwrap_or(0.0).max(report.energy.closure().abs()).max(1e-9)
}

/// The energy closes as well as the measures are good, or a warning says that it does not.
fn energy(report: &RunReport) -> Option<String> {
    let closure = report.energy.closure().abs();
    let allowed = if report.solver.rtol.is_some() { 1e-3 } else { 1e-9 };
    let is_said =
        report.warnings.iter().any(|warning| warning.to_string().contains("does not close"));
    (closure > allowed && !is_said).then(|| format!("closure of {closure:e} that is not said"))
}

/// Each free mass changes its momentum by the impulses of all forces and impacts.
fn momentum(report: &RunReport, threshold: f64) -> Option<String> {
    let (assembly, solution) = (&report.assembly, report.solution());
    let whole = (0.0, solution.end());
    let largest = assembly
        .nodes
        .iter()
        .filter_map(|node| Some(node.mass * solution.signal(node.velocity?).bound()));
    // What is not moved trembles by roundings of what moves.
    let rounding = 1e-12 * largest.fold(0.0, f64::max);
    assembly.nodes.iter().filter(|node| node.mass > 0.0 && node.free).find_map(|node| {
        let velocity = solution.signal(node.velocity?);
        // Nodes of one body would share their forces.
        if assembly.nodes.iter().filter(|other| other.body == node.body).count() > 1 {
            return None;
        }
        let gained = node.mass * (velocity.value(whole.1) - velocity.value(0.0));
        let (mut sum, mut size) = (0.0, node.mass * velocity.bound());
        let mut push = |impulse: f64, bound: f64| {
            sum += impulse;
            size += bound;
        };
        for connection in &assembly.connections {
            let ends = connection.between.map(|end| assembly.nodes[end.index()].body);
            for (end, sign) in [(ends[0], -1.0), (ends[1], 1.0)] {
                if end != node.body || ends[0] == ends[1] {
                    continue;
                }
                let force = solution.signal(connection.force?);
                push(sign * force.integral(whole), force.integral_of(whole, &[0.0], f64::abs));
                for primitive in &assembly.primitives[connection.primitives.clone()] {
                    let switches = report.trajectory.switches.iter();
                    // Speeds are reported from after the impacts at the start.
                    for own in switches
                        .filter(|switch| switch.time > 0.0 && *switch.name == *primitive.name)
                    {
                        push(sign * own.impulse, own.impulse);
                    }
                }
            }
        }
        for drive in
            assembly.drives.iter().filter(|drive| assembly.nodes[drive.node].body == node.body)
        {
            let force = solution.signal(drive.force);
            push(force.integral(whole), force.integral_of(whole, &[0.0], f64::abs));
        }
        let off = (gained - sum).abs();
        let allowed = 10.0 * threshold * size + rounding;
        (off > allowed).then(|| {
            format!("{} gains {gained:e} N s of {sum:e}, {off:e} > {allowed:e}", node.name)
        })
    })
}

/// What cannot pull does not.
fn pulls(report: &RunReport, threshold: f64) -> Option<String> {
    let (assembly, solution) = (&report.assembly, report.solution());
    assembly.connections.iter().filter(|connection| connection.never_pulls).find_map(|connection| {
        let force = solution.signal(connection.force?);
        let least = force.minimum((0.0, solution.end())).value;
        let allowed = 10.0 * threshold * largest_force(&solution);
        (least < -allowed).then(|| format!("{} pulls with {least:e} N", connection.name))
    })
}

fn largest_force(solution: &Solution<'_>) -> f64 {
    let connections = solution.assembly().connections.iter();
    let forces = connections.filter_map(|connection| Some(solution.signal(connection.force?)));
    forces.map(dashpot::dae::Signal::bound).fold(0.0, f64::max)
}

/// No dashpot and no friction gives energy back, in no part of the run.
fn given_back(report: &RunReport, threshold: f64) -> Option<String> {
    const PARTS: u32 = 16;
    let (assembly, solution) = (&report.assembly, report.solution());
    assembly.primitives.iter().find_map(|primitive| {
        let only_loses = match primitive.element.law() {
            Seen::Dashpot(_) => true,
            Seen::Nonlinear { stiffness, damping } => stiffness <= 0.0 && damping > 0.0,
            _ => primitive.element.kind() == "friction",
        };
        if !only_loses {
            return None;
        }
        let force = solution.signal(primitive.force);
        let rate = solution.rate(primitive.rate, primitive.deformation);
        (0..PARTS).find_map(|part| {
            let at = |part: u32| solution.end() * f64::from(part) / f64::from(PARTS);
            let work = force.integral_of_product(&rate, (at(part), at(part + 1)));
            let allowed = 10.0 * threshold * report.energy.turned_over;
            (work < -allowed).then(|| format!("{} gives back {:e} J", primitive.name, -work))
        })
    })
}
