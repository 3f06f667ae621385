//! From a network to the report of a run.

mod segmentation;

use std::sync::Arc;

use dashpot_dae::Observer;
use dashpot_network::{Assembly, Network};

use crate::{
    RunError, RunReport, SolveSettings,
    partial::reduced,
    run::{solve_assembly, words},
};

/// Compiles a network, integrates it, and reports.
///
/// A method that bounds its own error solves once. The others solve at four tolerances a factor √10
/// apart and take the errors of the finest solution from the differences; as long as an error
/// exceeds what is wanted, or the energy does not close as well, they go on to the next tolerance.
///
/// # Errors
///
/// Any [`RunError`]: what is wrong with the network or the settings, a method that fails, and an
/// energy balance that is off by more than 1 % of the energy turned over.
pub fn solve(
    network: &Network,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    settings.validate()?;
    let assembly = Arc::new(network.compile(settings.duration)?);
    solve_partial(network, &assembly, settings, observer)
}

/// Solves a network that is compiled already; where the accuracy has a bound for what may be left
/// out, without what is shown to matter less. Otherwise as [`solve_assembly`], without any further
/// solution.
///
/// The errors of measures include what was left out, and what the segments of layers make of them:
/// the latter takes one further solution.
///
/// # Errors
///
/// As [`solve_assembly`].
pub fn solve_partial(
    network: &Network,
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    let Some(bound) = settings.accuracy.neglect_below else {
        let report = solve_assembly(assembly, &words(network), settings, observer)?;
        return segmentation::charged(network, report, settings, observer);
    };
    let (report, left_out) = reduced(network, assembly, settings, bound, observer)?;
    segmentation::charged(&network.without(&left_out), report, settings, observer)
}
