//! What a search has found.

use dashpot_analysis::{Odds, RunReport, Unevaluated};
use serde::Serialize;

use super::{Required, search::SAME};

/// A change in parts of a value that is no more than rounding.
const MOVED: f64 = 1e-9;

/// What a requirement comes to in a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// The requirement.
    pub required: Required,
    /// The measure in SI units, or the part of what is known to which the pad or law is pressed.
    pub value: f64,
    /// What is left, in parts of the bound; negative where it is exceeded.
    pub margin: f64,
    /// Whether it holds the design where it is.
    pub is_active: bool,
    /// By how much the aim would change per unit of the bound \[SI units\]; of what is active alone.
    pub price: Option<f64>,
}

/// What a search could not evaluate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lost {
    /// How many designs, and why.
    pub unevaluated: Unevaluated,
    /// What the aim of each of them may be at least, in SI units: −∞ of a measure.
    pub aims: Vec<f64>,
    /// Searches that were given up, as they took more designs than one may.
    pub cut: usize,
}

impl Lost {
    /// How many of them may be better than a design with this aim; all of them, and what searches that were given up would
    /// have found, where there is none.
    pub fn open(&self, aim: Option<f64>) -> usize {
        let is_open = |least: &&f64| aim.is_none_or(|aim| **least < aim - SAME * aim.abs());
        self.aims.iter().filter(is_open).count() + if aim.is_none() { self.cut } else { 0 }
    }
}

/// A design.
#[derive(Debug)]
pub struct Design {
    /// The numbers, in SI units.
    pub values: Vec<f64>,
    /// The aim, in the worst test.
    pub aim: f64,
    /// What is required, test by test.
    pub kept: Vec<Kept>,
    /// For each number the change of the aim and of what is required, per unit of it; where numbers have a given sum, it
    /// is taken from those behind it, and the last one has none.
    pub slopes: Vec<Slope>,
    /// Which numbers are at a bound.
    pub at_bound: Vec<Option<Side>>,
    /// Whether everything is kept; else it is the design that exceeds the least, in parts of the bounds.
    pub is_feasible: bool,
    /// How it was found.
    pub search: Searched,
    /// The designs that were spread, in the order of a grid, the last number fastest.
    pub spread: Vec<Looked>,
    /// What could not be evaluated on the way.
    pub lost: Lost,
    /// What scatter leaves of it, where it was asked to bear some.
    pub borne: Option<Borne>,
    /// Its runs, one for each test, with their errors.
    pub runs: Vec<RunReport>,
}

impl Design {
    /// The least that is left to anything, in parts of its bound; negative where it is exceeded.
    pub fn least_margin(&self) -> f64 {
        self.kept.iter().map(|own| own.margin).fold(f64::INFINITY, f64::min)
    }

    /// Whether a number changes anything that is required beside this design, or what is made least where that is a
    /// measure; true where that is not known.
    pub fn moves(&self, number: usize, aim_is_measure: bool) -> bool {
        let Some(slope) = self.slopes.get(number) else { return true };
        // What rounding makes of two runs that are the same.
        let moves = |slope: f64, value: f64| {
            let change = (slope * self.values[number]).abs();
            change.is_nan() || change > MOVED * value.abs()
        };
        let required = slope.values.iter().zip(&self.kept);
        let of_aim = aim_is_measure && moves(slope.aim, self.aim);
        of_aim || required.into_iter().any(|(own, kept)| moves(*own, kept.value))
    }

    /// To which side a number may be rounded so that what holds the design is kept as well as before; `None` where nothing
    /// does, or some of it would be kept worse on either side.
    pub fn safe_side(&self, number: usize) -> Option<Side> {
        if !self.is_feasible || self.at_bound[number].is_some() {
            return None;
        }
        let slopes = &self.slopes.get(number)?.values;
        let active = slopes.iter().zip(&self.kept).filter(|own| own.1.is_active);
        let sides = active.filter_map(|(slope, own)| {
            let what = &own.required.what;
            let rising = slope * (what.excess(1.0, 0.0) - what.excess(0.0, 0.0));
            (rising != 0.0).then_some(if rising > 0.0 { Side::Low } else { Side::High })
        });
        let mut sides = sides.collect::<Vec<_>>().into_iter();
        let first = sides.next()?;
        sides.all(|own| own == first).then_some(first)
    }

    /// Whether no other test leaves less to what is required here; of those that leave as much it is the first.
    pub fn decides(&self, own: &Kept) -> bool {
        let alike =
            self.kept.iter().filter(|other| other.required.what.is_like(&own.required.what));
        let first = alike.min_by(|one, other| one.margin.total_cmp(&other.margin));
        first.is_some_and(|first| first.required == own.required)
    }
}

/// A design that was looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Looked {
    /// The numbers, in SI units.
    pub values: Vec<f64>,
    /// The aim in the worst test; not a number where the design cannot be solved.
    pub aim: f64,
    /// What each requirement comes to, in the order of [`Design::kept`]; empty where it cannot be solved.
    pub required: Vec<f64>,
    /// The largest excess of anything, in parts of its bound.
    pub excess: f64,
}

/// What a sample of scattered designs keeps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Borne {
    /// The probability with which everything has to be kept.
    pub wanted: f64,
    /// Those that keep it …
    pub kept: usize,
    /// … of so many.
    pub designs: usize,
    /// Those that could not be evaluated, and count as not kept.
    pub unevaluated: usize,
    /// How far limits are drawn in, in standard deviations of what the sample makes of each.
    pub deviations: f64,
}

impl Borne {
    /// Whether so many of them keep everything that the probability is what is wanted, however the sample was drawn.
    pub fn is_enough(&self) -> bool {
        self.least().is_some_and(|least| self.kept >= least)
    }

    /// Whether so many may keep everything if those do that could not be evaluated.
    pub fn may_be_enough(&self) -> bool {
        self.least().is_some_and(|least| self.kept + self.unevaluated >= least)
    }

    /// How many of them have to keep everything, as by [`Odds::least_kept`].
    pub fn least(&self) -> Option<usize> {
        Odds::least_kept(self.wanted, self.designs)
    }
}

/// Derivatives with respect to one number.
#[derive(Debug, Clone, PartialEq)]
pub struct Slope {
    /// Of the aim in the worst test.
    pub aim: f64,
    /// Of each requirement's value.
    pub values: Vec<f64>,
}

/// A bound of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The least value.
    Low,
    /// The largest.
    High,
}

/// How a design was found.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Searched {
    /// Designs that were spread over the bounds.
    pub designs: usize,
    /// Whether those are all points of a grid.
    pub is_grid: bool,
    /// Starts of the search …
    pub starts: usize,
    /// … and how many of them ended there.
    pub agree: usize,
    /// Designs of which everything is kept, among those that were spread.
    pub feasible: usize,
    /// Designs that were solved in all.
    pub solved: usize,
}

/// The best designs of two aims: none of them has less of one without more of the other.
#[derive(Debug)]
pub struct Front {
    /// From the least of the first aim to the least of the second.
    pub points: Vec<FrontPoint>,
}

/// A design of a front.
#[derive(Debug)]
pub struct FrontPoint {
    /// The least of the first aim …
    pub design: Design,
    /// … where the second one, in the worst test, is at most this.
    pub other: f64,
}
