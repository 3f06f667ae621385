//! Places for texts inside a chart, away from curves, from the border and from each other.

use crate::lettering::text_width;
use crate::thinning::Path;

/// A rectangle \[px\]; y grows downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
}

impl Area {
    fn overlap(&self, other: &Self) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }

    fn distance(&self, (x, y): &(f64, f64)) -> f64 {
        let aside = (self.left - x).max(x - self.right).max(0.0);
        aside.hypot((self.top - y).max(y - self.bottom).max(0.0))
    }

    fn size(&self) -> f64 {
        (self.right - self.left) * (self.bottom - self.top)
    }

    fn holds(&self, point: &(f64, f64)) -> bool {
        (self.left..=self.right).contains(&point.0) && (self.top..=self.bottom).contains(&point.1)
    }
}

/// The room of a text with its left middle at a place.
fn area(left: f64, middle: f64, width: f64, size: f64) -> Area {
    Area {
        left: left - 2.0,
        right: left + width + 2.0,
        top: middle - 0.65 * size,
        bottom: middle + 0.65 * size,
    }
}

/// Finds the place of least cost for one text after the other.
#[derive(Debug)]
pub(super) struct Placer {
    frame: Area,
    curves: Path,
    taken: Vec<Area>,
    points: Path,
}

impl Placer {
    /// Longest stretch of a curve that a text may not notice \[px\].
    const STRIDE: f64 = 6.0;

    /// Starts with nothing but `curves` in `frame`.
    pub(super) fn new(frame: Area, curves: &[Vec<Path>]) -> Self {
        let mut placer =
            Self { frame, curves: Path::new(), taken: Vec::new(), points: Path::new() };
        curves.iter().flatten().for_each(|path| placer.avoid_path(path));
        placer
    }

    /// Lets texts rather not cover a path.
    pub(super) fn avoid_path(&mut self, path: &[(f64, f64)]) {
        for pair in path.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            let length = dx.hypot(dy);
            let mut gone = 0.0;
            while gone < length {
                let part = gone / length;
                self.curves.push((pair[0].0 + dx * part, pair[0].1 + dy * part));
                gone += Self::STRIDE;
            }
        }
    }

    /// Keeps texts away from the disc of a marker, and texts of other markers from looking like its own.
    pub(super) fn avoid(&mut self, (x, y): (f64, f64), radius: f64) {
        self.points.push((x, y));
        self.taken.push(Area {
            left: x - radius,
            right: x + radius,
            top: y - radius,
            bottom: y + radius,
        });
    }

    /// Left middle of a text beside a point: the nearest place right, left, above or below that covers little.
    pub(super) fn beside(&mut self, (x, y): (f64, f64), text: &str, size: f64) -> (f64, f64) {
        let width = text_width(text, size);
        let mut spots = Vec::new();
        for far in (0..20).map(|i| 10.0 + 6.0 * f64::from(i)) {
            let shifts = [10.0, far, -0.5 * width, -10.0 - width, -far - width];
            let rises = [-1.0, 1.0].map(|side| side * (far + 0.3 * size));
            let above_and_below = shifts.iter().flat_map(|h| rises.map(|v| (x + h, y + v)));
            let right_and_left = [far, -far - width].map(|h| (x + h, y));
            let cost = 0.08 * far;
            spots.extend(
                right_and_left.into_iter().chain(above_and_below).map(|(x, y)| (x, y, cost)),
            );
        }
        for (left, middle, cost) in &mut spots {
            let place = area(*left, *middle, width, size);
            let own = place.distance(&(x, y));
            let others = self.points.iter().filter(|p| **p != (x, y));
            *cost += others.filter(|p| place.distance(p) < own + 6.0).fold(0.0, |sum, _| sum + 3.0);
        }
        self.settle(&spots, width, size)
    }

    /// Left middle of a text along a line across the frame: horizontal at height `at`, or vertical at place `at`.
    pub(super) fn along(&mut self, at: f64, horizontal: bool, text: &str, size: f64) -> (f64, f64) {
        let width = text_width(text, size);
        let Area { left, right, top, bottom } = self.frame;
        let spots = [0.0, 0.12, 0.25, 0.5, 0.75, 0.88, 1.0].into_iter().flat_map(|part: f64| {
            [-1.0, 1.0].map(|side: f64| {
                if horizontal {
                    let x = right - 8.0 - width - part * (right - left - width - 16.0);
                    (x, at + side * 0.85 * size, 0.1 * part)
                } else {
                    let x = if side < 0.0 { at - 8.0 - width } else { at + 8.0 };
                    (x, top + size + part * (bottom - top - 2.0 * size), 0.1 * part)
                }
            })
        });
        self.settle(&spots.collect::<Vec<_>>(), width, size)
    }

    /// The cheapest of the `spots` (left, middle, own cost), which is taken from then on.
    fn settle(&mut self, spots: &[(f64, f64, f64)], width: f64, size: f64) -> (f64, f64) {
        let cost = |(x, y, own): &(f64, f64, f64)| {
            let place = area(*x, *y, width, size);
            let outside = 1.0 - place.overlap(&self.frame) / place.size();
            let covered: f64 = self.taken.iter().map(|t| place.overlap(t) / place.size()).sum();
            let crossed =
                self.curves.iter().filter(|p| place.holds(p)).take(200).fold(0.0, |n, _| n + 1.0);
            own + 100.0 * outside + 60.0 * covered + crossed
        };
        let best = spots.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let (x, y) = best.map_or((self.frame.left, self.frame.top), |spot| (spot.0, spot.1));
        // Wholly inside the frame wherever the text is narrower than it.
        let x = x.min(self.frame.right - width - 2.0).max(self.frame.left + 2.0);
        self.taken.push(area(x, y, width, size));
        (x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Area = Area { left: 0.0, right: 600.0, top: 0.0, bottom: 300.0 };

    #[test]
    fn texts_of_neighbouring_points_do_not_cover_each_other() {
        let mut placer = Placer::new(FRAME, &[]);
        for i in 0..6 {
            placer.beside((590.0, 10.0 + f64::from(i)), "peak 38.4 kN at 0.98 ms", 12.0);
        }
        for (i, a) in placer.taken.iter().enumerate() {
            assert!(a.overlap(&FRAME) > 0.999 * a.size(), "{a:?}");
            assert!(placer.taken[..i].iter().all(|b| a.overlap(b) <= 0.0), "{:?}", placer.taken);
        }
    }

    #[test]
    fn a_text_is_nearer_to_its_own_point_than_to_another() {
        let mut placer = Placer::new(FRAME, &[]);
        let points = [(300.0, 150.0), (318.0, 151.0)];
        points.iter().for_each(|p| placer.avoid(*p, 4.5));
        for (i, point) in points.iter().enumerate() {
            placer.beside(*point, "deepest 17.5 mm", 12.0);
            let place = placer.taken[2 + i];
            assert!(place.distance(point) < place.distance(&points[1 - i]), "{place:?}");
        }
    }

    #[test]
    fn a_text_keeps_off_the_curve() {
        let curve = vec![vec![vec![(0.0, 150.0), (600.0, 150.0)]]];
        let mut placer = Placer::new(FRAME, &curve);
        let (_, y) = placer.beside((300.0, 150.0), "peak", 12.0);
        assert!((y - 150.0).abs() > 0.65 * 12.0);
    }
}
