//! What the groups mean for springs and dashpots, the equivalent model, and gravity.

use dashpot_rheology::appendix_a::TwoMaxwell;

use super::{Claim, OVER_VALUES, Trend, row};
use crate::{
    DURATION, Groups, Impact, Member, Padding, STANDARD_GRAVITY, Scales, Study, ThesisError,
    Varied,
    groups::{in_parallel, two_maxwell},
    words::{change, extremes, listed, significant},
};

/// Responses that differ by less, relative to their largest value, are the same.
const SAME: f64 = 1e-9;
/// What rounding alone may make of such a difference.
const ROUNDING: f64 = 1e-12;

pub(super) fn claims(study: &Study) -> Result<Vec<Claim>, ThesisError> {
    Ok(vec![meaning(study), conservative(study), one_time()?, equivalent(study)?, gravity(study)?])
}

/// A constant of a padding.
type Constant = fn(&Padding) -> f64;

/// What appendix D says: raising a group, a constant of the padding, and which way it goes.
const MEANING: [(Varied, &str, Constant, Trend); 5] = [
    (Varied::A, "K1", |own| own.k1, Trend::Rises),
    (Varied::A, "C1", |own| own.c1, Trend::Falls),
    (Varied::C, "K2", |own| own.k2, Trend::Rises),
    (Varied::C, "C2", |own| own.c2, Trend::Falls),
    (Varied::D, "C2", |own| own.c2, Trend::Rises),
];

fn meaning(study: &Study) -> Claim {
    let (mut cases, mut rows) = (Vec::new(), Vec::new());
    for (varied, constant, of, wanted) in MEANING {
        let members = study.family(varied).members.iter();
        let values: Vec<f64> = members.filter_map(Member::padding).map(|own| of(&own)).collect();
        let name = format!("{constant} with {}", varied.symbol());
        let is_spring = constant.starts_with('K');
        let unit = if is_spring { 1e6 } else { 1e3 };
        let found = Trend::of(&values);
        let [claimed, found_word] = [wanted, found].map(|trend| match trend {
            Trend::Rises => "rises".to_owned(),
            Trend::Falls => "falls".to_owned(),
            Trend::TurnsAround => "does neither".to_owned(),
        });
        cases.push((name.clone(), found == wanted));
        let each: Vec<String> = values.iter().map(|value| significant(value / unit, 4)).collect();
        rows.push(vec![name, claimed, found_word, each.join(", ")]);
    }
    Claim::over(
        "D",
        "raising a raises K1 and lowers C1; raising c raises K2 and lowers C2; lowering d \
               lowers C2",
        &cases,
    )
    .finding(
        "C1 = c m1/(q J) and K1 = d m1/(q J²) both fall when a raises q, and \
                  C2 = d m1/(b J) does not know c.",
    )
    .shown_by(
        "Constants of the padding over each family, in MN/m and kN s/m",
        &["constant", "claimed", "found", "values"],
        rows,
    )
}

fn conservative(study: &Study) -> Claim {
    let nu = |impact: &Impact| impact.groups.d / impact.groups.c;
    let rows = study.families().map(|family| {
        let each = family.each(nu).map(|own| significant(own, 3));
        row([family.varied.symbol().to_owned()].into_iter().chain(each))
    });
    let [least, most] = extremes(study.families().flat_map(|family| family.each(nu)));
    Claim::single("III", "ν = 10 is a conservative estimate", least >= 10.0)
        .finding(format!(
            "It is the base's own d/c = {}. Over the families d/c is {} to {}.",
            significant(nu(&study.printed), 3),
            significant(least, 3),
            significant(most, 3)
        ))
        .shown_by("ν = d/c over each family", &OVER_VALUES, rows)
}

fn one_time() -> Result<Claim, ThesisError> {
    let TwoMaxwell { slow, fast } = two_maxwell(Padding::CHAPTER_4)?;
    let Padding { k1, c1, .. } = Padding::CHAPTER_4;
    let [slow, fast] = [slow, fast].map(|own| 1e3 * own.dashpot / own.spring);
    let creep = 1e3 * c1 / k1;
    let is_one = [slow, fast].iter().all(|own| (own / creep - 1.0).abs() < SAME);
    let rows =
        [("relaxation, slow", slow), ("relaxation, fast", fast), ("retardation, C1/K1", creep)]
            .map(|(name, time)| vec![name.to_owned(), significant(time, 5)]);
    let [slow, fast] = [slow, fast].map(|own| significant(own, 4));
    Ok(Claim::single("VI", "the model has one relaxation time, C1/K1", is_one)
        .finding(format!(
            "C1/K1 = {} ms is its one retardation time, that of creep. Held at a deformation it \
             relaxes with two times, {slow} and {fast} ms.",
            significant(creep, 3)
        ))
        .shown_by("Times of the padding of chapter IV", &["time", "ms"], rows))
}

fn equivalent(study: &Study) -> Result<Claim, ThesisError> {
    let own = study.system.groups;
    let pad = in_parallel(two_maxwell(own.padding(&Scales::UNIT)?)?);
    let other = Impact::solve(&own, &own.network_with(&Scales::UNIT, pad))?;
    let times = (0..=500).map(|at| DURATION * f64::from(at) / 500.0);
    let differences = times.map(|time| {
        let force = other.force(time) - study.system.force(time);
        let deformation = other.deformation(time) - study.system.deformation(time);
        (force / study.system.peak().value).abs().max(deformation.abs())
    });
    let most = differences.fold(0.0, f64::max);
    let TwoMaxwell { slow, fast } = two_maxwell(Padding::CHAPTER_4)?;
    let rows = [("3", slow), ("4", fast)].into_iter().flat_map(|(number, own)| {
        let parts = [("K", own.spring / 1e6), ("C", own.dashpot / 1e3)];
        parts.map(|(letter, value)| vec![format!("{letter}{number}"), significant(value, 6)])
    });
    Ok(Claim::single(
        "A",
        "two Maxwell elements in parallel describe the padding with equal precision",
        most < SAME,
    )
    .finding(format!(
        "In the impact of chapter IV force and deformation differ by {}.",
        if most < ROUNDING {
            "rounding alone".to_owned()
        } else {
            format!("{} of their largest values", significant(most, 2))
        }
    ))
    .shown_by(
        "The equivalent model of chapter IV, in MN/m and kN s/m",
        &["constant", "value"],
        rows,
    ))
}

fn gravity(study: &Study) -> Result<Claim, ThesisError> {
    let Scales { speed, thickness, .. } = Scales::CHAPTER_4;
    let weight = STANDARD_GRAVITY * thickness / (speed * speed);
    let heavy = Impact::of_groups(&Groups { gravity: weight, ..study.printed.groups })?;
    let changes = [
        ("peak force", heavy.peak().value / study.printed.peak().value - 1.0),
        ("largest deformation", heavy.deepest().value / study.printed.deepest().value - 1.0),
        ("energy in 10 ms", heavy.energy(5.0) / study.printed.energy(5.0) - 1.0),
    ];
    let cases = changes.map(|(name, by)| (name.to_owned(), by.abs() < 0.01));
    let words = changes.map(|(name, by)| format!("the {name} by {} %", significant(100.0 * by, 2)));
    let rows = changes.map(|(name, by)| vec![name.to_owned(), change(by)]);
    Ok(Claim::over(
        "II",
        "gravity may be left out where V0² is much larger than g δ m1/(m1 + m2)",
        &cases,
    )
    .finding(format!(
        "In chapter IV, A = {}. It changes {}; less than 1 % counts as left out rightly.",
        significant(weight, 3),
        listed(&words)
    ))
    .shown_by("What gravity changes", &["measure", "change"], rows))
}
