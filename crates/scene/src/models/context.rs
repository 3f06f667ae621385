//! What the values in a table of a model mean: for which pad, at which temperature.

use dashpot_network::parameters::{Dimension, positive};

use super::Spot;
use crate::{
    basis::{AREA, Basis},
    diagnostics::Faults,
    document::{Content, Entry},
    fault::Fault,
    kinds::{Example, registers},
    library::{Library, Shelf},
    parameters::KindReader,
    plausible,
    table::wrong_type,
};

/// What becomes of the values in a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Context {
    /// Whether they are those of a model, or of a material and for which pad.
    pub(super) basis: Basis,
    /// Factor of all times \[1\], from the shifts around the table.
    pub(super) times: f64,
}

/// A shift of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shift {
    /// Its word.
    pub(super) word: &'static str,
    /// Factor of all times \[1\].
    pub(super) factor: f64,
}

impl Context {
    /// That of a table of its own.
    pub(super) fn of(shelf: Shelf) -> Self {
        let basis = match shelf {
            Shelf::Models => Basis::Model,
            Shelf::Materials => Basis::MATERIAL,
        };
        Self { basis, times: 1.0 }
    }
}

/// Reads what stands beside the law of a model.
pub(super) struct Besides<'d> {
    /// The documents.
    pub(super) library: &'d Library,
    /// Where errors go.
    pub(super) faults: &'d Faults,
}

impl<'d> Besides<'d> {
    /// The context of the law in `spot`, and the shift that stands there.
    ///
    /// Where a key is faulty it is left out: the error has been noted, and the rest of the model is
    /// still looked at.
    pub(super) fn read(
        &self,
        spot: &Spot<'d>,
        entries: &'d [Entry],
        law: &Entry,
    ) -> (Context, Option<Shift>) {
        let mut context = spot.context;
        let find = |key: &str| entries.iter().find(|entry| entry.key == key);
        let shift = find("shift").and_then(|entry| self.shift(spot, entry));
        if let Some(shift) = shift {
            context.times *= shift.factor;
        }
        let [thickness, area] = ["thickness", "area"].map(find);
        if law.key == Shelf::Materials.word() && !context.basis.is_material() {
            let thickness = self.size(spot, thickness, ("thickness", Dimension::LENGTH, "2 cm"));
            let area = self.size(spot, area, ("area", AREA, "100 cm^2"));
            let size = thickness.zip(area);
            let area_over_thickness = size.map_or(1.0, |(thickness, area)| area / thickness);
            context.basis = Basis::Material { area_over_thickness };
            return (context, shift);
        }
        // The thickness of an element is also the depth at which it is warned of.
        let thickness = thickness.filter(|_| !spot.other_keys.contains(&"between"));
        for (key, entry) in [("thickness", thickness), ("area", area)] {
            let Some(entry) = entry else { continue };
            let fault = if context.basis.is_material() {
                Fault::SizeInMaterial { key }
            } else {
                Fault::SizeWithoutMaterial { key, owner: spot.owner.to_string() }
            };
            self.faults.error(entry.key_place, fault);
        }
        (context, shift)
    }

    /// The thickness or area of a pad.
    fn size(
        &self,
        spot: &Spot<'d>,
        entry: Option<&Entry>,
        (key, dimension, example): (&'static str, Dimension, &str),
    ) -> Option<f64> {
        let Some(entry) = entry else {
            if !self.faults.damaged() {
                let (key, owner) = (key.to_owned(), spot.owner.to_string());
                let help = format!(
                    "a material becomes a pad by its thickness and area, for example `{key} = \
                     \"{example}\"`"
                );
                let fault = Fault::MissingKey { key, owner, example: String::new() };
                self.faults.error(spot.place, fault.with_help(help));
            }
            return None;
        };
        let quantities = self.library.quantities(spot.document, self.faults);
        let check = |size| positive(key, size);
        let size = quantities.read_checked(&entry.item, dimension, check);
        plausible::check(quantities, entry, size);
        size
    }

    /// The shift in a table such as `{ wlf = { … } }`.
    fn shift(&self, spot: &Spot<'d>, entry: &Entry) -> Option<Shift> {
        let shifts = &registers().shifts;
        let known = || shifts.iter().map(|kind| kind.word).collect::<Vec<_>>();
        let Content::Table(own) = &entry.item.value else {
            wrong_type(&entry.item, "`shift`", &expected(), self.faults);
            return None;
        };
        let mut strangers =
            own.iter().filter(|own| !known().contains(&own.key.as_str())).peekable();
        if strangers.peek().is_some() {
            for stranger in strangers {
                let (key, owner) = (stranger.key.clone(), "`shift`".to_owned());
                let fault = Fault::UnknownKey { key, owner, known: known() };
                self.faults.error(stranger.key_place, fault);
            }
            return None;
        }
        let [only] = own.as_slice() else {
            let found = match own.len() {
                0 => "an empty table".to_owned(),
                count => format!("a table of {count} shifts"),
            };
            let what = "`shift`".to_owned();
            let fault = Fault::WrongType { what, expected: expected(), found };
            self.faults.error(entry.item.place, fault);
            return None;
        };
        let kind = shifts.iter().find(|kind| kind.word == only.key)?;
        let quantities = self.library.quantities(spot.document, self.faults);
        let factor = KindReader::new(quantities).read(kind, &only.item, only.key_place)?;
        for own in only.item.table().unwrap_or(&[]) {
            let temperature = quantities.peek(&own.item);
            plausible::check(quantities, own, temperature);
        }
        Some(Shift { word: kind.word, factor })
    }
}

/// What a shift is.
fn expected() -> String {
    let example = registers().shifts.first().map_or_else(String::new, |kind| {
        format!("{{ {} = {} }}", kind.word, Example::PLAIN.value(kind.parameters))
    });
    format!("a table with one kind of shift, for example `{example}`")
}
