//! Tables with a model: the law, what stands beside it, the models that it names, and the names of branches.

use std::{
    borrow::Cow,
    collections::{HashMap, HashSet},
    sync::Arc,
};

use dashpot_network::{Element, Model, elements::ELEMENTS, parameters::registered};
use dashpot_rheology::Branch;

use super::{
    Descent, ModelReader,
    context::{Context, ContextReader, Shift, Site},
    notes::Remark,
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::has_model,
    quantities::sizes::Extent,
    text::{
        document::{Entry, Item},
        library::models::{ModelSection, Reference},
        source::Place,
        table::{check_name, entries_of, list_of, text_of, unknown_key},
    },
};

/// The law in a table, what becomes of its values, and the name of the branch that it is.
pub(super) struct Law<'d> {
    pub(super) entry: &'d Entry,
    pub(super) context: Context,
    /// The shift that stands beside it, and where.
    pub(super) shift: Option<(&'static str, Place)>,
    given: Given<'d>,
}

impl<'d> ModelReader<'d> {
    /// The law in the table `site`.
    pub(super) fn law(&self, site: &Site<'d>, descent: &Descent) -> Option<Law<'d>> {
        let entries = entries_of(site.item, &site.owner, self.faults)?;
        let entry = self.law_among(site, entries)?;
        let given = site.other_keys.contains(&"name").then(|| self.given_name(entries)).flatten();
        let reader = ContextReader { library: self.library, faults: self.faults };
        let (context, shift) = reader.read(site, entries, entry);
        let place = || entries.iter().find(|own| own.key == "shift").map(|own| own.key_place);
        let at = shift.as_ref().and_then(|own| Some((own.word, place()?)));
        if let Some(Shift { word, factor }) = shift {
            self.note(descent, given, (Remark::Shift { word, factor }, None));
        }
        Some(Law { entry, context, shift: at, given })
    }

    /// The model that a law stands for; `None` as by [`read`](Self::read).
    pub(super) fn of_law(
        &self,
        site: &Site<'d>,
        Law { entry, context, given, .. }: Law<'d>,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        match entry.key.as_str() {
            word @ ("series" | "parallel") => {
                if let Some(items) = self.branches(entry) {
                    return self.compose(site, (word, items, given), context, descent);
                }
            }
            "model" if context.basis.is_material() => {
                self.faults.error(entry.key_place, Fault::ModelInMaterial);
            }
            word @ ("model" | "material") => {
                let section =
                    if word == "model" { ModelSection::Models } else { ModelSection::Materials };
                if let Some(named) = self.reference(site.document, section, &entry.item, descent) {
                    let own = self.refer(named, context, site.place, descent)?;
                    return Some(ReadBranch { word: &self.library.entry(named).key, given, ..own });
                }
            }
            word if is_foundation(word) && !context.basis.is_material() => {
                return self.foundation(site, (entry, given), context, descent);
            }
            word => {
                let made = self.laws.read(site.document, entry, context);
                made.note.into_iter().for_each(|note| self.note(descent, given, note));
                let own = ReadBranch { word, given, model: made.model, extent: made.extent };
                return self.uncomposed(own, site.place, descent);
            }
        }
        self.uncomposed(ReadBranch::FAILED, site.place, descent)
    }

    /// The branches of a composition.
    fn branches(&self, law: &'d Entry) -> Option<&'d [Item]> {
        let items = list_of(&law.item, &format!("`{}`", law.key), self.faults)?;
        if items.is_empty() {
            self.faults.error(law.item.place, Fault::EmptyList { key: law.key.to_string() });
            return None;
        }
        Some(items)
    }

    /// Notes something about the table that is being read.
    fn note(&self, descent: &Descent, given: Given<'d>, (what, until): (Remark, Option<f64>)) {
        let Some(outer) = &descent.outer else { return };
        let inner = descent.open.last().map_or_else(|| outer.clone(), |own| self.called(*own));
        let subject = match given {
            Some((name, _)) => format!("{inner}, branch `{name}`"),
            None => inner,
        };
        self.notes.add(subject, what, until);
    }

    /// The one entry that says what the model is.
    fn law_among(&self, site: &Site<'d>, entries: &'d [Entry]) -> Option<&'d Entry> {
        let is_law = |entry: &&Entry| self.words.contains(&entry.key.as_str());
        let mut strangers = entries
            .iter()
            .filter(|entry| !is_law(entry) && !site.other_keys.contains(&entry.key.as_str()))
            .peekable();
        let has_strangers = strangers.peek().is_some();
        for stranger in strangers {
            let known = site.other_keys.iter().chain(&self.words).copied().collect();
            self.faults.error(stranger.key_place, unknown_key(stranger, &site.owner, known));
        }
        let mut laws = entries.iter().filter(is_law);
        let first = laws.next();
        if first.is_none() && !has_strangers {
            let fault = Fault::NoLaw { owner: site.owner.to_string(), known: self.words.clone() };
            self.faults.missing(site.place, fault);
        }
        if let Some(second) = laws.next() {
            let words = entries.iter().filter(is_law).map(|entry| entry.key.to_string()).collect();
            let fault = Fault::SeveralLaws { owner: site.owner.to_string(), words };
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

    pub(super) fn reference(
        &self,
        document: usize,
        section: ModelSection,
        item: &Item,
        descent: &Descent,
    ) -> Option<Reference> {
        let text = text_of(item, &format!("`{}`", section.word()), self.faults)?;
        let reference = match self.library.find(document, section, text) {
            Ok(found) => found?,
            Err(fault) => {
                self.faults.missing(item.place, fault);
                return None;
            }
        };
        let Some(from) = descent.open.iter().position(|&passed| passed == reference) else {
            return Some(reference);
        };
        let circle = descent.open[from..].iter().chain([&reference]);
        let names = circle.map(|&model| self.library.entry(model).key.to_string()).collect();
        self.faults.error(item.place, Fault::ModelInItself { family: section.word(), names });
        None
    }
}

/// Whether a word is that of an element with a law of its own, which stands in its table.
fn is_foundation(word: &str) -> bool {
    registered(ELEMENTS, word).is_some_and(|kind| has_model(kind.parameters))
}

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
pub(super) fn named_branches(
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
