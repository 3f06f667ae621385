//! Texts that were read, and places in them.

use std::{ops::Range, sync::Arc};

/// Name of the texts that set values from outside.
pub(crate) const SET: &str = "--set";

/// What is set from outside, a name and a value, as a text of its own.
pub(crate) fn set_source((name, value): &(String, String)) -> Arc<Source> {
    Arc::new(Source::new(SET, format!("{name}={value}")))
}

/// A text and what to call it in messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Path or other name.
    pub name: String,
    /// The whole text.
    pub text: Arc<str>,
}

impl Source {
    /// A text of the given name.
    pub fn new(name: impl Into<String>, text: impl Into<Arc<str>>) -> Self {
        Self { name: name.into(), text: text.into() }
    }

    /// Line and column of the byte at `at`, both from 1; columns count characters.
    pub fn line_and_column(&self, at: usize) -> (usize, usize) {
        let start = self.line_start(at);
        let line = self.text[..start].split('\n').count();
        let before = self.text.get(start..self.boundary(at)).unwrap_or_default();
        (line, 1 + before.trim_start_matches('\u{feff}').chars().count())
    }

    /// The lines that `span` touches, at most `limit` of them: their bytes in the text.
    pub(crate) fn lines(&self, span: &Range<usize>, limit: usize) -> Range<usize> {
        let start = self.line_start(span.start);
        let mut end = start;
        for line in self.text[start..].split_inclusive('\n').take(limit.max(1)) {
            end += line.len();
            if end >= span.end {
                break;
            }
        }
        start..end
    }

    /// `span` moved onto borders of characters within the text.
    pub(crate) fn clamp(&self, span: &Range<usize>) -> Range<usize> {
        let start = self.boundary(span.start);
        start..self.boundary(span.end).max(start)
    }

    fn line_start(&self, at: usize) -> usize {
        let at = self.boundary(at);
        self.text[..at].rfind('\n').map_or(0, |newline| newline + 1)
    }

    fn boundary(&self, at: usize) -> usize {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

/// A range of bytes in one of the sources of a reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Place {
    pub(crate) source: u32,
    pub(crate) start: u32,
    /// Byte after the last one.
    pub(crate) end: u32,
}

impl Place {
    /// The bytes of `span` in source number `source`. Texts are smaller than 4 GB.
    pub(crate) fn new(source: u32, span: &Range<usize>) -> Self {
        let byte = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        Self { source, start: byte(span.start), end: byte(span.end) }
    }

    pub(crate) fn span(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters() {
        let source = Source::new("a", "x = 1\nµ = \"é\"\n");
        assert_eq!(source.line_and_column(0), (1, 1));
        assert_eq!(source.line_and_column(6), (2, 1));
        assert_eq!(source.line_and_column(11), (2, 5));
        assert_eq!(source.line_and_column(7), (2, 1));
        assert_eq!(source.line_and_column(999), (3, 1));
    }

    #[test]
    fn lines_hold_the_span_and_are_limited() {
        let source = Source::new("a", "one\ntwo\nthree\nfour\n");
        assert_eq!(source.lines(&(5..6), 3), 4..8);
        assert_eq!(source.lines(&(5..10), 3), 4..14);
        assert_eq!(source.lines(&(0..19), 2), 0..8);
    }
}
