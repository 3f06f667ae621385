//! What the values in a table of a model mean: for which pad, at which temperature.

use std::borrow::Cow;

use dashpot_network::{
    elements::{ELEMENTS, Indenter},
    parameters::{Dimension, Kind as _, Range, registered},
    shifts::SHIFTS,
};

use super::{BRANCH_KEYS, LOADING, moduli::loading};
use crate::{
    diagnostics::{Faults, fault::Fault},
    kinds::{Example, parameters::KindReader},
    quantities::basis::{AREA, Basis, Loading, Pad, SIZE, is_sized},
    quantities::sizes::{EnclosingPad, Size},
    text::{
        document::{Content, Entry, Item},
        library::{Library, models::ModelSection},
        source::Place,
        table::{unknown_key, wrong_type},
    },
};

/// What becomes of the values in a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Context {
    /// Whether they are those of a model, or of a material and for which pad.
    pub(super) basis: Basis,
    /// Factor of all times \[1\], from the shifts around the table.
    pub(super) times: f64,
    /// What is known of the size of the pad.
    pub(super) size: EnclosingPad,
    /// The body that presses the model in the table, and where it stands.
    pub(super) pressed_by: Option<(Indenter, Place)>,
}

/// Where a model stands: its table, and what holds for the values in it.
pub(super) struct Site<'d> {
    pub(super) item: &'d Item,
    /// What the table is, for messages.
    pub(super) owner: Cow<'static, str>,
    pub(super) place: Place,
    pub(super) document: usize,
    /// What becomes of its values.
    pub(super) context: Context,
    /// Keys that it may have besides its law.
    pub(super) other_keys: &'static [&'static str],
}

/// A shift of a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shift {
    pub(super) word: &'static str,
    /// Factor of all times \[1\].
    pub(super) factor: f64,
}

impl Context {
    /// That of a table of its own.
    pub(super) fn of(section: ModelSection) -> Self {
        let basis = match section {
            ModelSection::Models => Basis::Model,
            ModelSection::Materials => Basis::MATERIAL,
        };
        Self { basis, times: 1.0, size: EnclosingPad::default(), pressed_by: None }
    }
}

impl<'d> Site<'d> {
    /// A branch of the model that stands here.
    pub(super) fn branch(&self, item: &'d Item, context: Context) -> Self {
        let (owner, document) = (Cow::Borrowed("this branch"), self.document);
        Self { item, owner, place: item.place, document, context, other_keys: BRANCH_KEYS }
    }
}

/// Reads what stands beside the law of a model.
pub(super) struct ContextReader<'d> {
    pub(super) library: &'d Library,
    pub(super) faults: &'d Faults,
}

impl<'d> ContextReader<'d> {
    /// The context of the law in `site`, and the shift that stands there.
    ///
    /// Where a key is faulty it is left out: the error has been noted, and the rest of the model is still looked at.
    pub(super) fn read(
        &self,
        site: &Site<'d>,
        entries: &'d [Entry],
        law: &Entry,
    ) -> (Context, Option<Shift>) {
        let mut context = Context { pressed_by: None, ..site.context };
        let find = |key: &str| entries.iter().find(|entry| entry.key == key);
        let shift = find("shift").and_then(|entry| self.shift(site, entry));
        if let Some(shift) = shift {
            context.times *= shift.factor;
        }
        let given = SIZE.map(find);
        let pressed_by = (Indenter::KIND, find(Indenter::KIND));
        if context.basis.is_material() {
            let loading = (LOADING, find(LOADING));
            for (key, entry) in SIZE.into_iter().zip(given).chain([pressed_by, loading]) {
                let Some(entry) = entry else { continue };
                self.faults.error(entry.key_place, Fault::SizeInMaterial { key });
            }
            return (context, shift);
        }
        let around = context.size;
        let mut sizes = SIZE.into_iter().zip(given);
        let mut beside = [(); 2].map(|()| {
            let (key, entry) = sizes.next()?;
            entry.and_then(|entry| self.size(site, key, entry))
        });
        let mut is_faulty = [0, 1].map(|at: usize| given[at].is_some() && beside[at].is_none());
        if let Some(entry) = pressed_by.1 {
            context.pressed_by = self.indenter(site, entry, given[1]);
            let area = context.pressed_by.and_then(|(own, place)| Some((own.area().ok()?, place)));
            beside[1] = area.map(|(value, place)| Size { value, place });
            is_faulty[1] = beside[1].is_none();
        }
        context.size.beside = [None; 2];
        context.size.is_faulty = [false; 2];
        let is_element = site.other_keys.contains(&"between");
        if law.key == ModelSection::Materials.word() {
            let passed = |at: usize| around.around(SIZE[at], law.item.place);
            let lacks = |at: usize| given[at].is_none() && !is_faulty[at];
            beside = [0, 1].map(|at| beside[at].or_else(|| passed(at).filter(|_| lacks(at))));
            for (key, (entry, size)) in SIZE.into_iter().zip(given.into_iter().zip(beside)) {
                match size {
                    Some(size) => around.check(key, size, self.faults),
                    None if entry.is_none() && !is_faulty[usize::from(key != SIZE[0])] => {
                        self.missing(site, around, key);
                    }
                    None => {}
                }
            }
            let [thickness, area] = beside.map(|size| size.map_or(1.0, |size| size.value));
            let loading = find(LOADING).and_then(|own| self.loading(own, pressed_by.1.is_some()));
            let loading = loading.unwrap_or((Loading::Compression, law.item.place));
            context.basis = Basis::Material(Pad::new(thickness, area).loaded(loading));
        } else if registered(ELEMENTS, &law.key).is_some_and(|kind| is_sized(kind.parameters)) {
            // The reader of the law checks them with those in its own table.
            context.size.beside = beside;
            context.size.is_faulty = is_faulty;
        } else {
            context.pressed_by = None;
            if is_element {
                context.size.around = beside[0].take();
                context.size.around_area = beside[1].take().map(|size| size.value);
            }
            let sizes = SIZE.into_iter().zip(given).filter(|_| !is_element);
            for (key, entry) in sizes.chain([pressed_by]) {
                let Some(entry) = entry else { continue };
                let fault = Fault::SizeWithoutMaterial { key, owner: site.owner.to_string() };
                self.faults.error(entry.key_place, fault);
            }
        }
        if let Some(entry) = find(LOADING).filter(|_| law.key != ModelSection::Materials.word()) {
            let message = format!("`{LOADING}` goes with a material, which {} is not", site.owner);
            let help = "leave it out: the law stands as it is written";
            self.faults.error(entry.key_place, Fault::odd(message, help));
        }
        context.size.in_row |= law.key == "series";
        (context, shift)
    }

    /// The thickness or area of a pad.
    fn size(&self, site: &Site<'d>, key: &'static str, entry: &Entry) -> Option<Size> {
        let quantities = self.library.quantities(site.document, self.faults);
        let dimension = if key == SIZE[0] { Dimension::LENGTH } else { AREA };
        let size = quantities.within(Range::Positive, key, &entry.item, dimension);
        size.map(|value| Size { value, place: entry.item.place })
    }

    /// The body that presses a pad, which gives the pad its area.
    fn indenter(
        &self,
        site: &Site<'d>,
        entry: &'d Entry,
        area: Option<&Entry>,
    ) -> Option<(Indenter, Place)> {
        if let Some(area) = area {
            let message =
                format!("`area` and `pressed-by` of {} are two sizes of one pad", site.owner);
            let help = "leave `area` out: the shape says what is loaded; or leave `pressed-by` \
                        out, if all of the area is loaded at once";
            self.faults.error(area.key_place, Fault::odd(message, help));
        }
        let reader = KindReader::new(self.library.quantities(site.document, self.faults));
        let what = (Indenter::KIND, Indenter::PARAMETERS);
        let keys = entry.item.table().unwrap_or(&[]);
        if entry.item.table().is_some() && !keys.iter().any(|own| own.key == "shape") {
            let message = "`pressed-by` has no `shape`".to_owned();
            let help = "write `{ shape = \"sphere\", radius = \"50 mm\" }`; a dome has `radius` and `diameter`, a \
                        cylinder `radius` and `length`, a flat `diameter`, and each `pad-radius` where the pad is curved";
            self.faults.error(entry.item.place, Fault::odd(message, help));
            return None;
        }
        let own = reader.read_as(what, &Indenter::from_values, &entry.item, entry.key_place)?;
        Some((own, entry.item.place))
    }

    /// How a pad is loaded, and where that stands; a body that presses it loads it in compression alone.
    fn loading(&self, entry: &Entry, is_pressed: bool) -> Option<(Loading, Place)> {
        let own = loading(entry, self.faults)?;
        if is_pressed && own == Loading::Shear {
            let message = "a body that presses a pad loads it across its thickness, not in shear";
            let help = "leave `loaded` out, or write `loaded = \"confined\"` where the material \
                        around each column holds its sides";
            self.faults.error(entry.item.place, Fault::odd(message, help));
        }
        Some((own, entry.item.place))
    }

    /// Notes a size that a material needs.
    fn missing(&self, site: &Site<'d>, around: EnclosingPad, key: &'static str) {
        if let Some(fault) = around.missing(key, &site.owner) {
            self.faults.missing(site.place, fault);
        }
    }

    /// The shift in a table such as `{ wlf = { … } }`.
    fn shift(&self, site: &Site<'d>, entry: &Entry) -> Option<Shift> {
        let shifts = SHIFTS;
        let known = || shifts.iter().map(|kind| kind.word).collect::<Vec<_>>();
        let Content::Table(own) = &entry.item.value else {
            wrong_type(&entry.item, "`shift`", &expected(), self.faults);
            return None;
        };
        let mut strangers =
            own.iter().filter(|own| !known().contains(&own.key.as_str())).peekable();
        if strangers.peek().is_some() {
            for stranger in strangers {
                let fault = unknown_key(stranger, "`shift`", known());
                self.faults.error(stranger.key_place, fault);
            }
            return None;
        }
        let [only] = &**own else {
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
        let quantities = self.library.quantities(site.document, self.faults);
        let factor = KindReader::new(quantities).read(kind, &only.item, only.key_place)?;
        Some(Shift { word: kind.word, factor })
    }
}

fn expected() -> String {
    let example = SHIFTS.first().map_or_else(String::new, |kind| {
        format!("{{ {} = {} }}", kind.word, Example::PLAIN.value(kind.parameters))
    });
    format!("a table with one kind of shift, for example `{example}`")
}
