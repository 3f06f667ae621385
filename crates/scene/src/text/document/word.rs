//! Words of a text, each kept once.

use std::{collections::HashSet, fmt, ops::Deref, sync::Arc};

/// A key or a string of a text.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) struct Word(Arc<str>);

impl Word {
    /// The word itself.
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
