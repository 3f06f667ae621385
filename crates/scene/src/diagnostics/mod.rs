//! Faults at their places in the text, collected and reported together.

pub(crate) mod fault;
pub(crate) mod fault_help;
pub(crate) mod render;

use std::{
    cell::RefCell,
    collections::{HashMap, HashSet},
    ops::Range,
    sync::Arc,
};

use self::fault::Fault;
use crate::{
    quantities::bare::BareNumbers,
    text::source::{Place, SET, Source},
};

/// So many faults are kept; the others are counted.
const KEPT: usize = 100;

/// How bad a fault is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// The scene cannot be used.
    Error,
    /// The scene can be used; something in it is odd.
    Warning,
}

/// One fault and where it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong.
    pub fault: Fault,
    /// The text in which it is.
    pub source: Option<Arc<Source>>,
    /// The bytes of the text that it is about.
    pub span: Option<Range<usize>>,
}

impl Diagnostic {
    /// What is wrong, in one sentence.
    pub fn message(&self) -> String {
        self.fault.to_string()
    }

    /// What else there is to know.
    pub fn note(&self) -> Option<String> {
        self.fault.note()
    }

    /// How to put it right, where that can be said.
    pub fn help(&self) -> Option<String> {
        self.fault.help()
    }

    /// Name of the file.
    pub fn file(&self) -> Option<&str> {
        self.source.as_deref().map(|source| source.name.as_str())
    }

    /// Line and column, both from 1.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        let (source, span) = self.source.as_deref().zip(self.span.as_ref())?;
        Some(source.line_and_column(span.start))
    }
}

/// All that was found in one reading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Diagnostics {
    /// The faults in the order of the text, errors first.
    pub list: Vec<Diagnostic>,
    /// How many more there are that were not kept.
    pub omitted: usize,
}

impl Diagnostics {
    /// One fault without a place.
    pub(crate) fn single(fault: Fault, source: Option<Arc<Source>>) -> Self {
        let diagnostic = Diagnostic { severity: Severity::Error, fault, source, span: None };
        Self { list: vec![diagnostic], omitted: 0 }
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

/// A value and the warnings that came with it.
#[derive(Debug, Clone)]
pub struct Checked<T> {
    /// The value.
    pub value: T,
    /// What is odd about its text.
    pub warnings: Diagnostics,
}

/// Takes up faults while a text is read.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    state: RefCell<State>,
}

#[derive(Debug, Default)]
struct State {
    sources: Vec<Arc<Source>>,
    list: Vec<(Option<Place>, Diagnostic)>,
    seen: HashSet<(Option<Place>, String)>,
    omitted: usize,
    errors: usize,
    damaged: bool,
    bare: BareNumbers,
    /// Numbers without a unit by their places, and what is wrong with them.
    without_unit: HashMap<Place, Fault>,
}

impl Faults {
    /// Adds a text; places refer to it by the number returned.
    pub(crate) fn add_source(&self, source: Arc<Source>) -> u32 {
        let sources = &mut self.state.borrow_mut().sources;
        sources.push(source);
        u32::try_from(sources.len() - 1).unwrap_or(u32::MAX)
    }

    /// Notes an error. The same one at the same place counts once.
    pub(crate) fn error(&self, place: impl Into<Option<Place>>, fault: Fault) {
        self.note(Severity::Error, place.into(), fault);
    }

    /// Notes that something is missing or unknown, unless parts of the text could not be parsed: it may have
    /// been meant to be there.
    pub(crate) fn missing(&self, place: impl Into<Option<Place>>, fault: Fault) {
        if !self.damaged() {
            self.error(place, fault);
        }
    }

    pub(crate) fn warning(&self, place: impl Into<Option<Place>>, fault: Fault) {
        self.note(Severity::Warning, place.into(), fault);
    }

    /// None yet; `bare` says what becomes of numbers without a unit.
    pub(crate) fn with(bare: BareNumbers) -> Self {
        let own = Self::default();
        own.state.borrow_mut().bare = bare;
        own
    }

    /// From now on nothing is said of numbers without a unit but of what is odd.
    pub(crate) fn allow_bare(&self) {
        self.state.borrow_mut().bare = BareNumbers::Silent;
    }

    /// Notes a number without a unit where it is written, once; one that is odd is told of in any case, and in place of
    /// what else is said of it.
    pub(crate) fn bare(&self, place: Place, is_odd: bool, fault: impl FnOnce() -> Fault) {
        let is_silent = self.state.borrow().bare == BareNumbers::Silent;
        let is_known = self.state.borrow().without_unit.contains_key(&place);
        match (is_silent, is_odd) {
            (true, true) => self.warning(place, fault()),
            (true, false) => {}
            (false, false) if is_known => {}
            (false, _) => {
                let fault = fault();
                self.state.borrow_mut().without_unit.insert(place, fault);
            }
        }
    }

    /// Notes all numbers without a unit, where they are no errors only if there are no others: what is wrong comes first.
    pub(crate) fn tell_bare(&self) {
        let (is_refused, all) = {
            let mut state = self.state.borrow_mut();
            (state.bare == BareNumbers::Refused, std::mem::take(&mut state.without_unit))
        };
        let severity = if is_refused { Severity::Error } else { Severity::Warning };
        let mut all: Vec<(Place, Fault)> = all.into_iter().collect();
        all.retain(|_| is_refused || self.errors() == 0);
        all.sort_by_key(|own| (own.0.source, own.0.start));
        all.into_iter().for_each(|(place, fault)| self.note(severity, Some(place), fault));
    }

    /// Says that the text is not TOML throughout: what is missing may have been meant to be there.
    pub(crate) fn damage(&self) {
        self.state.borrow_mut().damaged = true;
    }

    /// Whether parts of the text could not be parsed.
    pub(crate) fn damaged(&self) -> bool {
        self.state.borrow().damaged
    }

    /// Number of errors so far.
    pub(crate) fn errors(&self) -> usize {
        self.state.borrow().errors
    }

    pub(crate) fn text(&self, place: Place) -> String {
        let state = self.state.borrow();
        let source = state.sources.get(place.source as usize);
        source
            .map_or_else(String::new, |source| source.text[source.clamp(&place.span())].to_owned())
    }

    /// The bytes `span` of the text that stands at `place`, in quotes or without; all of them where it is written
    /// with escapes.
    pub(crate) fn within(&self, place: Place, span: &Range<usize>) -> Place {
        let text = self.text(place);
        if text.contains('\\') {
            return place;
        }
        let quotes = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|own| text.starts_with(own));
        let start = place.start as usize + quotes.map_or(0, str::len);
        let end = place.end as usize;
        Place::new(place.source, &((start + span.start).min(end)..(start + span.end).min(end)))
    }

    /// Where a value comes from, in words.
    pub(crate) fn origin(&self, place: Place) -> String {
        let state = self.state.borrow();
        match state.sources.get(place.source as usize) {
            Some(source) if source.name == SET => format!("set by `{SET}`"),
            Some(source) => {
                let (line, _) = source.line_and_column(place.start as usize);
                format!("defined in line {line}")
            }
            None => String::new(),
        }
    }

    /// The line and file of a place, in words.
    pub(crate) fn whereabouts(&self, place: Place) -> String {
        let state = self.state.borrow();
        state.sources.get(place.source as usize).map_or_else(String::new, |source| {
            let (line, _) = source.line_and_column(place.start as usize);
            format!("line {line} of {}", source.name)
        })
    }

    /// All that was found, errors first, in the order of the text.
    pub(crate) fn finish(self) -> Diagnostics {
        let mut state = self.state.into_inner();
        state.list.sort_by_key(|(place, diagnostic)| {
            let at = place.map_or((u32::MAX, 0), |place| (place.source, place.start));
            (diagnostic.severity == Severity::Warning, at)
        });
        let list = state.list.into_iter().map(|(_, diagnostic)| diagnostic).collect();
        Diagnostics { list, omitted: state.omitted }
    }

    fn note(&self, severity: Severity, place: Option<Place>, fault: Fault) {
        let mut state = self.state.borrow_mut();
        state.errors += usize::from(severity == Severity::Error);
        if state.list.len() >= KEPT {
            state.omitted += 1;
            let is_odd = |own: &(Option<Place>, Diagnostic)| own.1.severity == Severity::Warning;
            match state.list.iter().rposition(is_odd) {
                // An error is not left out for something odd.
                Some(last) if severity == Severity::Error => drop(state.list.remove(last)),
                _ => return,
            }
        }
        if !state.seen.insert((place, fault.to_string())) {
            return;
        }
        // What has no place, such as a section that is missing, is about the text that is read.
        let number = place.map_or(0, |place| place.source as usize);
        let source = state.sources.get(number).cloned();
        let span = place.zip(source.as_deref()).map(|(place, source)| source.clamp(&place.span()));
        state.list.push((place, Diagnostic { severity, fault, source, span }));
    }
}
