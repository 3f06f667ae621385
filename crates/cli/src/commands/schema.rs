//! `dashpot schema`.

use crate::{
    error::{CliError, Status},
    terminal::print_data,
};

/// Prints the JSON schema of scenes.
pub(crate) fn schema() -> Result<Status, CliError> {
    let text = serde_json::to_string_pretty(&dashpot_scene::schema())?;
    print_data(&(text + "\n"))?;
    Ok(Status::Done)
}
