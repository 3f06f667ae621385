//! `dashpot convert`.

use std::path::PathBuf;

use clap::{
    Args,
    builder::{PossibleValue, PossibleValuesParser},
};
use dashpot_network::{Model, linear_model, model_of};
use dashpot_rheology::{
    conversion::{Target, converted},
    equivalence::{Equivalence, compare},
};
use dashpot_scene::{read_named_model, with_model, write_model_table};

use crate::input::AsCommanded as _;
use crate::{
    args::{MODEL, ValueArguments},
    error::{CliError, Status, StudyError},
    operand::Surroundings,
    out::{SceneFile, SceneText},
    terminal::{Terminal, note, print, print_data},
};
use dashpot_report::numbers::bound;
use dashpot_studies::operand::{Operand, Subject};

/// Name of the table for a response, which has none of its own.
const RESPONSE: &str = "response";

/// `convert`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot convert reference:padding --to generalized-maxwell\n  \
    dashpot convert pads.toml:felt --to prony --out pads-prony.toml\n  \
    dashpot convert bridge.toml:head,ground --to generalized-kelvin\n\n\
    The text is that of FILE with the model replaced, its comments kept, so that \
    `dashpot run` takes it as it took FILE. The response at nodes becomes a table \
    [models.NAME] of its own.")]
pub(crate) struct ConvertArguments {
    /// The model.
    #[arg(value_name = "MODEL", help = MODEL)]
    model: String,
    /// The form.
    #[arg(long, value_name = "FORM", value_parser = forms())]
    to: String,
    #[command(flatten)]
    values: ValueArguments,
    /// File to write; without it the text is printed.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    force: bool,
}

fn forms() -> PossibleValuesParser {
    PossibleValuesParser::new(
        Target::all()
            .into_iter()
            .map(|form| PossibleValue::new(form.word).aliases(form.aliases).help(form.summary)),
    )
}

/// Writes a model in another form.
pub(crate) fn convert(
    arguments: &ConvertArguments,
    terminal: Terminal,
) -> Result<Status, CliError> {
    let mut surroundings = Surroundings::of("convert", terminal);
    let operand = Operand::read(&arguments.model, &arguments.values.set, &mut surroundings)?;
    let file = arguments.out.as_deref().map(|path| SceneFile::new(path, arguments.force));
    let file = file.transpose()?;
    let word = || operand.word.clone();
    let linear = operand.linear()?.ok_or_else(|| StudyError::MovingMasses { word: word() })?;
    let target =
        Target::named(&arguments.to).ok_or_else(|| CliError::unknown_kind(&arguments.to, []))?;
    let tree = converted(&linear, &target).map_err(|reason| CliError::Unfit {
        word: word(),
        form: target.word,
        reason,
    })?;
    let model = model_of(&tree);
    let error = round_trip(&compare(&linear, &linear_model(&model)));
    let set = &arguments.values.set;
    let with: Vec<String> = set.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let with = if with.is_empty() { String::new() } else { format!(" with {}", with.join(", ")) };
    let comment = format!(
        "converted to {} from {}{with}; {}",
        target.word,
        operand.word,
        round_trip_note(error)
    );
    let (text, section, name) = match &operand.subject {
        Subject::Model(named) => {
            let text = with_model(operand.input.text()?, named, &model, &comment);
            let text = text.ok_or_else(|| CliError::NotReplaced { word: word() })?;
            (text, named.section, named.name.as_str())
        }
        Subject::Response(_) => {
            (write_model_table(RESPONSE, &model, &[comment]), "models", RESPONSE)
        }
    };
    confirm(&operand, &text, &format!("{section}.{name}"), &model, set)?;
    match file {
        Some(file) => {
            file.write(&SceneText { text: &text, file: &operand.input.file, set })?;
            let path = file.path.display();
            print(&format!("wrote {path}; its model is `{path}:{name}`\n"))?;
        }
        None => print_data(&text)?,
    }
    note(&round_trip_note(error));
    if !with.is_empty() {
        note(&format!("the model is converted{with}; the table [values] is as it was"));
    }
    Ok(Status::Done)
}

/// The largest relative difference of a constant that rounding to doubles left.
fn round_trip(comparison: &Equivalence) -> f64 {
    let forms = comparison.maxwell.iter().chain(&comparison.kelvin);
    forms.map(|form| form.largest).fold(0.0, f64::max)
}

fn round_trip_note(error: f64) -> String {
    if error == 0.0 {
        "round trip: the same in every rate and residue, to the last digit".to_owned()
    } else {
        format!("round trip: the same within {} in every rate and residue", bound(error))
    }
}

/// Reads the text as `run` would, and makes sure that it says what was meant.
fn confirm(
    operand: &Operand,
    text: &str,
    name: &str,
    model: &Model,
    set: &[(String, String)],
) -> Result<(), CliError> {
    let again = read_named_model(text, name, &operand.input.options(set));
    let again = again.map_err(StudyError::Scene)?.value.model;
    let is_same = compare(&linear_model(&again), &linear_model(model)).is_same;
    if is_same { Ok(()) } else { Err(CliError::NotReplaced { word: operand.word.clone() }) }
}
