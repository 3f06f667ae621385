//! Tables with a model: the law, what stands beside it, and the models that it names.

use super::{
    Done, Entrance, Given, ModelReader, Open, Spot, Step,
    context::{Besides, Shift},
};
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Entry, Item},
        library::{Reference, Shelf},
        table::{check_name, entries_of, list_of, text_of},
    },
};

impl<'d> ModelReader<'d> {
    /// What follows from the table `spot`, with a model of `open` around it.
    pub(super) fn read(&self, spot: &Spot<'d>, open: &Open) -> Option<Step<'d>> {
        let entries = entries_of(spot.item, &spot.owner, self.faults)?;
        let law = self.law(spot, entries)?;
        let given = spot.other_keys.contains(&"name").then(|| self.given_name(entries)).flatten();
        let besides = Besides { library: self.library, faults: self.faults };
        let (context, shift) = besides.read(spot, entries, law);
        if let Some(Shift { word, factor }) = shift {
            let text = format!("`{word}` multiplies its times by {factor:.3e}");
            self.note(open, given, (text, None));
        }
        match law.key.as_str() {
            word @ ("series" | "parallel") => {
                let branches = list_of(&law.item, &format!("`{word}`"), self.faults)?;
                if branches.is_empty() {
                    self.faults.error(law.item.place, Fault::EmptyList { key: word.to_owned() });
                    return None;
                }
                Some(Step::Compose { series: word == "series", branches, context, given })
            }
            "model" if context.basis.is_material() => {
                self.faults.error(law.key_place, Fault::ModelInMaterial);
                None
            }
            word @ ("model" | "material") => {
                let shelf = if word == "model" { Shelf::Models } else { Shelf::Materials };
                let reference = self.reference(spot.document, shelf, &law.item, open)?;
                Some(Step::Enter(Entrance { reference, context, given }))
            }
            word => {
                let made = self.laws.read(spot.document, law, context);
                made.note.into_iter().for_each(|note| self.note(open, given, note));
                Some(Step::Done(Done { word, given, model: made.model, extent: made.extent }))
            }
        }
    }

    /// Notes something about the table that is being read.
    fn note(&self, open: &Open, given: Given<'d>, (text, until): (String, Option<f64>)) {
        let Some(outer) = &open.outer else { return };
        let inner = open.order.last().map_or_else(|| outer.clone(), |own| self.called(*own));
        let subject = match given {
            Some((name, _)) => format!("{inner}, branch `{name}`"),
            None => inner,
        };
        self.notes.add(subject, text, until);
    }

    /// The one entry that says what the model is.
    fn law(&self, spot: &Spot<'d>, entries: &'d [Entry]) -> Option<&'d Entry> {
        let is_law = |entry: &&Entry| self.words.contains(&entry.key.as_str());
        let mut strangers = entries
            .iter()
            .filter(|entry| !is_law(entry) && !spot.other_keys.contains(&entry.key.as_str()))
            .peekable();
        let has_strangers = strangers.peek().is_some();
        for stranger in strangers {
            let known = spot.other_keys.iter().chain(&self.words).copied().collect();
            let (key, owner) = (stranger.key.to_string(), spot.owner.to_string());
            self.faults.error(stranger.key_place, Fault::UnknownKey { key, owner, known });
        }
        let mut laws = entries.iter().filter(is_law);
        let first = laws.next();
        if first.is_none() && !has_strangers && !self.faults.damaged() {
            let fault = Fault::NoLaw { owner: spot.owner.to_string(), known: self.words.clone() };
            self.faults.error(spot.place, fault);
        }
        if let Some(second) = laws.next() {
            let words = entries.iter().filter(is_law).map(|entry| entry.key.to_string()).collect();
            let fault = Fault::SeveralLaws { owner: spot.owner.to_string(), words };
            self.faults.error(second.key_place, fault);
            return None;
        }
        first
    }

    fn given_name(&self, entries: &'d [Entry]) -> Given<'d> {
        let entry = entries.iter().find(|entry| entry.key == "name")?;
        let name = text_of(&entry.item, "`name`", self.faults)?;
        check_name(name, entry.item.place, self.faults);
        Some((name, entry.item.place))
    }

    fn reference(
        &self,
        document: usize,
        shelf: Shelf,
        item: &Item,
        open: &Open,
    ) -> Option<Reference> {
        let text = text_of(item, &format!("`{}`", shelf.word()), self.faults)?;
        let reference = match self.library.find(document, shelf, text) {
            Ok(found) => found?,
            Err(fault) => {
                if !self.faults.damaged() {
                    self.faults.error(item.place, fault);
                }
                return None;
            }
        };
        if !open.set.contains(&reference) {
            return Some(reference);
        }
        let from = open.order.iter().position(|&passed| passed == reference).unwrap_or(0);
        let circle = open.order[from..].iter().chain([&reference]);
        let names = circle.map(|&model| self.library.entry(model).key.to_string()).collect();
        self.faults.error(item.place, Fault::ModelInItself { family: shelf.word(), names });
        None
    }
}
