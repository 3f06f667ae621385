//! Solutions beside that of a run, and whether they are of its kind.

use std::ops::ControlFlow;

use crate::{EventReport, RunReport, sweep::share};

/// Times of two solutions next to each other may differ by this part of themselves; more is another peak.
const APART: f64 = 1e-2;

/// Errors of events that are a larger part of their times do not tell of differences between neighbours.
const SHARP: f64 = 1e-9;

/// What is known of a measure, or of an event, in a solution.
#[derive(Debug, Clone)]
struct Read {
    value: Result<f64, String>,
    error: Option<f64>,
    /// When it occurs, and the ends of its window \[s\].
    times: Vec<f64>,
}

/// A solution.
#[derive(Debug, Clone)]
pub(super) struct Neighbour {
    /// The measures, then the times of events.
    read: Result<Vec<Read>, String>,
    /// The parts that switch, each with the phase that it comes to, in order of time.
    phases: Vec<(usize, usize)>,
}

impl Neighbour {
    /// What a run tells of the measures with these keys, and of its events.
    pub(super) fn of(run: &RunReport, keys: &[String]) -> Self {
        let read = |key: &String| {
            let Some(own) = run.measure(key) else {
                let value = Err("it is not reported".to_owned());
                return Read { value, error: None, times: Vec::new() };
            };
            let window = own.window.into_iter().flat_map(|window| [window.0, window.1]);
            Read {
                value: own.value.ok_or_else(|| own.note().unwrap_or_default()),
                error: own.error,
                times: own.time.into_iter().chain(window).collect(),
            }
        };
        let event = |own: &EventReport| Read {
            value: Ok(own.time),
            error: own.error.filter(|error| *error <= SHARP * own.time),
            times: vec![own.time],
        };
        let events = run.events.iter().map(event);
        let switches = run.trajectory.switches.iter();
        Self {
            read: Ok(keys.iter().map(read).chain(events).collect()),
            phases: switches.map(|own| (own.part, own.phase)).collect(),
        }
    }

    /// A scene that could not be solved, and why.
    pub(super) fn none(reason: String) -> Self {
        Self { read: Err(reason), phases: Vec::new() }
    }

    /// Whether it could be solved.
    pub(super) fn is_solved(&self) -> bool {
        self.read.is_ok()
    }

    /// How many measures and events there are.
    pub(super) fn count(&self) -> usize {
        self.read.as_ref().map_or(0, Vec::len)
    }

    /// A value, or why there is none.
    pub(super) fn value(&self, at: usize) -> Result<f64, String> {
        let all = self.read.as_ref().map_err(String::clone)?;
        let none = || Err("the event does not happen".to_owned());
        all.get(at).map_or_else(none, |own| own.value.clone())
    }

    /// How far it may be off.
    pub(super) fn error(&self, at: usize) -> Option<f64> {
        self.read.as_ref().ok()?.get(at)?.error
    }

    /// Whether it passes the same events as another one.
    pub(super) fn passes_the_same(&self, other: &Self) -> bool {
        self.count() == other.count() && self.phases == other.phases
    }

    /// Whether, besides, all measures are those of the same peaks and windows, and the errors of the other are known.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let (Ok(own), Ok(others)) = (&self.read, &other.read) else { return false };
        let is_near = |one: &Read, other: &Read| {
            one.times.len() == other.times.len()
                && (other.error.is_some() || other.value.is_err())
                && one.times.iter().zip(&other.times).all(|(a, b)| (a - b).abs() <= APART * b.abs())
        };
        self.passes_the_same(other) && own.iter().zip(others).all(|(a, b)| is_near(a, b))
    }
}

/// Solves neighbours in pairs, by so many threads.
pub(super) fn neighbours<P: Sync + Send>(
    places: &[P],
    threads: usize,
    solve: &(dyn Fn(&P) -> Neighbour + Sync),
) -> Vec<[Neighbour; 2]> {
    let mut rows: Vec<(&P, Neighbour)> =
        places.iter().map(|place| (place, Neighbour::none(String::new()))).collect();
    let work = |(): &mut (), rows: &mut [(&P, Neighbour)]| {
        rows.iter_mut().for_each(|row| row.1 = solve(row.0));
    };
    share(&mut rows, (1, threads), &|| (), &work, &mut |_, _| ControlFlow::Continue(()));
    let mut all = rows.into_iter().map(|row| row.1);
    std::iter::from_fn(|| Some([all.next()?, all.next()?])).collect()
}
