//! What was found is moved inwards by its errors, and told: what holds it, and what more of anything would change.

use std::sync::atomic::Ordering;

use dashpot_analysis::Judgement;
use dashpot_numerics::decompositions::singular;
use nalgebra::{DMatrix, DVector};

use super::{
    Design, DesignError, Kept, Lost, Requirement, Searched, Side, Slope,
    evaluate::Evaluated,
    programme::Found,
    search::{DRAWN_IN, Known, ROOM, Search, worst},
};

/// What is within this part of its bound, or of the room between bounds, is at it.
const ACTIVE: f64 = 1e-4;
/// Bounds are drawn in by so many times the error of what is judged.
const ERRORS: f64 = 2.0;
/// How often a design is moved inwards.
const MOVES: usize = 3;

impl Search<'_> {
    /// Moves a design inwards until its errors do not reach across what it has to keep, and tells of it.
    pub(super) fn settled(
        &self,
        mut best: Found,
        mut searched: Searched,
        known: &Known,
        mut slack: Vec<f64>,
    ) -> Result<Design, DesignError> {
        let is_feasible = best.values[1] <= ROOM && best.values[0].is_finite();
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
        let spread = known.looked.clone();
        let told = self.told(&best, &slack, (searched, is_feasible))?;
        searched.solved = self.solved.load(Ordering::Relaxed);
        let lost = self.lost((!is_feasible).then_some(&spread[..]));
        Ok(Design { search: searched, spread, lost, runs, ..told })
    }

    fn told(
        &self,
        best: &Found,
        slack: &[f64],
        (search, is_feasible): (Searched, bool),
    ) -> Result<Design, DesignError> {
        let values = self.values(&best.unknowns);
        let found = self.evaluator.at(&values);
        let found = found.map_err(|cause| DesignError::NotPosed(cause.message))?;
        let slopes = self.slopes_of(&best.unknowns, &found);
        let excess = |at: usize| self.evaluator.required[at].what.excess(found.values[at], 0.0);
        let side = |(at, value): (usize, &f64)| match self.space.alone(at, *value) {
            own if own <= ACTIVE => Some(Side::Low),
            own if own >= 1.0 - ACTIVE => Some(Side::High),
            _ => None,
        };
        let at_bound: Vec<Option<Side>> = values.iter().enumerate().map(side).collect();
        let active: Vec<usize> =
            (0..found.values.len()).filter(|at| excess(*at) + slack[*at] > -ACTIVE).collect();
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
        let (spread, lost, borne, runs) = (Vec::new(), Lost::default(), None, Vec::new());
        Ok(Design {
            values,
            aim,
            kept,
            slopes,
            at_bound,
            is_feasible,
            search,
            spread,
            lost,
            borne,
            runs,
        })
    }

    /// Derivatives in SI units by numbers in SI units.
    fn slopes_of(&self, unknowns: &[f64], found: &Evaluated) -> Vec<Slope> {
        let at_worst = (0..found.aims.len())
            .max_by(|one, other| found.aims[*one].total_cmp(&found.aims[*other]))
            .unwrap_or(0);
        let nothing = || Slope { aim: f64::NAN, values: vec![f64::NAN; found.values.len()] };
        let mut all: Vec<Slope> = vec![nothing(); self.values(unknowns).len()];
        for (unknown, number) in self.space.free().enumerate() {
            let [below, above] = self.beside(unknowns, unknown);
            let Some((one, other)) = below.1.zip(above.1) else { continue };
            let value = |place: f64| {
                let mut beside = unknowns.to_vec();
                beside[unknown] = place;
                self.values(&beside)[number]
            };
            let width = value(above.0) - value(below.0);
            let slope = |one: f64, other: f64| (other - one) / width;
            let values = one.values.iter().zip(&other.values);
            all[number] = Slope {
                aim: slope(one.aims[at_worst], other.aims[at_worst]),
                values: values.map(|(one, other)| slope(*one, *other)).collect(),
            };
        }
        all
    }

    /// By how much the aim changes with the bound of each active requirement: multipliers of Lagrange, from the
    /// numbers that are not at a bound themselves.
    fn prices(&self, slopes: &[Slope], active: &[usize], at_bound: &[Option<Side>]) -> Vec<f64> {
        let free: Vec<usize> = self.space.free().filter(|at| at_bound[*at].is_none()).collect();
        if free.is_empty() || active.is_empty() {
            return vec![f64::NAN; active.len()];
        }
        let unit = |at: usize| self.space.room(free[at]);
        let matrix = DMatrix::from_fn(free.len(), active.len(), |row, column| {
            slopes[free[row]].values[active[column]] * unit(row)
        });
        let right = DVector::from_fn(free.len(), |row, _| slopes[free[row]].aim * unit(row));
        let is_finite = right.iter().all(|own| own.is_finite());
        let solved = singular(&matrix).filter(|_| is_finite);
        let solved = solved.and_then(|own| own.solve(&right, 1e-9).ok());
        solved.map_or_else(|| vec![f64::NAN; active.len()], |own| own.iter().copied().collect())
    }
}
