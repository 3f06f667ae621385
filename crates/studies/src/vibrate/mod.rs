//! Shaking a linear scene with a sine: transmissibility, resonances, peaks of the steady state.

mod report;

use std::f64::consts::TAU;

use dashpot_analysis::vibration::{
    DriveKind, Resonance, Steady, Sweep, SweepSettings, Swing, Transmission, Vibration,
    VibrationWarning,
};
use dashpot_network::parameters::Dimension;
use dashpot_report::{Report, Table};
use dashpot_scene::{
    Scene,
    units::{Quantity, parse_quantity},
};
use serde::{Serialize, Serializer};

use crate::{
    Amount, Answer, Context, DataTable, Frequency, Operands, Progress, Study, StudyError, VERSION,
    list, object,
    operand::remark_means,
    origin, request,
    study::{self, about_study},
};

request! {
    /// How a scene is shaken. One load or motion is a sine of any small size, all others are silent: the functions of time
    /// in the scene, weights and start speeds do not matter.
    pub VibrateRequest {
        /// The load that pushes or the node that is moved [default: the only one of the scene].
        drive "NAME": Option<String>;
        /// Lowest frequency [default: a tenth of the lowest natural frequency].
        from "FREQUENCY": Option<Frequency>;
        /// Highest frequency [default: ten times the highest natural frequency].
        to "FREQUENCY": Option<Frequency>;
        /// How many frequencies, at equal ratios; resonances are found between them.
        points "NUMBER": usize = 200;
        /// Nodes to look at, or supports and elements where a load drives [default: all masses, all supports]; or
        /// quantities, as `padding.force`: displacement of a node, force, deformation and power of an element, and
        /// dynamic-stiffness, impedance and apparent-mass of the driven node.
        of "NAME,…": Vec<String>;
        /// Peaks of the steady state at this frequency, and what `--of` names, in place of the table over frequency.
        at "FREQUENCY": Option<Frequency>, requires "amplitude";
        /// Amplitude of the drive there: of a force, or of a displacement or an acceleration.
        amplitude "QUANTITY": Option<Amount>, requires "at";
    }
}

/// What shaking a scene has shown.
#[derive(Debug)]
#[non_exhaustive]
pub struct Vibrated {
    /// Title and file of the scene.
    pub title: Option<String>,
    /// See [`title`](Self::title).
    pub file: Option<String>,
    /// The responses over frequency.
    pub sweep: Sweep,
    /// The steady state at one frequency, where one is asked for.
    pub steady: Option<Steady>,
    /// Whether the request says what is looked at.
    is_chosen: bool,
    page: Surroundings,
}

/// What stands around the result on a page.
#[derive(Debug)]
struct Surroundings {
    title: String,
    network: Option<dashpot_report::ReportFigure>,
    settings: Table,
    scene_text: String,
}

/// Shakes a scene.
///
/// # Errors
///
/// [`StudyError::Vibration`] for scenes that switch or are not linear, and for what is not there; and for an amplitude that is
/// no force, length or acceleration.
pub fn vibrate(
    scene: &Scene,
    request: &VibrateRequest,
    context: &mut dyn Context,
) -> Result<Vibrated, StudyError> {
    let vibration = Vibration::new(&scene.network, scene.run.duration, request.drive.as_deref())?;
    let settings = SweepSettings {
        from: request.from.map(|from| from.0),
        to: request.to.map(|to| to.0),
        points: request.points,
        of: request.of.clone(),
        at: request.at.map(|at| at.0),
    };
    let kind = vibration.drive().kind;
    context.prepare(report::files(&vibration.quantities(&settings.of)?, kind))?;
    let sweep = vibration
        .sweep_watched(&settings, &mut |done, of| context.progress(Progress::Count { done, of }))?;
    let steady = match (settings.at, &request.amplitude) {
        (Some(frequency), Some(text)) => {
            Some(vibration.steady(frequency, amplitude(&vibration, frequency, text)?)?)
        }
        (None, None) => None,
        (Some(_), None) => {
            return Err(StudyError::setting("--at", "it takes an `--amplitude` as well"));
        }
        (None, Some(_)) => {
            return Err(StudyError::setting(
                "--amplitude",
                "it takes a frequency, `--at`, as well",
            ));
        }
    };
    let settings = Table::plain("Settings", origin::rows(scene, &|name| context.load(name)));
    Ok(Vibrated {
        title: scene.title.clone(),
        file: scene.file.clone(),
        sweep,
        steady,
        is_chosen: !request.of.is_empty(),
        page: Surroundings {
            title: crate::title(scene).to_owned(),
            network: crate::sketch::figure(scene),
            settings,
            scene_text: scene.text.to_string(),
        },
    })
}

/// The amplitude of the drive \[m or N\]: that of an acceleration is one of a displacement, too.
fn amplitude(vibration: &Vibration, frequency: f64, amount: &Amount) -> Result<f64, StudyError> {
    let drive = vibration.drive();
    let wrong = |reason: String| StudyError::setting("--amplitude", reason);
    let acceleration = Dimension::ACCELERATION;
    let is_acceleration = |own: Quantity| own.meant(acceleration).dimension == Some(acceleration);
    let text = amount.text();
    let (dimension, over, other) = match drive.kind {
        DriveKind::Motion if parse_quantity(&text).is_ok_and(is_acceleration) => {
            (acceleration, (TAU * frequency).powi(2), "")
        }
        DriveKind::Motion => {
            (Dimension::LENGTH, 1.0, "; an acceleration, such as \"0.5 g\", is taken as well")
        }
        DriveKind::Load => (Dimension::FORCE, 1.0, ""),
    };
    let value = amount.positive(&drive.name, dimension).map_err(|own| wrong(own + other))? / over;
    if value.is_normal() { Ok(value) } else { Err(wrong(format!("`{text}` is too small"))) }
}

impl Serialize for Vibrated {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let sweep = &self.sweep;
        let kind = match sweep.drive.kind {
            DriveKind::Motion => "motion",
            DriveKind::Load => "load",
        };
        let (name, node, unit) = (&sweep.drive.name, &sweep.drive.node, sweep.drive.kind.unit());
        let object = object! {
            dashpot: VERSION,
            title: &self.title,
            file: &self.file,
            drive: object! { name, kind, node, unit },
            frequencies: &sweep.frequencies,
            responses: list(sweep.transmissions.iter().map(response)),
            modes: &sweep.modes,
            steady: &self.steady,
            notes: list(sweep.notes.iter().map(VibrationWarning::to_string)),
            note_codes: list(sweep.notes.iter().map(VibrationWarning::code)),
        };
        object.serialize(serializer)
    }
}

fn response(transmission: &Transmission) -> impl Serialize {
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
        ratio: all(|swing| swing.amplitude),
        phase: transmission.has_phase.then(|| all(|swing| swing.phase)),
        error: all(|swing| swing.error),
        resonances: list(transmission.resonances.iter().map(peak)),
        at: transmission.at,
        at_rest: transmission.at_rest,
    }
}

impl Answer for Vibrated {
    fn report(&self) -> Report {
        report::report(self)
    }

    fn warnings(&self) -> Vec<String> {
        let warnings = self.steady.iter().flat_map(|steady| &steady.warnings);
        list(warnings.map(VibrationWarning::to_string))
    }

    fn tables(&self) -> Vec<DataTable<'_>> {
        vec![report::table(&self.sweep)]
    }
}

/// The study.
pub(crate) struct Vibrate;

impl Study for Vibrate {
    about_study! {
        "vibrate", VibrateRequest, Operands::Scene,
        "Shakes a linear scene with a sine: transmissibility, resonances, peaks of the steady state",
        "Examples:\n  \
         dashpot vibrate crate.toml\n  \
         dashpot vibrate crate.toml --from \"1 Hz\" --to \"200 Hz\" --out crate-vibration\n  \
         dashpot vibrate crate.toml --at \"20 Hz\" --amplitude \"0.5 g0\"\n  \
         dashpot vibrate reference --drive ground --of head\n  \
         dashpot vibrate reference --drive ground --of padding.force,ground.apparent-mass\n\n\
         One load or motion is a sine of any small size, all others are silent: the functions of \
         time in the scene, weights and start speeds do not matter. A fixed node such as `ground` may \
         be shaken too. Scenes that switch or are not linear are refused.",
        |operands, set, request, context| {
            let scene = study::scene(operands, set, context)?;
            remark_means(&scene, context);
            vibrate(&scene, &request, context)?
        }
    }
}
