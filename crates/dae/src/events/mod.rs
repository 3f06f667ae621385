//! Guards: conditions on outputs that are watched during a run.
//!
//! One layer serves every method: it looks for crossings on the polynomials of the outputs, so that
//! none is missed for lying between steps, and two in one step are two events. A [`Watch`] follows a
//! run that comes step by step; [`scan`] looks at one that is there as a whole.
//!
//! A value that cannot be told from the level is neither above nor below it. With the exact method
//! that is a matter of rounding; a method with a tolerance `rtol` does not tell apart what is closer
//! than `rtol` times the largest terms of the output so far, so that its error makes no events of an
//! output that decays to its level, or of two bodies that move together.
//!
//! What counts as a crossing is told by [`Signal::crossings`](crate::Signal::crossings): a guard that starts on its
//! level, up to rounding, is armed by the way in which its output leaves the level, and does not fire there; an output
//! that touches the level, or ends on it, does not cross it; a jump across it does.

use crate::{Crossing, Panel, Signal};

/// Which crossings of the level count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From below to above.
    Rising,
    /// From above to below.
    Falling,
    /// Both.
    Either,
}

/// A condition: an output crosses a level in a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Guard {
    /// What it stands for, for the report.
    pub name: String,
    /// Index into [`System::outputs`](crate::System::outputs).
    pub output: usize,
    /// The level, in the output's SI unit.
    pub level: f64,
    /// Which crossings count.
    pub direction: Direction,
    /// Whether the run ends at the first crossing.
    pub stops: bool,
    /// The side of the level on which the output begins, `true` above, where that is known although the value may be on
    /// the level. `None` lets the guard be armed by the way in which its output leaves the level.
    pub begins: Option<bool>,
    /// The output that it is the rate of, if it is one. A method with a tolerance knows such an output
    /// better than the balances tell that it follows from: what it amounts to in a step is a change of the
    /// other output, which is kept within the tolerance.
    pub rate_of: Option<usize>,
}

/// A crossing that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// When \[s\].
    pub time: f64,
    /// Index into [`Run::guards`](crate::Run::guards).
    pub guard: usize,
    /// Whether the output rose through the level.
    pub rising: bool,
}

/// The end of a run by a guard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Index of the guard; of several at one instant the first.
    pub guard: usize,
    /// When \[s\].
    pub time: f64,
}

/// Follows guards while a run proceeds. Without guards it does nothing and holds nothing.
#[derive(Debug, Clone, Default)]
pub struct Watch {
    tracks: Vec<Track>,
    events: Vec<Event>,
    stop: Option<Stop>,
}

/// A crossing of one guard, with the span of time within which it cannot be told from others.
#[derive(Debug, Clone, Copy)]
struct Found {
    event: Event,
    spread: f64,
}

impl Watch {
    /// A watch over these guards from the start of a run.
    pub fn new(guards: &[Guard]) -> Self {
        let track = |guard: &Guard| Track {
            side: guard.begins,
            leaves: guard.begins.is_some(),
            ..Track::default()
        };
        Self { tracks: guards.iter().map(track).collect(), ..Self::default() }
    }

    /// Whether there is nothing to watch.
    pub fn is_idle(&self) -> bool {
        self.tracks.is_empty()
    }

    /// Looks at the next part of the run: `signals` holds the output of each guard on it, and
    /// `roundings` how well their numbers are known as such, whatever the error of the method that made
    /// them. Returns the stop, if a stopping guard is crossed; nothing after it is recorded then.
    ///
    /// Crossings that cannot be told apart in time, up to the rounding of their outputs, happen at
    /// one instant, and those at the instant of a stop are all recorded. The method's error joins none:
    /// what is one impact after another would become two at once, at every tolerance.
    pub fn feed(
        &mut self,
        guards: &[Guard],
        signals: &[Signal],
        roundings: &[f64],
    ) -> Option<Stop> {
        if self.stop.is_some() {
            return self.stop;
        }
        let mut found = Vec::new();
        for (at, (track, guard)) in self.tracks.iter_mut().zip(guards).enumerate() {
            let Some((signal, &rounding)) = signals.get(at).zip(roundings.get(at)) else { break };
            track.advance(guard.level, signal, rounding, |crossing, spread| {
                let Some(rising) = crossing.rising else { return };
                if guard.direction.counts(rising) {
                    found.push(Found {
                        event: Event { time: crossing.time, guard: at, rising },
                        spread,
                    });
                }
            });
        }
        if found.is_empty() {
            return None;
        }
        let earlier = |a: &Found, b: &Found| {
            a.event.time.total_cmp(&b.event.time).then(a.event.guard.cmp(&b.event.guard))
        };
        found.sort_by(earlier);
        if let Some(first) = found.iter().find(|found| guards[found.event.guard].stops).copied() {
            let instant = first.event.time;
            let with = |found: &Found| {
                found.event.time <= instant
                    || found.event.time - instant <= found.spread + first.spread
            };
            found.retain(with);
            for found in &mut found {
                if found.event.time > instant {
                    found.event.time = instant;
                }
            }
            found.sort_by(earlier);
            let stopping = found.iter().map(|found| found.event).find(|event| {
                guards[event.guard].stops && event.time + 2.0 * first.spread >= instant
            });
            let guard = stopping.map_or(first.event.guard, |event| event.guard);
            self.stop = Some(Stop { guard, time: instant });
        }
        self.events.extend(found.iter().map(|found| found.event));
        self.stop
    }

    /// The stop, if there was one.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// What was recorded, in order of time, and of guards at one instant.
    pub fn into_events(self) -> Vec<Event> {
        self.events
    }
}

/// All events of a run that is there as a whole, up to the first stop: `signals` holds the output of
/// each guard over the run.
pub fn scan(guards: &[Guard], signals: &[Signal]) -> (Vec<Event>, Option<Stop>) {
    let mut watch = Watch::new(guards);
    let roundings: Vec<f64> = signals.iter().map(|signal| signal.noise).collect();
    let stop = watch.feed(guards, signals, &roundings);
    (watch.into_events(), stop)
}

impl Direction {
    /// Whether a crossing in this direction counts.
    fn counts(self, rising: bool) -> bool {
        match self {
            Self::Rising => rising,
            Self::Falling => !rising,
            Self::Either => true,
        }
    }
}

/// What is known of one guard's output.
#[derive(Debug, Clone, Default)]
struct Track {
    /// The side of the level on which it was last, `true` above.
    side: Option<bool>,
    /// Whether the run has just begun, on a side that is known.
    leaves: bool,
    /// Its panels since it has come onto the level, while it stays there.
    open: Vec<Panel>,
    /// Crossings of the open panels that have been told.
    told: usize,
}

impl Track {
    /// Goes on along `signal` and tells `visit` the crossings, each with its uncertainty in time by `rounding`.
    fn advance(
        &mut self,
        level: f64,
        signal: &Signal,
        rounding: f64,
        mut visit: impl FnMut(Crossing, f64),
    ) {
        let noise = signal.noise;
        let mut panels = Vec::with_capacity(self.open.len() + signal.panels.len() + 1);
        let first = self.open.first().or(signal.panels.first()).map_or(0.0, |panel| panel.start);
        if let Some(above) = self.side {
            // What came before is summed up by an instant on its side, well off the level.
            let size = 1.0_f64.max(level.abs()).max(2.0 * noise);
            let value = if above { level + size } else { level - size };
            panels.push(Panel::constant(first.next_down(), first, value));
        }
        panels.append(&mut self.open);
        panels.extend_from_slice(&signal.panels);
        let all = Signal::new(panels, signal.error, noise);
        let crossings = all.crossings(level, (all.start(), all.end()));
        let bent = if self.leaves { bent_at_start(&crossings, signal, level) } else { 0 };
        self.leaves = false;
        for &crossing in crossings.iter().skip(self.told.max(bent)) {
            let of_time = 4.0 * f64::EPSILON * crossing.time.abs();
            let spread = rounding / crossing.slope.abs();
            visit(crossing, of_time + if spread.is_finite() { spread } else { 0.0 });
        }
        self.told = 0;
        let end = all.left_value(all.end()) - level;
        if end.abs() > noise.max(8.0 * f64::EPSILON * level.abs()) {
            self.side = Some(end > 0.0);
            return;
        }
        self.stay_open(level, &all, crossings.len());
    }

    /// Keeps what is needed to judge later how the level, on which `all` ends, will be left.
    fn stay_open(&mut self, level: f64, all: &Signal, told: usize) {
        let rests = |panel: &Panel| {
            let (constant, rest) = panel.coefficients.split_first().unwrap_or((&0.0, &[]));
            (constant - level).abs() + rest.iter().map(|c| c.abs()).sum::<f64>() <= all.noise
        };
        let marked = usize::from(self.side.is_some());
        for panel in &all.panels[marked..] {
            // However long a rest is, its last panel stands for all of it.
            if rests(panel) && self.open.last().is_some_and(rests) {
                self.open.pop();
            }
            self.open.push(panel.clone());
        }
        self.told = told;
    }
}

/// How many crossings at the begin of a run are none. An output that leaves its level without slope to the side that is
/// known bends the other way first in the polynomial of the first step, and comes back within it.
fn bent_at_start(crossings: &[Crossing], signal: &Signal, level: f64) -> usize {
    let (Some(first), [out, back, ..]) = (signal.panels.first(), crossings) else { return 0 };
    let way = (out.time - first.start) * out.slope.abs();
    let is_bent = way <= signal.noise.max(8.0 * f64::EPSILON * level.abs())
        && back.time < first.end
        && out.rising.zip(back.rising).is_some_and(|(out, back)| out != back);
    if is_bent { 2 } else { 0 }
}

#[cfg(test)]
mod tests;
