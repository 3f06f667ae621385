//! What the moduli of a material are, and what becomes of them in a pad that is loaded otherwise.

use dashpot_network::{
    Model, first_nonlinear,
    parameters::{Dimension, InvalidParameter},
};

use super::{ModelReader, context::Context};
use crate::{
    diagnostics::{Faults, fault::Fault},
    quantities::basis::{Basis, Loading},
    text::{
        document::Entry,
        library::models::{ModelSection, Reference},
        source::Place,
        table::text_of,
    },
};

/// Key of what the moduli of a material are.
pub(super) const MODULI: &str = "moduli";
pub(super) const POISSON: &str = "poisson";
/// What moduli may be: tensile or compressive with free sides, or those of simple shear.
const KINDS: [&str; 2] = ["compression", "shear"];
/// How a pad may be loaded.
const LOADINGS: [&str; 3] = ["compression", "shear", "confined"];

/// What a table of a material says about its moduli.
#[derive(Debug, Clone, Copy, Default)]
struct Moduli {
    is_of_shear: bool,
    /// Poisson's ratio, from above −1 to ½.
    poisson: Option<f64>,
}

impl Moduli {
    /// The modulus in this loading over that which is written: 1/(2(1+ν)) in shear of one in compression,
    /// 2(1+ν) the other way, and in compression with the sides held (1−ν)/((1+ν)(1−2ν)) of that with free ones.
    /// `None` where Poisson's ratio is needed and missing.
    fn factor(self, loading: Loading) -> Option<f64> {
        let shear = |ratio: f64| 0.5 / (1.0 + ratio);
        let confined = |ratio: f64| (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
        match (self.is_of_shear, loading) {
            (false, Loading::Compression) | (true, Loading::Shear) => Some(1.0),
            (false, Loading::Shear) => self.poisson.map(shear),
            (true, Loading::Compression) => self.poisson.map(|own| shear(own).recip()),
            (false, Loading::Confined) => self.poisson.map(confined),
            (true, Loading::Confined) => self.poisson.map(|own| confined(own) / shear(own)),
        }
    }
}

/// How the pad in a table is loaded, where it says so.
pub(super) fn loading(entry: &Entry, faults: &Faults) -> Option<Loading> {
    let at = word(entry, "a way of loading", &LOADINGS, faults)?;
    Some([Loading::Compression, Loading::Shear, Loading::Confined][at])
}

/// The position of the word in an entry among those that may stand there.
fn word(
    entry: &Entry,
    family: &str,
    known: &'static [&'static str],
    faults: &Faults,
) -> Option<usize> {
    let text = text_of(&entry.item, &format!("`{}`", entry.key), faults)?;
    let found = known.iter().position(|own| *own == text);
    if found.is_none() {
        let (family, word) = (family.to_owned(), text.to_owned());
        faults.error(entry.item.place, Fault::UnknownWord { family, word, known: known.to_vec() });
    }
    found
}

impl ModelReader<'_> {
    /// The context of the values in the table of a material, with the modulus that its pad wants.
    pub(super) fn in_loading(&self, reference: Reference, context: Context) -> Context {
        if reference.section != ModelSection::Materials {
            return context;
        }
        let entry = self.library.entry(reference);
        let entries = entry.item.table().unwrap_or(&[]);
        let find = |key: &str| entries.iter().find(|own| own.key == key);
        let named = find(ModelSection::Materials.word());
        if let (Some(_), Some(own)) = (named, find(MODULI).or(find(POISSON))) {
            let message = format!("`{}` stands beside a material that is named", own.key);
            let help = "write it in that material, beside the law with the values";
            self.faults.error(own.key_place, Fault::odd(message, help));
        }
        let moduli = Moduli {
            is_of_shear: find(MODULI)
                .and_then(|own| word(own, "what moduli are", &KINDS, self.faults))
                == Some(1),
            poisson: find(POISSON).and_then(|own| self.poisson(reference, own)),
        };
        let Basis::Material(pad) = context.basis else { return context };
        let Some((loading, place)) = pad.loading.filter(|_| named.is_none()) else {
            return context;
        };
        let factor = moduli.factor(loading).unwrap_or_else(|| {
            if find(POISSON).is_none() {
                self.missing_poisson(&entry.key, moduli, place);
            }
            1.0
        });
        let factor = if factor.is_finite() && factor > 0.0 {
            factor
        } else {
            let message = format!("`{}` does not give way where its sides are held", entry.key);
            let help = "with a `poisson` of 0.5 it keeps its volume: load it in \"compression\", or \
                        give a ratio below 0.5";
            self.faults.error(place, Fault::odd(message, help));
            1.0
        };
        Context { basis: Basis::Material(pad.with_factor(factor)), ..context }
    }

    fn poisson(&self, reference: Reference, entry: &Entry) -> Option<f64> {
        let quantities = self.library.quantities(reference.document, self.faults);
        let range = |ratio: f64| {
            let invalid = || InvalidParameter::new(POISSON, "above -1 and at most 0.5", ratio);
            if ratio > -1.0 && ratio <= 0.5 { Ok(()) } else { Err(invalid()) }
        };
        quantities.of(POISSON).read_checked(&entry.item, Dimension::NUMBER, range)
    }

    /// Notes that the modulus in a loading does not follow from that which is there.
    fn missing_poisson(&self, name: &str, moduli: Moduli, place: Place) {
        let [there, wanted] = if moduli.is_of_shear {
            ["moduli in shear", "in compression"]
        } else {
            ["moduli in compression", "in this loading"]
        };
        let message = format!(
            "material `{name}` has {there}, and no `poisson` to make those {wanted} of them"
        );
        let help = "write `poisson = 0.3` in the material, its own ratio; or `moduli = \"shear\"` if they \
                    are shear moduli, for a pad with `loaded = \"shear\"`";
        self.faults.error(place, Fault::odd(message, help));
    }

    /// Refuses a law that is not linear where its modulus would be that of another loading.
    pub(super) fn check_loading(&self, context: Context, model: Option<&Model>) {
        let Basis::Material(pad) = context.basis else { return };
        let (Some((_, place)), Some(leaf)) = (pad.loading, model.and_then(first_nonlinear)) else {
            return;
        };
        if pad.is_converted() {
            let message = format!(
                "`{}` is not linear: its curve in one loading does not follow from that in another",
                leaf.kind()
            );
            let help =
                "measure it as it is loaded, and write `moduli = \"shear\"` if that is in shear";
            self.faults.error(place, Fault::odd(message, help));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_follow_from_each_other_by_poissons_ratio() {
        for ratio in [-0.5, 0.0, 0.2, 0.3, 0.45] {
            let young = Moduli { is_of_shear: false, poisson: Some(ratio) };
            let shear = Moduli { is_of_shear: true, poisson: Some(ratio) };
            let of = |own: Moduli, loading| own.factor(loading).unwrap();
            // E = 9 K G/(3 K + G), and M = K + 4 G/3, by the bulk modulus K.
            let g = of(young, Loading::Shear);
            let bulk = 1.0 / (3.0 * (1.0 - 2.0 * ratio));
            let close = |one: f64, other: f64| (one / other - 1.0).abs() < 1e-14;
            assert!(close(9.0 * bulk * g / (3.0 * bulk + g), 1.0), "{ratio}");
            assert!(close(of(young, Loading::Confined), bulk + 4.0 * g / 3.0), "{ratio}");
            assert!(close(of(shear, Loading::Compression) * g, 1.0), "{ratio}");
            assert!(close(of(shear, Loading::Confined) * g, bulk + 4.0 * g / 3.0), "{ratio}");
        }
        let unknown = Moduli::default();
        assert_eq!(unknown.factor(Loading::Compression), Some(1.0));
        assert_eq!(
            (unknown.factor(Loading::Shear), unknown.factor(Loading::Confined)),
            (None, None)
        );
    }
}
