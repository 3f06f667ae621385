//! Thicknesses and areas of pads, and where they contradict each other.

use dashpot_network::parameters::Dimension;
use dashpot_units::format_short;

use super::basis::{AREA, Pad, SIZE};
use crate::{
    diagnostics::{Faults, fault::Fault},
    text::source::Place,
};

/// Two sizes that differ by less, in parts of themselves, are one that is written in two units.
const SAME: f64 = 1e-9;

/// A thickness \[m\] or area \[m²\], and where it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Size {
    pub(crate) value: f64,
    pub(crate) place: Place,
}

/// What the tables around a law say about the size of its pad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct EnclosingPad {
    /// What stands beside the law, by the order of [`SIZE`].
    pub(crate) beside: [Option<Size>; 2],
    /// Whether what stands there is faulty, which has been told.
    pub(crate) is_faulty: [bool; 2],
    /// The thickness of the element of which the law is a part.
    pub(crate) around: Option<Size>,
    /// Its area \[m²\].
    pub(crate) around_area: Option<f64>,
    /// Whether it is one of several parts in a row, which are thinner than the whole.
    pub(crate) in_row: bool,
}

impl EnclosingPad {
    /// What stands beside the law under one of the keys [`SIZE`].
    pub(crate) fn beside(&self, key: &str) -> Option<Size> {
        SIZE.iter().position(|known| *known == key).and_then(|at| self.beside[at])
    }

    /// The size of the element around the law, which stands at `place`, under one of the keys [`SIZE`], where the law lies
    /// between the same ends.
    pub(crate) fn around(&self, key: &str, place: Place) -> Option<Size> {
        let area = self.around_area.map(|value| Size { value, place });
        if key == SIZE[0] { self.around } else { area }.filter(|_| !self.in_row)
    }

    /// What is wrong where `owner` has no size of its own under this key.
    pub(crate) fn missing(&self, key: &'static str, owner: &str) -> Option<Fault> {
        let at = SIZE.iter().position(|known| *known == key);
        if at.is_some_and(|at| self.is_faulty[at]) {
            return None;
        }
        let example = if key == SIZE[0] { "2 cm" } else { "100 cm^2" };
        let what = if self.in_row {
            "each part of a `series` has a thickness and an area of its own, beside its law"
        } else if self.around.is_some() && key == SIZE[1] {
            "each of several parts side by side has an area of its own, in the table of its law"
        } else {
            "a material becomes a pad by its thickness and area"
        };
        let help = format!("{what}, for example `{key} = \"{example}\"`");
        let (key, owner) = (key.to_owned(), owner.to_owned());
        Some(Fault::MissingKey { key, owner, example: String::new() }.with_help(help))
    }

    /// Notes where the size `own` of a part contradicts what stands around it.
    pub(crate) fn check(&self, key: &'static str, size: Size, faults: &Faults) {
        if size.value <= 0.0 {
            return;
        }
        if let Some(other) = self.beside(key)
            && (size.value - other.value).abs() > SAME * other.value
        {
            note(key, [size, other], "both are that of one pad: give it once", faults);
        }
        let Some(whole) = self.around.filter(|_| key == SIZE[0]) else { return };
        let excess = size.value - whole.value;
        if self.in_row && excess > SAME * whole.value {
            note(key, [size, whole], "a part in series is no thicker than the whole", faults);
        } else if !self.in_row && excess.abs() > SAME * whole.value {
            let help = "what lies between the same ends has one thickness: correct one, or leave \
                        that of the element out";
            note(key, [size, whole], help, faults);
        }
    }
}

/// The size of what a model stands for, where it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    /// Thickness h \[m\].
    pub(crate) thickness: Option<f64>,
    /// Area A \[m²\].
    pub(crate) area: Option<f64>,
    /// Thickness of those parts that have one \[m\]: no pad is thinner.
    pub(crate) least: f64,
}

impl Extent {
    /// That of what no size is known of.
    pub(crate) const UNKNOWN: Self = Self { thickness: None, area: None, least: 0.0 };

    pub(crate) fn of(Pad { thickness, area, .. }: Pad) -> Self {
        Self { thickness: Some(thickness), area: Some(area), least: thickness }
    }

    /// That of parts in a row: as thick as all together where each of them has a thickness, and with
    /// the area that each of them has.
    pub(crate) fn in_row(parts: impl ExactSizeIterator<Item = Self> + Clone) -> Self {
        let least = parts.clone().map(|part| part.least).sum();
        let thickness = parts.clone().map(|part| part.thickness).sum();
        Self { thickness, area: same(parts.map(|part| part.area)), least }
    }

    /// That of parts side by side: the thickness of those that have one. On what area the force of
    /// all of them acts, they do not say.
    pub(crate) fn beside(parts: impl ExactSizeIterator<Item = Self> + Clone) -> Self {
        let area = if parts.len() == 1 { parts.clone().find_map(|part| part.area) } else { None };
        let thickness = same(parts.clone().filter_map(|part| part.thickness).map(Some));
        let least = parts.map(|part| part.least).fold(0.0, f64::max);
        Self { thickness, area, least }
    }

    /// Warns where the size that is given for the whole is not that of the parts in it.
    pub(crate) fn check(&self, owner: &str, [thickness, area]: [Option<Size>; 2], faults: &Faults) {
        let differs = |size: Size, own: f64| (size.value - own).abs() > SAME * own;
        let tell = |size: Size, key: &str, dimension, own: f64, why: &str| {
            let [given, own] = [size.value, own].map(|size| format_short(size, dimension, 6));
            let message = format!("`{key}` of {owner} is {given}, but {why} {own}");
            let help = format!("leave `{key}` of {owner} out, or correct one of them");
            faults.warning(size.place, Fault::odd(message, help));
        };
        if let Some(size) = thickness {
            let parts = self.thickness.filter(|thickness| differs(size, *thickness));
            let least = Some(self.least).filter(|own| size.value < (1.0 - SAME) * own);
            if let Some(own) = parts.or(least) {
                let why = "its parts together have";
                tell(size, SIZE[0], Dimension::LENGTH, own, why);
            }
        }
        if let Some((size, own)) = area.zip(self.area).filter(|(size, own)| differs(*size, *own)) {
            tell(size, SIZE[1], AREA, own, "each of its parts has");
        }
    }
}

/// The size of all, where it is one.
fn same(mut all: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let first = all.next()??;
    all.all(|own| own.is_some_and(|own| (own - first).abs() <= SAME * first)).then_some(first)
}

fn note(key: &'static str, [own, other]: [Size; 2], help: &str, faults: &Faults) {
    let dimension = if key == SIZE[0] { Dimension::LENGTH } else { AREA };
    let [found, expected] = [own, other].map(|size| format_short(size.value, dimension, 6));
    let place = faults.whereabouts(other.place);
    let fault = Fault::SizesDiffer { key, found, expected, place };
    faults.error(own.place, fault.with_help(help));
}
