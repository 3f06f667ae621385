//! What surrounds a study: files, and whoever listens.

use std::{borrow::Cow, ops::ControlFlow, path::Path, sync::Arc};

use dashpot_dae::Observer;
use dashpot_scene::{
    BareNumbers, Diagnostics, ModelNote, ReadOptions, Scene, read, references, table_text,
    text_of_bytes,
};

use crate::StudyError;

/// Endings of tables, and what is said of one in the place of a scene.
const TABLES: [&str; 4] = ["csv", "tsv", "dat", "xlsx"];
const NO_SCENE: &str = "it is a table, and a scene or model (TOML) is wanted here; options name tables, as \
                        `--to \"drop.csv:force=pad.force\"` of `fit` or `--measured drop.csv` of `run`, and \
                        `dashpot signal` reads one alone";

/// What surrounds a study: the files that requests and scenes name, and whoever is told of progress and remarks. `()` has
/// the built-in scenes alone, and listens to nothing.
pub trait Context {
    /// The bytes of a file.
    ///
    /// # Errors
    ///
    /// Why it cannot be read.
    fn load(&self, name: &str) -> Result<Vec<u8>, String>;

    /// Whether there is a file of this name.
    fn has(&self, name: &str) -> bool;

    /// The paths of what is in a folder; `None` where there is no folder of this name.
    fn folder(&self, _name: &str) -> Option<Result<Vec<String>, String>> {
        None
    }

    /// The text of a scene or model that a request names.
    ///
    /// # Errors
    ///
    /// [`StudyError::Unreadable`].
    fn input(&self, name: &str) -> Result<Input, StudyError> {
        match references().iter().find(|shipped| shipped.name == name && !self.has(name)) {
            Some(shipped) => {
                Ok(Input::new(format!("{name}.toml"), shipped.text.as_bytes().to_vec()))
            }
            None => match self.load(name) {
                Ok(bytes) => Ok(Input::new(name, bytes)),
                Err(reason) => {
                    Err(StudyError::Unreadable { name: name.to_owned(), reason, similar: None })
                }
            },
        }
    }

    /// What becomes of numbers without a unit in texts.
    fn bare_numbers(&self) -> BareNumbers {
        BareNumbers::Silent
    }

    /// Is told what is to be known beside the result.
    fn remark(&mut self, _remark: Remark<'_>) {}

    /// Is told, before the work, which files the answer may be written to, but for the page and the object. An error ends
    /// the work.
    ///
    /// # Errors
    ///
    /// Why they cannot be written.
    fn prepare(&mut self, _files: Vec<String>) -> Result<(), StudyError> {
        Ok(())
    }

    /// Is told how far the work has come; `Break` ends it.
    fn progress(&mut self, _progress: Progress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl Context for () {
    fn load(&self, _name: &str) -> Result<Vec<u8>, String> {
        Err("there are no files".to_owned())
    }

    fn has(&self, _name: &str) -> bool {
        false
    }
}

/// How far long work has come.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Progress {
    /// So many of so many are done.
    Count {
        /// Those that are done.
        done: usize,
        /// All.
        of: usize,
    },
    /// A solution is on its way; errors are estimated from further ones, each of which begins anew.
    Solution {
        /// The time that it has reached \[s\].
        time: f64,
        /// Its end \[s\].
        end: f64,
        /// Steps so far.
        steps: usize,
    },
}

impl Progress {
    /// The part that is done, from 0 to 1.
    pub fn share(&self) -> f64 {
        let share = match *self {
            Self::Count { done, of } => done as f64 / of as f64,
            Self::Solution { time, end, .. } => time / end,
        };
        share.clamp(0.0, 1.0)
    }
}

/// Tells a context of the progress of solutions until `end` \[s\].
pub(crate) struct Solving<'c> {
    pub(crate) context: &'c mut dyn Context,
    pub(crate) end: f64,
}

impl Observer for Solving<'_> {
    fn progress(&mut self, progress: dashpot_dae::Progress) -> ControlFlow<()> {
        let (time, steps, end) = (progress.time, progress.steps, self.end);
        self.context.progress(Progress::Solution { time, end, steps })
    }
}

/// What is to be known beside a result.
#[derive(Debug)]
pub enum Remark<'r> {
    /// What is odd about a text, with its places.
    Odd(&'r Diagnostics),
    /// What may be of interest about a model.
    Model(&'r ModelNote),
    /// What the reader must know.
    Warning(String),
    /// What may be of interest.
    Note(String),
}

/// A text and the file that it is from, as far as messages are concerned.
#[derive(Debug, Clone)]
pub struct Input {
    /// Name of the file.
    pub file: String,
    bytes: Vec<u8>,
}

impl Input {
    /// These bytes of a file.
    pub fn new(file: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { file: file.into(), bytes }
    }

    /// The text of a scene or model.
    ///
    /// # Errors
    ///
    /// That it is a table, or no text.
    pub fn text(&self) -> Result<&str, StudyError> {
        let ending = Path::new(&self.file).extension().and_then(|ending| ending.to_str());
        if ending.is_some_and(|ending| TABLES.contains(&&*ending.to_lowercase())) {
            let (name, reason) = (self.file.clone(), NO_SCENE.to_owned());
            return Err(StudyError::Unreadable { name, reason, similar: None });
        }
        text_of_bytes(&self.bytes, Some(&self.file)).map_err(StudyError::Scene)
    }

    /// The same, of which nothing is kept here.
    ///
    /// # Errors
    ///
    /// As those of [`text`](Self::text).
    pub fn take_text(&mut self) -> Result<Arc<str>, StudyError> {
        let text: Arc<str> = self.text()?.into();
        self.bytes = Vec::new();
        Ok(text)
    }

    /// The text of a file of numbers, whichever its encoding is.
    pub fn table_text(&self) -> Cow<'_, str> {
        table_text(&self.bytes)
    }

    /// The scene, with the values `set` in place of its own.
    ///
    /// # Errors
    ///
    /// All faults of its text.
    pub fn scene(
        &self,
        set: &[(String, String)],
        context: &mut dyn Context,
    ) -> Result<Scene, StudyError> {
        let checked = self.with(set, context, read)?;
        context.remark(Remark::Odd(&checked.warnings));
        Ok(checked.value)
    }

    /// What is read from the text with the values `set`.
    pub(crate) fn with<T>(
        &self,
        set: &[(String, String)],
        context: &dyn Context,
        read: impl FnOnce(&str, &ReadOptions<'_>) -> Result<T, Diagnostics>,
    ) -> Result<T, StudyError> {
        let load = |name: &str| context.load(name);
        let options = ReadOptions {
            file: Some(&self.file),
            set,
            loader: Some(&load),
            bare: context.bare_numbers(),
        };
        read(self.text()?, &options).map_err(StudyError::Scene)
    }
}

/// The scene's title, or the name of its file.
pub fn title(scene: &Scene) -> &str {
    scene.title.as_deref().or(scene.file.as_deref()).unwrap_or("a scene without title")
}
