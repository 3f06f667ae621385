//! Scenes and models that the command line names, and what is said of them.

use std::{
    collections::HashMap,
    ffi::OsStr,
    ops::ControlFlow,
    path::{Path, PathBuf},
};

use dashpot_scene::{
    BareNumbers, Checked, Diagnostics, ModelNote, NamedModel, Scene, read, read_models, read_shared,
};
use dashpot_studies::{Context, Progress, Remark};

use crate::{
    error::reason,
    error::{CliError, StudyError},
    folder::Folder,
    input::{self, AsCommanded as _, Input, bare_numbers, bytes_of, folder, load},
    output::PAGE,
    progress::Bar,
    terminal::{Terminal, note},
};

/// What surrounds a study of the command: files, and the terminal that is told of progress and remarks.
pub(crate) struct Surroundings {
    terminal: Terminal,
    bar: Bar,
    /// The folder that is asked for.
    pub(crate) out: Option<PathBuf>,
    /// What became of it.
    opened: Option<Result<Folder, CliError>>,
    /// Paths that are no texts, by those that stand for them.
    paths: HashMap<String, PathBuf>,
}

impl Surroundings {
    pub(crate) fn of(verb: &str, terminal: Terminal) -> Self {
        let bar = Bar::new(verb, 0.0, terminal.error.attended);
        Self { terminal, bar, out: None, opened: None, paths: HashMap::new() }
    }

    /// A text that stands for an operand.
    pub(crate) fn name(&mut self, operand: &OsStr) -> String {
        let name = operand.to_string_lossy().into_owned();
        if operand.to_str().is_none() {
            self.paths.insert(name.clone(), PathBuf::from(operand));
        }
        name
    }

    /// The folder that was opened.
    pub(crate) fn folder(self) -> Result<Option<Folder>, CliError> {
        self.opened.transpose()
    }

    fn path<'p>(&'p self, name: &'p str) -> &'p Path {
        self.paths.get(name).map_or(Path::new(name), PathBuf::as_path)
    }
}

impl Context for Surroundings {
    fn load(&self, name: &str) -> Result<Vec<u8>, String> {
        bytes_of(self.path(name)).map_err(|error| reason(&error))
    }

    fn folder(&self, name: &str) -> Option<Result<Vec<String>, String>> {
        folder(self.path(name))
    }

    fn has(&self, name: &str) -> bool {
        self.path(name).is_file()
    }

    fn input(&self, name: &str) -> Result<Input, StudyError> {
        input::read_input(self.path(name))
    }

    fn prepare(&mut self, files: Vec<String>) -> Result<(), StudyError> {
        let names = files.into_iter().chain([PAGE.to_owned()]);
        self.opened = Folder::wanted(self.out.as_deref(), names).transpose();
        match self.opened {
            Some(Err(_)) => Err(StudyError::Ended),
            _ => Ok(()),
        }
    }

    fn bare_numbers(&self) -> BareNumbers {
        bare_numbers()
    }

    fn remark(&mut self, remark: Remark<'_>) {
        match remark {
            Remark::Odd(diagnostics) => self.terminal.diagnose(diagnostics),
            Remark::Model(note) => print_notes([note]),
            Remark::Warning(text) => self.terminal.warn(&text),
            Remark::Note(text) => note(&text),
        }
    }

    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.bar.progress_of(progress)
    }
}

/// The files of the command, for what reads them alone.
pub(crate) struct Files;

impl Context for Files {
    fn load(&self, name: &str) -> Result<Vec<u8>, String> {
        load(name)
    }

    fn has(&self, name: &str) -> bool {
        Path::new(name).is_file()
    }

    fn folder(&self, name: &str) -> Option<Result<Vec<String>, String>> {
        folder(Path::new(name))
    }
}

/// Reads a scene with the values `set` in place of its own: the built-in one, a file, or standard
/// input for `-`; shows what is odd about it.
pub(crate) fn read_scene(
    path: Option<&Path>,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Scene, CliError> {
    let mut input = input::of(path)?;
    let text = input.take_text()?;
    shown(read_shared(&text, &input.options(set)), terminal)
}

/// The same of what was read already.
pub(crate) fn read_scene_of(
    input: &Input,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Scene, CliError> {
    shown(read(input.text()?, &input.options(set)), terminal)
}

fn shown(read: Result<Checked<Scene>, Diagnostics>, terminal: Terminal) -> Result<Scene, CliError> {
    let checked = read.map_err(StudyError::Scene)?;
    terminal.diagnose(&checked.warnings);
    Ok(checked.value)
}

/// The models of a file that has them and no scene, by what they are; `None` for a scene.
pub(crate) fn read_models_of(
    input: &Input,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Option<String>, CliError> {
    let Some(found) = read_models(input.text()?, &input.options(set)) else { return Ok(None) };
    let found = found.map_err(StudyError::Scene)?;
    terminal.diagnose(&found.warnings);
    let name = |own: &NamedModel| {
        format!("{} `{}`", if own.is_material { "material" } else { "model" }, own.name)
    };
    let names = found.value.iter().map(name).collect::<Vec<_>>().join(", ");
    let first = found.value.into_iter().next().map(|own| own.name).unwrap_or_default();
    Ok(Some(format!("{names}, and no scene: others name them as `{}:{first}`", input.file)))
}

/// Says which numbers of a scene have scatter, where that is not looked at.
pub(crate) fn note_means(scene: &Scene, terminal: Terminal) {
    dashpot_studies::operand::remark_means(scene, &mut Surroundings::of("", terminal));
}

/// Says what there is to say about models.
pub(crate) fn print_notes<'n>(notes: impl IntoIterator<Item = &'n ModelNote>) {
    for ModelNote { subject, what, .. } in notes {
        note(&format!("{subject}: {what}"));
    }
}
