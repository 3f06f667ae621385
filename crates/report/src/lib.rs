//! What a result says to people, stated once: a [`Report`] of lines, tables, notes and figures, which every face shows,
//! [as text](Text::report) of 80 columns and [as a page](Report::html).
//!
//! Nothing here knows scenes, studies or solvers, reads files or prints: data in, text out.

pub mod layout;
pub mod numbers;
mod page;
mod report;
mod table;
mod text;
mod tone;
#[cfg(test)]
#[path = "../../plot/src/tests/well_formed.rs"]
mod well_formed;

pub use page::{Page, ReportFigure};
pub use report::{Block, Drawing, Figure, Line, Place, Report};
pub use table::{Columns, Table};
pub use text::Text;
pub use tone::{Tone, Tones};
