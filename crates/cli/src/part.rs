//! Files that are whole or not there: each is written under a name of its own beside its place, and
//! renamed when it is complete.

use std::{
    collections::hash_map::RandomState,
    ffi::OsStr,
    fs::{self, File, Metadata, OpenOptions},
    hash::{BuildHasher, Hasher},
    io::{self, BufWriter, ErrorKind, Read, Write},
    path::{Path, PathBuf},
    time::Duration,
};

use crate::{
    cancel,
    error::{CliError, unwritable},
};

/// Beginning and end of the names of parts.
const NAME: [&str; 2] = [".dashpot-", ".part"];
/// A text that is not in its place for so long was left.
const ABANDONED: Duration = Duration::from_secs(60);
/// Bytes that are read at once.
const CHUNK: usize = 1 << 16;

/// A new file that is removed again unless it is put in its place.
#[derive(Debug)]
pub(crate) struct Part {
    path: PathBuf,
    is_placed: bool,
}

impl Part {
    /// A new file in `folder` with what `fill` writes, and the fingerprint of that. A file that is there
    /// already is left alone, and no link is followed.
    pub(crate) fn new(
        folder: &Path,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<(Self, Fingerprint)> {
        let path = folder.join(name);
        let file = OpenOptions::new().write(true).create_new(true).open(&path)?;
        cancel::begin(&path);
        let part = Self { path, is_placed: false };
        let mut writer = Printing { inner: BufWriter::new(file), print: Fingerprint::default() };
        fill(&mut writer)?;
        writer.flush()?;
        Ok((part, writer.print))
    }

    /// Gives the file its place, instead of what is there.
    pub(crate) fn place(mut self, path: &Path) -> io::Result<()> {
        fs::rename(&self.path, path)?;
        self.is_placed = true;
        Ok(())
    }

    /// Gives the file its place; nothing is there yet.
    fn place_new(self, path: &Path) -> io::Result<()> {
        match fs::hard_link(&self.path, path) {
            // Not every file system has links.
            Err(error) if error.kind() != ErrorKind::AlreadyExists && is_free(path) => {
                self.place(path)
            }
            linked => linked,
        }
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        cancel::end(&self.path);
        if !self.is_placed {
            // What cannot be removed stays; the error that led here is told.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Sixteen digits that nobody foresees.
pub(crate) fn token() -> String {
    format!("{:016x}", RandomState::new().build_hasher().finish())
}

/// Whether `text` may be a [`token`].
pub(crate) fn is_token(text: &str) -> bool {
    text.len() == 16 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// The name of a part of the writer with this token.
pub(crate) fn part_name(token: &str, number: usize) -> String {
    format!("{}{token}-{number}{}", NAME[0], NAME[1])
}

/// Whether a file has the name of the first part of some writer.
pub(crate) fn is_first_part(name: &OsStr) -> bool {
    token_and_number(name).is_some_and(|(token, number)| is_token(token) && number == "0")
}

/// Whether a file has the name of a part of the writer with this token.
pub(crate) fn is_part_of(name: &OsStr, token: &str) -> bool {
    token_and_number(name).is_some_and(|(own, number)| {
        own == token && !number.is_empty() && number.bytes().all(|digit| digit.is_ascii_digit())
    })
}

fn token_and_number(name: &OsStr) -> Option<(&str, &str)> {
    let [begin, end] = NAME;
    name.to_str()?.strip_prefix(begin)?.strip_suffix(end)?.split_once('-')
}

/// What is said of a file that is there.
const FORCED: &str = "`--force` overwrites it";

/// Writes `text` to a file that is not there yet, or in place of a regular one with `force`.
pub(crate) fn write_text(path: &Path, text: &str, force: bool) -> Result<(), CliError> {
    write_whole(path, text, FORCED, |_| force)
}

/// Writes `drawing` to a file that is not there yet, or in place of another drawing.
pub(crate) fn write_drawing(path: &Path, drawing: &str) -> Result<(), CliError> {
    let help = "only a drawing is overwritten: name another file, or move this one away";
    write_whole(path, drawing, help, |begin| begin.starts_with(b"<svg"))
}

/// Finds out whether [`write_text`] can do so, before there is a text.
pub(crate) fn can_write(path: &Path, force: bool) -> Result<(), CliError> {
    place(path, "", FORCED, |_| force).map(drop)
}

/// Writes `text` to a file that is not there yet, or in place of a regular one that `may_replace`
/// permits, given its first bytes.
fn write_whole(
    path: &Path,
    text: &str,
    help: &'static str,
    may_replace: impl FnOnce(&[u8]) -> bool,
) -> Result<(), CliError> {
    let unwritable = unwritable(path);
    let (part, old) = place(path, text, help, may_replace)?;
    match old {
        Some(own) => {
            fs::set_permissions(&part.path, own.permissions()).map_err(&unwritable)?;
            part.place(path).map_err(unwritable)
        }
        None => part.place_new(path).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => CliError::Foreign { path: path.to_owned(), help },
            _ => unwritable(error),
        }),
    }
}

/// The `text` beside the place of a file, and what is there so far.
fn place(
    path: &Path,
    text: &str,
    help: &'static str,
    may_replace: impl FnOnce(&[u8]) -> bool,
) -> Result<(Part, Option<Metadata>), CliError> {
    let unwritable = unwritable(path);
    let folder = match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let old = metadata(path).map_err(&unwritable)?;
    if let Some(own) = &old {
        if !own.is_file() {
            let help =
                "it is no regular file, and nothing is written through links, pipes or devices";
            return Err(CliError::Foreign { path: path.to_owned(), help });
        }
        if !may_replace(&beginning(path).unwrap_or_default()) {
            return Err(CliError::Foreign { path: path.to_owned(), help });
        }
    }
    tidy(folder);
    let name = part_name(&token(), 0);
    let made = Part::new(folder, &name, |out| out.write_all(text.as_bytes()));
    let (part, _) = made.map_err(unwritable)?;
    Ok((part, old))
}

/// Removes the texts that other processes left beside their places when they were killed: one that goes on is placed at
/// once.
fn tidy(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(|own| is_first_part(&own.file_name())) {
        let is_old = |own: Metadata| Some(own.modified().ok()?.elapsed().ok()? > ABANDONED);
        if entry.metadata().ok().filter(Metadata::is_file).and_then(is_old) == Some(true) {
            // What cannot be removed stays.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// What is at `path`, links not followed.
pub(crate) fn metadata(path: &Path) -> io::Result<Option<Metadata>> {
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        found => found.map(Some),
    }
}

/// Whether nothing is at `path`, not even a link that leads nowhere.
fn is_free(path: &Path) -> bool {
    matches!(metadata(path), Ok(None))
}

fn beginning(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(64).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Length and hash (FNV-1a) of a content, by which it is known again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Fingerprint {
    bytes: u64,
    hash: u64,
}

impl Default for Fingerprint {
    fn default() -> Self {
        Self { bytes: 0, hash: 0xcbf2_9ce4_8422_2325 }
    }
}

impl Fingerprint {
    /// That of a file.
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        let (mut file, mut chunk, mut print) = (File::open(path)?, vec![0; CHUNK], Self::default());
        loop {
            match file.read(&mut chunk) {
                Ok(0) => return Ok(print),
                Ok(count) => print.see(&chunk[..count]),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// That of the text `length-hash`.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let (bytes, hash) = text.split_once('-')?;
        Some(Self { bytes: bytes.parse().ok()?, hash: u64::from_str_radix(hash, 16).ok()? })
    }

    fn see(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        for &byte in bytes {
            self.hash = (self.hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

impl std::fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}-{:016x}", self.bytes, self.hash)
    }
}

/// A writer that takes the fingerprint of what passes.
struct Printing<W> {
    inner: W,
    print: Fingerprint,
}

impl<W: Write> Write for Printing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.print.see(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_content_is_known_again_by_the_published_hash() {
        // The test vector of the hash's authors for "foobar".
        let mut print = Fingerprint::default();
        print.see(b"foo");
        print.see(b"bar");
        assert_eq!(print, Fingerprint { bytes: 6, hash: 0x8594_4171_f739_67e8 });
        assert_eq!(Fingerprint::parse(&print.to_string()), Some(print));
    }

    #[test]
    fn parts_are_known_by_the_token_of_their_writer() {
        let (own, other) = (token(), token());
        assert!(is_token(&own) && own != other);
        let name = part_name(&own, 3);
        assert!(is_part_of(OsStr::new(&name), &own) && !is_part_of(OsStr::new(&name), &other));
        assert!(!is_part_of(OsStr::new("notes.txt"), &own));
    }
}
