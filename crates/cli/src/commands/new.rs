//! `dashpot new`.

use std::{
    fs::OpenOptions,
    io::{ErrorKind, Write},
};

use dashpot_scene::template;

use crate::{
    args::NewArguments,
    error::{CliError, Status},
    folder::unwritable,
    terminal::print,
};

/// Prints a commented scene, or writes it to a file that is not there yet.
pub(crate) fn new(arguments: &NewArguments) -> Result<Status, CliError> {
    let text = template(&arguments.template).unwrap_or_default();
    let Some(path) = &arguments.out else {
        print(text)?;
        return Ok(Status::Done);
    };
    let mut options = OpenOptions::new();
    if arguments.force {
        options.create(true).truncate(true);
    } else {
        options.create_new(true);
    }
    match options.write(true).open(path).and_then(|mut file| file.write_all(text.as_bytes())) {
        Ok(()) => {
            let path = path.display();
            print(&format!("wrote {path}; solve it with `dashpot run {path}`\n"))?;
            Ok(Status::Done)
        }
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            Err(CliError::Foreign { path: path.clone(), help: "`--force` overwrites it" })
        }
        Err(error) => Err(unwritable(path)(error)),
    }
}
