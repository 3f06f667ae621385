//! Results, each stated once.

use serde::Serialize;

use super::Text;
use crate::{
    error::CliError,
    folder::{Folder, Staged},
    terminal::{Terminal, print, print_data, remark},
};

/// What a verb has found.
pub(crate) trait Study {
    /// Says it to people.
    fn text(&self, text: &mut Text);

    /// The object for programs: what `--json` prints, and what a folder holds as its result.
    fn object(&self) -> impl Serialize;

    /// A table for programs that is printed where no folder is asked for, in place of the text.
    fn data(&self) -> Option<String> {
        None
    }

    /// What is said on standard error where no text is printed, which says it as well.
    fn remarks(&self) -> Vec<String> {
        Vec::new()
    }

    /// Adds what a folder holds besides: tables, figures, a page.
    fn files(&self, _files: &mut Staged<'_>) -> Result<(), CliError> {
        Ok(())
    }
}

/// Prints a study, as one JSON object or as text, and writes it into the folder, where there is one.
pub(crate) fn emit(
    study: &impl Study,
    json: bool,
    folder: Option<Folder>,
    terminal: Terminal,
) -> Result<(), CliError> {
    let object = || Ok::<_, CliError>(serde_json::to_string_pretty(&study.object())? + "\n");
    let data = || study.data().filter(|_| folder.is_none());
    match if json { Some(object()?) } else { data() } {
        Some(data) => {
            print_data(&data)?;
            study.remarks().iter().for_each(|own| remark(own));
        }
        None => print(&Text::written(terminal, |text| study.text(text)))?,
    }
    match folder {
        Some(folder) => folder.write(|files| study.files(files), &object()?, json),
        None => Ok(()),
    }
}
