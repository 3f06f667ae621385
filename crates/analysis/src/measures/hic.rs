//! Head injury criterion.

use dashpot_network::parameters::{
    Dimension, InvalidParameter, Parameter, ParameterKind, Value, WindowWish,
};

use super::{
    Family, MASSLESS, MeasureKind, Needs, Reading, STANDARD_GRAVITY, WINDOW, reading::infinite,
    window,
};
use crate::{Solution, hic_search::optimum};

/// The head injury criterion of what an accelerometer on a body reads,
/// `HIC = max (t2 − t1) [∫ |a|/g0 dt / (t2 − t1)]^2.5` \[s\] over all intervals `[t1, t2]` no
/// longer than a cap. The window reported is the interval found. Where the speed jumps, it is
/// infinite.
///
/// | symbol | field | unit | range    |
/// |--------|-------|------|----------|
/// |        | `cap` | s    | positive |
/// | `g0`   | [`STANDARD_GRAVITY`] | m/s² | |
///
/// A half-sine of height `A g0` and length `T` has `HIC = 0.41464565 A^2.5 T` without a cap, over
/// an interval of `0.6702297 T`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hic {
    /// The longest interval \[s\].
    pub cap: f64,
    /// The part of the run in which the interval lies.
    pub window: WindowWish,
}

impl Default for Hic {
    fn default() -> Self {
        Self { cap: 1e6, window: WindowWish::Impact }
    }
}

impl MeasureKind for Hic {
    const KIND: &'static str = "hic";
    const SUMMARY: &'static str = "head injury criterion over intervals up to a cap [s]";
    const UNIT: &'static str = "s";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::optional(
            "cap",
            ParameterKind::Quantity(Dimension::TIME),
            "1e6 s",
            "longest interval [s], positive; the default is as good as none",
        ),
        WINDOW,
    ];
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let range = "positive and finite";
        match values.first().and_then(Value::number) {
            Some(cap) if cap > 0.0 && cap.is_finite() => {
                Ok(Self { cap, window: window(values, 1)? })
            }
            Some(cap) => Err(InvalidParameter::new("cap", range, cap)),
            None => Err(InvalidParameter::new("cap", range, "missing")),
        }
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Number(self.cap), Value::Window(self.window)]
    }

    fn gravities(&self) -> f64 {
        2.5
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(acceleration) = solution.assembly().nodes[target].acceleration else {
            return Reading::undefined(MASSLESS);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        if let Some(reading) = infinite(&span, &solution.node_blows(target)) {
            return reading;
        }
        let acceleration = solution.signal(acceleration).scaled(1.0 / STANDARD_GRAVITY);
        let found = optimum(&acceleration, span.window(), self.cap);
        let length = found.interval.1 - found.interval.0;
        let mean = if length > 0.0 { (found.value / length).powf(0.4) } else { 0.0 };
        let growth = 2.5 * mean.powf(1.5);
        let is_at_end = found.interval.1 >= span.to;
        let last = if is_at_end { acceleration.left_value(span.to).abs() } else { 0.0 };
        let error = acceleration.error.zip(span.to_error).map(|(error, shift)| {
            growth * (error * length + last * shift) + found.doubt + 1e-13 * found.value
        });
        let reading = Reading::over(&span, found.value, error).changing(growth * last);
        Reading { window: Some(found.interval), ..reading }
    }
}
