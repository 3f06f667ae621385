//! What goes out: every verb states its result once as a [`Study`], and [`emit`] brings it to people,
//! to programs, and into a folder.

mod csv;
mod object;
mod study;
mod text;

pub(crate) use csv::csv;
pub(crate) use object::{Pairs, VERSION, list, object};
pub(crate) use study::{Study, emit};
pub(crate) use text::Text;
