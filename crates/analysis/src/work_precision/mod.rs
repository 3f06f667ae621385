//! What accuracy costs: the true error of every method over a ladder of tolerances, against time and work.
//!
//! [`work_precision`] solves a network by every method at every tolerance, and compares each solution with one
//! that is known better ([`ReferenceSolution`]): the exact solution where there is one, else two solutions by
//! methods of different families, whose agreement says how much can be told. Errors are those in
//! the state, in every measure, and in the times of events. Nothing is left out: methods that fail
//! are listed with what they say, and so are errors that a run does not tell of.
//!
//! Work is counted and repeats to the bit. Times are measured, by repetition, and decide nothing but
//! what is said about times.
//!
//! # Examples
//!
//! ```
//! use dashpot_analysis::{Choice, SolveSettings, work_precision, work_precision::Ladder};
//! use dashpot_dae::{Silent, methods::Bdf};
//! use dashpot_network::{Model, Network, Node, elements::{Dashpot, Spring}, part};
//!
//! let mut network = Network::new();
//! let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
//! let pad = Model::parallel([part(Spring { stiffness: 6e4 }), part(Dashpot { damping: 200.0 })]);
//! network.connect("pad", head, network.ground(), pad);
//! let ladder = Ladder { methods: vec![Choice::from(Bdf)], repeats: Some(3), ..Ladder::default() };
//! let report = work_precision(&network, &SolveSettings::lasting(0.05), &ladder, &mut Silent)?;
//! assert_eq!(report.reference.method, "exact");
//! let worst: Vec<f64> = report.points.iter().map(|point| point.worst(&report.asked)).collect();
//! assert!(worst[0] > 1e-4 && worst.last() < Some(&1e-7));
//! # Ok::<(), dashpot_analysis::RunError>(())
//! ```

mod deviation;
mod point;
mod reference;
mod report;
mod states;
mod watch;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use dashpot_dae::{Method, MethodKind, Observer, Run, SolveError, methods};
use dashpot_network::{Assembly, Network};

pub use self::report::{
    CostFailure, CostPoint, CostReport, Deviation, MeasureDeviation, ReferenceSolution, Spread,
    Subject, Timing, TrueMeasure, Underestimate,
};
use self::{point::Bench, reference::Judge, watch::Watch};
use crate::{
    Choice, RunError, SolveSettings,
    measures::selection::{Selected, select},
    run::{choice, guards},
};

/// What is tried.
#[derive(Debug, Clone)]
pub struct Ladder {
    /// The methods, that which suits for [`Choice::Auto`]; none stands for all of the register.
    pub methods: Vec<Choice>,
    /// Relative tolerances, each from 1e-13 to 1e-3, the coarsest first.
    pub rtols: Vec<f64>,
    /// Keys of the measures that are asked for, such as `padding.peak-force`: by them methods are
    /// ranked. None stands for all that are reported.
    pub measures: Vec<String>,
    /// How often each solution is repeated for its time, at least 1; `None` repeats by its number of
    /// steps, short ones more often.
    pub repeats: Option<usize>,
    /// A solution of more steps is given up, and so are the finer ones of its method.
    pub most_steps: usize,
    /// Most work of all solutions together, in steps; what would take more is given up, and repeats for times
    /// are fewer.
    pub most_work: usize,
}

impl Default for Ladder {
    /// All methods at the powers of ten from 1e-3 to 1e-11, judged by all measures.
    fn default() -> Self {
        Self {
            methods: Vec::new(),
            rtols: (3..=11).map(|exponent| 1.0 / 10.0_f64.powi(exponent)).collect(),
            measures: Vec::new(),
            repeats: None,
            most_steps: 200_000,
            most_work: 5_000_000,
        }
    }
}

/// Finds out what accuracy costs.
///
/// `settings` say what is solved; their method and tolerance do not matter, and nothing is left out
/// of the network. The observer is told of everything as if it were one run of their duration.
///
/// # Errors
///
/// What is wrong with the network, the settings or the ladder; the words of the last method if the
/// scene is not linear and no two methods of different families solve it; and
/// [`SolveError::Cancelled`] where the observer ends it. A method that fails is no error.
pub fn work_precision(
    network: &Network,
    settings: &SolveSettings,
    ladder: &Ladder,
    observer: &mut dyn Observer,
) -> Result<CostReport, RunError> {
    settings.validate()?;
    let assembly = Arc::new(network.compile(settings.duration)?);
    work_precision_assembly(&assembly, settings, ladder, observer)
}

/// The same for a network that is compiled already.
///
/// # Errors
///
/// As [`work_precision`], but for the network.
pub fn work_precision_assembly(
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    ladder: &Ladder,
    observer: &mut dyn Observer,
) -> Result<CostReport, RunError> {
    let settings = &full(settings);
    settings.validate()?;
    check(ladder)?;
    let first = choice(assembly, settings.duration).0;
    let count = chosen(ladder, first)?.len();
    let selected = select(assembly, &settings.measures, &settings.limits)?;
    let asked = asked(ladder, &selected)?;
    let total = reference::PARTS + count * ladder.rtols.len();
    let mut watch = Watch::new(observer, settings.duration, total, ladder.most_work);
    let judge = Judge::find(assembly, settings, &mut watch)?;
    let run = Run { guards: guards(assembly, settings)?, ..Run::to(settings.duration) };
    let bench = Bench { assembly, settings, selected: &selected, run, judge: &judge, ladder };
    let reference = judge.reference();
    // In scenes that switch `exact` may decline on the way, which is not known before.
    let auto = if reference.why_not_exact.is_some() { methods::Bdf::KIND } else { first };
    let names = chosen(ladder, auto)?;
    let mut report = CostReport {
        reference,
        auto,
        measures: judge.measures(),
        asked,
        points: Vec::new(),
        failures: Vec::new(),
        underestimates: judge.contradictions(),
    };
    for (place, method) in names.iter().enumerate() {
        watch.begin(reference::PARTS + place * ladder.rtols.len());
        let most_work = watch.share(names.len() - place);
        bench.climb(method, most_work, &mut report, &mut watch)?;
    }
    Ok(report)
}

/// The settings of runs that leave nothing out and estimate their errors.
fn full(settings: &SolveSettings) -> SolveSettings {
    let mut settings = settings.clone();
    settings.estimate = true;
    settings.rtol = None;
    settings.accuracy.neglect_below = None;
    settings
}

fn check(ladder: &Ladder) -> Result<(), RunError> {
    let invalid = |setting: &str, range, value| {
        Err(RunError::InvalidSetting { setting: setting.to_owned(), range, value })
    };
    if let Some(&rtol) = ladder.rtols.iter().find(|rtol| !(1e-13..=1e-3).contains(*rtol)) {
        return invalid("rtol", "from 1e-13 to 1e-3", rtol);
    }
    if ladder.rtols.is_empty() {
        return invalid("rtols", "one tolerance at least", 0.0);
    }
    if ladder.repeats == Some(0) {
        return invalid("repeats", "1 or more", 0.0);
    }
    Ok(())
}

/// The methods that are tried, each once; `auto` stands for the one of this name.
fn chosen(ladder: &Ladder, auto: &str) -> Result<Vec<Arc<dyn Method>>, RunError> {
    if ladder.methods.is_empty() {
        let all = methods::all().into_iter();
        let all = all.filter(|own| own.name() != methods::Auto::KIND);
        return Ok(all.map(Arc::from).collect());
    }
    let auto = Choice::named(auto)?;
    let mut found: Vec<Arc<dyn Method>> = Vec::new();
    for choice in &ladder.methods {
        let ((Choice::Method(method), _) | (Choice::Auto, Choice::Method(method))) =
            (choice, &auto)
        else {
            continue;
        };
        let method = Arc::clone(method);
        if found.iter().all(|own| own.name() != method.name()) {
            found.push(method);
        }
    }
    Ok(found)
}

/// Places of the measures that are asked for.
fn asked(ladder: &Ladder, selected: &[Selected]) -> Result<Vec<usize>, RunError> {
    if ladder.measures.is_empty() {
        return Ok((0..selected.len()).collect());
    }
    let place = |key: &String| {
        selected.iter().position(|own| own.key == *key).ok_or_else(|| RunError::UnknownMeasure {
            key: key.clone(),
            known: selected.iter().map(|own| own.key.clone()).collect(),
        })
    };
    ladder.measures.iter().map(place).collect()
}

/// Whether an error says that the method does not suit, at whatever tolerance.
fn declines(error: &RunError) -> bool {
    matches!(error, RunError::Solve(SolveError::NotApplicable { .. }))
}
