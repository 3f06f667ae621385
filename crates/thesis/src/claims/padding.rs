//! What the groups mean for springs and dashpots, the equivalent model, and gravity.

use dashpot_network::Model;
use dashpot_plot::Table;
use dashpot_rheology::{
    Branch, Tree,
    appendix_a::{SpringDashpot, TwoMaxwell},
};

use super::{Claim, OVER_VALUES, Trend, Verdict, row};
use crate::{
    DURATION, Groups, Impact, Member, Padding, STANDARD_GRAVITY, Scales, Study, ThesisError,
    Varied,
    groups::{burgers, maxwell},
    words::{change, listed, significant},
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
        let Some(family) = study.family(varied) else { continue };
        let values: Vec<f64> =
            family.members.iter().filter_map(Member::padding).map(|own| of(&own)).collect();
        let name = format!("{constant} with {}", varied.symbol());
        let is_spring = constant.starts_with('K');
        let unit = if is_spring { 1e6 } else { 1e3 };
        let found = match Trend::of(&values) {
            Trend::Rises => "rises",
            Trend::Falls => "falls",
            Trend::TurnsAround => "does neither",
        };
        let claimed = if wanted == Trend::Rises { "rises" } else { "falls" };
        cases.push((name.clone(), Trend::of(&values) == wanted));
        let each = values.iter().map(|value| significant(value / unit, 4));
        let each = each.collect::<Vec<_>>().join(", ");
        rows.push(row([name, claimed.to_owned(), found.to_owned(), each]));
    }
    Claim {
        place: "D",
        says: "raising a raises K1 and lowers C1; raising c raises K2 and lowers C2; lowering d \
               lowers C2",
        verdict: Verdict::of(&cases),
        finding: "C1 = c m1/(q J) and K1 = d m1/(q J²) both fall when a raises q, and \
                  C2 = d m1/(b J) does not know c."
            .to_owned(),
        evidence: vec![Table::new(
            "Constants of the padding over each family, in MN/m and kN s/m",
            &["constant", "claimed", "found", "values"],
            rows,
        )],
    }
}

fn conservative(study: &Study) -> Claim {
    let nu = |impact: &Impact| impact.groups.d / impact.groups.c;
    let rows = study.families().map(|family| {
        let each = family.each(nu).into_iter().map(|own| significant(own, 3));
        row([family.varied.symbol().to_owned()].into_iter().chain(each))
    });
    let all: Vec<f64> = study.families().flat_map(|family| family.each(nu)).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let most = all.iter().copied().fold(0.0, f64::max);
    Claim {
        place: "III",
        says: "ν = 10 is a conservative estimate",
        verdict: Verdict::single(least >= 10.0),
        finding: format!(
            "It is the base's own d/c = {}. Over the families d/c is {} to {}.",
            significant(nu(&study.printed), 3),
            significant(least, 3),
            significant(most, 3)
        ),
        evidence: vec![Table::new("ν = d/c over each family", &OVER_VALUES, rows)],
    }
}

fn one_time() -> Result<Claim, ThesisError> {
    let TwoMaxwell { slow, fast } = burgers(Padding::CHAPTER_4).to_two_maxwell()?;
    let kelvin = burgers(Padding::CHAPTER_4).kelvin;
    let milliseconds =
        |spring_dashpot: SpringDashpot| 1e3 * spring_dashpot.dashpot / spring_dashpot.spring;
    let times = [milliseconds(slow), milliseconds(fast), milliseconds(kelvin)];
    let is_one = times[..2].iter().all(|own| (own / times[2] - 1.0).abs() < SAME);
    let names = ["relaxation, slow", "relaxation, fast", "retardation, C1/K1"];
    let rows = names.iter().zip(times);
    let rows = rows.map(|(name, time)| row([(*name).to_owned(), significant(time, 5)]));
    Ok(Claim {
        place: "VI",
        says: "the model has one relaxation time, C1/K1",
        verdict: Verdict::single(is_one),
        finding: format!(
            "C1/K1 = {} ms is its one retardation time, that of creep. Held at a deformation it relaxes \
             with two times, {} and {} ms.",
            significant(times[2], 3),
            significant(times[0], 4),
            significant(times[1], 4)
        ),
        evidence: vec![Table::new("Times of the padding of chapter IV", &["time", "ms"], rows)],
    })
}

fn equivalent(study: &Study) -> Result<Claim, ThesisError> {
    let own = study.system.groups;
    let none = || ThesisError::NoPadding { q: own.q() };
    let unit = own.padding(&Scales::UNIT).ok_or_else(none)?;
    let TwoMaxwell { slow, fast } = burgers(unit).to_two_maxwell()?;
    let branch =
        |name: &str, own: SpringDashpot| Branch::new(name, maxwell(own.spring, own.dashpot));
    let pad: Model = Tree::Parallel(vec![branch("slow", slow), branch("fast", fast)]);
    let other = Impact::solve(&own, &own.network_with(&Scales::UNIT, pad))?;
    let times = (0..=500).map(|at| DURATION * f64::from(at) / 500.0);
    let differences = times.map(|time| {
        let force = other.force(time) - study.system.force(time);
        let deformation = other.deformation(time) - study.system.deformation(time);
        (force / study.system.peak().value).abs().max(deformation.abs())
    });
    let most = differences.fold(0.0, f64::max);
    let TwoMaxwell { slow, fast } = burgers(Padding::CHAPTER_4).to_two_maxwell()?;
    let named = [("K3", slow.spring, 1e6), ("C3", slow.dashpot, 1e3)];
    let named = named.into_iter().chain([("K4", fast.spring, 1e6), ("C4", fast.dashpot, 1e3)]);
    let rows =
        named.map(|(name, value, unit)| row([name.to_owned(), significant(value / unit, 6)]));
    Ok(Claim {
        place: "A",
        says: "two Maxwell elements in parallel describe the padding with equal precision",
        verdict: Verdict::single(most < SAME),
        finding: format!(
            "In the impact of chapter IV force and deformation differ by {}.",
            if most < ROUNDING {
                "rounding alone".to_owned()
            } else {
                format!("{} of their largest values", significant(most, 2))
            }
        ),
        evidence: vec![Table::new(
            "The equivalent model of chapter IV, in MN/m and kN s/m",
            &["constant", "value"],
            rows,
        )],
    })
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
    let cases: Vec<_> =
        changes.iter().map(|change| (change.0.to_owned(), change.1.abs() < 0.01)).collect();
    let words: Vec<String> = changes
        .iter()
        .map(|change| format!("the {} by {} %", change.0, significant(100.0 * change.1, 2)))
        .collect();
    let rows = changes.iter().map(|own| row([own.0.to_owned(), change(own.1)]));
    Ok(Claim {
        place: "II",
        says: "gravity may be left out where V0² is much larger than g δ m1/(m1 + m2)",
        verdict: Verdict::of(&cases),
        finding: format!(
            "In chapter IV, A = {}. It changes {}; less than 1 % counts as left out rightly.",
            significant(weight, 3),
            listed(&words)
        ),
        evidence: vec![Table::new("What gravity changes", &["measure", "change"], rows)],
    })
}
