//! What the runs of a sweep are warned of, told once for all points.

use serde::Serialize;

use super::Row;
use crate::{extremes::Through, warnings::pulls};

/// A warning of the runs at some points.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SweepWarning {
    /// What the run at the first of the points is warned of. At the others the numbers differ.
    pub text: String,
    /// The points, rising.
    pub points: Vec<usize>,
}

/// What is to be said of a stamped impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Notice {
    /// From when on \[s\] the element pulls.
    pub(super) pulls: Option<f64>,
    /// Its largest deformation \[m\], when \[s\] it is reached, and its thickness \[m\], which is less.
    pub(super) pressed: Option<[f64; 3]>,
}

impl Notice {
    /// The warnings that a full run brings of the same.
    pub(super) fn warnings(&self, element: &str) -> impl Iterator<Item = String> {
        self.texts(element).into_iter().flatten()
    }

    fn texts(&self, element: &str) -> [Option<String>; 2] {
        let pressed = |[deepest, time, thickness]: [f64; 3]| {
            Through { name: element.to_owned(), deepest, time, thickness }.text()
        };
        [self.pulls.map(|time| pulls(element, Some(time))), self.pressed.map(pressed)]
    }

    fn is_raised(&self) -> [bool; 2] {
        [self.pulls.is_some(), self.pressed.is_some()]
    }
}

/// The warnings of all rows, in the order of the first points that they are about. `element` is the
/// one that notices are about.
pub(super) fn collect(rows: &[Row<'_>], element: &str) -> Vec<SweepWarning> {
    let mut all = Kinds::default();
    // The words of notices are the same at all points, so they are formed once.
    let mut known: [Option<usize>; 2] = [None; 2];
    for row in rows {
        for text in &row.warnings {
            let at = all.of(text);
            all.add(at, row.point);
        }
        let Some(notice) = &row.notice else { continue };
        for (at, raised) in notice.is_raised().into_iter().enumerate() {
            if !raised {
                continue;
            }
            if known[at].is_none() {
                known[at] = notice.texts(element)[at].as_deref().map(|text| all.of(text));
            }
            if let Some(kind) = known[at] {
                all.add(kind, row.point);
            }
        }
    }
    all.found
}

/// Warnings by what they say besides numbers.
#[derive(Default)]
struct Kinds {
    forms: Vec<String>,
    found: Vec<SweepWarning>,
}

impl Kinds {
    /// Position of the kind of a warning.
    fn of(&mut self, text: &str) -> usize {
        let form = form(text);
        self.forms.iter().position(|own| *own == form).unwrap_or_else(|| {
            self.forms.push(form);
            self.found.push(SweepWarning { text: text.to_owned(), points: Vec::new() });
            self.forms.len() - 1
        })
    }

    fn add(&mut self, kind: usize, point: usize) {
        let points = &mut self.found[kind].points;
        if points.last() != Some(&point) {
            points.push(point);
        }
    }
}

/// A warning without its numbers and the words behind those, which are mostly their units.
pub(super) fn form(text: &str) -> String {
    let mut form = String::with_capacity(text.len());
    let mut words = text.split_whitespace();
    while let Some(word) = words.next() {
        let is_number = word.trim_start_matches('-').starts_with(|own: char| own.is_ascii_digit());
        form.push_str(if is_number { "0" } else { word });
        form.push(' ');
        if is_number {
            words.next();
        }
    }
    form
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_in_numbers_alone_are_of_one_kind() {
        let at = |time: &str| format!("from {time} the padding pulls: separation is off");
        assert_eq!(form(&at("7.43 ms")), form(&at("1.02 s")));
        assert_ne!(form(&at("7.43 ms")), form(&at("the start")));
        assert_ne!(form(&at("7.43 ms")), form(&at("7.43 ms").replace("padding", "mount")));
    }
}
