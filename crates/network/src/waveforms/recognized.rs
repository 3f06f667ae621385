//! Which kind a driving function is, told from its pieces.

use std::f64::consts::{PI, TAU};

use dashpot_dae::{Given, Piece, Waveform};

use super::{Constant, HalfSine, Haversine, Outside, Sine, Table, WaveformKind, before};
use crate::parameters::{InvalidParameter, Parameter, Value};

/// How far, relatively, the function of the kind may be from the one that was told: some kinds have
/// other numbers than their pieces.
const SAME: f64 = 1e-13;

/// A driving function by its kind and the values of that.
///
/// Straight lines with jumps are tables, whatever they were made as.
///
/// # Examples
///
/// ```
/// use dashpot_network::{
///     parameters::Value,
///     waveforms::{HalfSine, Recognized, WaveformKind},
/// };
///
/// let pulse = HalfSine { peak: 400.0, duration: 0.011, start: 0.0 }.waveform()?;
/// let motion = pulse.integral().and_then(|speed| speed.integral()).unwrap();
/// let (found, speed) = Recognized::as_acceleration(&motion).unwrap();
/// assert_eq!((found.word, speed), ("half-sine", 0.0));
/// assert!(matches!(found.values[0], Value::Number(peak) if (peak - 400.0).abs() < 1e-10));
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recognized {
    /// Word for the kind.
    pub word: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Their values.
    pub values: Vec<Value>,
    make: fn(&[Value]) -> Result<Waveform, InvalidParameter>,
}

impl Recognized {
    /// The kind of a function; `None` where its pieces do not show it.
    pub fn of(waveform: &Waveform) -> Option<Self> {
        line(waveform)
            .or_else(|| of_kind(waveform, &sine(waveform)?))
            .or_else(|| of_kind(waveform, &half_sine(waveform)?))
            .or_else(|| of_kind(waveform, &haversine(waveform)?))
    }

    /// The kind of the acceleration of a motion that begins at zero at `t = 0`, and the velocity \[m/s\] with which it
    /// begins; `None` where it is no such motion, or its pieces do not show the kind.
    pub fn as_acceleration(motion: &Waveform) -> Option<(Self, f64)> {
        let speed = motion.piece_at(0.0).derivative(1, 0.0);
        // What rounding leaves of a start from rest is none.
        [0.0, speed].into_iter().find_map(|speed| {
            let again = |own: &Waveform| own.motion(speed);
            Some((Self::of_derivative(motion, second_derivative, &again)?, speed))
        })
    }

    /// The kind of the velocity of a motion that begins at zero at `t = 0`; `None` likewise.
    pub fn as_velocity(motion: &Waveform) -> Option<Self> {
        Self::of_derivative(motion, first_derivative, &Waveform::integral)
    }

    /// The kind of a derivative of a motion, which leads `again` to it.
    fn of_derivative(
        motion: &Waveform,
        derivative: fn(&Piece) -> Option<Piece>,
        again: &dyn Fn(&Waveform) -> Option<Waveform>,
    ) -> Option<Self> {
        let pieces = motion.pieces().iter().map(derivative).collect::<Option<Vec<Piece>>>()?;
        let is_of = |own: &Self| {
            let made = (own.make)(&own.values).ok();
            let again = made.and_then(|made| again(&made));
            again.is_some_and(|again| is_same(motion, &again))
        };
        // What lies before t = 0 is not kept by the motion.
        let quiet = Piece { start: before(pieces.first()?.start), ..Piece::default() };
        let with_quiet = std::iter::once(quiet).chain(pieces.iter().copied()).collect();
        let given = motion.given().map(|own| Given { integrals: 0, ..own });
        let as_given = |waveform: Waveform| match given {
            Some(given) => waveform.given_at(given),
            None => waveform,
        };
        let both = [Waveform::new(pieces), Waveform::new(with_quiet)];
        both.into_iter().flatten().filter_map(|own| Self::of(&as_given(own))).find(is_of)
    }

    /// A function of the same kind with other values.
    ///
    /// # Errors
    ///
    /// A value that is out of range.
    pub fn with(&self, values: &[Value]) -> Result<Waveform, InvalidParameter> {
        (self.make)(values)
    }

    fn named<W: WaveformKind>(kind: &W) -> Self {
        Self {
            word: W::KIND,
            parameters: W::PARAMETERS,
            values: kind.values(),
            make: |values| W::from_values(values).and_then(|own| own.waveform()),
        }
    }
}

fn of_kind<W: WaveformKind>(waveform: &Waveform, kind: &W) -> Option<Recognized> {
    let again = kind.waveform().ok()?;
    is_same(waveform, &again).then(|| Recognized::named(kind))
}

/// The derivative of a piece; `None` where its frequency is swept.
fn first_derivative(piece: &Piece) -> Option<Piece> {
    if piece.is_swept() {
        return None;
    }
    let wave = |own: f64| if own == 0.0 { 0.0 } else { own };
    Some(Piece {
        start: piece.start,
        value: piece.slope,
        slope: piece.curvature,
        curvature: piece.jerk,
        sine: wave(-piece.omega * piece.cosine),
        cosine: wave(piece.omega * piece.sine),
        omega: piece.omega,
        ..Piece::default()
    })
}

/// The second derivative of a piece; `None` where its frequency is swept.
fn second_derivative(piece: &Piece) -> Option<Piece> {
    if piece.is_swept() {
        return None;
    }
    let factor = -piece.omega * piece.omega;
    let wave = |amplitude: f64| if amplitude == 0.0 { 0.0 } else { factor * amplitude };
    Some(Piece {
        start: piece.start,
        value: piece.curvature,
        slope: piece.jerk,
        sine: wave(piece.sine),
        cosine: wave(piece.cosine),
        omega: piece.omega,
        ..Piece::default()
    })
}

/// Straight lines and jumps as a table.
fn line(waveform: &Waveform) -> Option<Recognized> {
    let pieces = waveform.pieces();
    let is_straight = |piece: &Piece| {
        !piece.is_wave() && piece.curvature == 0.0 && piece.jerk == 0.0 && piece.cosine == 0.0
    };
    let (first, last) = (pieces.first()?, pieces.last()?);
    if !pieces.iter().all(is_straight) || first.slope != 0.0 || last.slope != 0.0 {
        return None;
    }
    if pieces.len() == 1 {
        return Some(Recognized::named(&Constant { value: first.value, start: 0.0 }));
    }
    let border = |pair: &[Piece]| {
        let at = pair[1].start;
        [(at, pair[0].derivative(0, at)), (at, pair[1].value)]
    };
    let mut points: Vec<(f64, f64)> = pieces.windows(2).flat_map(border).collect();
    points.dedup();
    let size = points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
    let outside = match waveform.given() {
        Some(Given { is_strict: true, .. }) => Some(Outside::Error),
        Some(_) => None,
        None => Some(Outside::Hold),
    };
    let table = Table { points, outside };
    let again = table.waveform().ok()?;
    let ends = pieces.iter().skip(1).map(|piece| piece.start);
    let close = |t: f64| (waveform.value(t) - again.value(t)).abs() <= 1e-12 * size;
    ends.chain([0.0]).all(close).then(|| Recognized::named(&table))
}

fn sine(waveform: &Waveform) -> Option<Sine> {
    let [only] = waveform.pieces() else { return None };
    let amplitude = only.sine.hypot(only.cosine);
    let frequency = only.omega / TAU;
    Some(Sine { amplitude, frequency, phase: only.cosine.atan2(only.sine) })
}

fn half_sine(waveform: &Waveform) -> Option<HalfSine> {
    let [_, arch, after] = waveform.pieces() else { return None };
    let duration = PI / arch.omega;
    let is_arch = (arch.start + duration - after.start).abs() <= 1e-9 * duration;
    is_arch.then_some(HalfSine { peak: arch.sine, duration, start: arch.start })
}

fn haversine(waveform: &Waveform) -> Option<Haversine> {
    let [_, wave, after] = waveform.pieces() else { return None };
    let duration = TAU / wave.omega;
    let is_wave = (wave.start + duration - after.start).abs() <= 1e-9 * duration;
    is_wave.then_some(Haversine { peak: 2.0 * wave.value, duration, start: wave.start })
}

/// Whether both have the same pieces to rounding; where the first one begins does not matter.
fn is_same(one: &Waveform, other: &Waveform) -> bool {
    // Rounding is that of the largest of each kind of number.
    const KINDS: [usize; 8] = [0, 0, 0, 1, 2, 3, 4, 5];
    const FREQUENCY: usize = 4;
    let (first, second) = (one.pieces(), other.pieces());
    let numbers = |own: &Piece| {
        let Piece { value, sine, cosine, slope, curvature, jerk, omega, sweep, .. } = *own;
        [value, sine, cosine, slope, curvature, jerk, omega, sweep]
    };
    let mut sizes = [0.0_f64; 6];
    for own in first.iter().chain(second) {
        for (kind, number) in KINDS.into_iter().zip(numbers(own)) {
            sizes[kind] = sizes[kind].max(number.abs());
        }
    }
    let close = |a: f64, b: f64, size: f64| (a - b).abs() <= SAME * size;
    let pair = |(at, (one, other)): (usize, (&Piece, &Piece))| {
        let (size, is_wave) = (one.start.abs() + other.start.abs(), one.is_wave());
        let pairs = numbers(one).into_iter().zip(numbers(other));
        (at == 0 && !is_wave || close(one.start, other.start, size))
            && KINDS.into_iter().zip(pairs).all(|(kind, (one, other))| {
                kind >= FREQUENCY && !is_wave || close(one, other, sizes[kind])
            })
    };
    first.len() == second.len() && first.iter().zip(second).enumerate().all(pair)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Kind as _;

    fn numbers(own: &Recognized) -> Vec<f64> {
        let number = |value: &Value| match value {
            Value::Number(own) => *own,
            _ => f64::NAN,
        };
        own.values.iter().map(number).collect()
    }

    #[test]
    fn pulses_and_the_motions_made_of_them_show_their_kind() {
        for (peak, duration, start) in [(3.0, 0.011, 0.0), (-7e3, 2.3e-4, 0.2), (1e-6, 40.0, 1e-3)]
        {
            let pulses = [
                (HalfSine { peak, duration, start }.waveform().unwrap(), HalfSine::KIND),
                (Haversine { peak, duration, start }.waveform().unwrap(), Haversine::KIND),
            ];
            for (pulse, word) in pulses {
                let motion = pulse.integral().and_then(|own| own.integral()).unwrap();
                let (of_motion, speed) = Recognized::as_acceleration(&motion).unwrap();
                assert!(speed.abs() < 1e-300, "{speed}");
                let found = [Recognized::of(&pulse).unwrap(), of_motion];
                for own in found {
                    assert_eq!(own.word, word);
                    for (found, known) in numbers(&own).iter().zip([peak, duration, start]) {
                        assert!((found - known).abs() <= 1e-13 * known.abs(), "{own:?}");
                    }
                    let again = own.with(&own.values).unwrap();
                    assert!(is_same(&again, &pulse));
                }
            }
        }
    }

    #[test]
    fn a_motion_that_begins_with_a_speed_shows_it() {
        let points = vec![(0.0, 0.0), (0.01, 900.0), (0.02, -100.0), (0.03, 0.0)];
        let pulse = Table::of(points).waveform().unwrap();
        let (found, speed) = Recognized::as_acceleration(&pulse.motion(-4.5).unwrap()).unwrap();
        assert!(found.word == Table::KIND && (speed + 4.5).abs() < 1e-12, "{found:?} {speed}");
        assert!(is_same(&found.with(&found.values).unwrap(), &pulse));
    }

    #[test]
    fn other_functions_are_not_taken_for_a_kind() {
        let half = HalfSine { peak: 1.0, duration: 1.0, start: 0.0 }.waveform().unwrap();
        let mut pieces = half.pieces().to_vec();
        pieces[2].value = 1e-9;
        assert!(Recognized::of(&Waveform::new(pieces).unwrap()).is_none());
        // A motion that does not begin at zero is not that of its acceleration alone.
        let mut motion = half.integral().and_then(|own| own.integral()).unwrap().pieces().to_vec();
        motion[0].value += 1e-6;
        assert!(Recognized::as_acceleration(&Waveform::new(motion).unwrap()).is_none());
    }
}
