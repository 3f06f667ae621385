//! What no pad can beat, beside what a run has come to.

use dashpot_analysis::{Bound, Limit, MeasureReport, RunReport};
use dashpot_design::floor::{Floor, Floors, NoFloor, TravelOf, floors};
use dashpot_network::{Network, parameters::WindowWish};
use serde::Serialize;

use super::{limits::stated, measures::measure_text, verdict::Line};
use crate::output::{Pairs, list};
use dashpot_report::numbers::{quantity, significant};

const LABEL: &str = "floor";
const DIGITS: usize = 4;
/// Digits of a ratio, and of a length.
const FEW: usize = 3;
/// A travel of which more than this part is used is used up.
const WHOLE: f64 = 0.995;

/// The floors of a scene, or why it has none.
pub(crate) struct Told(Result<Floors, NoFloor>);

/// A measure that has a floor.
struct Beside<'r> {
    measure: &'r MeasureReport,
    floor: Floor,
    /// The floor of the travel that the pad took.
    of_used: Option<Floor>,
}

impl Told {
    pub(crate) fn of(network: &Network, duration: f64, limits: &[Limit]) -> Self {
        Self(floors(network, duration, limits))
    }

    /// The measures of a run that have a floor.
    fn beside<'r>(&self, run: &'r RunReport) -> Vec<Beside<'r>> {
        let Ok(floors) = &self.0 else { return Vec::new() };
        let used = floors.deepest(run);
        let own = |measure| {
            let floor = floors.of(measure, None)?;
            let of_used = used.and_then(|used| floors.of(measure, Some(used)));
            Some(Beside { measure, floor, of_used })
        };
        list(run.measures.iter().filter_map(own))
    }

    /// A line on the travel, and one for each measure that has a floor.
    pub(crate) fn lines(&self, run: &RunReport) -> Vec<Line> {
        let line = |text: String| Line { label: LABEL, text };
        let floors = match &self.0 {
            Ok(floors) => floors,
            Err(why) => return vec![line(format!("not told: {why}"))],
        };
        let beside = self.beside(run);
        if beside.is_empty() {
            return vec![line("no measure of this run has one".to_owned())];
        }
        let travel = quantity(floors.travel.length, "m", DIGITS);
        let of = match floors.travel.of {
            TravelOf::Thickness => "its thickness",
            TravelOf::Stop => "its stop",
            TravelOf::Limit => "the limit on its deformation",
        };
        let mut lines = vec![line(format!(
            "what no pad can beat where {} is stopped within {travel} of {} ({of}):",
            floors.body, floors.pad
        ))];
        let deepest = floors.deepest(run);
        let used = deepest.filter(|own| *own < WHOLE * floors.travel.length);
        lines.extend(beside.iter().map(|own| {
            let measure = own.measure;
            let least = measure_text(&measure.key, own.floor.value, measure.unit, DIGITS);
            let ratio = own.ratio(own.floor).map_or(String::new(), |ratio| {
                let why = match deepest {
                    _ if ratio >= 1.0 => String::new(),
                    _ if own.floor.time > run.energy.time => {
                        ", for the run ends before it is stopped".to_owned()
                    }
                    Some(deepest) if deepest > floors.travel.length => {
                        format!(", for it is pressed in by {}", quantity(deepest, "m", FEW))
                    }
                    _ if measure.window_wish != Some(WindowWish::Run) => {
                        ", for a later impact is harder".to_owned()
                    }
                    _ => String::new(),
                };
                format!("; here {} times that{why}", significant(ratio, FEW))
            });
            let of_used = used.zip(own.of_used.and_then(|of_used| own.ratio(of_used)));
            let of_used = of_used.map_or(String::new(), |(used, ratio)| {
                let used = quantity(used, "m", FEW);
                format!(", {} times the floor of the {used} it took", significant(ratio, FEW))
            });
            line(format!("{} at least {least}{ratio}{of_used}", measure.key))
        }));
        let hopeless = beside.iter().flat_map(|own| {
            let of_it = run.limits.iter().filter(|limit| limit.key == own.measure.key);
            of_it.filter(|limit| matches!(limit.bound, Bound::Max(most) if most < own.floor.value))
        });
        lines.extend(hopeless.map(|limit| {
            let level = stated(limit, run.measure(&limit.key));
            line(format!("so no pad at all keeps {} {level} within {travel}", limit.key))
        }));
        lines
    }

    /// The highest floor of each measure among those of several runs, in SI units.
    pub(crate) fn highest(all: &[Self], runs: &[RunReport]) -> Pairs<String, Highest> {
        let mut found: Vec<(String, Highest)> = Vec::new();
        for own in all.iter().zip(runs).flat_map(|(floor, run)| floor.beside(run)) {
            let (key, value) = (&own.measure.key, own.floor.value);
            match found.iter_mut().find(|known| known.0 == *key) {
                Some(known) => known.1.value = known.1.value.max(value),
                None => found.push((key.clone(), Highest { value, unit: own.measure.unit })),
            }
        }
        found.into_iter().collect()
    }

    pub(crate) fn object(&self, run: &RunReport) -> Object {
        let beside = self.beside(run);
        let measures = beside.iter().map(|own| {
            let Floor { value, time, is_reached } = own.floor;
            let (unit, ratio) = (own.measure.unit, own.ratio(own.floor));
            let of_used = own.of_used.map(|of_used| of_used.value);
            (own.measure.key.clone(), Least { value, unit, time, is_reached, ratio, of_used })
        });
        let measures = measures.collect();
        let floors = self.0.as_ref().ok();
        Object {
            travel: floors.map(|own| own.travel.length),
            of: floors.map(|own| own.travel.of.word()),
            body: floors.map(|own| own.body.clone()),
            pad: floors.map(|own| own.pad.clone()),
            note: self.0.as_ref().err().map(ToString::to_string),
            measures,
        }
    }
}

/// The highest of several floors.
#[derive(Serialize)]
pub(crate) struct Highest {
    value: f64,
    unit: &'static str,
}

/// The floors as an object, in SI units.
#[derive(Serialize)]
pub(crate) struct Object {
    travel: Option<f64>,
    /// What bounds it: `thickness`, `stop` or `limit`.
    of: Option<&'static str>,
    body: Option<String>,
    pad: Option<String>,
    /// Why there are none.
    note: Option<String>,
    measures: Pairs<String, Least>,
}

#[derive(Serialize)]
struct Least {
    value: f64,
    unit: &'static str,
    /// When the travel is used up, after touch.
    time: f64,
    /// Whether a force is known that reaches it.
    is_reached: bool,
    /// What the run has come to, in parts of it.
    ratio: Option<f64>,
    /// The floor of the travel that the pad took.
    of_used: Option<f64>,
}

impl Beside<'_> {
    /// What the run has come to in parts of a floor.
    fn ratio(&self, floor: Floor) -> Option<f64> {
        self.measure.value.map(|value| value / floor.value)
    }
}
