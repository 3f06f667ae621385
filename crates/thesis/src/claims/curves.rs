//! What the force curves and the stress–strain curves do.

use dashpot_dae::Extremum;
use dashpot_numerics::roots::monotone_root;

use super::{Claim, OVER_VALUES, Trend, over, row};
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

fn ends(family: &Family) -> [&Impact; 2] {
    let [first, .., last] = &family.members;
    [&first.impact, &last.impact]
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
    Claim::over("V", "the curves of force over time cross", &cases)
        .finding(
            "Of each family, the curves of neighbouring values were followed from the start to \
                  the first release.",
        )
        .shown_by("τ* at which neighbouring force curves first cross", &header, rows)
}

/// Over each family the peak force, and a quantity that is claimed to go the other way without turning.
fn beside_peaks(
    study: &Study,
    (digits, word): (usize, &str),
    of: fn(&Impact) -> f64,
) -> (Vec<(String, bool)>, Vec<Vec<String>>) {
    over(study.families(), |family| {
        let (peaks, others) = (family.each(|own| own.peak().value), family.each(of));
        let ways = [Trend::of(&peaks), Trend::of(&others)];
        let is_opposed =
            ways == [Trend::Rises, Trend::Falls] || ways == [Trend::Falls, Trend::Rises];
        let cell = move |(peak, own): (f64, f64)| {
            significant(peak, digits) + word + &significant(own, digits)
        };
        (is_opposed, peaks.into_iter().zip(others).map(cell))
    })
}

fn decay(study: &Study) -> Claim {
    let time = |own: &Impact| own.decays_to(HALF).unwrap_or(f64::NAN) - own.peak().time;
    let (cases, rows) = beside_peaks(study, (3, ": "), time);
    let caption = "φ max: τ* from the peak to half of it, over the values of each family";
    Claim::over("V", "the higher the peak force, the faster the force decays", &cases)
        .finding("Timed from the peak to half of it.")
        .shown_by(caption, &OVER_VALUES, rows)
}

/// The slope of the stress–strain curve where the deformation is first so large.
fn slope_at(impact: &Impact, strain: f64) -> f64 {
    let rising = |time: f64| impact.deformation(time) - strain;
    // The deformation rises at the speed 1 at first, and is beyond the strain within twice its time.
    monotone_root(rising, 0.0, 2.0 * strain).map_or(f64::NAN, |time| impact.slope(time))
}

fn slopes(study: &Study) -> Claim {
    let (cases, rows) = over(study.groups.iter(), |family| {
        let ends = ends(family);
        let pairs = [ends.map(|end| end.slope(0.0)), ends.map(|end| slope_at(end, STRAIN))];
        let is_same = pairs.iter().all(|[first, last]| (last / first - 1.0).abs() < SAME);
        let cell = |pair: [f64; 2]| pair.map(|own| significant(own, 4)).join(" → ");
        (is_same, pairs.map(cell))
    });
    let [first, last] =
        ends(study.family(Varied::C)).map(|impact| significant(impact.slope(0.0), 3));
    Claim::over(
        "V",
        "varying a, b, c and d does not change the slope of the stress–strain curves",
        &cases,
    )
    .finding(format!(
        "The slope at the beginning is c: it goes from {first} to {last} over the family of c, and \
         only there. At ξ = {STRAIN} it changes with every group."
    ))
    .shown_by(
        "Slope dφ/dξ over each family",
        &["group", "at the beginning", "at ξ = 0.2"],
        rows,
    )
}

fn trade(study: &Study) -> Claim {
    let (cases, rows) = beside_peaks(study, (4, " at "), |own| own.deepest().value);
    Claim::over("V", "the peak force is the higher, the smaller the largest deformation is", &cases)
        .finding("Where both go with a parameter without turning, in opposite ways.")
        .shown_by("φ max at ξ max, over the values of each family", &OVER_VALUES, rows)
}

fn separation(study: &Study) -> Claim {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    let mut most = 0.0_f64;
    for (name, own) in study.members() {
        let Some(release) = own.release() else {
            rows.push(vec![name.clone(), "–".to_owned()]);
            cases.push((name, true));
            continue;
        };
        let (deepest, speed) = (own.deepest().time, own.impactor_speed(release));
        most = most.max(speed * speed);
        cases.push((name.clone(), release > deepest));
        let cells = [deepest, release, speed].map(|value| significant(value, 3));
        rows.push(row([name].into_iter().chain(cells)));
    }
    let header = ["impact", "ξ max at τ*", "release at τ*", "impactor's ζ′ then"];
    Claim::over("V", "the force turns to tension only late, when the impact is completed", &cases)
        .finding(format!(
            "In every impact it does so after the largest deformation; the impactor then has at \
             most {} % of its energy.",
            significant(100.0 * most, 2)
        ))
        .shown_by("Release", &header, rows)
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
    let [base, most] = [base, most].map(|share| significant(100.0 * share, 2));
    let says = "the strain energy that goes with tension is very small beside the impact energy";
    Claim::over("V", says, &cases)
        .finding(format!(
            "From the release to τ* = {DURATION} the padding takes up {base} % of the impact energy \
             at base, in any family at most {most} %; below {} % counts as very small.",
            significant(100.0 * VERY_SMALL, 1)
        ))
        .shown_by(
            "Energy taken up after the release over the impact energy, for the values of each family",
            &OVER_VALUES,
            rows,
        )
}

/// Two values of b between which two maxima of the deformation swap places.
const SWAP: [f64; 2] = [52.0, 54.0];

fn maxima(name: String, impact: &Impact) -> Vec<String> {
    let at =
        |own: &Extremum| format!("{} at {}", significant(own.value, 4), significant(own.time, 3));
    let all: Vec<String> = impact.maxima_of_deformation().iter().map(at).collect();
    vec![name, significant(impact.deepest().time, 4), all.join(", ")]
}

fn late_maximum(study: &Study) -> Result<Claim, ThesisError> {
    let (mut rows, mut early) = (Vec::new(), Vec::new());
    for (name, own) in study.members() {
        let time = own.deepest().time;
        if time <= 2.0 {
            early.push(format!("{name} ({})", significant(time, 3)));
        }
        rows.push(maxima(name, own));
    }
    let is_late =
        |family: &Family| family.each(|own| own.deepest().time).iter().all(|own| *own > 2.0);
    let cases: Vec<_> = study
        .families()
        .map(|family| (family.varied.symbol().to_owned(), is_late(family)))
        .collect();
    let mut jump = Vec::new();
    for b in SWAP {
        let own = Varied::B.impact(b)?;
        rows.push(maxima(format!("b = {b}"), &own));
        jump.push(format!("{} at b = {b}", significant(own.deepest().time, 3)));
    }
    Ok(Claim::over("III", "the deformation is largest after τ* = 2", &cases)
        .finding(format!(
            "Earlier in the families: {}. Where two maxima swap places its time jumps: it is {}.",
            listed(&early),
            listed(&jump)
        ))
        .shown_by("Largest deformation", &["impact", "at τ*", "local maxima"], rows))
}
