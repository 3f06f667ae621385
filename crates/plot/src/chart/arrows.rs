//! Arrowheads on curves: in which direction they are run through.

use super::{Chart, Pattern};
use crate::{axis::Frame, decimation::Path, theme::Colour};

/// Length and half the width of an arrowhead \[px\].
const SIZE: (f64, f64) = (12.0, 4.6);
/// Distance of the first one from the beginning of a curve, and of each from the one before, along the curve \[px\].
const FIRST: f64 = 70.0;
const APART: f64 = 170.0;
/// Least distance of two arrowheads from each other, and from a marker \[px\].
const CLEAR: f64 = 20.0;
/// So many stand on one curve at most.
const MOST: usize = 5;
/// Steps in which a place is looked for \[px\].
const STEP: f64 = 5.0;
/// A curve bends less than this within an arrowhead: the chord as a part of the way.
const STRAIGHT: f64 = 0.97;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Arrowhead {
    /// Its tip, and the two corners behind it \[px\].
    pub(super) corners: [(f64, f64); 3],
    pub(super) colour: Colour,
}

impl Chart {
    /// Places for arrowheads on curves, away from each other and from markers; none where the chart wants none.
    pub(super) fn arrowheads(&self, frame: &Frame, curves: &[Vec<Path>]) -> Vec<Arrowhead> {
        let mut all = Vec::new();
        if !self.has_arrows {
            return all;
        }
        let mut taken: Path = self.marked().map(|own| frame.at(own.x, own.y)).collect();
        // What is drawn on a broad curve runs as that does.
        let is_broad = |index: &usize| self.pen(*index).pattern == Pattern::Broad;
        let are_broad = (0..curves.len()).any(|index| is_broad(&index));
        for (index, paths) in curves.iter().enumerate() {
            if are_broad && !is_broad(&index) {
                continue;
            }
            let colour = self.pen(index).colour;
            let mut left = MOST;
            for path in paths {
                for corners in along(path, &mut taken, left) {
                    all.push(Arrowhead { corners, colour });
                    left -= 1;
                }
            }
        }
        all
    }
}

/// At most `most` arrowheads along a path.
fn along(path: &Path, taken: &mut Path, most: usize) -> Vec<[(f64, f64); 3]> {
    let way = Way::of(path);
    let mut heads = Vec::new();
    let mut at = FIRST.min(0.3 * way.length());
    while heads.len() < most && at + SIZE.0 <= way.length() {
        let (back, front) = (way.at(at), way.at(at + SIZE.0));
        let (dx, dy) = (front.0 - back.0, front.1 - back.1);
        let chord = dx.hypot(dy);
        let middle = (0.5 * (back.0 + front.0), 0.5 * (back.1 + front.1));
        let is_free = |other: &(f64, f64)| (other.0 - middle.0).hypot(other.1 - middle.1) >= CLEAR;
        if chord < STRAIGHT * SIZE.0 || !taken.iter().all(is_free) {
            at += STEP;
            continue;
        }
        let (aside_x, aside_y) = (-dy / chord * SIZE.1, dx / chord * SIZE.1);
        heads.push([
            front,
            (back.0 + aside_x, back.1 + aside_y),
            (back.0 - aside_x, back.1 - aside_y),
        ]);
        taken.push(middle);
        at += APART;
    }
    heads
}

/// A path with its length up to each point.
struct Way<'p> {
    path: &'p Path,
    gone: Vec<f64>,
}

impl<'p> Way<'p> {
    fn of(path: &'p Path) -> Self {
        let mut gone = vec![0.0];
        for pair in path.windows(2) {
            let last = gone[gone.len() - 1];
            gone.push(last + (pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1));
        }
        Self { path, gone }
    }

    fn length(&self) -> f64 {
        self.gone[self.gone.len() - 1]
    }

    /// The place at this length \[px\], within the path.
    fn at(&self, length: f64) -> (f64, f64) {
        let after = self.gone.partition_point(|own| *own < length).clamp(1, self.path.len() - 1);
        let (from, to) = (self.path[after - 1], self.path[after]);
        let part = (length - self.gone[after - 1]) / (self.gone[after] - self.gone[after - 1]);
        (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A loop as of a pad that is loaded and unloaded.
    fn pressed() -> Path {
        let upper = (0..=100).map(f64::from).map(|i| (4.0 * i, 300.0 - 3.0 * i));
        let lower = (0..=100).rev().map(f64::from).map(|i| (4.0 * i, 300.0 - 0.03 * i * i));
        upper.chain(lower).collect()
    }

    #[test]
    fn arrowheads_point_along_the_curve_and_stand_apart() {
        let (path, mut taken) = (pressed(), Path::new());
        let heads = along(&path, &mut taken, 6);
        assert!(heads.len() >= 4, "{heads:?}");
        let to_the_right = heads.iter().filter(|own| own[0].0 > own[1].0.max(own[2].0)).count();
        let to_the_left = heads.iter().filter(|own| own[0].0 < own[1].0.min(own[2].0)).count();
        assert!(to_the_right >= 2 && to_the_left >= 2, "{heads:?}");
        for (i, one) in taken.iter().enumerate() {
            assert!(taken[..i].iter().all(|o| (o.0 - one.0).hypot(o.1 - one.1) >= CLEAR));
        }
    }

    #[test]
    fn there_are_none_on_points_and_short_stretches_and_few_on_long_ones() {
        for path in [vec![(1.0, 1.0)], vec![(0.0, 0.0), (8.0, 0.0)]] {
            assert!(along(&path, &mut Path::new(), 6).is_empty());
        }
        let long: Path = (0..9000).map(|i| (f64::from(i), 0.0)).collect();
        assert_eq!(along(&long, &mut Path::new(), MOST).len(), MOST);
    }
}
