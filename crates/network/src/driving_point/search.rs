//! Search for the largest difference along the time.

use dashpot_numerics::extrema::{maximum, vertex};

use super::{
    disagreement::STEPS,
    impulse::{Course, Part, Point},
};

/// Largest step in the time of the fastest motion that matters, and as a part of the time itself.
const STEP: f64 = 0.25;
/// A motion that adds less than this part is not resolved.
const FAINT: f64 = 1e-4;
/// Most times that are looked at, and most values of single motions.
const MOST_TIMES: usize = 200_000;
const MOST_VALUES: usize = 5_000_000;

/// A time that was looked at.
#[derive(Debug, Clone, Copy, Default)]
struct Admissibility {
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
    ends: [Admissibility; 2],
    at: f64,
    estimate: f64,
}

pub(super) struct Search<'a> {
    course: &'a Course<'a>,
    /// The last three looks.
    looks: Vec<Admissibility>,
    crest: Crest,
    /// The largest difference that was seen.
    seen: f64,
    top: Top,
}

impl<'a> Search<'a> {
    pub(super) fn new(course: &'a Course<'a>) -> Self {
        Self { course, looks: Vec::new(), crest: Crest::default(), seen: 0.0, top: Top::default() }
    }

    /// Looks from one time to another; the time that is reached with a bounded number of values.
    pub(super) fn run(&mut self, start: f64, end: f64) -> f64 {
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
    pub(super) fn largest(&self) -> f64 {
        self.refined(self.crest)
    }

    fn refined(&self, crest: Crest) -> f64 {
        let [low, high] = crest.ends;
        let height = |t: f64| self.course.at(t, &mut Vec::new()).heights[crest.side];
        // A value that was looked at needs no search.
        if low < high { maximum(low, high, STEPS, height).1 } else { crest.height }
    }

    /// The time of the largest difference, and that difference.
    pub(super) fn top(&self) -> (f64, f64) {
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
        let look = Admissibility { t, heights: point.heights, apart, crest: self.crest };
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

    fn take(
        &mut self,
        low: Admissibility,
        admissibility: Admissibility,
        high: Admissibility,
        estimate: f64,
    ) {
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
