//! Numbers with scatter in a document: their means stand for them from here on.

use super::{Content, Item, Word};
use crate::{
    diagnostics::{Faults, fault::Fault},
    quantities::scatter::{Scatter, ScatterFault},
    text::source::Place,
};

/// The tables whose numbers may vary.
pub(crate) const SECTIONS: [&str; 7] =
    ["values", "models", "materials", "nodes", "elements", "effects", "loads"];

/// Puts means in the place of numbers with scatter, and returns those with their places.
pub(super) fn take(root: &mut Item, faults: &Faults) -> Vec<(Place, Scatter)> {
    let mut found = Vec::new();
    let Content::Table(sections) = &mut root.value else { return found };
    for section in sections.iter_mut().filter(|own| own.key != "title") {
        let is_varied = SECTIONS.contains(&section.key.as_str());
        let before = found.len();
        take_in(&mut section.item, faults, &mut found);
        if !is_varied {
            for (place, _) in found.drain(before..) {
                let section = section.key.to_string();
                note(faults, place, ScatterFault::Elsewhere { section });
            }
        }
    }
    found
}

fn take_in(item: &mut Item, faults: &Faults, found: &mut Vec<(Place, Scatter)>) {
    match &mut item.value {
        Content::Text(text) => match Scatter::parse(text) {
            None => {}
            Some(Ok(scatter)) => {
                *text = Word::from(scatter.text.as_str());
                found.push((item.place, scatter));
            }
            Some(Err(fault)) => {
                // One fault is enough: a number is read in its place.
                if let Some(sign) = text.find(['±', '+']).filter(|at| *at > 0) {
                    let mean = text[..sign].trim().to_owned();
                    *text = Word::from(mean);
                }
                note(faults, item.place, fault);
            }
        },
        Content::List(items) => items.iter_mut().for_each(|own| take_in(own, faults, found)),
        Content::Table(entries) => {
            entries.iter_mut().for_each(|own| take_in(&mut own.item, faults, found));
        }
        Content::Number(_) | Content::Switch(_) | Content::Date => {}
    }
}

/// Notes what is wrong with a number with scatter.
pub(crate) fn note(faults: &Faults, place: Place, fault: ScatterFault) {
    faults.error(place, Fault::Scatter(fault));
}
