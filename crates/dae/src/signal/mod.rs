//! Outputs as functions of time.

mod algebra;
mod crossings;
mod extrema;
mod integral;
mod panel;

pub use panel::Panel;

/// A scalar function of time as a sequence of adjoining polynomials, in SI units.
///
/// At a border of two panels the later one counts (value from the right), except at the end. All times are in s. A
/// window is a pair `(from, to)` of times, both included; what lies outside the signal is cut off.
///
/// # Examples
///
/// The fall `s(t) = 2 − 3 t` over one second, as a panel in `x = 2t − 1`:
///
/// ```
/// use dashpot_dae::{Panel, Signal};
///
/// let panel = Panel { start: 0.0, end: 1.0, coefficients: [0.5, -1.5].into() };
/// let signal = Signal::new(vec![panel], None, 0.0);
/// assert_eq!(signal.value(0.5), 0.5);
/// assert_eq!(signal.integral((0.0, 1.0)), 0.5);
/// let crossing = signal.first_crossing(0.0, (0.0, 1.0), Some(false)).unwrap();
/// assert!((crossing.time - 2.0 / 3.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// The panels in order of time; at least one. A run of zero length has one panel of zero length.
    pub panels: Vec<Panel>,
    /// Bound of the absolute error of the values, where the method states one.
    pub error: Option<f64>,
    /// Size of the rounding noise of the values: what is smaller cannot be told from zero.
    pub noise: f64,
}

/// Where a signal passes through, or touches, a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// When \[s\].
    pub time: f64,
    /// The signal's slope there \[unit/s\], from the right.
    pub slope: f64,
    /// Which way it goes: `Some(true)` up, `Some(false)` down, `None` if it only touches.
    pub rising: Option<bool>,
}

/// A largest or smallest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// When \[s\].
    pub time: f64,
    /// How much.
    pub value: f64,
}

impl Signal {
    /// A signal from its panels, which adjoin in order of time.
    ///
    /// Without any panel it is the zero of no length at time 0. `noise` should cover the jumps
    /// that the method leaves between panels, or [`crossings`](Self::crossings) counts them.
    pub fn new(panels: Vec<Panel>, error: Option<f64>, noise: f64) -> Self {
        let mut panels = panels;
        if panels.is_empty() {
            panels.push(Panel::constant(0.0, 0.0, 0.0));
        }
        debug_assert!(
            panels.iter().all(|panel| panel.start <= panel.end)
                && panels.windows(2).all(|pair| pair[0].start <= pair[1].start),
            "panels are in order of time"
        );
        Self { panels, error, noise }
    }

    /// The time at which it begins \[s\].
    pub fn start(&self) -> f64 {
        self.panels.first().map_or(0.0, |panel| panel.start)
    }

    /// The time at which it ends \[s\].
    pub fn end(&self) -> f64 {
        self.panels.last().map_or(0.0, |panel| panel.end)
    }

    /// Index of the panel that holds at `t` and on the right of it.
    pub fn panel_at(&self, t: f64) -> usize {
        self.panels.partition_point(|panel| panel.start <= t).saturating_sub(1)
    }

    /// Index of the panel that holds on the left of `t`.
    fn panel_before(&self, t: f64) -> usize {
        let before = self.panels.partition_point(|panel| panel.end < t);
        before.min(self.panels.len().saturating_sub(1))
    }

    /// The value at `t`, from the right where the signal jumps; beyond the ends that of the end.
    pub fn value(&self, t: f64) -> f64 {
        self.panels.get(self.panel_at(t)).map_or(0.0, |panel| panel.value(t))
    }

    /// The value at `t`, from the left where the signal jumps; beyond the ends that of the end.
    pub fn left_value(&self, t: f64) -> f64 {
        self.panels.get(self.panel_before(t)).map_or(0.0, |panel| panel.value(t))
    }

    /// The slope at `t` \[unit/s\], from the right; beyond the ends that of the end.
    pub fn slope(&self, t: f64) -> f64 {
        self.panels.get(self.panel_at(t)).map_or(0.0, |panel| panel.slope(t))
    }

    /// The values at these times, each as by [`value`](Self::value).
    pub fn sample(&self, times: &[f64]) -> Vec<f64> {
        times.iter().map(|&t| self.value(t)).collect()
    }
}

#[cfg(test)]
mod tests;
