//! Laws that say all about a model: elements, forms, composites.

use std::{cell::RefCell, collections::HashMap};

use dashpot_network::{Model, composites::Composed, shifts::shifted};
use dashpot_rheology::Tree;

use super::{context::Context, forms::FormReader};
use crate::{
    basis::{Basis, fits_material},
    diagnostics::Faults,
    document::Entry,
    fault::Fault,
    kinds::{CompositeEntry, registers},
    library::Library,
    parameters::KindReader,
    quantity::Quantities,
    source::Place,
};

/// Reads such laws.
pub(super) struct LawReader<'d> {
    library: &'d Library,
    faults: &'d Faults,
    /// Composites by their place and pad: many elements may have one model, and it may take long.
    composed: RefCell<HashMap<(Place, u64), Option<Composed>>>,
}

/// What comes of a law.
#[derive(Default)]
pub(super) struct Made {
    /// The model, where it could be read.
    pub(super) model: Option<Model>,
    /// What is to be said about it, and the time up to which that holds.
    pub(super) note: Option<(String, Option<f64>)>,
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
        let registers = registers();
        let word = law.key.as_str();
        let mut made = Made::default();
        if let Some(kind) = registers.element(word) {
            if context.basis.is_material() && !fits_material(kind.parameters) {
                self.faults.error(law.key_place, Fault::ElementInMaterial { word: kind.word });
                return made;
            }
            let reader = KindReader::new(quantities);
            made.model = reader.read(kind, &law.item, law.key_place).map(Tree::Part);
        } else if let Some(form) = registers.form(word) {
            made.model = FormReader { quantities }.read(form.parts, form.in_series, law);
        } else if let Some(composite) = registers.composite(word)
            && let Some(Composed { model, note, until }) =
                self.composite(quantities, composite, law)
        {
            made.model = Some(model);
            let until = until.map(|time| time * context.times);
            made.note = note.map(|note| (said_of(&note, context), until));
        }
        if is_shift(context) {
            made.model = made.model.and_then(|model| self.shifted(&model, law, context));
        }
        made
    }

    fn composite(
        &self,
        quantities: Quantities<'_>,
        composite: &CompositeEntry,
        law: &Entry,
    ) -> Option<Composed> {
        let pad = match quantities.basis {
            Basis::Model => 0,
            Basis::Material { area_over_thickness } => area_over_thickness.to_bits(),
        };
        let key = (law.key_place, pad);
        if let Some(known) = self.composed.borrow().get(&key) {
            return known.clone();
        }
        let reader = KindReader { driven: composite.amplitude, ..KindReader::new(quantities) };
        let composed = reader.read(&composite.kind, &law.item, law.key_place);
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

#[expect(clippy::float_cmp, reason = "1 is the factor where there is no shift at all")]
fn is_shift(context: Context) -> bool {
    context.times != 1.0
}

/// A note on a model as it was described, in a place where its times are shifted.
fn said_of(note: &str, context: Context) -> String {
    if is_shift(context) {
        format!("{note}, before its times are multiplied by {:.3e}", context.times)
    } else {
        note.to_owned()
    }
}
