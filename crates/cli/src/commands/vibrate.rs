//! `dashpot vibrate`.

use std::{f64::consts::TAU, fmt::Write as _};

use dashpot_analysis::vibration::{DriveKind, Steady, Sweep, SweepSettings, Vibration};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use dashpot_scene::{Scene, units::parse_quantity};

use crate::{
    answer::{
        title,
        vibration::{Document, drive, remarks, resonances, response, steady, steady_remarks},
    },
    args::{VibrateArguments, When},
    error::{CliError, Status},
    folder::Folder,
    input::read_scene,
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data},
    text::{table, wrapped},
    vibration_folder::{file_names, series, write},
};

/// Lines of a plot.
const PLOT_HEIGHT: usize = 16;

/// Shakes a scene.
pub(crate) fn vibrate(
    arguments: &VibrateArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let checked = read_scene(arguments.scene.scene.as_deref(), &arguments.scene.values.set)?;
    terminal.diagnose(&checked.warnings);
    let scene = checked.value;
    let vibration = Vibration::new(&scene.network, scene.run.duration, arguments.drive.as_deref())?;
    let folder = Folder::wanted(arguments.out.as_deref(), file_names())?;
    let sweep = vibration.sweep(&SweepSettings {
        from: arguments.from,
        to: arguments.to,
        points: arguments.points,
        of: arguments.of.iter().map(|own| own.trim().to_owned()).collect(),
    })?;
    let steady = match (arguments.at, &arguments.amplitude) {
        (Some(frequency), Some(text)) => {
            Some(vibration.steady(frequency, amplitude(&vibration, frequency, text)?)?)
        }
        _ => None,
    };
    for warning in steady.iter().flat_map(|own| &own.warnings) {
        terminal.warn(warning);
    }
    let document = Document::of(&scene, &sweep, steady.as_ref());
    let json = serde_json::to_string_pretty(&document)? + "\n";
    if arguments.json {
        print_data(&json)?;
    } else {
        print(&text(&scene, &sweep, steady.as_ref(), (arguments.plot, terminal)))?;
    }
    if let Some(folder) = folder {
        folder.write(|files| write(files, &sweep), &json, arguments.json)?;
    }
    Ok(Status::Done)
}

/// The amplitude of the drive \[m or N\]: that of an acceleration is one of a displacement, too.
fn amplitude(vibration: &Vibration, frequency: f64, text: &str) -> Result<f64, CliError> {
    let drive = vibration.drive();
    let wrong = |reason: String| CliError::WrongAmplitude { drive: drive.name.clone(), reason };
    let quantity = parse_quantity(text).map_err(|error| wrong(error.to_string()))?;
    let omega = TAU * frequency;
    let value = match (drive.kind, quantity.dimension) {
        (DriveKind::Motion, None | Some(Dimension::LENGTH))
        | (DriveKind::Load, None | Some(Dimension::FORCE)) => quantity.value,
        (DriveKind::Motion, Some(Dimension::ACCELERATION)) => quantity.value / (omega * omega),
        (DriveKind::Motion, Some(_)) => {
            let wanted = "a displacement or an acceleration is wanted, such as \"1 mm\" or";
            let grams = text.trim().strip_suffix('g').map(str::trim);
            let grams = grams.filter(|number| number.parse::<f64>().is_ok());
            let number = grams.unwrap_or("0.5");
            let gram = "; `g` is the gram, the acceleration of gravity is `g0`";
            let gram = if grams.is_some() { gram } else { "" };
            return Err(wrong(format!("{wanted} \"{number} g0\"{gram}")));
        }
        (DriveKind::Load, Some(_)) => {
            return Err(wrong("a force is wanted, such as \"10 N\"".to_owned()));
        }
    };
    if value.is_normal() && value > 0.0 {
        Ok(value)
    } else {
        Err(wrong(format!("`{text}` is not a positive amplitude")))
    }
}

fn text(
    scene: &Scene,
    sweep: &Sweep,
    steady: Option<&Steady>,
    (plot, terminal): (When, Terminal),
) -> String {
    let mut text = String::new();
    for line in wrapped(title(scene), WIDTH) {
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &line));
    }
    for line in wrapped(&drive(&sweep.drive), WIDTH - 2) {
        let _ = writeln!(text, "  {}", terminal.toned(Tone::Faint, &line));
    }
    if let Some(own) = steady {
        self::steady(own).iter().for_each(|own| show(&mut text, own, terminal));
        say(&mut text, &steady_remarks(own));
    }
    show(&mut text, &resonances(sweep), terminal);
    say(&mut text, &remarks(sweep));
    say(&mut text, &sweep.notes);
    if steady.is_none() {
        let (content, left_out) = response(sweep, WIDTH - 2);
        show(&mut text, &content, terminal);
        let hint = |own| format!("{own}; `--out` writes all of them");
        say(&mut text, &left_out.map(hint).into_iter().collect::<Vec<_>>());
    }
    let is_plotted = match plot {
        When::Auto => terminal.output.attended,
        When::Always => true,
        When::Never => false,
    };
    if is_plotted {
        let _ = write!(text, "\n{}", series(sweep).ratio_chart().text(WIDTH, PLOT_HEIGHT));
    }
    text
}

/// Adds a table, if it has any rows.
fn show(text: &mut String, content: &Table, terminal: Terminal) {
    if content.rows.is_empty() {
        return;
    }
    let _ = writeln!(text);
    if !content.caption.is_empty() {
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, &content.caption));
    }
    let (header, rows) = table(content);
    for line in [header].iter().chain(&rows) {
        let _ = writeln!(text, "  {line}");
    }
}

fn say(text: &mut String, remarks: &[String]) {
    for line in remarks.iter().flat_map(|own| wrapped(own, WIDTH - 2)) {
        let _ = writeln!(text, "  {line}");
    }
}
