//! Figures of linear models: what a spring–dashpot model answers at every time and frequency.
//!
//! A figure is one file here: a type, its [`ModelFigure`] implementation, and a line in [`MODEL_FIGURES`]. Several
//! models in one figure are told apart by pattern as well as by colour, so that a comparison can be printed in black:
//! the first one is broad and pale, the second one dashed on top of it.

mod creep;
mod curves;
mod loss_factor;
mod model_series;
mod relaxation;
mod rheometer;
mod sweep;

use crate::Chart;

pub use creep::Creep;
pub use loss_factor::LossFactor;
pub use model_series::{ModelCurve, ModelMarker, ModelSeries, ModelSubject};
pub use relaxation::Relaxation;
pub use rheometer::{Measured, RheometerLine, RheometerSeries};
pub use sweep::Sweep;

/// Every figure of linear models, in the order of a report. **A new one is registered here.**
pub const MODEL_FIGURES: &[&dyn ModelFigure] = &[&Relaxation, &Creep, &Sweep, &LossFactor];

/// A figure drawn from one model, or from several that are compared.
pub trait ModelFigure: Sync {
    /// Name in files and on the command line, as in `relaxation`.
    fn name(&self) -> &'static str;

    /// Heading, as in `Creep compliance`.
    fn title(&self, subject: ModelSubject) -> &'static str;

    /// The chart of `models`, all of them of pads or all of materials; what they have nothing of stays empty.
    fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart;
}

#[cfg(test)]
mod tests;
