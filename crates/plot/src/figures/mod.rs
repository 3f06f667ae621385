//! The registers of figures: of [runs](FIGURES), of [models](model::MODEL_FIGURES), of [fits](FIT_FIGURES), and what
//! vibrations, costs and cushion curves are drawn as.

mod cushion;
mod fits;
pub mod model;
mod runs;
mod stress_energy;
mod unit;
mod vibration;
mod work_precision;

pub use cushion::{CushionCurve, CushionMark, CushionSeries};
pub use fits::{
    CREEP, FIT_FIGURES, FitChannel, FitFigure, FitQuantity, FitRow, FitSeries, HISTORY,
    OSCILLATION, RELAXATION,
};
#[cfg(test)]
pub(crate) use runs::tests;
pub use runs::{
    ACCELERATION_TIME, DEFORMATION_TIME, ENERGY_TIME, ElementSeries, EnergySeries, FIGURES,
    FORCE_DEFORMATION, FORCE_TIME, Figure, MeasuredSeries, NodeSeries, Of, RunLimit, RunMarker,
    RunMarkerKind, RunRank, RunSeries, VELOCITY_TIME,
};
pub use stress_energy::StressEnergySeries;
pub use vibration::{VibrationCurve, VibrationSeries};
pub use work_precision::{PrecisionCurve, PrecisionSeries};
