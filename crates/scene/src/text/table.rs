//! Tables whose keys are asked for by name; the ones that nobody asks for are errors.

use std::cell::RefCell;

use super::{
    document::{Content, Entry, Item},
    nearest::nearest,
    source::Place,
    visible::is_hidden,
};
use crate::diagnostics::{Faults, fault::Fault};

pub(crate) struct Table<'d> {
    /// What the table is, for messages: "node `head`".
    pub(crate) owner: String,
    /// Where its name stands.
    pub(crate) place: Place,
    entries: &'d [Entry],
    asked: RefCell<Vec<&'static str>>,
    missing: RefCell<Vec<(&'static str, String)>>,
    faults: &'d Faults,
}

impl<'d> Table<'d> {
    /// The table `item`, which is `owner` and whose name stands at `place`.
    pub(crate) fn new(
        item: &'d Item,
        owner: impl Into<String>,
        place: Place,
        faults: &'d Faults,
    ) -> Option<Self> {
        let owner = owner.into();
        let entries = entries_of(item, &owner, faults)?;
        Some(Self {
            owner,
            place,
            entries,
            asked: RefCell::default(),
            missing: RefCell::default(),
            faults,
        })
    }

    /// The entry of a key that may be left out.
    pub(crate) fn take(&self, key: &'static str) -> Option<&'d Entry> {
        self.asked.borrow_mut().push(key);
        self.entries.iter().find(|entry| entry.key == key)
    }

    /// The entry of a key that is required; `example` shows how it is written.
    pub(crate) fn require(&self, key: &'static str, example: &str) -> Option<&'d Entry> {
        self.require_with(key, || example.to_owned())
    }

    /// The same, where the example is made.
    pub(crate) fn require_with(
        &self,
        key: &'static str,
        example: impl FnOnce() -> String,
    ) -> Option<&'d Entry> {
        let entry = self.take(key);
        if entry.is_none() {
            self.missing.borrow_mut().push((key, example()));
        }
        entry
    }

    /// Notes every required key that is missing, and every key that nobody asked for.
    pub(crate) fn finish(&self) {
        let asked = self.asked.borrow();
        self.finish_missing();
        for entry in self.strangers() {
            self.faults.error(entry.key_place, unknown_key(entry, &self.owner, asked.clone()));
        }
    }

    /// Notes every required key that is missing; others look at the keys that nobody asked for.
    ///
    /// A key that is misspelt is not missing.
    pub(crate) fn finish_missing(&self) {
        if self.faults.damaged() {
            return;
        }
        let asked = self.asked.borrow();
        let meant = self.strangers().filter_map(|entry| nearest(&entry.key, asked.iter().copied()));
        let meant = meant.collect::<Vec<_>>();
        for (key, example) in self.missing.borrow().iter() {
            if !meant.contains(key) {
                let (key, owner) = ((*key).to_owned(), self.owner.clone());
                let fault = Fault::MissingKey { key, owner, example: example.clone() };
                self.faults.error(self.place, fault);
            }
        }
    }

    fn strangers(&self) -> impl Iterator<Item = &'d Entry> {
        let asked = self.asked.borrow().clone();
        self.entries.iter().filter(move |entry| !asked.contains(&entry.key.as_str()))
    }
}

/// What is wrong with an entry of `owner` whose key is none of those that are `known`.
pub(crate) fn unknown_key(entry: &Entry, owner: &str, known: Vec<&'static str>) -> Fault {
    Fault::UnknownKey { key: entry.key.to_string(), owner: owner.to_owned(), known }
}

/// The entries of `item`, which is `owner`; an error where it is not a table.
pub(crate) fn entries_of<'d>(item: &'d Item, owner: &str, faults: &Faults) -> Option<&'d [Entry]> {
    let entries = item.table();
    if entries.is_none() {
        wrong_type(item, owner, "a table", faults);
    }
    entries
}

/// The text of `item`, which is `what`; an error where it is not a text.
pub(crate) fn text_of<'d>(item: &'d Item, what: &str, faults: &Faults) -> Option<&'d str> {
    let text = item.text();
    if text.is_none() {
        wrong_type(item, what, "a text in quotes", faults);
    }
    text
}

/// The entries of a list; an error where it is not a list.
pub(crate) fn list_of<'d>(item: &'d Item, what: &str, faults: &Faults) -> Option<&'d [Item]> {
    if let Content::List(items) = &item.value {
        return Some(items);
    }
    wrong_type(item, what, "a list", faults);
    None
}

/// One entry, or a list of them.
pub(crate) fn one_or_many(item: &Item) -> &[Item] {
    if let Content::List(items) = &item.value { items } else { std::slice::from_ref(item) }
}

/// Notes that `item`, which is `what`, should be `expected`.
pub(crate) fn wrong_type(item: &Item, what: &str, expected: &str, faults: &Faults) {
    let (what, expected) = (what.to_owned(), expected.to_owned());
    faults.error(item.place, Fault::WrongType { what, expected, found: item.type_name() });
}

/// Notes a name that cannot stand in paths such as `padding.peak-force`.
pub(crate) fn check_name(name: &str, place: Place, faults: &Faults) {
    let reason = if name.is_empty() {
        "it is empty"
    } else if name.contains(['.', ':']) {
        "`.` and `:` separate names"
    } else if name.contains(|own: char| own.is_control() || is_hidden(own)) || name.trim() != name {
        "it has characters that are not to be seen, or spaces at an end"
    } else {
        return;
    };
    faults.error(place, Fault::BadName { name: name.to_owned(), reason });
}
