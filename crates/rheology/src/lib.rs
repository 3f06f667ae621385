//! Two-terminal models as trees: primitives composed in series and in parallel, and the named
//! forms of viscoelasticity as short words for such trees.

pub mod forms;
mod tree;

pub use forms::{Form, FormVisitor, Part, Role, visit_forms};
pub use tree::{Branch, Tree};
