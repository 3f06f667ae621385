//! What is read: TOML texts, as values that know their places.

pub(crate) mod bytes;
pub(crate) mod document;
pub(crate) mod library;
pub(crate) mod nearest;
pub(crate) mod nesting;
pub(crate) mod repair;
pub(crate) mod source;
pub(crate) mod table;
pub(crate) mod table_file;
pub(crate) mod visible;
