//! The thickness as a limit, and the range in which the thesis says that its conclusions hold.

use dashpot_plot::Table;

use super::{Claim, Verdict, row};
use crate::{
    Groups, Impact, Padding, Scales, Study, Support, ThesisError, Varied,
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

/// Values of a group between which a padding exists, all else at base; the upper one may be infinite.
fn existence(varied: Varied) -> (f64, f64) {
    let ranges = Groups::PRINTED.ranges();
    let found = match varied {
        Varied::A => Some(ranges.a),
        Varied::B => ranges.b,
        Varied::C => ranges.c,
        _ => ranges.d,
    };
    found.unwrap_or((f64::NAN, f64::NAN))
}

fn thickness(study: &Study) -> Result<Claim, ThesisError> {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    let (mut words, mut free) = (Vec::new(), Vec::new());
    for family in &study.groups {
        let varied = family.varied;
        let symbol = varied.symbol().to_owned();
        let values = varied.values();
        let (low, high) = existence(varied);
        let ends = [
            low.max(values[0] / FARTHER) * (1.0 + NEAR),
            high.min(values[4] * FARTHER) * (1.0 - NEAR),
        ];
        let limit = varied.limit(ends[0], ends[1])?;
        let mut beyond = Vec::new();
        for end in ends {
            beyond.push(varied.impact(end)?.deepest().value);
        }
        if let Some(limit) = limit {
            let side = if beyond[0] > 1.0 { "above" } else { "below" };
            words.push(format!("{symbol} has to stay {side} {}", significant(limit, 6)));
        } else {
            free.push(symbol.clone());
        }
        cases.push((symbol.clone(), limit.is_some()));
        rows.push(row([
            symbol,
            limit.map_or_else(|| "none".to_owned(), |limit| significant(limit, 6)),
            significant(low, 5),
            significant(high, 5),
            format!("{} at {}", significant(beyond[0], 4), short(ends[0], 4)),
            format!("{} at {}", significant(beyond[1], 4), short(ends[1], 4)),
        ]));
    }
    let header = [
        "group",
        "ξ max = 1",
        "padding exists from",
        "to",
        "ξ max at the lower end",
        "at the upper end",
    ];
    Ok(Claim {
        place: "VI.1",
        says: "the range of each of a, b, c and d is restricted by the largest deformation",
        verdict: Verdict::of(&cases),
        finding: format!(
            "All else at base, {}. Within the range in which a padding exists, q > 0, the deformation \
             does not come to the thickness by {}.",
            listed(&words),
            listed(&free)
        ),
        evidence: vec![Table::new("Limits of each group, all else at base", &header, rows)],
    })
}

fn validity() -> Result<Claim, ThesisError> {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    for k1 in SPRINGS {
        for k2 in SPRINGS {
            for c1 in DASHPOTS {
                for c2 in DASHPOTS {
                    let padding = Padding { k1, c1, k2, c2 };
                    let own = Impact::of_system(&padding, &Support::CHAPTER_4)?;
                    let deepest = own.deepest().value;
                    let name = format!(
                        "K1 {}, K2 {}, C1 {c1}, C2 {c2}",
                        short(k1 / 1e6, 3),
                        short(k2 / 1e6, 3)
                    );
                    cases.push((name.clone(), deepest <= 1.0));
                    let peak = own.peak().value;
                    rows.push(row([name, significant(peak, 4), significant(deepest, 4)]));
                }
            }
        }
    }
    let within = cases.iter().filter(|case| case.1).count();
    let exists = Groups::PRINTED.ranges().c.map_or_else(String::new, |(low, high)| {
        let scales = Scales::CHAPTER_4;
        let stiffness = |c: f64| significant(c * scales.mass / scales.time().powi(2) / 1e6, 3);
        format!(
            " With a, b and d at base a padding exists only for c between {} and {}, which is K2 from {} \
             to {} MN/m.",
            significant(low, 4),
            significant(high, 5),
            stiffness(low),
            stiffness(high)
        )
    });
    let base = Padding::CHAPTER_4.c1;
    let is_inside = (DASHPOTS[0]..=DASHPOTS[1]).contains(&base);
    let verdict = Verdict::of(&[
        ("the base".to_owned(), is_inside),
        ("all corners of the range".to_owned(), within == cases.len()),
    ]);
    Ok(Claim {
        place: "V",
        says: "the conclusions are valid for K of 5 to 30 MN/m and C of 5150 to 7600 N s/m",
        verdict,
        finding: format!(
            "The thesis' own C1 of {base} N s/m lies {}. Of the {} corners of that range, {within} stay \
             within the thickness.{exists}",
            if is_inside { "inside" } else { "outside" },
            cases.len(),
        ),
        evidence: vec![Table::new(
            "Corners of the range, K in MN/m, C in N s/m",
            &["padding", "φ max", "ξ max"],
            rows,
        )],
    })
}
