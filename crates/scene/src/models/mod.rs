//! Two-terminal models, composed as deeply as wanted.
//!
//! Models may nest 1000 levels in one text and deeper through names, so they are read with a stack
//! of tasks and not by recursion.

pub(crate) mod named;
pub(crate) mod notes;

mod context;
mod forms;
mod laws;
mod naming;
mod sizes;
mod tables;

use std::{
    borrow::Cow,
    cell::{Cell, RefCell},
    collections::HashSet,
};

use dashpot_network::{
    InnerPad, Model,
    memory::{MOST_BYTES, PART_BYTES},
};
use dashpot_rheology::Tree;

use self::notes::{ModelNote, Notes};
use self::{context::Context, laws::LawReader, sizes::Sizes};
use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::registers,
    quantities::{
        basis::{Basis, Pad},
        pad::Extent,
    },
    text::{
        document::Item,
        library::{Library, Reference, SHELVES, Shelf},
        source::Place,
    },
};

/// The keys of a model or material besides its law.
const MODEL_KEYS: &[&str] = &["shift", "thickness", "area"];

/// The keys of a branch besides its law.
const BRANCH_KEYS: &[&str] = &["name", "shift", "thickness", "area"];

/// Reads models from the documents of a library.
pub(crate) struct ModelReader<'d> {
    library: &'d Library,
    faults: &'d Faults,
    /// Words with which a model begins.
    words: Vec<&'static str>,
    laws: LawReader<'d>,
    notes: Notes,
    visited: RefCell<HashSet<Reference>>,
    sizes: Sizes<'d>,
    parts: Cell<u64>,
}

/// A table with a model.
struct Spot<'d> {
    item: &'d Item,
    /// What the table is, for messages.
    owner: Cow<'static, str>,
    /// Where its name stands.
    place: Place,
    document: usize,
    /// What becomes of its values.
    context: Context,
    /// Keys that it may have besides its law.
    other_keys: &'static [&'static str],
}

/// The name that a branch is given, and its place.
type Given<'d> = Option<(&'d str, Place)>;

/// A model by name.
#[derive(Clone, Copy)]
struct Entrance<'d> {
    reference: Reference,
    context: Context,
    given: Given<'d>,
}

enum Task<'d> {
    Read(Spot<'d>),
    /// Begins a model by name.
    Enter(Entrance<'d>),
    /// Puts the last branches together.
    Compose {
        series: bool,
        count: usize,
        given: Given<'d>,
    },
    /// Ends a model that was entered by name.
    Leave(Entrance<'d>),
}

/// What follows from a table.
enum Step<'d> {
    Done(Done<'d>),
    Compose { series: bool, branches: &'d [Item], context: Context, given: Given<'d> },
    Enter(Entrance<'d>),
}

/// A model that has been read, or could not be, with the name of its branch.
struct Done<'d> {
    word: &'d str,
    given: Given<'d>,
    model: Option<Model>,
    /// The size of the pad that it is.
    extent: Extent,
}

/// A model that an element is made of.
pub(crate) struct Read {
    /// The model.
    pub(crate) model: Model,
    /// The size of the pad that it is.
    pub(crate) extent: Extent,
    /// Its branches that are pads with a size of their own.
    pub(crate) pads: Vec<InnerPad>,
}

/// The branches with a size of their own among all that has been read, each behind its own branches.
#[derive(Default)]
struct Pads {
    count: usize,
    all: Vec<InnerPad>,
    /// What had been read when each model that is open by name was entered.
    entered: Vec<usize>,
}

impl Pads {
    /// Goes on by a tree of so many parts and compositions, which is a pad where it has a thickness.
    fn read(&mut self, parts: usize, Extent { thickness, area, .. }: Extent) {
        self.count += parts;
        let at = self.count.saturating_sub(1);
        self.all.extend(thickness.map(|thickness| InnerPad { at, thickness, area }));
    }

    /// Makes one pad of all that has been read since a model was entered.
    fn merge(&mut self, from: usize, pad: Pad) {
        self.all.retain(|own| own.at < from);
        self.read(0, Extent::of(pad));
    }

    /// Those within the model, which is the last that has been read.
    fn within(mut self) -> Vec<InnerPad> {
        self.all.retain(|own| own.at + 1 < self.count);
        self.all
    }
}

/// Models that have been entered and not left yet.
struct Open {
    order: Vec<Reference>,
    set: HashSet<Reference>,
    /// What notes on none of them are about; `None` where no notes are wanted.
    outer: Option<String>,
}

impl<'d> ModelReader<'d> {
    /// A reader of the models in `library`.
    pub(crate) fn new(library: &'d Library, faults: &'d Faults) -> Self {
        Self {
            library,
            faults,
            words: registers().model_words(),
            laws: LawReader::new(library, faults),
            notes: Notes::default(),
            visited: RefCell::default(),
            sizes: Sizes::new(library),
            parts: Cell::new(0),
        }
    }

    /// The model in the table of an element of the scene; `other_keys` are read by the caller.
    pub(crate) fn element(
        &self,
        item: &'d Item,
        owner: String,
        place: Place,
        other_keys: &'static [&'static str],
    ) -> Option<Read> {
        let outer = Some(owner.clone());
        let (owner, context) = (owner.into(), Context::of(Shelf::Models));
        self.run(Task::Read(Spot { item, owner, place, document: 0, context, other_keys }), outer)
    }

    /// The model or material `reference`.
    pub(crate) fn named(&self, reference: Reference) -> Option<Model> {
        self.visited.borrow_mut().insert(reference);
        self.foresee(reference, self.library.entry(reference).key_place)?;
        let named = Task::Enter(Entrance::plain(reference));
        self.run(named, Some(String::new())).map(|own| own.model)
    }

    /// The model that stands in `item`: its name, or a table of its own.
    pub(crate) fn given(&self, item: &'d Item, owner: String, place: Place) -> Option<Model> {
        let Some(text) = item.text() else {
            return self.element(item, owner, place, MODEL_KEYS).map(|own| own.model);
        };
        match self.library.find(0, Shelf::Models, text) {
            Ok(found) => self.named(found?),
            Err(fault) => {
                if !self.faults.damaged() {
                    self.faults.error(item.place, fault);
                }
                None
            }
        }
    }

    /// Looks for faults in those models and materials of the scene that no element uses.
    pub(crate) fn check_unused(&self) {
        for reference in SHELVES.into_iter().flat_map(|shelf| self.library.models(0, shelf)) {
            if self.visited.borrow_mut().insert(reference) {
                self.run(Task::Enter(Entrance::plain(reference)), None);
            }
        }
    }

    /// What is to be said about the models that have been read.
    pub(crate) fn notes(&self) -> Vec<ModelNote> {
        self.notes.all()
    }

    fn spot(&self, entrance: &Entrance<'d>) -> Spot<'d> {
        let Entrance { reference, context, .. } = *entrance;
        let entry = self.library.entry(reference);
        Spot {
            item: &entry.item,
            owner: self.called(reference).into(),
            place: entry.key_place,
            document: reference.document,
            context,
            other_keys: MODEL_KEYS,
        }
    }

    /// "model `felt`".
    fn called(&self, reference: Reference) -> String {
        format!("{} `{}`", reference.shelf.word(), self.library.entry(reference).key)
    }

    /// Works off `first` and all that follows from it; notes on tables without a name are about
    /// `outer`. Without it, models that have been visited before are not looked at again, nothing
    /// is noted, and the result is of no use.
    fn run(&self, first: Task<'d>, outer: Option<String>) -> Option<Read> {
        let mut tasks = vec![first];
        let mut done: Vec<Done<'d>> = Vec::new();
        let mut open = Open { order: Vec::new(), set: HashSet::new(), outer };
        let mut pads = Pads::default();
        while let Some(task) = tasks.pop() {
            match task {
                Task::Compose { series, count, given } => {
                    let branches = done.split_off(done.len() - count);
                    done.push(self.composed(series, branches, given));
                    pads.read(1, Extent::default());
                }
                Task::Enter(entrance) => {
                    open.order.push(entrance.reference);
                    open.set.insert(entrance.reference);
                    pads.entered.push(pads.count);
                    tasks.push(Task::Leave(entrance));
                    tasks.push(Task::Read(self.spot(&entrance)));
                }
                Task::Leave(Entrance { reference, given, context }) => {
                    open.order.pop();
                    open.set.remove(&reference);
                    let from = pads.entered.pop();
                    if let Some(last) = done.last_mut() {
                        (last.word, last.given) = (&self.library.entry(reference).key, given);
                        if let (Shelf::Materials, Basis::Material(pad)) =
                            (reference.shelf, context.basis)
                        {
                            last.extent = Extent::of(pad);
                            pads.merge(from.unwrap_or(0), pad);
                        }
                    }
                }
                Task::Read(spot) => {
                    let failed = Step::Done(Done {
                        word: "model",
                        given: None,
                        model: None,
                        extent: Extent::default(),
                    });
                    match self.read(&spot, &open).unwrap_or(failed) {
                        Step::Done(model) => {
                            let parts = model.model.as_ref().map_or(1, Model::size);
                            self.count(parts as u64, spot.place)?;
                            pads.read(parts, model.extent);
                            done.push(model);
                        }
                        Step::Compose { series, branches, context, given } => {
                            self.count(1, spot.place)?;
                            tasks.push(Task::Compose { series, count: branches.len(), given });
                            let branch = |item| Task::Read(Spot::branch(item, context, &spot));
                            tasks.extend(branches.iter().rev().map(branch));
                        }
                        Step::Enter(entrance) => {
                            let Entrance { reference, given, .. } = entrance;
                            let seen = !self.visited.borrow_mut().insert(reference);
                            if seen && open.outer.is_none() {
                                let word = &self.library.entry(reference).key;
                                done.push(Done {
                                    word,
                                    given,
                                    model: None,
                                    extent: Extent::default(),
                                });
                                continue;
                            }
                            if open.outer.is_some() {
                                self.foresee(reference, spot.place)?;
                            }
                            tasks.push(Task::Enter(entrance));
                        }
                    }
                }
            }
        }
        done.pop().and_then(|last| {
            Some(Read { model: last.model?, extent: last.extent, pads: pads.within() })
        })
    }

    /// Looks ahead before a model is expanded; `None` where it has too many parts.
    fn foresee(&self, model: Reference, place: Place) -> Option<()> {
        self.limit(self.sizes.of(model), self.called(model), place)
    }

    /// Counts parts; `None` where there are too many by now.
    fn count(&self, parts: u64, place: Place) -> Option<()> {
        self.limit(parts, "the scene".to_owned(), place)?;
        self.parts.set(self.parts.get() + parts);
        Some(())
    }

    /// Refuses so many further parts of a model where they would take too much memory.
    fn limit(&self, parts: u64, model: String, place: Place) -> Option<()> {
        let all = self.parts.get().saturating_add(parts);
        let bytes = all.saturating_mul(PART_BYTES);
        if bytes <= MOST_BYTES {
            return Some(());
        }
        self.faults
            .error(place, Fault::TooManyParts { model, parts: all, bytes, limit: MOST_BYTES });
        None
    }

    fn composed(&self, series: bool, branches: Vec<Done<'d>>, given: Given<'d>) -> Done<'d> {
        let word = if series { "series" } else { "parallel" };
        let compose = if series { Tree::Series } else { Tree::Parallel };
        let extents = branches.iter().map(|branch| branch.extent);
        let extent = if series { Extent::in_row(extents) } else { Extent::beside(extents) };
        Done { word, given, model: naming::named(branches, self.faults).map(compose), extent }
    }
}

impl<'d> Spot<'d> {
    fn branch(item: &'d Item, context: Context, outer: &Self) -> Self {
        let (owner, document) = (Cow::Borrowed("this branch"), outer.document);
        Self { item, owner, place: item.place, document, context, other_keys: BRANCH_KEYS }
    }
}

impl Entrance<'_> {
    /// A model for its own sake.
    fn plain(reference: Reference) -> Self {
        Self { reference, context: Context::of(reference.shelf), given: None }
    }
}
