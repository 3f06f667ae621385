//! `dashpot new`, `schema`, `man` and `completions`: texts that are there already.

use std::{
    fs,
    path::{Path, PathBuf},
};

use clap::{
    Args, CommandFactory,
    builder::{PossibleValue, PossibleValuesParser},
};
use clap_complete::{Shell, generate};
use clap_mangen::Man;
use dashpot_scene::{Shipped, template, templates};

use super::Arguments;
use crate::{
    error::{CliError, Status, unwritable},
    part::write_text,
    terminal::{print, print_data},
};

/// `new`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot new > pad.toml\n  \
    dashpot new chain --out chain.toml")]
pub(crate) struct NewArguments {
    /// What to start from.
    #[arg(default_value = "impact", value_parser = template_names())]
    template: String,
    /// File to write; without it the text is printed.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Overwrites the file if there is one.
    #[arg(long, requires = "out")]
    force: bool,
}

fn template_names() -> PossibleValuesParser {
    let value = |shipped: &Shipped| PossibleValue::new(shipped.name).help(shipped.summary);
    PossibleValuesParser::new(templates().iter().map(value))
}

/// Prints the completions for a shell.
pub(crate) fn completions(shell: Shell) -> Result<Status, CliError> {
    let mut text = Vec::new();
    generate(shell, &mut Arguments::command(), "dashpot", &mut text);
    print_data(&String::from_utf8_lossy(&text))?;
    Ok(Status::Done)
}

/// Prints the manual page of the command, or writes those of all verbs to a folder.
pub(crate) fn man(out: Option<&Path>) -> Result<Status, CliError> {
    let mut command = Arguments::command().disable_help_subcommand(true);
    command.build();
    let Some(folder) = out else {
        print_data(&page(&Man::new(command))?)?;
        return Ok(Status::Done);
    };
    fs::create_dir_all(folder).map_err(unwritable(folder))?;
    for verb in command.get_subcommands() {
        let path = folder.join(format!("dashpot-{}.1", verb.get_name()));
        write_text(&path, &page(&Man::new(verb.clone()))?, true)?;
    }
    let count = command.get_subcommands().count() + 1;
    write_text(&folder.join("dashpot.1"), &page(&Man::new(command))?, true)?;
    print(&format!("wrote {count} manual pages to {}\n", folder.display()))?;
    Ok(Status::Done)
}

fn page(man: &Man) -> Result<String, CliError> {
    let mut text = Vec::new();
    man.render(&mut text).map_err(CliError::Output)?;
    Ok(String::from_utf8_lossy(&text).into_owned())
}

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

/// Prints the JSON schema of scenes.
pub(crate) fn schema() -> Result<Status, CliError> {
    let text = serde_json::to_string_pretty(&dashpot_scene::schema())?;
    print_data(&(text + "\n"))?;
    Ok(Status::Done)
}
