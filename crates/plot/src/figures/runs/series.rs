//! The plain numbers of one run that figures are drawn from.

use super::super::unit::{self, Unit};
use crate::{Direction, ReferenceLine};

/// So many names stand in one text.
pub(super) const MOST_LISTED: usize = 3;

/// Sampled results of one run, in SI units.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunSeries {
    /// What tells it from others: its method, or its design.
    pub name: String,
    /// Whether it is one of several designs, and not of several methods of the same scene.
    pub is_design: bool,
    /// Of designs that differ in a number: its place in their order.
    pub rank: Option<RunRank>,
    /// Sample times \[s\], ascending: from the start of the run, or from the first touch.
    pub time: Vec<f64>,
    /// When in the run \[s\] an impactor that falls or flies first touches something: 0 of `time` and of the times of
    /// markers. `None` where these count from the start of the run.
    pub first_touch: Option<f64>,
    /// Elements to be shown.
    pub elements: Vec<ElementSeries>,
    /// Masses to be shown.
    pub nodes: Vec<NodeSeries>,
    /// Parts of the energy ledger.
    pub energy: Vec<EnergySeries>,
    /// Length of the run \[s\] where `time` is only a part of it; figures then say which.
    pub excerpt_of: Option<f64>,
    /// Points worth a text; of several runs the first one's are drawn.
    pub markers: Vec<RunMarker>,
    /// Limits.
    pub limits: Vec<RunLimit>,
    /// What was measured, beside the curves; equal ones of several runs are drawn once.
    pub measured: Vec<MeasuredSeries>,
}

/// The place of a design among others by one number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct RunRank {
    /// Its place in the rising order of the numbers, from 0, which gives its colour.
    pub place: usize,
    /// Which designs it is like in all else, from 0, which gives its pattern.
    pub group: usize,
}

/// One element at the sample times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ElementSeries {
    /// Name.
    pub name: String,
    /// Force \[N\], positive in compression.
    pub force: Vec<f64>,
    /// Deformation \[m\], positive in compression.
    pub deformation: Vec<f64>,
    /// Thickness \[m\] of a pad, drawn as a limit of the deformation.
    pub thickness: Option<f64>,
    /// Whether it is a rigid contact: its force does not belong to its deformation, which is the width of a gap.
    pub is_contact: bool,
}

/// One mass at the sample times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NodeSeries {
    /// Name.
    pub name: String,
    /// What an accelerometer reads \[m/s²\], positive away from the support.
    pub acceleration: Vec<f64>,
    /// Velocity \[m/s\], positive towards the support.
    pub velocity: Vec<f64>,
}

/// What a signal of an element or a mass may be.
#[derive(Debug, Clone, PartialEq)]
pub struct RunLimit {
    /// Name of the element or mass.
    pub name: String,
    /// Which signal.
    pub of: Of,
    /// The limit, in the SI unit of the signal.
    pub at: f64,
    /// Text at its line.
    pub label: String,
}

/// One part of the energy ledger at the sample times.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EnergySeries {
    /// Name, as in `kinetic`.
    pub name: String,
    /// Energy \[J\].
    pub values: Vec<f64>,
}

/// A point of an element's curves that carries a text.
#[derive(Debug, Clone, PartialEq)]
pub struct RunMarker {
    /// Name of the element.
    pub element: String,
    /// What happens there; decides which figures show it.
    pub kind: RunMarkerKind,
    /// Time \[s\], counted as those of the samples.
    pub time: f64,
    /// Text beside the point, as in `peak 38.4 kN`.
    pub label: String,
    /// Its time as text, as in `0.98 ms`; empty where the label tells it.
    pub moment: String,
}

/// What a [`RunMarker`] marks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RunMarkerKind {
    /// The largest force.
    PeakForce,
    /// The largest deformation.
    DeepestPoint,
    /// The first time at which the element pulls.
    TensionStart,
}

/// A curve that was measured, over time.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSeries {
    /// Name in the legend, as in `measured, drop.csv`.
    pub name: String,
    /// What was measured, which decides in which figure it stands.
    pub of: Of,
    /// (Time \[s\], value in SI units), in order of time, which counts as that of the runs.
    pub points: Vec<(f64, f64)>,
}

/// One quantity of all runs: a name and, per run, its curve in SI units.
pub(super) struct Quantity {
    pub(super) name: String,
    pub(super) curves: Vec<Vec<(f64, f64)>>,
}

/// What a figure shows along an axis: a signal of an element or a mass, or the parts of the energy ledger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Of {
    /// Time \[s\].
    Time,
    /// Force of an element \[N\].
    Force,
    /// Deformation of an element \[m\].
    Deformation,
    /// Acceleration of a mass \[m/s²\].
    Acceleration,
    /// Velocity of a mass \[m/s\].
    Velocity,
    /// Parts of the energy ledger \[J\].
    Energy,
}

impl Of {
    /// Its name, as in `force`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Force => "force",
            Self::Deformation => "deformation",
            Self::Acceleration => "acceleration",
            Self::Velocity => "velocity",
            Self::Energy => "energy",
        }
    }

    /// The unit in which such values are shown.
    pub(super) fn unit(self, values: impl Iterator<Item = f64>) -> Unit {
        match self {
            Self::Time => Unit::of(&unit::TIME, values),
            Self::Force => Unit::of(&unit::FORCE, values),
            Self::Deformation => Unit::of(&unit::LENGTH, values),
            Self::Acceleration => Unit::of(&unit::ACCELERATION, values),
            Self::Velocity => Unit::of(&unit::VELOCITY, values),
            Self::Energy => Unit::of(&unit::ENERGY, values),
        }
    }
}

impl RunSeries {
    pub(super) fn signal<'a>(&'a self, element: &'a ElementSeries, of: Of) -> &'a [f64] {
        match of {
            Of::Time => &self.time,
            Of::Force => &element.force,
            Of::Deformation => &element.deformation,
            Of::Acceleration | Of::Velocity | Of::Energy => &[],
        }
    }

    /// A signal over time that belongs to no element, by the name of what it belongs to.
    fn of_others(&self, name: &str, of: Of) -> Option<&[f64]> {
        let node = || self.nodes.iter().find(|own| own.name == name);
        Some(match of {
            Of::Acceleration => &node()?.acceleration,
            Of::Velocity => &node()?.velocity,
            _ => &self.energy.iter().find(|own| own.name == name)?.values,
        })
    }
}

/// Per element, mass or part of the energy ledger one curve of `y` over `x` of each run.
pub(super) fn quantities(runs: &[RunSeries], x: Of, y: Of) -> Vec<Quantity> {
    let curve = |run: &RunSeries, name: &str| {
        if !matches!(y, Of::Force | Of::Deformation) {
            return run.of_others(name, y).map_or_else(Vec::new, |own| zip(&run.time, own));
        }
        let is_drawn = |e: &&ElementSeries| !(e.is_contact && x == Of::Deformation);
        let element = run.elements.iter().find(|e| e.name == name).filter(is_drawn);
        element.map_or_else(Vec::new, |e| zip(run.signal(e, x), run.signal(e, y)))
    };
    let of_all = |name: &String| Quantity {
        name: name.clone(),
        curves: runs.iter().map(|run| curve(run, name)).collect(),
    };
    let mut names: Vec<&String> = Vec::new();
    for run in runs {
        let own: Vec<&String> = match y {
            Of::Energy => run.energy.iter().map(|own| &own.name).collect(),
            Of::Acceleration | Of::Velocity => run.nodes.iter().map(|own| &own.name).collect(),
            _ => run.elements.iter().map(|own| &own.name).collect(),
        };
        names.extend(own.into_iter().filter(|name| !names.contains(name)).collect::<Vec<_>>());
    }
    names.into_iter().map(of_all).collect()
}

/// Points of two signals of equal times; the longer one is cut.
fn zip(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

/// The limits on what is shown along one axis, in the colours of their curves.
pub(super) fn limit_lines(
    runs: &[RunSeries],
    shown: &[Quantity],
    (of, unit): (Of, Unit),
    direction: Direction,
) -> Vec<ReferenceLine> {
    let mut limits: Vec<&RunLimit> = Vec::new();
    for limit in runs.iter().flat_map(|run| &run.limits).filter(|limit| limit.of == of) {
        if !limits.contains(&limit) {
            limits.push(limit);
        }
    }
    let lines = limits.into_iter().filter_map(|limit| {
        let colour = shown.iter().position(|own| own.name == limit.name)?;
        let colour = (shown.len() > 1).then_some(colour);
        let (at, label) = (limit.at / unit.factor, limit.label.clone());
        Some(ReferenceLine { direction, at, label, colour })
    });
    lines.collect()
}

/// The thicknesses of the elements that are shown, in the colours of their curves; equal ones are one line.
pub(super) fn thickness_lines(
    runs: &[RunSeries],
    shown: &[Quantity],
    direction: Direction,
    unit: Unit,
) -> Vec<ReferenceLine> {
    let is_meant = |(at, run): &(usize, &RunSeries)| *at == 0 || run.is_design;
    let of_run = |(at, run)| {
        let run: &RunSeries = run;
        run.elements.iter().map(move |element| (at, run, element))
    };
    let elements = runs.iter().enumerate().filter(is_meant).flat_map(of_run);
    let mut limits: Vec<(f64, Vec<&str>, Option<usize>)> = Vec::new();
    for (at, run, element) in elements {
        let colour = shown.iter().position(|q| q.name == element.name);
        let (Some(thickness), Some(_)) = (element.thickness, colour) else { continue };
        let (name, colour) = match run.is_design {
            true if shown.len() == 1 => (&run.name, run.rank.is_none().then_some(at)),
            true => (&run.name, colour),
            false => (&element.name, colour),
        };
        match limits.iter_mut().find(|limit| limit.0.total_cmp(&thickness).is_eq()) {
            Some((_, names, shared)) => {
                if !names.contains(&name.as_str()) {
                    names.push(name);
                }
                *shared = None;
            }
            None => limits.push((thickness, vec![name], colour)),
        }
    }
    let line = |(thickness, names, colour): (f64, Vec<&str>, Option<usize>)| ReferenceLine {
        direction,
        at: thickness / unit.factor,
        label: format!("thickness of {}: {}", listed(&names), unit.print(thickness)),
        colour,
    };
    limits.into_iter().map(line).collect()
}

/// Names in one text; of many the first ones and how many more there are.
pub(super) fn listed(names: &[&str]) -> String {
    const LAST: usize = MOST_LISTED - 1;
    match names.len() {
        0..=MOST_LISTED => names.join(", "),
        count => format!("{} and {} more", names[..LAST].join(", "), count - LAST),
    }
}
