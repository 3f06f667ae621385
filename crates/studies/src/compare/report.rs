//! The verdict in words.

use std::fmt::Write as _;

use dashpot_report::{
    Report, Tone,
    numbers::{apart, bound, quantity, share},
};

use super::{About, Comparison, Form, Impact, Map, Worst};
use crate::non_identifiable::sentence;

/// Maps of more parameters than this are in the object only.
const MOST_SHOWN: usize = 8;

/// Everything that is said of it.
pub(super) fn report(comparison: &Comparison) -> Report {
    let [first, second] = &comparison.compared;
    let (verdict, tone) =
        if comparison.same { ("The same", Tone::Heading) } else { ("Not the same", Tone::Warning) };
    let mut report = Report::titled(verdict);
    report.subject = format!(": {first} and {second}");
    report.tone = tone;
    report.notes(sentences(comparison));
    report.tables(comparison.forms.iter().map(Form::table));
    report.tables(comparison.map.iter().filter(|map| map.is_at_most(MOST_SHOWN)).map(Map::table));
    report.tables(comparison.impact.iter().map(Impact::table));
    report
}

fn sentences(found: &Comparison) -> Vec<String> {
    let mut all = Vec::new();
    if let Some(largest) = found.largest_difference {
        let limit = bound(found.within);
        let text = if found.same {
            "All poles and residues agree within"
        } else {
            "A pole or residue differs by"
        };
        all.push(format!("{text} {} (the limit is {limit}).", apart(largest)));
    }
    if found.forms.is_empty() && found.worst.is_none() && !found.same {
        all.push("One of them has masses that move, the other has none.".to_owned());
    }
    all.extend(found.worst.as_ref().map(|worst| disagreement(worst, found.same)));
    for (word, about) in ["first", "second"].into_iter().zip(&found.models) {
        all.extend(described(word, about));
    }
    if let Some(map) = &found.map {
        let condition = map.condition;
        let condition =
            if condition < 1e4 { format!("{condition:.3}") } else { format!("{condition:.1e}") };
        all.push(format!(
            "Condition number {condition}: 1 % in the parameters of the first is up to that many \
             percent in one of the second.",
        ));
    }
    all
}

/// How far the responses are apart; where, only if they are.
fn disagreement(worst: &Worst, is_same: bool) -> String {
    if is_same {
        let largest = worst.creep.map_or(worst.response, |creep| creep.max(worst.response));
        return format!(
            "No response to a force or deformation differs by more than {}.",
            bound(largest)
        );
    }
    let at = |place: Option<f64>, unit: &str, limits: [&str; 2]| match place {
        Some(0.0) => limits[0].to_owned(),
        Some(own) if own.is_finite() => format!("at {}", quantity(own, unit, 3)),
        _ => limits[1].to_owned(),
    };
    let frequency =
        at(worst.frequency, "Hz", ["at ever lower frequencies", "at ever higher frequencies"]);
    let mut line = format!("The responses differ most {frequency}, by {}", share(worst.response));
    if let Some(creep) = worst.creep {
        let time = at(worst.time, "s", ["at once", "after ever longer times"]);
        let _ = write!(line, "; in creep most {time}, by {}", share(creep));
    }
    line + "."
}

fn described(word: &str, about: &About) -> Vec<String> {
    let mut all = Vec::new();
    if let Some(poles) = about.poles {
        all.push(format!(
            "The {word} has masses that move, and {poles} poles: no springs and dashpots alone \
             respond like it."
        ));
    }
    if let Some(least) = about.least_elements {
        let has = match about.elements {
            None => String::new(),
            Some(1) => " has 1 element and".to_owned(),
            Some(count) => format!(" has {count} elements and"),
        };
        let forms = match (about.maxwell_form, about.kelvin_form) {
            (true, true) => "in both forms, which are passive",
            (true, false) => "it bears no force, so it has no Kelvin form",
            _ => "it is rigid, so it has no Maxwell form",
        };
        all.push(format!("The {word}{has} needs {least}, {forms}."));
    }
    for own in &about.cancelled {
        let [real, imaginary] = own.pole;
        if imaginary < 0.0 {
            // Its conjugate stands for both.
            continue;
        }
        let place = if real == 0.0 && imaginary == 0.0 {
            "of free motion".to_owned()
        } else if imaginary == 0.0 {
            format!("at a time of {}", quantity(real.abs().recip(), "s", 4))
        } else {
            let real = if real.abs() < 1e-12 * imaginary { 0.0 } else { real };
            format!("at {real:.4e} ± {imaginary:.4e}i 1/s")
        };
        all.push(match own.count {
            1 => format!("In the {word}, a zero cancels a pole {place}."),
            count => format!("In the {word}, zeros cancel {count} poles {place}."),
        });
    }
    all.extend(
        about
            .entangled
            .iter()
            .map(|own| format!("In the {word}, {}.", sentence(&own.parameters, &own.combinations))),
    );
    all
}
