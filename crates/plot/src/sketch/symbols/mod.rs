//! Symbols of elements and nodes as pieces of SVG.

mod canvas;
mod elements;
mod nodes;

pub(super) use canvas::{Canvas, Weight};
pub(super) use elements::{SYMBOLS, leaf_extent, symbol_of};
pub(super) use nodes::{GRAVITY, LINE, gravity_width, node_extent, word};
