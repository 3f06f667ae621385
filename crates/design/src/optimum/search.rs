//! The way to the best design: spread designs, and searches from the best of them.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_analysis::{Cause, Misses, Unevaluated};

use super::{
    Aim, DepthOf, DesignError, Effort, Looked, Lost, Problem, Required, Requirement, Searched,
    aims::{Direct, Epigraph},
    evaluate::{Evaluated, Evaluator},
    programme::{Found, least},
    spread::{Space, spread},
};
use crate::shared::shared;

/// What a design may exceed a bound by, in parts of it, and still count as keeping it in a search.
pub(super) const ROOM: f64 = 1e-7;
/// Bounds are drawn in by this part of them where errors or rounding may reach across.
pub(super) const DRAWN_IN: f64 = 1e-6;
/// Searches that end with aims this near each other have found one design.
pub(super) const SAME: f64 = 1e-5;

/// Designs that one search may look at, for each of its unknowns and one more.
const MOST_LOOKED: usize = 200;

pub(super) struct Search<'p> {
    pub(super) evaluator: Evaluator<'p>,
    pub(super) space: Space,
    effort: Effort,
    pub(super) solved: AtomicUsize,
    /// What could not be evaluated: its numbers, and why.
    missing: Misses,
    /// After so many designs in all the search at hand is given up, and how many were.
    until: AtomicUsize,
    cut: AtomicUsize,
}

/// The designs that were spread.
pub(super) struct Known {
    /// Those that could be solved, and where the scene is.
    all: Vec<Spread>,
    /// All of them in their order.
    pub(super) looked: Vec<Looked>,
    is_grid: bool,
}

/// A design that was spread.
struct Spread {
    place: Vec<f64>,
    found: Evaluated,
}

impl<'p> Search<'p> {
    /// Of a problem, with another aim that may have a ceiling.
    pub(super) fn of(
        problem: &Problem<'p>,
        other: Option<&'p Aim>,
        effort: Effort,
    ) -> Result<Self, DesignError> {
        problem.check()?;
        let space = Space::of(problem.variables, problem.totals);
        let begin = space.values(&space.unknowns(&problem.begin()));
        let evaluator = Evaluator::new(problem.tests, problem.aim, other, &begin)?;
        let [solved, cut, until] = [0, 0, usize::MAX].map(AtomicUsize::new);
        Ok(Self { evaluator, space, effort, solved, missing: Misses::default(), until, cut })
    }

    /// By how much requirements are drawn in at least: neither thickness nor law is left by rounding.
    pub(super) fn no_slack(&self) -> Vec<f64> {
        let is_depth = |own: &Required| matches!(own.what, Requirement::Depth(..));
        let all = self.evaluator.required.iter();
        all.map(|own| if is_depth(own) { DRAWN_IN } else { 0.0 }).collect()
    }

    /// Solves designs spread over the bounds, and where the scene begins.
    pub(super) fn known(&self, begin: &[f64]) -> Result<Known, DesignError> {
        let begin = self.space.unknowns(begin);
        let (mut places, is_grid) = spread(begin.len(), self.effort.designs);
        let count = places.len();
        places.push(begin);
        let (mut looked, found) = self.looked(&places);
        looked.truncate(count);
        let all = places.into_iter().zip(found);
        let all = all.filter_map(|(place, found)| Some(Spread { place, found: found.ok()? }));
        let all: Vec<Spread> = all.collect();
        if all.is_empty() {
            return Err(DesignError::Nothing(self.lost(None).unevaluated));
        }
        Ok(Known { all, looked, is_grid })
    }

    /// What could not be evaluated so far. Where nothing keeps everything, that are those of `looked` as well which round
    /// bodies press by more than their radius, and those which keep all but the range of a law: beyond it the law is taken
    /// as straight, which for one that stiffens is the least that its force and peak may be.
    pub(super) fn lost(&self, looked: Option<&[Looked]>) -> Lost {
        let mut all = self.missing.all();
        let required = &self.evaluator.required;
        let is_exceeded = |own: &Looked, at: usize| {
            let value = own.required.get(at).copied().unwrap_or(f64::NAN);
            required[at].what.excess(value, 0.0) > 0.0
        };
        let ends = |own: &Required| {
            matches!(own.what, Requirement::Depth(_, DepthOf::Law | DepthOf::Radius))
        };
        for own in looked.into_iter().flatten() {
            let mut others = (0..required.len()).filter(|at| !ends(&required[*at]));
            let keeps_others = !others.any(|at| is_exceeded(own, at));
            let beyond = (0..required.len()).find_map(|at| match &required[at].what {
                Requirement::Depth(name, of)
                    if is_exceeded(own, at)
                        && (*of == DepthOf::Radius || *of == DepthOf::Law && keeps_others) =>
                {
                    Some(name)
                }
                _ => None,
            });
            let message = || "it is pressed beyond what is known of it".to_owned();
            let cause = beyond.map(|name| Cause::beyond(name, message()));
            all.extend(cause.map(|cause| (own.values.clone(), cause)));
        }
        let causes = all.iter().map(|(place, cause)| (cause, &place[..]));
        let unevaluated = Unevaluated::of(self.solved.load(Ordering::Relaxed), causes);
        let aims = all.iter().map(|own| self.evaluator.least_aim(&own.0)).collect();
        Lost { unevaluated, aims, cut: self.cut.load(Ordering::Relaxed) }
    }

    /// What designs come to.
    pub(super) fn looked(
        &self,
        places: &[Vec<f64>],
    ) -> (Vec<Looked>, Vec<Result<Evaluated, Cause>>) {
        let found = self.solved(places);
        let none = self.no_slack();
        let one = |(place, found): (&Vec<f64>, &Result<Evaluated, Cause>)| {
            let values = self.space.values(place);
            let (aim, required, excess) = match found {
                Ok(own) => (worst(&own.aims), own.values.clone(), self.excess(own, &none)),
                Err(_) => (f64::NAN, Vec::new(), f64::NAN),
            };
            Looked { values, aim, required, excess }
        };
        (places.iter().zip(&found).map(one).collect(), found)
    }

    /// The best design from these, where every requirement is drawn in by its slack.
    pub(super) fn best(&self, known: &Known, slack: &[f64]) -> (Found, Searched) {
        self.best_from(known, slack, &[])
    }

    /// The same with further starts.
    pub(super) fn best_from(
        &self,
        known: &Known,
        slack: &[f64],
        further: &[Vec<f64>],
    ) -> (Found, Searched) {
        // Those that keep everything first, by their aim; then by how much they exceed.
        let rank =
            |own: &Spread| (self.excess(&own.found, slack).max(ROOM), worst(&own.found.aims));
        let mut ranked: Vec<&Spread> = known.all.iter().collect();
        ranked.sort_by(|one, other| {
            let (one, other) = (rank(one), rank(other));
            one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1))
        });
        let starts: Vec<Vec<f64>> = further.iter().cloned().chain(self.starts(&ranked)).collect();
        let ends: Vec<Found> = starts.iter().filter_map(|own| self.from(own, slack)).collect();
        let better = |one: &Found, other: &Found| {
            let key = |own: &Found| (own.values[1].max(ROOM), own.values[0]);
            key(one).0.total_cmp(&key(other).0).then(key(one).1.total_cmp(&key(other).1))
        };
        let sought = ends.iter().min_by(|one, other| better(one, other)).cloned();
        let first = ranked[0];
        let of_spread = Found {
            unknowns: first.place.clone(),
            values: vec![worst(&first.found.aims), self.excess(&first.found, slack)],
        };
        let best = sought.filter(|own| better(own, &of_spread).is_le()).unwrap_or(of_spread);
        let alike = |own: &&Found| {
            own.values[1] <= ROOM
                && (own.values[0] - best.values[0]).abs() <= SAME * best.values[0].abs()
        };
        let agree = ends.iter().filter(alike).count();
        let starts = starts.len();
        let searched = Searched { starts, agree, ..self.looked_at(known, slack) };
        (best, searched)
    }

    /// What is told of the designs that were spread.
    pub(super) fn looked_at(&self, known: &Known, slack: &[f64]) -> Searched {
        let feasible = known.all.iter().filter(|own| self.excess(&own.found, slack) <= ROOM);
        let (feasible, designs, is_grid) = (feasible.count(), known.looked.len(), known.is_grid);
        Searched { designs, is_grid, starts: 0, agree: 0, feasible, solved: 0 }
    }

    pub(super) fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        self.space.values(unknowns)
    }

    pub(super) fn at(&self, unknowns: &[f64]) -> Option<Evaluated> {
        if self.is_over() {
            return None;
        }
        self.solved.fetch_add(1, Ordering::Relaxed);
        let values = self.values(unknowns);
        self.evaluator.at(&values).map_err(|cause| self.missing.note(values, cause)).ok()
    }

    /// The designs beside one along a number, with their places, within the bounds.
    pub(super) fn beside(&self, unknowns: &[f64], at: usize) -> [(f64, Option<Evaluated>); 2] {
        let step = self.space.step(at);
        [-step, step].map(|step| {
            let mut beside = unknowns.to_vec();
            beside[at] = (beside[at] + step).clamp(0.0, 1.0);
            (beside[at], self.at(&beside))
        })
    }

    /// The largest excess of anything.
    pub(super) fn excess(&self, found: &Evaluated, slack: &[f64]) -> f64 {
        self.excesses(found, slack).into_iter().fold(f64::NEG_INFINITY, f64_max)
    }

    pub(super) fn excesses(&self, found: &Evaluated, slack: &[f64]) -> Vec<f64> {
        let all = self.evaluator.required.iter().zip(&found.values).zip(slack);
        all.map(|((own, value), slack)| own.what.excess(*value, *slack)).collect()
    }

    /// Solves designs by all threads, in their order.
    fn solved(&self, places: &[Vec<f64>]) -> Vec<Result<Evaluated, Cause>> {
        self.solved.fetch_add(places.len(), Ordering::Relaxed);
        let all = self.shared(places, &|place: &Vec<f64>| self.evaluator.at(&self.values(place)));
        for (place, found) in places.iter().zip(&all) {
            if let Err(cause) = found {
                self.missing.note(self.values(place), cause.clone());
            }
        }
        all
    }

    /// Does the same to all of these by all threads, in their order.
    pub(super) fn shared<T: Sync, U: Send>(
        &self,
        all: &[T],
        one: &(dyn Fn(&T) -> U + Sync),
    ) -> Vec<U> {
        shared(self.effort.threads, all, one)
    }

    /// The best designs that are not beside each other.
    fn starts(&self, ranked: &[&Spread]) -> Vec<Vec<f64>> {
        let numbers = ranked.first().map_or(0, |own| own.place.len()).max(1);
        let apart = 1.5 / (self.effort.designs as f64).powf(1.0 / numbers as f64);
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for own in ranked {
            let is_near = |other: &Vec<f64>| {
                let each = own.place.iter().zip(other);
                each.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max) < apart
            };
            if starts.len() < self.effort.starts && !starts.iter().any(is_near) {
                starts.push(own.place.clone());
            }
        }
        starts
    }

    fn is_over(&self) -> bool {
        self.solved.load(Ordering::Relaxed) >= self.until.load(Ordering::Relaxed)
    }

    /// The best design from a start, its aim and largest excess; what exceeds is brought back first. None where that takes
    /// more designs than a search may look at.
    pub(super) fn from(&self, start: &[f64], slack: &[f64]) -> Option<Found> {
        let most = MOST_LOOKED * (start.len() + 1);
        self.until.store(self.solved.load(Ordering::Relaxed) + most, Ordering::Relaxed);
        let found = self.found_from(start, slack);
        self.cut.fetch_add(usize::from(self.is_over()), Ordering::Relaxed);
        self.until.store(usize::MAX, Ordering::Relaxed);
        found
    }

    fn found_from(&self, start: &[f64], slack: &[f64]) -> Option<Found> {
        let mut from = start.to_vec();
        if from.is_empty() {
            return None;
        }
        if self.excess(&self.at(&from)?, slack) > 0.0 {
            let epigraph = Epigraph::new(self, slack, false, &from)?;
            from = epigraph.least(&from)?;
        }
        let tests = self.at(&from)?.aims.len();
        let ended = if tests == 1 {
            let unit = self.at(&from)?.aims[0].abs().max(f64::MIN_POSITIVE);
            least(&Direct { search: self, slack, unit }, &from)?.unknowns
        } else {
            Epigraph::new(self, slack, true, &from)?.least(&from)?
        };
        let found = self.at(&ended)?;
        // A search that has ended outside has not found anything.
        let excess = self.excess(&found, slack);
        Some(Found { unknowns: ended, values: vec![worst(&found.aims), excess] })
    }

    /// Derivatives of aims and excesses by places.
    pub(super) fn slopes(&self, unknowns: &[f64], slack: &[f64]) -> Vec<[Vec<f64>; 2]> {
        let one = |at: usize| {
            let [below, above] = self.beside(unknowns, at);
            let width = above.0 - below.0;
            let sides = below.1.zip(above.1);
            let of = |own: Evaluated| (own.aims.clone(), self.excesses(&own, slack));
            let none = |count| vec![f64::NAN; count];
            let nothing = || [(); 2].map(|()| (none(self.evaluator.aims()), none(slack.len())));
            let [(aims, excesses), other] =
                sides.map_or_else(nothing, |(below, above)| [below, above].map(of));
            let slope = |one: &[f64], other: &[f64]| {
                one.iter().zip(other).map(|(one, other)| (other - one) / width).collect()
            };
            [slope(&aims, &other.0), slope(&excesses, &other.1)]
        };
        (0..unknowns.len()).map(one).collect()
    }
}

pub(super) fn f64_max(one: f64, other: f64) -> f64 {
    if one.is_nan() || other.is_nan() { f64::NAN } else { one.max(other) }
}

pub(super) fn worst(all: &[f64]) -> f64 {
    all.iter().copied().fold(f64::NEG_INFINITY, f64_max)
}
