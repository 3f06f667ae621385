//! The command `dashpot`: arguments, files and the terminal. It reads, calls the other crates, and
//! shows what they return; it computes nothing itself.
//!
//! Results go to standard output, progress and warnings to standard error.

mod args;
mod around;
mod cancel;
mod counts;
mod error;
mod folder;
mod host;
mod input;
mod operand;
mod options;
mod out;
mod output;
mod part;
mod progress;
mod said;
mod section;
mod terminal;
mod unevaluated;
mod varied;
mod verbs;

use std::{io::ErrorKind, process::ExitCode};

use dashpot_report::layout as text;

pub use dashpot_studies::sketch::drawing;
pub use host::{Called, Host, Said, Tone, Watch, call, open, read_scene};
pub use input::{folder, load, read_input};
pub use options::{VerbOption, options};
pub use verbs::run::{RunOptions, ScatterArguments, SceneRun};

use error::{CliError, Status};
use terminal::Terminal;

/// Does what the command line says. The exit code is 0 when it is done (warnings included), 1 when
/// a run failed, 2 when the input is wrong, 3 when two models are not the same, or two scenes not similar, and 4 when
/// a limit that is enforced is not kept.
pub fn main() -> ExitCode {
    let arguments = match args::parsed(std::env::args_os()) {
        Ok(arguments) => arguments,
        Err(message) => {
            let message = args::explained(message);
            return print_usage(&message).into();
        }
    };
    cancel::watch_interrupts();
    let terminal = Terminal::new(arguments.color);
    if arguments.strict {
        input::refuse_bare_numbers();
    }
    let status = arguments.command.run(terminal).unwrap_or_else(|error| {
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
    let plain = message.to_string();
    let is_wide = plain.lines().any(|line| text::columns(line) > terminal::WIDTH);
    if is_wide || plain.contains(dashpot_scene::is_control) {
        let lines: Vec<String> = plain.trim_end().lines().map(text::indented_line).collect();
        terminal::message(&lines.join("\n"));
    } else {
        // There is nowhere left to complain to.
        let _ = message.print();
    }
    Status::InputWrong
}
