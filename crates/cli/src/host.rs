//! The command called by a program in place of a shell: what it reads and says stays in memory.

use std::{
    cell::RefCell, collections::HashMap, env, ffi::OsString, iter::once, mem::replace,
    ops::ControlFlow, path::Path,
};

use clap::Parser;
use dashpot_analysis::RunError;
use dashpot_scene::{Diagnostic, Diagnostics, ReadOptions, Scene, Severity, read};

use crate::{
    args,
    error::{CliError, Status},
    input::{Input, load},
    terminal::Terminal,
    verbs::Arguments,
};

thread_local! {
    /// What calls the command on this thread, and what was said so far.
    static HOSTED: RefCell<Option<Hosted>> = const { RefCell::new(None) };
}

/// Is told which share of long work is done, 0 … 1; `Break` ends it.
pub type Watch = Box<dyn FnMut(f64) -> ControlFlow<()>>;

/// What calls the command.
pub struct Host {
    /// Texts by the names under which the arguments speak of them, before any file.
    pub texts: HashMap<String, String>,
    /// How far long work has come.
    pub watch: Watch,
}

/// What became of a call.
#[derive(Debug, Clone, Default)]
pub struct Called {
    /// The exit code of the command.
    pub status: u8,
    /// What it would have printed.
    pub output: String,
    /// What it said besides, in order.
    pub said: Vec<Said>,
}

/// What the command says beside its results.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Said {
    /// How bad it is.
    pub tone: Tone,
    /// What it is, in one sentence.
    pub message: String,
    /// What to do.
    pub help: Option<String>,
    /// The text that it is about.
    pub file: Option<String>,
    /// Line and column there, both from 1.
    pub place: Option<(usize, usize)>,
}

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// It is not done, or not all of it.
    Error,
    /// The reader must know it.
    Warning,
    /// It may be of interest.
    Note,
}

impl From<&Diagnostic> for Said {
    fn from(own: &Diagnostic) -> Self {
        Self {
            tone: if own.severity == Severity::Error { Tone::Error } else { Tone::Warning },
            message: own.message(),
            help: own.help(),
            file: own.file().map(str::to_owned),
            place: own.line_and_column(),
        }
    }
}

impl Said {
    fn all(error: &CliError) -> Vec<Self> {
        match error {
            CliError::Scene(diagnostics) => diagnostics.list.iter().map(Self::from).collect(),
            error => vec![Self {
                tone: Tone::Error,
                message: error.to_string(),
                help: error.help(),
                file: None,
                place: None,
            }],
        }
    }
}

/// Why a run failed, and the exit code of that.
pub fn failed(error: RunError) -> (u8, Vec<Said>) {
    let error = CliError::Run(error);
    (error.status() as u8, Said::all(&error))
}

/// The name of the file and the text of a scene: a file, or a built-in scene.
///
/// # Errors
///
/// What cannot be read, and why.
pub fn open(path: &Path) -> Result<(String, String), Vec<Said>> {
    let input = Input::read(path).map_err(|error| Said::all(&error))?;
    let text = input.text().map_err(|error| Said::all(&error))?.to_owned();
    Ok((input.file, text))
}

/// The scene of a text with the values `set` in place of its own, as the command reads it; and what is odd about it.
///
/// # Errors
///
/// All faults of the text, each with its place.
pub fn read_scene(
    text: &str,
    file: Option<&str>,
    set: &[(String, String)],
) -> Result<(Scene, Vec<Said>), Vec<Said>> {
    let all = |found: Diagnostics| found.list.iter().map(Said::from).collect();
    let read = read(text, &ReadOptions { file, set, loader: Some(&load) }).map_err(all)?;
    Ok((read.value, all(read.warnings)))
}

struct Hosted {
    host: Host,
    /// What it called with, from the verb on.
    arguments: Vec<OsString>,
    called: Called,
}

/// Does what the arguments say, which begin with the verb, as the command does it, with the same results.
///
/// # Examples
///
/// ```
/// use std::{collections::HashMap, ops::ControlFlow};
///
/// use dashpot_cli::{Host, call};
///
/// let host = Host { texts: HashMap::new(), watch: Box::new(|_| ControlFlow::Continue(())) };
/// let called = call(["list".into(), "methods".into()], host);
/// assert_eq!((called.status, called.output.contains("exact")), (0, true));
/// ```
pub fn call(arguments: impl IntoIterator<Item = OsString>, host: Host) -> Called {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let words: Vec<OsString> = once("dashpot".into()).chain(arguments.iter().cloned()).collect();
    // A call from within a call ends before that goes on.
    let _outer = Outer(HOSTED.replace(Some(Hosted { host, arguments, called: Called::default() })));
    let status = match Arguments::try_parse_from(words) {
        Ok(arguments) => {
            let terminal = Terminal::unattended();
            arguments.command.run(terminal).unwrap_or_else(|error| {
                terminal.error(&error);
                error.status()
            })
        }
        Err(message) => {
            let text = args::explained(message).to_string();
            said(Tone::Error, text.trim_start_matches("error: ").trim_end(), None);
            Status::InputWrong
        }
    };
    let called = HOSTED.take().map(|own| own.called).unwrap_or_default();
    Called { status: status as u8, ..called }
}

/// The call that another one has come into; it goes on however that ends.
struct Outer(Option<Hosted>);

impl Drop for Outer {
    fn drop(&mut self) {
        HOSTED.set(self.0.take());
    }
}

/// The arguments of the command, from the verb on.
pub(crate) fn arguments() -> Vec<OsString> {
    let own = HOSTED.with_borrow(|own| own.as_ref().map(|own| own.arguments.clone()));
    own.unwrap_or_else(|| env::args_os().skip(1).collect())
}

/// Whether a program calls.
pub(crate) fn is_called() -> bool {
    HOSTED.with_borrow(Option::is_some)
}

/// The text that stands for a file of this name.
pub(crate) fn text(name: &str) -> Option<String> {
    HOSTED.with_borrow(|own| own.as_ref()?.host.texts.get(name).cloned())
}

/// Keeps what is printed, where a program calls.
pub(crate) fn printed(text: &str) -> bool {
    told(|called| called.output.push_str(text))
}

/// Keeps what is said, where a program calls.
pub(crate) fn said(tone: Tone, message: &str, help: Option<String>) -> bool {
    let message = message.to_owned();
    told(|called| called.said.push(Said { tone, message, help, file: None, place: None }))
}

/// Keeps what is said of a text, where a program calls.
pub(crate) fn diagnosed(diagnostics: &Diagnostics) -> bool {
    let all = diagnostics.list.iter().map(Said::from);
    told(|called| called.said.extend(all))
}

fn told(tell: impl FnOnce(&mut Called)) -> bool {
    HOSTED.with_borrow_mut(|own| own.as_mut().map(|own| tell(&mut own.called)).is_some())
}

/// What a program that calls says to the share that is done; `None` where none does.
pub(crate) fn progress(share: f64) -> Option<ControlFlow<()>> {
    let silent: Watch = Box::new(|_| ControlFlow::Continue(()));
    let place =
        |watch| HOSTED.with_borrow_mut(|own| Some(replace(&mut own.as_mut()?.host.watch, watch)));
    // It may call in turn, so nothing is borrowed meanwhile.
    let mut watch = place(silent)?;
    let answer = watch(share);
    place(watch);
    Some(answer)
}
