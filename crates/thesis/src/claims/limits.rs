//! The thickness as a limit, and the range in which the thesis says that its conclusions hold.

use super::{Claim, row};
use crate::{
    Groups, Impact, Padding, Scales, Study, Support, ThesisError,
    words::{listed, short, significant},
};

/// Springs \[N/m\] and dashpots \[N s/m\] between which chapter V says that it is valid.
const SPRINGS: [f64; 2] = [5e6, 30e6];
const DASHPOTS: [f64; 2] = [5150.0, 7600.0];
/// Ranges are looked at as far as this beyond the families, as a factor.
const FARTHER: f64 = 4.0;
/// A value so near to where no padding exists is taken as its end.
const NEAR: f64 = 1e-3;

pub(super) fn claims(study: &Study) -> Result<Vec<Claim>, ThesisError> {
    Ok(vec![thickness(study)?, validity()?])
}

fn thickness(study: &Study) -> Result<Claim, ThesisError> {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    let (mut words, mut free) = (Vec::new(), Vec::new());
    for (family, exists) in study.groups.iter().zip(Groups::PRINTED.ranges().0) {
        let varied = family.varied;
        let symbol = varied.symbol().to_owned();
        let values = varied.values();
        let (low, high) = exists.unwrap_or((f64::NAN, f64::NAN));
        let lower = low.max(values[0] / FARTHER) * (1.0 + NEAR);
        let upper = high.min(values[4] * FARTHER) * (1.0 - NEAR);
        let limit = varied.limit(lower, upper)?;
        let beyond = [varied.impact(lower)?.deepest().value, varied.impact(upper)?.deepest().value];
        let shown = limit.map(|limit| significant(limit, 6));
        if let Some(shown) = &shown {
            let side = if beyond[0] > 1.0 { "above" } else { "below" };
            words.push(format!("{symbol} has to stay {side} {shown}"));
        } else {
            free.push(symbol.clone());
        }
        cases.push((symbol.clone(), limit.is_some()));
        let at = |(value, end)| format!("{} at {}", significant(value, 4), short(end, 4));
        let [lower, upper] = [(beyond[0], lower), (beyond[1], upper)].map(at);
        let [low, high] = [low, high].map(|end| significant(end, 5));
        rows.push(vec![symbol, shown.unwrap_or("none".to_owned()), low, high, lower, upper]);
    }
    let header = [
        "group",
        "ξ max = 1",
        "padding exists from",
        "to",
        "ξ max at the lower end",
        "at the upper end",
    ];
    Ok(Claim::over(
        "VI.1",
        "the range of each of a, b, c and d is restricted by the largest deformation",
        &cases,
    )
    .finding(format!(
        "All else at base, {}. Within the range in which a padding exists, q > 0, the deformation \
             does not come to the thickness by {}.",
        listed(&words),
        listed(&free)
    ))
    .shown_by("Limits of each group, all else at base", &header, rows))
}

fn validity() -> Result<Claim, ThesisError> {
    let mut rows = Vec::new();
    let mut within = 0;
    for corner in 0..16_usize {
        let [k1, k2] = [3, 2].map(|bit| SPRINGS[corner >> bit & 1]);
        let [c1, c2] = [1, 0].map(|bit| DASHPOTS[corner >> bit & 1]);
        let padding = Padding { k1, c1, k2, c2 };
        let own = Impact::of_system(&padding, &Support::CHAPTER_4)?;
        let deepest = own.deepest().value;
        within += usize::from(deepest <= 1.0);
        let [k1, k2] = [k1, k2].map(|own| short(own / 1e6, 3));
        let values = [own.peak().value, deepest].map(|own| significant(own, 4));
        rows.push(row([format!("K1 {k1}, K2 {k2}, C1 {c1}, C2 {c2}")].into_iter().chain(values)));
    }
    let exists = Groups::PRINTED.ranges().0[2].map_or_else(String::new, |(low, high)| {
        let scales = Scales::CHAPTER_4;
        let stiffness = |c: f64| significant(c * scales.mass / scales.time().powi(2) / 1e6, 3);
        let [from, to] = [low, high].map(stiffness);
        let (low, high) = (significant(low, 4), significant(high, 5));
        format!(
            " With a, b and d at base a padding exists only for c between {low} and {high}, which is K2 from \
             {from} to {to} MN/m."
        )
    });
    let base = Padding::CHAPTER_4.c1;
    let is_inside = (DASHPOTS[0]..=DASHPOTS[1]).contains(&base);
    let parts = [
        ("the base".to_owned(), is_inside),
        ("all corners of the range".to_owned(), within == rows.len()),
    ];
    let (side, all) = (if is_inside { "inside" } else { "outside" }, rows.len());
    let says = "the conclusions are valid for K of 5 to 30 MN/m and C of 5150 to 7600 N s/m";
    let header = ["padding", "φ max", "ξ max"];
    Ok(Claim::over("V", says, &parts)
        .finding(format!(
            "The thesis' own C1 of {base} N s/m lies {side}. Of the {all} corners of that range, \
             {within} stay within the thickness.{exists}"
        ))
        .shown_by("Corners of the range, K in MN/m, C in N s/m", &header, rows))
}
