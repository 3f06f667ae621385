//! What `vibrate` draws, and what it writes into a folder.

use dashpot_analysis::vibration::{Sweep, Swing, Transmission, VibrationWarning};
use dashpot_plot::{Report, ReportFigure, Table, VibrationCurve, VibrationSeries};

use super::{
    DIGITS, Shaken,
    tables::{degrees, drive, modes, range_notes, resonances, response, steady, steady_notes},
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
const FIGURES: [&str; 2] = ["transmissibility.svg", "phase.svg"];

/// The files that are written besides the result.
pub(super) fn names() -> Vec<String> {
    FIGURES.iter().chain([&TABLE, &PAGE]).map(|own| (*own).to_owned()).collect()
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, shaken: &Shaken) -> Result<(), CliError> {
    let all = &shaken.sweep.transmissions;
    let header = all.iter().flat_map(|Transmission { name, .. }| {
        [("ratio", "1"), ("phase", "deg"), ("error", "1")]
            .map(|(what, unit)| format!("{what} of {name} [{unit}]"))
    });
    let header = ["frequency [Hz]".to_owned()].into_iter().chain(header);
    let row = |(at, frequency): (usize, &f64)| {
        let values = all.iter().flat_map(|own| {
            let swing = own.swings[at];
            // A zero has no sign.
            let phase = swing.map(|swing| degrees(swing.phase) + 0.0);
            [swing.map(|swing| swing.amplitude), phase, swing.map(|swing| swing.error)]
        });
        list([Some(*frequency)].into_iter().chain(values))
    };
    let rows = shaken.sweep.frequencies.iter().enumerate().map(row);
    files.add_with(TABLE, |out| csv(out, header, rows))?;
    let figures = figures(&shaken.sweep)?;
    files.add(PAGE, page(shaken, &figures).html())?;
    FIGURES.into_iter().zip(figures).try_for_each(|(name, own)| files.add(name, own.svg))
}

fn figures(sweep: &Sweep) -> Result<[ReportFigure; 2], CliError> {
    let series = series(sweep);
    Ok([ReportFigure::of(&series.ratio_chart())?, ReportFigure::of(&series.phase_chart())?])
}

fn page(shaken: &Shaken, figures: &[ReportFigure]) -> Report {
    let Shaken { scene, sweep, .. } = shaken;
    let of_steady = shaken.steady.iter();
    let warnings = of_steady.clone().flat_map(|own| &own.warnings).map(ToString::to_string);
    let notes = of_steady.clone().flat_map(steady_notes);
    let notes = notes.chain(range_notes(sweep));
    let notes = notes.chain(sweep.notes.iter().map(VibrationWarning::to_string));
    let tables = of_steady.flat_map(steady).chain([modes(sweep), resonances(sweep)]);
    Report {
        title: title(scene).to_owned(),
        warnings: list(warnings),
        verdict: [drive(&sweep.drive)].into_iter().chain(notes).collect(),
        tables: tables.filter(|own| !own.rows.is_empty()).collect(),
        network: sketch::figure(scene),
        figures: figures.to_vec(),
        details: vec![response(sweep, usize::MAX).0, Table::plain("Settings", origin::rows(scene))],
        scene_text: scene.text.to_string(),
    }
}

/// The responses as the plain numbers that figures are drawn from, with their peaks between the
/// frequencies of the list.
pub(super) fn series(sweep: &Sweep) -> VibrationSeries {
    VibrationSeries {
        title: format!("Response to {}", sweep.drive.name),
        curves: sweep.transmissions.iter().map(|transmission| curve(sweep, transmission)).collect(),
    }
}

fn curve(sweep: &Sweep, transmission: &Transmission) -> VibrationCurve {
    let swings = sweep.frequencies.iter().copied().zip(transmission.swings.iter().copied());
    let resonances = transmission.resonances.iter().map(|own| (own.frequency, own.swing));
    let mut points: Vec<(f64, Option<Swing>)> = swings.chain(resonances).collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let peaks = transmission.resonances.iter().filter_map(|resonance| {
        let height = resonance.swing?.amplitude;
        let value = Unit::plain("1").number(height, DIGITS);
        let label = format!("{value} at {}", quantity(resonance.frequency, "Hz", DIGITS));
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
