//! What `vibrate` draws, and what it writes into a folder.

use std::{fs, path::Path};

use dashpot_analysis::vibration::{Sweep, Swing, Transmission};
use dashpot_plot::{VibrationCurve, VibrationSeries};

use crate::{
    answer::vibration::degrees,
    error::CliError,
    folder::{RESULT, unwritable},
    numbers::{Unit, quantity},
};

/// Ratios and phases at all frequencies.
const TABLE: &str = "response.csv";
/// The figures.
const FIGURES: [&str; 2] = ["transmissibility.svg", "phase.svg"];
/// Digits in the text of a peak.
const DIGITS: usize = 3;

/// The files that are written besides the result.
pub(crate) fn file_names() -> Vec<String> {
    FIGURES.iter().chain([&TABLE]).map(|own| (*own).to_owned()).collect()
}

/// The responses as the plain numbers that figures are drawn from, with their peaks between the
/// frequencies of the list.
pub(crate) fn series(sweep: &Sweep) -> VibrationSeries {
    VibrationSeries {
        title: format!("Response to {}", sweep.drive.name),
        curves: sweep.transmissions.iter().map(|own| curve(sweep, own)).collect(),
    }
}

fn curve(sweep: &Sweep, own: &Transmission) -> VibrationCurve {
    let mut points: Vec<(f64, Option<Swing>)> =
        sweep.frequencies.iter().copied().zip(own.swings.iter().copied()).collect();
    points.extend(own.resonances.iter().map(|own| (own.frequency, own.swing)));
    points.sort_by(|one, other| one.0.total_cmp(&other.0));
    let peaks = own.resonances.iter().filter_map(|own| {
        let height = own.swing?.amplitude;
        let value = Unit::plain("1").number(height, DIGITS);
        let label = format!("{value} at {}", quantity(own.frequency, "Hz", DIGITS));
        Some((own.frequency, height, label))
    });
    let value = |of: fn(Swing) -> f64| {
        points.iter().map(|own| own.1.map_or(f64::NAN, of)).collect::<Vec<f64>>()
    };
    VibrationCurve {
        name: own.name.clone(),
        frequency: points.iter().map(|own| own.0).collect(),
        ratio: value(|own| own.amplitude),
        phase: value(|own| degrees(own.phase)),
        peaks: peaks.collect(),
    }
}

/// Writes everything into the folder `path`, and returns the names of the files.
pub(crate) fn write(path: &Path, json: &str, sweep: &Sweep) -> Result<Vec<String>, CliError> {
    let series = series(sweep);
    let [ratio, phase] = FIGURES.map(str::to_owned);
    let table = csv(sweep).map_err(std::io::Error::from);
    let files = [
        (RESULT.to_owned(), json.as_bytes().to_vec()),
        (TABLE.to_owned(), table.map_err(unwritable(&path.join(TABLE)))?),
        (ratio, series.ratio_chart().svg()?.into_bytes()),
        (phase, series.phase_chart().svg()?.into_bytes()),
    ];
    for (name, content) in &files {
        let file = path.join(name);
        fs::write(&file, content).map_err(unwritable(&file))?;
    }
    Ok(files.into_iter().map(|own| own.0).collect())
}

/// The responses at all frequencies of the list.
fn csv(sweep: &Sweep) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = vec!["frequency [Hz]".to_owned()];
    for own in &sweep.transmissions {
        header.push(format!("ratio of {} [1]", own.name));
        header.push(format!("phase of {} [deg]", own.name));
        header.push(format!("error of {} [1]", own.name));
    }
    writer.write_record(header)?;
    for (at, frequency) in sweep.frequencies.iter().enumerate() {
        let mut record = vec![Some(*frequency)];
        for own in &sweep.transmissions {
            let swing = own.swings[at];
            record.push(swing.map(|own| own.amplitude));
            // A zero has no sign.
            record.push(swing.map(|own| degrees(own.phase) + 0.0));
            record.push(swing.map(|own| own.error));
        }
        writer.serialize(record)?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
