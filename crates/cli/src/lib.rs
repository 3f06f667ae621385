//! The command `dashpot`: arguments, files and the terminal. It reads, calls the other crates, and
//! shows what they return; it computes nothing itself.
//!
//! Results go to standard output, progress and warnings to standard error.

mod args;
mod commands;
mod error;
mod folder;
mod input;
mod non_identifiable;
mod numbers;
mod operand;
mod output;
mod part;
mod progress;
mod sketch;
mod studies;
mod terminal;
mod text;

use std::{io::ErrorKind, process::ExitCode};

use clap::Parser;

use args::{Arguments, Command};
use error::{CliError, Status};
use terminal::Terminal;

/// Does what the command line says. The exit code is 0 when it is done (warnings included), 1 when
/// a run failed, 2 when the input is wrong, and 3 when two models are not the same, or two scenes not
/// similar.
pub fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(message) => {
            let message = args::explained(message);
            return print_usage(&message).into();
        }
    };
    let terminal = Terminal::new(arguments.color);
    let result = match arguments.command {
        Command::Run(arguments) => studies::run(&arguments, terminal),
        Command::Check(arguments) => commands::check(&arguments, terminal),
        Command::Explain(arguments) => commands::explain(&arguments, terminal),
        Command::Convert(arguments) => commands::convert(&arguments, terminal),
        Command::Compare(arguments) => studies::compare(&arguments, terminal),
        Command::Rheometer(arguments) => studies::rheometer(&arguments, terminal),
        Command::Cost(arguments) => studies::cost(&arguments, terminal),
        Command::Sweep(arguments) => studies::sweep(&arguments, terminal),
        Command::Vibrate(arguments) => studies::vibrate(&arguments, terminal),
        Command::Groups(arguments) => studies::groups(&arguments, terminal),
        Command::Thesis(arguments) => studies::thesis(&arguments, terminal),
        Command::List(arguments) => commands::list(&arguments, terminal),
        Command::New(arguments) => commands::new(&arguments),
        Command::Schema => commands::schema(),
        Command::Man { out } => commands::man(out.as_deref()),
        Command::Completions { shell } => commands::completions(shell),
    };
    let status = result.unwrap_or_else(|error| {
        terminal.error(&error);
        error.status()
    });
    status.into()
}

/// Tells what is wrong with a command line, or the help or version that it asks for.
fn print_usage(message: &clap::Error) -> Status {
    if !message.use_stderr() {
        return match message.print() {
            // A reader that is gone is no matter.
            Err(error) if error.kind() != ErrorKind::BrokenPipe => {
                terminal::message(&format!("error: {}", CliError::Output(error)));
                Status::RunFailed
            }
            _ => Status::Done,
        };
    }
    if message.to_string().contains(dashpot_scene::is_control) {
        terminal::message(&message.to_string());
    } else {
        // There is nowhere left to complain to.
        let _ = message.print();
    }
    Status::InputWrong
}
