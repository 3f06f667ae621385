//! Intervals that are over before a method has seen them.
//!
//! What rebounds slowly comes back from so near that the way out and back is less than the method's
//! error, or the rounding of what is far away. The series of the derivatives at the interval's
//! start tells all about so short an interval.

use std::time::Instant;

use dashpot_numerics::chebyshev::Interpolation;

use super::ModeInterval;
use crate::{
    Dense, Derivatives, Direction, Event, Guard, Method, Observer, Outcome, Panel, Progress, Run,
    Signal, SolveError, Statistics, System, Trajectory, derivatives,
    events::scan,
    pieces::{Pieces, ROUNDING, between},
};

/// A guard that ends an interval at a time that is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PredictedEvent {
    /// Index into [`ModeInterval::guards`].
    pub guard: usize,
    /// When, from the start of the interval, in units of its system's time, positive.
    pub length: f64,
}

/// The highest order of the derivatives that are used.
const ORDERS: usize = 7;
/// What the last two orders may contribute, in parts of the whole and of the threshold.
const NEGLIGIBLE: f64 = 1e-3;
/// The error of an interval that follows an exact solution, in parts of the rounding of its values:
/// they are sums of larger terms.
const ERROR: f64 = 8.0;
/// Most improvements of the time at which a quantity comes back.
const IMPROVEMENTS: usize = 30;

impl PredictedEvent {
    /// How an interval of `system` ends at the guard number `guard`, if that is reached soon by what begins on its
    /// inner side, and how far it strays from its level before, in the output's unit. `None` where the `motion`, which
    /// is the derivatives up to order 7, does not tell all about so long a time; `threshold` is as in
    /// [`IntervalEnd::threshold`](crate::IntervalEnd::threshold).
    pub fn of(
        system: &System,
        motion: &Derivatives,
        guard: (usize, &Guard),
        threshold: f64,
    ) -> Option<(Self, f64)> {
        let (guard, own) = guard;
        if !system.is_linear() || motion.values.len() <= ORDERS {
            return None;
        }
        let outward = match own.direction {
            Direction::Rising => 1.0,
            Direction::Falling => -1.0,
            Direction::Either => return None,
        };
        let output = system.outputs.get(own.output)?;
        let mut gap = series(|order| -outward * motion.output(output, order).0);
        gap[0] = (gap[0] + outward * own.level).max(0.0);
        let (length, height) = back(&gap, threshold)?;
        let is_told = |unknown: usize| {
            is_settled(&series(|order| motion.values[order][unknown].abs()), length, threshold)
        };
        let is_smooth = system.breakpoints(2.0 * length).is_empty();
        let is_known = is_smooth && (0..system.len()).all(is_told);
        is_known.then_some((Self { guard, length }, height))
    }
}

/// The coefficients of a Taylor series from its derivatives.
fn series(derivative: impl Fn(usize) -> f64) -> [f64; ORDERS + 1] {
    let mut factorial = 1.0;
    std::array::from_fn(|order| {
        let factor = order.max(1) as f64;
        factorial *= factor;
        derivative(order) / factorial
    })
}

/// When a quantity of this series that begins at zero or above falls through zero, and how high it rises before.
fn back(gap: &[f64; ORDERS + 1], threshold: f64) -> Option<(f64, f64)> {
    let [start, rate, bend, ..] = *gap;
    let root = (rate * rate - 4.0 * bend * start).sqrt();
    let rises = rate > 0.0;
    let first = if rises { (rate + root) / (-2.0 * bend) } else { 2.0 * start / (root - rate) };
    let mut time = first;
    for _ in 0..IMPROVEMENTS {
        let (mut value, mut slope) = (0.0, 0.0);
        for &coefficient in gap.iter().rev() {
            slope = slope * time + value;
            value = value * time + coefficient;
        }
        let next = time - value / slope;
        let is_found = (next - time).abs() <= 2.0 * f64::EPSILON * time;
        time = next;
        if is_found {
            break;
        }
    }
    // What improves it by much has led to another root.
    let is_near = (time - first).abs() <= 0.1 * first;
    let is_told = time > 0.0 && is_near && is_settled(&gap.map(f64::abs), time, threshold);
    let height = if rises { start + rate * rate / (-4.0 * bend) } else { start };
    is_told.then_some((time, height))
}

/// Whether the last orders of a series contribute next to nothing to what it changes by.
fn is_settled(sizes: &[f64; ORDERS + 1], time: f64, threshold: f64) -> bool {
    let mut power = 1.0;
    let (mut whole, mut last) = (0.0, 0.0);
    for (order, size) in sizes.iter().enumerate().skip(1) {
        power *= time;
        whole += size * power;
        if order + 1 >= ORDERS {
            last += size * power;
        }
    }
    last <= NEGLIGIBLE * threshold * whole
}

/// Solves an interval whose end is known by its series; `None` where the series cannot be had.
/// Errors: [`SolveError::Cancelled`] where the observer ends the run.
pub(super) fn follow(
    interval: &ModeInterval,
    predicted: PredictedEvent,
    method: &dyn Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Option<Trajectory>, SolveError> {
    let begin = Instant::now();
    let system = interval.system.as_ref();
    let Ok(motion) = derivatives(system, &system.initial, ORDERS) else { return Ok(None) };
    let mut pieces = Pieces::new(system, run);
    let mut row = vec![0.0; system.len()];
    let state = |time: f64, row: &mut Vec<f64>| {
        for (unknown, value) in row.iter_mut().enumerate() {
            let terms = series(|order| motion.values[order][unknown]);
            *value = terms.iter().rev().fold(0.0, |sum, term| sum * time + term);
        }
    };
    for &node in Interpolation::of_degree(ORDERS).nodes() {
        let time = between(0.0, predicted.length, node);
        state(time, &mut row);
        if time > 0.0 {
            pieces.add_row(system, time, &row);
        } else {
            pieces.begin(system, 0.0, &row);
        }
    }
    pieces.end_step(system, ORDERS);
    let whole = predicted.length * system.time_scale;
    let signal = |(at, guard): (usize, &Guard)| {
        if at == predicted.guard {
            // Its end is known better than by looking.
            let inside = guard.begins.map_or(0.0, |above| if above { 1.0 } else { -1.0 });
            let value = guard.level + inside * guard.level.abs().max(1.0);
            return Signal::new(vec![Panel::constant(0.0, whole, value)], None, 0.0);
        }
        let output = system.outputs.at(guard.output);
        let mut signal = pieces.whole(system, output);
        let largest = signal.noise / (ROUNDING * f64::EPSILON);
        if !method.is_exact() {
            signal.noise = signal.noise.max(run.rtol * largest.max(output.scale.abs()));
        }
        signal
    };
    let signals: Vec<Signal> = run.guards.iter().enumerate().map(signal).collect();
    let (mut events, stop) = scan(&run.guards, &signals);
    let (outcome, t_end) = match stop {
        Some(stop) if stop.time <= run.t_end => (Outcome::Stopped { guard: stop.guard }, stop.time),
        _ if whole <= run.t_end => {
            let guard = predicted.guard;
            let rising = run.guards[guard].direction == Direction::Rising;
            events.push(Event { time: whole, guard, rising });
            (Outcome::Stopped { guard }, whole)
        }
        _ => (Outcome::Finished, run.t_end),
    };
    events.retain(|event| event.time <= t_end);
    pieces.finish(system, t_end);
    if observer.progress(Progress { time: t_end, steps: 1 }).is_break() {
        return Err(SolveError::Cancelled { time: t_end });
    }
    let wall = begin.elapsed();
    Ok(Some(Trajectory {
        method: method.name(),
        outcome,
        t_end,
        events,
        first_phases: Vec::new(),
        switches: Vec::new(),
        statistics: Statistics { accepted: 1, wall, ..Statistics::default() },
        dense: if method.is_exact() { Box::new(Bounded(pieces)) } else { Box::new(pieces) },
    }))
}

/// An interval of an exact solution: its error is that of rounding.
#[derive(Debug)]
struct Bounded(Pieces);

impl Dense for Bounded {
    fn signal(&self, system: &System, output: usize) -> Signal {
        let own = self.0.signal(system, output);
        Signal { error: Some(ERROR * own.noise), ..own }
    }

    fn sample(&self, system: &System, times: &[f64]) -> Vec<f64> {
        self.0.sample(system, times)
    }

    fn bytes(&self) -> usize {
        self.0.bytes()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Piece, Waveform, tests::problems};

    const THRESHOLD: f64 = 1e-10;

    fn falling(output: usize, level: f64) -> Guard {
        Guard {
            name: String::new(),
            output,
            level,
            direction: Direction::Falling,
            stops: true,
            begins: Some(true),
            rate_of: None,
        }
    }

    /// `x″ + 0.4 x′ + x = −1` from the middle upwards.
    fn thrown(speed: f64) -> System {
        let mut system = problems::driven_by_sine().system;
        system.waveforms = vec![Waveform::constant(-1.0)];
        system.initial = vec![0.0, speed];
        system
    }

    fn predicted(system: &System) -> Option<(PredictedEvent, f64)> {
        let motion = derivatives(system, &system.initial, ORDERS).unwrap();
        PredictedEvent::of(system, &motion, (3, &falling(0, 0.0)), THRESHOLD)
    }

    #[test]
    fn short_flight_ends_where_the_closed_form_does() {
        for speed in [1e-3, 1e-7, 1e-12] {
            let system = thrown(speed);
            let (found, height) = predicted(&system).unwrap();
            let scale = system.outputs.at(0).scale;
            // x = −1 + e^(−0.2 t) (cos ω t + (v + 0.2)/ω sin ω t), whose −1 cancels.
            let (t, omega) = (found.length, 0.96_f64.sqrt());
            let (half, decay) = ((0.5 * omega * t).sin(), (-0.2 * t).exp_m1());
            let wave = (speed + 0.2) / omega * (omega * t).sin() - 2.0 * half * half;
            let place = decay + wave + decay * wave;
            assert!(place.abs() < 1e-15 * t, "{speed:e}: {place:e} at {t:e}");
            assert!((height / (0.5 * speed * speed * scale) - 1.0).abs() < 0.5 * speed + 1e-12);
            assert_eq!(found.guard, 3);
        }
    }

    #[test]
    fn flight_that_the_series_does_not_tell_all_about_is_none() {
        assert!(predicted(&thrown(1.0)).is_none(), "too long");
        assert!(predicted(&thrown(-1e-3)).is_none(), "it does not rise");
        let step = |start: f64, value: f64| Piece { start, value, ..Piece::default() };
        let mut system = thrown(1e-3);
        system.waveforms = vec![Waveform::new(vec![step(0.0, -1.0), step(1e-3, 0.0)]).unwrap()];
        assert!(predicted(&system).is_none(), "the force changes on the way");
    }
}
