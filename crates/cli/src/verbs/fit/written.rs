//! The fitted model as a scene: in the text of one, or as a table of its own.

use dashpot_fit::linear::{Form, LinearFit, Spectrum};
use dashpot_network::{Model, model_of};
use dashpot_rheology::Canonical;
use dashpot_scene::{
    ReadOptions, read_named_model, with_model, write_material_table, write_model_table,
};

use crate::input::AsCommanded as _;
use crate::{
    error::{CliError, StudyError},
    input::Input,
};

/// Digits of fitted constants.
const DIGITS: usize = 6;

/// The model of a fit, its constants with so many digits as make sense.
pub(super) fn model(fit: &LinearFit) -> Option<Model> {
    let rounded = |own: f64| format!("{own:.*e}", DIGITS - 1).parse().unwrap_or(own);
    let branches = fit.spectrum.branches.iter().map(|own| (rounded(own.0), rounded(own.1)));
    let spectrum = Spectrum {
        spring: rounded(fit.spectrum.spring),
        dashpot: rounded(fit.spectrum.dashpot),
        branches: branches.collect(),
    };
    let canonical = match fit.form {
        Form::Maxwell => Canonical::Maxwell,
        Form::Kelvin => Canonical::Kelvin,
    };
    spectrum.model(fit.form).tree(canonical).map(|tree| model_of(&tree))
}

/// The text of a scene with the model in the place of its own of this name, or behind it; without a scene the
/// model alone.
pub(super) fn text(
    scene: Option<(&Input, &[(String, String)])>,
    (name, is_material): (&str, bool),
    model: &Model,
    comments: &[String],
) -> Result<String, CliError> {
    let write = if is_material { write_material_table } else { write_model_table };
    let Some((input, set)) = scene else { return Ok(write(name, model, comments)) };
    let text = input.text()?;
    let options = input.options(set);
    let section = if is_material { "materials" } else { "models" };
    let known = read_named_model(text, name, &options).ok();
    let Some(known) = known.map(|own| own.value) else {
        let text = format!("{}\n\n{}", text.trim_end(), write(name, model, comments));
        return confirmed(text, &format!("{section}.{name}"), &options);
    };
    if known.is_material != is_material {
        return Err(StudyError::MaterialAndPad.into());
    }
    let comment = comments.join("; ");
    let replaced = with_model(text, &known, model, &comment);
    let text = replaced.ok_or_else(|| CliError::NotReplaced { word: name.to_owned() })?;
    confirmed(text, &format!("{}.{}", known.section, known.name), &options)
}

/// The text, if it can be read.
fn confirmed(text: String, name: &str, options: &ReadOptions<'_>) -> Result<String, CliError> {
    read_named_model(&text, name, options).map_err(StudyError::Scene)?;
    Ok(text)
}
