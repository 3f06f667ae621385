//! `duration = "auto"`: the length of a run that the scene does not say.

use dashpot_analysis::{SolveSettings, found_duration};
use dashpot_network::{Network, parameters::Dimension};
use dashpot_units::format_short;

use super::{Reading, RunSettings};
use crate::diagnostics::fault::Fault;

/// The length \[s\] that the network needs, at most `at_most` \[s\]; where that is too short for it, or a run
/// that is tried fails, the scene is told.
pub(crate) fn find_duration(
    reading: &Reading<'_>,
    network: &Network,
    run: &RunSettings,
    at_most: f64,
) -> Option<f64> {
    let entry = reading.section("run").iter().find(|own| own.key == "duration");
    let place = entry.map(|own| own.item.place);
    let settings = SolveSettings { stops: run.stops.clone(), ..SolveSettings::lasting(at_most) };
    match found_duration(network, &settings, at_most) {
        Ok(found) => {
            if found.is_cut {
                let end = format_short(found.duration, Dimension::TIME, 4);
                let message = format!(
                    "the run is cut off at {end}: by then not every impact is over, or a larger peak may \
                     follow"
                );
                let help = "give a longer `at-most`, a `duration`, or a condition in `stop`";
                reading.faults.warning(place, Fault::odd(message, help));
            }
            Some(found.duration)
        }
        Err(error) => {
            let message = format!("how long the run has to be cannot be found: {error}");
            reading
                .faults
                .missing(place, Fault::odd(message, "give a `duration` such as \"50 ms\""));
            None
        }
    }
}
