//! Places for texts inside a chart, away from curves, from the border and from each other.

use crate::decimation::Path;
use crate::text_metrics::text_width;

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

/// A straight line from a point to its text \[px\].
pub(super) type Leader = [(f64, f64); 2];

/// Distance of a text from its point from which on a line joins the two \[px\].
const LEADER: f64 = 22.0;

/// The line from a point to the text at a left middle, where the two are far from each other.
fn leader(point: (f64, f64), anchor: (f64, f64), width: f64) -> Option<Leader> {
    let (left, right) = (anchor.0 + 4.0, (anchor.0 + width - 4.0).max(anchor.0 + 4.0));
    let touch = (point.0.clamp(left, right), anchor.1);
    ((touch.0 - point.0).hypot(touch.1 - point.1) > LEADER).then_some([point, touch])
}

/// Whether a line runs through an area in which it neither begins nor ends.
fn strikes(area: &Area, [from, to]: &Leader) -> bool {
    let at = |i: i32| {
        let part = f64::from(i) / 60.0;
        (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1))
    };
    !area.holds(from) && !area.holds(to) && (1..60).any(|i| area.holds(&at(i)))
}

/// Whether two lines cross each other.
fn cross(a: &Leader, b: &Leader) -> bool {
    let side = |[from, to]: &Leader, point: &(f64, f64)| {
        (to.0 - from.0) * (point.1 - from.1) - (to.1 - from.1) * (point.0 - from.0)
    };
    side(a, &b[0]) * side(a, &b[1]) < 0.0 && side(b, &a[0]) * side(b, &a[1]) < 0.0
}

/// Where a text stands beside an upright line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Standing {
    pub(super) place: (f64, f64),
    pub(super) is_upright: bool,
}

/// Finds the place of least cost for one text after the other.
#[derive(Debug)]
pub(super) struct Placer {
    frame: Area,
    curves: Path,
    taken: Vec<Area>,
    points: Path,
    leaders: Vec<Leader>,
    across: Vec<Leader>,
}

impl Placer {
    /// Longest stretch of a curve that a text may not notice \[px\].
    const STRIDE: f64 = 6.0;

    /// A curve nearer to a text than this touches it \[px\].
    const CLEAR: f64 = 3.0;

    /// Cost of a text and a leader that cross.
    const STRUCK: f64 = 50.0;

    /// Cost of an upright text, which is harder to read: a curve that is crossed costs more.
    const UPRIGHT: f64 = 3.0;

    /// Cost of a text on a line across the frame, which is worth a shorter way than that.
    const ACROSS: f64 = 8.0;

    /// Starts with nothing but `curves` in `frame`.
    pub(super) fn new(frame: Area, curves: &[Vec<Path>]) -> Self {
        let mut placer = Self {
            frame,
            curves: Path::new(),
            taken: Vec::new(),
            points: Path::new(),
            leaders: Vec::new(),
            across: Vec::new(),
        };
        curves.iter().flatten().for_each(|path| placer.avoid_path(path));
        placer
    }

    /// Keeps texts off a line across the frame, which would strike them through.
    pub(super) fn avoid_line(&mut self, ends: Leader) {
        self.avoid_path(&ends);
        self.across.push(ends);
    }

    /// Lets texts rather not cover a path.
    pub(super) fn avoid_path(&mut self, path: &[(f64, f64)]) {
        let mut gone = 0.0;
        for pair in path.windows(2) {
            let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            let length = dx.hypot(dy);
            while gone < length {
                let part = gone / length;
                self.curves.push((pair[0].0 + dx * part, pair[0].1 + dy * part));
                gone += Self::STRIDE;
            }
            gone -= length;
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

    /// Left middles of texts beside their points. Each text is placed after the ones before it and once more among all
    /// others, until none moves.
    pub(super) fn beside_all(&mut self, texts: &[((f64, f64), String)], size: f64) -> Path {
        const ROUNDS: usize = 4;
        let fixed = self.taken.clone();
        let mut anchors: Vec<Option<(f64, f64)>> = vec![None; texts.len()];
        for _ in 0..ROUNDS {
            let before = anchors.clone();
            for (index, (point, text)) in texts.iter().enumerate() {
                self.taken.clone_from(&fixed);
                self.leaders.clear();
                for (other, anchor) in anchors.iter().enumerate().filter(|(i, _)| *i != index) {
                    let Some(anchor) = *anchor else { continue };
                    let width = text_width(&texts[other].1, size);
                    self.taken.push(area(anchor.0, anchor.1, width, size));
                    self.leaders.extend(leader(texts[other].0, anchor, width));
                }
                anchors[index] = Some(self.beside(*point, text, size));
            }
            if anchors == before {
                break;
            }
        }
        anchors.into_iter().flatten().collect()
    }

    /// Left middle of a text beside a point: the nearest place right, left, above or below that covers little.
    fn beside(&mut self, (x, y): (f64, f64), text: &str, size: f64) -> (f64, f64) {
        let width = text_width(text, size);
        let mut spots = Vec::new();
        for far in (0..20).map(|i| 10.0 + 6.0 * f64::from(i)) {
            let shifts = [
                10.0,
                far,
                2.0 * far,
                -0.5 * width,
                -10.0 - width,
                -far - width,
                -2.0 * far - width,
            ];
            let rises = [-1.0, 1.0].map(|side| side * (far + 0.3 * size));
            let above_and_below = shifts.iter().flat_map(|h| rises.map(|v| (x + h, y + v)));
            let right_and_left = [far, -far - width].map(|h| (x + h, y));
            let cost = 0.08 * far;
            spots.extend(
                right_and_left.into_iter().chain(above_and_below).map(|(x, y)| (x, y, cost)),
            );
        }
        for (left, middle, cost) in &mut spots {
            // Wholly inside the frame wherever the text is narrower than it.
            *left = left.min(self.frame.right - width - 2.0).max(self.frame.left + 2.0);
            let place = area(*left, *middle, width, size);
            let own = place.distance(&(x, y));
            let others = self.points.iter().filter(|p| **p != (x, y));
            if let Some(line) = leader((x, y), (*left, *middle), width) {
                let struck = self.taken.iter().filter(|taken| strikes(taken, &line));
                *cost += struck.fold(0.0, |sum, _| sum + Self::STRUCK);
                let crossed = self.leaders.iter().filter(|other| cross(&line, other));
                *cost += crossed.fold(0.0, |sum, _| sum + Self::STRUCK);
            }
            *cost += others.filter(|p| place.distance(p) < own + 6.0).fold(0.0, |sum, _| sum + 3.0);
        }
        let anchor = self.settle(&spots, width, size);
        self.leaders.extend(leader((x, y), anchor, width));
        anchor
    }

    /// The lines that join points with texts far from them.
    pub(super) fn leaders(&self) -> &[Leader] {
        &self.leaders
    }

    /// Left middle of a text along a horizontal line across the frame, at the height `at`.
    pub(super) fn along(&mut self, at: f64, text: &str, size: f64) -> (f64, f64) {
        let width = text_width(text, size);
        let Area { left, right, .. } = self.frame;
        let spots = (0..=20).map(|i| 0.05 * f64::from(i)).flat_map(|part| {
            [-1.0, 1.0].map(|side: f64| {
                let x = right - 8.0 - width - part * (right - left - width - 16.0);
                (x, at + side * 0.85 * size, 0.1 * part)
            })
        });
        self.settle(&spots.collect::<Vec<_>>(), width, size)
    }

    /// Place of a text beside an upright line across the frame, at the place `at`: its left middle, or where it stands
    /// upright itself its middle. It does so where it would else be struck through, or look like the text of another line.
    pub(super) fn beside_line(&mut self, at: f64, text: &str, size: f64) -> Standing {
        let width = text_width(text, size);
        let Area { left, right, top, bottom } = self.frame;
        let parts =
            || (0..=20).map(|i| 0.05 * f64::from(i)).flat_map(|own| [(own, -1.0), (own, 1.0)]);
        let lying = parts().map(|(part, side)| {
            let x = if side < 0.0 { at - 8.0 - width } else { at + 8.0 };
            let x = x.min(right - width - 2.0).max(left + 2.0);
            let y = top + size + part * (bottom - top - 2.0 * size);
            (Standing { place: (x, y), is_upright: false }, area(x, y, width, size), 0.1 * part)
        });
        let is_alone =
            self.across.iter().filter(|[from, to]| (from.0 - to.0).abs() <= 0.0).count() < 2;
        let room = bottom - top - width - 16.0;
        let upright = parts().filter(|_| room >= 0.0).map(|(part, side)| {
            let off = 0.65 * size + Self::CLEAR + 1.0;
            let (x, y) = (at + side * off, top + 8.0 + 0.5 * width + part * room);
            let half = (0.65 * size, 0.5 * width + 2.0);
            let place =
                Area { left: x - half.0, right: x + half.0, top: y - half.1, bottom: y + half.1 };
            (Standing { place: (x, y), is_upright: true }, place, Self::UPRIGHT + 0.1 * part)
        });
        let lying = lying.filter(|_| is_alone || room < 0.0);
        let all: Vec<(Standing, Area, f64)> = lying.chain(upright).collect();
        let best = all.iter().min_by(|a, b| self.cost(&a.1, a.2).total_cmp(&self.cost(&b.1, b.2)));
        let Some(&(standing, place, _)) = best else {
            return Standing { place: (left, top), is_upright: false };
        };
        self.taken.push(place);
        standing
    }

    /// The cheapest of the `spots` (left, middle, own cost), which is taken from then on.
    fn settle(&mut self, spots: &[(f64, f64, f64)], width: f64, size: f64) -> (f64, f64) {
        let cost = |(x, y, own): &(f64, f64, f64)| self.cost(&area(*x, *y, width, size), *own);
        let best = spots.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)));
        let (x, y) = best.map_or((self.frame.left, self.frame.top), |spot| (spot.0, spot.1));
        self.taken.push(area(x, y, width, size));
        (x, y)
    }

    /// What a text in this place costs, beside its `own` cost.
    fn cost(&self, place: &Area, own: f64) -> f64 {
        let outside = 1.0 - place.overlap(&self.frame) / place.size();
        let covers = self.taken.iter().map(|t| place.overlap(t) / place.size());
        let covered: f64 = covers.filter(|part| *part > 0.0).map(|part| 1.0 + part).sum();
        let near = |p: &&(f64, f64)| place.distance(p) < Self::CLEAR;
        let crossed = self.curves.iter().filter(near).take(200).fold(0.0, |n, _| n + 1.0);
        let across = self.across.iter().filter(|line| strikes(place, line));
        let own = across.fold(own, |sum, _| sum + Self::ACROSS);
        let struck = self.leaders.iter().filter(|line| strikes(place, line));
        let struck = struck.fold(0.0, |sum, _| sum + Self::STRUCK);
        own + 1000.0 * outside + 400.0 * covered + struck + crossed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Area = Area { left: 0.0, right: 600.0, top: 0.0, bottom: 300.0 };

    #[test]
    fn a_text_is_not_struck_through_by_a_line_across() {
        let mut placer = Placer::new(FRAME, &[]);
        let line = [(500.0, FRAME.top), (500.0, FRAME.bottom)];
        placer.avoid_line(line);
        let text = "deepest 44.9 mm at 424 ms".to_owned();
        let anchor = placer.beside_all(&[((450.0, 60.0), text.clone())], 12.0)[0];
        let place = area(anchor.0, anchor.1, text_width(&text, 12.0), 12.0);
        assert!(place.right < 500.0 || place.left > 500.0, "{place:?}");
    }

    #[test]
    fn texts_of_neighbouring_lines_stand_upright_and_cross_none() {
        let mut placer = Placer::new(FRAME, &[]);
        let lines = [400.0, 440.0, 480.0, 520.0];
        lines.iter().for_each(|at| placer.avoid_line([(*at, FRAME.top), (*at, FRAME.bottom)]));
        for at in lines {
            let own = placer.beside_line(at, "thickness of T=40 mm: 40 mm", 12.0);
            assert!(own.is_upright);
            let place = *placer.taken.last().unwrap();
            assert!(lines.iter().all(|at| place.right < *at || place.left > *at), "{place:?}");
            assert!(
                (own.place.0 - at).abs() < 20.0,
                "{own:?} is nearer to another line than to {at}"
            );
            assert!(place.overlap(&FRAME) > 0.999 * place.size(), "{place:?}");
        }
        let mut placer = Placer::new(FRAME, &[]);
        placer.avoid_line([(400.0, FRAME.top), (400.0, FRAME.bottom)]);
        assert!(!placer.beside_line(400.0, "thickness of pad: 40 mm", 12.0).is_upright);
    }

    #[test]
    fn texts_of_neighbouring_points_do_not_cover_each_other() {
        let mut placer = Placer::new(FRAME, &[]);
        let text = "peak 38.4 kN at 0.98 ms".to_owned();
        let texts: Vec<_> = (0..6).map(|i| ((590.0, 10.0 + f64::from(i)), text.clone())).collect();
        assert_eq!(placer.beside_all(&texts, 12.0).len(), 6);
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
    fn no_leader_strikes_through_a_text() {
        let mut placer = Placer::new(FRAME, &[]);
        let points: Vec<_> = (0..4).map(|i| (500.0 + 12.0 * f64::from(i), 60.0)).collect();
        points.iter().for_each(|p| placer.avoid(*p, 4.5));
        let text = "soft: peak 1.47 kN at 17.8 ms".to_owned();
        let texts: Vec<_> = points.iter().map(|point| (*point, text.clone())).collect();
        assert_eq!(placer.beside_all(&texts, 12.0).len(), 4);
        assert!(!placer.leaders().is_empty());
        for line in placer.leaders() {
            assert!(placer.taken[4..].iter().all(|text| !strikes(text, line)), "{placer:?}");
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
