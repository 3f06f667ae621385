//! `duration = "auto"`: the length of a run that the scene does not say.

use dashpot_analysis::{SolveSettings, found_duration};
use dashpot_network::{
    Network,
    parameters::{Dimension, InvalidParameter},
};

use super::{Reading, RunSettings};
use crate::{
    diagnostics::fault::Fault,
    text::{document::Entry, table::Table},
    units::format_short,
};

/// What stands for a length that is to be found.
const AUTO: &str = "auto";

/// The longest run \[s\] that is found, unless more is allowed.
const AT_MOST: f64 = 1.0;

/// The longest run \[s\] that may be found, where `duration` asks for it; it is an error beside a length that is given.
pub(super) fn read_at_most(
    reading: &Reading<'_>,
    table: &Table<'_>,
    duration: Option<&Entry>,
) -> Option<f64> {
    let is_auto = duration.is_some_and(|own| own.item.text().map(str::trim) == Some(AUTO));
    let Some(own) = table.take("at-most") else { return is_auto.then_some(AT_MOST) };
    if !is_auto {
        let message = "`at-most` bounds a length that is to be found, and `duration` gives one";
        let help = "write `duration = \"auto\"`, or remove `at-most`";
        reading.faults.error(own.key_place, Fault::odd(message, help));
        return None;
    }
    let check = |time: f64| {
        let invalid = || InvalidParameter::new("at-most", "positive", time);
        if time > 0.0 { Ok(()) } else { Err(invalid()) }
    };
    let quantities = reading.quantities().of("run.at-most");
    quantities.read_checked(&own.item, Dimension::TIME, check)
}

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
