//! What a method makes of a scene, judged by the truth.

use std::{
    cell::OnceCell,
    time::{Duration, Instant},
};

use dashpot::{
    analysis::{RunError, RunReport, Solve, SolveSettings},
    dae::SolveError,
};

use super::{
    scenes::{Drawn, draw},
    truth::{Patience, Truth, truth},
};

/// Steps that a method may take for one scene, with all its solutions.
const PATIENCE: usize = 200_000;
/// How many times the threshold about the truth an error must be to be known.
const KNOWN: f64 = 10.0;
/// Doubt about the truth that does not matter, in parts of the largest measure of the same unit.
const ROUNDING: f64 = 1e-11;

/// What became of a scene.
pub(super) enum Outcome {
    /// It was solved, and the truth is known.
    Judged(Judged),
    /// The method says that it is not made for it.
    Declined,
    /// It needs more steps than anybody waits for: explicit steps where the scene is stiff.
    TooLong,
    /// It ended in an error.
    Failed(String),
    /// The truth is not known well enough.
    Unknown,
}

/// Measures beside the truth.
#[derive(Debug, Default)]
pub(super) struct Judged {
    /// How many measures have a value, or ought to have one.
    pub(super) measures: usize,
    /// Those whose truth lies outside of the bar, and by how many bars.
    pub(super) outside: Vec<String>,
    /// Bars in parts of the true error, where it can be told from zero.
    pub(super) ratios: Vec<f64>,
    /// Measures whose bar exceeds the accuracy wanted.
    pub(super) unreached: usize,
    /// Time that all its solutions took.
    pub(super) time: Duration,
}

/// A scene, and what is true of it once somebody asks.
pub(super) struct Case {
    pub(super) drawn: Drawn,
    truth: OnceCell<Option<Truth>>,
}

impl Case {
    /// Scene number `at` of a seed.
    pub(super) fn new(seed: u64, at: usize) -> Self {
        Self { drawn: draw(seed, at), truth: OnceCell::new() }
    }

    /// The same with a change of its text.
    pub(super) fn changed(seed: u64, at: usize, change: impl Fn(&str) -> String) -> Self {
        Self { drawn: draw(seed, at).changed(change), truth: OnceCell::new() }
    }

    /// What is true of it, if that can be found out.
    pub(super) fn truth(&self) -> Option<&Truth> {
        self.truth.get_or_init(|| truth(&self.drawn)).as_ref()
    }

    /// Solves it.
    pub(super) fn solve(&self, settings: &SolveSettings) -> Result<RunReport, RunError> {
        self.drawn.scene.network.solve_watched(settings, &mut Patience { steps: PATIENCE })
    }

    /// Solves it by a method, as its text says but for what `also` changes, and judges that.
    pub(super) fn judge(
        &self,
        method: &str,
        also: impl Fn(SolveSettings) -> SolveSettings,
    ) -> Outcome {
        let begin = Instant::now();
        let report = match self.solve(&also(self.drawn.scene.settings(method).unwrap())) {
            Ok(report) => report,
            Err(RunError::Solve(SolveError::NotApplicable { .. })) => return Outcome::Declined,
            Err(RunError::Solve(SolveError::Cancelled { .. })) => return Outcome::TooLong,
            Err(error) => return Outcome::Failed(error.to_string()),
        };
        let time = begin.elapsed();
        match self.truth().and_then(|truth| beside(truth, &report)) {
            Some(judged) => Outcome::Judged(Judged { time, ..judged }),
            None => Outcome::Unknown,
        }
    }
}

/// A report beside the truth; `None` where that is not known well enough to tell inside from outside.
pub(super) fn beside(truth: &Truth, report: &RunReport) -> Option<Judged> {
    let mut judged = Judged::default();
    for found in &report.measures {
        let &(value, threshold) = truth.get(&found.key).expect("the same measures");
        let alike = report.measures.iter().filter(|other| other.unit == found.unit);
        let scale = alike.map(|other| other.size).fold(0.0, f64::max);
        let (bars, ratio) = match (value, found.value) {
            (Some(truth), Some(value)) => {
                let gap = (truth - value).abs();
                let bar = found.error.expect("every value has a bar");
                let is_certain = gap + threshold <= bar || gap - threshold > bar;
                if !is_certain && threshold > ROUNDING * scale {
                    return None;
                }
                let bars = if gap > threshold { (gap - threshold) / bar } else { 0.0 };
                (bars, (gap > KNOWN * threshold).then(|| bar / gap))
            }
            (None, None) => continue,
            // A contact in forces that are rounding, of which nobody can say whether there is one.
            (Some(truth), None) if truth.abs() <= threshold => return None,
            _ if found.error.is_some_and(f64::is_infinite) => (0.0, None),
            _ => (f64::INFINITY, None),
        };
        judged.measures += 1;
        judged.unreached += usize::from(found.excess > 1.0);
        judged.ratios.extend(ratio);
        if bars > 1.0 {
            judged.outside.push(format!("{}: {bars:.1} bars", found.key));
        }
    }
    Some(judged)
}
