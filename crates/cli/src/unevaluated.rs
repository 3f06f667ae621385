//! What a study could not evaluate, in words.

use dashpot_analysis::{CauseKind, Missing, Unevaluated};

use crate::output::list;
use dashpot_report::numbers::counted;

/// One sentence for each kind of cause: `399 of 401 designs have no valid scene, the first at T = 3 mm: …`. `place` says
/// where something is, by its numbers in SI units.
pub(crate) fn sentences(
    all: &Unevaluated,
    noun: &str,
    place: impl Fn(&Missing) -> String,
) -> Vec<String> {
    let sentence = |own: &Missing| {
        let Missing { cause, count, .. } = own;
        let of = &cause.of;
        let what = match cause.kind {
            CauseKind::Scene => "no valid scene".to_owned(),
            CauseKind::NoValue => format!("no value of {of}"),
            CauseKind::Cut => format!("a value of {of} that may still grow"),
            CauseKind::Beyond => format!("{of} pressed beyond what is known of it"),
            _ => "no solution".to_owned(),
        };
        let place = place(own);
        let at = if place.is_empty() { place } else { format!(", the first at {place}") };
        let has = if *count == 1 { "has" } else { "have" };
        let why = if cause.kind == CauseKind::Beyond || cause.message.is_empty() {
            String::new()
        } else {
            format!(": {}", cause.message)
        };
        format!("{count} of {} {has} {what}{at}{why}", counted(all.of, noun))
    };
    list(all.causes.iter().map(sentence))
}
