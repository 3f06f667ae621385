//! `dashpot new`.

use dashpot_scene::template;

use crate::{
    args::NewArguments,
    error::{CliError, Status},
    folder::write_new,
    terminal::print,
};

/// Prints a commented scene, or writes it to a file that is not there yet.
pub(crate) fn new(arguments: &NewArguments) -> Result<Status, CliError> {
    let text = template(&arguments.template).unwrap_or_default();
    match &arguments.out {
        None => print(text)?,
        Some(path) => {
            write_new(path, text, arguments.force)?;
            let path = path.display();
            print(&format!("wrote {path}; solve it with `dashpot run {path}`\n"))?;
        }
    }
    Ok(Status::Done)
}
