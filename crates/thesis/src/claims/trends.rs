//! Which way the peak force and the energy go with each parameter.

use super::{Claim, Mark, Trend, row};
use crate::{
    Family, Scales, Study,
    words::{change, listed, significant},
};

/// What the thesis recommends of a, b, c and d, and of K1, K2, C1 and C2: high or low.
const OF_GROUPS: [Trend; 4] = [Trend::Rises, Trend::Rises, Trend::Rises, Trend::Falls];
const OF_CONSTANTS: [Trend; 4] = [Trend::Rises, Trend::Rises, Trend::Falls, Trend::Falls];

pub(super) fn claims(study: &Study) -> Vec<Claim> {
    let groups = || study.groups.iter().zip(OF_GROUPS);
    let constants = || study.constants.iter().zip(OF_CONSTANTS);
    vec![
        peak(groups(), "V, VI.3", "raising a, b or c, or lowering d, lowers the peak force"),
        energy(
            groups(),
            "V, VI.3",
            "raising a, b or c, or lowering d, makes the padding take up more energy early on",
        ),
        peak(
            constants(),
            "V, VI.3, D",
            "the highest springs K1, K2 and the lowest dashpots C1, C2 give the lowest peak force",
        ),
        energy(
            constants(),
            "V, VI.3, D",
            "the highest springs and the lowest dashpots take up the most energy early on",
        ),
    ]
}

/// Whether values of a family, in the order of its parameter, rise where the parameter is moved as
/// wished; with `falls` whether they fall.
fn follows(values: &[f64], wish: Trend, falls: bool) -> bool {
    let wanted = if (wish == Trend::Rises) == falls { Trend::Falls } else { Trend::Rises };
    Trend::of(values) == wanted
}

/// First and last value, with a word where the way between is not one way.
fn span(values: &[f64; 5]) -> String {
    let way = if Trend::of(values) == Trend::TurnsAround { ", turns around" } else { "" };
    format!("{} → {}{way}", significant(values[0], 4), significant(values[4], 4))
}

/// The range of a family's parameter.
fn range(family: &Family) -> String {
    let [first, .., last] = family.varied.values().map(|own| family.varied.text(own));
    format!("{first} → {last}")
}

/// The change over a family in percent.
fn total(values: &[f64; 5]) -> String {
    change(values[4] / values[0] - 1.0)
}

fn peak<'f>(
    families: impl Iterator<Item = (&'f Family, Trend)>,
    place: &'static str,
    says: &'static str,
) -> Claim {
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (family, wish) in families {
        let symbol = family.varied.symbol().to_owned();
        let peaks = family.each(|own| own.peak().value);
        cases.push((symbol.clone(), follows(&peaks, wish, true)));
        let kilonewtons = peaks.map(|peak| peak * Scales::CHAPTER_4.force() / 1e3);
        let (range, changed) = (range(family), total(&peaks));
        words.push(format!("{symbol} {range} changes it by {changed}"));
        rows.push(vec![symbol, range, span(&peaks), span(&kilonewtons), changed]);
    }
    Claim::over(place, says, &cases).finding(format!("{}.", listed(&words))).shown_by(
        "Peak force over each family",
        &["parameter", "range", "φ max", "kN in chapter IV", "change"],
        rows,
    )
}

fn energy<'f>(
    families: impl Iterator<Item = (&'f Family, Trend)>,
    place: &'static str,
    says: &'static str,
) -> Claim {
    let marks = Mark::ALL.map(Mark::text);
    let (mut cases, mut rows, mut words) = (Vec::new(), Vec::new(), Vec::new());
    for (family, wish) in families {
        let symbol = family.varied.symbol().to_owned();
        let each = Mark::ALL.map(|mark| family.each(|own| mark.energy(own)));
        let named = marks.iter().zip(&each);
        let good = named.clone().filter(|own| follows(own.1, wish, false));
        let good: Vec<&str> = good.map(|own| own.0.as_str()).collect();
        if !good.is_empty() && good.len() < each.len() {
            cases.push((format!("{symbol} ({})", good.join(", ")), true));
        }
        cases.push((symbol.clone(), good.len() == each.len()));
        let changes: Vec<String> =
            named.map(|(mark, own)| format!("{} at {mark}", total(own))).collect();
        let range = range(family);
        words.push(format!("{symbol} {range}: {}", changes.join(", ")));
        rows.push(row([symbol, range].into_iter().chain(each.iter().map(span))));
    }
    let header = ["parameter", "range"].into_iter().chain(marks.iter().map(String::as_str));
    Claim::over(place, says, &cases)
        .finding(format!("Energy over the range: {}.", words.join("; ")))
        .shown_by("Energy ω in the padding over each family", &header.collect::<Vec<_>>(), rows)
}
