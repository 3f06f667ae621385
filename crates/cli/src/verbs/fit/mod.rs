//! `dashpot fit`.

mod alone;
mod among;
mod asked;
mod figures;
mod files;
mod pressed;
mod scattered;
mod scene;
mod scene_object;
mod scene_words;
mod seen;
mod shown;
mod solver;
mod target;
mod watched;
mod words;
mod written;

use std::path::PathBuf;

use clap::Args;
use dashpot_fit::linear::{
    LinearFault, LinearFit, LinearSettings, Record, RecordFault, fit as fit_spectrum,
};
use dashpot_signal::{Cfc, Padding};
use serde::Serialize;

use self::{
    asked::{Asked, Measured, asked},
    files::{all_names, write_model},
    words::{Units, branches, comments, determined, ends, notes, records, warnings},
};
use crate::{
    args::{Switch, ValueArguments, paddings, share, shift, single},
    counts::STARTS,
    error::{CliError, Status, StudyError},
    folder::Staged,
    input::Input,
    out::{OutArguments, SceneText},
    output::{Pairs, Study, Text, VERSION, emit, list, object},
    section::Verb,
    terminal::{Terminal, note},
};

/// `[fit]` of a scene; what is fitted to are files beside it.
pub(super) const SECTION: Verb = Verb { name: "fit", files: &[("to", |_| Some(0))] };

/// `fit`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot fit --to \"relax.csv:G=felt\" --out felt.toml\n  \
    dashpot fit --to \"dma.csv:E',E''=felt\" --error 2%\n  \
    dashpot fit --to \"hold.csv:stress=gel\" --solid\n  \
    dashpot fit pad.toml --vary \"K=10..1000 kN/m\" --to \"drop.csv:force=pad.force\"\n  \
    dashpot fit pad.toml --vary \"K=10..1000 kN/m\" --to \"drop.csv:acc=head.acceleration\" --cfc 180\n  \
    dashpot fit pad.toml --vary \"K=10..1000 kN/m\" --to \"press.csv:force=pad,rate=10 mm/min\"\n  \
    dashpot fit pad.toml --among \"pad=zener,burgers,prony\" --to \"drop.csv:force=pad.force\"\n  \
    dashpot fit pad.toml --to \"hold.csv:stress=foam\" --until \"140 s\" --out fitted.toml\n\n\
    Columns of files have names and units: times or frequencies, and moduli (relaxation, storage and loss), \
    compliances (creep), or a stress and the strain that was measured beside it, likewise forces \
    and deformations of a pad.\n\n\
    A scene is fitted to its outputs over time, such as `pad.force` or `head.acceleration`, and to tests of a model \
    alone, such as `pad`; a force over a deformation without times states its rate. Several tests share \
    the numbers. What differs is set behind a comma: \"low.csv:force=pad.force,head.drop=0.5 m\", or \
    \"head.velocity=4.5 ± 0.05 m/s\" where it was measured, and how the test was recorded: \
    \"cfc=180,noise=0.5 g,gain=1%\"; `scale=-1` turns the sign of its columns. Tests for which the same stands behind \
    `=` are repeats of one. The section \
    `[fit]` of a scene sets options by their names; those of the command stand above them.\n\n\
    What no network of springs and dashpots can meet is said, and what \
    the records do not determine.")]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
pub(crate) struct FitArguments {
    /// The scene whose numbers are fitted, or whose model is replaced; without it a model is written alone.
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// What is fitted to: columns of a file to a model, or a column to an output of the scene, with what is set for
    /// this test alone behind a comma; repeatable.
    #[arg(long, value_name = "FILE:COLUMNS=TARGET", value_parser = asked, required_unless_present = "scene")]
    to: Vec<Asked>,
    /// A number of the scene that is fitted, and its bounds, "K=10..1000 kN/m"; repeatable.
    #[arg(long, value_name = "NAME=LOW..HIGH", requires = "scene")]
    vary: Vec<String>,
    /// Forms of a model of the scene, "pad=spring,zener,burgers,prony": each is fitted in its place, and the one that
    /// the tests speak for is told and written.
    #[arg(long, value_name = "[MODEL=]FORM,…", requires = "scene")]
    among: Option<String>,
    /// The largest error that fewer branches, or forms with fewer numbers, may make [default: 1%].
    #[arg(long, value_name = "PART", value_parser = share)]
    error: Option<f64>,
    /// Leaves out rows behind this time of the file.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = shift)]
    until: Option<f64>,
    /// Whether the clock of a record may be off: against the run, or of what answered against what was done
    /// [default: on].
    #[arg(long, value_name = "WHEN")]
    shift: Option<Switch>,
    /// Whether the zero of a record of a scene may be off [default: on].
    #[arg(long, value_name = "WHEN")]
    offset: Option<Switch>,
    /// Whether the gain of a record of a scene may be off, and by which part: its standard deviation.
    #[arg(long, value_name = "PART", value_parser = share)]
    gain: Option<f64>,
    /// The channel frequency class that the records went through: the output of the scene goes through the same filter.
    #[arg(long, value_name = "CLASS", value_parser = single::<Cfc>)]
    cfc: Option<Cfc>,
    /// What stood beyond the ends of a record for its filter [default: odd].
    #[arg(long, value_name = "MODE", value_parser = paddings())]
    padding: Option<String>,
    /// Standard deviation of a sample before the filter, "0.5 g"; found from what is left of the records by default.
    #[arg(long, value_name = "VALUE")]
    noise: Option<String>,
    /// Intervals of the profile likelihood for all numbers; else where the covariance falls short.
    #[arg(long)]
    profile: bool,
    /// Writes what is not known of the numbers, and what is known of them together, into the fitted scene as `[scatter]`:
    /// runs and designs then draw from it.
    #[arg(long)]
    scatter: bool,
    /// Whether rows that are far off count by their magnitude, in place of its square; for a model whether rows that stand
    /// apart from all others are left out and reported [default: on].
    #[arg(long, value_name = "WHEN")]
    robust: Option<Switch>,
    /// The material is known to come to rest under a constant load: what relaxes slower than the records determine is a
    /// spring, and nothing flows.
    #[arg(long)]
    solid: bool,
    /// From how many starts numbers of a scene are searched at most: its own, and others over the bounds, until enough
    /// of them end at the same minimum [default: 10].
    #[arg(long, value_name = "NUMBER", value_parser = STARTS.read())]
    starts: Option<usize>,
    /// The seed of these starts [default: 1].
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    #[command(flatten)]
    values: ValueArguments,
    #[command(flatten)]
    out: OutArguments,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

impl FitArguments {
    /// Whether there is something to fit to, and every option that is given is one of this kind of fit.
    fn check(&self) -> Result<(), CliError> {
        let wrong = |name: &str, reason: &str| Err(CliError::setting(name, reason));
        if self.to.is_empty() {
            return wrong("--to", "say to what is fitted, as in \"drop.csv:force=pad.force\"");
        }
        let of_numbers = (
            self.fits_numbers(),
            "it is for numbers of a scene: say which, as in `--vary \"K=10..1000 kN/m\"`",
        );
        let of_spectra =
            (!self.fits_numbers(), "it is for the spectrum of a model alone, without `--vary`");
        let of_among = (
            !self.fits_numbers() || self.among.is_some(),
            "with `--vary` all numbers are fitted; it tells how near fewer branches of a model, or forms of `--among`, \
             have to be",
        );
        let of_scenes = (self.scene.is_some(), "there is no scene in which it could be set");
        let of_filters = (
            self.cfc.is_some() || self.to.iter().any(|own| own.cfc.is_some()),
            "it is for the filter of a record: say which, as in `--cfc 180`",
        );
        let all = [
            ("--error", self.error.is_some(), of_among),
            ("--set", !self.values.set.is_empty(), of_scenes),
            ("--gain", self.gain.is_some(), of_numbers),
            ("--cfc", self.cfc.is_some(), of_numbers),
            ("--noise", self.noise.is_some(), of_numbers),
            ("--offset", self.offset.is_some(), of_numbers),
            ("--profile", self.profile, of_numbers),
            ("--scatter", self.scatter, of_numbers),
            ("--starts", self.starts.is_some(), of_numbers),
            ("--seed", self.seed.is_some(), of_numbers),
            ("--padding", self.padding.is_some(), of_numbers),
            ("--padding", self.padding.is_some(), of_filters),
            ("--solid", self.solid, of_spectra),
        ];
        if let Some((name, _, (_, reason))) = all.iter().find(|own| own.1 && !own.2.0) {
            return wrong(name, reason);
        }
        let behind = self.to.iter().filter(|_| !self.fits_numbers());
        let mut behind = behind.filter_map(|own| Some((own, own.of_numbers()?)));
        behind.next().map_or(Ok(()), |(own, word)| {
            let reason = format!("`{word}` behind its comma: {}", of_numbers.1);
            Err(own.wrong(reason))
        })
    }

    fn error(&self) -> f64 {
        self.error.unwrap_or(0.01)
    }

    fn starts(&self) -> usize {
        self.starts.unwrap_or(10)
    }

    fn seed(&self) -> u64 {
        self.seed.unwrap_or(1)
    }

    /// Whether numbers of a scene are fitted, else a model.
    fn fits_numbers(&self) -> bool {
        !self.vary.is_empty() || self.among.is_some()
    }

    fn padding(&self) -> Padding {
        let given = self.padding.as_deref();
        Padding::ALL.into_iter().find(|own| Some(own.words()[0]) == given).unwrap_or_default()
    }
}

/// Whether what is said of tests, if it is given, is said of one at least: name, whether it is given, whether it is.
fn check_tests<const N: usize>(options: [(&'static str, bool, bool); N]) -> Result<(), CliError> {
    let none = options.into_iter().find(|own| own.1 && !own.2);
    none.map_or(Ok(()), |own| {
        let reason = "it changes nothing: there is no test of which it could be said";
        Err(CliError::setting(own.0, reason))
    })
}

/// What a switch is unless it is given.
fn is_on(own: Option<Switch>) -> bool {
    own != Some(Switch::Off)
}

/// A model that was fitted.
struct Fitted<'f> {
    arguments: &'f FitArguments,
    records: Vec<Measured>,
    fit: LinearFit,
    /// The scene or model with what was found.
    text: String,
    /// The file of the scene, if there is one.
    file: &'f str,
}

impl Fitted<'_> {
    fn name(&self) -> &str {
        &self.arguments.to[0].target
    }

    fn is_material(&self) -> bool {
        self.records[0].is_material
    }

    fn units(&self) -> Units {
        Units::of(self.fit.form, self.is_material())
    }

    fn written(&self) -> SceneText<'_> {
        SceneText { text: &self.text, file: self.file, set: &self.arguments.values.set }
    }
}

/// Fits numbers of a scene, or a model.
pub(crate) fn fit(arguments: &FitArguments, terminal: Terminal) -> Result<Status, CliError> {
    let input = arguments.scene.as_deref().map(crate::input::read_input).transpose()?;
    let merged = input.as_ref().map(|own| SECTION.merged(own)).transpose()?.flatten();
    let arguments = merged.as_ref().unwrap_or(arguments);
    arguments.check()?;
    let Some(input) = input.as_ref().filter(|_| arguments.fits_numbers()) else {
        return fit_model(arguments, input.as_ref(), terminal);
    };
    let (folder, file) = arguments.out.split(all_names(arguments.to.len()))?;
    let fitted = scene::fitted(arguments, input, terminal)?;
    emit(&fitted, arguments.json, folder, terminal)?;
    if let Some(file) = file {
        let text = fitted.scene_text(&fitted.comments());
        file.write(&fitted.written(&text))?;
        note(&format!("wrote {}", file.path.display()));
    }
    Ok(if fitted.fit.is_stopped { Status::RunFailed } else { Status::Done })
}

fn fit_model(
    arguments: &FitArguments,
    input: Option<&Input>,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let (folder, file) = arguments.out.split(all_names(arguments.to.len()))?;
    let name = &arguments.to[0].target;
    if let Some(other) = arguments.to.iter().find(|own| own.target != *name) {
        return Err(other.wrong(format!("`{name}` is fitted already: one model at a time")));
    }
    if let Some(own) = arguments.to.iter().find(|own| own.target.contains('.')) {
        let reason =
            "an output of a scene wants numbers that are fitted: `--vary \"K=10..1000 kN/m\"`";
        return Err(own.wrong(reason));
    }
    let measured = arguments.to.iter().map(|own| own.measured(arguments.until));
    let measured = measured.collect::<Result<Vec<_>, _>>()?;
    let is_material = measured[0].is_material;
    if measured.iter().any(|own| own.is_material != is_material) {
        return Err(StudyError::MaterialAndPad.into());
    }
    let is_timed = |own: &&Asked, record: &Record| own.rate.is_none() && record.has_times();
    let any = |is_one: &dyn Fn(&&Asked, &Record) -> bool| {
        arguments.to.iter().zip(&measured).any(|own| is_one(&own.0, &own.1.record))
    };
    check_tests([
        ("--until", arguments.until.is_some(), any(&is_timed)),
        ("--shift", arguments.shift.is_some(), any(&|_, own| own.has_history())),
    ])?;
    measured.iter().filter_map(|own| own.note.as_deref()).for_each(note);
    let records: Vec<Record> = list(measured.iter().map(|own| own.record.clone()));
    let settings = LinearSettings {
        error: arguments.error(),
        is_shifted: is_on(arguments.shift),
        is_robust: is_on(arguments.robust),
        is_solid: arguments.solid,
    };
    let fit =
        fit_spectrum(&records, settings).map_err(|fault| wrong(fault, &arguments.to, &measured))?;
    let (beside, text) = (input.map_or("", |own| &own.file), String::new());
    let mut fitted = Fitted { arguments, records: measured, fit, text, file: beside };
    let model =
        written::model(&fitted.fit).ok_or_else(|| StudyError::OutOfRange { word: name.clone() })?;
    let scene = input.map(|own| (own, &arguments.values.set[..]));
    fitted.text = written::text(scene, (name, is_material), &model, &comments(&fitted))?;
    emit(&fitted, arguments.json, folder, terminal)?;
    if let Some(file) = file {
        file.write(&fitted.written())?;
        note(&format!("wrote {0}; its model is `{0}:{name}`", file.path.display()));
    }
    Ok(Status::Done)
}

/// A fault of a record, with its file and line.
fn wrong(fault: LinearFault, asked: &[Asked], measured: &[Measured]) -> CliError {
    let (record, row) = match fault {
        LinearFault::Record { record, fault } => (record, RecordFault::row(&fault)),
        LinearFault::MixedForms { record } => (record, None),
        _ => (0, None),
    };
    measured[record].fault(&asked[record], row, &fault)
}

impl Study for Fitted<'_> {
    fn warnings(&self) -> Vec<String> {
        warnings(self)
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&warnings(self));
        text.title(self.name());
        text.table(&records(self));
        text.table(&determined(self));
        text.table(&branches(self));
        text.blank();
        text.items(notes(self));
    }

    fn notes(&self) -> Vec<String> {
        notes(self)
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        write_model(files, self)
    }

    fn object(&self) -> impl Serialize {
        let unit = self.units().strength;
        let parameters = ends(&self.fit, self.is_material()).into_iter().map(|(key, _, range)| {
            let (value, low, high) = (range.value, range.low, range.high);
            (key, object! { value, low, high, unit, identified: range.is_identified() })
        });
        let tests = self.records.iter().zip(&self.fit.records).map(|(told, own)| {
            object! {
                file: &told.file,
                rms: own.misfit.rms,
                largest: own.misfit.largest,
                floor: own.floor,
                scale: own.largest,
                shift: own.shift,
                offset: None::<f64>,
                outliers: list(own.outliers.iter().map(|own| object! {
                    line: told.lines.get(own.row),
                    off: own.off,
                })),
                contradiction: own.contradiction,
            }
        });
        let branches = self.fit.spectrum.branches.iter();
        object! {
            dashpot: VERSION,
            model: self.name(),
            material: self.is_material(),
            parameters: parameters.collect::<Pairs<_, _>>(),
            tests: list(tests),
            converged: self.fit.is_kept,
            floor: self.fit.floor,
            floor_unshifted: self.fit.floor_unshifted,
            rms: self.fit.misfit.rms,
            largest: self.fit.misfit.largest,
            spring: self.fit.spectrum.spring,
            dashpot_constant: self.fit.spectrum.dashpot,
            branches: list(branches.map(|&(time, strength)| object! { time, strength, unit })),
        }
    }
}
