//! How much each group matters.

use dashpot_plot::Table;

use super::{Claim, Mark, Verdict, row};
use crate::{
    Family, Impact, Scales, Study,
    words::{change, listed, significant},
};

/// The order in which the thesis says that the groups matter for the energy.
const CLAIMED: [&str; 4] = ["d", "c", "b", "a"];

pub(super) fn claims(study: &Study) -> Vec<Claim> {
    vec![size(study), order(study), early_peak(study)]
}

fn size(study: &Study) -> Claim {
    let changes = study.energy_changes(0.01);
    let is_in = |relative: f64| (0.03..=0.07).contains(&relative);
    let cases: Vec<_> =
        changes.iter().map(|change| (change.0.to_owned(), is_in(change.1))).collect();
    let words: Vec<String> = changes
        .iter()
        .map(|change| format!("{} % by {}", significant(100.0 * change.1, 2), change.0))
        .collect();
    let times = [0.001, 0.002, 0.004, 0.01];
    let rows = changes.iter().enumerate().map(|(at, own)| {
        let each = times.map(|time| {
            let relative = study.energy_changes(time)[at].1;
            format!("{} %", significant(100.0 * relative, 2))
        });
        row([own.0.to_owned()].into_iter().chain(each))
    });
    Claim {
        place: "V",
        says: "varying a, b, c and d changes the energy taken up in the first 10 ms by 3 to 7 %",
        verdict: Verdict::of(&cases),
        finding: format!("Over the families it changes by {}.", listed(&words)),
        evidence: vec![Table::new(
            "Change of the energy over each family",
            &["group", "in 1 ms", "in 2 ms", "in 4 ms", "in 10 ms"],
            rows,
        )],
    }
}

/// What is read off an impact.
type Quantity = Box<dyn Fn(&Impact) -> f64>;

/// Relative change of a quantity per relative change of the group, between the neighbours of the base.
fn elasticity(family: &Family, of: impl Fn(&Impact) -> f64) -> f64 {
    let [_, below, base, above, _] = &family.members[..] else { return f64::NAN };
    let quantity = (of(&above.impact) - of(&below.impact)) / of(&base.impact);
    quantity / ((above.value - below.value) / base.value)
}

fn order(study: &Study) -> Claim {
    let mut quantities: Vec<(String, Quantity)> = Vec::new();
    for mark in Mark::ALL {
        quantities
            .push((format!("energy at {}", mark.text()), Box::new(move |own| mark.energy(own))));
    }
    quantities.push(("peak force".to_owned(), Box::new(|own| own.peak().value)));
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (name, of) in &quantities {
        let mut each: Vec<(&str, f64)> = study
            .groups
            .iter()
            .map(|group| (group.varied.symbol(), elasticity(group, of)))
            .collect();
        let texts: Vec<String> = each.iter().map(|own| significant(own.1, 2)).collect();
        each.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let found: Vec<&str> = each.iter().map(|own| own.0).collect();
        cases.push((name.clone(), found == CLAIMED));
        words.push(format!("{} by {name}", found.join(", ")));
        rows.push(row([name.clone()].into_iter().chain(texts).chain([found.join(", ")])));
    }
    Claim {
        place: "V",
        says: "d matters most for the energy, then c, b and a",
        verdict: Verdict::of(&cases),
        finding: format!("The order is {}.", listed(&words)),
        evidence: vec![Table::new(
            "Percent of change per percent of the group, around the base",
            &["quantity", "a", "b", "c", "d", "order"],
            rows,
        )],
    }
}

fn early_peak(study: &Study) -> Claim {
    let milliseconds = 1e3 * Scales::CHAPTER_4.time();
    let all = study.families().flat_map(|family| family.each(|own| own.peak().time));
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(l, h), own| (l.min(own), h.max(own)));
    let (low, high) = (low * milliseconds, high * milliseconds);
    let share = study.printed.energy(study.printed.peak().time) / study.printed.energy(5.0);
    Claim {
        place: "V",
        says: "the peak force occurs in the first few milliseconds",
        verdict: Verdict::single(high < 3.0),
        finding: format!(
            "Over all families it is at {} to {} ms. By then the base has taken up {} of the energy \
             of 10 ms.",
            significant(low, 3),
            significant(high, 3),
            change(share).trim_start_matches('+'),
        ),
        evidence: Vec::new(),
    }
}
