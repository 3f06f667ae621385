//! From trajectories to numbers: measures, the energy ledger, their errors, and the report of a
//! run.
//!
//! [`solve`] compiles a network, integrates it as often as its errors ask for, and returns a
//! [`RunReport`]. All measures are read off the continuous solution, never off samples.

mod accounts;
mod accuracy;
mod attempts;
mod bearing;
mod blows;
mod bodies;
mod contacts;
pub mod contribution;
pub mod cost;
mod difference;
mod driven;
mod error;
mod events;
mod exceedance;
mod excerpt;
mod extremes;
mod hic_search;
mod holding;
mod idle;
mod impact;
mod large;
pub mod ledger;
mod magnitude;
pub mod measures;
mod memory;
mod note;
mod open_end;
mod padding;
pub mod partial;
mod refinement;
mod report;
pub mod rheometer;
mod run_end;
mod sample;
mod segmentation;
mod selection;
mod settings;
pub mod similarity;
mod solution;
mod solve;
pub mod sweep;
mod task;
pub mod verdict;
pub mod vibration;
mod warning;
mod warnings;
mod wording;

pub use accuracy::Accuracy;
pub use cost::cost;
pub use difference::{Difference, differences};
pub use error::RunError;
pub use exceedance::Counted;
pub use excerpt::{excerpt, resolving_times, touching};
pub use holding::SliderFault;
pub use idle::Idle;
pub use impact::{Contact, Impact, Span};
pub use ledger::{EnergySeries, Leak, Ledger, Place};
pub use measures::{Family, MEASURES, Measure, MeasureKind, Reading};
pub use note::Note;
pub use partial::{Partial, solve_partial};
pub use report::{
    ContactReport, EventReport, MeasureReport, RunReport, SolverReport, SystemReport,
};
pub use sample::{Column, Table, regular_times, table, table_at};
pub use segmentation::Segmentation;
pub use selection::MeasureWish;
pub use settings::{Choice, SolveSettings, Stop};
pub use solution::{Solution, doubt_at};
pub use solve::{choice, hopeless_measures, reported_measures, solve, solve_assembly};
pub use warning::{Beyond, Harder, Missed, Through, Warning};
