//! What `auto` chooses where scenes are not linear, or switch, to whatever accuracy is asked for.

use std::time::Instant;

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

/// So many scenes, with the measures that an impact tells.
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
        let solved = case.solve(&settings);
        let time = begin.elapsed();
        let name = format!("auto {} {at} to {}", case.drawn.kind, settings.accuracy.default);
        let report = match solved {
            Ok(report) => report,
            Err(error) => {
                tally.add(&name, Outcome::Failed(error.to_string()));
                continue;
            }
        };
        let judged = case.truth().and_then(|truth| beside(truth, &report));
        let judged = judged.map(|own| Judged { time, ..own });
        tally.add(&name, judged.map_or(Outcome::Unknown, Outcome::Judged));
    }
    tally
}

#[test]
fn bars_of_auto_hold_whatever_accuracy_is_asked_for() {
    let own = judged(SEED, PART);
    assert_eq!(own.scenes, PART);
    assert!(own.scenes - own.inside <= most_outside(PART), "{:?}", own.remarks);
}
