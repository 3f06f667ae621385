//! The solutions of all legs as one.

use crate::{Dense, Panel, Signal, System};

/// One leg that has been solved.
#[derive(Debug)]
pub(super) struct Solved {
    /// When it began \[s\].
    pub(super) start: f64,
    /// When it ended \[s\].
    pub(super) end: f64,
    pub(super) phases: Vec<(usize, f64)>,
    /// What its outputs are told from.
    pub(super) system: System,
    pub(super) dense: Box<dyn Dense>,
}

/// All legs in order of time.
#[derive(Debug, Default)]
pub(super) struct Chain {
    pub(super) legs: Vec<Solved>,
    /// The legs of a second solution whose states were shaken, where one was asked for.
    pub(super) doubled: Option<Vec<Solved>>,
    /// See [`Dense::margin`].
    pub(super) margin: Option<f64>,
}

/// Legs beyond which what makes further signals of a leg quicker takes too much memory.
const MANY: usize = 1000;
/// Places within a panel at which two solutions are compared.
const INSIDE: [f64; 3] = [-0.9, 0.0, 0.9];
/// The error of a chain in parts of the difference that shaking makes.
const CAUTION: f64 = 8.0;

impl Dense for Chain {
    /// The signals of the legs, one behind the other.
    ///
    /// Each leg bounds its own error, to which comes what the rounding of times does to a value. What
    /// the errors before it do to it is estimated from a second solution whose states were shaken: eight times the largest difference of both, leg by leg,
    /// is added. Where the second one has no value, no error is stated.
    fn signal(&self, _system: &System, output: usize) -> Signal {
        let mut panels: Vec<Panel> = Vec::new();
        let (mut error, mut noise) = (Some(0.0_f64), 0.0_f64);
        let mut difference = Some(0.0_f64);
        let alone = self.legs.len() == 1;
        for (at, leg) in self.legs.iter().enumerate() {
            let own = self.told(leg, output);
            noise = noise.max(own.noise);
            let timed = own.error.map(|error| {
                // A leg bounds its error in its own time, which begins at a rounded one.
                if alone { error } else { error + f64::EPSILON * leg.end * steepest(&own) }
            });
            error = error.zip(timed).map(|(most, own)| most.max(own));
            if !alone && error.is_some() {
                let between = self.difference(at, output, &own);
                difference = difference.zip(between).map(|(most, own)| most.max(own));
            }
            // What drives may jump where the leg ends, and nothing else has the new value yet.
            let ends = own.panels.iter().rposition(|panel| leg.start + panel.start < leg.end);
            let last = ends.unwrap_or(0);
            let within = own.panels.into_iter().take(last + 1);
            panels.extend(within.enumerate().map(|(at, panel)| Panel {
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

    fn margin(&self) -> Option<f64> {
        self.margin
    }

    fn bytes(&self) -> usize {
        let all = self.legs.iter().chain(self.doubled.iter().flatten());
        all.map(|leg| leg.dense.bytes()).sum()
    }
}

/// A bound of the slope of a signal. Panels that are too short to have one do not count.
fn steepest(signal: &Signal) -> f64 {
    let slope = |panel: &Panel| {
        let (mut sum, mut order) = (0.0, 0.0);
        for coefficient in &panel.coefficients {
            sum += order * order * coefficient.abs();
            order += 1.0;
        }
        2.0 * sum / panel.length()
    };
    signal.panels.iter().map(slope).filter(|slope| slope.is_finite()).fold(0.0, f64::max)
}

impl Chain {
    /// An output in one leg.
    fn told(&self, leg: &Solved, output: usize) -> Signal {
        let signal = leg.dense.signal(&leg.system, output);
        if self.legs.len() > MANY {
            leg.dense.forget();
        }
        signal
    }

    /// The largest difference of an output between a leg and the second solution. As long as both go
    /// through the same legs, time counts from the start of each and from that of the run; where one of
    /// them has come to rest after fewer bounces, from that of the run only.
    fn difference(&self, leg: usize, output: usize, own: &Signal) -> Option<f64> {
        let doubled = self.doubled.as_ref().filter(|all| !all.is_empty())?;
        let one = &self.legs[leg];
        // Inside of panels only: where an input jumps, both may jump a rounding apart.
        let mut places = own
            .panels
            .iter()
            .flat_map(|panel| INSIDE.map(|x| panel.time(x)).map(|t| (t, panel.value(t))));
        let all = doubled.len() == self.legs.len();
        if let Some(other) = doubled.get(leg).filter(|other| is_same(one, other, all)) {
            let double = self.told(other, output);
            // A leg that ends earlier by a rounding is not followed beyond its end.
            let end = double.end();
            let shift = one.start - other.start;
            let differences = places.flat_map(|(t, value)| {
                let within = [t, t + shift].into_iter().filter(|at| *at > 0.0 && *at <= end);
                within.map(|at| (value - double.left_value(at)).abs()).collect::<Vec<_>>()
            });
            return Some(differences.fold(0.0, f64::max));
        }
        let mut known: Option<(usize, Signal)> = None;
        places.try_fold(0.0_f64, |most, (t, value)| {
            let time = one.start + t;
            let at = doubled.partition_point(|other| other.end < time);
            let other = doubled.get(at)?;
            if known.as_ref().is_none_or(|(known, _)| *known != at) {
                known = Some((at, self.told(other, output)));
            }
            let double = known.as_ref().map(|(_, signal)| signal.left_value(time - other.start))?;
            Some(most.max((value - double).abs()))
        })
    }
}

/// Whether a leg and one of the second solution are the same part of the run. They are by their place
/// among the legs, and where there are not as many also by their times.
fn is_same(one: &Solved, other: &Solved, as_many: bool) -> bool {
    let alike = one.phases.iter().zip(&other.phases).all(|(a, b)| a.0 == b.0);
    let apart = (one.start - other.start).abs().max((one.end - other.end).abs());
    alike && (as_many || apart <= 0.5 * (one.end - one.start))
}
