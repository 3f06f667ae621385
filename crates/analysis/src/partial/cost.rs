//! How far measures are moved by what is left out.

use crate::{MeasureReport, RunReport, partial::Cost};

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
        let others = reduced.by_key();
        for measure in &full.measures {
            let target = measure.target.as_str();
            match others.get(measure.key.as_str()) {
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
    let others = full.by_key();
    for measure in &mut reduced.measures {
        let Some(opposite) = others.get(measure.key.as_str()) else { continue };
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

/// Part of its size below which a value is the small remainder of something larger.
const REMAINDER: f64 = 0.05;

/// What a move of a measure is a part of: its value or, where that is next to nothing, a part of its size.
fn scale(measure: &MeasureReport) -> f64 {
    measure.value.map_or(0.0, f64::abs).max(REMAINDER * measure.size)
}

fn cost(full: &MeasureReport, reduced: &MeasureReport) -> Cost {
    let size = scale(full).max(scale(reduced));
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

#[cfg(test)]
mod tests {
    use super::*;

    fn energy(value: f64, size: f64) -> MeasureReport {
        MeasureReport {
            key: "pad.energy".to_owned(),
            target: "pad".to_owned(),
            kind: "energy",
            unit: "J",
            value: Some(value),
            time: None,
            window: None,
            error: Some(0.0),
            notes: Vec::new(),
            window_wish: None,
            parameters: Vec::new(),
            is_undetermined: false,
            size,
            excess: 0.0,
        }
    }

    #[test]
    fn a_move_is_a_part_of_the_value_however_much_has_gone_to_and_fro() {
        let moved = cost(&energy(28.8, 110.0), &energy(32.0, 110.0));
        assert!((moved.relative - 0.1).abs() < 1e-12, "{}", moved.relative);
    }

    #[test]
    fn a_move_of_what_is_given_back_is_a_part_of_what_went_to_and_fro() {
        let moved = cost(&energy(0.0, 100.0), &energy(0.01, 100.0));
        assert!((moved.relative - 0.002).abs() < 1e-12, "{}", moved.relative);
    }
}
