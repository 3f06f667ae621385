//! The passive network that is nearest to records, of those whose times the records determine.

use nalgebra::DVector;

use super::{floor::Dense, problem::Problem, spectrum::Spectrum};

/// Steps of refinement, until one wins less than this part.
const STEPS: usize = 40;
const SETTLED: f64 = 1e-4;

/// The nearest network: that on the grid of times, or where it comes nearer one of fewer terms between them.
#[derive(Debug, Clone)]
pub(super) struct Nearest {
    pub(super) spectrum: Spectrum,
    /// The terms on the grid, those that are next to each other as one, refined.
    pub(super) start: Spectrum,
    /// What it leaves of the rows.
    pub(super) left: DVector<f64>,
}

impl Nearest {
    /// That of a problem; `None` where it has no terms.
    pub(super) fn of(problem: &Problem) -> Option<Self> {
        let dense = Dense::within(problem);
        let minimum = dense.minimum();
        let mut start = dense.spectrum(&minimum);
        start.terms().next()?;
        let residual = start.refine(problem, STEPS, SETTLED);
        let (spectrum, left) = if residual.norm() < minimum.residual.norm() {
            (start.clone(), residual)
        } else {
            (dense.every_term(&minimum), minimum.residual)
        };
        Some(Self { spectrum, start, left })
    }
}
