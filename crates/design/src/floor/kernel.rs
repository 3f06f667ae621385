//! How far body and support approach each other after a unit impulse between them.

use dashpot_dae::Signal;
use dashpot_numerics::quadrature::integral;

/// Pieces into which an interval is cut where a power of time begins.
const PIECES: usize = 8;

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

    /// The largest `∫ G(t − s) dJ(s)` from 0 to `t` of all `J` that go no further than `most(s)` to either side: by
    /// parts `|G(0)| J(t) + ∫ |G′(t − s)| J(s) ds`.
    pub(super) fn paced(&self, time: f64, most: &dyn Fn(f64) -> f64) -> f64 {
        let slope = |lag: f64| match self {
            Self::Fixed { mass } => mass.recip(),
            Self::Moving(own) => own.slope(lag).abs(),
        };
        let first = match self {
            Self::Fixed { .. } => 0.0,
            Self::Moving(own) => own.value(0.0).abs() * most(time),
        };
        // By x⁵ in place of the time since a piece began a power 0.6 of it is smooth.
        let length = time / PIECES as f64;
        let top = length.powf(0.2);
        let piece = |at: usize| {
            let from = at as f64 * length;
            let inner = |x: f64| {
                let since = from + x.powi(5);
                5.0 * x.powi(4) * most(since) * slope(time - since)
            };
            integral(inner, 0.0, top)
        };
        first + (0..PIECES).map(piece).sum::<f64>()
    }
}
