//! What `vibrate` draws, and what it writes into a folder.

use std::io::Write;

use dashpot_analysis::vibration::{Sweep, Swing, Transmission};
use dashpot_plot::{VibrationCurve, VibrationSeries};

use crate::{
    answer::vibration::degrees,
    error::CliError,
    folder::Staged,
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

/// Adds all files but the result.
pub(crate) fn write(files: &mut Staged<'_>, sweep: &Sweep) -> Result<(), CliError> {
    let series = series(sweep);
    let [ratio, phase] = FIGURES;
    files.add_with(TABLE, |out| Ok(write_csv(sweep, out)?))?;
    files.add(ratio, series.ratio_chart().svg()?)?;
    files.add(phase, series.phase_chart().svg()?)
}

/// The responses at all frequencies of the list.
fn write_csv(sweep: &Sweep, out: &mut dyn Write) -> csv::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
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
    Ok(writer.flush()?)
}
