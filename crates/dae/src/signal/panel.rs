//! One polynomial of a signal.

use std::borrow::Cow;

use dashpot_numerics::chebyshev::{self, Coefficients};

use super::Signal;

/// A polynomial on `[start, end]`: `Σ c_k T_k(x)`, `x = (2t − start − end)/(end − start)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Where the panel begins \[s\].
    pub start: f64,
    /// Where it ends \[s\]; never before `start`.
    pub end: f64,
    /// Chebyshev coefficients, at least one.
    pub coefficients: Coefficients,
}

impl Panel {
    /// The polynomial that is `value` everywhere.
    pub fn constant(start: f64, end: f64, value: f64) -> Self {
        Self { start, end, coefficients: [value].into() }
    }

    /// How long it is \[s\].
    pub fn length(&self) -> f64 {
        self.end - self.start
    }

    /// The place `x` in `[−1, 1]` of time `t`; beyond the ends that of the end. All of a panel of
    /// no length is its beginning.
    pub fn place(&self, t: f64) -> f64 {
        if t <= self.start {
            -1.0
        } else if t >= self.end {
            1.0
        } else {
            ((t - self.start) - (self.end - t)) / self.length()
        }
    }

    /// The time of the place `x` in `[−1, 1]`, exact at both ends.
    pub fn time(&self, x: f64) -> f64 {
        let time = if x < 0.0 {
            self.start + 0.5 * self.length() * (1.0 + x)
        } else {
            self.end - 0.5 * self.length() * (1.0 - x)
        };
        time.clamp(self.start, self.end)
    }

    /// The value at `t`; beyond the ends that of the end.
    pub fn value(&self, t: f64) -> f64 {
        chebyshev::evaluate(&self.coefficients, self.place(t))
    }

    /// The slope at `t` \[unit/s\]; beyond the ends that of the end.
    pub fn slope(&self, t: f64) -> f64 {
        chebyshev::evaluate(&self.derivative().coefficients, self.place(t))
    }

    /// Its derivative with respect to time. It is zero where the panel is so short that the slope is no finite number.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let mut coefficients = chebyshev::derivative(&self.coefficients);
        let rate = 2.0 / self.length();
        for c in coefficients.iter_mut() {
            *c *= rate;
        }
        if coefficients.iter().any(|c| !c.is_finite()) {
            coefficients = [0.0].into();
        }
        Self { start: self.start, end: self.end, coefficients }
    }

    /// How much of a [derivative](Self::derivative) that no `|slope|` exceeds may be the rounding of its values
    /// and of the times of its ends \[unit/s\]; infinite, or no number, where it has no length.
    pub(super) fn slope_rounding(&self, slope: f64) -> f64 {
        let size: f64 = self.coefficients.iter().map(|c| c.abs()).sum();
        let degree = self.coefficients.iter().skip(1).map(|_| 1.0).sum::<f64>().max(1.0);
        let latest = self.start.abs().max(self.end.abs());
        2.0 * f64::EPSILON / self.length() * (degree * degree * size + latest * slope)
    }

    /// The part of it from `start` to `end`, which must lie within.
    #[must_use]
    pub fn part(&self, start: f64, end: f64) -> Self {
        let (a, b) = (self.place(start), self.place(end));
        let coefficients = if a < b {
            chebyshev::restrict(&self.coefficients, a, b)
        } else {
            [chebyshev::evaluate(&self.coefficients, a)].into()
        };
        Self { start, end, coefficients }
    }

    /// The part of it between `from` and `to`; itself where it lies within.
    pub(super) fn cut(&self, from: f64, to: f64) -> Cow<'_, Self> {
        if self.start >= from && self.end <= to {
            Cow::Borrowed(self)
        } else {
            Cow::Owned(self.part(self.start.max(from), self.end.min(to)))
        }
    }

    /// Its integral from its start on \[unit·s\].
    #[must_use]
    pub fn antiderivative(&self) -> Self {
        let mut coefficients = chebyshev::antiderivative(&self.coefficients);
        coefficients.iter_mut().for_each(|own| *own *= 0.5 * self.length());
        Self { coefficients, ..*self }
    }

    /// Its integral over time \[unit·s\].
    pub fn integral(&self) -> f64 {
        0.5 * self.length() * chebyshev::integral(&self.coefficients)
    }
}

impl Signal {
    /// The panels within the window, cut to it. Where the signal jumps at the very end of the
    /// window, a last panel of no length holds the value from the right.
    pub(super) fn panels_in(
        &self,
        window: (f64, f64),
    ) -> impl Iterator<Item = Cow<'_, Panel>> + Clone {
        let from = window.0.max(self.start());
        let to = window.1.min(self.end());
        let mut indices = 0..0;
        let mut last = None;
        if from < to {
            indices = self.panel_at(from)..self.panel_before(to) + 1;
            let next = self.panel_at(to);
            if next >= indices.end {
                last = self.panels.get(next).map(|panel| panel.part(to, to));
            }
        } else if from <= to {
            last = self.panels.get(self.panel_at(from)).map(|panel| panel.part(from, from));
        }
        let whole = self.panels.get(indices).unwrap_or_default().iter();
        whole.map(move |panel| panel.cut(from, to)).chain(last.map(Cow::Owned))
    }

    /// What cannot be told from a level in a panel: the noise, some roundings of the value, or a rounding of the time.
    pub(super) fn floor(&self, panel: &Panel, level: f64) -> f64 {
        let (mut size, mut variation, mut steepest) = (0.0, 0.0, 0.0);
        let mut k = 0.0;
        for c in panel.coefficients.iter() {
            size += c.abs();
            variation = if k > 0.0 { variation + c.abs() } else { 0.0 };
            steepest += k * k * c.abs();
            k += 1.0;
        }
        let latest = panel.start.abs().max(panel.end.abs());
        let change = (2.0 * latest / panel.length() * steepest).min(variation / f64::EPSILON);
        self.noise.max(f64::EPSILON * (4.0 * (level.abs() + size) + change))
    }
}
