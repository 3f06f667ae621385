//! Clip: what is exceeded for a given time.

use dashpot_network::parameters::{
    Dimension, InvalidParameter, Parameter, ParameterKind, Value, WindowWish, positive,
};

use super::{Family, MASSLESS, MeasureKind, Needs, Reading, WINDOW, window};
use crate::{
    Solution,
    exceedance::{Counted, Exceedance},
};

/// The largest acceleration that is reached or exceeded for a given time: the largest `A` \[m/s²\]
/// with `|a| ≥ A` for at least the `duration`, where `a` is what an accelerometer on the body reads.
///
/// | symbol | field      | unit | range    |
/// |--------|------------|------|----------|
/// | `d`    | `duration` | s    | positive |
/// |        | `counted`  |      | [`Counted`] |
///
/// Times are counted `together` (all of them are added up) or `at-once` (within one stretch). It is 0
/// where the whole window is shorter than the duration. Where the speed jumps it is not infinite,
/// because a jump takes no time.
///
/// A half-sine of height `A` and length `T` has `A cos(π d/(2 T))`, counted either way; of two equal
/// ones apart from each other the times count together as those of one of twice the length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clip {
    /// The time `d` \[s\].
    pub duration: f64,
    /// Which times count.
    pub counted: Counted,
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for Clip {
    fn default() -> Self {
        Self { duration: 0.003, counted: Counted::Together, window: WindowWish::Impact }
    }
}

/// The parameter that says which times count.
pub(super) const COUNTED: Parameter = Parameter::optional(
    "counted",
    ParameterKind::Choice(Counted::WORDS),
    "together",
    "`together`: all times are added up; `at-once`: those of one stretch",
);

/// What [`COUNTED`] is, from the value at `at`.
pub(super) fn counted(values: &[Value], at: usize) -> Result<Counted, InvalidParameter> {
    let word = match values.get(at) {
        Some(Value::Word(word)) => Counted::named(word),
        _ => None,
    };
    let invalid = || InvalidParameter::new("counted", "`together` or `at-once`", "something else");
    word.ok_or_else(invalid)
}

impl MeasureKind for Clip {
    const KIND: &'static str = "clip";
    const SUMMARY: &'static str = "largest acceleration that is exceeded for a given time [m/s^2]";
    const UNIT: &'static str = "m/s^2";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::optional(
            "duration",
            ParameterKind::Quantity(Dimension::TIME),
            "3 ms",
            "the time d [s], positive",
        ),
        COUNTED,
        WINDOW,
    ];
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let duration = values.first().and_then(Value::number);
        let missing = || InvalidParameter::new("duration", "a number", "missing");
        let duration = duration.ok_or_else(missing)?;
        positive("duration", duration)?;
        Ok(Self { duration, counted: counted(values, 1)?, window: window(values, 2)? })
    }

    fn values(&self) -> Vec<Value> {
        let counted = Value::Word(self.counted.word().to_owned());
        vec![Value::Number(self.duration), counted, Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let Some(acceleration) = solution.assembly().nodes[target].acceleration else {
            return Reading::undefined(MASSLESS);
        };
        let span = match solution.node_impact(target).span(self.window, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let signal = solution.signal(acceleration);
        let found = Exceedance::new(signal, span.window()).level(self.duration, self.counted);
        // Values move by the error of the signal, and a longer window moves the level no faster than
        // the signal itself.
        let end_rate = if found.reaches_end { found.slope } else { 0.0 };
        let error = signal.error.zip(span.to_error);
        let error =
            error.map(|(error, shift)| error + if shift > 0.0 { end_rate * shift } else { 0.0 });
        let reading = Reading::over(&span, found.value, error).of_size(found.value);
        let reading = reading.above(signal.noise).changing(end_rate);
        if span.length() < self.duration {
            return reading.noting("the window is shorter than the time that counts");
        }
        reading
    }
}
