//! Charts, maps and network drawings of dashpot, from plain numbers and texts to SVG and terminal text.
//!
//! - [`Chart`]: curves with markers and limits, as [SVG](Chart::svg) and as [text](Chart::text).
//! - [`figures`]: the register of figures that are drawn from the [`RunSeries`] of one or several runs.
//! - [`figures::model`]: the register of figures that are drawn from the [`ModelSeries`] of linear models, and what a
//!   rheometer measures on them.
//! - [`figures::FIT_FIGURES`]: the register of figures that are drawn from the [`FitSeries`] of fits.
//! - [`Sketch`]: a network of masses, springs, dashpots and supports, as [SVG](Sketch::svg) and as [text](Sketch::text).
//! - [`Map`]: a value over two quantities, as [SVG](Map::svg).
//!
//! Nothing here knows scenes, systems or solvers, reads files or prints: data in, text out.

mod axis;
mod chart;
mod decimation;
pub mod figures;
mod map;
mod sketch;
mod text_metrics;
mod theme;
#[cfg(test)]
#[path = "tests/well_formed.rs"]
mod well_formed;

pub use chart::{
    Chart, Direction, Marker, Pattern, PlotError, ReferenceLine, Scale, Series, Stroke,
};
pub use figures::model::{
    Loop, LoopSeries, Measured, ModelCurve, ModelFigure, ModelSeries, ModelSubject, RheometerLine,
    RheometerSeries,
};
pub use figures::{
    CushionCurve, CushionMark, CushionSeries, ElementSeries, EnergySeries, Figure, FitChannel,
    FitFigure, FitQuantity, FitRow, FitSeries, MeasuredSeries, NodeSeries, Of, PrecisionCurve,
    PrecisionSeries, RunLimit, RunMarker, RunMarkerKind, RunSeries, StressEnergySeries,
    VibrationCurve, VibrationSeries,
};
pub use map::{Map, MapLimit, Side};
pub use sketch::{
    Sketch, SketchGravity, SketchKind, SketchLaw, SketchLink, SketchNode, SketchTree,
};
pub use text_metrics::escape;
pub use theme::page_colours;
