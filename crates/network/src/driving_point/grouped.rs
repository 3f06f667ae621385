//! Motion of poles that stand too close for exponentials of their own.

use dashpot_numerics::Twofold;

use super::{complex::Complex, terms::Term};

/// Terms of the exponential series over at most one [`STRIDE`]: 2⁴⁰/40! is below 10⁻³⁵.
const TERMS: usize = 40;
/// Longest way of one series, in the time of the poles' distance.
const STRIDE: f64 = 2.0;
/// Strides are doubled no more often than this.
const DOUBLINGS: usize = 48;

/// The motion `f(t) = Σ residue·e^{(pole − p) t}` of a group about its centre `p`, without any of
/// its poles or residues: a differential equation with the polynomial of the group, that starts
/// with its moments.
pub(super) struct Grouped {
    /// Distance of the poles from the centre \[1/s\], by which all is scaled.
    unit: f64,
    /// The polynomial of the poles besides its first coefficient, the constant first.
    spread: Vec<Complex>,
    /// `f` and its derivatives at the start.
    start: Vec<Complex>,
    /// What leads them over 1, 2, 4, … strides.
    strides: Vec<Vec<Vec<Complex>>>,
}

impl Grouped {
    /// Of terms no further than `width` \[1/s\] from the centre, for times up to `longest` \[s\].
    pub(super) fn of(terms: &[&Term], about: Complex, width: f64, longest: f64) -> Self {
        let order = terms.iter().map(|term| term.residues.len()).sum();
        let mut start = vec![Complex::zero(); order];
        let mut spread = vec![Complex::one()];
        for term in terms {
            for (sum, moment) in start.iter_mut().zip(term.moments(about, order)) {
                *sum = *sum + moment;
            }
            spread = product(&spread, &shifted(term, term.at - about));
        }
        spread.truncate(order);
        let mut share = Twofold::ONE;
        for at in 0..order {
            start[at] = start[at].times(share);
            share = share / width;
            spread[order - 1 - at] = spread[order - 1 - at].times(share);
        }
        let mut own = Self { unit: width, spread, start, strides: Vec::new() };
        own.prepare(longest);
        own
    }

    /// The motion at a time \[s\] up to the longest; not finite where it overflows.
    pub(super) fn at(&self, t: f64) -> Complex {
        let way = t * self.unit;
        let count = (way / STRIDE).floor();
        let mut state = self.start.clone();
        let mut left = count;
        for stride in &self.strides {
            let half = (left * 0.5).floor();
            if left - 2.0 * half > 0.5 {
                state = lead(stride, &state);
            }
            left = half;
        }
        if left > 0.0 {
            return Complex::new(f64::NAN, 0.0);
        }
        series(&self.continued(&state), way - count * STRIDE)
    }

    fn prepare(&mut self, longest: f64) {
        let order = self.start.len();
        let columns: Vec<Vec<Complex>> = (0..order)
            .map(|at| {
                let mut unit = vec![Complex::zero(); order];
                unit[at] = Complex::one();
                let all = self.continued(&unit);
                (0..order).map(|row| series(&all[row..], STRIDE)).collect()
            })
            .collect();
        let mut stride: Vec<Vec<Complex>> =
            (0..order).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        let mut reach = STRIDE;
        while reach <= longest * self.unit && self.strides.len() < DOUBLINGS {
            let mut twice = vec![vec![Complex::zero(); order]; order];
            for (row, own) in twice.iter_mut().zip(&stride) {
                for (&factor, other) in own.iter().zip(&stride) {
                    for (sum, &value) in row.iter_mut().zip(other) {
                        *sum = *sum + factor * value;
                    }
                }
            }
            self.strides.push(std::mem::replace(&mut stride, twice));
            reach *= 2.0;
        }
    }

    /// The state with all derivatives that the series need.
    fn continued(&self, state: &[Complex]) -> Vec<Complex> {
        let order = state.len();
        let mut all = state.to_vec();
        for at in 0..TERMS {
            let next = self
                .spread
                .iter()
                .zip(&all[at..])
                .fold(Complex::zero(), |sum, (&factor, &value)| sum - factor * value);
            all.push(next);
        }
        debug_assert_eq!(all.len(), order + TERMS);
        all
    }
}

/// `Σ derivatives·way^i/i!`.
fn series(derivatives: &[Complex], way: f64) -> Complex {
    let mut weight = Twofold::ONE;
    let mut sum = Complex::zero();
    for (at, value) in derivatives.iter().take(TERMS).enumerate() {
        sum = sum + value.times(weight);
        weight = weight * way / (at + 1) as f64;
    }
    sum
}

fn lead(stride: &[Vec<Complex>], state: &[Complex]) -> Vec<Complex> {
    let row = |row: &Vec<Complex>| {
        row.iter().zip(state).fold(Complex::zero(), |sum, (&factor, &value)| sum + factor * value)
    };
    stride.iter().map(row).collect()
}

/// The whole polynomial of a term with its centre at `by`.
fn shifted(term: &Term, by: Complex) -> Vec<Complex> {
    let root = [-by, Complex::one()];
    term.spread.iter().rev().fold(vec![Complex::one()], |sum, &coefficient| {
        let mut next = product(&sum, &root);
        next[0] = next[0] + coefficient;
        next
    })
}

fn product(first: &[Complex], second: &[Complex]) -> Vec<Complex> {
    let mut all = vec![Complex::zero(); first.len() + second.len() - 1];
    for (i, &a) in first.iter().enumerate() {
        for (j, &b) in second.iter().enumerate() {
            all[i + j] = all[i + j] + a * b;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poles_apart_move_by_their_exponentials_over_short_and_long_times() {
        let at = |im: f64| Complex::new(-1e-3, im);
        let poles = [at(100.0), at(100.5), at(99.25)];
        let residues = [1.0, -0.5, 2.0];
        let terms: Vec<Term> = poles
            .iter()
            .zip(residues)
            .map(|(&pole, own)| Term::simple(pole, Complex::new(own, 0.0)))
            .collect();
        let all: Vec<&Term> = terms.iter().collect();
        let grouped = Grouped::of(&all, poles[0], 0.75, 1e3);
        for t in [0.0, 0.3, 2.6, 2.7, 31.4, 314.0, 999.0] {
            let [re, im] = grouped.at(t).rounded();
            let expected = residues
                .iter()
                .zip([0.0, 0.5, -0.75])
                .map(|(own, apart)| [own * (apart * t).cos(), own * (apart * t).sin()])
                .fold([0.0, 0.0], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
            // Rounding of the angle in the expected values.
            let rounding = 4.0 * f64::EPSILON * (1.0 + t);
            assert!((re - expected[0]).abs() < rounding, "{t}: {re} {expected:?}");
            assert!((im - expected[1]).abs() < rounding, "{t}: {im} {expected:?}");
        }
    }

    #[test]
    fn poles_that_coincide_move_by_powers_of_time() {
        let term = Term {
            at: Complex::new(-2.0, 0.0),
            spread: vec![Complex::zero(); 3],
            residues: [6.0, 5.0, 7.0].map(|own| Complex::new(own, 0.0)).to_vec(),
            count: 3,
            error: 0.0,
        };
        let grouped = Grouped::of(&[&term], term.at, 1e-6, 1e3);
        for t in [0.0_f64, 0.1, 9.0] {
            let expected = 7.0 + 5.0 * t + 3.0 * t * t;
            assert!((grouped.at(t).re.high() - expected).abs() < 1e-15 * expected);
        }
    }

    #[test]
    fn another_centre_does_not_change_the_motion() {
        let term = Term {
            at: Complex::new(-1.0, 0.0),
            spread: vec![Complex::new(1e-4, 0.0), Complex::zero()],
            residues: vec![Complex::new(1.0, 0.0), Complex::new(0.5, 0.0)],
            count: 2,
            error: 0.0,
        };
        let about = Complex::new(-1.01, 0.0);
        let [own, other] =
            [term.at, about].map(|centre| Grouped::of(&[&term], centre, 0.02, 50.0).at(40.0));
        let other = other.re.high() * (0.01_f64 * 40.0).exp().recip();
        assert!((own.re.high() / other - 1.0).abs() < 1e-14);
    }
}
