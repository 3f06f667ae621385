//! The thesis' equations 2.20–2.22 in ζ, η, φ, φ′, solved by Taylor series.
//!
//! This shares no code with the compiler of networks or with any method: six numbers, their
//! equations as printed, and a series whose remainder is below rounding.

/// The groups of the thesis (2.27–2.36), with A = 0 for an impact without gravity.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Groups {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
    pub(crate) d: f64,
    pub(crate) alpha: f64,
    pub(crate) beta: f64,
    pub(crate) gamma: f64,
}

/// ζ, ζ′, η, η′, φ, φ′ and ω.
type State = [f64; 7];

/// Terms of the series.
const ORDER: usize = 26;

/// The solution on a uniform grid, with its Taylor coefficients at each point.
pub(crate) struct Solution {
    step: f64,
    series: Vec<[[f64; ORDER]; 7]>,
}

impl Groups {
    /// The groups that the thesis prints for its reference case.
    pub(crate) fn printed(alpha: f64) -> Self {
        Self { a: 26.6, b: 66.66, c: 8.0, d: 80.0, alpha, beta: 2.0, gamma: 0.1 }
    }

    /// Solves from τ* = 0 to `end`.
    pub(crate) fn solve(&self, end: f64) -> Solution {
        let stiffest = self.alpha.max(self.a).max(self.d);
        let count = (end * stiffest * 2.0).ceil() as usize;
        let step = end / count as f64;
        let mut state: State = [0.0, 1.0, 0.0, 0.0, 0.0, self.c, 0.0];
        let mut series = Vec::with_capacity(count + 1);
        for _ in 0..=count {
            let terms = self.series(&state);
            for (value, terms) in state.iter_mut().zip(&terms) {
                *value = terms.iter().rev().fold(0.0, |sum, term| sum * step + term);
            }
            series.push(terms);
        }
        Solution { step, series }
    }

    /// Taylor coefficients of the solution through `state`.
    fn series(&self, state: &State) -> [[f64; ORDER]; 7] {
        let mut x = [[0.0; ORDER]; 7];
        for (series, value) in x.iter_mut().zip(state) {
            series[0] = *value;
        }
        for k in 0..ORDER - 1 {
            let next = (k + 1) as f64;
            let zeta2 = -x[4][k];
            let eta2 = -self.alpha * x[3][k] - self.beta * x[2][k] + self.gamma * x[4][k];
            let xi1 = x[1][k] - x[3][k];
            let xi2 = zeta2 - eta2;
            let phi2 = -self.a * x[5][k] - self.b * x[4][k] + self.c * xi2 + self.d * xi1;
            let power: f64 = (0..=k).map(|i| x[4][i] * (x[1][k - i] - x[3][k - i])).sum();
            let rates = [x[1][k], zeta2, x[3][k], eta2, x[5][k], phi2, power];
            for (series, rate) in x.iter_mut().zip(rates) {
                series[k + 1] = rate / next;
            }
        }
        x
    }
}

impl Solution {
    fn value(&self, at: usize, s: f64, of: impl Fn(&[[f64; ORDER]; 7], usize) -> f64) -> f64 {
        (0..ORDER).rev().fold(0.0, |sum, k| sum * s + of(&self.series[at], k))
    }

    /// φ at τ*.
    pub(crate) fn phi(&self, tau: f64) -> f64 {
        let (at, s) = self.place(tau);
        self.value(at, s, |x, k| x[4][k])
    }

    /// ξ = ζ − η at τ*.
    pub(crate) fn xi(&self, tau: f64) -> f64 {
        let (at, s) = self.place(tau);
        self.value(at, s, |x, k| x[0][k] - x[2][k])
    }

    /// ω = ∫ φ ξ′ at τ*.
    pub(crate) fn omega(&self, tau: f64) -> f64 {
        let (at, s) = self.place(tau);
        self.value(at, s, |x, k| x[6][k])
    }

    /// ζ′ at τ*.
    pub(crate) fn zeta_rate(&self, tau: f64) -> f64 {
        let (at, s) = self.place(tau);
        self.value(at, s, |x, k| x[1][k])
    }

    /// First zero of φ after its rise.
    pub(crate) fn tension(&self) -> f64 {
        self.first_fall(|x, k| x[4][k])
    }

    /// Largest φ (its rate falls through zero first there) and where.
    pub(crate) fn phi_max(&self) -> (f64, f64) {
        let tau = self.first_fall(|x, k| x[5][k]);
        (self.phi(tau), tau)
    }

    /// Largest ξ up to the tension and where; local maxima are compared.
    pub(crate) fn xi_max(&self) -> (f64, f64) {
        let falls = self.falls(|x, k| x[1][k] - x[3][k]);
        let end = self.tension();
        falls
            .into_iter()
            .filter(|&tau| tau <= end)
            .map(|tau| (self.xi(tau), tau))
            .fold((0.0, 0.0), |best, next| if next.0 > best.0 { next } else { best })
    }

    fn place(&self, tau: f64) -> (usize, f64) {
        let at = ((tau / self.step) as usize).min(self.series.len() - 1);
        (at, tau - at as f64 * self.step)
    }

    fn first_fall(&self, of: impl Fn(&[[f64; ORDER]; 7], usize) -> f64 + Copy) -> f64 {
        self.falls(of)[0]
    }

    /// All places where a quantity falls from above zero to below, by bisection.
    fn falls(&self, of: impl Fn(&[[f64; ORDER]; 7], usize) -> f64 + Copy) -> Vec<f64> {
        let mut falls = Vec::new();
        for at in 0..self.series.len() - 1 {
            let (mut low, mut high) = (0.0, self.step);
            let begins =
                self.value(at, low, of) > 0.0 || (at == 0 && self.value(at, 1e-9, of) > 0.0);
            if !begins || self.value(at, high, of) > 0.0 {
                continue;
            }
            while high - low > 1e-16 {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if self.value(at, middle, of) > 0.0 { low = middle } else { high = middle }
            }
            falls.push(at as f64 * self.step + low);
        }
        falls
    }
}

/// Whether `value` rounds to the digits of a `printed` decimal.
pub(crate) fn has_digits(value: f64, printed: &str) -> bool {
    let decimals = printed.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    format!("{value:.decimals$}") == printed
}

/// The thesis' printed groups, exact: α, then φ max and where, ξ max and where, τ* of the tension
/// and ω(5), as decimals.
pub(crate) const PRINTED: [(f64, [&str; 6]); 2] = [
    (
        0.2,
        ["0.767833515", "0.488318669", "0.876753841", "3.426861744", "3.712820255", "0.479133623"],
    ),
    (
        200.0,
        ["0.782469363", "0.505911201", "0.847727298", "2.336375231", "2.914717554", "0.499715097"],
    ),
];

#[test]
fn the_thesis_table_for_its_printed_groups_holds_to_all_digits() {
    for (alpha, expected) in PRINTED {
        let solution = Groups::printed(alpha).solve(10.0);
        let (phi, xi) = (solution.phi_max(), solution.xi_max());
        let found = [phi.0, phi.1, xi.0, xi.1, solution.tension(), solution.omega(5.0)];
        for (value, printed) in found.into_iter().zip(expected) {
            assert!(has_digits(value, printed), "alpha {alpha}: {value:.12} is not {printed}");
        }
    }
}
