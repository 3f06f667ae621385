//! Single runs of plain impacts, whose bars come of two solutions as a rule.

use std::time::Instant;

use dashpot::analysis::RunReport;

use super::{
    SEED, most_outside,
    scenes::kinds,
    tally::Tally,
    text::HEAD_MEASURES,
    trial::{Case, Judged, Outcome, beside},
};

/// Accuracies that are asked for, by turns.
const ACCURACIES: [f64; 4] = [5e-2, 1e-2, 1e-3, 1e-4];
/// Scenes of the part that runs with all other tests.
const PART: usize = 100;

/// Other runs take three further solutions at least.
fn is_plain(run: &RunReport) -> bool {
    run.solver.method == "dop853" && run.solver.solves_for_error < 3
}

/// So many of them, with the measures that an impact tells.
pub(super) fn judged(seed: u64, scenes: usize) -> Tally {
    let mut tally = Tally::default();
    for at in (1..40 * scenes).step_by(2) {
        if tally.scenes == scenes {
            break;
        }
        let case = Case::changed(seed, at, |text| text.replace(HEAD_MEASURES, "\"hic15\""));
        let mut settings = case.drawn.scene.settings("auto").unwrap();
        // Kinds come by turns as well.
        settings.accuracy.default = ACCURACIES[at / 2 / kinds().count() % ACCURACIES.len()];
        let begin = Instant::now();
        let Ok(report) = case.solve(&settings) else { continue };
        let time = begin.elapsed();
        if !is_plain(&report) {
            continue;
        }
        let judged = case.truth().and_then(|truth| beside(truth, &report));
        let name = format!("plain {} {at} to {}", case.drawn.kind, settings.accuracy.default);
        let judged = judged.map(|own| Judged { time, ..own });
        tally.add(&name, judged.map_or(Outcome::Unknown, Outcome::Judged));
    }
    tally
}

#[test]
fn bars_of_plain_impacts_hold_whatever_accuracy_is_asked_for() {
    let own = judged(SEED, PART);
    assert_eq!(own.scenes, PART);
    assert!(own.scenes - own.inside <= most_outside(PART), "{:?}", own.remarks);
}
