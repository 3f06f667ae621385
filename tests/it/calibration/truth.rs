//! What is true of a scene, and how well that is known.

use std::{collections::BTreeMap, ops::ControlFlow};

use dashpot::{
    analysis::{MeasureReport, RunError, RunReport, Solve, SolveSettings},
    dae::{Observer, Progress},
};

use super::scenes::Drawn;

/// Tolerance of the two references.
const FINE: f64 = 1e-11;
/// Steps that each of them may take.
const PATIENCE: usize = 300_000;

/// Ends what takes too long, so that one scene does not hold up a thousand.
pub(crate) struct Patience {
    pub(crate) steps: usize,
}

impl Observer for Patience {
    fn progress(&mut self, _: Progress) -> ControlFlow<()> {
        match self.steps.checked_sub(1) {
            Some(left) => {
                self.steps = left;
                ControlFlow::Continue(())
            }
            None => ControlFlow::Break(()),
        }
    }
}

/// True values of measures by key, and how far they may be off.
pub(super) type Truth = BTreeMap<String, (Option<f64>, f64)>;

/// The truth by `exact`, with the bound that it states, or by two methods of different families at a
/// fine tolerance, with their difference; `None` where neither is to be had.
pub(super) fn truth(drawn: &Drawn) -> Option<Truth> {
    let settings = drawn.scene.settings("exact").unwrap();
    let run = |settings: &SolveSettings| -> Result<RunReport, RunError> {
        drawn.scene.network.solve_watched(settings, &mut Patience { steps: PATIENCE })
    };
    if let Ok(exact) = run(&settings) {
        let own = |measure: &MeasureReport| {
            let threshold = measure.value.map_or(0.0, |_| measure.error.unwrap_or(f64::INFINITY));
            (measure.key.clone(), (measure.value, threshold))
        };
        return Some(exact.measures.iter().map(own).collect());
    }
    let settings = SolveSettings { rtol: Some(FINE), estimate: false, ..settings };
    let [one, other] =
        ["bdf", "esdirk34"].map(|method| run(&settings.clone().by_name(method).unwrap()).ok());
    let (one, other) = one.zip(other)?;
    let both = one.measures.iter().zip(&other.measures);
    let agreed = both.map(|(one, other)| {
        let gap = match (one.value, other.value) {
            (Some(a), Some(b)) => Some((a - b).abs()),
            (None, None) => Some(0.0),
            _ => None,
        };
        gap.map(|gap| (one.key.clone(), (one.value, gap)))
    });
    agreed.collect()
}
