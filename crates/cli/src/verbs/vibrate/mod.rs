//! `dashpot vibrate`.

mod files;
mod tables;

use std::{f64::consts::TAU, path::PathBuf};

use clap::Args;
use dashpot_analysis::vibration::{
    DriveKind, Resonance, Steady, Sweep, SweepSettings, Swing, Transmission, Vibration,
    VibrationWarning,
};
use dashpot_network::parameters::Dimension;
use dashpot_report::Table;
use dashpot_scene::{
    Scene,
    units::{Quantity, parse_quantity},
};
use serde::Serialize;

use self::tables::{drive, modes, range_notes, ratios, resonances, response, steady, steady_notes};
use crate::{
    args::{SceneArguments, When, positive},
    error::{CliError, Status},
    folder::{Folder, Staged},
    input::title,
    operand::note_means,
    output::{Study, Text, VERSION, emit, list, object},
    progress::Bar,
    terminal::{Terminal, WIDTH},
};

/// Digits in the text of a peak.
const DIGITS: usize = 3;
const PLOT_HEIGHT: usize = 16;

/// `vibrate`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot vibrate crate.toml\n  \
    dashpot vibrate crate.toml --from \"1 Hz\" --to \"200 Hz\" --out crate-vibration\n  \
    dashpot vibrate crate.toml --at \"20 Hz\" --amplitude \"0.5 g0\"\n  \
    dashpot vibrate reference --drive ground --of head\n  \
    dashpot vibrate reference --drive ground --of padding.force,ground.apparent-mass\n\n\
    One load or motion is a sine of any small size, all others are silent: the functions of \
    time in the scene, weights and start speeds do not matter. A fixed node such as `ground` may \
    be shaken too. Scenes that switch or are not linear are refused.")]
pub(crate) struct VibrateArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// The load that pushes or the node that is moved [default: the only one of the scene].
    #[arg(long, value_name = "NAME")]
    drive: Option<String>,
    /// Lowest frequency [default: a tenth of the lowest natural frequency].
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true, value_parser = frequency)]
    from: Option<f64>,
    /// Highest frequency [default: ten times the highest natural frequency].
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true, value_parser = frequency)]
    to: Option<f64>,
    /// How many frequencies, at equal ratios; resonances are found between them.
    #[arg(long, value_name = "NUMBER", default_value_t = 200)]
    points: usize,
    /// Nodes to look at, or supports and elements where a load drives [default: all masses, all supports]; or
    /// quantities, as `padding.force`: displacement of a node, force, deformation and power of an element, and
    /// dynamic-stiffness, impedance and apparent-mass of the driven node.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    of: Vec<String>,
    /// Peaks of the steady state at this frequency, and what `--of` names, in place of the table over frequency.
    #[arg(long, value_name = "FREQUENCY", allow_hyphen_values = true, value_parser = frequency, requires = "amplitude")]
    at: Option<f64>,
    /// Amplitude of the drive there: of a force, or of a displacement or an acceleration.
    #[arg(long, value_name = "QUANTITY", allow_hyphen_values = true, requires = "at")]
    amplitude: Option<String>,
    /// Folder for CSV, JSON, SVG and report.html with all on one page; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
    /// A plot in the text; `auto` draws it on terminals.
    #[arg(long, value_name = "WHEN", default_value = "auto", conflicts_with = "json")]
    plot: When,
}

fn frequency(text: &str) -> Result<f64, String> {
    positive("frequency", text, Dimension::FREQUENCY)
}

/// What shaking a scene has shown.
struct Shaken {
    scene: Scene,
    sweep: Sweep,
    steady: Option<Steady>,
    /// Whether it is said what is looked at.
    is_chosen: bool,
    plot: bool,
}

impl Shaken {
    /// The tables of the steady state, where one is asked for.
    fn steady_tables(&self) -> Vec<Table> {
        let Some(own) = &self.steady else { return Vec::new() };
        let asked = self.is_chosen.then(|| ratios(&self.sweep, own.frequency));
        steady(own).into_iter().chain(asked).collect()
    }
}

pub(crate) fn vibrate(
    arguments: &VibrateArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let scene = arguments.scene.read(terminal)?;
    note_means(&scene);
    let vibration = Vibration::new(&scene.network, scene.run.duration, arguments.drive.as_deref())?;
    let settings = SweepSettings {
        from: arguments.from,
        to: arguments.to,
        points: arguments.points,
        of: arguments.of.iter().map(|own| own.trim().to_owned()).collect(),
        at: arguments.at,
    };
    let quantities = vibration.quantities(&settings.of)?;
    let names = files::names(&quantities, vibration.drive().kind);
    let folder = Folder::wanted(arguments.out.as_deref(), names)?;
    let mut bar = Bar::new("vibrate", 0.0, terminal.error.attended);
    let sweep = vibration.sweep_watched(&settings, &mut |done, of| bar.count(done, of))?;
    let steady = match (arguments.at, &arguments.amplitude) {
        (Some(frequency), Some(text)) => {
            Some(vibration.steady(frequency, amplitude(&vibration, frequency, text)?)?)
        }
        _ => None,
    };
    for warning in steady.iter().flat_map(|own| &own.warnings) {
        terminal.warn(&warning.to_string());
    }
    let is_chosen = !arguments.of.is_empty();
    let found = Shaken {
        scene,
        sweep,
        steady,
        is_chosen,
        plot: arguments.plot.is_now(terminal.output.attended),
    };
    emit(&found, arguments.json, folder, terminal)?;
    Ok(Status::Done)
}

/// The amplitude of the drive \[m or N\]: that of an acceleration is one of a displacement, too.
fn amplitude(vibration: &Vibration, frequency: f64, text: &str) -> Result<f64, CliError> {
    let drive = vibration.drive();
    let wrong = |reason: String| CliError::setting("--amplitude", reason);
    let acceleration = Dimension::ACCELERATION;
    let is_acceleration = |own: Quantity| own.meant(acceleration).dimension == Some(acceleration);
    let (dimension, over, other) = match drive.kind {
        DriveKind::Motion if parse_quantity(text).is_ok_and(is_acceleration) => {
            (acceleration, (TAU * frequency).powi(2), "")
        }
        DriveKind::Motion => {
            (Dimension::LENGTH, 1.0, "; an acceleration, such as \"0.5 g\", is taken as well")
        }
        DriveKind::Load => (Dimension::FORCE, 1.0, ""),
    };
    let value = positive(&drive.name, text, dimension).map_err(|own| wrong(own + other))? / over;
    if value.is_normal() { Ok(value) } else { Err(wrong(format!("`{text}` is too small"))) }
}

impl Study for Shaken {
    fn text(&self, text: &mut Text) {
        let Self { sweep, .. } = self;
        text.title(title(&self.scene));
        text.faint(&drive(sweep));
        self.steady_tables().iter().for_each(|own| text.table(own));
        text.paragraphs(self.steady.iter().flat_map(steady_notes));
        text.table(&modes(sweep));
        text.table(&resonances(sweep));
        let notes = sweep.notes.iter().map(VibrationWarning::to_string);
        text.paragraphs(range_notes(sweep).into_iter().chain(notes));
        if self.steady.is_none() {
            let (content, left_out) = response(sweep, WIDTH - 2);
            text.table(&content);
            text.paragraphs(
                left_out.map(|left_out| format!("{left_out}; `--out` writes all of them")),
            );
        }
        if self.plot {
            files::series(sweep).iter().for_each(|own| text.chart(&own.ratio_chart(), PLOT_HEIGHT));
        }
    }

    fn object(&self) -> impl Serialize {
        let Self { scene, sweep, .. } = self;
        let kind = match sweep.drive.kind {
            DriveKind::Motion => "motion",
            DriveKind::Load => "load",
        };
        let (name, node, unit) = (&sweep.drive.name, &sweep.drive.node, sweep.drive.kind.unit());
        object! {
            dashpot: VERSION,
            title: &scene.title,
            file: &scene.file,
            drive: object! { name, kind, node, unit },
            frequencies: &sweep.frequencies,
            responses: list(sweep.transmissions.iter().map(response_object)),
            modes: &sweep.modes,
            steady: &self.steady,
            notes: list(sweep.notes.iter().map(VibrationWarning::to_string)),
            note_codes: list(sweep.notes.iter().map(VibrationWarning::code)),
        }
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}

fn response_object(transmission: &Transmission) -> impl Serialize {
    let all =
        |value: fn(Swing) -> f64| list(transmission.swings.iter().map(|swing| swing.map(value)));
    let peak = |resonance: &Resonance| {
        let Resonance { frequency, frequency_error, swing, band } = *resonance;
        object! { frequency, frequency_error, response: swing, band, quality: resonance.quality() }
    };
    object! {
        name: &transmission.name,
        quantity: transmission.quantity,
        unit: transmission.unit,
        ratio: all(|own| own.amplitude),
        phase: transmission.has_phase.then(|| all(|own| own.phase)),
        error: all(|own| own.error),
        resonances: list(transmission.resonances.iter().map(peak)),
        at: transmission.at,
        at_rest: transmission.at_rest,
    }
}
