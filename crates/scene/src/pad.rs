//! The size of the pad that a law stands for, and where it is said.

use dashpot_network::parameters::Dimension;

use crate::{
    basis::{AREA, Pad, SIZE},
    diagnostics::Faults,
    fault::Fault,
    source::Place,
    units::format_short,
};

/// Two sizes that differ by less, in parts of themselves, are one that is written in two units.
const SAME: f64 = 1e-9;

/// A thickness \[m\] or area \[m²\], and where it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Size {
    /// Its value.
    pub(crate) value: f64,
    /// Its place.
    pub(crate) place: Place,
}

/// What the tables around a law say about the size of its pad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Surroundings {
    /// What stands beside the law, by the order of [`SIZE`].
    pub(crate) beside: [Option<Size>; 2],
    /// The thickness of the element of which the law is a part.
    pub(crate) around: Option<Size>,
    /// Whether it is one of several parts in a row, which are thinner than the whole.
    pub(crate) in_row: bool,
}

impl Surroundings {
    /// What stands beside the law under one of the keys [`SIZE`].
    pub(crate) fn beside(&self, key: &str) -> Option<Size> {
        SIZE.iter().position(|known| *known == key).and_then(|at| self.beside[at])
    }

    /// Notes where the size `own` of a part contradicts what stands around it.
    pub(crate) fn check(&self, key: &'static str, own: Size, faults: &Faults) {
        if own.value <= 0.0 {
            return;
        }
        if let Some(other) = self.beside(key)
            && (own.value - other.value).abs() > SAME * other.value
        {
            note(key, [own, other], "both are that of one pad: give it once", faults);
        }
        let Some(whole) = self.around.filter(|_| key == SIZE[0]) else { return };
        let excess = own.value - whole.value;
        if self.in_row && excess > SAME * whole.value {
            note(key, [own, whole], "a part in a row is no thicker than the whole", faults);
        } else if !self.in_row && excess.abs() > SAME * whole.value {
            let help = "what lies between the same ends has one thickness: correct one, or leave \
                        that of the element out";
            note(key, [own, whole], help, faults);
        }
    }
}

/// The size of what a model stands for, where it is known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Extent {
    /// Thickness h \[m\].
    pub(crate) thickness: Option<f64>,
    /// Area A \[m²\].
    pub(crate) area: Option<f64>,
}

impl Extent {
    /// That of a pad.
    pub(crate) fn of(Pad { thickness, area }: Pad) -> Self {
        Self { thickness: Some(thickness), area: Some(area) }
    }

    /// That of parts in a row. Of several it says nothing: stress and strain are not the same in
    /// all of them.
    pub(crate) fn in_row(parts: impl ExactSizeIterator<Item = Self>) -> Self {
        Self::only(parts).unwrap_or_default()
    }

    /// That of parts side by side: the thickness of those that have one. On what area the force of
    /// all of them acts, they do not say.
    pub(crate) fn beside(parts: impl ExactSizeIterator<Item = Self> + Clone) -> Self {
        Self::only(parts.clone()).unwrap_or_else(|| {
            let mut known = parts.filter_map(|part| part.thickness);
            let is_same = |first: &f64, other: f64| (other - first).abs() <= SAME * first;
            let first = known.next().filter(|first| known.all(|other| is_same(first, other)));
            Self { thickness: first, area: None }
        })
    }

    fn only(mut parts: impl ExactSizeIterator<Item = Self>) -> Option<Self> {
        if parts.len() == 1 { parts.next() } else { None }
    }
}

fn note(key: &'static str, [own, other]: [Size; 2], help: &str, faults: &Faults) {
    let dimension = if key == SIZE[0] { Dimension::LENGTH } else { AREA };
    let [found, expected] = [own, other].map(|size| format_short(size.value, dimension, 6));
    let place = faults.whereabouts(other.place);
    let fault = Fault::SizesDiffer { key, found, expected, place };
    faults.error(own.place, fault.with_help(help));
}

/// That `owner` has no thickness or area.
pub(crate) fn missing_size(key: &'static str, owner: &str) -> Fault {
    let example = if key == SIZE[0] { "2 cm" } else { "100 cm^2" };
    let help = format!(
        "a material becomes a pad by its thickness and area, for example `{key} = \"{example}\"`"
    );
    let (key, owner) = (key.to_owned(), owner.to_owned());
    Fault::MissingKey { key, owner, example: String::new() }.with_help(help)
}
