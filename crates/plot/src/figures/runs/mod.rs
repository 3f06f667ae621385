//! Figures of runs: one line of [`FIGURES`] says which signal stands over which, and what is marked.

mod curves;
mod markers;
mod measured;
mod notes;
mod series;
#[cfg(test)]
pub(crate) mod tests;

use self::{
    curves::{curves, cut_off, has_order, largest},
    markers::markers,
    measured::measured,
    notes::note,
    series::{limit_lines, quantities, thickness_lines},
};
use crate::{Chart, Direction};

pub use series::{
    ElementSeries, EnergySeries, MeasuredSeries, NodeSeries, Of, RunLimit, RunMarker,
    RunMarkerKind, RunRank, RunSeries,
};

use RunMarkerKind::{DeepestPoint, PeakForce, TensionStart};

/// Every figure, in the order of the report. **A new figure is registered here.**
pub const FIGURES: &[Figure] = &[
    FORCE_TIME,
    ACCELERATION_TIME,
    VELOCITY_TIME,
    DEFORMATION_TIME,
    FORCE_DEFORMATION,
    ENERGY_TIME,
];

/// Force of each element over time, positive in compression.
pub const FORCE_TIME: Figure =
    Figure::of("force-time", "Force over time", (Of::Time, Of::Force), &[PeakForce, TensionStart]);

/// Acceleration of each mass over time, as an accelerometer reads it, positive away from the support: free fall is 0.
pub const ACCELERATION_TIME: Figure =
    Figure::of("acceleration-time", "Acceleration over time", (Of::Time, Of::Acceleration), &[]);

/// Velocity of each mass over time, positive towards the support.
pub const VELOCITY_TIME: Figure =
    Figure::of("velocity-time", "Velocity over time", (Of::Time, Of::Velocity), &[]);

/// Deformation of each element over time, positive in compression, with the thickness of pads as a limit. Gaps at
/// contacts that are wide beside the deformations are cut off.
pub const DEFORMATION_TIME: Figure = Figure::of(
    "deformation-time",
    "Deformation over time",
    (Of::Time, Of::Deformation),
    &[DeepestPoint, TensionStart],
);

/// Force of each element over its deformation, both positive in compression: the area in a loop is the energy lost.
pub const FORCE_DEFORMATION: Figure = Figure::of(
    "force-deformation",
    "Force over deformation",
    (Of::Deformation, Of::Force),
    &[PeakForce, DeepestPoint, TensionStart],
);

/// The parts of the energy ledger over time.
pub const ENERGY_TIME: Figure =
    Figure::of("energy-time", "Energy over time", (Of::Time, Of::Energy), &[]);

/// A figure drawn from one or several runs of the same scene.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Name in files and on the command line, as in `force-time`.
    pub name: &'static str,
    /// Heading, as in `Force over time`.
    pub title: &'static str,
    x: Of,
    y: Of,
    kinds: &'static [RunMarkerKind],
}

impl Figure {
    const fn of(
        name: &'static str,
        title: &'static str,
        (x, y): (Of, Of),
        kinds: &'static [RunMarkerKind],
    ) -> Self {
        Self { name, title, x, y, kinds }
    }

    /// The figure of this signal over time.
    pub fn over_time(y: Of) -> Option<&'static Self> {
        FIGURES.iter().find(|figure| figure.x == Of::Time && figure.y == y)
    }

    /// The chart of `runs`, which differ in their method or are designs; what they have nothing of stays empty.
    pub fn chart(&self, runs: &[RunSeries]) -> Chart {
        let mut all = quantities(runs, self.x, self.y);
        let widest = if self.y == Of::Deformation { cut_off(runs, &mut all) } else { None };
        let are_designs = runs.iter().any(|run| run.is_design);
        if are_designs {
            all.retain(|quantity| quantity.curves.iter().any(|curve| !curve.is_empty()));
        }
        let (shown, left_out) = largest(all, self.y);
        // Of several designs each has its own peak; the curves tell them.
        let marked = if are_designs { &[] } else { self.kinds };
        let measured = measured(runs, (self.x, self.y));
        let of_measured = || measured.iter().flat_map(|own| &own.points);
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten()).chain(of_measured());
        let x = self.x.unit(points().map(|p| p.0));
        let y = self.y.unit(points().map(|p| p.1));
        let mut series = curves(runs, &shown, x.factor, y.factor);
        let taken = series.iter().filter_map(|own| Some(own.stroke?.colour + 1)).max();
        series.extend(measured::series(&measured, taken.unwrap_or(0), (x, y)));
        let gaps = widest.map(|gap| format!("gaps wider than {} are cut off", y.print(gap)));
        let thicknesses = match (self.x, self.y) {
            (Of::Deformation, _) => thickness_lines(runs, &shown, Direction::Vertical, x),
            (_, Of::Deformation) => thickness_lines(runs, &shown, Direction::Horizontal, y),
            _ => Vec::new(),
        };
        let limits = limit_lines(runs, &shown, (self.x, x), Direction::Vertical)
            .into_iter()
            .chain(limit_lines(runs, &shown, (self.y, y), Direction::Horizontal));
        Chart {
            title: self.title.into(),
            note: note(runs, left_out, gaps),
            x_label: x.label(&word(runs, self.x)),
            y_label: y.label(self.y.word()),
            markers: markers(runs, &shown, marked, (self.x, x), (self.y, y)),
            lines: limits.chain(thicknesses).collect(),
            family: if has_order(runs, &shown) { runs.len() } else { 0 },
            series,
            has_arrows: self.x != Of::Time,
            ..Chart::default()
        }
    }
}

/// What an axis is labelled with.
fn word(runs: &[RunSeries], of: Of) -> String {
    let is_shifted = of == Of::Time && runs.iter().any(|run| run.first_touch.is_some());
    if is_shifted { "time from first touch".into() } else { of.word().into() }
}
