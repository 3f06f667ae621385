//! A spectrum of a few terms, its curve, and its refinement by least squares.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::{kernel::Term, problem::Problem, record::Form};
use dashpot_rheology::{DoubleDouble, LinearModel, Primitive};

/// Strengths of a spring, a dashpot and branches; moduli in the Maxwell form, compliances in the Kelvin form.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Equilibrium modulus, or instantaneous compliance; 0 where there is none.
    pub spring: f64,
    /// Viscosity, or fluidity; 0 where there is none.
    pub dashpot: f64,
    /// Times \[s\] and strengths of the branches, rising in time.
    pub branches: Vec<(f64, f64)>,
}

impl Spectrum {
    /// The linear model that has it.
    pub fn model(&self, form: Form) -> LinearModel {
        match form {
            Form::Maxwell => {
                let single = [Primitive::Spring(self.spring), Primitive::Dashpot(self.dashpot)];
                let single = single.into_iter().filter(|own| match own {
                    Primitive::Spring(own) | Primitive::Dashpot(own) => *own > 0.0,
                    Primitive::Rigid => true,
                });
                let elements = self.branches.iter().map(|&(time, modulus)| {
                    let parts = [Primitive::Spring(modulus), Primitive::Dashpot(modulus * time)];
                    LinearModel::series(&parts.map(LinearModel::primitive))
                });
                let all: Vec<LinearModel> =
                    single.map(LinearModel::primitive).chain(elements).collect();
                LinearModel::parallel(&all)
            }
            Form::Kelvin => {
                let double = DoubleDouble::from;
                let modes = self.branches.iter().map(|&(time, compliance)| {
                    (double(time).recip(), double(compliance) / double(time))
                });
                LinearModel::from_kelvin(double(self.spring), double(self.dashpot), modes)
            }
        }
    }

    /// The relaxation modulus, or the creep compliance, at a time \[s\] after a sudden load; without the impulse of a
    /// dashpot that stands in parallel.
    pub fn at(&self, form: Form, time: f64) -> f64 {
        let branches = self.branches.iter();
        self.spring
            + match form {
                Form::Maxwell => branches.map(|own| own.1 * (-time / own.0).exp()).sum::<f64>(),
                Form::Kelvin => {
                    let late: f64 = branches.map(|own| own.1 * -(-time / own.0).exp_m1()).sum();
                    self.dashpot * time + late
                }
            }
    }

    /// The terms with their strengths; those that are zero are left out.
    pub(super) fn terms(&self) -> impl Iterator<Item = (Term, f64)> + '_ {
        let single = [(Term::Spring, self.spring), (Term::Dashpot, self.dashpot)];
        let branches = self.branches.iter().map(|own| (Term::Branch(own.0), own.1));
        single.into_iter().filter(|own| own.1 > 0.0).chain(branches)
    }

    /// Its curve less the rows.
    pub(super) fn residual(&self, problem: &Problem) -> DVector<f64> {
        let mut sum = -&problem.target;
        let (mut value, mut slope) = (vec![0.0; problem.rows()], vec![0.0; problem.rows()]);
        for (term, strength) in self.terms() {
            problem.term(term, &mut value, &mut slope);
            sum.iter_mut().zip(&value).for_each(|(own, value)| *own += strength * value);
        }
        sum
    }

    /// The residual, and its derivatives by the logarithms of strengths and then of times.
    pub(super) fn linearised(&self, problem: &Problem) -> (DVector<f64>, DMatrix<f64>) {
        let (terms, rows) = (self.terms().count(), problem.rows());
        let first_time = terms;
        let mut jacobian = DMatrix::zeros(rows, terms + self.branches.len());
        let mut residual = -&problem.target;
        let (mut value, mut slope) = (vec![0.0; rows], vec![0.0; rows]);
        let skipped = terms - self.branches.len();
        for (at, (term, strength)) in self.terms().enumerate() {
            problem.term(term, &mut value, &mut slope);
            for (own, value) in jacobian.column_mut(at).iter_mut().zip(&value) {
                *own = strength * value;
            }
            residual += jacobian.column(at);
            if let Term::Branch(_) = term {
                let mut column = jacobian.column_mut(first_time + at - skipped);
                column.iter_mut().zip(&slope).for_each(|(own, slope)| *own = strength * slope);
            }
        }
        (residual, jacobian)
    }

    /// With logarithms moved by a step, times within the limits.
    fn moved(&self, step: &DVector<f64>, (low, high): (f64, f64)) -> Self {
        let mut own = self.clone();
        let mut factors = step.iter().map(|own| own.exp());
        let mut scale = |value: &mut f64| {
            if *value > 0.0 {
                *value *= factors.next().unwrap_or(1.0);
            }
        };
        scale(&mut own.spring);
        scale(&mut own.dashpot);
        own.branches.iter_mut().for_each(|own| scale(&mut own.1));
        own.branches.iter_mut().for_each(|own| scale(&mut own.0));
        own.branches.iter_mut().for_each(|own| own.0 = own.0.clamp(low, high));
        own
    }

    /// The positions of times that stand at a limit and would leave it.
    fn held(&self, (low, high): (f64, f64), descent: &DVector<f64>) -> Vec<usize> {
        let first = descent.len() - self.branches.len();
        let leaves = |at: usize| {
            let (time, way) = (self.branches[at].0, descent[first + at]);
            time <= low && way < 0.0 || time >= high && way > 0.0
        };
        (0..self.branches.len()).filter(|at| leaves(*at)).map(|at| first + at).collect()
    }

    /// Refines it by at most so many steps of Levenberg and Marquardt on logarithms, until a step lowers the sum of
    /// squares by less than this part; returns what is left.
    ///
    /// With some 50 unknowns and rows by the hundred the normal equations take a fiftieth of what a trust region of
    /// singular values takes, and damping keeps them well posed.
    pub(super) fn refine(&mut self, problem: &Problem, steps: usize, settled: f64) -> DVector<f64> {
        let (mut residual, mut jacobian) = self.linearised(problem);
        let mut damping = START_DAMPING;
        let mut square = residual.norm_squared();
        for _ in 0..steps {
            let mut normal = jacobian.tr_mul(&jacobian);
            let mut descent = -jacobian.tr_mul(&residual);
            for at in self.held(problem.limits, &descent) {
                normal.row_mut(at).fill(0.0);
                normal.column_mut(at).fill(0.0);
                (normal[(at, at)], descent[at]) = (1.0, 0.0);
            }
            for at in 0..normal.nrows() {
                normal[(at, at)] += damping * normal[(at, at)].max(f64::MIN_POSITIVE);
            }
            let Some(mut step) = Cholesky::new(normal).map(|own| own.solve(&descent)) else {
                damping *= UP;
                continue;
            };
            let longest = step.amax();
            if longest > LONGEST {
                step *= LONGEST / longest;
            }
            let next = self.moved(&step, problem.limits);
            let left = next.residual(problem).norm_squared();
            if left.is_nan() || left >= square {
                damping *= UP;
                if damping > MOST_DAMPING {
                    break;
                }
                continue;
            }
            damping = (damping * DOWN).max(f64::EPSILON);
            let won = square - left;
            *self = next;
            square = left;
            (residual, jacobian) = self.linearised(problem);
            if won < settled * square {
                break;
            }
        }
        self.branches.sort_by(|one, other| one.0.total_cmp(&other.0));
        residual
    }
}

/// The damping to begin with, in parts of the diagonal.
const START_DAMPING: f64 = 1e-3;
/// A damping beyond which no step is taken any more.
const MOST_DAMPING: f64 = 1e8;
/// Change of the damping where a step fails, and where it succeeds.
const UP: f64 = 8.0;
const DOWN: f64 = 0.2;
/// The longest step, in logarithms.
const LONGEST: f64 = 1.0;
