//! `dashpot fit`.

mod asked;
mod words;
mod written;

use std::path::PathBuf;

use clap::Args;
use dashpot_fit::linear::{
    LinearFault, LinearFit, LinearSettings, Record, RecordFault, fit as fit_spectrum,
};
use serde::Serialize;

use self::{
    asked::{Asked, Measured, asked},
    words::{Units, branches, comments, determined, ends, notes, records, warnings},
};
use crate::{
    args::{Switch, ValueArguments, share, signed_time},
    error::{CliError, Status},
    input::Input,
    output::{Pairs, Study, Text, VERSION, emit, list, object},
    part::write_text,
    terminal::{Terminal, note},
};

/// `fit`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot fit --to \"relax.csv:G=felt\" --out felt.toml\n  \
    dashpot fit --to \"dma.csv:E',E''=felt\" --error 2%\n  \
    dashpot fit pad.toml --to \"hold.csv:stress=foam\" --until \"140 s\" --out fitted.toml\n\n\
    Files have names and units: times or frequencies, and moduli (relaxation, storage and loss), \
    compliances (creep), or a stress and the strain that was measured beside it, likewise forces \
    and deformations of a pad. What no network of springs and dashpots can meet is said, and what \
    the records do not determine.")]
pub(crate) struct FitArguments {
    /// The scene whose model is replaced; without it the model is written alone.
    #[arg(value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Which columns of a file a model is fitted to; repeatable for one model.
    #[arg(long, value_name = "FILE:COLUMNS=MODEL", value_parser = asked, required = true)]
    to: Vec<Asked>,
    /// The largest error that fewer branches may make.
    #[arg(long, value_name = "PART", default_value = "1%", value_parser = share)]
    error: f64,
    /// Leaves out rows behind this time of the file.
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = signed_time)]
    until: Option<f64>,
    /// Whether the clock of what answered may differ from that of what was done.
    #[arg(long, value_name = "WHEN", default_value = "on")]
    shift: Switch,
    #[command(flatten)]
    values: ValueArguments,
    /// File for the scene with the fitted model.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    force: bool,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

/// What is told of a record.
struct Told {
    file: String,
    what: String,
}

/// A model that was fitted.
struct Fitted {
    name: String,
    is_material: bool,
    error: f64,
    records: Vec<Told>,
    fit: LinearFit,
}

impl Fitted {
    fn units(&self) -> Units {
        Units::of(self.fit.form, self.is_material)
    }
}

/// Fits a model.
pub(crate) fn fit(arguments: &FitArguments, terminal: Terminal) -> Result<Status, CliError> {
    let name = &arguments.to[0].target;
    if let Some(other) = arguments.to.iter().find(|own| own.target != *name) {
        let reason = format!("`{name}` is fitted already: one model at a time");
        return Err(CliError::Fit { text: other.text.clone(), reason });
    }
    let input = arguments.scene.as_deref().map(Input::read).transpose()?;
    let measured = arguments.to.iter().map(|own| own.measured(arguments.until));
    let measured = measured.collect::<Result<Vec<_>, _>>()?;
    let is_material = measured[0].is_material;
    if measured.iter().any(|own| own.is_material != is_material) {
        return Err(CliError::MaterialAndPad);
    }
    measured.iter().filter_map(|own| own.note.as_deref()).for_each(note);
    let records: Vec<Record> = list(measured.iter().map(|own| own.record.clone()));
    let settings =
        LinearSettings { error: arguments.error, is_shifted: arguments.shift == Switch::On };
    let fit =
        fit_spectrum(&records, settings).map_err(|fault| wrong(fault, &arguments.to, &measured))?;
    let told = arguments.to.iter().zip(measured);
    let told = told.map(|(asked, own)| Told { file: asked.file.clone(), what: own.what });
    let fitted = Fitted {
        name: name.clone(),
        is_material,
        error: arguments.error,
        records: told.collect(),
        fit,
    };
    let model = written::model(&fitted.fit)
        .ok_or_else(|| CliError::OutOfRange { word: fitted.name.clone() })?;
    let scene = input.as_ref().map(|own| (own, &arguments.values.set[..]));
    let text = written::text(scene, (name, is_material), &model, &comments(&fitted))?;
    emit(&fitted, arguments.json, None, terminal)?;
    if let Some(path) = &arguments.out {
        write_text(path, &text, arguments.force)?;
        note(&format!("wrote {0}; its model is `{0}:{name}`", path.display()));
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
    let line = row.and_then(|row| measured[record].lines.get(row));
    let line = line.map_or(String::new(), |line| format!("line {line}: "));
    CliError::Fit { text: asked[record].text.clone(), reason: format!("{line}{fault}") }
}

impl Study for Fitted {
    fn warnings(&self) -> Vec<String> {
        warnings(self)
    }

    fn text(&self, text: &mut Text) {
        text.warnings(&warnings(self));
        text.title(&self.name);
        text.table(&records(self));
        text.table(&determined(self));
        text.table(&branches(self));
        text.blank();
        text.items(notes(self));
    }

    fn notes(&self) -> Vec<String> {
        notes(self)
    }

    fn object(&self) -> impl Serialize {
        let unit = self.units().strength;
        let parameters = ends(&self.fit, self.is_material).into_iter().map(|(key, _, range)| {
            let (value, low, high) = (range.value, range.low, range.high);
            (key, object! { value, low, high, unit, identified: range.is_identified() })
        });
        let tests = self.records.iter().zip(&self.fit.records).map(|(told, own)| {
            object! {
                file: &told.file,
                rms: own.misfit.rms,
                largest: own.misfit.largest,
                floor: own.floor.rms,
                scale: own.largest,
                shift: own.shift,
                offset: None::<f64>,
                contradiction: own.contradiction.map(|own| object! {
                    storage_alone: own.storage_alone,
                    loss_alone: own.loss_alone,
                    loss_from_storage: own.loss_from_storage,
                    storage_from_loss: own.storage_from_loss,
                }),
            }
        });
        let branches = self.fit.spectrum.branches.iter();
        object! {
            dashpot: VERSION,
            model: &self.name,
            material: self.is_material,
            parameters: parameters.collect::<Pairs<_, _>>(),
            tests: list(tests),
            converged: self.fit.is_kept,
            floor: self.fit.floor.rms,
            floor_unshifted: self.fit.floor_unshifted.map(|own| own.rms),
            rms: self.fit.misfit.rms,
            largest: self.fit.misfit.largest,
            spring: self.fit.spectrum.spring,
            dashpot_constant: self.fit.spectrum.dashpot,
            branches: list(branches.map(|&(time, strength)| object! { time, strength, unit })),
        }
    }
}
