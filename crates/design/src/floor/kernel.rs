//! How far body and support approach each other after a unit impulse between them.

use std::iter::successors;

use dashpot_dae::Signal;
use dashpot_numerics::quadrature::integral;

use super::HIC_EXPONENT;

/// A time is cut into so many pieces at least, and where windows of impulse begin.
const PIECES: usize = 8;
/// Where a time has more windows, their impulse is bounded by a line.
const MOST: usize = 512;
/// The most of `x^0.6 − x` for `x` from 0 to 1 is 0.1859, at `0.6^2.5`.
const ABOVE: f64 = 0.186;
/// The power of its length with which the impulse of a window grows, of one value of the head injury criterion.
const GROWTH: f64 = 1.0 - 1.0 / HIC_EXPONENT;

/// The approach `G` per impulse \[m/(N s)\].
#[derive(Debug, Clone)]
pub(super) enum Kernel {
    /// On a fixed support: `t/m`.
    Fixed {
        /// Mass of the body \[kg\].
        mass: f64,
    },
    /// On one that gives way.
    Moving(Signal),
}

impl Kernel {
    pub(super) fn is_fixed(&self) -> bool {
        matches!(self, Self::Fixed { .. })
    }

    /// `G` after this time \[s\].
    pub(super) fn value(&self, time: f64) -> f64 {
        match self {
            Self::Fixed { mass } => time / mass,
            Self::Moving(own) => own.value(time),
        }
    }

    /// `∫ |G|` from 0.
    pub(super) fn area(&self, time: f64) -> f64 {
        match self {
            Self::Fixed { mass } => 0.5 * time * time / mass,
            Self::Moving(own) => own.absolute_integral((0.0, time)),
        }
    }

    /// `∫ |G|^p` from 0.
    pub(super) fn power(&self, time: f64, power: f64) -> f64 {
        match self {
            Self::Fixed { mass } => time.powf(power + 1.0) / ((power + 1.0) * mass.powf(power)),
            Self::Moving(own) => own.integral_of((0.0, time), &[0.0], |y| y.abs().powf(power)),
        }
    }

    /// The largest `∫ G(t − s) dJ(s)` from 0 to `t` of all `J` of which no window of a length `τ` up to a cap has more
    /// than `τ^0.6`: by parts `|G(0)| J(t) + ∫ |G′(t − s)| J(s) ds`.
    pub(super) fn paced(&self, time: f64, cap: f64) -> f64 {
        let own = match self {
            Self::Fixed { mass } => return paced_area(time, cap) / mass,
            Self::Moving(own) => own,
        };
        let window = cap.min(time);
        let is_followed = window >= time / MOST as f64;
        let parts = if is_followed { (PIECES as f64 * window / time).ceil() } else { 1.0 };
        let length = if is_followed { window / parts } else { time / PIECES as f64 };
        let most = |since: f64| if is_followed { paced(since, cap) } else { evenly(since, cap) };
        // By x⁵ in place of the time since a piece began a power 0.6 of it is smooth.
        let piece = |from: f64| {
            let inner = |x: f64| {
                let since = from + x.powi(5);
                5.0 * x.powi(4) * most(since) * own.slope(time - since).abs()
            };
            integral(inner, 0.0, (time - from).clamp(0.0, length).powf(0.2))
        };
        let starts = successors(Some(0.0), |at| Some(at + 1.0)).map(|at: f64| at * length);
        let pieces = starts.take_while(|from| *from < time).map(piece);
        own.value(0.0).abs() * most(time) + pieces.sum::<f64>()
    }
}

/// The most impulse from the start where no window of the length `τ` up to a cap has more than `τ^0.6`.
fn paced(since: f64, cap: f64) -> f64 {
    let whole = (since / cap).floor();
    whole * cap.powf(GROWTH) + (since - whole * cap).max(0.0).powf(GROWTH)
}

/// A line that is above it: by the most of `x^0.6 − x`, with `x` in parts of a window.
fn evenly(since: f64, cap: f64) -> f64 {
    cap.powf(GROWTH) * (since / cap + ABOVE)
}

/// Its integral from the start.
fn paced_area(since: f64, cap: f64) -> f64 {
    let whole = (since / cap).floor();
    let rest = (since - whole * cap).max(0.0);
    let window = |length: f64| length.powf(GROWTH + 1.0) / (GROWTH + 1.0);
    if whole == 0.0 {
        return window(rest);
    }
    let before = whole * cap.powf(GROWTH) * (0.5 * (whole - 1.0) * cap + rest);
    before + whole * window(cap) + window(rest)
}
