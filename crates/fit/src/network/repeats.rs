//! One test that was repeated: what tells its records apart is noise, whatever the model makes of them.

use serde::Serialize;

use super::{certainty::correlation, residuals::Task};

/// Fewer rows that records have in common tell nothing.
const FEWEST: usize = 8;

/// What the records of a test that was repeated differ by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scatter {
    /// Standard deviation of a row; behind a filter of a sample before it.
    pub deviation: f64,
    /// How many of its rows stand for one that is independent.
    pub correlation: f64,
    /// How many records there are.
    pub records: usize,
}

impl Task<'_> {
    /// The scatter of the records that repeat a test, once each has its own clock and zero; `None` where it was not
    /// repeated.
    pub(super) fn scatter(&self, test: usize, unknowns: &[f64]) -> Option<Scatter> {
        let group = self.tests()[test].repeated?;
        let is_one = |own: &usize| self.tests()[*own].repeated == Some(group);
        let members: Vec<usize> = (0..self.tests().len()).filter(is_one).collect();
        let parts: Vec<_> = self.parts().collect();
        let left = self.left(unknowns);
        let rows = |own: usize| -> Vec<f64> {
            left[parts[own].clone()].iter().map(|row| self.unit(own) * row).collect()
        };
        // By the same time of the model, to the nearest row: what is left is noise, or changes slowly.
        let first = |own: usize| self.rows_before(own, self.own(own, unknowns).shift);
        let all: Vec<Vec<f64>> = members.iter().map(|own| rows(*own)).collect();
        let firsts: Vec<usize> = members.iter().map(|own| first(*own)).collect();
        let before = firsts.iter().copied().min()?;
        let behind = all.iter().zip(&firsts).map(|(rows, first)| rows.len() - first).min()?;
        if members.len() < 2 || before + behind < FEWEST {
            return None;
        }
        let common: Vec<&[f64]> = all
            .iter()
            .zip(&firsts)
            .map(|(rows, first)| &rows[first - before..first + behind])
            .collect();
        let count = common.len() as f64;
        let mean = |row: usize| common.iter().map(|own| own[row]).sum::<f64>() / count;
        let means: Vec<f64> = (0..before + behind).map(mean).collect();
        let apart = |own: &&[f64]| -> Vec<f64> {
            own.iter().zip(&means).map(|(one, mean)| one - mean).collect()
        };
        let apart: Vec<Vec<f64>> = common.iter().map(apart).collect();
        let square: f64 = apart.iter().flatten().map(|own| own * own).sum();
        let variance = square / ((count - 1.0) * means.len() as f64);
        let correlations = apart.iter().map(|own| correlation(own));
        (variance > 0.0).then(|| Scatter {
            deviation: variance.sqrt(),
            correlation: correlations.sum::<f64>() / count,
            records: members.len(),
        })
    }
}
