//! What a result is made of, so that it can be told years later whether that is still the same.

use std::fmt::Write as _;

use dashpot_scene::{Loader, Scene};
use serde::Serialize;
use sha2::{Digest, Sha256};

use crate::{VERSION, list, object};

/// A text or file with its SHA-256, as `sha256sum` prints it.
#[derive(Debug, Serialize)]
pub struct Source {
    /// Its name.
    pub file: String,
    /// The hash, in hexadecimal digits.
    pub sha256: String,
}

/// What a result is of: its first keys.
pub fn head<'s>(scene: &'s Scene, load: Loader<'_>) -> impl Serialize + use<'s> {
    let (title, file, files) = (&scene.title, &scene.file, of_files(scene, load));
    object! { dashpot: VERSION, title, file, sha256: of_text(scene), files }
}

/// The SHA-256 of the scene's text, with what the command line sets by its path.
pub fn of_text(scene: &Scene) -> String {
    sha256(scene.text.as_bytes())
}

/// The other files of which the scene is made; one that is gone meanwhile is left out.
pub fn of_files(scene: &Scene, load: Loader<'_>) -> Vec<Source> {
    let source = |file: &String| Some(Source { file: file.clone(), sha256: of_file(file, load)? });
    list(scene.files.iter().filter_map(source))
}

/// The SHA-256 of a file, unless it is gone meanwhile.
pub fn of_file(name: &str, load: Loader<'_>) -> Option<String> {
    Some(sha256(&load(name).ok()?))
}

/// The version of the program and all hashes, as rows of a table of settings.
pub fn rows(scene: &Scene, load: Loader<'_>) -> Vec<Vec<String>> {
    let own = [
        vec!["dashpot".to_owned(), VERSION.to_owned()],
        vec!["SHA-256 of the scene".to_owned(), of_text(scene)],
    ];
    let files = of_files(scene, load).into_iter();
    list(
        own.into_iter()
            .chain(files.map(|own| vec![format!("SHA-256 of {}", own.file), own.sha256])),
    )
}

/// The SHA-256 of some bytes, in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in Sha256::digest(bytes) {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-2, appendix B.1.
    #[test]
    fn hash_is_that_of_the_standard() {
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), expected);
    }
}
