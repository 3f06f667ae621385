//! Two-terminal models as trees: primitives composed in series and in parallel, the named forms of
//! viscoelasticity as short words for such trees, and what a linear model is, seen from outside.

pub mod appendix_a;
pub mod conversion;
pub mod equivalence;
pub mod forms;
pub mod identifiability;
pub mod linear;
pub mod sensitivity;
pub mod spectra;
mod tree;

pub use forms::{FORMS, Form, Part, Role};
pub use linear::{Canonical, DoubleDouble, KelvinForm, LinearModel, MaxwellForm, Primitive};
pub use tree::{Branch, MOST_LEVELS, Tree};
