//! Values of a TOML text that know their places; each of its words is kept once.

use std::{
    collections::HashSet,
    fmt,
    ops::{Deref, Range},
    sync::Arc,
};

use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::text::source::Place;

/// A value and its place.
#[derive(Debug, Clone)]
pub(crate) struct Item {
    pub(crate) value: Content,
    /// Where it stands. For a table under a header that is the header.
    pub(crate) place: Place,
}

#[derive(Debug, Clone)]
pub(crate) enum Content {
    /// A string.
    Text(Word),
    /// An integer or a float, as decimal digits.
    Number(Word),
    /// `true` or `false`.
    Switch(bool),
    /// A date or a time.
    Date,
    /// A list.
    List(Box<[Item]>),
    /// A table, in the order of the text.
    Table(Box<[Entry]>),
}

/// A key and its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key: Word,
    pub(crate) key_place: Place,
    pub(crate) item: Item,
}

impl Item {
    pub(crate) fn type_name(&self) -> String {
        match &self.value {
            Content::Text(_) => "a text".to_owned(),
            Content::Number(_) => "a number".to_owned(),
            Content::Switch(switch) => format!("`{switch}`"),
            Content::Date => "a date".to_owned(),
            Content::List(items) if items.len() == 1 => "a list of 1 entry".to_owned(),
            Content::List(items) => format!("a list of {} entries", items.len()),
            Content::Table(_) => "a table".to_owned(),
        }
    }

    /// The entries, where it is a table.
    pub(crate) fn table(&self) -> Option<&[Entry]> {
        if let Content::Table(entries) = &self.value { Some(entries) } else { None }
    }

    /// The text, where it is one.
    pub(crate) fn text(&self) -> Option<&str> {
        if let Content::Text(text) = &self.value { Some(text) } else { None }
    }
}

/// Makes items of what the parser found.
pub(super) struct Builder {
    /// Number of the source.
    pub(super) number: u32,
    pub(super) words: Words,
}

impl Builder {
    /// The entries of a table in the part of the text that begins at the byte `start`.
    pub(super) fn entries(&mut self, table: DeTable<'_>, start: usize) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(table.len());
        for (key, value) in table {
            entries.push(Entry {
                key_place: self.place(&key.span(), start),
                key: self.words.word(key.get_ref()),
                item: self.item(value, start),
            });
        }
        // The parser sorts by key; the order of the text decides the order of nodes and branches.
        entries.sort_by_key(|entry| entry.key_place.start);
        entries
    }

    fn item(&mut self, value: Spanned<DeValue<'_>>, start: usize) -> Item {
        let place = self.place(&value.span(), start);
        let value = match value.into_inner() {
            DeValue::String(text) => Content::Text(self.words.word(&text)),
            DeValue::Integer(integer) => {
                let digits = decimal(integer.as_str(), integer.radix());
                Content::Number(self.words.word(&digits))
            }
            DeValue::Float(float) => Content::Number(self.words.word(float.as_str())),
            DeValue::Boolean(switch) => Content::Switch(switch),
            DeValue::Datetime(_) => Content::Date,
            DeValue::Array(items) => {
                let mut list = Vec::with_capacity(items.len());
                for value in items {
                    list.push(self.item(value, start));
                }
                Content::List(list.into_boxed_slice())
            }
            DeValue::Table(table) => Content::Table(self.entries(table, start).into_boxed_slice()),
        };
        Item { value, place }
    }

    fn place(&self, span: &Range<usize>, start: usize) -> Place {
        Place::new(self.number, &(start + span.start..start + span.end))
    }
}

fn decimal(digits: &str, radix: u32) -> String {
    match u128::from_str_radix(digits, radix) {
        Ok(value) if radix != 10 => value.to_string(),
        _ => digits.to_owned(),
    }
}

/// A key or a string of a text.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Word(Arc<str>);

impl Word {
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }
}

impl Deref for Word {
    type Target = str;

    fn deref(&self) -> &str {
        &self.0
    }
}

impl fmt::Display for Word {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(formatter)
    }
}

impl<T: Into<Arc<str>>> From<T> for Word {
    fn from(text: T) -> Self {
        Self(text.into())
    }
}

impl PartialEq<str> for Word {
    fn eq(&self, other: &str) -> bool {
        *self.0 == *other
    }
}

impl PartialEq<&str> for Word {
    fn eq(&self, other: &&str) -> bool {
        *self.0 == **other
    }
}

impl PartialEq<Word> for &str {
    fn eq(&self, other: &Word) -> bool {
        **self == *other.0
    }
}

/// The words met so far: what is written again shares its memory with the first time.
#[derive(Debug, Default)]
pub(super) struct Words(HashSet<Arc<str>>);

impl Words {
    pub(super) fn word(&mut self, text: &str) -> Word {
        if let Some(known) = self.0.get(text) {
            return Word(Arc::clone(known));
        }
        let word: Arc<str> = text.into();
        self.0.insert(Arc::clone(&word));
        Word(word)
    }
}
