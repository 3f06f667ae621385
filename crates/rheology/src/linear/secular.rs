//! The secular equation `c − Σ w_j/(x − p_j) = 0`.
//!
//! Between two poles the left side rises from −∞ to ∞, so there is one zero. It is sought as the distance from the
//! nearer pole: near a pole the zero itself has no digits left for its distance, and everything that follows depends on
//! distances. A safeguarded Newton iteration in doubles is polished in twice their digits.

use dashpot_numerics::{DoubleDouble, roots::Bracket};

/// Newton steps in doubles; about eight are usual, and bisection alone takes this many at worst.
const MOST_STEPS: usize = 200;
/// Newton steps in twice the digits; one or two are usual.
const MOST_POLISHING: usize = 4;
/// Relative change after which a zero is final: the next would be about its square.
const FINAL: f64 = 1e-14;

/// One mode: a pole at `-rate`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    /// Rate \[1/s\], > 0 except for the pole at zero.
    pub(crate) rate: DoubleDouble,
    /// Strength, > 0: a stiffness \[N/m\], or a compliance times its rate \[m/(N s)\].
    pub(crate) strength: DoubleDouble,
}

/// The function `F(x) = c − Σ w_j/(x − p_j)`, poles in rising order.
pub(super) struct Secular<'l> {
    pub(super) constant: DoubleDouble,
    pub(super) poles: &'l [Line],
}

/// A zero of the function.
pub(super) struct Zero {
    pub(super) place: DoubleDouble,
    /// Derivative of the function there, > 0.
    pub(super) slope: DoubleDouble,
}

/// The function as seen from one of its poles: `x = p + side · η`, `η > 0`.
struct View {
    side: f64,
    /// `c`, and for each other pole its strength and its distance from this one.
    constant: f64,
    others: Vec<(f64, f64)>,
    strength: f64,
    /// The zero is not farther than this.
    limit: f64,
    /// Strength and distance of the pole at the other end of the interval.
    opposite: Option<(f64, f64)>,
}

impl Secular<'_> {
    /// All zeros, in rising order.
    pub(super) fn zeros(&self) -> impl Iterator<Item = Zero> {
        let intervals = self.poles.len().saturating_sub(usize::from(self.constant.high() == 0.0));
        (0..intervals).map(|at| self.zero_after(at))
    }

    /// The zero between the pole `at` and the next one, or beyond the last.
    fn zero_after(&self, at: usize) -> Zero {
        let base = if self.is_nearer_to_next(at) { at + 1 } else { at };
        let side = if base == at { 1.0 } else { -1.0 };
        let distance = self.view(at, base, side).zero();
        self.polished(base, side, distance)
    }

    /// Whether the zero is in the upper half of the interval.
    fn is_nearer_to_next(&self, at: usize) -> bool {
        let Some(next) = self.poles.get(at + 1) else { return false };
        let from = self.poles[at].rate;
        let half = ((next.rate - from) * 0.5).high();
        let terms =
            self.poles.iter().map(|pole| pole.strength.high() / ((from - pole.rate).high() + half));
        self.constant.high() - terms.sum::<f64>() < 0.0
    }

    fn view(&self, at: usize, base: usize, side: f64) -> View {
        let from = self.poles[base].rate;
        let others = self.poles.iter().enumerate().filter(|&(own, _)| own != base);
        let opposite = (at + 1 < self.poles.len()).then(|| {
            let other = if base == at { at + 1 } else { at };
            let gap = (self.poles[at + 1].rate - self.poles[at].rate).high();
            (self.poles[other].strength.high(), gap)
        });
        // Beyond the last pole, F(p + η) ≥ c − Σw/η.
        let limit = opposite.map_or_else(
            || {
                self.poles.iter().map(|pole| pole.strength.high()).sum::<f64>()
                    / self.constant.high()
            },
            |(_, gap)| 0.5 * gap,
        );
        View {
            side,
            constant: self.constant.high(),
            others: others
                .map(|(_, own)| (own.strength.high(), (from - own.rate).high()))
                .collect(),
            strength: self.poles[base].strength.high(),
            limit,
            opposite,
        }
    }

    /// Newton's steps in twice the digits from the distance `distance` on.
    fn polished(&self, base: usize, side: f64, distance: f64) -> Zero {
        let own = self.poles[base];
        let others = self.poles.iter().enumerate().filter(|other| other.0 != base);
        let others: Vec<(DoubleDouble, DoubleDouble)> =
            others.map(|(_, other)| (other.strength, own.rate - other.rate)).collect();
        let mut distance = DoubleDouble::from(distance);
        for _ in 0..MOST_POLISHING {
            let offset = distance * side;
            let mut rest = self.constant;
            let mut slope = 0.0;
            for &(strength, apart) in &others {
                let apart = apart + offset;
                let term = strength / apart;
                rest -= term;
                slope += term.high() / apart.high();
            }
            let residual = distance * rest * side - own.strength;
            let step = residual.high() / (side * rest.high() + distance.high() * slope);
            // No step leads across the pole; one that would is lost in rounding.
            if !step.is_finite() || step.abs() > 0.5 * distance.high() {
                break;
            }
            distance -= step;
            if step.abs() <= FINAL * distance.high() {
                break;
            }
        }
        let offset = distance * side;
        let square = |strength: DoubleDouble, apart: DoubleDouble| {
            let inverse = apart.recip();
            strength * inverse * inverse
        };
        let slopes = others.iter().map(|&(strength, apart)| square(strength, apart + offset));
        Zero {
            place: own.rate + offset,
            slope: slopes.sum::<DoubleDouble>() + square(own.strength, distance),
        }
    }
}

impl View {
    /// The distance `η` at which `φ(η) = side · η · R(η) − w` is zero, `R` being the function
    /// without the pole itself. Unlike the function, `φ` is smooth down to `η = 0`.
    fn zero(&self) -> f64 {
        let mut bracket = Bracket { low: 0.0, high: self.limit };
        let mut at = self.first().max(f64::MIN_POSITIVE).min(self.limit);
        for _ in 0..MOST_STEPS {
            let (rest, slope) = self.rest(at);
            let value = at * self.side * rest - self.strength;
            bracket.cut(at, value.is_nan() || value <= 0.0);
            let Bracket { low, high } = bracket;
            let next = at - value / (self.side * rest + at * slope);
            let next = if next > low && next < high { next } else { between(low, high) };
            let step = (next - at).abs();
            at = next;
            if step <= 4.0 * f64::EPSILON * at {
                break;
            }
        }
        at
    }

    /// A first distance: the poles at both ends as they are, all else as at the middle.
    fn first(&self) -> f64 {
        let Some((opposite, gap)) = self.opposite else { return self.limit };
        let (rest, _) = self.rest(self.limit);
        let constant = self.side * rest - opposite / (gap - self.limit);
        let linear = constant * gap + opposite + self.strength;
        let product = self.strength * gap;
        let root = (linear * linear - 4.0 * constant * product).max(0.0).sqrt();
        let first = 2.0 * product / (linear + root);
        if first > 0.0 && first < self.limit { first } else { 0.5 * self.limit }
    }

    fn rest(&self, distance: f64) -> (f64, f64) {
        let offset = self.side * distance;
        self.others.iter().fold((self.constant, 0.0), |(rest, slope), &(strength, apart)| {
            let term = strength / (apart + offset);
            (rest - term, slope + term / (apart + offset))
        })
    }
}

/// Halves an interval of distances, in powers where it spans many.
fn between(low: f64, high: f64) -> f64 {
    if low == 0.0 {
        0.01 * high
    } else if high > 4.0 * low {
        low.sqrt() * high.sqrt()
    } else {
        0.5 * (low + high)
    }
}
