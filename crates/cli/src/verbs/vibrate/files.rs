//! What `vibrate` draws, and what it writes into a folder.

use dashpot_analysis::vibration::{
    DriveKind, Quantity, Sweep, Swing, Transmission, VibrationWarning,
};
use dashpot_plot::{VibrationCurve, VibrationSeries};
use dashpot_report::{Page, ReportFigure, Table};

use super::{
    DIGITS, Shaken,
    tables::{
        degrees, drive, modes, quantities, range_notes, resonances, response, steady_notes,
        title as title_of,
    },
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    numbers::{Unit, quantity},
    origin,
    output::{PAGE, csv, list},
    sketch,
};

/// Ratios and phases at all frequencies.
const TABLE: &str = "response.csv";
const PHASE: &str = "phase.svg";

/// The files that are written besides the result, with a figure for each of these quantities.
pub(super) fn names(quantities: &[&Quantity], drive: DriveKind) -> Vec<String> {
    let figures = quantities.iter().map(|own| figure(&title_of(own, drive)));
    figures.chain([PHASE, TABLE, PAGE].map(str::to_owned)).collect()
}

fn figure(title: &str) -> String {
    format!("{}.svg", title.replace(' ', "-"))
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, shaken: &Shaken) -> Result<(), CliError> {
    let all = &shaken.sweep.transmissions;
    let header = all.iter().flat_map(|Transmission { name, unit, .. }| {
        [("ratio", *unit), ("phase", "deg"), ("error", *unit)]
            .map(|(what, unit)| format!("{what} of {name} [{unit}]"))
    });
    let header = ["frequency [Hz]".to_owned()].into_iter().chain(header);
    let row = |(at, frequency): (usize, &f64)| {
        let values = all.iter().flat_map(|own| {
            let swing = own.swings[at];
            // A zero has no sign.
            let phase = swing.filter(|_| own.has_phase).map(|swing| degrees(swing.phase) + 0.0);
            [swing.map(|swing| swing.amplitude), phase, swing.map(|swing| swing.error)]
        });
        list([Some(*frequency)].into_iter().chain(values))
    };
    let rows = shaken.sweep.frequencies.iter().enumerate().map(row);
    files.add_with(TABLE, |out| csv(out, header, rows))?;
    let figures = figures(&shaken.sweep)?;
    files.add(PAGE, page(shaken, &figures).html())?;
    figures.into_iter().try_for_each(|(name, own)| files.add(&name, own.svg))
}

/// A figure of each quantity, and one of all phases, with the names of their files.
fn figures(sweep: &Sweep) -> Result<Vec<(String, ReportFigure)>, CliError> {
    let mut figures = Vec::new();
    for series in series(sweep) {
        figures.push((figure(&series.quantity), ReportFigure::of(&series.ratio_chart())?));
    }
    let phases = of(sweep, String::new(), "", |own| own.has_phase);
    if !phases.curves.is_empty() {
        figures.push((PHASE.to_owned(), ReportFigure::of(&phases.phase_chart())?));
    }
    Ok(figures)
}

fn page(shaken: &Shaken, figures: &[(String, ReportFigure)]) -> Page {
    let Shaken { scene, sweep, .. } = shaken;
    let of_steady = shaken.steady.iter();
    let warnings = of_steady.clone().flat_map(|own| &own.warnings).map(ToString::to_string);
    let notes = of_steady.clone().flat_map(steady_notes);
    let notes = notes.chain(range_notes(sweep));
    let notes = notes.chain(sweep.notes.iter().map(VibrationWarning::to_string));
    let tables = shaken.steady_tables().into_iter().chain([modes(sweep), resonances(sweep)]);
    Page {
        title: title(scene).to_owned(),
        warnings: list(warnings),
        verdict: [drive(sweep)].into_iter().chain(notes).collect(),
        tables: tables.filter(|own| !own.rows.is_empty()).collect(),
        network: sketch::figure(scene),
        figures: list(figures.iter().map(|own| own.1.clone())),
        details: vec![response(sweep, usize::MAX).0, Table::plain("Settings", origin::rows(scene))],
        scene_text: scene.text.to_string(),
    }
}

/// The responses as the plain numbers that figures are drawn from, with their peaks between the frequencies of the list:
/// quantity by quantity.
pub(super) fn series(sweep: &Sweep) -> Vec<VibrationSeries> {
    let kind = sweep.drive.kind;
    let series = |own: &Quantity| {
        of(sweep, title_of(own, kind), own.unit(kind), |shown| shown.quantity == own.word)
    };
    quantities(sweep).into_iter().map(series).collect()
}

fn of(
    sweep: &Sweep,
    quantity: String,
    unit: &str,
    is_shown: impl Fn(&Transmission) -> bool,
) -> VibrationSeries {
    let shown = sweep.transmissions.iter().filter(|own| is_shown(own));
    VibrationSeries {
        title: format!("Response to {}", sweep.drive.name),
        quantity,
        unit: Unit::plain(unit).symbol,
        curves: list(shown.map(|own| curve(sweep, own))),
    }
}

fn curve(sweep: &Sweep, transmission: &Transmission) -> VibrationCurve {
    let swings = sweep.frequencies.iter().copied().zip(transmission.swings.iter().copied());
    let resonances = transmission.resonances.iter().map(|own| (own.frequency, own.swing));
    let mut points: Vec<(f64, Option<Swing>)> = swings.chain(resonances).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let peaks = transmission.resonances.iter().filter_map(|resonance| {
        let height = resonance.swing?.amplitude;
        let height_text = quantity(height, transmission.unit, DIGITS);
        let label = format!("{height_text} at {}", quantity(resonance.frequency, "Hz", DIGITS));
        Some((resonance.frequency, height, label))
    });
    let value = |of: fn(Swing) -> f64| {
        points.iter().map(|point| point.1.map_or(f64::NAN, of)).collect::<Vec<f64>>()
    };
    VibrationCurve {
        name: transmission.name.clone(),
        frequency: points.iter().map(|point| point.0).collect(),
        ratio: value(|own| own.amplitude),
        phase: value(|own| degrees(own.phase)),
        peaks: peaks.collect(),
    }
}
