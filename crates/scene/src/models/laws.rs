//! Laws that say all about a model: elements, forms, composites.

use std::{cell::RefCell, collections::HashMap};

use dashpot_network::{
    Element, Model,
    composites::{COMPOSITES, Composed},
    elements::{Dashpot, ELEMENTS, Spring},
    parameters::{Dimension, Kind as _, Registered, registered},
    shifts::shifted,
};
use dashpot_rheology::{Branch, Part, Role, Tree};

use super::{context::Context, notes::Remark};
use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::{Example, form, parameters::KindReader},
    quantities::{
        basis::{Basis, SIZE, fits_material, is_size},
        quantity::Quantities,
        sizes::Extent,
    },
    text::{
        document::Entry,
        library::Library,
        source::Place,
        table::{Table, wrong_type},
    },
};

pub(super) struct LawReader<'d> {
    library: &'d Library,
    faults: &'d Faults,
    /// Many elements may have one model, and it may take long.
    composed: RefCell<HashMap<ComposedFor, Option<Composed>>>,
}

/// The place of a composite, and the thickness and area of the pad that it is for, as bits.
type ComposedFor = (Place, [u64; 2]);

/// What comes of a law.
pub(super) struct Made {
    /// The model, where it could be read.
    pub(super) model: Option<Model>,
    /// What is to be said about it, and the time up to which that holds.
    pub(super) note: Option<(Remark, Option<f64>)>,
    /// The size of the pad that it is.
    pub(super) extent: Extent,
}

impl<'d> LawReader<'d> {
    /// A reader of laws in `library`.
    pub(super) fn new(library: &'d Library, faults: &'d Faults) -> Self {
        Self { library, faults, composed: RefCell::default() }
    }

    /// The model that `law` describes in a document.
    pub(super) fn read(&self, document: usize, law: &Entry, context: Context) -> Made {
        let quantities = self.library.quantities(document, self.faults);
        let quantities = Quantities { basis: context.basis, ..quantities };
        let word = law.key.as_str();
        let mut made = Made { model: None, note: None, extent: Extent::UNKNOWN };
        if let Some(kind) = registered(ELEMENTS, word) {
            if context.basis.is_material() && !fits_material(kind.parameters) {
                self.faults.error(law.key_place, Fault::ElementInMaterial { word: kind.word });
                return made;
            }
            let reader = KindReader { size: context.size, ..KindReader::new(quantities) };
            let element = reader.read(kind, &law.item, law.key_place);
            if let Some(element) = &element {
                made.extent = extent_of(element.as_ref());
            }
            made.model = element.map(Tree::Part);
        } else if let Some(form) = form(word) {
            made.model = FormReader { quantities }.read(form.parts, form.in_series, law);
        } else if let Some(composite) = registered(COMPOSITES, word)
            && let Some(Composed { model, note, until }) =
                self.composite(quantities, composite, law)
        {
            made.model = Some(model);
            let until = until.map(|time| time * context.times);
            let factor = is_shift(context).then_some(context.times);
            made.note = note.map(|note| (Remark::Composite { note, factor }, until));
        }
        if is_shift(context) {
            made.model = made.model.and_then(|model| self.shifted(&model, law, context));
        }
        made
    }

    fn composite(
        &self,
        quantities: Quantities<'_>,
        composite: &Registered<Composed, Dimension>,
        law: &Entry,
    ) -> Option<Composed> {
        let pad = match quantities.basis {
            Basis::Model => [0; 2],
            Basis::Material(pad) => pad.to_bits(),
        };
        let key = (law.key_place, pad);
        if let Some(known) = self.composed.borrow().get(&key) {
            return known.clone();
        }
        let reader = KindReader { driven: composite.about, ..KindReader::new(quantities) };
        let composed = reader.read(composite, &law.item, law.key_place);
        self.composed.borrow_mut().insert(key, composed.clone());
        composed
    }

    fn shifted(&self, model: &Model, law: &Entry, context: Context) -> Option<Model> {
        match shifted(model, context.times) {
            Ok(model) => Some(model),
            Err(invalid) => {
                self.faults.error(law.key_place, Fault::Invalid(invalid));
                None
            }
        }
    }
}

/// Whether a model has any time that a shift changes.
pub(super) fn has_times(model: &Model) -> bool {
    fn is_same(one: &Model, other: &Model) -> bool {
        match (one, other) {
            (Tree::Part(one), Tree::Part(other)) => one.values() == other.values(),
            (one, other) => {
                let pairs = one.branches().iter().zip(other.branches());
                pairs.into_iter().all(|(one, other)| is_same(&one.tree, &other.tree))
            }
        }
    }
    shifted(model, 2.0).map_or(true, |own| !is_same(model, &own))
}

/// The size of an element that has one.
fn extent_of(element: &dyn Element) -> Extent {
    let [thickness, area] = SIZE.map(|key| {
        element
            .parameters()
            .iter()
            .find(|parameter| is_size(parameter) && parameter.name == key)?;
        element.value(key)?.number()
    });
    Extent { thickness, area, least: thickness.unwrap_or(0.0) }
}

#[expect(clippy::float_cmp, reason = "1 is the factor where there is no shift at all")]
fn is_shift(context: Context) -> bool {
    context.times != 1.0
}

/// Reads named forms; their depth is that of the register.
struct FormReader<'d> {
    quantities: Quantities<'d>,
}

impl FormReader<'_> {
    /// The form with these parts.
    fn read(&self, parts: &'static [Part], in_series: bool, entry: &Entry) -> Option<Model> {
        let faults = self.quantities.faults;
        let example = Example { basis: self.quantities.basis, driven: None };
        let owner = format!("`{}`", entry.key);
        if entry.item.table().is_none() {
            let expected = format!("a table, for example `{}`", example.parts(parts));
            wrong_type(&entry.item, &owner, &expected, faults);
            return None;
        }
        let table = Table::new(&entry.item, owner, entry.key_place, faults)?;
        let read = parts.iter().map(|part| {
            let example = example.parts(std::slice::from_ref(part));
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
        let kind = registered(ELEMENTS, word)?;
        let reader = KindReader::new(self.quantities);
        reader.read(kind, &entry.item, entry.key_place).map(Tree::Part)
    }
}
