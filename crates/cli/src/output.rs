//! What goes out: every verb states its result once as a [`Study`], and [`emit`] brings it to people,
//! to programs, and into a folder.

use std::io::{self, Write};

use dashpot_scene::{guarded, text_cell};
use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::{
    error::CliError,
    folder::{Folder, Staged},
    host,
    terminal::{Terminal, note, print, print_data},
};

pub(crate) use dashpot_report::Text;

/// Writes a heading and rows; a cell without a value is blank. A text that a sheet would take for a formula is guarded
/// in cells as in headings; a number stays one.
pub(crate) fn csv(
    out: &mut dyn Write,
    header: impl IntoIterator<Item = String>,
    rows: impl IntoIterator<Item: Serialize>,
) -> io::Result<()> {
    let header: Vec<String> = header.into_iter().map(|own| text_cell(&own).into_owned()).collect();
    writeln!(out, "{}", header.join(","))?;
    let mut writer = csv::Writer::from_writer(out);
    for row in rows {
        cells(&serde_json::to_value(row)?, &mut writer)?;
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
}

/// The cells of a row or of a part of it.
fn cells(part: &Value, writer: &mut csv::Writer<impl Write>) -> csv::Result<()> {
    match part {
        Value::Array(all) => all.iter().try_for_each(|own| cells(own, writer)),
        Value::Object(all) => all.values().try_for_each(|own| cells(own, writer)),
        Value::Null => writer.write_field(""),
        Value::Bool(own) => writer.write_field(own.to_string()),
        Value::Number(own) => writer.write_field(own.to_string()),
        Value::String(own) if own.parse::<f64>().is_ok() => writer.write_field(own),
        Value::String(own) => writer.write_field(guarded(own).as_ref()),
    }
}

/// File of a folder that has everything on one page.
pub(crate) const PAGE: &str = "report.html";

/// Version of the program; also the mark of files that it wrote.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// An object with these keys, in this order: `object! { method: own.method, rtol }`; a key that has the attribute
/// `#[serde(flatten)]` stands for those of its value.
macro_rules! object {
    (@value $key:ident) => { $key };
    (@value $key:ident $value:expr) => { $value };
    ($($(#[$flatten:meta])? $key:ident $(: $value:expr)?),* $(,)?) => {{
        #[expect(non_camel_case_types, reason = "a key is the name of its own type as well")]
        mod object {
            #[derive(serde::Serialize)]
            pub(super) struct Object<$($key),*> { $($(#[$flatten])? pub(super) $key: $key),* }
        }
        object::Object { $($key: object!(@value $key $($value)?)),* }
    }};
}
pub(crate) use object;

pub(crate) fn list<T>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    items.into_iter().collect()
}

/// Items that are alike in groups, in the order of their first ones.
pub(crate) fn alike<T>(
    items: impl IntoIterator<Item = T>,
    is_alike: impl Fn(&T, &T) -> bool,
) -> Vec<Vec<T>> {
    let mut all: Vec<Vec<T>> = Vec::new();
    for item in items {
        match all.iter_mut().find(|group| is_alike(&group[0], &item)) {
            Some(group) => group.push(item),
            None => all.push(vec![item]),
        }
    }
    all
}

/// Each item where it stands first.
pub(crate) fn each_once<T: PartialEq>(items: impl IntoIterator<Item = T>) -> Vec<T> {
    list(alike(items, T::eq).into_iter().filter_map(|group| group.into_iter().next()))
}

/// A map in an order of its own.
pub(crate) struct Pairs<K, V>(Vec<(K, V)>);

impl<K, V> FromIterator<(K, V)> for Pairs<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(pairs: I) -> Self {
        Self(list(pairs))
    }
}

impl<K: Serialize, V: Serialize> Serialize for Pairs<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

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
        return Err(CliError::Ended);
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
