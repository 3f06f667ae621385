//! Which way the peak force and the energy go with each parameter.

use dashpot_plot::Table;

use super::{Claim, Mark, Trend, Verdict, row};
use crate::{
    Family, Member, Scales, Study, Varied,
    words::{change, listed, significant},
};

/// What the thesis recommends of each parameter: high or low.
const GROUPS: [(Varied, Trend); 4] = [
    (Varied::A, Trend::Rises),
    (Varied::B, Trend::Rises),
    (Varied::C, Trend::Rises),
    (Varied::D, Trend::Falls),
];
const CONSTANTS: [(Varied, Trend); 4] = [
    (Varied::K1, Trend::Rises),
    (Varied::K2, Trend::Rises),
    (Varied::C1, Trend::Falls),
    (Varied::C2, Trend::Falls),
];

pub(super) fn claims(study: &Study) -> Vec<Claim> {
    vec![
        peak(study, GROUPS, "raising a, b or c, or lowering d, lowers the peak force"),
        energy(
            study,
            GROUPS,
            "raising a, b or c, or lowering d, makes the padding take up more energy early on",
        ),
        peak(
            study,
            CONSTANTS,
            "the highest springs K1, K2 and the lowest dashpots C1, C2 give the lowest peak force",
        ),
        energy(
            study,
            CONSTANTS,
            "the highest springs and the lowest dashpots take up the most energy early on",
        ),
    ]
}

fn chosen(study: &Study, of: [(Varied, Trend); 4]) -> impl Iterator<Item = (&Family, Trend)> {
    of.into_iter().filter_map(|(varied, wish)| Some((study.family(varied)?, wish)))
}

/// Whether values of a family, in the order of its parameter, rise where the parameter is moved as
/// wished; with `falls` whether they fall.
fn follows(values: &[f64], wish: Trend, falls: bool) -> bool {
    let wanted = if (wish == Trend::Rises) == falls { Trend::Falls } else { Trend::Rises };
    Trend::of(values) == wanted
}

/// First and last value, with a word where the way between is not one way.
fn span(values: &[f64]) -> String {
    let [first, .., last] = values else { return String::new() };
    let way = if Trend::of(values) == Trend::TurnsAround { ", turns around" } else { "" };
    format!("{} → {}{way}", significant(*first, 4), significant(*last, 4))
}

/// The range of a family's parameter.
fn range(family: &Family) -> String {
    let text =
        |at: Option<&Member>| at.map_or_else(String::new, |own| family.varied.text(own.value));
    format!("{} → {}", text(family.members.first()), text(family.members.last()))
}

fn total(values: &[f64]) -> f64 {
    values.first().zip(values.last()).map_or(f64::NAN, |(first, last)| last / first - 1.0)
}

fn place(of: [(Varied, Trend); 4]) -> &'static str {
    if of == GROUPS { "V, VI.3" } else { "V, VI.3, D" }
}

fn peak(study: &Study, of: [(Varied, Trend); 4], says: &'static str) -> Claim {
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (family, wish) in chosen(study, of) {
        let symbol = family.varied.symbol();
        let peaks = family.each(|own| own.peak().value);
        cases.push((symbol.to_owned(), follows(&peaks, wish, true)));
        let kilonewtons: Vec<f64> =
            peaks.iter().map(|peak| peak * Scales::CHAPTER_4.force() / 1e3).collect();
        let changed = change(total(&peaks));
        words.push(format!("{} changes it by {changed}", range_of(symbol, family)));
        rows.push(row([
            symbol.to_owned(),
            range(family),
            span(&peaks),
            span(&kilonewtons),
            changed,
        ]));
    }
    Claim {
        place: place(of),
        says,
        verdict: Verdict::of(&cases),
        finding: format!("{}.", listed(&words)),
        evidence: vec![Table::new(
            "Peak force over each family",
            &["parameter", "range", "φ max", "kN in chapter IV", "change"],
            rows,
        )],
    }
}

fn range_of(symbol: &str, family: &Family) -> String {
    format!("{symbol} {}", range(family))
}

fn energy(study: &Study, of: [(Varied, Trend); 4], says: &'static str) -> Claim {
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (family, wish) in chosen(study, of) {
        let symbol = family.varied.symbol();
        let each = Mark::ALL.map(|mark| (mark, family.each(|own| mark.energy(own))));
        let good = each.iter().filter(|own| follows(&own.1, wish, false));
        let good: Vec<String> = good.map(|good| good.0.text()).collect();
        if good.len() == each.len() {
            cases.push((symbol.to_owned(), true));
        } else if good.is_empty() {
            cases.push((symbol.to_owned(), false));
        } else {
            cases.push((format!("{symbol} ({})", good.join(", ")), true));
            cases.push((symbol.to_owned(), false));
        }
        let changes: Vec<String> = each
            .iter()
            .map(|own| format!("{} at {}", change(total(&own.1)), own.0.text()))
            .collect();
        words.push(format!("{}: {}", range_of(symbol, family), changes.join(", ")));
        let spans = each.iter().map(|own| span(&own.1));
        rows.push(row([symbol.to_owned(), range(family)].into_iter().chain(spans)));
    }
    Claim {
        place: place(of),
        says,
        verdict: Verdict::of(&cases),
        finding: format!("Energy over the range: {}.", words.join("; ")),
        evidence: vec![energies(rows)],
    }
}

fn energies(rows: Vec<Vec<String>>) -> Table {
    let marks = Mark::ALL.map(Mark::text);
    let header: Vec<&str> =
        ["parameter", "range"].into_iter().chain(marks.iter().map(String::as_str)).collect();
    Table::new("Energy ω in the padding over each family", &header, rows)
}
