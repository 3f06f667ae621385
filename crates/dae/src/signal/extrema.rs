//! Largest and smallest values.

use std::borrow::Cow;

use dashpot_numerics::chebyshev::{self, evaluate, sign_changes};

use super::{Extremum, Panel, Signal};

/// Values that differ by so many roundings are equal.
const ROUNDINGS: f64 = 64.0;

/// What is to be as large as possible.
#[derive(Debug, Clone, Copy)]
enum Goal {
    Largest,
    Smallest,
    LargestAbsolute,
}

impl Goal {
    fn merit(self, value: f64) -> f64 {
        match self {
            Self::Largest => value,
            Self::Smallest => -value,
            Self::LargestAbsolute => value.abs(),
        }
    }

    /// What no merit of the polynomial exceeds, rounding included.
    fn bound(self, coefficients: &[f64]) -> f64 {
        let middle = coefficients.first().copied().unwrap_or(0.0);
        let spread = chebyshev::variation(coefficients);
        self.merit(middle) + spread + 8.0 * f64::EPSILON * (middle.abs() + spread)
    }
}

impl Signal {
    /// The largest value in the window and the first time at which it is reached. At a jump the
    /// values of both sides count. Outside the signal it is the value of the nearer end.
    pub fn maximum(&self, window: (f64, f64)) -> Extremum {
        self.best(window, Goal::Largest)
    }

    /// The smallest value in the window and the first time at which it is reached; otherwise as
    /// [`maximum`](Self::maximum).
    pub fn minimum(&self, window: (f64, f64)) -> Extremum {
        self.best(window, Goal::Smallest)
    }

    /// The largest absolute value in the window, which is not negative, and the first time at which
    /// it is reached; otherwise as [`maximum`](Self::maximum).
    pub fn absolute_maximum(&self, window: (f64, f64)) -> Extremum {
        let best = self.best(window, Goal::LargestAbsolute);
        Extremum { value: best.value.abs(), ..best }
    }

    /// The local maxima and minima in the window in order of time, beginning and end among them.
    ///
    /// Ups and downs within the noise, or some roundings, do not count, so a constant signal has one extremum, at
    /// the beginning of the window. Of a plateau the first time is given.
    pub fn extrema(&self, window: (f64, f64)) -> Vec<Extremum> {
        let mut found = Vec::new();
        let mut low: Option<Extremum> = None;
        let mut high: Option<Extremum> = None;
        // While the direction is not known, both are candidates for the first extremum.
        let mut rising = None;
        for panel in self.panels_in(window) {
            let noise = self.floor(&panel, 0.0);
            let mut places = vec![-1.0];
            places.extend(sign_changes(&chebyshev::derivative(&panel.coefficients)));
            places.push(1.0);
            for x in places {
                let value = evaluate(&panel.coefficients, x);
                let point = Extremum { time: panel.time(x), value };
                let lowest = *low.get_or_insert(point);
                let highest = *high.get_or_insert(point);
                if rising != Some(false) && value < highest.value - noise {
                    found.push(highest);
                    (rising, low) = (Some(false), Some(point));
                } else if rising != Some(true) && value > lowest.value + noise {
                    found.push(lowest);
                    (rising, high) = (Some(true), Some(point));
                } else {
                    if value < lowest.value {
                        low = Some(point);
                    }
                    if value > highest.value {
                        high = Some(point);
                    }
                }
            }
        }
        found.extend(if rising == Some(true) { high } else { low });
        found
    }

    /// Branch and bound: the values at the borders first, then the inside of those panels alone that may hold more. Of
    /// what is equal but for rounding the first counts.
    fn best(&self, window: (f64, f64), goal: Goal) -> Extremum {
        let panels = self.panels_in(window);
        let mut best: Option<Extremum> = None;
        let mut consider = |time: f64, value: f64| {
            let merit = goal.merit(value);
            let better = best.is_none_or(|best| {
                let most = goal.merit(best.value);
                merit > most || (merit >= most && time < best.time)
            });
            if better {
                best = Some(Extremum { time, value });
            }
            best.map_or(merit, |best| goal.merit(best.value))
        };
        let mut most = f64::NEG_INFINITY;
        for panel in panels.clone() {
            let [first, last] = chebyshev::at_ends(&panel.coefficients);
            consider(panel.start, first);
            most = consider(panel.end, last);
        }
        // What is equal but for rounding; the largest only grows.
        let equal_to = |most: f64| most - ROUNDINGS * f64::EPSILON * most.abs();
        let turns_of = |panel: &Panel| sign_changes(&chebyshev::derivative(&panel.coefficients));
        let mut candidates: Vec<(Cow<'_, Panel>, Option<Vec<f64>>)> = Vec::new();
        for panel in panels {
            let bound = goal.bound(&panel.coefficients);
            let is_less = bound < most;
            let turns = (!is_less).then(|| turns_of(&panel));
            for &x in turns.iter().flatten() {
                most = consider(panel.time(x), evaluate(&panel.coefficients, x));
            }
            if bound >= equal_to(most) {
                candidates.push((panel, turns));
            }
        }
        let Some(best) = best else {
            let time = if window.0 > self.end() { self.end() } else { self.start() };
            return Extremum { time, value: self.value(time) };
        };
        let equal = equal_to(most);
        let before = candidates.into_iter().take_while(|own| own.0.start < best.time);
        let first = before.filter(|own| goal.bound(&own.0.coefficients) >= equal).find_map(
            |(panel, turns)| {
                let turns = turns.unwrap_or_else(|| turns_of(&panel));
                let mut places = [-1.0].into_iter().chain(turns).chain([1.0]);
                let is_equal = |x: &f64| goal.merit(evaluate(&panel.coefficients, *x)) >= equal;
                places.find(is_equal).map(|x| panel.time(x))
            },
        );
        Extremum { time: first.map_or(best.time, |first| first.min(best.time)), ..best }
    }
}
