//! The command called by a program in place of a shell: what it reads and says stays in memory.

use std::{
    cell::RefCell, collections::HashMap, env, ffi::OsString, iter::once, ops::ControlFlow,
    path::Path, sync::Arc,
};

use dashpot_network::NetworkWarning;
use dashpot_scene::{Diagnostic, Diagnostics, Scene, Severity, read};

use crate::{
    args,
    error::{CliError, Status, StudyError},
    input::options,
    terminal::Terminal,
    verbs::undefined,
};

thread_local! {
    /// What calls the command on this thread, and what was said so far.
    static HOSTED: RefCell<Option<Hosted>> = const { RefCell::new(None) };
}

/// The code of a measure that can have no value.
const UNDEFINED: &str = "undefined-measure";
/// What is said of work that a program ended.
pub(crate) const ENDED: &str = "it was asked to end";

/// Is told by any thread which share of long work is done, 0 … 1; `Break` ends it.
pub type Watch = Arc<dyn Fn(f64) -> ControlFlow<()> + Send + Sync>;

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
    /// What kind of thing it is, in one word that stays the same, where it has one.
    pub code: Option<&'static str>,
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
            code: None,
            message: own.message(),
            help: own.help(),
            file: own.file().map(str::to_owned),
            place: own.line_and_column(),
        }
    }
}

impl Said {
    /// What an error says.
    pub(crate) fn all(error: &CliError) -> Vec<Self> {
        match error {
            CliError::Study(StudyError::Scene(diagnostics)) => {
                diagnostics.list.iter().map(Self::from).collect()
            }
            error => {
                let help = error.help();
                vec![Self { help, ..Self::plain(Tone::Error, error.to_string()) }]
            }
        }
    }

    /// A sentence about no place.
    pub fn plain(tone: Tone, message: String) -> Self {
        Self { tone, code: None, message, help: None, file: None, place: None }
    }
}

/// The name of the file and the text of a scene: a file, or a built-in scene.
///
/// # Errors
///
/// What cannot be read, and why.
pub fn open(path: &Path) -> Result<(String, String), Vec<Said>> {
    let input = crate::input::read_input(path).map_err(|error| Said::all(&error.into()))?;
    let text = input.text().map_err(|error| Said::all(&error.into()))?.to_owned();
    Ok((input.file, text))
}

/// The scene of a text with the values `set` in place of its own, as the command reads it; and what is to be said about
/// it: what is odd about its text, measures that can have no value, and notes on its models.
///
/// # Errors
///
/// All faults of the text, each with its place.
pub fn read_scene(
    text: &str,
    file: Option<&str>,
    set: &[(String, String)],
) -> Result<(Scene, Vec<Said>), Vec<Said>> {
    let all = |found: Diagnostics| -> Vec<Said> { found.list.iter().map(Said::from).collect() };
    let read = read(text, &options(file, set)).map_err(all)?;
    let (scene, mut said) = (read.value, all(read.warnings));
    for own in &mut said {
        let known = scene.assembly.warnings.iter().find(|known| known.to_string() == own.message);
        own.code = known.map(NetworkWarning::code);
    }
    let undefined = undefined(&scene).unwrap_or_default().into_iter();
    let code = Some(UNDEFINED);
    said.extend(undefined.map(|own| Said { code, ..Said::plain(Tone::Warning, own) }));
    said.extend(scene.notes.iter().map(|own| {
        let (code, text) = (Some(own.what.code()), format!("{}: {}", own.subject, own.what));
        Said { code, ..Said::plain(Tone::Note, text) }
    }));
    Ok((scene, said))
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
/// use std::{collections::HashMap, ops::ControlFlow, sync::Arc};
///
/// use dashpot_cli::{Host, call};
///
/// let host = Host { texts: HashMap::new(), watch: Arc::new(|_| ControlFlow::Continue(())) };
/// let called = call(["list".into(), "methods".into()], host);
/// assert_eq!((called.status, called.output.contains("exact")), (0, true));
/// ```
pub fn call(arguments: impl IntoIterator<Item = OsString>, host: Host) -> Called {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let words: Vec<OsString> = once("dashpot".into()).chain(arguments.iter().cloned()).collect();
    // A call from within a call ends before that goes on.
    let _outer = Outer(HOSTED.replace(Some(Hosted { host, arguments, called: Called::default() })));
    let status = match args::parsed(words) {
        Ok(arguments) => {
            let terminal = Terminal::unattended();
            arguments.command.run(terminal).unwrap_or_else(|error| {
                terminal.error(&error);
                error.status()
            })
        }
        Err(message) => {
            let (message, help) = args::sentences(&args::explained(message));
            said(Tone::Error, &message, help);
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
    let own = Said { help, ..Said::plain(tone, message.to_owned()) };
    told(|called| called.said.push(own))
}

/// Keeps what is said of a text, where a program calls.
pub(crate) fn diagnosed(diagnostics: &Diagnostics) -> bool {
    let all = diagnostics.list.iter().map(Said::from);
    told(|called| called.said.extend(all))
}

fn told(tell: impl FnOnce(&mut Called)) -> bool {
    HOSTED.with_borrow_mut(|own| own.as_mut().map(|own| tell(&mut own.called)).is_some())
}

/// What watches the work of this thread, where a program calls.
pub(crate) fn watch() -> Option<Watch> {
    HOSTED.with_borrow(|own| own.as_ref().map(|own| Arc::clone(&own.host.watch)))
}

/// What a program that calls says to the share that is done; `None` where none does.
pub(crate) fn progress(share: f64) -> Option<ControlFlow<()>> {
    // It may call in turn, so nothing is borrowed meanwhile.
    watch().map(|watch| watch(share))
}

/// Whether a program that calls has ended the work.
pub(crate) fn has_ended() -> bool {
    progress(0.0).is_some_and(|own| own.is_break())
}
