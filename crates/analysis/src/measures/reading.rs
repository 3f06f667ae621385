//! What a measure yields, and how errors of signals become errors of measures.

use dashpot_dae::Signal;
use dashpot_network::ConnectionOutputs;

use crate::{Solution, impact::Span, ledger};

/// A number read off a solution.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The value in the measure's unit; `None` where it is infinite or undefined, and the note
    /// says why.
    pub value: Option<f64>,
    /// The size to which a relative accuracy refers: the value's own, or where the value is a
    /// difference of larger things, theirs.
    pub size: f64,
    /// When it occurs \[s\], where it occurs at a time.
    pub time: Option<f64>,
    /// The part of the run that it belongs to \[s\].
    pub window: Option<(f64, f64)>,
    /// Bound of its absolute error, where the method bounds that of its signals.
    pub error: Option<f64>,
    /// What is to be said about it.
    pub note: Option<String>,
    /// Values below this cannot be told from zero.
    pub noise: f64,
    /// How fast the value changes at most with the end of its window \[unit/s\].
    pub end_rate: f64,
}

impl Reading {
    /// No value, and why.
    pub fn undefined(note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..Self::default() }
    }

    /// A value over a span, of its own size. A value that is not finite becomes `None` with a note.
    pub(crate) fn over(span: &Span, value: f64, error: Option<f64>) -> Self {
        let reading = Self {
            value: Some(value),
            size: value.abs(),
            time: None,
            window: Some(span.window()),
            error,
            note: span.note.map(str::to_owned),
            noise: 0.0,
            end_rate: 0.0,
        };
        if value.is_finite() {
            reading
        } else {
            Self { value: None, size: 0.0, ..reading }
                .noting("beyond the range of double precision")
        }
    }

    /// The same reading of a larger size.
    #[must_use]
    pub(crate) fn of_size(self, size: f64) -> Self {
        Self { size: self.size.max(size), ..self }
    }

    /// The same reading with a noise.
    #[must_use]
    pub(crate) fn above(self, noise: f64) -> Self {
        Self { noise, ..self }
    }

    /// The same reading with a rate of change with the window's end.
    #[must_use]
    pub(crate) fn changing(self, end_rate: f64) -> Self {
        Self { end_rate: end_rate.abs(), ..self }
    }

    /// The same reading at a time.
    #[must_use]
    pub(crate) fn at(self, time: f64) -> Self {
        Self { time: Some(time), ..self }
    }

    /// The same reading with a further note.
    #[must_use]
    pub(crate) fn noting(self, note: &str) -> Self {
        let note = match self.note {
            Some(before) => format!("{before}; {note}"),
            None => note.to_owned(),
        };
        Self { note: Some(note), ..self }
    }
}

/// The largest magnitude of a signal over a span.
pub(crate) fn peak(signal: &Signal, span: &Span) -> Reading {
    let peak = signal.absolute_maximum(span.window());
    // An end that is not known to the last digit moves a peak that lies at it.
    let end_rate = if peak.time >= span.to { signal.slope(span.to).abs() } else { 0.0 };
    let error = signal.error.zip(span.to_error);
    let error = error.map(|(error, shift)| error + moved(end_rate, shift));
    Reading::over(span, peak.value, error).at(peak.time).above(signal.noise).changing(end_rate)
}

/// Whether the largest magnitude of a signal over a span is that of a negative value.
pub(crate) fn peaks_below_zero(signal: &Signal, span: &Span) -> bool {
    -signal.minimum(span.window()).value > signal.maximum(span.window()).value
}

/// The value of a signal at the end of a span.
pub(crate) fn end_value(signal: &Signal, span: &Span) -> Reading {
    let end_rate = signal.slope(span.to).abs();
    let error = signal.error.zip(span.to_error);
    let error = error.map(|(error, shift)| error + moved(end_rate, shift));
    Reading::over(span, signal.left_value(span.to), error)
        .of_size(signal.absolute_maximum(span.window()).value)
        .at(span.to)
        .above(signal.noise)
        .changing(end_rate)
}

/// The integral of a signal over a span.
pub(crate) fn integral(signal: &Signal, span: &Span) -> Reading {
    let size = signal.integral_of(span.window(), &[0.0], f64::abs);
    let last = signal.left_value(span.to).abs();
    let error = signal.error.zip(span.to_error);
    let error = error.map(|(error, shift)| error * span.length() + last * shift);
    let noise = signal.noise * span.length();
    let value = signal.integral(span.window());
    Reading::over(span, value, error).of_size(size).above(noise).changing(last)
}

/// How far a value moves at this rate because the end of its span does.
fn moved(rate: f64, shift: f64) -> f64 {
    if shift > 0.0 { rate * shift } else { 0.0 }
}

/// The work that an element takes up over a span, `∫ F ẏ dt` and what jumps of its deformation
/// store.
pub(crate) fn work(
    solution: &Solution<'_>,
    connection: &ConnectionOutputs,
    span: &Span,
) -> Reading {
    let Some(force) = connection.force.map(|force| solution.signal(force)) else {
        return Reading::undefined("the force is undetermined");
    };
    let rate = solution.rate(connection.rate, connection.deformation);
    let primitives = connection.primitives.clone();
    let value = force.integral_of_product(&rate, span.window())
        + ledger::steps(solution, primitives, span.window());
    let magnitude = |signal: &Signal| signal.absolute_maximum(span.window()).value;
    let most_force = magnitude(force);
    let last = (force.left_value(span.to) * rate.left_value(span.to)).abs();
    let error = ledger::work_error(force, &rate, span.window()).zip(span.to_error);
    let error = error.map(|(error, shift)| error + moved(last, shift));
    // What a spring of this peak force and deformation takes up, and may give back.
    let deformation = magnitude(solution.signal(connection.deformation));
    let area = |signal: &Signal| signal.integral_of(span.window(), &[0.0], f64::abs);
    let noise = force.noise * area(&rate) + rate.noise * area(force);
    Reading::over(span, value, error)
        .of_size(0.5 * most_force * deformation)
        .above(noise)
        .changing(last)
}
