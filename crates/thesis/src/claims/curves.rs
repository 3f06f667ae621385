//! What the force curves and the stress–strain curves do.

use dashpot_dae::Extremum;
use dashpot_numerics::roots::monotone_root;

use dashpot_plot::Table;

use super::{Claim, OVER_VALUES, Verdict, are_opposed, over, row};
use crate::{
    DURATION, Family, Impact, Study, ThesisError, Varied,
    words::{change, listed, significant},
};

/// Share of the peak at which the decay of a force is timed.
const HALF: f64 = 0.5;
/// Deformation at which slopes of stress–strain curves are compared, besides the beginning.
const STRAIN: f64 = 0.2;
/// Slopes that differ by less are called the same.
const SAME: f64 = 0.01;
/// A share of the impact energy below which it is called very small.
const VERY_SMALL: f64 = 0.02;

pub(super) fn claims(study: &Study) -> Result<Vec<Claim>, ThesisError> {
    Ok(vec![
        crossing(study),
        decay(study),
        slopes(study),
        trade(study),
        separation(study),
        tension(study),
        late_maximum(study)?,
    ])
}

fn ends(family: &Family) -> Option<[&Impact; 2]> {
    Some([&family.members.first()?.impact, &family.members.last()?.impact])
}

/// The first τ* after the beginning at which the forces of two impacts are equal.
fn meeting(one: &Impact, other: &Impact) -> Option<f64> {
    /// The curves run apart slowly compared with this share of the impact.
    const STEPS: i32 = 400;
    let end = one.end().min(other.end());
    let time = |at: i32| end * f64::from(at) / f64::from(STEPS);
    let gap = |time: f64| one.force(time) - other.force(time);
    (1..STEPS).find_map(|at| monotone_root(gap, time(at), time(at + 1)))
}

fn crossing(study: &Study) -> Claim {
    let cell = |own: Option<f64>| own.map_or_else(|| "–".to_owned(), |at| significant(at, 3));
    let (cases, rows) = over(study.families(), |family| {
        let pairs = family.members.windows(2);
        let meetings: Vec<Option<f64>> =
            pairs.map(|pair| meeting(&pair[0].impact, &pair[1].impact)).collect();
        (meetings.iter().all(Option::is_some), meetings.into_iter().map(cell))
    });
    let header = ["parameter", "1st and 2nd value", "2nd and 3rd", "3rd and 4th", "4th and 5th"];
    Claim {
        place: "V",
        says: "the curves of force over time cross",
        verdict: Verdict::of(&cases),
        finding:
            "Of each family, the curves of neighbouring values were followed from the start to \
                  the first release."
                .to_owned(),
        evidence: vec![Table::new(
            "τ* at which neighbouring force curves first cross",
            &header,
            rows,
        )],
    }
}

fn decay(study: &Study) -> Claim {
    let (cases, rows) = over(study.families(), |family| {
        let peaks = family.each(|own| own.peak().value);
        let times = family.each(|own| own.decays_to(HALF).unwrap_or(f64::NAN) - own.peak().time);
        let is_opposed = are_opposed(&peaks, &times);
        let cells = peaks.into_iter().zip(times);
        let cell = |(peak, time)| format!("{}: {}", significant(peak, 3), significant(time, 3));
        (is_opposed, cells.map(cell))
    });
    Claim {
        place: "V",
        says: "the higher the peak force, the faster the force decays",
        verdict: Verdict::of(&cases),
        finding: "Timed from the peak to half of it.".to_owned(),
        evidence: vec![Table::new(
            "φ max: τ* from the peak to half of it, over the values of each family",
            &OVER_VALUES,
            rows,
        )],
    }
}

/// The slope of the stress–strain curve where the deformation is first so large.
fn slope_at(impact: &Impact, strain: f64) -> f64 {
    let rising = |time: f64| impact.deformation(time) - strain;
    // The deformation rises at the speed 1 at first, and is beyond the strain within twice its time.
    monotone_root(rising, 0.0, 2.0 * strain).map_or(f64::NAN, |time| impact.slope(time))
}

fn slopes(study: &Study) -> Claim {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    for family in &study.groups {
        let Some(ends) = ends(family) else { continue };
        let symbol = family.varied.symbol().to_owned();
        let pairs = [ends.map(|end| end.slope(0.0)), ends.map(|end| slope_at(end, STRAIN))];
        let is_same = pairs.iter().all(|[first, last]| (last / first - 1.0).abs() < SAME);
        cases.push((symbol.clone(), is_same));
        let cells = pairs
            .iter()
            .map(|[first, last]| format!("{} → {}", significant(*first, 4), significant(*last, 4)));
        rows.push(row([symbol].into_iter().chain(cells)));
    }
    let first = ends_of_c(study);
    Claim {
        place: "V",
        says: "varying a, b, c and d does not change the slope of the stress–strain curves",
        verdict: Verdict::of(&cases),
        finding: format!(
            "The slope at the beginning is c: it goes {first} over the family of c, and only there. \
             At ξ = {STRAIN} it changes with every group."
        ),
        evidence: vec![Table::new(
            "Slope dφ/dξ over each family",
            &["group", "at the beginning", "at ξ = 0.2"],
            rows,
        )],
    }
}

fn ends_of_c(study: &Study) -> String {
    let of_c = study.family(Varied::C).and_then(ends);
    of_c.map_or_else(String::new, |of_c| {
        let [first, last] = of_c.map(|impact| significant(impact.slope(0.0), 3));
        format!("from {first} to {last}")
    })
}

fn trade(study: &Study) -> Claim {
    let (cases, rows) = over(study.families(), |family| {
        let peaks = family.each(|own| own.peak().value);
        let depths = family.each(|own| own.deepest().value);
        let is_opposed = are_opposed(&peaks, &depths);
        let cells = peaks.into_iter().zip(depths);
        let cell = |(peak, depth)| format!("{} at {}", significant(peak, 4), significant(depth, 4));
        (is_opposed, cells.map(cell))
    });
    Claim {
        place: "V",
        says: "the peak force is the higher, the smaller the largest deformation is",
        verdict: Verdict::of(&cases),
        finding: "Where both go with a parameter without turning, in opposite ways.".to_owned(),
        evidence: vec![Table::new(
            "φ max at ξ max, over the values of each family",
            &OVER_VALUES,
            rows,
        )],
    }
}

fn separation(study: &Study) -> Claim {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    let mut most = 0.0_f64;
    for family in study.families() {
        for member in &family.members {
            let own = &member.impact;
            let name = format!("{} = {}", family.varied.symbol(), family.varied.text(member.value));
            let Some(release) = own.release() else {
                rows.push(row([name.clone(), "–".to_owned()]));
                cases.push((name, true));
                continue;
            };
            let speed = own.impactor_speed(release);
            let Extremum { time, .. } = own.deepest();
            most = most.max(speed * speed);
            cases.push((name.clone(), release > time));
            let cells = [time, release, speed].map(|value| significant(value, 3));
            rows.push(row([name].into_iter().chain(cells)));
        }
    }
    Claim {
        place: "V",
        says: "the force turns to tension only late, when the impact is completed",
        verdict: Verdict::of(&cases),
        finding: format!(
            "In every impact it does so after the largest deformation; the impactor then has at most \
             {} % of its energy.",
            significant(100.0 * most, 2)
        ),
        evidence: vec![Table::new(
            "Release",
            &["impact", "ξ max at τ*", "release at τ*", "impactor's ζ′ then"],
            rows,
        )],
    }
}

fn tension(study: &Study) -> Claim {
    let shares_of = |family: &Family| family.each(|own| own.energy_after_release() / 0.5);
    let most = study.families().flat_map(shares_of).fold(0.0, f64::max);
    let (cases, rows) = over(study.families(), |family| {
        let shares = shares_of(family);
        let is_small = shares.iter().all(|share| *share < VERY_SMALL);
        let cell = |share| change(share).trim_start_matches('+').to_owned();
        (is_small, shares.into_iter().map(cell))
    });
    let base = study.printed.energy_after_release() / 0.5;
    Claim {
        place: "V",
        says: "the strain energy that goes with tension is very small beside the impact energy",
        verdict: Verdict::of(&cases),
        finding: format!(
            "From the release to τ* = {DURATION} the padding takes up {} % of the impact energy at base, \
             in any family at most {} %; below {} % counts as very small.",
            significant(100.0 * base, 2),
            significant(100.0 * most, 2),
            significant(100.0 * VERY_SMALL, 1)
        ),
        evidence: vec![Table::new(
            "Energy taken up after the release over the impact energy, for the values of each family",
            &OVER_VALUES,
            rows,
        )],
    }
}

/// Two values of b between which two maxima of the deformation swap places.
const SWAP: [f64; 2] = [52.0, 54.0];

fn maxima(name: String, impact: &Impact) -> Vec<String> {
    let all = impact.maxima_of_deformation();
    let all = all
        .iter()
        .map(|own| format!("{} at {}", significant(own.value, 4), significant(own.time, 3)))
        .collect::<Vec<_>>();
    row([name, significant(impact.deepest().time, 4), all.join(", ")])
}

fn late_maximum(study: &Study) -> Result<Claim, ThesisError> {
    let (mut cases, mut rows, mut early) = (Vec::new(), Vec::new(), Vec::new());
    for family in study.families() {
        for member in &family.members {
            let name = format!("{} = {}", family.varied.symbol(), family.varied.text(member.value));
            let deepest = member.impact.deepest();
            if deepest.time <= 2.0 {
                early.push(format!("{name} ({})", significant(deepest.time, 3)));
            }
            rows.push(maxima(name, &member.impact));
        }
        let is_late = family.members.iter().all(|member| member.impact.deepest().time > 2.0);
        cases.push((family.varied.symbol().to_owned(), is_late));
    }
    let mut jump = Vec::new();
    for b in SWAP {
        let own = Varied::B.impact(b)?;
        rows.push(maxima(format!("b = {b}"), &own));
        jump.push(format!("{} at b = {b}", significant(own.deepest().time, 3)));
    }
    Ok(Claim {
        place: "III",
        says: "the deformation is largest after τ* = 2",
        verdict: Verdict::of(&cases),
        finding: format!(
            "Earlier in the families: {}. Where two maxima swap places its time jumps: it is {}.",
            listed(&early),
            listed(&jump)
        ),
        evidence: vec![Table::new(
            "Largest deformation",
            &["impact", "at τ*", "local maxima"],
            rows,
        )],
    })
}
