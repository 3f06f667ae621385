//! The report of a run, and how far two of them are apart.

pub(crate) mod compression;
mod deepest;
pub(crate) mod event;
pub(crate) mod excerpt;
pub(crate) mod judged;
pub(crate) mod partial;
pub(crate) mod sample;
pub(crate) mod scatter;
pub(crate) mod serialized;
pub(crate) mod unevaluated;
pub mod verdict;
pub(crate) mod warning;
pub(crate) mod zeros;

use std::{collections::HashMap, sync::Arc, time::Duration};

use dashpot_dae::{Extremum, Statistics, Trajectory};
use dashpot_network::{
    Assembly, NodeOutputs,
    parameters::{Value, WindowWish},
};
use serde::Serialize;

use crate::{
    EventReport, Impact, Ledger, Limit, NoValue, Note, Partial, ScatterReport, Segmentation,
    Solution, Warning, errors::accuracy::FIRST_DIGIT,
};

/// In networks of more elements than this nobody looks for the largest force of all.
const MOST_ELEMENTS: usize = 200;

/// All that a run yields.
#[derive(Debug)]
pub struct RunReport {
    /// How it was solved.
    pub solver: SolverReport,
    /// What was solved.
    pub system: SystemReport,
    /// The measures: those that every run reports, then those wanted.
    pub measures: Vec<MeasureReport>,
    /// Keys of the measures that tables and programs are told of; all where none is named.
    pub only: Vec<String>,
    /// The contact of each element that touches an impactor.
    pub contacts: Vec<ContactReport>,
    /// The energy balance at the end of the run.
    pub energy: Ledger,
    /// The energy balance at the end of the impact, where it ends within the run.
    pub energy_after_impact: Option<Ledger>,
    /// What happened, in order of time.
    pub events: Vec<EventReport>,
    /// What was left out, where that was allowed.
    pub partial: Option<Partial>,
    /// The segments of layers that the errors include; `None` where there are none, or errors were not estimated.
    pub segmentation: Option<Segmentation>,
    /// What the reader must know, the most important first.
    pub warnings: Vec<Warning>,
    /// The limits that were asked for.
    pub limits: Vec<Limit>,
    /// What a sample of the scene's scatter tells, where it has any and one was drawn.
    pub scatter: Option<Box<ScatterReport>>,
    /// The equations.
    pub assembly: Arc<Assembly>,
    /// The solution that is reported, the finest one.
    pub trajectory: Trajectory,
}

/// How a run was solved.
#[derive(Debug, Clone, PartialEq)]
pub struct SolverReport {
    /// The method that was used.
    pub method: &'static str,
    /// Why it was.
    pub why: String,
    /// Its relative tolerance; `None` for a method that has none.
    pub rtol: Option<f64>,
    /// The part of the largest contact force below which a pull counts as an error of the method.
    pub threshold: f64,
    /// Work done for the solution that is reported.
    pub statistics: Statistics,
    /// Further solutions, from which the errors come.
    pub solves_for_error: usize,
    /// Wall-clock time of those.
    pub wall_for_error: Duration,
    /// Wall-clock time of the whole run: solutions, measures and errors.
    pub wall_in_all: Duration,
    /// Work of the whole run, with every solution that was tried, in units of
    /// [`Budget`](dashpot_dae::Budget).
    pub work: u64,
}

/// What was solved.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SystemReport {
    /// Differential unknowns.
    pub states: usize,
    /// Algebraic unknowns.
    pub algebraic: usize,
    /// Modes between which the system can switch: how many combinations of phases there are, as many as
    /// fit into the number.
    pub modes: usize,
    /// Effects that are on.
    pub effects: Vec<&'static str>,
}

impl SystemReport {
    /// Counts what a network without effects was compiled to.
    pub(crate) fn of(assembly: &Assembly) -> Self {
        let parts = assembly.switching.iter().flat_map(|own| own.parts());
        Self {
            states: assembly.system.states(),
            algebraic: assembly.system.algebraic(),
            modes: parts.map(|part| part.phases.len()).fold(1, usize::saturating_mul),
            effects: Vec::new(),
        }
    }
}

/// One measure.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureReport {
    /// `<target>.<kind>`, unique in a report.
    pub key: String,
    /// Name of the element or node.
    pub target: String,
    /// The measure's word.
    pub kind: &'static str,
    /// SI unit of the value.
    pub unit: &'static str,
    /// The value; `None` where it is infinite, undefined or not determined, and a note says why.
    pub value: Option<f64>,
    /// When it occurs \[s\].
    pub time: Option<f64>,
    /// The part of the run that it belongs to \[s\].
    pub window: Option<(f64, f64)>,
    /// Its absolute error: a bound (exact method) or an estimate; infinite where its kind changes
    /// with the tolerance, `None` where it was not estimated.
    pub error: Option<f64>,
    /// What is to be said about it.
    pub notes: Vec<Note>,
    /// The part of the run that it was asked for; `None` for a measure without that parameter.
    pub window_wish: Option<WindowWish>,
    /// Its parameters but the window, by name.
    pub parameters: Vec<(&'static str, Value)>,
    /// Whether the solution does not tell the value, not even its first digit.
    pub is_undetermined: bool,
    /// The size to which a relative accuracy refers.
    pub size: f64,
    /// The error in parts of what the accuracy wanted allows: at most 1 where it is reached, 0
    /// where the error was not estimated.
    pub excess: f64,
}

impl MeasureReport {
    /// What is to be said about it, in words.
    pub fn note(&self) -> Option<String> {
        (!self.notes.is_empty()).then(|| Note::joined(&self.notes))
    }

    /// Whether it is infinite, as a peak is where speeds jump: it has a time then, and no value.
    pub fn is_infinite(&self) -> bool {
        self.value.is_none() && self.time.is_some() && !self.is_undetermined
    }

    /// The error relative to the value, where both are known; of what is next to nothing beside its
    /// size, relative to that.
    pub fn relative_error(&self) -> Option<f64> {
        let error = self.error.filter(|_| self.size > 0.0)?;
        let of = if self.is_next_to_nothing() { Some(self.size) } else { self.value };
        of.map(|of| error / of.abs())
    }

    /// The same without its value, which the solution does not tell, and why.
    pub(crate) fn undetermined(mut self, why: Note) -> Self {
        self.notes.push(why);
        Self { value: None, time: None, error: None, excess: 0.0, is_undetermined: true, ..self }
    }

    /// Whether not even the first digit of the value is known, while the error is small beside the
    /// size of what the value is the remainder of.
    pub fn is_next_to_nothing(&self) -> bool {
        let (Some(value), Some(error)) = (self.value, self.error) else { return false };
        value.abs() < self.size && (value == 0.0 || error > FIRST_DIGIT * value.abs())
    }
}

/// The contact of an element that touches an impactor.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactReport {
    /// Name of the element.
    pub element: String,
    /// Its impact.
    pub impact: Impact,
    /// Whether it can pull: nothing lets it part at either end.
    pub is_glued: bool,
    /// How often it meets again, after the impact, what it has parted from.
    pub again: usize,
}

impl RunReport {
    /// The measure with this key, for instance `padding.peak-force`.
    pub fn measure(&self, key: &str) -> Option<&MeasureReport> {
        self.measures.iter().find(|measure| measure.key == key)
    }

    /// The measures that tables and programs are told of.
    pub fn told(&self) -> impl Iterator<Item = &MeasureReport> {
        let is_told = |key: &String| self.only.is_empty() || self.only.contains(key);
        self.measures.iter().filter(move |own| is_told(&own.key))
    }

    /// The value of the measure with this key, in its SI unit.
    ///
    /// # Errors
    ///
    /// [`NoValue`] where it is not reported, and where it has none.
    pub fn value(&self, key: &str) -> Result<f64, NoValue> {
        let Some(measure) = self.measure(key) else {
            let known: Vec<&str> = self.measures.iter().map(|own| own.key.as_str()).collect();
            return Err(NoValue::unknown(key, &known));
        };
        let why = || NoValue::Undefined { key: key.to_owned(), notes: measure.notes.clone() };
        measure.value.ok_or_else(why)
    }

    /// All measures by their keys.
    pub fn by_key(&self) -> HashMap<&str, &MeasureReport> {
        self.measures.iter().map(|measure| (measure.key.as_str(), measure)).collect()
    }

    /// The solution, for further measures, series and plots.
    pub fn solution(&self) -> Solution<'_> {
        Solution::new(&self.assembly, &self.trajectory).doubting(self.solver.threshold)
    }

    /// Kinetic energy of the impactors at the start \[J\]; 0 without any, and for those that are
    /// dropped from above and have none yet.
    pub fn impact_energy(&self) -> f64 {
        let impactors = self.assembly.nodes.iter().filter(|node| node.is_impactor());
        let energy =
            |node: &NodeOutputs| 0.5 * node.mass * node.start_velocity.unwrap_or(0.0).powi(2);
        impactors.map(energy).sum::<f64>().min(self.energy.start)
    }

    /// The condition that ended the run early, if one did.
    pub fn stopped_by(&self) -> Option<&EventReport> {
        self.events.iter().find(|event| event.stops)
    }

    /// The element with the largest magnitude of the force in the whole run, and that extremum in
    /// newtons and seconds; it is infinite where masses meet in the element. `None` where there is no force, or where there are too many elements to
    /// look at each.
    pub fn largest_force(&self) -> Option<(&str, Extremum)> {
        if self.assembly.connections.len() > MOST_ELEMENTS {
            return None;
        }
        let solution = self.solution();
        let window = (0.0, solution.end());
        let connections = self.assembly.connections.iter().enumerate();
        let forces = connections.filter_map(|(at, connection)| {
            let force = solution.signal(connection.force?);
            let peak = match solution.element_jumps(at).first() {
                Some(jump) => Extremum { time: jump.time, value: f64::INFINITY },
                None => force.absolute_maximum(window),
            };
            Some((connection.name.as_str(), peak))
        });
        forces.max_by(|one, other| one.1.value.total_cmp(&other.1.value))
    }

    /// The largest relative error of any measure, where errors are known.
    pub fn worst_relative_error(&self) -> Option<f64> {
        self.measures.iter().filter_map(MeasureReport::relative_error).reduce(f64::max)
    }
}

/// How far two runs are apart in one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Key of the measure.
    pub key: String,
    /// `|a − b|` over the larger of both measures' sizes, to which their errors refer as well; 0 where both are zero.
    pub relative: f64,
}

/// The differences in all measures that have a value in both runs, in the order of the first.
pub fn differences(one: &RunReport, other: &RunReport) -> Vec<Difference> {
    let others = other.by_key();
    one.measures
        .iter()
        .filter_map(|measure| {
            let a = measure.value?;
            let opposite = others.get(measure.key.as_str())?;
            let b = opposite.value?;
            let relative = over((a - b).abs(), measure.size.max(opposite.size));
            Some(Difference { key: measure.key.clone(), relative })
        })
        .collect()
}

/// A difference over the size of what differs; 0 where that is zero.
pub(crate) fn over(difference: f64, size: f64) -> f64 {
    if size > 0.0 { difference / size } else { 0.0 }
}
