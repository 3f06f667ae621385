//! The solutions of all intervals as one.

use crate::{Dense, Panel, Signal, System};

/// One interval that has been solved.
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

impl Solved {
    /// What is told at these times from its start on \[s\], where that is known without the signal.
    fn values(&self, (output, order): Told, times: &[f64]) -> Option<Vec<f64>> {
        self.dense.values(&self.system, output, order, times)
    }
}

/// All intervals in order of time.
#[derive(Debug, Default)]
pub(super) struct Chain {
    pub(super) intervals: Vec<Solved>,
    /// The intervals of a second solution whose states were perturbed, where one was asked for.
    pub(super) doubled: Option<Vec<Solved>>,
    /// See [`Dense::end_margin`].
    pub(super) end_margin: Option<f64>,
    /// See [`Dense::hangs_on_threshold`].
    pub(super) hangs_on_threshold: bool,
}

/// Intervals beyond which what makes further signals of an interval quicker takes too much memory.
const MANY: usize = 1000;
/// Places within a panel at which two solutions are compared.
const INSIDE: [f64; 3] = [-0.9, 0.0, 0.9];
/// The error of a chain in parts of the difference that shaking makes.
const CAUTION: f64 = 8.0;

impl Dense for Chain {
    fn signal(&self, _system: &System, output: usize) -> Signal {
        self.joined((output, 0))
    }

    fn has_rates(&self) -> bool {
        self.intervals.iter().any(|interval| interval.dense.has_rates())
    }

    fn rate(&self, _system: &System, output: usize) -> Signal {
        self.joined((output, 1))
    }

    fn values(&self, _: &System, output: usize, order: usize, times: &[f64]) -> Option<Vec<f64>> {
        let value = |&time: &f64| {
            let at = self.intervals.partition_point(|own| own.end < time);
            let own = self.intervals.get(at)?;
            own.values((output, order), &[time - own.start])?.pop()
        };
        times.iter().map(value).collect()
    }

    fn sample(&self, _system: &System, _times: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    fn end_margin(&self) -> Option<f64> {
        self.end_margin
    }

    fn hangs_on_threshold(&self) -> bool {
        self.hangs_on_threshold
    }

    fn bytes(&self) -> usize {
        let all = self.intervals.iter().chain(self.doubled.iter().flatten());
        all.map(|interval| interval.dense.bytes()).sum()
    }
}

/// An output, and 0 for it or 1 for its rate.
type Told = (usize, usize);

/// A bound of the slope of a signal. Panels that are too short to have one do not count.
fn steepest(signal: &Signal) -> f64 {
    let slope = |panel: &Panel| {
        let (mut sum, mut order) = (0.0, 0.0);
        for coefficient in panel.coefficients.iter() {
            sum += order * order * coefficient.abs();
            order += 1.0;
        }
        2.0 * sum / panel.length()
    };
    signal.panels.iter().map(slope).filter(|slope| slope.is_finite()).fold(0.0, f64::max)
}

impl Chain {
    /// The signals of the intervals, one behind the other.
    ///
    /// Each interval bounds its own error, to which comes what the rounding of times does to a value. What the errors
    /// before it do to it is estimated from a second solution whose states were perturbed: eight times the largest
    /// difference of both, interval by interval, is added. Where the second one has no value, no error is stated.
    fn joined(&self, told: Told) -> Signal {
        let mut panels: Vec<Panel> = Vec::new();
        let (mut error, mut noise) = (Some(0.0_f64), 0.0_f64);
        let mut difference = Some(0.0_f64);
        let alone = self.intervals.len() == 1;
        for (at, interval) in self.intervals.iter().enumerate() {
            let own = self.signal_of(interval, told);
            noise = noise.max(own.noise);
            let timed = own.error.map(|error| {
                // An interval bounds its error in its own time, which begins at a rounded one.
                if alone { error } else { error + f64::EPSILON * interval.end * steepest(&own) }
            });
            error = error.zip(timed).map(|(most, own)| most.max(own));
            if !alone && error.is_some() {
                let between = self.difference(at, told, &own);
                difference = difference.zip(between).map(|(most, own)| most.max(own));
            }
            // What drives may jump where the interval ends, and nothing else has the new value yet.
            let ends =
                own.panels.iter().rposition(|panel| interval.start + panel.start < interval.end);
            let last = ends.unwrap_or(0);
            let within = own.panels.into_iter().take(last + 1);
            panels.extend(within.enumerate().map(|(at, panel)| Panel {
                // The sums may be rounded beyond the end of the interval.
                start: (interval.start + panel.start).min(interval.end),
                end: if at == last {
                    interval.end
                } else {
                    (interval.start + panel.end).min(interval.end)
                },
                coefficients: panel.coefficients,
            }));
        }
        let error = error.zip(difference).map(|(error, between)| error + CAUTION * between);
        Signal::new(panels, error, noise)
    }

    fn signal_of(&self, interval: &Solved, (output, order): Told) -> Signal {
        let is_kept = self.intervals.len() <= MANY;
        if !is_kept {
            interval.dense.forget();
        }
        let signal = match order {
            0 => interval.dense.signal(&interval.system, output),
            _ => interval.dense.rate(&interval.system, output),
        };
        if !is_kept {
            interval.dense.forget();
        }
        signal
    }

    /// The largest difference of a signal between an interval and the second solution. As long as
    /// both go through the same intervals, time counts from the start of each and from that of the
    /// run; where one of them has come to rest after fewer bounces, from that of the run only.
    fn difference(&self, interval: usize, told: Told, own: &Signal) -> Option<f64> {
        let doubled = self.doubled.as_ref().filter(|all| !all.is_empty())?;
        let one = &self.intervals[interval];
        // Inside of panels only: where an input jumps, both may jump a rounding apart.
        let places = || own.panels.iter().flat_map(|panel| INSIDE.map(|x| (panel, panel.time(x))));
        let all = doubled.len() == self.intervals.len();
        if let Some(other) = doubled.get(interval).filter(|other| is_same(one, other, all)) {
            let shift = one.start - other.start;
            let shifts = if shift == 0.0 { &[0.0][..] } else { &[0.0, shift] };
            // An interval that ends earlier by a rounding is not followed beyond its end.
            let end = other.end - other.start;
            let inside: Vec<(&Panel, f64)> = places().collect();
            let times = inside.iter().map(|own| own.1);
            let all: Vec<(usize, f64)> = shifts
                .iter()
                .flat_map(|by| times.clone().map(move |t| t + by).enumerate())
                .filter(|own| own.1 > 0.0 && own.1 <= end)
                .collect();
            let values = || {
                let ours = one.values(told, &times.clone().collect::<Vec<_>>())?;
                let theirs: Vec<f64> = all.iter().map(|own| own.1).collect();
                Some((ours, other.values(told, &theirs)?))
            };
            let is_kept = self.intervals.len() <= MANY;
            let (ours, theirs) = is_kept.then(values).flatten().unwrap_or_else(|| {
                let double = self.signal_of(other, told);
                let theirs = all.iter().map(|own| double.left_value(own.1));
                (inside.iter().map(|(panel, t)| panel.value(*t)).collect(), theirs.collect())
            });
            let differences =
                all.iter().zip(&theirs).map(|(own, other)| (ours[own.0] - other).abs());
            return Some(differences.fold(0.0, f64::max));
        }
        let mut known: Option<(usize, Signal)> = None;
        places().try_fold(0.0_f64, |most, (panel, t)| {
            let (time, value) = (one.start + t, panel.value(t));
            let at = doubled.partition_point(|other| other.end < time);
            let other = doubled.get(at)?;
            if known.as_ref().is_none_or(|(known, _)| *known != at) {
                known = Some((at, self.signal_of(other, told)));
            }
            let double = known.as_ref().map(|(_, known)| known.left_value(time - other.start))?;
            Some(most.max((value - double).abs()))
        })
    }
}

/// Whether an interval and one of the second solution are the same part of the run. They are by
/// their place among the intervals, and where there are not as many also by their times.
fn is_same(one: &Solved, other: &Solved, as_many: bool) -> bool {
    let alike = one.phases.iter().zip(&other.phases).all(|(a, b)| a.0 == b.0);
    let apart = (one.start - other.start).abs().max((one.end - other.end).abs());
    alike && (as_many || apart <= 0.5 * (one.end - one.start))
}
