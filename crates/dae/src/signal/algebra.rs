//! Signals made from signals.

use dashpot_numerics::chebyshev;

use super::{Panel, Signal};

/// Rounding up to which a slope counts as known, in parts of it.
const OF_SLOPE: f64 = 1e-3;
/// The same in parts of the largest slope that is known.
const OF_LARGEST: f64 = 1e-6;

impl Signal {
    /// A number that no `|value|` exceeds, and that is rarely much larger.
    pub fn bound(&self) -> f64 {
        self.panels.iter().map(|panel| chebyshev::bound(&panel.coefficients)).fold(0.0, f64::max)
    }

    /// The derivative with respect to time \[unit/s\], panel by panel: jumps leave no trace in it.
    ///
    /// The shorter a panel, the more of its slope is rounding, of the values and of the times. Where that would
    /// stand out among the slopes that are known, and accounts for what lies between the slope and a line from
    /// the panel before to the one behind, it is that line.
    ///
    /// Its `noise` is an estimate, in proportion to the size of the values; an error bound it has none.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let mut panels: Vec<Panel> = self.panels.iter().map(Panel::derivative).collect();
        let sizes: Vec<f64> =
            panels.iter().map(|panel| chebyshev::bound(&panel.coefficients)).collect();
        let roundings: Vec<f64> = self
            .panels
            .iter()
            .zip(&sizes)
            .map(|(panel, size)| panel.slope_rounding(*size))
            .collect();
        let is_told = |(rounding, size): (&f64, &f64)| *rounding <= OF_SLOPE * size;
        let told = roundings.iter().zip(&sizes).filter(|own| is_told(*own)).map(|own| *own.1);
        let largest = told.fold(0.0, f64::max);
        if largest > 0.0 {
            let is_known = |own: (&f64, &f64)| *own.0 <= OF_LARGEST * largest || is_told(own);
            let is_known: Vec<bool> = roundings.iter().zip(&sizes).map(is_known).collect();
            bridge(&mut panels, &roundings, &is_known);
        }
        let mut slope = Self { panels, error: None, noise: 0.0 };
        let size = self.bound();
        if size > 0.0 {
            slope.noise = self.noise * (slope.bound() / size);
        }
        slope
    }

    /// The signal times `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        for panel in &mut scaled.panels {
            for c in panel.coefficients.iter_mut() {
                *c *= factor;
            }
        }
        scaled.error = self.error.map(|error| error * factor.abs());
        scaled.noise = self.noise * factor.abs();
        scaled
    }

    /// `self + factor · other` over the time that both cover, with the panels of both. If there is
    /// none, it is zero of no length at the beginning of `self`.
    #[must_use]
    pub fn plus(&self, other: &Self, factor: f64) -> Self {
        let mut panels = Vec::with_capacity(self.panels.len() + other.panels.len());
        self.overlaps(other, (self.start(), self.end()), |one, two, start, end| {
            let mut coefficients = one.cut(start, end).into_owned().coefficients;
            let summand = &two.cut(start, end).coefficients;
            if coefficients.len() < summand.len() {
                coefficients.resize(summand.len());
            }
            for (sum, c) in coefficients.iter_mut().zip(summand.iter()) {
                *sum += factor * c;
            }
            panels.push(Panel { start, end, coefficients });
        });
        if panels.is_empty() {
            let t = self.start();
            let common = (other.start()..=other.end()).contains(&t);
            let value = if common { self.value(t) + factor * other.value(t) } else { 0.0 };
            panels.push(Panel::constant(t, t, value));
        }
        let error = self.error.zip(other.error).map(|(one, two)| one + factor.abs() * two);
        Self { panels, error, noise: self.noise + factor.abs() * other.noise }
    }

    /// Calls `visit` with a panel of each signal and the times between which both hold, in order
    /// of time, for all such times of positive length in the window.
    pub(super) fn overlaps(
        &self,
        other: &Self,
        window: (f64, f64),
        mut visit: impl FnMut(&Panel, &Panel, f64, f64),
    ) {
        let from = window.0.max(self.start()).max(other.start());
        let to = window.1.min(self.end()).min(other.end());
        let (mut i, mut j) = (self.panel_at(from), other.panel_at(from));
        let mut start = from;
        while start < to
            && let (Some(one), Some(two)) = (self.panels.get(i), other.panels.get(j))
        {
            let end = one.end.min(two.end).min(to);
            if start < end {
                visit(one, two, start, end);
                start = end;
            }
            if one.end <= start {
                i += 1;
            }
            if two.end <= start {
                j += 1;
            }
        }
    }
}

/// Replaces the panels of each run that are not known by a line from the end of the panel before to the begin
/// of the one behind, as far as their roundings account for the difference.
fn bridge(panels: &mut [Panel], roundings: &[f64], is_known: &[bool]) {
    let mut at = 0;
    while let Some(from) = is_known[at..].iter().position(|known| !known).map(|own| at + own) {
        let run = is_known[from..].iter().position(|known| *known);
        let to = run.map_or(panels.len(), |length| from + length);
        let before = panels[..from].last().map(|own| (own.end, own.value(own.end)));
        let behind = panels.get(to).map(|panel| (panel.start, panel.value(panel.start)));
        let ends = before.or(behind).zip(behind.or(before));
        for (panel, rounding) in panels[from..to].iter_mut().zip(&roundings[from..to]) {
            let Some(((start, first), (end, last))) = ends else { continue };
            let part = |t: f64| {
                if end > start { ((t - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 }
            };
            let [left, right] = [panel.start, panel.end].map(|t| first + (last - first) * part(t));
            let line = [0.5 * (left + right), 0.5 * (right - left)];
            let mut between = panel.coefficients.clone();
            between.resize(between.len().max(2));
            between.iter_mut().zip(line).for_each(|(own, line)| *own -= line);
            let is_more = chebyshev::bound(&between) > *rounding;
            if !is_more {
                panel.coefficients = line.into();
            }
        }
        at = to;
    }
}
