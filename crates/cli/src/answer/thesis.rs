//! What `thesis` has to say, as one JSON object.

use dashpot_dae::Extremum;
use dashpot_plot::Table;
use dashpot_thesis::{Claim, Family, Member, Misprint, Number, Recomputation, Scales, Verdict};
use serde::Serialize;

/// The object that `thesis --json` prints: groups and impacts without dimensions, constants of
/// paddings in SI units. What is infinite or missing is null.
#[derive(Serialize)]
pub(crate) struct Document<'a> {
    dashpot: &'static str,
    summary: Vec<String>,
    numbers: Vec<Judged<'a>>,
    misprints: Vec<Wrong<'a>>,
    claims: Vec<Claimed<'a>>,
    families: Vec<Varied>,
}

#[derive(Serialize)]
struct Judged<'a> {
    place: &'a str,
    what: &'a str,
    printed: &'a str,
    value: f64,
    verdict: String,
}

#[derive(Serialize)]
struct Wrong<'a> {
    place: &'a str,
    printed: &'a str,
    correct: &'a str,
    shown_by: Option<Shown<'a>>,
}

#[derive(Serialize)]
struct Shown<'a> {
    what: &'a str,
    printed_form: f64,
    correct_form: f64,
    expected: f64,
}

#[derive(Serialize)]
struct Claimed<'a> {
    place: &'a str,
    claim: &'a str,
    verdict: &'static str,
    /// Where it holds, if it holds in part.
    cases: &'a [String],
    finding: &'a str,
    evidence: Vec<Evidence<'a>>,
}

#[derive(Serialize)]
struct Evidence<'a> {
    caption: &'a str,
    header: &'a [String],
    rows: &'a [Vec<String>],
}

#[derive(Serialize)]
struct Varied {
    parameter: &'static str,
    members: Vec<Impact>,
}

#[derive(Serialize)]
struct Impact {
    value: f64,
    k1: Option<f64>,
    c1: Option<f64>,
    k2: Option<f64>,
    c2: Option<f64>,
    q: f64,
    peak_force: Point,
    largest_deformation: Point,
    release: Option<f64>,
    exceeds_thickness: bool,
}

#[derive(Serialize)]
struct Point {
    value: f64,
    time: f64,
}

impl<'a> Document<'a> {
    /// The object for all of it.
    pub(crate) fn of(all: &'a Recomputation) -> Self {
        Self {
            dashpot: env!("CARGO_PKG_VERSION"),
            summary: all.summary(),
            numbers: all.numbers.iter().map(printed).collect(),
            misprints: all.misprints.iter().map(wrong).collect(),
            claims: all.claims.iter().map(claimed).collect(),
            families: all.study.families().map(varied).collect(),
        }
    }
}

fn printed(own: &Number) -> Judged<'_> {
    let Number { place, what, printed, value, ref verdict, .. } = *own;
    Judged { place, what, printed, value, verdict: verdict.text() }
}

fn wrong(own: &Misprint) -> Wrong<'_> {
    Wrong {
        place: own.place,
        printed: own.printed,
        correct: own.correct,
        shown_by: own.demonstration.as_ref().map(|shown| Shown {
            what: shown.what,
            printed_form: shown.printed,
            correct_form: shown.correct,
            expected: shown.truth,
        }),
    }
}

fn claimed(own: &Claim) -> Claimed<'_> {
    let (verdict, cases) = match &own.verdict {
        Verdict::Holds => ("holds", &[][..]),
        Verdict::DoesNotHold => ("does not hold", &[][..]),
        Verdict::HoldsOnlyFor(cases) => ("holds in part", &cases[..]),
    };
    let evidence = own.evidence.iter().map(|Table { caption, header, rows }| Evidence {
        caption,
        header,
        rows,
    });
    Claimed {
        place: own.place,
        claim: own.says,
        verdict,
        cases,
        finding: &own.finding,
        evidence: evidence.collect(),
    }
}

fn varied(own: &Family) -> Varied {
    Varied { parameter: own.varied.symbol(), members: own.members.iter().map(impact).collect() }
}

fn impact(own: &Member) -> Impact {
    let pad = own.impact.groups.padding(&Scales::CHAPTER_4);
    let point = |Extremum { time, value }| Point { value, time };
    Impact {
        value: own.value,
        k1: pad.map(|own| own.k1),
        c1: pad.map(|own| own.c1),
        k2: pad.map(|own| own.k2),
        c2: pad.map(|own| own.c2),
        q: own.impact.groups.q(),
        peak_force: point(own.impact.peak()),
        largest_deformation: point(own.impact.deepest()),
        release: own.impact.release(),
        exceeds_thickness: own.exceeds(),
    }
}
