//! The slope of a measure from its values at a number and at both sides of it.

/// Values at a number less a step, at the number, and at the number and a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stencil {
    /// The number's magnitude.
    pub(super) number: f64,
    /// The step in parts of the number.
    pub(super) step: f64,
    /// The three values.
    pub(super) values: [f64; 3],
    /// The values half a step to both sides, where they are known.
    pub(super) inner: Option<[f64; 2]>,
    /// How far a value may be off by itself.
    pub(super) noise: f64,
    /// How far all values may be off alike, in parts of themselves.
    pub(super) common: f64,
}

/// A slope, and how far it may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slope {
    pub(super) value: f64,
    pub(super) error: f64,
    /// The slopes below and above the number, where these differ however small the step.
    pub(super) sides: Option<[f64; 2]>,
}

/// By how much errors may exceed what differences of differences tell.
const SAFETY: f64 = 4.0;
/// Errors of values in the difference of their differences.
const NOISES: f64 = 4.0;
/// Part of the error from which on two slopes are what makes it.
const MOSTLY: f64 = 0.25;

impl Stencil {
    /// What an error is judged by: the larger of the value and of its change with the number.
    pub(super) fn scale(&self, slope: f64) -> f64 {
        self.values[1].abs().max(slope.abs() * self.number)
    }

    /// The third derivative that three values tell of, times the number's third power, if the value is the root of the
    /// distance to where there is none; 0 where it bends less than it slopes.
    fn rooted(&self) -> f64 {
        let [below, here, above] = self.values;
        let change = (above - below).abs() / (2.0 * self.step);
        let bend = ((above - here) - (here - below)).abs();
        let ratio = (bend - NOISES * self.noise).max(0.0) / (2.0 * self.step * self.step);
        let steep = (ratio / change).min(0.25 / self.step);
        if steep > 1.0 { ratio * steep } else { 0.0 }
    }

    /// What of the relative error of three values is that of such a root, about twice of it.
    pub(super) fn error_of_root(&self) -> f64 {
        let rooted = self.rooted();
        let change = (self.values[2] - self.values[0]).abs() / (2.0 * self.step);
        if rooted > 0.0 {
            SAFETY * self.step * self.step * rooted / self.values[1].abs().max(change)
        } else {
            0.0
        }
    }

    /// The slope. With values at half a step its error is taken from them: of the step, by which the slopes at both
    /// steps differ, and of a kink, which keeps the difference of the slopes below and above from falling with the
    /// step. Without them the measure must be known to be smooth: its third derivative is then taken as no larger
    /// than the number's size tells, or the second one if it is the root of the distance to where it has none, as the
    /// times of events are beside a graze.
    pub(super) fn slope(&self) -> Slope {
        let step = self.step * self.number;
        let [below, here, above] = self.values;
        let central = (above - below) / (2.0 * step);
        let bend = (above - here) - (here - below);
        let Some([near_below, near_above]) = self.inner else {
            let scale = self.scale(central);
            let cut = SAFETY * self.step * self.step * scale.max(self.rooted()) / self.number;
            let error = cut + self.noise / step + self.common * scale / self.number;
            return Slope { value: central, error, sides: None };
        };
        let half = 0.5 * step;
        let near = (near_above - near_below) / step;
        let sides = [(here - near_below) / half, (near_above - here) / half];
        let kink = 2.0 * (sides[1] - sides[0]) - bend / step;
        let value = (4.0 * near - central) / 3.0;
        let cut = SAFETY * (near - central).abs() / 3.0;
        let common = self.common * self.scale(value) / self.number;
        let error = cut + kink.abs() + self.noise / step + common;
        let is_kink = kink.abs() > MOSTLY * error;
        Slope { value, error, sides: is_kink.then_some(sides) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stencil(f: impl Fn(f64) -> f64, number: f64, step: f64, is_wide: bool) -> Stencil {
        let at = |part: f64| f(number * (1.0 + part));
        let inner = is_wide.then(|| [at(-0.5 * step), at(0.5 * step)]);
        let values = [at(-step), at(0.0), at(step)];
        Stencil { number, step, values, inner, noise: 0.0, common: 0.0 }
    }

    #[test]
    fn errors_cover_the_truth_and_are_of_the_steps_square_or_better() {
        type Function = fn(f64) -> f64;
        let cases: [[Function; 2]; 4] = [
            [f64::sqrt, |x| 0.5 / x.sqrt()],
            [|x| x.powf(-2.5), |x| -2.5 * x.powf(-3.5)],
            [|x| (3.0 * x).sin(), |x| 3.0 * (3.0 * x).cos()],
            [|x| (x * x).exp(), |x| 2.0 * x * (x * x).exp()],
        ];
        for [f, derivative] in cases {
            for number in [0.3, 1.0, 1.7] {
                let right = derivative(number);
                let three = stencil(f, number, 1e-3, false).slope();
                let scale = stencil(f, number, 1e-3, false).scale(right) / number;
                let rounding = 1e-12 * scale;
                assert!((three.value - right).abs() <= three.error + rounding, "{three:?} {right}");
                assert!(three.error <= 1e-3 * scale, "{three:?} {scale}");
                let five = stencil(f, number, 1e-2, true).slope();
                assert!((five.value - right).abs() <= five.error + rounding, "{five:?} {right}");
                assert!((five.value - right).abs() <= 1e-6 * scale, "{five:?} {right}");
                assert!(five.error <= 1e-2 * scale && five.sides.is_none(), "{five:?} {scale}");
            }
        }
    }

    /// `c + √(x − x₀)`: what changes with the number is small beside the value, as the time of an event is late.
    #[test]
    fn beside_a_graze_three_values_tell_of_the_root() {
        for distance in [3e-3, 1e-2, 3e-2] {
            let f = |x: f64| 10.0 + (x - 0.3 + distance).sqrt();
            let own = stencil(f, 0.3, 1e-3, false).slope();
            let off = (own.value - 0.5 / distance.sqrt()).abs();
            assert!(off <= own.error && own.error <= 30.0 * off, "{own:?} {off}");
        }
    }

    #[test]
    fn a_kink_has_two_slopes_and_an_error_that_does_not_fall_with_the_step() {
        let f = |x: f64| if x > 1.0 { 2.0 * x } else { 1.0 + x * x * x - x + 1.0 };
        for step in [1e-2, 1e-3, 1e-4] {
            let own = stencil(f, 1.0, step, true).slope();
            // 3x² − 1 = 2 on both sides: no kink but in the second derivative.
            assert!(own.error < 20.0 * step, "{own:?}");
            let own = stencil(|x| x + 0.1 * (x - 1.0).abs(), 1.0, step, true).slope();
            let [below, above] = own.sides.unwrap();
            assert!((below - 0.9).abs() < 1e-9 && (above - 1.1).abs() < 1e-9, "{own:?}");
            assert!(own.error >= 0.1, "{own:?}");
        }
    }
}
