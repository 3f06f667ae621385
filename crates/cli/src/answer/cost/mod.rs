//! What accuracy costs, as one JSON object, as tables, and in words.

mod json;
mod tables;
mod words;

use dashpot_analysis::cost::{CostReport, Subject};

use crate::numbers::rounded;

pub(crate) use json::document;
pub(crate) use tables::{cheapest, errors, measures, work};
pub(crate) use words::{answer, failures, slips, truth};

/// The accuracies that everyone asks for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-6];

/// The accuracies for which the cheapest method is told: the usual ones and that of the scene.
pub(crate) fn accuracies(wish: f64) -> Vec<f64> {
    let is_new = |own: f64| (wish / own - 1.0).abs() > 1e-9;
    let mut all = ACCURACIES.to_vec();
    if all.iter().all(|own| is_new(*own)) {
        all.push(wish);
    }
    all.sort_by(|one, other| other.total_cmp(one));
    all
}

/// What an error is one of, as readers know it.
fn subject(report: &CostReport, subject: Subject) -> &str {
    match subject {
        Subject::State => "state",
        Subject::Events => "events",
        Subject::Measure(at) => report.measures.get(at).map_or("", |own| own.key.as_str()),
    }
}

/// A tolerance, or that there is none.
fn tolerance(rtol: Option<f64>) -> String {
    rtol.map_or("–".to_owned(), |own| format!("{own:e}"))
}

/// An accuracy as it is asked for: in percent, or where it is strict, as a power of ten.
fn wish(accuracy: f64) -> String {
    if accuracy < 1e-5 {
        format!("{accuracy:e}")
    } else {
        format!("{} %", rounded(100.0 * accuracy, "1", 3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accuracies_are_written_as_they_are_asked_for() {
        assert_eq!([1e-2, 1e-3, 5e-4, 1e-6].map(wish), ["1 %", "0.1 %", "0.05 %", "1e-6"]);
    }

    #[test]
    fn the_accuracy_of_the_scene_is_told_once_in_its_place() {
        assert_eq!(accuracies(1e-3), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(0.1 / 100.0), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(1e-4), [1e-2, 1e-3, 1e-4, 1e-6]);
    }
}
