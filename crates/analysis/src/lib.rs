//! From trajectories to numbers: measures, the energy ledger, their errors, and the report of a run.
//!
//! [`Solve`] compiles a network, integrates it as often as its errors ask for, and returns a
//! [`RunReport`]. All measures are read off the continuous solution, never off samples.

pub mod contribution;
mod duration;
mod energy;
mod error;
mod errors;
pub mod gradients;
mod impact;
pub mod limits;
pub mod measured;
pub mod measures;
mod memory;
mod note;
pub mod partial;
mod report;
pub mod rheometer;
mod run;
mod segmentation;
mod settings;
pub mod similarity;
mod solution;
mod solve;
pub mod sweep;
pub mod vibration;
mod wording;
pub mod work_precision;

pub use duration::{FoundDuration, found_duration};
pub use energy::ledger;
pub use energy::ledger::{EnergySeries, Leak, Ledger, Place};
pub use error::{NoValue, RunError};
pub use impact::impulses::VelocityJump;
pub use impact::interval::{Contact, Impact, Span};
pub use impact::sliders::Idle;
pub use impact::sliders::SliderFault;
pub use limits::{Bound, Judgement, Limit, Reason};
pub use measures::asked::ask;
pub use measures::exceedance::Counted;
pub use measures::selection::{MeasureWish, reported};
pub use measures::{Family, MEASURES, Measure, MeasureKind, MeasureTraits, Reading};
pub use note::Note;
pub use report::compression::Compression;
pub use report::event::{Collision, Event, EventReport};
pub use report::excerpt::{excerpt, resolving_times, touching};
pub use report::judged::Judged;
pub use report::partial::{Partial, Segmentation};
pub use report::sample::{Column, Table, regular_times, table, table_at};
pub use report::scatter::{Band, Chance, Odds, ScatterReport, ScatterSource};
pub use report::unevaluated::{Cause, CauseKind, Misses, Missing, Unevaluated};
pub use report::verdict;
pub use report::warning::{Beyond, Harder, Missed, Through, Warning};
pub use report::{ContactReport, MeasureReport, RunReport, SolverReport, SystemReport};
pub use report::{Difference, differences};
pub use run::{
    Signals, choice, reported_measures, solve_assembly, solve_signals, undefined_measures,
};
pub use settings::{Accuracy, Choice, SolveSettings, Stop};
pub use solution::{Solution, threshold_at};
pub use solve::{Solve, solve_partial};
pub use work_precision::work_precision;
