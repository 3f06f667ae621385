//! `dashpot completions`.

use clap::CommandFactory;
use clap_complete::{Shell, generate};

use crate::{
    args::Arguments,
    error::{CliError, Status},
    terminal::print_data,
};

/// Prints the completions for a shell.
pub(crate) fn completions(shell: Shell) -> Result<Status, CliError> {
    let mut text = Vec::new();
    generate(shell, &mut Arguments::command(), "dashpot", &mut text);
    print_data(&String::from_utf8_lossy(&text))?;
    Ok(Status::Done)
}
