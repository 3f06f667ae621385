//! What a measure yields, and how errors of signals become errors of measures.

use dashpot_dae::{Extremum, Signal};

use crate::{
    Note,
    impact::{impulses::VelocityJump, interval::Span},
};

/// A number read off a solution.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// The value in the measure's unit; `None` where it is infinite or undefined, and a note says why.
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
    pub fn over(span: &Span, value: f64, error: Option<f64>) -> Self {
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

    /// The same reading of a larger size, where what is measured is a difference of larger things.
    #[must_use]
    pub fn of_size(self, size: f64) -> Self {
        Self { size: self.size.max(size), ..self }
    }

    /// The same reading with a noise, below which it cannot be told from zero.
    #[must_use]
    pub fn above(self, noise: f64) -> Self {
        Self { noise, ..self }
    }

    /// The same reading with a rate of change with the window's end \[unit/s\].
    #[must_use]
    pub fn changing(self, end_rate: f64) -> Self {
        Self { end_rate: end_rate.abs(), ..self }
    }

    /// The same reading at a time \[s\].
    #[must_use]
    pub fn at(self, time: f64) -> Self {
        Self { time: Some(time), ..self }
    }

    /// The same reading with a further note.
    #[must_use]
    pub fn noting(mut self, note: Note) -> Self {
        self.notes.push(note);
        self
    }

    /// The same reading with a further note, where it is true.
    #[must_use]
    pub(crate) fn noting_if(self, is_so: bool, note: Note) -> Self {
        if is_so { self.noting(note) } else { self }
    }

    /// The same reading of a largest value, where that just before the span counts as well.
    pub(super) fn with_value_before(self, before: Option<f64>, span: &Span) -> Self {
        match before.zip(self.value).filter(|(before, value)| before > value) {
            Some((before, _)) => Self { value: Some(before), ..self }.of_size(before).at(span.from),
            None => self,
        }
    }

    /// No value, where speeds jump within the span so that what is measured is infinite there: the force
    /// of an element in which masses meet, the acceleration of a node. `None` where none does.
    pub fn infinite(span: &Span, jumps: &[VelocityJump]) -> Option<Self> {
        let first = VelocityJump::within(jumps, span.window()).first()?;
        let reading = Self { value: None, size: 0.0, ..Self::over(span, 0.0, None) };
        Some(reading.at(first.time).noting(Note::Infinite(first.time)))
    }

    /// The largest magnitude of a signal over a span, with its time.
    pub fn peak(signal: &Signal, span: &Span) -> Self {
        Self::at_extremum(signal, span, signal.absolute_maximum(span.window()))
    }

    /// The largest value of a signal over a span, with its time; 0 where all are negative.
    pub fn positive_peak(signal: &Signal, span: &Span) -> Self {
        let most = signal.maximum(span.window());
        Self::at_extremum(signal, span, Extremum { value: most.value.max(0.0), ..most })
    }

    fn at_extremum(signal: &Signal, span: &Span, peak: Extremum) -> Self {
        // An end that is not known to the last digit moves a peak that lies at it.
        let end_rate = if peak.time >= span.to { signal.slope(span.to).abs() } else { 0.0 };
        let error = signal.error.zip(span.to_error);
        let error = error.map(|(error, shift)| error + moved(end_rate, shift));
        Self::over(span, peak.value, error).at(peak.time).above(signal.noise).changing(end_rate)
    }

    /// The value of a signal at the end of a span; of what jumps there that before the jump.
    pub fn end_value(signal: &Signal, span: &Span) -> Self {
        let end_rate = signal.slope(span.to).abs();
        let error = signal.error.zip(span.to_error);
        let error = error.map(|(error, shift)| error + moved(end_rate, shift));
        Self::over(span, signal.left_value(span.to), error)
            .of_size(signal.absolute_maximum(span.window()).value)
            .at(span.to)
            .above(signal.noise)
            .changing(end_rate)
    }

    /// The integral of a signal over a span.
    pub fn integral(signal: &Signal, span: &Span) -> Self {
        let size = signal.absolute_integral(span.window());
        let last = signal.left_value(span.to).abs();
        let error = signal.error.zip(span.to_error);
        let error = error.map(|(error, shift)| error * span.length() + last * shift);
        let noise = signal.noise * span.length();
        let value = signal.integral(span.window());
        Self::over(span, value, error).of_size(size).above(noise).changing(last)
    }

    /// The same reading over the length of its span, which is positive: the mean of what it is the integral of.
    #[must_use]
    pub fn mean(self, span: &Span) -> Self {
        let length = span.length();
        let value = self.value.map_or(f64::NAN, |value| value / length);
        // A longer window adds to the integral, and divides it by more.
        let stretch = span.to_error.map(|shift| value.abs() * shift / length);
        let error = self.error.zip(stretch).map(|(error, stretch)| error / length + stretch);
        Self::over(span, value, error)
            .of_size(self.size / length)
            .above(self.noise / length)
            .changing((self.end_rate + value.abs()) / length)
    }

    /// The same reading with what impulses add to it: `amount` is their sum, `size` that of their
    /// magnitudes, `error` its bound, where it is known. Nothing where the size is 0.
    #[must_use]
    pub fn plus(self, amount: f64, size: f64, error: Option<f64>) -> Self {
        if size == 0.0 {
            return self;
        }
        Self {
            value: self.value.map(|value| value + amount),
            size: self.size + size,
            error: self.error.zip(error).map(|(one, other)| one + other),
            ..self
        }
    }
}

/// Whether the largest magnitude of a signal over a span is that of a negative value.
pub(super) fn peaks_below_zero(signal: &Signal, span: &Span) -> bool {
    -signal.minimum(span.window()).value > signal.maximum(span.window()).value
}

/// How far a value moves at this rate because the end of its span does.
pub(super) fn moved(rate: f64, shift: f64) -> f64 {
    if shift > 0.0 { rate * shift } else { 0.0 }
}
