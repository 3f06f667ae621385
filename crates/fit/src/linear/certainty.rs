//! How well records determine a spectrum: bands on its curve, and what other spectra at the same floor say.

use nalgebra::{Cholesky, DVector};

use super::{
    floor::{Dense, SPRING},
    kernel::Term,
    problem::Problem,
    spectrum::Spectrum,
};
use crate::nnls::Minimum;

/// Square of the number of standard deviations of a two-sided 95 % interval.
const CHI_SQUARE: f64 = 3.841_458_820_694_124;
/// The least share of rows that count as independent.
const LEAST_SHARE: f64 = 1e-3;
/// A term as strong as the whole spectrum that adds less than this part to the rows is not seen.
const UNSEEN: f64 = 1e-6;
/// A value that may be so many times the best is not bounded.
const UNBOUNDED: f64 = 1e3;

/// Part of the rows that count as independent: residuals that follow each other tell less than their number.
pub(super) fn independent_share(problem: &Problem, residual: &DVector<f64>) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (_, rows) in problem.parts() {
        let own = &residual.as_slice()[rows];
        product += own.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
        square += own.iter().map(|own| own * own).sum::<f64>();
    }
    let follows = if square > 0.0 { (product / square).max(0.0) } else { 0.0 };
    ((1.0 - follows) / (1.0 + follows)).clamp(LEAST_SHARE, 1.0)
}

/// Half of the 95 % band of each row of a refined spectrum, in its weight: that of noise, by the covariance of the
/// logarithms, and what fewer branches change in the nearest network; `few` and `floor` are what both leave. `None` where
/// branches cannot be told apart.
pub(super) fn bands(
    problem: &Problem,
    spectrum: &Spectrum,
    [floor, few]: [&DVector<f64>; 2],
) -> Option<DVector<f64>> {
    let (_, jacobian) = spectrum.linearised(problem);
    let free = problem.rows().saturating_sub(jacobian.ncols()).max(1) as f64;
    let variance = floor.norm_squared() / (free * independent_share(problem, floor));
    let mut normal = jacobian.tr_mul(&jacobian);
    let largest = normal.diagonal().max();
    (0..normal.nrows()).for_each(|at| normal[(at, at)] += f64::EPSILON * largest);
    let spread = &jacobian * Cholesky::new(normal)?.inverse() * variance;
    Some(DVector::from_fn(problem.rows(), |row, _| {
        let variance = spread.row(row).dot(&jacobian.row(row));
        (CHI_SQUARE * variance.max(0.0)).sqrt() + (few[row] - floor[row]).abs()
    }))
}

/// From where to where a number may be while a passive network comes as near to the records as the nearest one does,
/// within their noise; without an upper end where nothing bounds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// That of the fewest branches.
    pub value: f64,
    /// The lower end.
    pub low: f64,
    /// The upper end; `None` where there is none.
    pub high: Option<f64>,
}

/// A range wider than this part of its value determines nothing.
const IDENTIFIED: f64 = 0.2;

impl Range {
    /// Whether records determine it: within a tenth either way.
    pub fn is_identified(&self) -> bool {
        self.high.is_some_and(|high| high - self.low <= IDENTIFIED * self.value)
    }

    /// The range with the value of another network that is as near.
    pub(super) fn around(self, value: f64) -> Self {
        Self { value, low: self.low.min(value), high: self.high.map(|own| own.max(value)) }
    }

    pub(super) fn joined(self, other: Self) -> Self {
        let high = self.high.zip(other.high).map(|(one, other)| one.max(other));
        Self { low: self.low.min(other.low), high, ..self }
    }
}

/// The two ends of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// The spring alone: equilibrium modulus, instantaneous compliance.
    Spring,
    /// The spring and all branches: instantaneous modulus, compliance when all has crept.
    Sum,
}

/// The 95 % quantile of what a bound on strengths lets the sum of squares rise by where one number is held at its truth, in
/// variances of the noise: those that are zero in the nearest network become free as it is moved, so that it is more
/// than that of one degree of freedom (about 3.8). That of two holds it.
///
/// Source: P. Batlle, P. Patil, M. Stanley, H. Owhadi, M. Kuusela, arXiv 2310.02461 (2023), which refutes the conjecture of
/// Burrus that one degree of freedom suffices.
const RISE: f64 = 5.991_464_547_107_98;

/// The largest sum of squares that noise explains, where the nearest network leaves least.
pub(super) fn tolerated(problem: &Problem, nearest: &Minimum) -> f64 {
    let rows = problem.rows() as f64 * independent_share(problem, &nearest.residual);
    let free = rows - nearest.passive().len() as f64;
    nearest.residual.norm_squared() * (1.0 + RISE / free.max(1.0))
}

/// The range of an end within a sum of squares; `None` where no network stays within it.
pub(super) fn range(dense: &Dense, end: End, tolerated: f64) -> Option<Range> {
    let nearest = dense.minimum();
    if nearest.residual.norm_squared() > tolerated {
        return None;
    }
    let is_taken = |at: usize| match end {
        End::Spring => at == SPRING,
        End::Sum => !matches!(dense.terms[at], Term::Dashpot),
    };
    let taken: Vec<f64> =
        (0..dense.terms.len()).map(|at| if is_taken(at) { 1.0 } else { 0.0 }).collect();
    // The strengths of branches that no row sees are arbitrary, and those of a dashpot have another unit.
    let is_elastic = |at: usize| !matches!(dense.terms[at], Term::Dashpot);
    let length = |at: usize| dense.problem.length(at);
    let longest = (0..taken.len()).filter(|at| is_elastic(*at)).map(length).fold(0.0, f64::max);
    let is_seen = |at: &usize| is_elastic(*at) && length(*at) > UNSEEN * longest;
    let size = dense.problem.square().sqrt();
    let all: f64 = (0..taken.len()).filter(is_seen).map(|at| nearest.values[at]).sum();
    // Not less than what one term would have to be.
    let scale = all.max(size / longest).max(f64::MIN_POSITIVE);
    let least = UNSEEN * size / scale;
    let sum = |values: &[f64]| -> f64 {
        (0..taken.len()).filter(|at| is_taken(*at) && is_seen(at)).map(|at| values[at]).sum()
    };
    let is_bounded = (0..taken.len()).all(|at| !is_taken(at) || length(at) > least);
    let value = sum(&nearest.values);
    let reached = |way: f64| {
        let (mut inside, mut weak, mut strong) = (nearest.clone(), -LN_PULLS, LN_PULLS);
        let mut problem = dense.problem.clone();
        let unit = dense.problem.square() / scale;
        for _ in 0..STEPS {
            let middle = 0.5 * (weak + strong);
            let pull = way * middle.exp() * unit;
            problem.pull(&taken.iter().map(|own| own * pull).collect::<Vec<_>>());
            let found = problem.minimum(&inside.passive());
            if found.residual.norm_squared() <= tolerated {
                (inside, weak) = (found, middle);
            } else {
                strong = middle;
            }
        }
        sum(&inside.values)
    };
    let high = if is_bounded { reached(1.0).max(value) } else { f64::INFINITY };
    let high = (high <= UNBOUNDED * scale).then_some(high);
    Some(Range { value, low: reached(-1.0).min(value), high })
}

/// Pulls from e^−20 to e^20 of what a network's residual would weigh are tried, by so many bisections.
const LN_PULLS: f64 = 20.0;
const STEPS: usize = 14;
