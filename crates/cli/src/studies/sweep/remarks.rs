//! How a sweep was solved, and what is to be said of its points.

use dashpot_analysis::{
    Warning,
    sweep::{PartialOfSweep, SweepReport, SweepWarning},
};

use super::{Swept, words::name};
use crate::numbers::{apart, bound, duration, estimate};

/// Faults of so many kinds are told.
const MOST_TOLD: usize = 3;
/// Warnings of so many kinds are told.
const MOST_WARNED: usize = 8;

/// How it was solved, what runs are warned of, what is missing, and what was left out.
pub(super) fn remarks(swept: &Swept) -> Vec<String> {
    let (report, points) = (&swept.report, swept.points());
    let mut all = vec![solved(report, points)];
    if !report.checked.is_empty() {
        all.push(format!(
            "{} of them solved in full as well: the largest difference is {}",
            report.checked.len(),
            bound(report.largest_difference)
        ));
    }
    all.extend(warnings(swept, report, points));
    all.extend(report.partial.iter().flat_map(|own| left_out(own, report)));
    all.extend(missing(report, points));
    all
}

fn counted(points: usize) -> String {
    if points == 1 { "1 point".to_owned() } else { format!("{points} points") }
}

fn solved(report: &SweepReport, points: usize) -> String {
    match (report.instantiated, points - report.instantiated) {
        (0, 1) => "1 point, solved in full".to_owned(),
        (0, full) => format!("{full} points, each solved in full"),
        (instantiated, 0) => {
            format!("{}, instantiated from one compiled form", counted(instantiated))
        }
        (instantiated, full) => {
            format!(
                "{} instantiated from one compiled form, {full} solved in full",
                counted(instantiated)
            )
        }
    }
}

/// What runs are warned of, with the numbers by which the table calls it; not what the scene's own text
/// has brought already.
fn warnings(swept: &Swept, report: &SweepReport, points: usize) -> Vec<String> {
    let known = &swept.scene.assembly.warnings;
    let told = |(at, own): (usize, &SweepWarning)| {
        let first = own.points.first().map_or(String::new(), |point| swept.at(*point));
        let of = if own.points.len() == points {
            format!("at all {points} points")
        } else {
            format!("at {} of {points} points", own.points.len())
        };
        format!("warning {}, {of}, first at {first}: {}", at + 1, own.warning)
    };
    let is_known = |sweep_warning: &SweepWarning| matches!(&sweep_warning.warning, Warning::Network(sweep_warning) if known.contains(sweep_warning));
    let new = report.warnings.iter().enumerate().filter(|own| !is_known(own.1));
    let mut all: Vec<String> = new.map(told).collect();
    let more = all.len().saturating_sub(MOST_WARNED);
    all.truncate(MOST_WARNED);
    if more > 0 {
        all.push(format!("{more} more kinds of warnings are in the JSON object"));
    }
    all
}

fn left_out(partial_of_sweep: &PartialOfSweep, report: &SweepReport) -> Vec<String> {
    let names: Vec<String> = partial_of_sweep
        .left_out
        .iter()
        .map(|own| {
            let estimate = estimate(&own.influence.formula, own.influence.value);
            format!("{} ({estimate})", own.effect)
        })
        .collect();
    let most = partial_of_sweep.worst.as_ref().map_or(String::new(), |worst| {
        format!("; `{}` moves by {}, the most of all", worst.measure, apart(worst.most()))
    });
    // Nothing is saved where nothing is left out.
    let saving = if names.is_empty() {
        String::new()
    } else {
        format!(
            "; that took {} in all, where the sweep in full takes about {}",
            duration(report.wall),
            duration(partial_of_sweep.wall_in_full)
        )
    };
    let names = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    let checked = counted(partial_of_sweep.checked.len());
    let mut all = vec![format!(
        "left out everywhere: {names}{most}; solved with and without it at {checked}{saving}"
    )];
    let back: Vec<&str> = partial_of_sweep.put_back.iter().map(|own| own.effect.as_str()).collect();
    if !back.is_empty() {
        all.push(format!("put back, because it matters at one of them: {}", back.join(", ")));
    }
    all
}

fn missing(report: &SweepReport, points: usize) -> Vec<String> {
    let mut all = Vec::new();
    let failed: Vec<_> = report.gaps.iter().filter(|gap| gap.column.is_none()).collect();
    if let Some(first) = failed.first() {
        let have = if failed.len() == 1 { "has" } else { "have" };
        all.push(format!(
            "{} {have} no solution; the first: {}",
            counted(failed.len()),
            first.reason
        ));
    }
    let mut told: Vec<(usize, &str, usize)> = Vec::new();
    for gap in &report.gaps {
        let Some(column) = gap.column else { continue };
        match told.iter_mut().find(|known| (known.0, known.1) == (column, gap.reason.as_str())) {
            Some(known) => known.2 += 1,
            None => told.push((column, &gap.reason, 1)),
        }
    }
    for (column, reason, count) in told.into_iter().take(MOST_TOLD) {
        let name = name(&report.columns[column]);
        all.push(format!("`{name}` has no value at {count} of {points} points: {reason}"));
    }
    all
}
