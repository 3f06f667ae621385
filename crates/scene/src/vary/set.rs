//! Numbers and words of a text that are set from outside, by their paths.

use std::borrow::Cow;

use super::{
    together,
    tunable::{TunableFault, Tunables},
};
use crate::{
    diagnostics::Faults,
    quantities::{bare::BareNumber, scatter::Scatter},
    text::{document::parse, source::Source},
};

/// What is set, a name or path and its text each.
type Set = [(String, String)];

/// What is set, by where it belongs.
#[derive(Debug, Default)]
pub(crate) struct Settled {
    /// Numbers and words of the text, and what stands in their places.
    pub(crate) changes: Vec<(usize, String)>,
    /// Names under `[values]`.
    pub(crate) named: Vec<(String, String)>,
    /// What leads to nothing, as it was set, and why.
    pub(crate) astray: Vec<((String, String), TunableFault)>,
}

impl Settled {
    /// Sets numbers and words in the text: `head.mass`, `liner.material`. A name under `[values]` is no
    /// path, and neither is one without a point that nothing in the text has.
    pub(crate) fn in_text<'t>(text: &'t str, set: &Set) -> (Cow<'t, str>, Self) {
        let own = || Self { named: set.to_vec(), ..Self::default() };
        // Whether names under [values] are set without a unit is looked at where these are read.
        if set.is_empty() || !has_scatter(text, set) && all_are_named(text, set) {
            return (Cow::Borrowed(text), own());
        }
        // What is wrong with the text is told where it is read.
        let Ok(tunables) = Tunables::of(text, None) else { return (Cow::Borrowed(text), own()) };
        let own = Self::of(&tunables, text, set);
        if own.changes.is_empty() {
            return (Cow::Borrowed(text), own);
        }
        (Cow::Owned(tunables.text_with(&own.changes)), own)
    }

    /// Finds where it belongs in a scene of this text.
    pub(crate) fn of(tunables: &Tunables, text: &str, set: &Set) -> Self {
        let mut own = Self::default();
        if set.is_empty() {
            return own;
        }
        let has_scatter = has_scatter(text, set);
        for (name, value) in set {
            let given = || (name.clone(), value.clone());
            match tunables.anything(name) {
                Ok(at) => {
                    if let Some(bare) = BareNumber::of_set(name, value, tunables.written(at)) {
                        own.astray.push((given(), TunableFault::NoUnit(bare)));
                        continue;
                    }
                    let is_value = tunables.all()[at].path == format!("values.{name}");
                    if !is_value || has_scatter {
                        // The last one counts.
                        own.changes.retain(|known| known.0 != at);
                        own.changes.push((at, value.trim().to_owned()));
                    }
                    // Values of other files go by the name, too.
                    if is_value && !(has_scatter && Scatter::is_possible(value)) {
                        own.named.push(given());
                    }
                }
                Err(fault) if name.contains('.') => own.astray.push((given(), fault)),
                Err(_) => own.named.push(given()),
            }
        }
        own
    }
}

fn has_scatter(text: &str, set: &Set) -> bool {
    Scatter::is_possible(text)
        || together::is_possible(text)
        || set.iter().any(|own| Scatter::is_possible(&own.1))
}

/// Whether all of `set` are names under `[values]`.
fn all_are_named(text: &str, set: &Set) -> bool {
    let root = parse(&Source::new("", text).into(), &Faults::default());
    let sections = root.as_ref().and_then(|root| root.table()).unwrap_or(&[]);
    let values = sections.iter().find(|own| own.key == "values");
    let known = values.and_then(|own| own.item.table()).unwrap_or(&[]);
    set.iter().all(|(name, _)| known.iter().any(|own| own.key == name.as_str()))
}
