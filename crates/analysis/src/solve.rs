//! From a network to the report of a run.

use std::{sync::Arc, time::Instant};

use dashpot_dae::{Observer, Silent};
use dashpot_network::{Assembly, Network};

use crate::{
    RunError, RunReport, SolveSettings,
    partial::reduced,
    run::{solve_assembly, words},
    segmentation::with_segments,
};

/// What can be solved.
///
/// # Examples
///
/// ```
/// use dashpot_analysis::Solve;
/// use dashpot_network::{Network, Node, dashpot, spring};
///
/// let mut network = Network::new();
/// let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
/// network.connect("pad", head, network.ground(), spring(60e3) | dashpot(300.0));
/// let report = network.solve(0.05)?;
/// assert!(report.value("pad.peak-force")? > 1500.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Solve {
    /// Solves for a run of `duration` \[s\] by the method that suits, with measures good to 0.1 %.
    ///
    /// # Errors
    ///
    /// As [`solve_watched`](Self::solve_watched).
    fn solve(&self, duration: f64) -> Result<RunReport, RunError> {
        self.solve_with(&SolveSettings::lasting(duration))
    }

    /// Solves with these settings.
    ///
    /// # Errors
    ///
    /// As [`solve_watched`](Self::solve_watched).
    fn solve_with(&self, settings: &SolveSettings) -> Result<RunReport, RunError> {
        self.solve_watched(settings, &mut Silent)
    }

    /// Compiles a network, integrates it, and reports; `observer` is told of the progress, and may end the run.
    ///
    /// A method that bounds its own error solves once. The others solve at four tolerances a factor √10
    /// apart and take the errors of the finest solution from the differences; as long as an error
    /// exceeds what is wanted, or the energy does not close as well, they go on to the next tolerance.
    ///
    /// # Errors
    ///
    /// Any [`RunError`]: what is wrong with the network or the settings, a method that fails, and an
    /// energy balance that is off by more than 1 % of the energy turned over.
    fn solve_watched(
        &self,
        settings: &SolveSettings,
        observer: &mut dyn Observer,
    ) -> Result<RunReport, RunError>;
}

impl Solve for Network {
    fn solve_watched(
        &self,
        settings: &SolveSettings,
        observer: &mut dyn Observer,
    ) -> Result<RunReport, RunError> {
        settings.validate()?;
        let assembly = Arc::new(self.compile(settings.duration)?);
        solve_partial(self, &assembly, settings, observer)
    }
}

/// Solves a network that is compiled already; where the accuracy has a bound for what may be left out, without what is
/// shown to matter less. Otherwise as [`solve_assembly`], without any further solution.
///
/// The errors of measures include what was left out, and what the segments of layers make of them:
/// the latter takes one further solution, or two where a front is as steep as the segments.
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
    let started = Instant::now();
    let mut report = match settings.accuracy.neglect_below {
        None => {
            let report = solve_assembly(assembly, &words(network), settings, observer)?;
            with_segments(network, report, settings, observer)?
        }
        Some(bound) => {
            let (report, left_out) = reduced(network, assembly, settings, bound, observer)?;
            with_segments(&network.without(&left_out), report, settings, observer)?
        }
    };
    report.solver.wall_in_all = started.elapsed();
    Ok(report)
}
