//! Names of branches.

use std::{
    borrow::Cow,
    collections::{HashMap, HashSet},
    sync::Arc,
};

use dashpot_network::Element;
use dashpot_rheology::Branch;

use super::Done;
use crate::diagnostics::{Faults, fault::Fault};

/// The branches by the names that they are given, or else by their words, numbered from the second
/// one of a word on; `None` where one could not be read.
pub(super) fn named(
    branches: Vec<Done<'_>>,
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
