//! How much each group matters.

use super::{Claim, Mark, row};
use crate::{
    Family, Impact, Scales, Study,
    words::{change, extremes, listed, significant},
};

/// The order in which the thesis says that the groups matter for the energy.
const CLAIMED: [&str; 4] = ["d", "c", "b", "a"];

pub(super) fn claims(study: &Study) -> Vec<Claim> {
    vec![size(study), order(study), early_peak(study)]
}

fn size(study: &Study) -> Claim {
    let changes = study.energy_changes(0.01);
    let is_in = |relative: f64| (0.03..=0.07).contains(&relative);
    let cases = changes.map(|(symbol, by)| (symbol.to_owned(), is_in(by)));
    let words = changes.map(|(symbol, by)| format!("{} % by {symbol}", significant(100.0 * by, 2)));
    let times = [0.001, 0.002, 0.004, 0.01];
    let rows = changes.iter().enumerate().map(|(at, own)| {
        let each = times.map(|time| {
            let relative = study.energy_changes(time)[at].1;
            format!("{} %", significant(100.0 * relative, 2))
        });
        row([own.0.to_owned()].into_iter().chain(each))
    });
    Claim::over(
        "V",
        "varying a, b, c and d changes the energy taken up in the first 10 ms by 3 to 7 %",
        &cases,
    )
    .finding(format!("Over the families it changes by {}.", listed(&words)))
    .shown_by(
        "Change of the energy over each family",
        &["group", "in 1 ms", "in 2 ms", "in 4 ms", "in 10 ms"],
        rows,
    )
}

/// Relative change of a quantity per relative change of the group, between the neighbours of the base.
fn elasticity(family: &Family, of: impl Fn(&Impact) -> f64) -> f64 {
    let [_, below, base, above, _] = &family.members;
    let quantity = (of(&above.impact) - of(&below.impact)) / of(&base.impact);
    quantity / ((above.value - below.value) / base.value)
}

fn order(study: &Study) -> Claim {
    let energies = Mark::ALL.map(|mark| (format!("energy at {}", mark.text()), Some(mark)));
    let quantities = energies.into_iter().chain([("peak force".to_owned(), None)]);
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (name, mark) in quantities {
        let of = |own: &Impact| mark.map_or_else(|| own.peak().value, |mark| mark.energy(own));
        let mut each =
            study.groups.each_ref().map(|group| (group.varied.symbol(), elasticity(group, of)));
        let texts = each.map(|own| significant(own.1, 2));
        each.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let found = each.map(|own| own.0);
        let listed = found.join(", ");
        cases.push((name.clone(), found == CLAIMED));
        words.push(format!("{listed} by {name}"));
        rows.push(row([name].into_iter().chain(texts).chain([listed])));
    }
    Claim::over("V", "d matters most for the energy, then c, b and a", &cases)
        .finding(format!("The order is {}.", listed(&words)))
        .shown_by(
            "Percent of change per percent of the group, around the base",
            &["quantity", "a", "b", "c", "d", "order"],
            rows,
        )
}

fn early_peak(study: &Study) -> Claim {
    let milliseconds = 1e3 * Scales::CHAPTER_4.time();
    let all = study.families().flat_map(|family| family.each(|own| own.peak().time));
    let [low, high] = extremes(all).map(|own| own * milliseconds);
    let share = study.printed.energy(study.printed.peak().time) / study.printed.energy(5.0);
    let [low, last] = [low, high].map(|own| significant(own, 3));
    Claim::single("V", "the peak force occurs in the first few milliseconds", high < 3.0).finding(
        format!(
            "Over all families it is at {low} to {last} ms. By then the base has taken up {} of \
             the energy of 10 ms.",
            change(share).trim_start_matches('+'),
        ),
    )
}
