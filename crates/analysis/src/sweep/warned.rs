//! What the runs of a sweep are warned of, told once for all points.

use super::Row;
use crate::{Through, Warning};

/// A warning of the runs at some points.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepWarning {
    /// What the run at the first of the points is warned of. At the others the numbers differ.
    pub warning: Warning,
    /// The points, rising.
    pub points: Vec<usize>,
}

/// What is to be said of a instantiated impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Notice {
    /// From when on \[s\] the element pulls.
    pub(super) pulls: Option<f64>,
    /// Its largest deformation \[m\], when \[s\] it is reached, and its thickness \[m\], which is less.
    pub(super) pressed: Option<[f64; 3]>,
}

impl Notice {
    /// The warnings that a full run brings of the same.
    pub(super) fn warnings(&self, element: &str) -> Vec<Warning> {
        let element = element.to_owned();
        let pulls =
            self.pulls.map(|time| Warning::Pulls { element: element.clone(), since: Some(time) });
        let pressed = self.pressed.map(|[deepest, time, thickness]| {
            let through = Through { name: element, deepest, time, thickness };
            Warning::PressedThrough { through, others: 0 }
        });
        pulls.into_iter().chain(pressed).collect()
    }
}

/// The warnings of all rows, in the order of the first points that they are about. `element` is the
/// one that notices are about.
pub(super) fn collect(rows: &[Row<'_>], element: &str) -> Vec<SweepWarning> {
    let mut all = Kinds::default();
    // Notices are of the same kinds at all points, so each is looked for once.
    let mut known: [Option<usize>; 2] = [None; 2];
    for row in rows {
        for warning in &row.warnings {
            let at = all.of(warning);
            all.add(at, row.point);
        }
        let Some(notice) = &row.notice else { continue };
        let alone = [Notice { pressed: None, ..*notice }, Notice { pulls: None, ..*notice }];
        for (known, own) in known.iter_mut().zip(alone).filter(|own| own.1 != Notice::default()) {
            let found = || own.warnings(element).first().map(|warning| all.of(warning));
            if let Some(kind) = known.or_else(found) {
                *known = Some(kind);
                all.add(kind, row.point);
            }
        }
    }
    all.0
}

/// Warnings by what they say besides numbers.
#[derive(Default)]
struct Kinds(Vec<SweepWarning>);

impl Kinds {
    /// Position of the kind of a warning.
    fn of(&mut self, warning: &Warning) -> usize {
        self.0.iter().position(|own| own.warning.is_like(warning)).unwrap_or_else(|| {
            self.0.push(SweepWarning { warning: warning.clone(), points: Vec::new() });
            self.0.len() - 1
        })
    }

    fn add(&mut self, kind: usize, point: usize) {
        let points = &mut self.0[kind].points;
        if points.last() != Some(&point) {
            points.push(point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_in_numbers_alone_are_of_one_kind() {
        let at = |since: Option<f64>, element: &str| Warning::Pulls {
            element: element.to_owned(),
            since,
        };
        assert!(at(Some(7.43e-3), "padding").is_like(&at(Some(1.02), "padding")));
        assert!(!at(Some(7.43e-3), "padding").is_like(&at(None, "padding")));
        assert!(!at(Some(7.43e-3), "padding").is_like(&at(Some(7.43e-3), "mount")));
    }
}
