//! The settings with which a scene was solved, as they were resolved.

use dashpot_analysis::Stop;
use dashpot_dae::Direction;
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;

use super::Answer;
use crate::numbers::{constant, share};

/// The settings, one a row.
pub(super) fn settings_table(answer: &Answer) -> Table {
    let Some(asked) = answer.asked.first() else { return Table::default() };
    let run = &answer.scene.run;
    let methods: Vec<&str> = answer.asked.iter().map(|own| own.method.name()).collect();
    let mut rows = vec![
        ("duration".to_owned(), constant(asked.duration, "s")),
        ("samples".to_owned(), run.samples.to_string()),
        ("methods".to_owned(), methods.join(", ")),
        (
            "rtol".to_owned(),
            asked.rtol.map_or("found by accuracy".to_owned(), |rtol| format!("{rtol:e}")),
        ),
        (
            "errors".to_owned(),
            if asked.estimate { "estimated" } else { "not estimated" }.to_owned(),
        ),
        ("accuracy".to_owned(), share(asked.accuracy.default)),
    ];
    rows.extend(
        asked
            .accuracy
            .by_measure
            .iter()
            .map(|(key, own)| (format!("accuracy of {key}"), share(*own))),
    );
    rows.extend(
        asked
            .accuracy
            .neglect_below
            .map(|neglect_below| ("neglect below".to_owned(), share(neglect_below))),
    );
    rows.extend(
        asked.stops.iter().map(|stop| (format!("stop at {}", stop.output), stop_text(stop))),
    );
    rows.extend(answer.scene.values.iter().map(|value| {
        let unit = value.dimension.and_then(Dimension::named).map_or("1", |(_, unit)| unit);
        (format!("value {}", value.name), constant(value.value, unit))
    }));
    Table::new("Settings", &[], rows.into_iter().map(|(name, value)| vec![name, value]))
}

fn stop_text(stop: &Stop) -> String {
    format!("{} {}", direction(stop), stop.level)
}

/// Which crossings of its level a condition counts.
pub(super) fn direction(stop: &Stop) -> &'static str {
    match stop.direction {
        Direction::Rising => "rises above",
        Direction::Falling => "falls below",
        Direction::Either => "crosses",
    }
}
