//! Two-terminal models, composed as deeply as wanted.
//!
//! Models may nest 1000 levels in one text and deeper through names, so they are read with a stack
//! of tasks and not by recursion.

use std::{
    borrow::Cow,
    cell::{Cell, RefCell},
    collections::{HashMap, HashSet},
    sync::Arc,
};

use dashpot_network::{
    Element, Model,
    elements::{Dashpot, ElementKind, Spring},
};
use dashpot_rheology::{Branch, Part, Role, Tree};

use crate::{
    diagnostics::Faults,
    document::{Entry, Item},
    fault::Fault,
    kinds::{example_parts, registers},
    library::{Library, Reference},
    parameters::KindReader,
    quantity::Quantities,
    source::Place,
    table::{Table, check_name, entries_of, list_of, text_of, wrong_type},
};

/// The models of one scene may expand to so many parts and compositions.
const MAX_PARTS: usize = 4_000_000;

/// Reads models from the documents of a library.
pub(crate) struct ModelReader<'d> {
    library: &'d Library,
    faults: &'d Faults,
    /// Words with which a model begins.
    words: Vec<&'static str>,
    visited: RefCell<HashSet<Reference>>,
    parts: Cell<usize>,
}

/// A table with a model.
struct Spot<'d> {
    item: &'d Item,
    /// What the table is, for messages.
    owner: Cow<'static, str>,
    /// Where its name stands.
    place: Place,
    document: usize,
    /// Keys that it may have besides its law.
    other_keys: &'static [&'static str],
}

/// The name that a branch is given, and its place.
type Given<'d> = Option<(&'d str, Place)>;

enum Task<'d> {
    Read(Spot<'d>),
    /// Begins a model by name.
    Enter {
        reference: Reference,
        given: Given<'d>,
    },
    /// Puts the last branches together.
    Compose {
        series: bool,
        count: usize,
        given: Given<'d>,
    },
    /// Ends a model that was entered by name.
    Leave {
        reference: Reference,
        given: Given<'d>,
    },
}

/// What follows from a table.
enum Step<'d> {
    Done(Done<'d>),
    Compose { series: bool, branches: &'d [Item], given: Given<'d> },
    Enter { reference: Reference, given: Given<'d> },
}

/// A model that has been read, or could not be, with the name of its branch.
struct Done<'d> {
    word: &'d str,
    given: Given<'d>,
    model: Option<Model>,
}

/// Models that have been entered and not left yet.
#[derive(Default)]
struct Open {
    order: Vec<Reference>,
    set: HashSet<Reference>,
}

impl<'d> ModelReader<'d> {
    /// A reader of the models in `library`.
    pub(crate) fn new(library: &'d Library, faults: &'d Faults) -> Self {
        let words = registers().model_words();
        Self { library, faults, words, visited: RefCell::default(), parts: Cell::new(0) }
    }

    /// The model in the table of an element of the scene; `other_keys` are read by the caller.
    pub(crate) fn element(
        &self,
        item: &'d Item,
        owner: String,
        place: Place,
        other_keys: &'static [&'static str],
    ) -> Option<Model> {
        let owner = owner.into();
        self.run(Task::Read(Spot { item, owner, place, document: 0, other_keys }), false)
    }

    /// The model `reference`.
    pub(crate) fn named(&self, reference: Reference) -> Option<Model> {
        self.visited.borrow_mut().insert(reference);
        self.run(Task::Enter { reference, given: None }, false)
    }

    /// Looks for faults in those models of the scene that no element uses.
    pub(crate) fn check_unused(&self) {
        for reference in self.library.models(0) {
            if self.visited.borrow_mut().insert(reference) {
                self.run(Task::Enter { reference, given: None }, true);
            }
        }
    }

    fn spot(&self, reference: Reference) -> Spot<'d> {
        let entry = self.library.entry(reference);
        Spot {
            item: &entry.item,
            owner: format!("model `{}`", entry.key).into(),
            place: entry.key_place,
            document: reference.document,
            other_keys: &[],
        }
    }

    /// Works off `first` and all that follows from it. With `skip`, models that have been visited
    /// before are not looked at again, and the result is of no use.
    fn run(&self, first: Task<'d>, skip: bool) -> Option<Model> {
        let mut tasks = vec![first];
        let mut done: Vec<Done<'d>> = Vec::new();
        let mut open = Open::default();
        while let Some(task) = tasks.pop() {
            match task {
                Task::Compose { series, count, given } => {
                    let branches = done.split_off(done.len() - count);
                    done.push(self.composed(series, branches, given));
                }
                Task::Enter { reference, given } => {
                    open.order.push(reference);
                    open.set.insert(reference);
                    tasks.push(Task::Leave { reference, given });
                    tasks.push(Task::Read(self.spot(reference)));
                }
                Task::Leave { reference, given } => {
                    open.order.pop();
                    open.set.remove(&reference);
                    if let Some(last) = done.last_mut() {
                        (last.word, last.given) = (&self.library.entry(reference).key, given);
                    }
                }
                Task::Read(spot) => {
                    self.parts.set(self.parts.get() + 1);
                    if self.parts.get() > MAX_PARTS {
                        self.faults.error(spot.place, Fault::TooManyParts { limit: MAX_PARTS });
                        return None;
                    }
                    let failed = Step::Done(Done { word: "model", given: None, model: None });
                    match self.read(&spot, &open).unwrap_or(failed) {
                        Step::Done(model) => done.push(model),
                        Step::Compose { series, branches, given } => {
                            tasks.push(Task::Compose { series, count: branches.len(), given });
                            let branch = |item| Task::Read(Spot::branch(item, spot.document));
                            tasks.extend(branches.iter().rev().map(branch));
                        }
                        Step::Enter { reference, given } => {
                            let seen = !self.visited.borrow_mut().insert(reference);
                            if seen && skip {
                                let word = &self.library.entry(reference).key;
                                done.push(Done { word, given, model: None });
                                continue;
                            }
                            tasks.push(Task::Enter { reference, given });
                        }
                    }
                }
            }
        }
        done.pop()?.model
    }

    fn read(&self, spot: &Spot<'d>, open: &Open) -> Option<Step<'d>> {
        let entries = entries_of(spot.item, &spot.owner, self.faults)?;
        let law = self.law(spot, entries)?;
        let given = spot.other_keys.contains(&"name").then(|| self.given_name(entries)).flatten();
        match law.key.as_str() {
            word @ ("series" | "parallel") => {
                let branches = list_of(&law.item, &format!("`{word}`"), self.faults)?;
                if branches.is_empty() {
                    self.faults.error(law.item.place, Fault::EmptyList { key: word.to_owned() });
                    return None;
                }
                Some(Step::Compose { series: word == "series", branches, given })
            }
            "model" => {
                let reference = self.reference(spot.document, &law.item, open)?;
                Some(Step::Enter { reference, given })
            }
            word => {
                let model = self.primitive_or_form(spot.document, law, word);
                Some(Step::Done(Done { word, given, model }))
            }
        }
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
            let (key, owner) = (stranger.key.clone(), spot.owner.to_string());
            self.faults.error(stranger.key_place, Fault::UnknownKey { key, owner, known });
        }
        let mut laws = entries.iter().filter(is_law);
        let first = laws.next();
        if first.is_none() && !has_strangers && !self.faults.damaged() {
            let fault = Fault::NoLaw { owner: spot.owner.to_string(), known: self.words.clone() };
            self.faults.error(spot.place, fault);
        }
        if let Some(second) = laws.next() {
            let words = entries.iter().filter(is_law).map(|entry| entry.key.clone()).collect();
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

    fn reference(&self, document: usize, item: &Item, open: &Open) -> Option<Reference> {
        let text = text_of(item, "`model`", self.faults)?;
        let reference = match self.library.find(document, text) {
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
        let names = circle.map(|&model| self.library.entry(model).key.clone()).collect();
        self.faults.error(item.place, Fault::ModelInItself { names });
        None
    }

    fn primitive_or_form(&self, document: usize, law: &Entry, word: &str) -> Option<Model> {
        let quantities = self.library.quantities(document, self.faults);
        if let Some(kind) = registers().element(word) {
            let reader = KindReader::new(quantities);
            return reader.read(kind, &law.item, law.key_place).map(Tree::Part);
        }
        let form = registers().form(word)?;
        FormReader { quantities }.read(form.parts, form.in_series, law)
    }

    fn composed(&self, series: bool, branches: Vec<Done<'d>>, given: Given<'d>) -> Done<'d> {
        let word = if series { "series" } else { "parallel" };
        let compose = if series { Tree::Series } else { Tree::Parallel };
        Done { word, given, model: self.branches(branches).map(compose) }
    }

    /// The branches by the names that they are given, or else by their words, numbered from the
    /// second one of a word on.
    fn branches(&self, branches: Vec<Done<'d>>) -> Option<Vec<Branch<Arc<dyn Element>>>> {
        let mut taken = HashSet::new();
        for (name, place) in branches.iter().filter_map(|branch| branch.given) {
            if !taken.insert(Cow::Borrowed(name)) {
                self.faults.error(place, Fault::DuplicateKey { key: name.to_owned() });
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
}

impl<'d> Spot<'d> {
    fn branch(item: &'d Item, document: usize) -> Self {
        let owner = Cow::Borrowed("this branch");
        Self { item, owner, place: item.place, document, other_keys: &["name"] }
    }
}

/// Reads named forms; their depth is that of the register.
struct FormReader<'d> {
    quantities: Quantities<'d>,
}

impl FormReader<'_> {
    fn read(&self, parts: &'static [Part], in_series: bool, entry: &Entry) -> Option<Model> {
        let faults = self.quantities.faults;
        let owner = format!("`{}`", entry.key);
        if entry.item.table().is_none() {
            let expected = format!("a table, for example `{}`", example_parts(parts));
            wrong_type(&entry.item, &owner, &expected, faults);
            return None;
        }
        let table = Table::new(&entry.item, owner, entry.key_place, faults)?;
        let read = parts.iter().map(|part| {
            let example = example_parts(std::slice::from_ref(part));
            let inner = example.strip_prefix("{ ").and_then(|rest| rest.strip_suffix(" }"));
            let tree = table
                .require(part.name, inner.unwrap_or_default())
                .and_then(|entry| self.part(part, entry));
            tree.map(|tree| Branch::new(part.name, tree))
        });
        // Every part is read, so that all faults are found.
        let read = read.collect::<Vec<_>>();
        table.finish();
        let branches = read.into_iter().collect::<Option<Vec<_>>>()?;
        Some(if in_series { Tree::Series(branches) } else { Tree::Parallel(branches) })
    }

    fn part(&self, part: &Part, entry: &Entry) -> Option<Model> {
        let word = match part.role {
            Role::Spring => Spring::KIND,
            Role::Dashpot => Dashpot::KIND,
            Role::Form { parts, in_series } => return self.read(parts, in_series, entry),
        };
        let kind = registers().element(word)?;
        let reader = KindReader::new(self.quantities);
        reader.read(kind, &entry.item, entry.key_place).map(Tree::Part)
    }
}
