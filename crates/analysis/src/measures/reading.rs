//! What a measure yields, and how errors of signals become errors of measures.

use dashpot_dae::{Extremum, Signal};
use dashpot_network::{ConnectionOutputs, PrimitiveOutputs};

use crate::{
    Note, Solution,
    energy::{
        ledger,
        roles::{self, Accounts},
    },
    impact::{
        impulses::{self, Blow},
        interval::Span,
    },
};

/// A number read off a solution.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The value in the measure's unit; `None` where it is infinite or undefined, and a note
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
    pub notes: Vec<Note>,
    /// Values below this cannot be told from zero.
    pub noise: f64,
    /// How fast the value changes at most with the end of its window \[unit/s\].
    pub end_rate: f64,
    /// By how much it might be larger \[unit\] and there would still be a value, where the run may end
    /// before there is one.
    pub room: Option<f64>,
}

impl Reading {
    /// No value, and why.
    pub fn undefined(note: Note) -> Self {
        Self { notes: vec![note], ..Self::default() }
    }

    /// A value over a span, of its own size. A value that is not finite becomes `None` with a note.
    pub(crate) fn over(span: &Span, value: f64, error: Option<f64>) -> Self {
        let reading = Self {
            value: Some(value),
            size: value.abs(),
            time: None,
            window: Some(span.window()),
            error,
            notes: span.note.clone().into_iter().collect(),
            noise: 0.0,
            end_rate: 0.0,
            room: None,
        };
        if value.is_finite() {
            reading
        } else {
            Self { value: None, size: 0.0, ..reading }.noting(Note::BeyondRange)
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
    pub(crate) fn noting(mut self, note: Note) -> Self {
        self.notes.push(note);
        self
    }
}

/// No value, where masses meet within the span so that what is measured is infinite there.
pub(crate) fn infinite(span: &Span, blows: &[Blow]) -> Option<Reading> {
    let first = impulses::within(blows, span.window()).first()?;
    let reading = Reading { value: None, size: 0.0, ..Reading::over(span, 0.0, None) };
    Some(reading.at(first.time).noting(Note::Infinite(first.time)))
}

/// The largest magnitude of a signal over a span.
pub(crate) fn peak(signal: &Signal, span: &Span) -> Reading {
    at_extremum(signal, span, signal.absolute_maximum(span.window()))
}

/// The largest value of a signal over a span, 0 where all are negative.
pub(crate) fn positive_peak(signal: &Signal, span: &Span) -> Reading {
    let most = signal.maximum(span.window());
    at_extremum(signal, span, Extremum { value: most.value.max(0.0), ..most })
}

fn at_extremum(signal: &Signal, span: &Span, peak: Extremum) -> Reading {
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
    let size = signal.absolute_integral(span.window());
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

/// The reading with what impulses add to it: `amount` is their sum, `size` that of their
/// magnitudes.
pub(crate) fn with_blows(reading: Reading, amount: f64, size: f64, error: Option<f64>) -> Reading {
    if size == 0.0 {
        return reading;
    }
    Reading {
        value: reading.value.map(|value| value + amount),
        size: reading.size + size,
        error: reading.error.zip(error).map(|(one, other)| one + other),
        ..reading
    }
}

/// The work that an element takes up over a span, `∫ F ẏ dt`, what jumps of its deformation store,
/// and what impacts in it lose.
pub(crate) fn work(solution: &Solution<'_>, target: usize, span: &Span) -> Reading {
    let connection = &solution.assembly().connections[target];
    let Some(force) = connection.force.map(|force| solution.signal(force)) else {
        return Reading::undefined(Note::NoForce);
    };
    let rate = solution.rate_of(connection);
    let window = span.window();
    let last = (force.left_value(span.to) * rate.left_value(span.to)).abs();
    let (value, error) = if span.length() <= 0.0 {
        (0.0, Some(0.0))
    } else if connection.has_layers
        || rate.error.is_none()
        || has_only_springs(solution, connection)
    {
        work_of_parts(solution, connection, window)
    } else {
        let steps = ledger::steps(solution, connection.primitives.clone(), window);
        let work = force.integral_of_product(&rate, window) + steps;
        (work, ledger::work_error(force, &rate, window))
    };
    let error = error.zip(span.to_error).map(|(error, shift)| error + moved(last, shift));
    let magnitude = |signal: &Signal| signal.absolute_maximum(window).value;
    let most_force = magnitude(force);
    // What a spring of this peak force and deformation takes up, and may give back.
    let deformation = solution.glance(connection.deformation);
    let deformation = if connection.never_pulls {
        deformation.maximum(window).value.max(0.0)
    } else {
        magnitude(&deformation)
    };
    let area = |signal: &Signal| signal.area_bound(window);
    let noise = force.noise * area(&rate) + rate.noise * area(force);
    let blows = impulses::within(solution.element_blows(target), window);
    let lost: f64 = blows.iter().map(|own| own.lost).sum();
    let push: f64 = blows.iter().map(|own| own.impulse).sum();
    // What is lost changes with the speeds by no more than the impulse.
    let of_approach = if lost == 0.0 { None } else { solution.approach(connection).error };
    let error_of_lost = of_approach.map(|error| push * error);
    let reading = Reading::over(span, value, error)
        .of_size(0.5 * most_force * deformation)
        .above(noise)
        .changing(last);
    with_blows(reading, lost, lost.abs(), error_of_lost)
}

/// Whether an element is made of springs alone, and contacts that do no work: then its work is a matter of
/// both ends of the window, and errors on the way do not add up.
fn has_only_springs(solution: &Solution<'_>, connection: &ConnectionOutputs) -> bool {
    let parts = solution.assembly().primitives.get(connection.primitives.clone());
    let is_spring = |part: &PrimitiveOutputs| {
        let own = Accounts::of(part.element.as_ref());
        own.stores && !own.dissipates
    };
    parts.is_some_and(|parts| parts.iter().all(|part| is_spring(part) || !ledger::does_work(part)))
}

/// The work \[J\] that an element takes up as the sum over its parts, and a bound of its error: in
/// networks that switch, where elements have no rate of their own, of springs alone, and of layers with
/// masses between them, which do not all feel one force.
fn work_of_parts(
    solution: &Solution<'_>,
    connection: &ConnectionOutputs,
    window: (f64, f64),
) -> (f64, Option<f64>) {
    let primitives = solution.assembly().primitives.get(connection.primitives.clone());
    let (mut work, mut bound) = (0.0, Some(0.0));
    for primitive in primitives.unwrap_or(&[]) {
        let own = Accounts::of(primitive.element.as_ref());
        let error = if own.dissipates {
            let force = &solution.glance(primitive.force);
            let rate = solution.rate(primitive.rate, primitive.deformation);
            if ledger::does_work(primitive) {
                work += force.integral_of_product(&rate, window);
                ledger::work_error(force, &rate, window)
            } else {
                Some(0.0)
            }
        } else if own.stores {
            let deformation = solution.glance(primitive.deformation);
            let stored = |time, y| roles::stored(solution.run(), primitive, time, y);
            let (from, to) = (deformation.value(window.0), deformation.left_value(window.1));
            work += stored(window.1, to) - stored(window.0, from);
            let at = |y: f64, error: f64| {
                let slope = primitive.element.tangent(y, 0.0).stiffness.abs();
                slope * error * (y.abs() + error)
            };
            deformation.error.map(|error| at(from, error) + at(to, error))
        } else {
            Some(0.0)
        };
        bound = bound.zip(error).map(|(sum, error)| sum + error);
    }
    (work, bound)
}
