//! One smooth piece of a driving function.

/// One smooth piece of a [`Waveform`](super::Waveform), from its `start` to the start of the next.
/// With `s = t − start` and the phase `φ = ω s + ½ κ s²`:
///
/// `u(t) = value + slope·s + ½ curvature·s² + ⅙ jerk·s³ + sine·sin φ + cosine·cos φ`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Piece {
    /// Where the piece begins; the first one holds before its start as well.
    pub start: f64,
    /// Constant part.
    pub value: f64,
    /// Rate of the polynomial part at the start.
    pub slope: f64,
    /// Second derivative of the polynomial part at the start.
    pub curvature: f64,
    /// Third derivative of the polynomial part.
    pub jerk: f64,
    /// Amplitude of the sine.
    pub sine: f64,
    /// Amplitude of the cosine.
    pub cosine: f64,
    /// Angular frequency `ω` of sine and cosine at the start.
    pub omega: f64,
    /// Rate `κ` at which the angular frequency rises.
    pub sweep: f64,
}

impl Piece {
    /// The `order`-th derivative of the piece at `t`.
    pub fn derivative(&self, order: u32, t: f64) -> f64 {
        let polynomial = self.polynomial(order, t);
        if self.is_wave() { polynomial + self.wave(order, t - self.start) } else { polynomial }
    }

    /// Whether a part of it oscillates; at frequency zero its cosine is a constant.
    pub fn is_wave(&self) -> bool {
        (self.omega != 0.0 || self.sweep != 0.0) && (self.sine != 0.0 || self.cosine != 0.0)
    }

    /// Whether the frequency of what oscillates changes.
    pub fn is_swept(&self) -> bool {
        self.sweep != 0.0 && self.is_wave()
    }

    /// Whether the `order`-th derivative is the same at all times.
    pub fn is_constant(&self, order: u32) -> bool {
        !self.is_wave() && self.degree().is_none_or(|degree| degree <= order)
    }

    /// The size of the angular frequency `ω + κ s` at `t`; zero where nothing oscillates.
    pub fn frequency(&self, t: f64) -> f64 {
        if self.is_wave() { (self.omega + self.sweep * (t - self.start)).abs() } else { 0.0 }
    }

    /// Whether the polynomial part rises and falls within two times in order.
    pub(crate) fn turns(&self, from: f64, to: f64) -> bool {
        // The rate is largest or smallest at an end or where the second derivative is zero.
        let steepest = from - self.polynomial(2, from) / self.jerk;
        let inside = (steepest > from && steepest < to).then_some(steepest);
        let rates = || [from, to].into_iter().chain(inside).map(|t| self.polynomial(1, t));
        rates().any(|rate| rate > 0.0) && rates().any(|rate| rate < 0.0)
    }

    /// Degree of the polynomial part; `None` where it is zero.
    pub(crate) fn degree(&self) -> Option<u32> {
        let coefficients = [self.constant(), self.slope, self.curvature, self.jerk];
        (0..).zip(coefficients).filter(|own| own.1 != 0.0).map(|own| own.0).last()
    }

    /// The `order`-th derivative of the polynomial part at `t`.
    pub(crate) fn polynomial(&self, order: u32, t: f64) -> f64 {
        let s = t - self.start;
        match order {
            0 => {
                let rise = self.slope + s * (0.5 * self.curvature + s * (self.jerk / 6.0));
                self.constant() + s * rise
            }
            1 => self.slope + s * (self.curvature + s * (0.5 * self.jerk)),
            2 => self.curvature + s * self.jerk,
            3 => self.jerk,
            _ => 0.0,
        }
    }

    /// The `order`-th derivative of the oscillating part at `s` after the start.
    fn wave(&self, order: u32, s: f64) -> f64 {
        let phase = (self.omega + 0.5 * self.sweep * s) * s;
        let frequency = self.omega + self.sweep * s;
        let (sin, cos) = phase.sin_cos();
        // p' = (ω + κ s) q and q' = −(ω + κ s) p, differentiated by Leibniz' rule.
        let mut last = [0.0; 2];
        let mut now = [self.sine * sin + self.cosine * cos, self.sine * cos - self.cosine * sin];
        for n in 0..order {
            let turn = f64::from(n) * self.sweep;
            let next = [frequency * now[1] + turn * last[1], -frequency * now[0] - turn * last[0]];
            (last, now) = (now, next);
        }
        now[0]
    }

    pub(super) fn numbers(&self) -> [f64; 9] {
        let Self { start, value, slope, curvature, jerk, sine, cosine, omega, sweep } = *self;
        [start, value, slope, curvature, jerk, sine, cosine, omega, sweep]
    }

    /// The piece with time and value measured in other units.
    pub(super) fn in_units(&self, time: f64, value: f64) -> Self {
        Self {
            start: self.start / time,
            value: self.value / value,
            slope: self.slope * time / value,
            curvature: self.curvature * time * time / value,
            jerk: self.jerk * time * time * time / value,
            sine: self.sine / value,
            cosine: self.cosine / value,
            omega: self.omega * time,
            sweep: self.sweep * time * time,
        }
    }

    /// A piece from the same start whose rate is this one and which is zero at `t`; `None` where the
    /// rate has no such integral.
    pub(super) fn integral(&self, t: f64) -> Option<Self> {
        if self.is_swept() || self.jerk != 0.0 {
            return None;
        }
        let Self { start, slope, curvature, .. } = *self;
        let mut whole =
            Self { start, slope: self.constant(), curvature: slope, jerk: curvature, ..*self };
        (whole.value, whole.sine, whole.cosine, whole.sweep) = (0.0, 0.0, 0.0, 0.0);
        if self.is_wave() {
            (whole.sine, whole.cosine) = (self.cosine / self.omega, -self.sine / self.omega);
        }
        whole.value = -whole.derivative(0, t);
        Some(whole)
    }

    /// A bound of the size of the piece between two times in order.
    pub(super) fn bound(&self, from: f64, to: f64) -> f64 {
        let [slope, curvature, jerk] = [1, 2, 3].map(|order| self.polynomial(order, from));
        let wave = if self.is_wave() { self.sine.hypot(self.cosine) } else { 0.0 };
        let at = |t: f64| self.polynomial(0, t).abs();
        let (ends, length) = (at(from).max(at(to)), to - from);
        if slope.abs() > length * (curvature.abs() + 0.5 * length * jerk.abs()) {
            return ends + wave;
        }
        // The roots of slope + curvature s + ½ jerk s², as they come without cancellation.
        let root = (curvature * curvature - 2.0 * jerk * slope).max(0.0).sqrt();
        let sum = -(curvature + root.copysign(curvature));
        let inner = [sum / jerk, 2.0 * slope / sum].map(|s| from + s);
        inner.into_iter().filter(|&t| t > from && t < to).map(at).fold(ends, f64::max) + wave
    }

    /// What rounding may change in the value at `t`, its time included.
    pub(super) fn noise(&self, t: f64) -> f64 {
        /// Share of the whole that says nothing about a function's shape.
        const BLUR: f64 = 1e-12;
        let s = t - self.start;
        let terms = [
            self.constant(),
            self.slope * s,
            0.5 * self.curvature * s * s,
            self.jerk / 6.0 * s * s * s,
        ];
        let wave = if self.is_wave() { self.sine.hypot(self.cosine) } else { 0.0 };
        let largest = terms.iter().fold(wave, |most, term| most.max(term.abs()));
        let rate = self.polynomial(1, t).abs() + self.frequency(t) * wave;
        BLUR * (self.polynomial(0, t).abs() + wave)
            + 8.0 * f64::EPSILON * (largest + rate * (t.abs() + self.start.abs()))
    }

    fn constant(&self) -> f64 {
        let still = self.omega == 0.0 && self.sweep == 0.0;
        if still { self.value + self.cosine } else { self.value }
    }
}
