//! A finite list of retardation times.

use super::{InvalidSpectrum, Retardation, Spectrum, approach, positive};

/// A spectrum of lines: `R(t) = Σ J_i (1 − e^(−t/λ_i))`.
///
/// A long list, measured or computed, can be reduced like any other spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    branches: Vec<Retardation>,
    compliance: f64,
}

impl List {
    /// A list of one or more elements. They are sorted by time, and those of the same time become
    /// one.
    ///
    /// # Errors
    ///
    /// A list that is empty, and times or compliances that are not positive and finite.
    pub fn new(mut branches: Vec<Retardation>) -> Result<Self, InvalidSpectrum> {
        for branch in &branches {
            positive("time", branch.time)?;
            positive("compliance", branch.compliance)?;
        }
        branches.sort_by(|a, b| a.time.total_cmp(&b.time));
        branches.dedup_by(|later, kept| {
            let same = later.time.total_cmp(&kept.time).is_eq();
            if same {
                kept.compliance += later.compliance;
            }
            same
        });
        let compliance = branches.iter().map(|branch| branch.compliance).sum();
        positive("compliance", compliance)?;
        Ok(Self { branches, compliance })
    }
}

impl Spectrum for List {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn creep(&self, time: f64) -> f64 {
        self.branches.iter().map(|branch| branch.compliance * approach(time / branch.time)).sum()
    }

    fn branches(&self) -> Option<&[Retardation]> {
        Some(&self.branches)
    }
}
