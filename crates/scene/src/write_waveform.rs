//! Driving functions as text, from their pieces.

use std::f64::consts::{PI, TAU};

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    parameters::{Dimension, Value},
    waveforms::{Constant, HalfSine, Haversine, Sine, Table, WaveformKind},
};

use crate::write::write_kind;

/// How far, relatively, a function that is read back may be from the one that was written: some
/// kinds have other numbers than their pieces.
const SAME: f64 = 1e-14;

/// A driving function of what is measured in `driven`, as `word = …`; `None` where it is of a kind
/// that does not show in its pieces.
pub(crate) fn write_waveform(waveform: &Waveform, driven: Dimension) -> Option<String> {
    line(waveform, driven)
        .or_else(|| of_kind(waveform, driven, &sine(waveform)?))
        .or_else(|| of_kind(waveform, driven, &half_sine(waveform)?))
        .or_else(|| of_kind(waveform, driven, &haversine(waveform)?))
}

fn of_kind<W: WaveformKind>(waveform: &Waveform, driven: Dimension, kind: &W) -> Option<String> {
    let again = kind.waveform().ok()?;
    is_same(waveform, &again).then(|| write::<W>(&kind.values(), driven))
}

fn write<W: WaveformKind>(values: &[Value], driven: Dimension) -> String {
    write_kind(W::KIND, W::PARAMETERS, values, driven)
}

/// Straight lines and jumps as a table.
fn line(waveform: &Waveform, driven: Dimension) -> Option<String> {
    let pieces = waveform.pieces();
    let is_straight = |own: &Piece| {
        !own.is_wave() && own.curvature == 0.0 && own.jerk == 0.0 && own.cosine == 0.0
    };
    let (first, last) = (pieces.first()?, pieces.last()?);
    if !pieces.iter().all(is_straight) || first.slope != 0.0 || last.slope != 0.0 {
        return None;
    }
    if pieces.len() == 1 {
        let constant = Constant { value: first.value, start: 0.0 };
        return Some(write::<Constant>(&constant.values(), driven));
    }
    let border = |pair: &[Piece]| {
        let at = pair[1].start;
        [(at, pair[0].derivative(0, at)), (at, pair[1].value)]
    };
    let mut points: Vec<(f64, f64)> = pieces.windows(2).flat_map(border).collect();
    points.dedup();
    let table = Table { points };
    let again = table.waveform().ok()?;
    let ends = pieces.iter().skip(1).map(|own| own.start);
    let size = points_size(&table);
    let close = |t: f64| (waveform.value(t) - again.value(t)).abs() <= 1e-12 * size;
    ends.chain([0.0]).all(close).then(|| write::<Table>(&table.values(), driven))
}

/// The largest value in a table.
fn points_size(table: &Table) -> f64 {
    table.points.iter().map(|point| point.1.abs()).fold(0.0, f64::max)
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
    let pair = |(at, (one, other)): (usize, (&Piece, &Piece))| {
        let size = |own: &Piece| own.value.abs() + own.sine.abs() + own.cosine.abs();
        let amplitude = size(one).max(size(other));
        let close = |a: f64, b: f64, size: f64| (a - b).abs() <= SAME * size;
        (at == 0 && !one.is_wave()
            || close(one.start, other.start, one.start.abs() + other.start.abs()))
            && close(one.value, other.value, amplitude)
            && close(one.sine, other.sine, amplitude)
            && close(one.cosine, other.cosine, amplitude)
            && close(one.omega, other.omega, one.omega.abs())
            && [one.slope, one.curvature, one.jerk, one.sweep].iter().all(|own| *own == 0.0)
    };
    let (first, second) = (one.pieces(), other.pieces());
    first.len() == second.len() && first.iter().zip(second).enumerate().all(pair)
}
