//! Scenes: TOML text in, checked values out, with errors that point at the text.
//!
//! [`read`] turns a text into a [`Scene`]: a network, compiled, and what is to be done with it. All
//! faults of a text are found in one reading and returned together as [`Diagnostics`], which
//! [`render`](Diagnostics::render) with the value under a caret, the nearest known word and the unit
//! that is expected. The crate knows no file system: other files come through a [`Loader`].
//!
//! What may stand in a scene follows from the registers of elements, forms, driving functions,
//! effects, measures and methods; there is no second list. [`schema`] writes it down as a JSON
//! schema, [`templates`] are commented scenes to start from.
//!
//! Quantities carry [`units`]; inside all values are SI.

mod basis;
mod csv;
mod diagnostics;
mod document;
mod driven;
mod fault;
mod fault_help;
mod kinds;
mod library;
mod models;
mod named;
mod nearest;
mod nesting;
mod network_faults;
mod notes;
mod pad;
mod parameters;
mod plausible;
mod quantity;
mod render;
mod repair;
mod review;
mod rewrite;
mod scene;
mod schema;
mod sections;
mod shipped;
mod source;
mod table;
mod tunable;
pub mod units;
mod values;
mod variation;
mod visible;
mod write;
mod write_scene;
mod write_waveform;

pub use csv::{CsvFault, text_cell};
pub use diagnostics::{Checked, Diagnostic, Diagnostics, Severity};
pub use document::MAX_BYTES;
pub use fault::Fault;
pub use library::Loader;
pub use named::{NamedModel, read_named_model};
pub use nearest::{nearest, suggestion};
pub use notes::ModelNote;
pub use rewrite::with_model;
pub use scene::{ReadOptions, RunSettings, Scene, read, read_bytes, read_network, text_of_bytes};
pub use schema::schema;
pub use shipped::{Shipped, reference, references, template, templates};
pub use source::Source;
pub use tunable::{Tunable, TunableFault, Tunables};
pub use values::NamedValue;
pub use variation::{Variation, VariationFault};
pub use visible::{is_control, visible};
pub use write::{write_effect, write_kind, write_material_table, write_model, write_model_table};
pub use write_scene::{Unwritable, write_scene};

#[cfg(test)]
mod tests;
