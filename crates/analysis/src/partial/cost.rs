//! How far measures are moved by what is left out.

use crate::{MeasureReport, RunReport};

/// How far a measure is moved by what was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Cost {
    /// Key of the measure, for instance `padding.peak-force`.
    pub measure: String,
    /// The difference over the larger of both sizes; infinite where only one has a value.
    pub relative: f64,
    /// How far it may be off, by the errors of both, in parts of the same size; 0 where they were
    /// not estimated.
    pub uncertainty: f64,
}

impl Cost {
    /// The largest move that the errors allow.
    pub fn most(&self) -> f64 {
        self.relative + self.uncertainty
    }

    /// The one of both that is larger.
    pub(super) fn larger(self, other: Self) -> Self {
        if other.most() > self.most() { other } else { self }
    }
}

/// A network's measures with and without something.
#[derive(Debug, Clone)]
pub(super) struct Comparison {
    /// One for each measure that both have.
    pub(super) costs: Vec<Cost>,
    /// Measures of what does not exist without it.
    pub(super) unreported: Vec<String>,
}

impl Comparison {
    /// Compares a run with that of a reduced network.
    pub(super) fn of(full: &RunReport, reduced: &RunReport) -> Self {
        let (mut costs, mut unreported) = (Vec::new(), Vec::new());
        for measure in &full.measures {
            let target = measure.target.as_str();
            match reduced.measure(&measure.key) {
                Some(other) => costs.push(cost(measure, other)),
                None if exists(reduced, target) => costs.push(infinite(measure)),
                None => unreported.push(measure.key.clone()),
            }
        }
        Self { costs, unreported }
    }

    /// The measure that moves the most.
    pub(super) fn worst(&self) -> Option<&Cost> {
        self.costs.iter().max_by(|one, other| one.most().total_cmp(&other.most()))
    }

    /// Whether no measure moves by more than the bound, however the errors lie.
    pub(super) fn is_within(&self, bound: f64) -> bool {
        self.costs.iter().all(|cost| cost.most() <= bound)
    }
}

/// The reduced run with the errors of its measures widened by what was left out.
pub(super) fn charged(mut reduced: RunReport, full: &RunReport) -> RunReport {
    for measure in &mut reduced.measures {
        let Some(opposite) = full.measure(&measure.key) else { continue };
        if let (Some(value), Some(right), Some(error)) =
            (measure.value, opposite.value, opposite.error)
        {
            // The difference from the value that is known to be this good.
            measure.error = Some((value - right).abs() + error);
        }
    }
    reduced
}

/// Whether the network of a run has a node or element of this name.
fn exists(report: &RunReport, name: &str) -> bool {
    report.assembly.node(name).is_some() || report.assembly.connection(name).is_some()
}

fn infinite(measure: &MeasureReport) -> Cost {
    Cost { measure: measure.key.clone(), relative: f64::INFINITY, uncertainty: 0.0 }
}

fn cost(full: &MeasureReport, reduced: &MeasureReport) -> Cost {
    let size = full.size.max(reduced.size);
    let (difference, errors) = match (full.value, reduced.value) {
        (Some(one), Some(other)) => {
            let errors = full.error.unwrap_or(0.0) + reduced.error.unwrap_or(0.0);
            ((one - other).abs(), errors)
        }
        (None, None) => (0.0, 0.0),
        _ => return infinite(full),
    };
    let over_size = |amount: f64| if amount > 0.0 { amount / size } else { 0.0 };
    Cost {
        measure: full.key.clone(),
        relative: over_size(difference),
        uncertainty: over_size(errors),
    }
}
