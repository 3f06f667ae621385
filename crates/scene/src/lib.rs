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

mod check;
mod curves;
mod diagnostics;
mod kinds;
mod models;
mod outline;
mod posed;
mod quantities;
mod scene;
mod schema;
mod sections;
mod shipped;
mod tables;
mod text;
mod vary;
mod write;

pub use curves::CurveChange;
pub use dashpot_units as units;
pub use diagnostics::fault::Fault;
pub use diagnostics::{Checked, Diagnostic, Diagnostics, Severity};
pub use models::named::{NamedModel, read_models, read_named_model};
pub use models::notes::{ModelNote, Remark, RestRemoved};
pub use outline::{OutlineRow, outline};
pub use posed::{Posed, pose};
pub use quantities::bare::{BareNumber, BareNumbers};
pub use quantities::scatter::ScatterFault;
pub use quantities::values::NamedValue;
pub use quantities::words::with_units;
pub use scene::{ReadOptions, RunSettings, Scene, read, read_bytes, read_network, read_shared};
pub use schema::schema;
pub use sections::{WISHING, Wish, parse_limits, wishes};
pub use shipped::{Shipped, reference, references, template, templates};
pub use tables::{
    DataTable, Heading, LeftOut, Likewise, TableError, TableFault, guarded, table_text, text_cell,
};
pub use text::bytes::text_of_bytes;
pub use text::document::MAX_BYTES;
pub use text::library::Loader;
pub use text::nearest::{nearest, suggestion};
pub use text::source::Source;
pub use text::visible::{is_control, is_hidden, visible};
pub use vary::listed::{Listed, ListedFault};
pub use vary::scatter::{Change, Drawn, Sample};
pub use vary::scattered::ScatteredNumber;
pub use vary::tunable::{Tunable, TunableFault, Tunables};
pub use vary::variation::{Variation, VariationFault};
pub use write::limits::with_limits;
pub use write::references::with_paths;
pub use write::rewrite::with_model;
pub use write::scene::{Unwritable, write_scene};
pub use write::{write_effect, write_kind, write_material_table, write_model, write_model_table};

#[cfg(test)]
mod tests;
