//! When the motions of two receptances after an impulse differ most.

use std::f64::consts::TAU;

use dashpot_numerics::{
    Twofold,
    extrema::{maximum, vertex},
};

use super::{
    Receptance,
    complex::Complex,
    disagreement::STEPS,
    motions::{Motion, motions},
    terms::Term,
};

/// Where the search starts, in the time of the fastest pole.
const START: f64 = 1e-6;
/// Oscillations that live for more periods than this are looked at over [`PERIODS`].
const MANY: f64 = 2000.0;
const PERIODS: f64 = 100.0;
/// A limit within this part of the largest value is where it is reached.
const FLAT: f64 = 1e-6;
/// The last part of the time, in which the largest difference counts as growing.
const LAST: f64 = 0.02;
/// Rounding of one motion in doubles, relative.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// A sum at the start is nothing below this part of what is added up, and below this many errors.
const NOTHING: f64 = 1e-24;
const MARGIN: f64 = 1e3;
/// How far the limit at the start may be beyond the first value.
const AGREES: f64 = 0.99;
/// Noise of the creep beside free motion.
const NOISE: f64 = 1e-25;

/// The largest difference of two motions after an impulse.
pub(super) struct Largest {
    /// 0 and infinity are the limits \[s\].
    pub(super) time: f64,
    pub(super) size: f64,
    /// It is at the end of what was looked at.
    pub(super) is_growing: bool,
    /// Up to when the motions were looked at \[s\]; infinite where all is known.
    pub(super) until: f64,
}

/// The largest difference at a time in units of the largest motion up to then.
pub(super) fn worst(a: &Receptance, b: &Receptance) -> Largest {
    let (motions, end) = motions(a, b, horizon);
    let course = Course::of(a, b, &motions);
    let fastest = motions.iter().map(|motion| motion.speed).fold(0.0, f64::max);
    let mut search = Search::new(&course);
    let until = if motions.is_empty() { end } else { search.run(START / fastest, end) };
    let is_over = until >= end && motions.iter().all(is_passing);
    let (time, size) = search.top();
    let at_once = course.at_once(a, b, START / fastest);
    let late = course.late(is_over, search.largest());
    let top = size.max(at_once).max(late);
    let is_top = |limit: f64| limit >= top * (1.0 - FLAT);
    let (time, is_growing) = if is_top(at_once) {
        (0.0, false)
    } else if is_top(late) {
        (f64::INFINITY, false)
    } else {
        (time, !is_over && time >= (1.0 - LAST) * until)
    };
    Largest { time, size: top, is_growing, until: if is_over { f64::INFINITY } else { until } }
}

/// Whether it dies down within the time that is looked at.
fn is_passing(motion: &Motion) -> bool {
    motion.life() * motion.speed <= MANY * TAU
}

/// Up to when motions are looked at \[s\].
fn horizon(motions: &[Motion]) -> f64 {
    let own = |motion: &Motion| {
        if is_passing(motion) { motion.life() } else { PERIODS * TAU / motion.speed }
    };
    motions.iter().map(own).fold(0.0, f64::max)
}

/// The motions of both after an impulse.
pub(super) struct Course<'a> {
    pub(super) motions: &'a [Motion],
    /// Creep and free motion of the first: a constant \[m/(N s)\] and what multiplies the time.
    rest: [f64; 2],
    /// The first less the second.
    rest_change: [f64; 2],
    /// Rounding of the constant.
    rest_noise: f64,
    /// Relative error of both.
    error: f64,
}

/// Both motions at a time.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    /// Size of each.
    pub(super) heights: [f64; 2],
    /// Size of their difference.
    pub(super) change: f64,
    /// Bounds on the rounding of both.
    pub(super) height_noise: f64,
    pub(super) change_noise: f64,
}

impl Point {
    /// Size of the larger.
    pub(super) fn height(&self) -> f64 {
        self.heights[0].max(self.heights[1])
    }

    /// The difference that is there for certain, in units of a motion no smaller than `largest`.
    pub(super) fn apart(&self, largest: f64) -> f64 {
        let largest = largest.max(self.height()) + self.height_noise;
        if largest > 0.0 { (self.change - self.change_noise).max(0.0) / largest } else { 0.0 }
    }
}

/// One motion at a time, as it matters to the next step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// How fast it changes \[1/s\].
    pub(super) speed: f64,
    pub(super) height: f64,
    pub(super) change: f64,
    pub(super) cost: usize,
}

impl<'a> Course<'a> {
    fn of(a: &Receptance, b: &Receptance, motions: &'a [Motion]) -> Self {
        let [first, second] = [a, b].map(|own| {
            let term = own.terms.iter().find(|term| term.at.size() <= 0.0);
            match term.map(|term| &term.residues[..]) {
                Some([double, simple]) => [simple.re, double.re],
                Some([simple]) => [simple.re, 0.0.into()],
                _ => [0.0.into(), 0.0.into()],
            }
        });
        let slowest = motions.iter().map(|motion| motion.speed).fold(f64::INFINITY, f64::min);
        Self {
            motions,
            rest: first.map(Twofold::high),
            rest_change: [0, 1].map(|at| (first[at] - second[at]).high()),
            rest_noise: NOISE * first[1].high().max(second[1].high()) / slowest,
            error: a.error + b.error,
        }
    }

    /// At a time; the parts that are still alive are put into `parts`.
    pub(super) fn at(&self, t: f64, parts: &mut Vec<Part>) -> Point {
        parts.clear();
        let mut first = self.rest[0] + self.rest[1] * t;
        let mut change = self.rest_change[0] + self.rest_change[1] * t;
        let rounding = self.rest_change[0].abs() + self.rest_change[1].abs() * t;
        let mut point = Point {
            height_noise: ROUNDING * first.abs(),
            change_noise: ROUNDING * rounding + self.rest_noise,
            ..Point::default()
        };
        for motion in self.motions.iter().filter(|motion| !motion.is_dead(t)) {
            let own = motion.at(t);
            first += own.first.re;
            change += own.change.re;
            let part = Part {
                speed: motion.speed,
                height: own.first.norm().max((own.first - own.change).norm()),
                change: own.change.norm(),
                cost: motion.cost,
            };
            let unknown = self.error * (1.0 + motion.speed * t);
            point.height_noise += ROUNDING * part.height;
            point.change_noise += ROUNDING * part.change + unknown * part.height;
            parts.push(part);
        }
        point.heights = [first.abs(), (first - change).abs()];
        point.change = change.abs();
        point
    }

    /// The limit at the start: the first of speed and acceleration that is there in either. It must
    /// not be beyond what a time near it shows, where a small sum could be rounding.
    fn at_once(&self, a: &Receptance, b: &Receptance, near: f64) -> f64 {
        let starts = [a, b].map(|own| own.terms.iter().map(start).collect::<Vec<_>>());
        for k in 0..2 {
            let sums = [&starts[0], &starts[1]].map(|own| {
                let sum = own.iter().fold(Complex::zero(), |sum, own| sum + own[k]);
                (sum, own.iter().map(|own| own[k].size()).sum::<f64>())
            });
            let nothing = MARGIN * self.error + NOTHING;
            if sums.iter().all(|(sum, all)| sum.size() <= nothing * all) {
                continue;
            }
            let [(first, all), (second, others)] = sums;
            let noise = (self.error + NOTHING / MARGIN) * (all + others);
            let change = ((first - second).size() - noise).max(0.0);
            let limit = change / first.size().max(second.size());
            if self.motions.is_empty() {
                return limit;
            }
            let point = self.at(near, &mut Vec::new());
            let least = (point.height() - point.height_noise).max(0.0);
            let is_shown = AGREES * limit * least <= point.change + point.change_noise;
            return if is_shown { limit } else { 0.0 };
        }
        0.0
    }

    /// The limit after long times: of free motion, else of creep once all else has died down.
    fn late(&self, is_over: bool, largest: f64) -> f64 {
        let second = [0, 1].map(|at| self.rest[at] - self.rest_change[at]);
        let [creep, free] = [0, 1].map(|at| self.rest[at].abs().max(second[at].abs()));
        if free > 0.0 {
            self.rest_change[1].abs() / free
        } else if is_over && creep > 0.0 {
            self.rest_change[0].abs() / largest.max(creep)
        } else {
            0.0
        }
    }
}

/// What a term adds to the speed and the acceleration at the start.
fn start(term: &Term) -> [Complex; 2] {
    let moments = term.moments(Complex::zero(), 2);
    [moments[0], moments[1]]
}

/// Largest step in the time of the fastest motion that matters, and as a part of the time itself.
const STEP: f64 = 0.25;
/// A motion that adds less than this part is not resolved.
const FAINT: f64 = 1e-4;
/// Most times that are looked at, and most values of single motions.
const MOST_TIMES: usize = 200_000;
const MOST_VALUES: usize = 5_000_000;

/// A time that was looked at.
#[derive(Debug, Clone, Copy, Default)]
struct Sample {
    t: f64,
    heights: [f64; 2],
    apart: f64,
    /// The largest motion up to then.
    crest: Crest,
}

/// A largest motion: which of the two, and between which times \[s\].
#[derive(Debug, Clone, Copy, Default)]
struct Crest {
    height: f64,
    side: usize,
    ends: [f64; 2],
}

impl Crest {
    fn larger(self, other: Self) -> Self {
        if other.height > self.height { other } else { self }
    }
}

/// Where the largest difference is.
#[derive(Debug, Clone, Copy, Default)]
struct Top {
    ends: [Sample; 2],
    at: f64,
    estimate: f64,
}

struct Search<'a> {
    course: &'a Course<'a>,
    /// The last three looks.
    looks: Vec<Sample>,
    crest: Crest,
    /// The largest difference that was seen.
    seen: f64,
    top: Top,
}

impl<'a> Search<'a> {
    fn new(course: &'a Course<'a>) -> Self {
        Self { course, looks: Vec::new(), crest: Crest::default(), seen: 0.0, top: Top::default() }
    }

    /// Looks from one time to another; the time that is reached with a bounded number of values.
    fn run(&mut self, start: f64, end: f64) -> f64 {
        let mut parts = Vec::new();
        let (mut t, mut reached, mut values) = (start.min(end), 0.0, 0);
        for _ in 0..MOST_TIMES {
            let point = self.course.at(t, &mut parts);
            if !(point.height().is_finite() && point.change.is_finite()) {
                break;
            }
            self.look(t, &point);
            reached = t;
            values += parts.iter().map(|part| part.cost).sum::<usize>();
            if t >= end || values > MOST_VALUES {
                break;
            }
            t = (t + self.step(t, &parts)).min(end);
        }
        // The last look has no other behind it.
        if let [.., before, last] = self.looks[..] {
            self.take(before, last, last, last.apart);
        }
        reached
    }

    /// The largest motion.
    fn largest(&self) -> f64 {
        self.refined(self.crest)
    }

    fn refined(&self, crest: Crest) -> f64 {
        let [low, high] = crest.ends;
        let height = |t: f64| self.course.at(t, &mut Vec::new()).heights[crest.side];
        // A value that was looked at needs no search.
        if low < high { maximum(low, high, STEPS, height).1 } else { crest.height }
    }

    /// The time of the largest difference, and that difference.
    fn top(&self) -> (f64, f64) {
        let [low, high] = self.top.ends.map(|look| look.t);
        let course = |t: f64| self.course.at(t, &mut Vec::new());
        let peaks = [0, 1].map(|side| maximum(low, high, STEPS, |t| course(t).heights[side]));
        let before = self.refined(self.top.ends[0].crest);
        let apart = |t: f64| {
            let past = peaks.iter().filter(|peak| t >= peak.0).map(|peak| peak.1);
            course(t).apart(past.fold(before, f64::max))
        };
        let (found, own) = (maximum(low, high, STEPS, apart), (self.top.at, apart(self.top.at)));
        if found.1 > own.1 { found } else { own }
    }

    fn look(&mut self, t: f64, point: &Point) {
        if let [.., before, own] = &mut self.looks[..] {
            for side in 0..2 {
                let [old, middle] = [&*before, &*own].map(|look| (look.t, look.heights[side]));
                let new = (t, point.heights[side]);
                if middle.1 >= old.1 && middle.1 >= new.1 {
                    let peak = vertex([old, middle, new]).unwrap_or(middle);
                    let crest = Crest { height: peak.1, side, ends: [old.0, t] };
                    self.crest = self.crest.larger(crest);
                    if peak.0 <= own.t {
                        own.crest = own.crest.larger(crest);
                    }
                }
            }
        }
        let own = Crest { height: point.height(), side: 0, ends: [t, t] };
        self.crest = self.crest.larger(own);
        let apart = point.apart(self.crest.height);
        self.seen = self.seen.max(apart);
        let look = Sample { t, heights: point.heights, apart, crest: self.crest };
        match self.looks[..] {
            [.., before, own] if own.apart >= before.apart && own.apart >= apart => {
                let places = [before, own, look].map(|look| (look.t, look.apart));
                self.take(before, own, look, vertex(places).unwrap_or(places[1]).1);
            }
            [own] if own.apart >= apart => self.take(own, own, look, own.apart),
            _ => {}
        }
        if self.looks.len() > 2 {
            self.looks.remove(0);
        }
        self.looks.push(look);
    }

    fn take(&mut self, low: Sample, admissibility: Sample, high: Sample, estimate: f64) {
        if estimate > self.top.estimate {
            self.top = Top { ends: [low, high], at: admissibility.t, estimate };
        }
    }

    /// To the next time: as fine as what is seen of the motions and of their difference asks for.
    fn step(&self, t: f64, parts: &[Part]) -> f64 {
        let matters = |part: &&Part| {
            let least = FAINT * self.crest.height;
            part.height > least || part.change > least * self.seen
        };
        let fastest = parts.iter().filter(matters).map(|part| part.speed).fold(0.0, f64::max);
        STEP * t.min(fastest.recip())
    }
}
