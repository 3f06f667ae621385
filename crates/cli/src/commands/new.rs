//! `dashpot new`.

use dashpot_scene::template;

use crate::{
    args::NewArguments,
    error::{CliError, Status},
    part::write_text,
    terminal::{print, print_data},
};

/// Prints a commented scene, or writes it to a file that is not there yet.
pub(crate) fn new(arguments: &NewArguments) -> Result<Status, CliError> {
    let text = template(&arguments.template).unwrap_or_default();
    match &arguments.out {
        None => print_data(text)?,
        Some(path) => {
            write_text(path, text, arguments.force)?;
            let path = path.display();
            print(&format!("wrote {path}; solve it with `dashpot run {path}`\n"))?;
        }
    }
    Ok(Status::Done)
}
