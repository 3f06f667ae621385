//! What `--neglect` has left out of a run and what it has put back, in words.

use dashpot_analysis::{
    Partial, RunReport,
    partial::{Cost, Verification, Why},
};
use dashpot_report::numbers::{apart, duration, estimate, quantity};

use super::verdict::TIME_DIGITS;

/// What was left out, what that cost, and what the proof of it took.
pub(super) fn left_out(run: &RunReport) -> Option<String> {
    let partial = run.partial.as_ref()?;
    let checked = verification(partial.verification);
    let names = partial.left_out.iter().map(|own| {
        format!("{} ({})", own.effect, estimate(&own.influence.formula, own.influence.value))
    });
    let names: Vec<String> = names.collect();
    if names.is_empty() {
        let other = if partial.put_back.is_empty() { "" } else { " other" };
        return Some(match partial.verification.solves {
            0 => format!("nothing: no{other} estimate is below the bound"),
            _ => format!("nothing{checked}"),
        });
    }
    let cost = partial.worst().map_or(String::new(), |worst| format!(": {}", moved(worst)));
    Some(format!("{}{cost}, the most of all{checked}", names.join(", ")))
}

/// What stayed although its estimate was small.
pub(super) fn put_back(run: &RunReport) -> Option<String> {
    let partial = run.partial.as_ref()?;
    let texts = partial.put_back.iter().map(|own| {
        let estimate = estimate(&own.influence.formula, own.influence.value);
        format!("{} ({estimate}): {}", own.effect, why(partial, &own.why))
    });
    let texts: Vec<String> = texts.collect();
    (!texts.is_empty()).then(|| texts.join("; "))
}

fn why(partial: &Partial, why: &Why) -> String {
    match why {
        Why::Moves(cost) => {
            format!("without it {}, more than {}", moved(cost), apart(partial.bound))
        }
        Why::Fails(error) => format!("without it {error}"),
        Why::Pulls { element, time } => {
            format!(
                "without it the {element} goes into tension at {}",
                quantity(*time, "s", TIME_DIGITS)
            )
        }
    }
}

fn moved(cost: &Cost) -> String {
    let size = if cost.most().is_finite() { apart(cost.most()) } else { "all of it".to_owned() };
    format!("`{}` moves by {size}", cost.measure)
}

fn verification(verification: Verification) -> String {
    match verification.solves {
        1 => format!("; checked by 1 further run in {}", duration(verification.wall)),
        solves => format!("; checked by {solves} further runs in {}", duration(verification.wall)),
    }
}
