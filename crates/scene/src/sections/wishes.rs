//! Sections such as `[fit]` and `[design]`: what a scene asks of a verb, by the names of the command's options.

use std::sync::Arc;

use crate::{
    diagnostics::{Diagnostics, Faults, fault::Fault},
    text::{
        document::{Content, Item, parse},
        source::Source,
    },
};

/// The verbs that have a section, each with what it does in a few words.
pub const WISHING: [(&str, &str); 2] = [("fit", "a fit"), ("design", "a design")];

/// An option that a scene sets.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wish {
    /// Its name, without dashes.
    pub key: String,
    /// Its values as the command line would have them; one but for what may be repeated, and none for what is not
    /// wished.
    pub values: Vec<String>,
    /// Whether it is only on or off: `true`, `false`.
    pub is_switch: bool,
    /// The line of the text on which it stands, from 1.
    pub line: usize,
}

/// What the section of a verb, such as `[fit]`, sets in a scene; nothing where there is none. Which names there are is not
/// looked at.
///
/// # Examples
///
/// ```
/// use dashpot_scene::wishes;
///
/// let text = "[fit]\nto = [\"a.csv:F=pad.force\", \"b.csv:F=pad.force\"]\ncfc = 180\nprofile = true\n";
/// let own = wishes("fit", text, None)?;
/// assert_eq!((own[0].key.as_str(), own[0].values.len(), own[0].line), ("to", 2, 2));
/// assert_eq!((own[1].values[0].as_str(), own[2].is_switch), ("180", true));
/// # Ok::<(), dashpot_scene::Diagnostics>(())
/// ```
///
/// # Errors
///
/// A text that is no TOML, and values that are neither texts, numbers, switches nor lists of texts.
pub fn wishes(verb: &str, text: &str, file: Option<&str>) -> Result<Vec<Wish>, Diagnostics> {
    let faults = Faults::default();
    let source = Arc::new(Source::new(file.unwrap_or("scene"), text));
    let root = parse(&source, &faults);
    let Some(root) = root.filter(|_| faults.errors() == 0) else { return Err(faults.finish()) };
    let sections = root.table().unwrap_or(&[]);
    let Some(section) = sections.iter().find(|own| own.key == verb) else { return Ok(Vec::new()) };
    let Some(entries) = section.item.table() else {
        faults.error(
            section.key_place,
            Fault::odd(format!("`{verb}` is a table"), format!("write `[{verb}]`")),
        );
        return Err(faults.finish());
    };
    let what = WISHING.iter().find(|own| own.0 == verb).map_or(verb, |own| own.1);
    let mut wishes = Vec::new();
    for entry in entries {
        let Some((values, is_switch)) = values(&entry.item) else {
            let message = format!("`{}` is no option of {what}", entry.key);
            let help = "write texts, numbers, true or false, or lists of texts";
            faults.error(entry.item.place, Fault::odd(message, help));
            continue;
        };
        let line = 1 + text[..entry.key_place.span().start].matches('\n').count();
        wishes.push(Wish { key: entry.key.to_string(), values, is_switch, line });
    }
    if faults.errors() == 0 { Ok(wishes) } else { Err(faults.finish()) }
}

/// The values of an option, and whether it is a switch.
fn values(item: &Item) -> Option<(Vec<String>, bool)> {
    match &item.value {
        Content::Switch(is_on) => {
            Some((if *is_on { vec!["on".to_owned()] } else { Vec::new() }, true))
        }
        Content::List(items) => {
            let all: Option<Vec<String>> = items.iter().map(one).collect();
            all.map(|own| (own, false))
        }
        _ => one(item).map(|own| (vec![own], false)),
    }
}

fn one(item: &Item) -> Option<String> {
    match &item.value {
        Content::Text(own) | Content::Number(own) => Some(own.to_string()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_option_is_told_with_its_line() {
        assert_eq!(wishes("fit", "[run]\nduration = 1\n", None).unwrap(), []);
        let fault = |text: &str| wishes("fit", text, None).unwrap_err().render(false);
        assert!(fault("[fit]\nto = { a = 1 }\n").contains("`to` is no option of a fit"));
        assert!(fault("fit = 1\n").contains("`fit` is a table"));
        assert!(fault("[fit\n").contains('1'));
    }
}
