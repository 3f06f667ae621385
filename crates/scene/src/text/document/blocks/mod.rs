//! Large texts, parsed in blocks.
//!
//! The parser's own tree takes some fifty times the memory of its text. Texts that one after another
//! have no error are one text without error, so a large one is parsed block by block, and the tree of a
//! block is gone before the next one is parsed. A block begins at the header of a table, or where
//! another one in the same table grows long. Whatever is not plainly the same as in one piece is
//! parsed in one piece: errors, keys that come again, and headers of more than one key.

use toml::de::DeTable;

use super::tree::{Builder, Content, Entry, Item};
use crate::text::{nesting, source::Place};

/// Texts longer than this are parsed in blocks of about this many bytes.
const BLOCK: usize = 64 << 10;

/// The whole text; `None` where it is to be parsed in one piece.
pub(super) fn root(text: &str, builder: &mut Builder) -> Option<Item> {
    if text.len() <= BLOCK {
        return None;
    }
    let mut top = Vec::new();
    let mut section: Option<Section> = None;
    for block in nesting::blocks(text, BLOCK) {
        let own = &text[block.clone()];
        let (table, errors) = DeTable::parse_recoverable(own);
        if !errors.is_empty() {
            return None;
        }
        let entries = builder.entries(table.into_inner(), block.start);
        if own.trim_start_matches('\u{feff}').trim_start().starts_with('[') {
            if let Some(section) = section.take() {
                top.push(section.entry()?);
            }
            section = Some(Section::headed(entries, text)?);
        } else {
            section.as_mut().map_or(&mut top, |section| &mut section.entries).extend(entries);
        }
    }
    if let Some(section) = section {
        top.push(section.entry()?);
    }
    let value = Content::Table(distinct(top)?);
    Some(Item { value, place: Place::new(builder.number, &(0..0)) })
}

/// A table under a header, as far as it has been parsed.
struct Section {
    /// The header as an empty table.
    head: Entry,
    entries: Vec<Entry>,
}

impl Section {
    /// The section of the only table in `entries`, if its header `[…]` has one key.
    fn headed(entries: Vec<Entry>, text: &str) -> Option<Self> {
        let [mut head] = <[Entry; 1]>::try_from(entries).ok()?;
        let has_header = text[head.item.place.span()].starts_with('[');
        match &mut head.item.value {
            Content::Table(entries) if has_header => {
                let entries = std::mem::take(entries).into_vec();
                Some(Self { head, entries })
            }
            _ => None,
        }
    }

    fn entry(self) -> Option<Entry> {
        let Self { mut head, entries } = self;
        head.item.value = Content::Table(distinct(entries)?);
        Some(head)
    }
}

/// The entries, unless two of them have one key.
fn distinct(entries: Vec<Entry>) -> Option<Box<[Entry]>> {
    let mut keys: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
    keys.sort_unstable();
    let is_distinct = keys.windows(2).all(|pair| pair[0] != pair[1]);
    is_distinct.then(|| entries.into_boxed_slice())
}

#[cfg(test)]
mod tests;
