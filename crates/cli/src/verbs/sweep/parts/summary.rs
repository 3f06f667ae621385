//! What is known of some points, and adds up.

use std::collections::BTreeSet;

use dashpot_analysis::{
    Judgement,
    partial::Cost,
    sweep::{PartialOfSweep, SweepReport, SweepWarning},
};
use serde::{Deserialize, Serialize};

use crate::output::list;
use dashpot_report::numbers::apart;

/// What is known of some points.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(super) struct Summary {
    pub(super) points: usize,
    /// How many of them were instantiated.
    pub(super) instantiated: usize,
    /// At how many of them errors were estimated by further solutions.
    pub(super) estimated: usize,
    /// Why some have no solution, and how many.
    pub(super) failed: Vec<Counted>,
    /// The lowest and the highest value of each measure; `None` where there is none.
    pub(super) extremes: Vec<Option<[f64; 2]>>,
    /// How many keep each limit.
    pub(super) limits: Vec<Kept>,
    /// What runs are warned of: by the code of each warning at how many points, and what it says at the first one.
    pub(super) warnings: Vec<Counted>,
    /// How many instantiated points were solved in full as well, and the largest difference there.
    pub(super) checked: Option<(usize, f64)>,
    /// How many values may still grow after the end of their runs.
    pub(super) cut: usize,
    /// What was left out of all points, where the scene allows that.
    pub(super) left_out: Option<LeftOut>,
}

/// What was left out, and by which part of its size that moves a measure at the most.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct LeftOut {
    bound: f64,
    effects: Vec<String>,
    moves: f64,
}

impl LeftOut {
    fn of(own: &PartialOfSweep) -> Self {
        let effects = list(own.left_out.iter().map(|own| own.effect.clone()));
        Self { bound: own.bound, effects, moves: own.worst.as_ref().map_or(0.0, Cost::most) }
    }

    pub(super) fn in_words(&self) -> String {
        let names =
            if self.effects.is_empty() { "nothing".to_owned() } else { self.effects.join(", ") };
        format!("left out everywhere: {names}; no measure moves by more than {}", apart(self.moves))
    }
}

/// What is said of some points.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Counted {
    /// What it is counted by.
    pub(super) code: String,
    pub(super) text: String,
    pub(super) points: usize,
    /// The first of them, by its number in the whole grid, from 0.
    pub(super) first: usize,
}

/// How many points keep a limit.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Kept {
    pub(super) pass: usize,
    pub(super) fail: usize,
    pub(super) undecided: usize,
}

impl Summary {
    /// What is known of the points of a report, the first of which has the number `start` in the whole grid.
    pub(super) fn of(report: &SweepReport, start: usize) -> Self {
        let failed = report.gaps.iter().filter(|own| own.column.is_none()).map(|own| {
            let text = own.cause.message.clone();
            Counted { code: text.clone(), text, points: 1, first: start + own.point }
        });
        let extremes = |at: usize| {
            let finite = report.column(at).filter(|own| own.is_finite());
            finite.map(|own| [own, own]).reduce(widest)
        };
        let kept = |at: usize| {
            let mut kept = Kept::default();
            for own in report.judged(at).into_iter().flatten() {
                *match own {
                    Judgement::Pass => &mut kept.pass,
                    Judgement::Fail => &mut kept.fail,
                    Judgement::Undecided(_) => &mut kept.undecided,
                } += 1;
            }
            kept
        };
        let mut own = Self {
            points: report.points(),
            instantiated: report.instantiated,
            estimated: report.estimated,
            extremes: list((0..report.columns.len()).map(extremes)),
            limits: list((0..report.limits.len()).map(kept)),
            left_out: report.partial.as_ref().map(LeftOut::of),
            checked: (!report.checked.is_empty())
                .then_some((report.checked.len(), report.largest_difference)),
            cut: report.cut.len(),
            ..Self::default()
        };
        failed.for_each(|one| count(&mut own.failed, one));
        warned(report, start).for_each(|one| count(&mut own.warnings, one));
        own
    }

    /// Adds what is known of further points.
    pub(super) fn add(&mut self, other: Self) {
        self.points += other.points;
        self.instantiated += other.instantiated;
        self.estimated += other.estimated;
        self.extremes.resize(other.extremes.len(), None);
        for (own, other) in self.extremes.iter_mut().zip(other.extremes) {
            *own = own.iter().copied().chain(other).reduce(widest);
        }
        self.limits.resize(other.limits.len(), Kept::default());
        for (own, other) in self.limits.iter_mut().zip(other.limits) {
            own.pass += other.pass;
            own.fail += other.fail;
            own.undecided += other.undecided;
        }
        // Those of the whole sweep, whichever part tells them.
        self.checked = match (self.checked, other.checked) {
            (Some(own), Some(other)) => Some((own.0.max(other.0), own.1.max(other.1))),
            (own, other) => own.or(other),
        };
        self.cut += other.cut;
        self.left_out = self.left_out.take().or(other.left_out);
        other.failed.into_iter().for_each(|one| count(&mut self.failed, one));
        other.warnings.into_iter().for_each(|one| count(&mut self.warnings, one));
    }

    /// How many points have no solution.
    pub(super) fn unsolved(&self) -> usize {
        self.failed.iter().map(|own| own.points).sum()
    }
}

/// What runs are warned of, by code: of several parts of a scene each point counts once.
fn warned(report: &SweepReport, start: usize) -> impl Iterator<Item = Counted> {
    let mut all: Vec<(BTreeSet<usize>, &SweepWarning)> = Vec::new();
    for own in &report.warnings {
        match all.iter_mut().find(|known| known.1.warning.code() == own.warning.code()) {
            Some((points, first)) => {
                if own.points.first() < points.first() {
                    *first = own;
                }
                points.extend(&own.points);
            }
            None => all.push((own.points.iter().copied().collect(), own)),
        }
    }
    all.into_iter().map(move |(points, own)| Counted {
        code: own.warning.code().to_owned(),
        text: own.warning.to_string(),
        points: points.len(),
        first: start + points.first().copied().unwrap_or_default(),
    })
}

fn widest(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [one[0].min(other[0]), one[1].max(other[1])]
}

/// So many kinds are told apart: reasons why points fail may have numbers of their own, as many as there are points.
const MOST_KINDS: usize = 100;
const OTHERS: &str = "others";

fn count(all: &mut Vec<Counted>, own: Counted) {
    let is_full = all.len() >= MOST_KINDS;
    let is_it = |known: &&mut Counted| known.code == own.code || (is_full && known.code == OTHERS);
    match all.iter_mut().rev().find(is_it) {
        Some(known) => known.points += own.points,
        None if is_full => all.push(Counted { code: OTHERS.to_owned(), ..own }),
        None => all.push(own),
    }
}
