//! A sweep over the designs of a sample as bands and probabilities.

use std::slice;

use super::SweepReport;
use crate::{
    Band, Chance, Judgement, Limit, Odds, Reason, ScatterReport, ScatterSource,
    report::scatter::WANTED,
};

impl ScatterReport {
    /// What a sweep over the designs of a sample tells.
    pub fn of(sources: Vec<ScatterSource>, seed: u64, sweep: &SweepReport) -> Self {
        let columns = sweep.columns.iter().enumerate().filter(|own| !own.1.is_share);
        let bands = columns.map(|(at, own)| Band::of(&own.key, own.unit, sweep.column(at)));
        let judged = |(column, limit): &(usize, Limit)| -> Vec<Judgement> {
            let doubts = sweep.doubts(limit);
            let judge = |(design, value): (usize, f64)| {
                let grows = sweep.cut.contains(&(design, *column));
                limit.bound.judge(value, None, grows).doubted(doubts[design])
            };
            sweep.column(*column).enumerate().map(judge).collect()
        };
        let all: Vec<Vec<Judgement>> = sweep.limits.iter().map(judged).collect();
        let chance = |((_, limit), judged): (&(usize, Limit), &Vec<Judgement>)| {
            let count =
                |reason| judged.iter().filter(|own| **own == Judgement::Undecided(reason)).count();
            Chance {
                limit: limit.clone(),
                odds: Odds::of(slice::from_ref(judged)),
                beyond: count(Reason::Beyond) + count(Reason::NoLaw),
                outside: count(Reason::Outside),
            }
        };
        Self {
            sources,
            wanted: WANTED,
            designs: sweep.points(),
            seed,
            bands: bands.collect(),
            limits: sweep.limits.iter().zip(&all).map(chance).collect(),
            all_limits: (all.len() > 1).then(|| Odds::of(&all)),
            instantiated: sweep.instantiated,
            unevaluated: sweep.unevaluated(),
        }
    }
}
