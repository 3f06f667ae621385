//! Extrema of a response over frequency, and resonances: how high, how wide.

use std::{
    f64::consts::{LN_2, TAU},
    ops::ControlFlow,
};

use dashpot_numerics::{extrema::maximum_unless, roots::false_position};

use super::{Swing, curve::Curve};

/// A peak of the response over frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resonance {
    /// Its frequency \[Hz\]: that of the highest response, not that of free oscillation.
    pub frequency: f64,
    /// How wrong the frequency may be \[Hz\].
    pub frequency_error: f64,
    /// The response there; `None` where nothing damps it, so that it has no limit.
    pub swing: Option<Swing>,
    /// The frequencies \[Hz\] below and above at which the response has fallen to 1/√2 of the peak.
    /// `None` where it does not on either side before it rises again, and without damping.
    pub band: Option<[f64; 2]>,
}

impl Resonance {
    /// Quality factor: the frequency over the width of the band \[1\].
    pub fn quality(&self) -> Option<f64> {
        self.band.map(|[low, high]| self.frequency / (high - low))
    }
}

/// The resonances from `low` to `high` \[Hz\] of a response whose extrema are known.
pub(super) fn resonances(
    curve: &Curve<'_>,
    extrema: &[Extremum],
    range: [f64; 2],
) -> Vec<Resonance> {
    let inner = extrema.windows(3).filter(|three| three[1].is_peak);
    inner
        .map(|three| of(curve, three))
        .filter(|own| (range[0]..=range[1]).contains(&own.frequency))
        .collect()
}

fn of(curve: &Curve<'_>, three: &[Extremum]) -> Resonance {
    let peak = three[1];
    let omega = peak.probe.omega;
    let swing = curve.swing(omega).filter(|own| own.error <= UNKNOWN * own.amplitude);
    let level = peak.probe.level - LN_2;
    let side = |far: &Extremum| {
        let (left, right) = if far.probe.omega < omega { (far, &peak) } else { (&peak, far) };
        (far.probe.level < level)
            .then(|| curve.root(left.probe, right.probe, |own| own.level - level).omega / TAU)
    };
    let band = swing.and_then(|_| Some([side(&three[0])?, side(&three[2])?]));
    Resonance {
        frequency: omega / TAU,
        frequency_error: peak.width / TAU + f64::EPSILON * omega,
        swing,
        band,
    }
}

/// Samples in each decade with which the search begins.
const EACH_DECADE: f64 = 24.0;
/// Distances from a pole, in units of its damping, at which it is looked at too.
const FROM_POLE: [f64; 7] = [0.0, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0];
/// An undamped pole is looked at as if it were damped with each of these parts of its frequency: one that nearly
/// cancels shows only near by.
const LEAST_DAMPING: [f64; 4] = [1e-9, 1e-11, 1e-13, 1e-15];
/// A stretch is halved until its middle is so near to the cubic through its ends, in `ln |T|²`.
const SMOOTH: f64 = 0.05;
/// Halvings of one stretch.
const MOST_HALVINGS: u32 = 40;
/// Steps by which the flattest place of a shoulder is looked for: to a hundred thousandth.
const SHOULDER_STEPS: usize = 24;
/// Smaller hills, in `ln |T|²`, are what rounding makes.
const LEAST_HILL: f64 = 1e-9;

/// A relative error from which on a response is not known.
pub(super) const UNKNOWN: f64 = 1e-3;

/// The response at one frequency.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    /// Angular frequency \[rad/s\].
    pub(super) omega: f64,
    /// `ln |T|²`.
    pub(super) level: f64,
    /// `d ln |T|² / d ln ω`.
    pub(super) rise: f64,
    /// Relative error of `T`.
    pub(super) threshold: f64,
}

/// Where something changes its sign.
#[derive(Debug, Clone, Copy)]
pub(super) struct Root {
    /// Angular frequency \[rad/s\].
    pub(super) omega: f64,
    /// The response there; `None` where it has a pole or vanishes.
    probe: Option<Probe>,
    /// Width of the last bracket \[rad/s\].
    width: f64,
}

/// A valley, a peak, or an end of the range.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremum {
    pub(super) probe: Probe,
    /// The response is the same to rounding over this distance to either side \[rad/s\].
    pub(super) width: f64,
    pub(super) is_peak: bool,
}

impl Curve<'_> {
    /// The response at `omega` \[rad/s\]; `None` where it cannot be told, and where it is zero.
    pub(super) fn probe(&self, omega: f64) -> Option<Probe> {
        let found = self.at(omega)?;
        let level = 2.0 * found.value.norm().ln();
        let probe = Probe { omega, level, rise: found.rise, threshold: found.threshold() };
        (probe.level.is_finite() && probe.rise.is_finite()).then_some(probe)
    }

    /// The ends of the range from `low` to `high` \[rad/s\], and between them valleys and peaks in
    /// turn. Between two of them the response is monotonic, up to hills that rounding makes.
    pub(super) fn extrema(&self, low: f64, high: f64, poles: &[(f64, f64)]) -> Vec<Extremum> {
        let samples = self.with_shoulders(&self.samples(low, high, poles));
        let end = |probe: &Probe, is_peak| Extremum { probe: *probe, width: 0.0, is_peak };
        let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
            return Vec::new();
        };
        let mut found = vec![end(first, first.rise < 0.0)];
        for pair in samples.windows(2) {
            let is_peak = pair[0].rise > 0.0;
            if (pair[1].rise > 0.0) != is_peak {
                found.push(self.turn(pair[0], pair[1], is_peak));
            }
        }
        found.push(end(last, last.rise > 0.0));
        without_noise(found)
    }

    /// Samples near enough to each other for the response to be smooth between them.
    fn samples(&self, low: f64, high: f64, poles: &[(f64, f64)]) -> Vec<Probe> {
        let mut places: Vec<f64> = vec![low, high];
        let count = (EACH_DECADE * (high / low).log10()).ceil().max(1.0);
        let mut at = 1.0;
        while at < count {
            places.push(low * (high / low).powf(at / count));
            at += 1.0;
        }
        for &(omega, damping) in poles {
            let least = LEAST_DAMPING.iter().map(|own| own * omega);
            let widths =
                if damping < LEAST_DAMPING[0] * omega { least.collect() } else { vec![damping] };
            for width in widths {
                let both = |own: &f64| [omega - own * width, omega + own * width];
                places.extend(FROM_POLE.iter().flat_map(both));
            }
        }
        places.retain(|place| (low..=high).contains(place));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let coarse: Vec<Probe> = places.iter().filter_map(|&place| self.probe(place)).collect();
        let mut fine = Vec::with_capacity(2 * coarse.len());
        for pair in coarse.windows(2) {
            fine.push(pair[0]);
            let mut open = vec![(pair[0], pair[1], MOST_HALVINGS)];
            // The left half is taken first, so that samples come in order.
            while let Some((left, right, halvings)) = open.pop() {
                let middle = self.probe((left.omega * right.omega).sqrt());
                let middle =
                    middle.filter(|middle| left.omega < middle.omega && middle.omega < right.omega);
                match middle {
                    Some(middle) if halvings > 0 && !is_smooth(&left, &middle, &right) => {
                        open.push((middle, right, halvings - 1));
                        open.push((left, middle, halvings - 1));
                    }
                    Some(middle) => fine.extend([middle, right]),
                    None => fine.push(right),
                }
            }
            fine.pop();
        }
        fine.extend(coarse.last());
        fine
    }

    /// The same samples, and one beyond each shoulder: where the slope nearly changes its sign, it
    /// may do so twice between two samples.
    fn with_shoulders(&self, samples: &[Probe]) -> Vec<Probe> {
        let mut all = Vec::with_capacity(samples.len());
        all.extend(samples.first());
        for three in samples.windows(3) {
            let [left, middle, right] = [three[0], three[1], three[2]];
            let sign = middle.rise.signum();
            let slopes = [left.rise, middle.rise, right.rise].map(|rise| sign * rise);
            let is_shoulder = slopes[1] < slopes[0] && slopes[1] <= slopes[2];
            let beyond = (is_shoulder && slopes[1] > LEAST_HILL)
                .then(|| self.beyond(left, right, |probe| sign * probe.rise))
                .flatten();
            match beyond {
                Some(probe) if probe.omega < middle.omega => all.extend([probe, middle]),
                Some(probe) if probe.omega > middle.omega => all.extend([middle, probe]),
                _ => all.push(middle),
            }
        }
        all.extend(samples.last().filter(|_| samples.len() > 1));
        all
    }

    /// A sample between two others at which `value` is negative, by golden section; `None` where none is found.
    fn beyond(&self, left: Probe, right: Probe, value: impl Fn(&Probe) -> f64) -> Option<Probe> {
        let look = |omega: f64| match self.probe(omega) {
            Some(probe) if value(&probe) < 0.0 => ControlFlow::Break(Some(probe)),
            Some(probe) => ControlFlow::Continue(-value(&probe)),
            None => ControlFlow::Break(None),
        };
        maximum_unless(left.omega, right.omega, SHOULDER_STEPS, look).break_value().flatten()
    }

    /// The peak or valley between two samples with slopes of different signs.
    fn turn(&self, left: Probe, right: Probe, is_peak: bool) -> Extremum {
        let root = self.root(left, right, |probe| probe.rise);
        let level = if is_peak { f64::INFINITY } else { f64::NEG_INFINITY };
        let unknown = Probe { omega: root.omega, level, rise: 0.0, threshold: f64::INFINITY };
        let probe = root.probe.unwrap_or(unknown);
        if probe.threshold >= UNKNOWN {
            return Extremum { probe, width: root.width + self.shift(root.omega), is_peak };
        }
        // Where the response is off by its error, a turn is off by about that part of its breadth.
        let bend = (right.rise - left.rise).abs() / (right.omega - left.omega);
        let breadth = (root.omega / bend).sqrt().min(root.omega);
        Extremum { probe, width: root.width + 4.0 * probe.threshold * breadth, is_peak }
    }

    /// By how much an undamped pole, or a zero, near `omega` may be off \[rad/s\]: the shift that makes as
    /// much of a difference beside it as the error of the response there.
    fn shift(&self, omega: f64) -> f64 {
        let mut distance = f64::EPSILON * omega;
        while distance < 0.1 * omega {
            let beside = [omega - distance, omega + distance].map(|own| self.probe(own));
            let known = beside.into_iter().flatten().filter(|own| own.threshold < UNKNOWN);
            let shifts = known.map(|known| 2.0 * known.threshold * omega / known.rise.abs());
            if let Some(shift) = shifts.reduce(f64::max) {
                return shift;
            }
            distance *= 4.0;
        }
        distance
    }

    /// Where `value` changes its sign between two samples.
    pub(super) fn root(&self, left: Probe, right: Probe, value: impl Fn(&Probe) -> f64) -> Root {
        let look = |omega: f64| self.probe(omega).map(|probe| value(&probe)).ok_or(omega);
        let ends = [left, right].map(|probe| (probe.omega, value(&probe)));
        match false_position(look, ends[0], ends[1], 0.0) {
            Ok([left, right]) => {
                let nearer = if left.1.abs() <= right.1.abs() { left } else { right };
                Root { omega: nearer.0, probe: self.probe(nearer.0), width: right.0 - left.0 }
            }
            Err(omega) => Root { omega, probe: None, width: 0.0 },
        }
    }
}

/// Whether the middle of a stretch is what its ends promise.
fn is_smooth(left: &Probe, middle: &Probe, right: &Probe) -> bool {
    let width = (right.omega / left.omega).ln();
    let promised = 0.5 * (left.level + right.level) + width * (left.rise - right.rise) / 8.0;
    (middle.level - promised).abs() <= SMOOTH
}

/// Takes out hills and dales that are no larger than what rounding makes, the smallest ones first.
fn without_noise(mut all: Vec<Extremum>) -> Vec<Extremum> {
    while all.len() > 2 {
        let height = |at: usize| (all[at].probe.level - all[at + 1].probe.level).abs();
        let noise = |at: usize| {
            let threshold = all[at].probe.threshold + all[at + 1].probe.threshold;
            // What is not known at all is a resonance without damping.
            if threshold < UNKNOWN { LEAST_HILL.max(16.0 * threshold) } else { LEAST_HILL }
        };
        let smallest = (0..all.len() - 1)
            .filter(|&at| height(at) <= noise(at))
            .min_by(|&a, &b| height(a).total_cmp(&height(b)));
        let Some(at) = smallest else { break };
        // Of an end and its neighbour the end stays.
        if at == 0 {
            all.remove(1);
        } else if at + 2 == all.len() {
            all.remove(at);
        } else {
            all.drain(at..at + 2);
        }
    }
    all
}
