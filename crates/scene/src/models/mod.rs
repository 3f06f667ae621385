//! Two-terminal models, read by recursion into their branches and the models that they name.

mod context;
mod laws;
mod moduli;
pub(crate) mod named;
pub(crate) mod notes;
mod pressed;
mod sizes;
mod tables;

use std::{
    cell::{Cell, RefCell},
    collections::HashSet,
};

use dashpot_network::{
    InnerPad, Model,
    elements::{ELEMENTS, Indenter},
    memory::{MOST_BYTES, PART_BYTES},
    parameters::{Kind as _, registered},
};
use dashpot_rheology::{MOST_LEVELS, Tree};

use self::{
    context::{Context, Site},
    laws::LawReader,
    moduli::{MODULI, POISSON},
    notes::{ModelNote, Notes},
    sizes::Sizes,
    tables::{Given, ReadBranch, named_branches},
};
use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::model_words,
    quantities::basis::{Basis, Pad, SIZE, is_sized},
    quantities::sizes::Extent,
    text::{
        document::{Content, Entry, Item},
        library::{
            Library,
            models::{MODEL_SECTIONS, ModelSection, Reference},
        },
        source::Place,
    },
};

/// The keys of a model or material besides its law.
const MODEL_KEYS: &[&str] = &["shift", "thickness", "area", "pressed-by", LOADING];

/// The keys of a material besides its law.
const MATERIAL_KEYS: &[&str] =
    &["shift", "thickness", "area", "pressed-by", LOADING, MODULI, POISSON];

/// Key of how a pad is loaded.
pub(crate) const LOADING: &str = "loaded";

/// The keys of a branch besides its law.
const BRANCH_KEYS: &[&str] = &["name", "shift", "thickness", "area", "pressed-by", LOADING];

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

/// A model that an element is made of.
pub(crate) struct Read {
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
}

impl Pads {
    /// Goes on by a tree of so many parts and compositions, which is a pad where it has a thickness.
    fn read(&mut self, parts: usize, Extent { thickness, area, .. }: Extent) {
        self.count += parts;
        let at = self.count.saturating_sub(1);
        self.all.extend(thickness.map(|thickness| InnerPad { at, thickness, area }));
    }

    /// Forgets the areas of those that have been read since: what presses them loads only a part.
    fn forget_areas(&mut self, from: usize) {
        self.all.iter_mut().filter(|own| own.at >= from).for_each(|own| own.area = None);
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

/// One way down into a model.
struct Descent {
    levels: usize,
    /// Models that have been entered by name and not left yet.
    open: Vec<Reference>,
    /// What notes on none of them are about. Without it, models that have been visited before are not
    /// looked at again, nothing is noted, and what is read is of no use.
    outer: Option<String>,
    pads: Pads,
}

impl Descent {
    fn new(outer: Option<String>) -> Self {
        Self { levels: 0, open: Vec::new(), outer, pads: Pads::default() }
    }

    /// What has been read in the end.
    fn finish(self, whole: ReadBranch<'_>) -> Option<Read> {
        Some(Read { model: whole.model?, extent: whole.extent, pads: self.pads.within() })
    }
}

impl<'d> ModelReader<'d> {
    /// A reader of the models in `library`.
    pub(crate) fn new(library: &'d Library, faults: &'d Faults) -> Self {
        Self {
            library,
            faults,
            words: model_words(),
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
        let mut descent = Descent::new(Some(owner.clone()));
        let (owner, context) = (owner.into(), Context::of(ModelSection::Models));
        let site = Site { item, owner, place, document: 0, context, other_keys };
        let whole = self.read(&site, &mut descent)?;
        descent.finish(whole)
    }

    /// The model or material `reference`.
    pub(crate) fn named(&self, reference: Reference) -> Option<Model> {
        self.visited.borrow_mut().insert(reference);
        self.foresee(reference, self.library.entry(reference).key_place)?;
        let mut descent = Descent::new(Some(String::new()));
        self.enter(reference, Context::of(reference.section), &mut descent)?.model
    }

    /// The model that stands in `item`: its name, or a table of its own.
    pub(crate) fn given(&self, item: &'d Item, owner: String, place: Place) -> Option<Model> {
        let Some(text) = item.text() else {
            return self.element(item, owner, place, MODEL_KEYS).map(|own| own.model);
        };
        match self.library.find(0, ModelSection::Models, text) {
            Ok(found) => self.named(found?),
            Err(fault) => {
                self.faults.missing(item.place, fault);
                None
            }
        }
    }

    /// Looks for faults in those models and materials of the scene that no element uses.
    pub(crate) fn check_unused(&self) {
        for reference in
            MODEL_SECTIONS.into_iter().flat_map(|section| self.library.models(0, section))
        {
            if self.visited.borrow_mut().insert(reference) {
                self.enter(reference, Context::of(reference.section), &mut Descent::new(None));
            }
        }
    }

    /// What is to be said about the models that have been read.
    pub(crate) fn notes(&self) -> Vec<ModelNote> {
        self.notes.all()
    }

    /// "model `felt`".
    fn called(&self, reference: Reference) -> String {
        format!("{} `{}`", reference.section.word(), self.library.entry(reference).key)
    }

    /// The model in a table, one that failed where something in it is wrong; `None` where nothing more
    /// is to be read, because there is too much of it.
    fn read(&self, site: &Site<'d>, descent: &mut Descent) -> Option<ReadBranch<'d>> {
        if descent.levels == MOST_LEVELS {
            self.faults.error(site.place, Fault::ModelTooDeep { limit: MOST_LEVELS });
            return None;
        }
        descent.levels += 1;
        let read = match self.law(site, descent) {
            Some(law) => self.pressed(site, law, descent),
            None => self.uncomposed(ReadBranch::FAILED, site.place, descent),
        };
        descent.levels -= 1;
        read
    }

    /// The branches of a composition, put together.
    fn compose(
        &self,
        site: &Site<'d>,
        (word, items, given): (&'d str, &'d [Item], Given<'d>),
        context: Context,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        self.count(1, site.place)?;
        // How several parts side by side share an area is for them to say.
        let mut context = context;
        if word == "parallel" && items.iter().map(without_area).sum::<usize>() > 1 {
            context.size.around_area = None;
        }
        let branches = items.iter().map(|item| self.read(&site.branch(item, context), descent));
        let branches = branches.collect::<Option<Vec<_>>>()?;
        descent.pads.read(1, Extent::UNKNOWN);
        let in_series = word == "series";
        let compose = if in_series { Tree::Series } else { Tree::Parallel };
        let extents = branches.iter().map(|branch| branch.extent);
        let extent = if in_series { Extent::in_row(extents) } else { Extent::beside(extents) };
        let model = named_branches(branches, self.faults).map(compose);
        Some(ReadBranch { word, given, model, extent })
    }

    /// The model that a table names.
    fn refer(
        &self,
        reference: Reference,
        context: Context,
        place: Place,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let is_new = self.visited.borrow_mut().insert(reference);
        if descent.outer.is_some() {
            self.foresee(reference, place)?;
        } else if !is_new {
            return Some(ReadBranch::FAILED);
        }
        self.enter(reference, context, descent)
    }

    /// Reads a model by name.
    fn enter(
        &self,
        reference: Reference,
        context: Context,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let entry = self.library.entry(reference);
        let context = self.in_loading(reference, context);
        let is_material = reference.section == ModelSection::Materials;
        let site = Site {
            item: &entry.item,
            owner: self.called(reference).into(),
            place: entry.key_place,
            document: reference.document,
            context,
            other_keys: if is_material { MATERIAL_KEYS } else { MODEL_KEYS },
        };
        let from = descent.pads.count;
        descent.open.push(reference);
        let mut own = self.read(&site, descent)?;
        descent.open.pop();
        self.check_loading(context, own.model.as_ref());
        if let (ModelSection::Materials, Basis::Material(pad)) = (reference.section, context.basis)
        {
            own.extent = Extent::of(pad);
            descent.pads.merge(from, pad);
        }
        Some(own)
    }

    /// Counts a model that is not composed of branches here, with the pad that it is.
    fn uncomposed(
        &self,
        read_branch: ReadBranch<'d>,
        place: Place,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let parts = read_branch.model.as_ref().map_or(1, Model::size);
        self.count(parts as u64, place)?;
        descent.pads.read(parts, read_branch.extent);
        Some(read_branch)
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
}

/// How many parts of a branch of a `parallel` need an area and say none.
fn without_area(branch: &Item) -> usize {
    let entries = branch.table().unwrap_or(&[]);
    if entries.iter().any(|own| own.key == SIZE[1] || own.key == Indenter::KIND) {
        return 0;
    }
    let of = |own: &Entry| match own.key.as_str() {
        "parallel" => match &own.item.value {
            Content::List(items) => items.iter().map(without_area).sum(),
            _ => 0,
        },
        "material" => 1,
        word => registered(ELEMENTS, word).map_or(0, |kind| {
            let inner = own.item.table().unwrap_or(&[]).iter().any(|own| own.key == SIZE[1]);
            usize::from(is_sized(kind.parameters) && !inner)
        }),
    };
    entries.iter().map(of).sum()
}
