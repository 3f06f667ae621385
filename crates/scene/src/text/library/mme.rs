//! Tests in ISO-MME that documents name: an `.mme` file, with its channels `.001` and so on beside it or in `Channel`.

use dashpot_signal::iso_mme::{self, MmeChannel};

use super::Loader;
use crate::{tables::table_text, text::document::MAX_BYTES};

/// A test has at most so many channels.
const MOST_CHANNELS: usize = 999;
/// Folders in which they stand.
const FOLDERS: [&str; 4] = ["", "Channel/", "channel/", "CHANNEL/"];

/// The channels of a test, and the paths of their files.
pub(super) struct MmeTest {
    pub(super) channels: Vec<MmeChannel>,
    pub(super) paths: Vec<String>,
}

/// Whether a path is that of a test.
pub(super) fn is_one(path: &str) -> bool {
    stem(path).is_some()
}

/// What stands before the ending.
fn stem(path: &str) -> Option<&str> {
    let (stem, ending) = path.rsplit_once('.')?;
    ending.eq_ignore_ascii_case("mme").then_some(stem)
}

/// Reads the channels of a test; a fault in words names the file and its line.
pub(super) fn read(path: &str, loader: Loader<'_>) -> Result<MmeTest, String> {
    let stem = stem(path).unwrap_or(path);
    let (folder, name) = stem.rfind(['/', '\\']).map_or(("", stem), |at| stem.split_at(at + 1));
    let of = |within: &str, number: usize| format!("{folder}{within}{name}.{number:03}");
    let within = FOLDERS.into_iter().find(|own| loader(&of(own, 1)).is_ok());
    let Some(within) = within else {
        let first = of("", 1);
        return Err(format!("it has no channel: there is no `{first}` beside it or in `Channel`"));
    };
    let (mut paths, mut texts, mut length) = (Vec::new(), Vec::new(), 0);
    for number in 1..=MOST_CHANNELS {
        let path = of(within, number);
        let Ok(bytes) = loader(&path) else { break };
        length += bytes.len();
        if length > MAX_BYTES {
            return Err("its channels have more than 64 MB".to_owned());
        }
        texts.push(table_text(&bytes).into_owned());
        paths.push(path);
    }
    let each: Vec<&str> = texts.iter().map(String::as_str).collect();
    let channels =
        iso_mme::read(&each).map_err(|(at, error)| format!("`{}`, {error}", paths[at]))?;
    Ok(MmeTest { channels, paths })
}
