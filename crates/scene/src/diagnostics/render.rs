//! Diagnostics as text for a terminal.

use std::{fmt, ops::Range, ptr};

use annotate_snippets::{
    AnnotationKind, Group, Level, Renderer, Snippet, renderer::DEFAULT_TERM_WIDTH,
};

use super::{Diagnostic, Diagnostics, Severity};
use crate::text::{
    source::Source,
    visible::{is_control, visible},
};

/// So many faults of one kind are shown …
const SHOWN: usize = 3;
/// … and so many lines named in which there are others.
const NAMED: usize = 8;
/// So many lines of the text are shown for one fault.
const LINES: usize = 3;

/// Longer lines are cut around the place, in bytes.
const LONG_LINE: usize = 400;

impl Diagnostics {
    /// The text for a terminal: message, place, the value under a caret and help for each fault.
    pub fn render(&self, color: bool) -> String {
        self.render_within(color, usize::MAX)
    }

    /// The same in `width` columns: messages, notes and help are wrapped, and long lines of the text are cut around
    /// what is at fault. Of many faults of one kind in a file the first ones are shown, and where the others are.
    pub fn render_within(&self, color: bool, width: usize) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let renderer = renderer.term_width(width.min(DEFAULT_TERM_WIDTH));
        let kinds = self.by_kind();
        let mut shown: Vec<String> = Vec::new();
        let mut of_kind = vec![0; kinds.len()];
        for own in &self.list {
            let is_it = |kind: &Vec<&Diagnostic>| kind.iter().any(|other| ptr::eq(*other, own));
            let Some(kind) = kinds.iter().position(is_it) else { continue };
            of_kind[kind] += 1;
            let others = kinds[kind].split_at_checked(SHOWN).map_or(&[][..], |own| own.1);
            let is_told = others.len() > 1;
            if of_kind[kind] <= SHOWN || !is_told {
                shown.push(one(&renderer, own, width));
            }
            shown.extend((of_kind[kind] == SHOWN && is_told).then(|| likewise(others)));
        }
        shown.extend((self.omitted > 0).then(|| format!("and {} more", self.omitted)));
        shown.join("\n\n")
    }

    /// Faults of one kind in one file together, each in the order of the text.
    fn by_kind(&self) -> Vec<Vec<&Diagnostic>> {
        let mut kinds: Vec<Vec<&Diagnostic>> = Vec::new();
        for own in &self.list {
            let is_like = |known: &&mut Vec<&Diagnostic>| {
                let first = known[0];
                first.severity == own.severity
                    && first.file() == own.file()
                    && first.fault.is_like(&own.fault)
            };
            match kinds.iter_mut().find(is_like) {
                Some(kind) => kind.push(own),
                None => kinds.push(vec![own]),
            }
        }
        kinds
    }
}

/// How many more faults of a kind there are, and where the first of them stand.
fn likewise(others: &[&Diagnostic]) -> String {
    let lines = others.iter().filter_map(|own| own.line_and_column());
    let mut lines: Vec<usize> = lines.map(|own| own.0).collect();
    lines.dedup();
    let named: Vec<String> = lines.iter().take(NAMED).map(usize::to_string).collect();
    let word = match others[0].severity {
        Severity::Error => "errors",
        Severity::Warning => "warnings",
    };
    let end = match lines.len().saturating_sub(NAMED) {
        0 if lines.is_empty() => String::new(),
        0 => format!(", in lines {}", named.join(", ")),
        more => format!(", in lines {} and {more} more", named.join(", ")),
    };
    format!("and {} {word} of the same kind{end}", others.len())
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.render(false))
    }
}

impl std::error::Error for Diagnostics {}

fn one(renderer: &Renderer, diagnostic: &Diagnostic, width: usize) -> String {
    let inner = width.saturating_sub(INNER_LEAD);
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(wrapped(&diagnostic.message(), width.saturating_sub(LEAD)));
    let mut group = match (&diagnostic.source, &diagnostic.span) {
        (Some(source), Some(span)) => title.element(snippet(source, span, diagnostic, width)),
        (Some(source), None) => {
            title.element(annotate_snippets::Origin::path(visible(&source.name)))
        }
        _ => Group::with_title(title),
    };
    if let Some(note) = diagnostic.note() {
        group = group.element(Level::NOTE.message(wrapped(&note, inner)));
    }
    if let Some(help) = diagnostic.help() {
        group = group.element(Level::HELP.message(wrapped(&help, inner)));
    }
    // Where no line has a number, the name of the file stands where it would with one.
    let renderer = renderer.clone().anonymized_snippet_line_numbers(diagnostic.span.is_none());
    renderer.render(&[group])
}

const LEAD: usize = "warning: ".len();
/// Columns before its help or a note, in texts of up to 999 lines.
const INNER_LEAD: usize = "    = help: ".len();

/// The text in lines of at most `room` columns.
fn wrapped(text: &str, room: usize) -> String {
    let text = &*visible(text);
    let (mut shown, mut columns) = (String::with_capacity(text.len()), 0);
    for word in text.split(' ') {
        let own = word.chars().count();
        if columns > 0 && columns + 1 + own > room {
            shown.push('\n');
            columns = 0;
        } else if !shown.is_empty() {
            shown.push(' ');
            columns += 1;
        }
        shown.push_str(word);
        columns += own;
    }
    shown
}

fn snippet<'a>(
    source: &'a Source,
    span: &Range<usize>,
    diagnostic: &Diagnostic,
    width: usize,
) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
    let lines = excerpt(source, span);
    let first_line = source.line_and_column(lines.start).0;
    let start = span.start.clamp(lines.start, lines.end);
    let end = span.end.clamp(start, lines.end);
    let end = start + marked(&source.text[start..end], width.saturating_sub(MARGIN)).len();
    let span = start - lines.start..end - lines.start;
    let annotation = AnnotationKind::Primary.span(span).label(diagnostic.fault.label());
    let text = stood_in(&source.text[lines]);
    Snippet::source(text).line_start(first_line).path(visible(&source.name)).annotation(annotation)
}

/// The text with others for characters that are not to be seen, of as many bytes, so that places stay.
/// The renderer shows control characters of one byte.
fn stood_in(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for own in text.chars() {
        match own.len_utf8() {
            2 if is_control(own) => shown.push('\u{b7}'),
            3 if is_control(own) => shown.push('\u{fffd}'),
            4 if is_control(own) => shown.push_str("\u{b7}\u{b7}"),
            _ => shown.push(own),
        }
    }
    shown
}

/// Columns beside a mark: the number of the line, and what shows that the line goes on.
const MARGIN: usize = 20;

/// So much of the text of a place that its line can be cut around the mark under it.
fn marked(text: &str, room: usize) -> &str {
    let end = text.char_indices().nth(room).map(|char_index| char_index.0);
    end.filter(|_| !text.contains('\n')).map_or(text, |end| &text[..end])
}

/// The lines to show: few, and cut where they are very long.
fn excerpt(source: &Source, span: &Range<usize>) -> Range<usize> {
    let mut lines = source.lines(span, LINES);
    if source.text[lines.clone()].starts_with('\u{feff}') {
        lines.start += '\u{feff}'.len_utf8();
    }
    if lines.len() <= LONG_LINE {
        return lines;
    }
    let start = span.start.saturating_sub(LONG_LINE / 2).max(lines.start);
    let end = (span.start + LONG_LINE / 2).min(lines.end);
    source.clamp(&(start..end))
}
