//! Pads that are pressed by a body of a given shape.

use std::{mem, sync::Arc};

use dashpot_network::{
    Element, Model,
    elements::{ELEMENTS, Foundation, Indenter},
    parameters::{InvalidParameter, ModelValue, Parameter, Value, registered},
};
use dashpot_rheology::Tree;

use super::{
    Descent, ModelReader,
    context::{Context, Site},
    laws::has_times,
    tables::{Given, Law, ReadBranch},
};
use crate::{
    diagnostics::fault::Fault,
    kinds::{is_model, parameters::KindReader},
    quantities::sizes::Extent,
    text::{
        document::{Entry, Item},
        library::models::ModelSection,
        source::Place,
    },
};

impl<'d> ModelReader<'d> {
    /// The model that a law stands for, under the body that presses it.
    pub(super) fn pressed(
        &self,
        site: &Site<'d>,
        law: Law<'d>,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let (pressed_by, shift) = (law.context.pressed_by, law.shift);
        let from = descent.pads.count;
        let own = self.of_law(site, law, descent)?;
        if let (Some((word, place)), Some(model)) = (shift, &own.model)
            && !has_times(model)
        {
            let message =
                format!("`{word}` shifts times, and this law has none: it changes nothing");
            let help =
                "leave `shift` out; forces and moduli are those at the temperature of the test";
            self.faults.warning(place, Fault::odd(message, help));
        }
        let Some((indenter, place)) = pressed_by else { return Some(own) };
        descent.pads.forget_areas(from);
        let extent = Extent { area: None, ..own.extent };
        let model = own.model.and_then(|model| self.on_columns(&model, &indenter, place));
        Some(ReadBranch { model, extent, ..own })
    }

    /// A model of which each column is made, under a body: parts side by side are so in every column.
    fn on_columns(&self, model: &Model, indenter: &Indenter, place: Place) -> Option<Model> {
        let press = |leaf: &Arc<dyn Element>| {
            Foundation::new(Arc::clone(leaf), *indenter).map(|own| Tree::Part(Arc::new(own) as _))
        };
        let fault = match model.try_map(press) {
            Ok(pressed) if !has_series(&pressed) => return Some(pressed),
            Ok(_) => {
                let message = "what `pressed-by` presses has parts in series".to_owned();
                let help = "press the part at the face alone, and put the others in series with it; \
                            or give the measured curve of all of them as one `table-spring`";
                Fault::odd(message, help)
            }
            Err(InvalidParameter { range, found, .. }) => {
                let message = format!("what `pressed-by` presses must be {range}, but has {found}");
                let help = "give an `area` instead, which is loaded at once; or press a material that does not \
                            depend on the rate, such as a `table-spring` or `hysteretic-table`, with the dashpot in \
                            parallel beside the pad";
                Fault::odd(message, help)
            }
        };
        self.faults.error(place, fault);
        None
    }

    /// An element with a law of its own, which stands in its table as a model.
    pub(super) fn foundation(
        &self,
        site: &Site<'d>,
        (entry, given): (&'d Entry, Given<'d>),
        context: Context,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let word = entry.key.as_str();
        let failed = || ReadBranch { word, given, ..ReadBranch::FAILED };
        let Some(kind) = registered(ELEMENTS, word) else { return Some(failed()) };
        let entries = entry.item.table().unwrap_or(&[]);
        let own = kind.parameters.iter().position(is_model);
        let law = own.and_then(|at| entries.iter().find(|law| law.key == kind.parameters[at].name));
        let quantities = self.library.quantities(site.document, self.faults);
        let (Some(at), Some(law)) = (own, law) else {
            // The reader tells what is missing.
            KindReader::new(quantities).read(kind, &entry.item, entry.key_place);
            return self.uncomposed(failed(), site.place, descent);
        };
        let read = self.inner(site, &law.item, context, descent)?;
        let extent = Extent { area: None, ..read.extent };
        let others: Vec<Parameter> =
            kind.parameters.iter().filter(|own| !is_model(own)).copied().collect();
        let model = read.model.and_then(|model| {
            let make = |values: &[Value]| {
                let mut values = values.to_vec();
                values.insert(at, Value::Model(ModelValue::new(model.clone())));
                (kind.make)(&values)
            };
            let other_keys = &[Foundation::LAW];
            let reader = KindReader { other_keys, ..KindReader::new(quantities) };
            reader.read_as((word, &others), &make, &entry.item, entry.key_place)
        });
        let own = ReadBranch { word, given, model: model.map(Tree::Part), extent };
        self.uncomposed(own, site.place, descent)
    }

    /// A model within an element, whose branches are none of the network.
    fn inner(
        &self,
        site: &Site<'d>,
        item: &'d Item,
        context: Context,
        descent: &mut Descent,
    ) -> Option<ReadBranch<'d>> {
        let pads = mem::take(&mut descent.pads);
        let read = if item.text().is_some() {
            match self.reference(site.document, ModelSection::Models, item, descent) {
                Some(named) => self.refer(named, context, site.place, descent),
                None => Some(ReadBranch::FAILED),
            }
        } else {
            self.read(&site.branch(item, context), descent)
        };
        descent.pads = pads;
        read
    }
}

/// Whether parts of a model are in series.
fn has_series(model: &Model) -> bool {
    model.is_series() || model.branches().iter().any(|branch| has_series(&branch.tree))
}
