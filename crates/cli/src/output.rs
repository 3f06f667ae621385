//! What goes out: every verb states its result once as a [`Study`], and [`emit`] brings it to people,
//! to programs, and into a folder.

use serde::Serialize;

use crate::{
    error::{CliError, StudyError},
    folder::{Folder, Staged},
    host,
    terminal::{Terminal, note, print, print_data},
};

pub(crate) use dashpot_report::Text;
pub(crate) use dashpot_studies::{Pairs, VERSION, alike, csv, each_once, list, object};

/// File of a folder that has everything on one page.
pub(crate) const PAGE: &str = "report.html";

/// What a verb has found.
pub(crate) trait Study {
    /// Says it to people.
    fn text(&self, text: &mut Text);

    /// The object for programs: what `--json` prints, and what a folder holds as its result.
    fn object(&self) -> impl Serialize;

    /// Writes a table for programs that is printed where no folder is asked for, in place of the text; `None` where this
    /// terminal is read by people.
    fn data(&self, _terminal: Terminal, _out: &mut Vec<u8>) -> Option<()> {
        None
    }

    /// What the text begins with, and what is said on standard error where that is read at another place.
    fn warnings(&self) -> Vec<String> {
        Vec::new()
    }

    /// What is said on standard error where no text is printed, which says it as well.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// Adds what a folder holds besides: tables, figures, a page.
    fn files(&self, _files: &mut Staged<'_>) -> Result<(), CliError> {
        Ok(())
    }
}

/// Prints a study, as one JSON object or as text, and writes it into the folder, where there is one; nothing of it once
/// the program that calls has asked the work to end.
pub(crate) fn emit(
    study: &impl Study,
    json: bool,
    folder: Option<Folder>,
    terminal: Terminal,
) -> Result<(), CliError> {
    if host::has_ended() {
        return Err(StudyError::Ended.into());
    }
    let object = || Ok::<_, CliError>(serde_json::to_string_pretty(&study.object())? + "\n");
    let data = || {
        let mut bytes = Vec::new();
        study.data(terminal, &mut bytes).filter(|()| folder.is_none())?;
        String::from_utf8(bytes).ok()
    };
    let data = if json { Some(object()?) } else { data() };
    if data.is_some() || !terminal.is_one {
        study.warnings().iter().for_each(|own| terminal.warn(own));
    }
    match data {
        Some(data) => {
            print_data(&data)?;
            study.notes().iter().for_each(|own| note(own));
        }
        None => print(&Text::written(terminal, |text| study.text(text)))?,
    }
    match folder {
        Some(folder) => folder.write(|files| study.files(files), &object()?, json),
        None => Ok(()),
    }
}
