//! What was said of a scene while it was read, as results hold it.

use dashpot_scene::{Diagnostic, ModelNote, Scene};
use serde::Serialize;

use crate::output::{list, object};

/// A warning of the scene's text in one line, with its place.
pub(crate) fn warning(own: &Diagnostic) -> String {
    match own.file().zip(own.line_and_column()) {
        Some((file, (line, _))) => format!("{file}, line {line}: {}", own.message()),
        None => own.message(),
    }
}

/// The warnings of the scene's text, but those that `known` says already.
pub(crate) fn warnings(scene: &Scene, known: &[String]) -> Vec<String> {
    let is_new = |own: &&Diagnostic| !known.iter().any(|known| known.ends_with(&own.message()));
    list(scene.warnings.iter().filter(is_new).map(warning))
}

/// What is to be said about its models and files, in lines.
pub(crate) fn notes(scene: &Scene) -> Vec<String> {
    list(scene.notes.iter().map(|ModelNote { subject, what, .. }| format!("{subject}: {what}")))
}

pub(crate) fn warning_objects(scene: &Scene) -> Vec<impl Serialize> {
    list(scene.warnings.iter().map(|own| {
        object! {
            file: own.file(),
            line: own.line_and_column().map(|own| own.0),
            message: own.message(),
            help: own.help(),
        }
    }))
}

pub(crate) fn note_objects(scene: &Scene) -> Vec<impl Serialize> {
    list(scene.notes.iter().map(|own| {
        object! { of: &own.subject, code: own.what.code(), text: own.what.to_string() }
    }))
}
