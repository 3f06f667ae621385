//! The thesis behind this project, "Impact Modeling of Viscoelastic Systems", recomputed: its groups,
//! chapter III in closed form, its figures, numbers, misprints and claims.
//!
//! The thesis solved its equations on an analogue computer and read its conclusions off the plots. Here the same
//! equations are solved exactly. Nothing is taken over: verdicts follow from what is computed at run time.
//!
//! - [`Groups`]: a … e, α, β, γ, to and from springs, dashpots and masses.
//! - [`Pulse`]: chapter III, a padding under a force that is prescribed.
//! - [`Impact`]: chapter II, exactly; [`best_pulse`] is the pulse that comes nearest to its force.
//! - [`Recomputation`]: numbers, misprints and claims; [`figures()`] has the figures.
//!
//! # Examples
//!
//! ```
//! use dashpot_thesis::{Groups, Impact};
//!
//! let impact = Impact::of_groups(&Groups::PRINTED)?;
//! assert!((impact.peak().value - 0.767_833_515).abs() < 1e-9);
//! assert!((impact.deepest().time - 3.426_861_744).abs() < 1e-8);
//! # Ok::<(), dashpot_thesis::ThesisError>(())
//! ```

mod claims;
mod error;
mod figures;
mod fit;
mod groups;
mod impact;
mod lambert;
mod misprints;
mod numbers;
mod pulse;
mod report;
mod study;
mod words;

pub use claims::{Claim, Verdict, claims};
pub use error::ThesisError;
pub use figures::{
    Column, Drawing, EQUATIONS, Figure, GraphCase, figure_stems, figures, graph_cases,
};
pub use fit::{Fit, best_pulse, misfit};
pub use groups::{Groups, Padding, Scales, Support};
pub use impact::{DURATION, Impact};
pub use lambert::intersections;
pub use misprints::{Demonstration, Misprint, misprint_table, misprints};
pub use numbers::{
    Number, NumberVerdict, STANDARD_GRAVITY, chapter_3_table, exact_table, fit_table, number_table,
    numbers,
};
pub use pulse::{Checks, Constants, Parameter, Pulse};
pub use report::Recomputation;
pub use study::{Family, Member, Study, Varied};
