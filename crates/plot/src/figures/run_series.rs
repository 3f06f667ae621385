//! The plain numbers of one run that figures are drawn from.

use super::Quantity;
use super::markers::listed;
use super::unit::Unit;
use crate::{Direction, ReferenceLine};

/// Sampled results of one run with one method, in SI units.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunSeries {
    /// Name of the method.
    pub method: String,
    /// Sample times \[s\], ascending.
    pub time: Vec<f64>,
    /// Elements to be shown.
    pub elements: Vec<ElementSeries>,
    /// Parts of the energy ledger.
    pub energy: Vec<EnergySeries>,
    /// Length of the run \[s\] where `time` is only a part of it; figures then say which.
    pub excerpt_of: Option<f64>,
    /// Points worth a text; of several runs the first one's are drawn.
    pub markers: Vec<RunMarker>,
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
    /// Whether it is a rigid contact: its force does not belong to its deformation, which is the
    /// width of a gap.
    pub is_contact: bool,
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
    /// Time \[s\].
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

/// What a figure shows along an axis: a signal of an element, or the parts of the energy ledger.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Time,
    Force,
    Deformation,
    Energy,
}

impl Of {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Force => "force",
            Self::Deformation => "deformation",
            Self::Energy => "energy",
        }
    }

    /// The unit in which such values are shown.
    pub(super) fn unit(self, values: impl Iterator<Item = f64>) -> Unit {
        match self {
            Self::Time => Unit::time(values),
            Self::Force => Unit::force(values),
            Self::Deformation => Unit::length(values),
            Self::Energy => Unit::energy(values),
        }
    }
}

impl RunSeries {
    pub(super) fn signal<'a>(&'a self, element: &'a ElementSeries, of: Of) -> &'a [f64] {
        match of {
            Of::Time => &self.time,
            Of::Force => &element.force,
            Of::Deformation => &element.deformation,
            Of::Energy => &[],
        }
    }
}

/// Per element of the first run, or per part of its energy ledger, one curve of `y` over `x` of each run.
pub(super) fn quantities(runs: &[RunSeries], x: Of, y: Of) -> Vec<Quantity> {
    let Some(first) = runs.first() else { return Vec::new() };
    let curve = |run: &RunSeries, name: &str| {
        if y == Of::Energy {
            let part = run.energy.iter().find(|part| part.name == name);
            return part.map_or_else(Vec::new, |part| zip(&run.time, &part.values));
        }
        let is_drawn = |e: &&ElementSeries| !(e.is_contact && x == Of::Deformation);
        let element = run.elements.iter().find(|e| e.name == name).filter(is_drawn);
        element.map_or_else(Vec::new, |e| zip(run.signal(e, x), run.signal(e, y)))
    };
    let of_all = |name: &String| Quantity {
        name: name.clone(),
        curves: runs.iter().map(|run| curve(run, name)).collect(),
    };
    match y {
        Of::Energy => first.energy.iter().map(|part| of_all(&part.name)).collect(),
        _ => first.elements.iter().map(|element| of_all(&element.name)).collect(),
    }
}

/// Points of two signals of equal times; the longer one is cut.
fn zip(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    x.iter().copied().zip(y.iter().copied()).collect()
}

/// The thicknesses of the elements that are shown, in the colours of their curves; equal ones are one line.
pub(super) fn thickness_lines(
    runs: &[RunSeries],
    shown: &[Quantity],
    direction: Direction,
    unit: Unit,
) -> Vec<ReferenceLine> {
    let elements = runs.first().map_or(&[][..], |run| &run.elements);
    let mut limits: Vec<(f64, Vec<&str>, Option<usize>)> = Vec::new();
    for element in elements {
        let colour = shown.iter().position(|q| q.name == element.name);
        let (Some(thickness), Some(_)) = (element.thickness, colour) else { continue };
        match limits.iter_mut().find(|limit| limit.0.total_cmp(&thickness).is_eq()) {
            Some((_, names, shared)) => {
                names.push(&element.name);
                *shared = None;
            }
            None => limits.push((thickness, vec![&element.name], colour)),
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
