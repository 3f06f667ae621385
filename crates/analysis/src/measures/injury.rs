//! What an impact does to a head: the severity index, and the head injury criterion over intervals up to a cap, and
//! of at most 15 and 36 ms.

use std::sync::Arc;

use dashpot_network::{parameters, parameters::WindowWish};

use super::{
    Measure, MeasureKind, MeasureTraits, Reading, STANDARD_GRAVITY, WINDOW,
    hic_search::{RESOLUTION, optimum, optimum_of_magnitude},
    powers::raised,
};
use crate::{Note, Solution, VelocityJump};

parameters! {
    /// Gadd's severity index, `SI = ∫ (|a|/g0)^n dt` \[s\], of what an accelerometer on a body reads.
    ///
    /// | symbol | field      | unit | range            |
    /// |--------|------------|------|------------------|
    /// | `n`    | `exponent` | 1    | positive         |
    /// | `g0`   | [`STANDARD_GRAVITY`] | m/s² |        |
    ///
    /// Where the speed jumps by `Δv`, it is infinite for `n > 1`, and `Δv/g0` is added for `n = 1`.
    /// A half-sine of height `A g0` and length `T` has `SI = 0.45765586 A^2.5 T` at `n = 2.5`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct SeverityIndex: "severity-index", "integral of (|a|/g0)^exponent over time [s]" {
        /// exponent n, positive
        pub exponent: f64 = Quantity(Dimension::NUMBER), default "2.5", range Positive;
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
    default { exponent: 2.5, window: WindowWish::Impact }
}

impl MeasureKind for SeverityIndex {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("s").of_impacts();

    fn gravities(&self) -> f64 {
        self.exponent
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let jumps = solution.node_jumps(target);
        if self.exponent > 1.0
            && let Some(reading) = Reading::infinite(&span, &jumps)
        {
            return Ok(reading);
        }
        let severity = |a: f64| raised(a.abs() / STANDARD_GRAVITY, self.exponent).0;
        let value = acceleration.integral_of(span.window(), &[0.0], severity);
        let last = severity(acceleration.left_value(span.to));
        let error = acceleration.error.zip(span.to_error).map(|(error, shift)| {
            // How much the integrand grows at most when the acceleration does by its error.
            let n = self.exponent;
            let growth = |a: f64| {
                let most = (a.abs() + error) / STANDARD_GRAVITY;
                if n >= 1.0 {
                    n * raised(most, n).1 * error / STANDARD_GRAVITY
                } else {
                    severity(error)
                }
            };
            acceleration.integral_of(span.window(), &[0.0], growth) + last * shift + 1e-13 * value
        });
        let reading = Reading::over(&span, value, error).changing(last);
        if self.exponent < 1.0 {
            return Ok(reading);
        }
        let unit = solution.body_mass(target) * STANDARD_GRAVITY;
        let jumps = VelocityJump::within(&jumps, span.window());
        let sum = jumps.iter().map(|jump| jump.impulse.abs() / unit).sum();
        let error = solution.velocity_error(target).map(|error| 2.0 * error / STANDARD_GRAVITY);
        let error = error.map(|each| jumps.iter().map(|_| each).sum());
        Ok(reading.plus(sum, sum, error))
    }
}

parameters! {
    /// The head injury criterion of what an accelerometer on a body reads,
    /// `HIC = max (t2 − t1) [|∫ a/g0 dt| / (t2 − t1)]^2.5` \[s\] over all intervals `[t1, t2]` no
    /// longer than a cap. The window reported is the interval found. Where the speed jumps, it is
    /// infinite. On its one axis the acceleration counts with its sign, as that of a single channel does, so that a swing
    /// back takes from the mean; where that of the magnitude, as of a resultant, is larger, a note tells it.
    ///
    /// | symbol | field | unit | range    |
    /// |--------|-------|------|----------|
    /// |        | `cap` | s    | positive |
    /// | `g0`   | [`STANDARD_GRAVITY`] | m/s² | |
    ///
    /// A half-sine of height `A g0` and length `T` has `HIC = 0.41464565 A^2.5 T` without a cap, over
    /// an interval of `0.6702297 T`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Hic: "hic", "head injury criterion over intervals up to a cap [s]" {
        /// longest interval [s], positive; the default is as good as none
        pub cap: f64 = Quantity(Dimension::TIME), default "1e6 s", range Positive;
        /// The part of the run in which the interval lies.
        pub window: WindowWish => WINDOW;
    }
    default { cap: 1e6, window: WindowWish::Impact }
}

impl MeasureKind for Hic {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("s");

    fn gravities(&self) -> f64 {
        2.5
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        if let Some(reading) = Reading::infinite(&span, &solution.node_jumps(target)) {
            return Ok(reading);
        }
        let acceleration = acceleration.scaled(1.0 / STANDARD_GRAVITY);
        let found = optimum(&acceleration, span.window(), self.cap);
        let length = found.interval.1 - found.interval.0;
        let mean = if length > 0.0 { (found.value / length).powf(0.4) } else { 0.0 };
        let growth = 2.5 * mean.powf(1.5);
        let is_at_end = found.interval.1 >= span.to;
        let last = if is_at_end { acceleration.left_value(span.to).abs() } else { 0.0 };
        let error = acceleration.error.zip(span.to_error).map(|(error, shift)| {
            growth * (error * length + last * shift) + found.threshold + RESOLUTION * found.value
        });
        let reading = Reading::over(&span, found.value, error).changing(growth * last);
        let magnitude = optimum_of_magnitude(&acceleration, span.window(), self.cap);
        let least = error.unwrap_or(0.0).max(SAME * found.value);
        let larger = magnitude.map(|own| own.value).filter(|own| own - found.value > least);
        let reading = match larger {
            Some(own) => reading.noting(Note::LargerByMagnitude(own)),
            None => reading,
        };
        Ok(Reading { window: Some(found.interval), ..reading })
    }
}

/// A criterion of the magnitude that is larger by no more than this part is the same.
const SAME: f64 = 1e-6;

/// Declares the criterion over intervals of at most so many seconds.
macro_rules! within {
    ($name:ident: $kind:literal, $summary:literal, $cap:literal) => {
        parameters! {
            #[doc = concat!("The ", $summary, "; otherwise as [`Hic`].")]
            #[allow(rustdoc::broken_intra_doc_links, reason = "units stand in brackets")]
            #[derive(Debug, Clone, Copy, PartialEq, Default)]
            pub struct $name: $kind, $summary {
                /// The part of the run in which the interval lies.
                pub window: WindowWish => WINDOW;
            }
        }

        impl $name {
            fn hic(self) -> Hic {
                Hic { cap: $cap, window: self.window }
            }
        }

        impl MeasureKind for $name {
            const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("s");

            fn gravities(&self) -> f64 {
                2.5
            }

            fn general(&self) -> Option<Arc<dyn Measure>> {
                Some(Arc::new(self.hic()))
            }

            fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
                MeasureKind::read(&self.hic(), solution, target)
            }
        }
    };
}

within!(Hic15: "hic15", "head injury criterion over intervals up to 15 ms [s]", 0.015);
within!(Hic36: "hic36", "head injury criterion over intervals up to 36 ms [s]", 0.036);
