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

/// A text with what is set in it.
pub(crate) struct Settled<'t> {
    /// With what was set by a path.
    pub(crate) text: Cow<'t, str>,
    /// The rest of what was set: names under `[values]`.
    pub(crate) named: Vec<(String, String)>,
    /// What leads to nothing, as it was set, and why.
    pub(crate) astray: Vec<((String, String), TunableFault)>,
}

impl<'t> Settled<'t> {
    /// Sets numbers and words in the text: `head.mass`, `liner.material`. A name under `[values]` is no
    /// path, and neither is one without a point that nothing in the text has.
    pub(crate) fn new(text: &'t str, set: &[(String, String)]) -> Self {
        let text = Cow::Borrowed(text);
        let mut own = Self { text, named: set.to_vec(), astray: Vec::new() };
        let is_scattered = |text: &str| Scatter::is_possible(text);
        let has_scatter = is_scattered(&own.text)
            || together::is_possible(&own.text)
            || set.iter().any(|own| is_scattered(&own.1));
        // Whether names under [values] are set without a unit is looked at where these are read.
        if set.is_empty() || !has_scatter && all_are_named(&own.text, set) {
            return own;
        }
        // What is wrong with the text is told where it is read.
        let Ok(tunables) = Tunables::of(&own.text, None) else { return own };
        let mut changes: Vec<(usize, String)> = Vec::new();
        own.named.retain(|(name, value)| {
            match tunables.anything(name) {
                Ok(at) => {
                    if let Some(bare) = BareNumber::of_set(name, value, tunables.written(at)) {
                        let fault = TunableFault::NoUnit(bare);
                        own.astray.push(((name.clone(), value.clone()), fault));
                        return false;
                    }
                    let is_value = tunables.all()[at].path == format!("values.{name}");
                    if is_value && !has_scatter {
                        return true;
                    }
                    // The last one counts.
                    changes.retain(|known| known.0 != at);
                    changes.push((at, value.trim().to_owned()));
                    // Values of other files go by the name, too.
                    return is_value && !is_scattered(value);
                }
                Err(fault) if name.contains('.') => {
                    own.astray.push(((name.clone(), value.clone()), fault));
                }
                Err(_) => return true,
            }
            false
        });
        if !changes.is_empty() {
            own.text = Cow::Owned(tunables.text_with(&changes));
        }
        own
    }
}

/// Whether all of `set` are names under `[values]`.
fn all_are_named(text: &str, set: &[(String, String)]) -> bool {
    let root = parse(&Source::new("", text).into(), &Faults::default());
    let sections = root.as_ref().and_then(|root| root.table()).unwrap_or(&[]);
    let values = sections.iter().find(|own| own.key == "values");
    let known = values.and_then(|own| own.item.table()).unwrap_or(&[]);
    set.iter().all(|(name, _)| known.iter().any(|own| own.key == name.as_str()))
}
