//! The way to the best design: spread designs, searches from the best of them, and a look at what was found.

use std::{
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

use dashpot_analysis::Judgement;
use nalgebra::{DMatrix, DVector};

use super::{
    Design, DesignError, Effort, Kept, Requirement, Searched, Side, Slope,
    aims::{Direct, Epigraph},
    evaluate::{Evaluated, Evaluator},
    programme::{Found, least},
    spread::{Place, spread},
};

/// What a design may exceed a bound by, in parts of it, and still count as keeping it in a search.
const ROOM: f64 = 1e-7;
/// What is within this part of its bound, or of the room between bounds, is at it.
const ACTIVE: f64 = 1e-4;
/// Searches that end with aims this near each other have found one design.
const SAME: f64 = 1e-5;
/// Bounds are drawn in by this part of them, and by so many times the error of what is judged.
const DRAWN_IN: f64 = 1e-6;
const ERRORS: f64 = 2.0;
/// How often a design is moved inwards.
const MOVES: usize = 3;

/// A search.
pub(super) struct Search<'p> {
    pub(super) evaluator: Evaluator<'p>,
    places: Vec<Place>,
    effort: Effort,
    solved: AtomicUsize,
}

/// A design that was spread.
struct Spread {
    place: Vec<f64>,
    found: Evaluated,
}

impl<'p> Search<'p> {
    pub(super) fn new(evaluator: Evaluator<'p>, places: Vec<Place>, effort: Effort) -> Self {
        Self { evaluator, places, effort, solved: AtomicUsize::new(0) }
    }

    /// The best design.
    pub(super) fn found(self, begin: &[f64]) -> Result<Design, DesignError> {
        let none = vec![0.0; self.evaluator.required.len()];
        let (mut spread, is_grid) = spread(self.places.len(), self.effort.designs);
        let designs = spread.len();
        let places = self.places.iter().zip(begin);
        spread.push(places.map(|(place, value)| place.place(*value)).collect());
        let (mut known, why) = self.solved(&spread);
        if known.is_empty() {
            return Err(DesignError::Nothing(why.unwrap_or_default()));
        }
        let feasible = known.iter().filter(|own| self.excess(&own.found, &none) <= ROOM).count();
        // Those that keep everything first, by their aim; then by how much they exceed.
        let rank = |own: &Spread| {
            let excess = self.excess(&own.found, &none).max(ROOM);
            (excess, worst(&own.found.aims))
        };
        known.sort_by(|one, other| {
            let (one, other) = (rank(one), rank(other));
            one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1))
        });
        let starts: Vec<Vec<f64>> = self.starts(&known);
        let ends: Vec<Found> = starts.iter().filter_map(|own| self.from(own, &none)).collect();
        let better = |one: &Found, other: &Found| {
            let key = |own: &Found| (own.values[1].max(ROOM), own.values[0]);
            key(one).0.total_cmp(&key(other).0).then(key(one).1.total_cmp(&key(other).1))
        };
        let sought = ends.iter().min_by(|one, other| better(one, other)).cloned();
        let of_spread = Found {
            unknowns: known[0].place.clone(),
            values: vec![worst(&known[0].found.aims), self.excess(&known[0].found, &none)],
        };
        let best = sought.filter(|own| better(own, &of_spread).is_le()).unwrap_or(of_spread);
        let alike = |own: &&Found| {
            own.values[1] <= ROOM
                && (own.values[0] - best.values[0]).abs() <= SAME * best.values[0].abs()
        };
        let agree = ends.iter().filter(alike).count();
        let searched =
            Searched { designs, is_grid, starts: starts.len(), agree, feasible, solved: 0 };
        self.settled(best, searched)
    }

    /// Moves a design inwards until its errors do not reach across what it has to keep, and tells of it.
    fn settled(self, mut best: Found, mut searched: Searched) -> Result<Design, DesignError> {
        let required = self.evaluator.required.len();
        let mut slack = vec![0.0; required];
        let is_feasible = best.values[1] <= ROOM;
        let mut runs = Vec::new();
        for at in 0..=MOVES {
            let values = self.values(&best.unknowns);
            let all = 0..self.evaluator.tests();
            runs =
                all.map(|test| self.evaluator.run(test, &values)).collect::<Result<Vec<_>, _>>()?;
            if !is_feasible || at == MOVES {
                break;
            }
            let mut is_open = false;
            for (own, slack) in self.evaluator.required.iter().zip(&mut slack) {
                let Requirement::Limit(limit) = &own.what else { continue };
                let judged = runs[own.test].judged();
                let judged = judged.iter().find(|judged| judged.limit.is_same(limit));
                let Some(judged) = judged.filter(|own| own.judgement != Judgement::Pass) else {
                    continue;
                };
                let size = limit.bound.level().abs().max(f64::MIN_POSITIVE);
                let error = judged.error().filter(|own| own.is_finite()).unwrap_or(0.0);
                *slack += ERRORS * error / size + DRAWN_IN;
                is_open = true;
            }
            if !is_open {
                break;
            }
            let Some(moved) = self.from(&best.unknowns, &slack) else { break };
            best = Found { values: vec![moved.values[0], moved.values[1]], ..moved };
        }
        searched.solved = self.solved.load(Ordering::Relaxed);
        self.told(&best, (searched, is_feasible), runs)
    }

    fn told(
        self,
        best: &Found,
        (searched, is_feasible): (Searched, bool),
        runs: Vec<dashpot_analysis::RunReport>,
    ) -> Result<Design, DesignError> {
        let values = self.values(&best.unknowns);
        let found = self.evaluator.at(&values).map_err(DesignError::NotPosed)?;
        let slopes = self.slopes_of(&best.unknowns, &found);
        let excess = |at: usize| self.evaluator.required[at].what.excess(found.values[at], 0.0);
        let at_bound: Vec<Option<Side>> = best
            .unknowns
            .iter()
            .map(|own| match *own {
                own if own <= ACTIVE => Some(Side::Low),
                own if own >= 1.0 - ACTIVE => Some(Side::High),
                _ => None,
            })
            .collect();
        let active: Vec<usize> =
            (0..found.values.len()).filter(|at| excess(*at) > -ACTIVE).collect();
        let prices = self.prices(&slopes, &active, &at_bound);
        let kept = self.evaluator.required.iter().enumerate().map(|(at, required)| {
            let place = active.iter().position(|own| *own == at);
            let price = place.filter(|_| is_feasible).map(|place| prices[place]);
            Kept {
                required: required.clone(),
                value: found.values[at],
                margin: -excess(at),
                is_active: place.is_some(),
                price,
            }
        });
        let kept = kept.collect();
        let aim = worst(&found.aims);
        Ok(Design { values, aim, kept, slopes, at_bound, is_feasible, search: searched, runs })
    }

    /// Derivatives in SI units by numbers in SI units.
    fn slopes_of(&self, unknowns: &[f64], found: &Evaluated) -> Vec<Slope> {
        let at_worst = (0..found.aims.len())
            .max_by(|one, other| found.aims[*one].total_cmp(&found.aims[*other]))
            .unwrap_or(0);
        let one = |at: usize| {
            let [below, above] = self.beside(unknowns, at);
            let width = self.places[at].value(above.0) - self.places[at].value(below.0);
            let sides = below.1.zip(above.1);
            let nothing = || Slope { aim: f64::NAN, values: vec![f64::NAN; found.values.len()] };
            sides.map_or_else(nothing, |(below, above)| {
                let slope = |one: f64, other: f64| (other - one) / width;
                let values = below.values.iter().zip(&above.values);
                Slope {
                    aim: slope(below.aims[at_worst], above.aims[at_worst]),
                    values: values.map(|(one, other)| slope(*one, *other)).collect(),
                }
            })
        };
        (0..unknowns.len()).map(one).collect()
    }

    /// By how much the aim changes with the bound of each active requirement: multipliers of Lagrange, from the
    /// numbers that are not at a bound themselves.
    fn prices(&self, slopes: &[Slope], active: &[usize], at_bound: &[Option<Side>]) -> Vec<f64> {
        let free: Vec<usize> = (0..slopes.len()).filter(|at| at_bound[*at].is_none()).collect();
        if free.is_empty() || active.is_empty() {
            return vec![f64::NAN; active.len()];
        }
        let unit = |at: usize| self.places[free[at]].room();
        let matrix = DMatrix::from_fn(free.len(), active.len(), |row, column| {
            slopes[free[row]].values[active[column]] * unit(row)
        });
        let right = DVector::from_fn(free.len(), |row, _| slopes[free[row]].aim * unit(row));
        let is_finite = matrix.iter().chain(right.iter()).all(|own| own.is_finite());
        let solved = is_finite.then(|| matrix.svd(true, true).solve(&right, 1e-9).ok()).flatten();
        solved.map_or_else(|| vec![f64::NAN; active.len()], |own| own.iter().copied().collect())
    }

    fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        unknowns.iter().zip(&self.places).map(|(own, place)| place.value(*own)).collect()
    }

    pub(super) fn at(&self, unknowns: &[f64]) -> Option<Evaluated> {
        self.solved.fetch_add(1, Ordering::Relaxed);
        self.evaluator.at(&self.values(unknowns)).ok()
    }

    /// The designs beside one along a number, with their places, within the bounds.
    fn beside(&self, unknowns: &[f64], at: usize) -> [(f64, Option<Evaluated>); 2] {
        let step = self.places[at].step();
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

    /// Solves designs by all threads, in their order; those that could be, and why the first of the others could not.
    fn solved(&self, spread: &[Vec<f64>]) -> (Vec<Spread>, Option<String>) {
        let threads = self.effort.threads.max(1);
        let each = spread.len().div_ceil(threads).max(1);
        let work = |part: &[Vec<f64>]| {
            let one = |place: &Vec<f64>| self.evaluator.at(&self.values(place));
            part.iter().map(one).collect::<Vec<_>>()
        };
        let found = thread::scope(|scope| {
            let parts: Vec<_> =
                spread.chunks(each).map(|part| scope.spawn(move || work(part))).collect();
            parts.into_iter().flat_map(|own| own.join().unwrap_or_default()).collect::<Vec<_>>()
        });
        self.solved.fetch_add(spread.len(), Ordering::Relaxed);
        let why = found.iter().find_map(|own| own.as_ref().err().cloned());
        let known = spread.iter().zip(found).filter_map(|(place, found)| {
            let found = found.ok()?;
            let is_whole = found.aims.iter().chain(&found.values).all(|own| own.is_finite());
            is_whole.then(|| Spread { place: place.clone(), found })
        });
        (known.collect(), why)
    }

    /// The best designs that are not beside each other.
    fn starts(&self, known: &[Spread]) -> Vec<Vec<f64>> {
        let apart = 1.5 / (self.effort.designs as f64).powf(1.0 / self.places.len().max(1) as f64);
        let mut starts: Vec<Vec<f64>> = Vec::new();
        for own in known {
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

    /// The best design from a start, its aim and largest excess; what exceeds is brought back first.
    fn from(&self, start: &[f64], slack: &[f64]) -> Option<Found> {
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
            let [(aims, excesses), other] = match sides {
                Some((below, above)) => [below, above].map(|own| {
                    let excesses = self.excesses(&own, slack);
                    (own.aims, excesses)
                }),
                None => Default::default(),
            };
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
