//! Branches and their names.

use std::{
    borrow::Cow,
    collections::{HashMap, HashSet},
    sync::Arc,
};

use dashpot_network::{Element, Model};
use dashpot_rheology::Branch;

use crate::{
    diagnostics::{Faults, fault::Fault},
    quantities::pad::Extent,
    text::source::Place,
};

/// The name that a branch is given, and its place.
pub(super) type Given<'d> = Option<(&'d str, Place)>;

/// A model that has been read, or could not be, with the name of its branch.
pub(super) struct ReadBranch<'d> {
    /// By which it is called where it is given no name.
    pub(super) word: &'d str,
    pub(super) given: Given<'d>,
    pub(super) model: Option<Model>,
    /// The size of the pad that it is.
    pub(super) extent: Extent,
}

impl ReadBranch<'_> {
    /// One in which something is wrong.
    pub(super) const FAILED: Self =
        Self { word: "model", given: None, model: None, extent: Extent::UNKNOWN };
}

/// The branches by the names that they are given, or else by their words, numbered from the second
/// one of a word on; `None` where one could not be read.
pub(super) fn named(
    branches: Vec<ReadBranch<'_>>,
    faults: &Faults,
) -> Option<Vec<Branch<Arc<dyn Element>>>> {
    let mut taken = HashSet::new();
    for (name, place) in branches.iter().filter_map(|branch| branch.given) {
        if !taken.insert(Cow::Borrowed(name)) {
            faults.error(place, Fault::DuplicateKey { key: name.to_owned() });
        }
    }
    let mut counts: HashMap<&str, usize> = HashMap::new();
    let mut named = Vec::with_capacity(branches.len());
    let mut complete = true;
    for branch in branches {
        let name = if let Some((name, _)) = branch.given {
            name.to_owned()
        } else {
            let count = counts.entry(branch.word).or_default();
            loop {
                *count += 1;
                let name = match *count {
                    1 => branch.word.to_owned(),
                    count => format!("{}-{count}", branch.word),
                };
                if taken.insert(Cow::Owned(name.clone())) {
                    break name;
                }
            }
        };
        match branch.model {
            Some(model) => named.push(Branch::new(name, model)),
            None => complete = false,
        }
    }
    complete.then_some(named)
}
