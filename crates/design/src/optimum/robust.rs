//! Designs that bear the scatter of their numbers: limits are drawn in until enough of a sample keeps them.

use dashpot_analysis::{Odds, sweep::ScenePoint};

use super::{
    Borne, Design, DesignError, Effort, Problem, Searched,
    programme::Found,
    search::{Known, ROOM, Search},
};
use crate::shared::exceeded;

/// Rounds in which limits are drawn in.
const ROUNDS: usize = 6;
/// Limits are drawn in by so many standard deviations at most.
const MOST: f64 = 6.0;
/// Where too few designs keep everything, limits are drawn in by this part more.
const MORE: f64 = 1.02;
/// Numbers of standard deviations this near to each other, in parts of the larger one, are not told apart.
const NEAR: f64 = 0.02;

/// Poses the scattered designs of a test around these numbers.
pub type PoseScattered<'p> = dyn Fn(usize, &[f64]) -> Result<Vec<ScenePoint>, String> + Sync + 'p;

/// Scatter that a design has to bear.
#[derive(Clone, Copy)]
pub struct Scattered<'p> {
    /// The probability with which everything has to be kept, between 0 and 1.
    pub probability: f64,
    /// What poses them. The sample of each test has the same scattered numbers whenever it is asked for.
    pub pose: &'p PoseScattered<'p>,
}

/// The best numbers with which everything is kept in all tests with this probability, or more, as far as a sample of
/// scattered designs shows that. The limits are drawn in by a
/// number of standard deviations of what the sample makes of each of them, the same for all, that is sought.
///
/// What was borne is [told](Design::borne); where no search bears enough, the nearest to it is given.
///
/// # Errors
///
/// [`DesignError`].
pub fn robust(
    problem: &Problem<'_>,
    scattered: Scattered<'_>,
    effort: Effort,
) -> Result<Design, DesignError> {
    let search = Search::of(problem, None, effort)?;
    let known = search.known(&problem.begin())?;
    let none = search.no_slack();
    let (mut deviations, mut slack) = (0.0, none.clone());
    // By how many standard deviations limits are drawn in, and what too much of the sample exceeds then, where too few
    // designs keep everything, and where enough do.
    let (mut few, mut enough): ([f64; 2], Option<[f64; 2]>) = ([0.0; 2], None);
    let mut spreads = Vec::new();
    let mut found: Option<Design> = None;
    for _ in 0..ROUNDS {
        let begun = found.as_ref().map(|own| search.space.unknowns(&own.values));
        let (best, searched) = search.again(&known, &slack, begun.as_deref());
        let own = search.settled(best, searched, &known, slack.clone())?;
        let sample = search.sample(&own, scattered)?;
        let (kept, designs) = (sample.kept(0.0), sample.excesses.len());
        let unevaluated = sample.unevaluated;
        let wanted = scattered.probability;
        let borne = Borne { wanted, kept, designs, unevaluated, deviations };
        let Some(least) = borne.least() else {
            return Err(DesignError::TooFew { designs, least: Odds::least_designs(wanted) });
        };
        let share = least as f64 / designs as f64;
        let is_feasible = own.is_feasible;
        let is_better = |before: &Borne| match (borne.is_enough(), before.is_enough()) {
            (true, true) => deviations < before.deviations,
            (false, false) => kept > before.kept,
            (is_enough, _) => is_enough,
        };
        if found.as_ref().and_then(|own| own.borne).is_none_or(|own| is_better(&own)) {
            // Where no design keeps limits that are drawn in so far, this one is the nearest: it may keep those that are asked.
            let is_kept = own.kept.iter().all(|own| own.margin >= 0.0);
            let is_feasible = is_feasible || borne.is_enough() && is_kept;
            found = Some(Design { borne: Some(borne), is_feasible, ..own });
        }
        let exceeded = sample.exceeded(share);
        if borne.is_enough() {
            enough = Some([deviations, exceeded]);
        } else if is_feasible {
            few = [deviations, exceeded];
        } else {
            break;
        }
        let next = enough.map(|enough| between(few, enough));
        deviations = match (next, enough) {
            (Some(next), Some([most, _])) if most - next <= NEAR * most => break,
            (Some(next), _) => next,
            (None, _) => sample.deviations(share).max(MORE * few[0]),
        };
        if deviations > MOST {
            break;
        }
        // Those of one sample, so that what is drawn in depends on one number alone.
        if enough.is_none() {
            spreads.clone_from(&sample.spreads);
        }
        let drawn_in = spreads.iter().zip(&none);
        slack = drawn_in.map(|(own, none): (&f64, &f64)| (deviations * own).max(*none)).collect();
    }
    found.ok_or_else(|| DesignError::NotPosed("no sample of it can be solved".to_owned()))
}

/// Between too few and enough standard deviations, where nothing more than is allowed is exceeded, on the safe side.
fn between([few, exceeded]: [f64; 2], [enough, left]: [f64; 2]) -> f64 {
    let room = exceeded - left;
    let share = if room > 0.0 && room.is_finite() { exceeded / room } else { 0.5 };
    (few + (enough - few) * (share + 0.25 * NEAR)).min(enough)
}

/// A sample around a design.
struct Sample {
    /// By how much each design exceeds each requirement, in parts of its bound.
    excesses: Vec<Vec<f64>>,
    /// The same of the design without scatter.
    own: Vec<f64>,
    /// The standard deviation of each.
    spreads: Vec<f64>,
    /// Designs that could not be evaluated.
    unevaluated: usize,
}

impl Sample {
    /// How many of the designs keep everything, where limits are drawn in by so many more standard deviations.
    fn kept(&self, deviations: f64) -> usize {
        let is_kept = |all: &&Vec<f64>| {
            let each = all.iter().zip(&self.own).zip(&self.spreads);
            each.into_iter().all(|((excess, own), spread)| {
                let moved =
                    if deviations > 0.0 { own.min(-deviations * spread) - own } else { 0.0 };
                excess + moved <= 0.0
            })
        };
        self.excesses.iter().filter(is_kept).count()
    }

    /// What no more than this part of the designs stays within: below zero where they keep everything.
    fn exceeded(&self, share: f64) -> f64 {
        let most = |all: &Vec<f64>| all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        exceeded(self.excesses.iter().map(most).collect(), share)
    }

    /// By how many standard deviations limits have to be drawn in for this part of the designs to keep everything, if the
    /// sample moves with the design.
    fn deviations(&self, share: f64) -> f64 {
        let wanted = share * self.excesses.len() as f64;
        let (mut low, mut high) = (0.0, MOST);
        while high - low > 1e-3 {
            let middle = 0.5 * (low + high);
            if self.kept(middle) as f64 >= wanted {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}

impl Search<'_> {
    /// The best design again where limits have moved a little: from where it was, if that leads anywhere.
    fn again(&self, known: &Known, slack: &[f64], begun: Option<&[f64]>) -> (Found, Searched) {
        let (first, searched) = match begun {
            Some(begun) => (self.from(begun, slack), self.looked_at(known, slack)),
            None => return self.best(known, slack),
        };
        match first.filter(|own| own.values[1] <= ROOM) {
            Some(own) => (own, Searched { starts: 1, agree: 1, ..searched }),
            None => self.best(known, slack),
        }
    }

    fn sample(&self, design: &Design, scattered: Scattered<'_>) -> Result<Sample, DesignError> {
        let required = &self.evaluator.required;
        let mut values: Vec<Vec<f64>> = Vec::new();
        let mut missing = Vec::new();
        for test in 0..self.evaluator.tests() {
            let posed = (scattered.pose)(test, &design.values).map_err(DesignError::NotPosed)?;
            let count = required.iter().filter(|own| own.test == test).count();
            let of_test = self.shared(&posed, &|point: &ScenePoint| {
                self.evaluator.of_scattered(test, point, &design.values)
            });
            if values.is_empty() {
                values = vec![Vec::new(); of_test.len()];
                missing = vec![false; of_test.len()];
            }
            for ((all, is_missing), own) in values.iter_mut().zip(&mut missing).zip(of_test) {
                *is_missing |= own.is_err();
                all.extend(own.unwrap_or_else(|_| vec![f64::NAN; count]));
            }
        }
        // What cannot be solved keeps nothing.
        let excess = |at: usize, value: f64| {
            let own = required[at].what.excess(value, 0.0);
            if own.is_nan() { f64::INFINITY } else { own }
        };
        let excesses: Vec<Vec<f64>> = values
            .iter()
            .map(|all| all.iter().enumerate().map(|(at, own)| excess(at, *own)).collect())
            .collect();
        let spread = |at: usize| {
            let known: Vec<f64> =
                excesses.iter().map(|own| own[at]).filter(|own| own.is_finite()).collect();
            let count = known.len() as f64;
            let mean = known.iter().sum::<f64>() / count;
            let squares: f64 = known.iter().map(|own| (own - mean).powi(2)).sum();
            if known.len() > 1 { (squares / (count - 1.0)).sqrt() } else { 0.0 }
        };
        let spreads = (0..required.len()).map(spread).collect();
        let own = design.kept.iter().map(|own| -own.margin).collect();
        let unevaluated = missing.iter().filter(|own| **own).count();
        Ok(Sample { excesses, own, spreads, unevaluated })
    }
}
