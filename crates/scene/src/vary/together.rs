//! Numbers that scatter together, such as those of one fit: `[scatter]`.

use std::sync::Arc;

use dashpot_network::parameters::Dimension;
use dashpot_units::{Quantity, parse_quantity};

use super::tunable::Tunables;
use crate::{
    diagnostics::{Faults, fault::Fault},
    text::{
        document::{Content, Entry, Item, parse},
        source::{Place, Source},
        table::unknown_key,
    },
};

/// The section, and its only key.
pub(crate) const SECTION: &str = "scatter";
pub(crate) const KEY: &str = "together";
const HELP: &str = "write `together = [{ \"foam.modulus\" = \"4 %\", \"foam.plateau\" = \"-2 %\" }]`: what one standard \
                    deviation of each cause adds to each number";
const ALONE: &str = "a number that scatters alone has it behind `±`: \"20 ± 2 MN/m\"";
/// Shares beyond this are no scatter any more.
const MOST: f64 = 1.0;

/// One of the independent things that numbers scatter by.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cause {
    /// Numbers by their positions, and what one standard deviation of the cause adds to the logarithm of each.
    pub(crate) shares: Vec<(usize, f64)>,
}

/// Whether a text may have the section.
pub(crate) fn is_possible(text: &str) -> bool {
    text.contains(SECTION)
}

/// The causes of a text that is known to be without faults.
pub(crate) fn causes(text: &str, tunables: &Tunables) -> Vec<Cause> {
    if !is_possible(text) {
        return Vec::new();
    }
    read(&Arc::new(Source::new("scene", text)), tunables, &Faults::default())
}

/// Notes what is wrong with the section.
pub(crate) fn check(source: &Arc<Source>, faults: &Faults) {
    if !is_possible(&source.text) {
        return;
    }
    if let Ok(tunables) = Tunables::of(&source.text, None) {
        read(source, &tunables, faults);
    }
}

fn read(source: &Arc<Source>, tunables: &Tunables, faults: &Faults) -> Vec<Cause> {
    let Some(root) = parse(source, faults) else { return Vec::new() };
    let section = root.table().unwrap_or(&[]).iter().find(|own| own.key == SECTION);
    let Some(section) = section else { return Vec::new() };
    let Some(entries) = section.item.table() else {
        no_table(&section.item, "`[scatter]`", "a table", faults);
        return Vec::new();
    };
    let mut all = Vec::new();
    for entry in entries {
        match &entry.item.value {
            Content::List(causes) if entry.key == KEY => {
                all.extend(causes.iter().filter_map(|own| cause(own, tunables, faults)));
            }
            _ if entry.key == KEY => {
                no_table(&entry.item, "`together`", "a list of tables", faults);
            }
            _ => {
                let unknown = unknown_key(entry, "`[scatter]`", vec![KEY]);
                faults.error(entry.key_place, unknown.with_help(format!("{HELP}; {ALONE}")));
            }
        }
    }
    all
}

fn no_table(item: &Item, what: &str, expected: &str, faults: &Faults) {
    let (what, expected) = (what.to_owned(), expected.to_owned());
    let fault = Fault::WrongType { what, expected, found: item.type_name() };
    faults.error(item.place, fault.with_help(HELP));
}

fn cause(item: &Item, tunables: &Tunables, faults: &Faults) -> Option<Cause> {
    let mut shares = Vec::new();
    let Some(entries) = item.table() else {
        no_table(item, "what scatters together", "a table", faults);
        return None;
    };
    collect(entries, "", &mut |name, item, place| match number(name, item, tunables) {
        Ok((at, _)) if shares.iter().any(|own: &(usize, f64)| own.0 == at) => {
            faults.error(place, Fault::odd(format!("`{name}` stands here twice"), HELP));
        }
        Ok(own) => shares.push(own),
        Err((message, help)) => faults.error(place, Fault::odd(message, help)),
    });
    Some(Cause { shares })
}

/// Names with points may be written without quotes: then they are tables within tables.
fn collect(entries: &[Entry], before: &str, found: &mut dyn FnMut(&str, &Item, Place)) {
    for entry in entries {
        let name = format!("{before}{}", entry.key);
        match entry.item.table() {
            Some(inner) => collect(inner, &format!("{name}."), found),
            None => found(&name, &entry.item, entry.key_place),
        }
    }
}

/// The number of this name and its share, or what is wrong and what to do.
fn number(name: &str, item: &Item, tunables: &Tunables) -> Result<(usize, f64), (String, String)> {
    let at = tunables.find(name);
    let at =
        at.map_err(|fault| (fault.to_string(), fault.help().unwrap_or_else(|| HELP.to_owned())))?;
    let own = &tunables.all()[at];
    if own.scatter.is_some() {
        let help = "leave the scatter behind `±` out, or the number here".to_owned();
        return Err((format!("`{name}` has scatter of its own"), help));
    }
    if own.value == 0.0 || !own.value.is_finite() || own.unit.ends_with("°C") {
        let help = "what scatters together is a part of each number: give it its own scatter, \"20 ± 2 °C\"";
        return Err((format!("`{name}` has no parts"), help.to_owned()));
    }
    let share = match &item.value {
        Content::Text(own) | Content::Number(own) => parse_quantity(own).ok(),
        _ => None,
    };
    let is_part = |own: &Quantity| own.dimension.is_none_or(|own| own == Dimension::NUMBER);
    let share = share.filter(is_part).map(|own| own.value);
    match share.filter(|own| own.is_finite() && own.abs() <= MOST) {
        Some(share) => Ok((at, share)),
        None => {
            Err((format!("`{name}` wants a part of itself, from −100 to 100 %"), HELP.to_owned()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_list_of_causes_is_told_with_an_example() {
        let scene = |section: &str| format!("[values]\nK = \"5 N/m\"\n{section}\n");
        for section in [
            "scatter = 5",
            "[scatter]\nK = \"10 %\"",
            "[scatter]\ntogether = { K = \"10 %\" }",
            "[scatter]\ntogether = [\"K\"]",
        ] {
            let section =
                if section.starts_with('[') { scene(section) } else { section.to_owned() };
            let faults = Faults::default();
            check(&Arc::new(Source::new("scene", section.clone())), &faults);
            let all = faults.finish().list;
            assert!(!all.is_empty(), "{section}");
            for own in all {
                assert!(own.help().is_some_and(|own| own.contains("together = [{")), "{section}");
            }
        }
    }
}
