//! The solutions of all legs as one.

use std::sync::Arc;

use crate::{Dense, Panel, Signal, System};

/// One leg that has been solved.
#[derive(Debug)]
pub(super) struct Solved {
    /// When it began \[s\].
    pub(super) start: f64,
    /// When it ended \[s\].
    pub(super) end: f64,
    pub(super) phases: Vec<(usize, f64)>,
    pub(super) system: Arc<System>,
    pub(super) dense: Box<dyn Dense>,
}

/// All legs in order of time.
#[derive(Debug, Default)]
pub(super) struct Chain {
    pub(super) legs: Vec<Solved>,
    /// The legs of a second solution whose states were shaken, where one was asked for.
    pub(super) doubled: Option<Vec<Solved>>,
}

/// Places within a panel at which two solutions are compared.
const INSIDE: [f64; 3] = [-0.9, 0.0, 0.9];
/// The error of a chain in parts of the difference that shaking makes.
const CAUTION: f64 = 8.0;

impl Dense for Chain {
    /// The signals of the legs, one behind the other.
    ///
    /// Each leg bounds its own error. What the errors before it do to it is estimated from a second
    /// solution whose states were shaken: eight times the largest difference of both, leg by leg,
    /// is added. Where the legs of both are not the same ones, no error is stated.
    fn signal(&self, _system: &System, output: usize) -> Signal {
        let mut panels: Vec<Panel> = Vec::new();
        let (mut error, mut noise) = (Some(0.0_f64), 0.0_f64);
        let mut difference = Some(0.0_f64);
        let alone = self.legs.len() == 1;
        for (at, leg) in self.legs.iter().enumerate() {
            let own = leg.dense.signal(&leg.system, output);
            noise = noise.max(own.noise);
            error = error.zip(own.error).map(|(most, own)| most.max(own));
            if !alone && error.is_some() {
                let between = self.difference(at, output, &own);
                difference = difference.zip(between).map(|(most, own)| most.max(own));
            }
            let last = own.panels.len().saturating_sub(1);
            panels.extend(own.panels.into_iter().enumerate().map(|(at, panel)| Panel {
                // The sums may be rounded beyond the end of the leg.
                start: (leg.start + panel.start).min(leg.end),
                end: if at == last { leg.end } else { (leg.start + panel.end).min(leg.end) },
                coefficients: panel.coefficients,
            }));
        }
        let error = error.zip(difference).map(|(error, between)| error + CAUTION * between);
        Signal::new(panels, error, noise)
    }

    fn sample(&self, _system: &System, _times: &[f64]) -> Vec<f64> {
        Vec::new()
    }
}

impl Chain {
    /// The largest difference of an output between a leg and its double, with time counted from the
    /// start of each.
    fn difference(&self, leg: usize, output: usize, own: &Signal) -> Option<f64> {
        let doubled = self.doubled.as_ref()?;
        let (one, other) = (&self.legs[leg], doubled.get(leg)?);
        let alike = |(a, b): (&(usize, f64), &(usize, f64))| a.0 == b.0;
        if doubled.len() != self.legs.len() || !one.phases.iter().zip(&other.phases).all(alike) {
            return None;
        }
        let double = other.dense.signal(&other.system, output);
        // Inside of panels only: where an input jumps, both may jump a rounding apart.
        let places = own
            .panels
            .iter()
            .flat_map(|panel| INSIDE.map(|x| panel.time(x)).map(|t| (t, panel.value(t))));
        // A leg that ends earlier by a rounding is not followed beyond its end.
        let end = double.end();
        let differences = places
            .filter(|(t, _)| *t <= end)
            .map(|(t, value)| (value - double.left_value(t)).abs());
        Some(differences.fold(0.0, f64::max))
    }
}
