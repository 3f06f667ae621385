//! Named outputs, packed.
//!
//! A large network has some twelve of them for each of its masses. They lie one behind the other in a
//! few vectors: an output takes 24 bytes, its name and 12 bytes for each term.

use std::{fmt, sync::Arc};

use dashpot_numerics::{Forms, packed};

use crate::{FormRef, LinearForm};

/// A named scalar that a system can report: `scale · (unknowns·y + inputs·w)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output<'s> {
    /// Its name, for instance `padding.force`.
    pub name: &'s str,
    /// SI unit of the reported value.
    pub unit: &'static str,
    /// SI value of the dimensionless value 1.
    pub scale: f64,
    /// Coefficients over the unknowns.
    pub unknowns: FormRef<'s>,
    /// Coefficients over the inputs.
    pub inputs: FormRef<'s>,
}

/// The outputs of a system, numbered as they were added.
///
/// # Examples
///
/// ```
/// use dashpot_dae::{LinearForm, Outputs};
///
/// let mut outputs = Outputs::new();
/// let (rate, none) = (LinearForm::term(1, 0.5), LinearForm::zero());
/// let at = outputs.push("head.velocity", "m/s", 10.0, &rate, &none);
/// assert_eq!(outputs.find("head.velocity"), Some(at));
/// assert_eq!(outputs.at(at).unknowns.at(&[0.0, 3.0]), 1.5);
/// ```
#[derive(Clone, Default, PartialEq)]
pub struct Outputs {
    /// Shared by all copies: the intervals of a run have the same ones.
    packed: Arc<Packed>,
}

#[derive(Clone, Default, PartialEq)]
struct Packed {
    names: String,
    /// The units that occur.
    units: Vec<&'static str>,
    heads: Vec<Head>,
    scales: Vec<f64>,
    /// For each output that over its unknowns, then that over its inputs.
    forms: Forms,
}

/// Where the name of an output ends; it begins where that of the one before ends.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Head {
    name: u32,
    unit: u8,
}

impl Outputs {
    /// No outputs.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an output and returns its number.
    ///
    /// # Panics
    ///
    /// When there are more than 256 different units, or 2³² terms or bytes of names in all.
    pub fn push(
        &mut self,
        name: &str,
        unit: &'static str,
        scale: f64,
        unknowns: &LinearForm,
        inputs: &LinearForm,
    ) -> usize {
        let own = Arc::make_mut(&mut self.packed);
        let known = own.units.iter().position(|known| *known == unit);
        let unit = known.unwrap_or_else(|| {
            own.units.push(unit);
            own.units.len() - 1
        });
        own.names.push_str(name);
        own.forms.push(unknowns.terms().iter().copied());
        own.forms.push(inputs.terms().iter().copied());
        let unit = u8::try_from(unit).unwrap_or_else(|_| panic!("too many units"));
        own.heads.push(Head { name: packed(own.names.len()), unit });
        own.scales.push(scale);
        own.heads.len() - 1
    }

    /// Whether these are copies of one another.
    pub(crate) fn are_those(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.packed, &other.packed)
    }

    /// Gives back memory that was set aside for more.
    pub fn shrink_to_fit(&mut self) {
        let own = Arc::make_mut(&mut self.packed);
        own.names.shrink_to_fit();
        own.heads.shrink_to_fit();
        own.scales.shrink_to_fit();
        own.forms.shrink_to_fit();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.packed.heads.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.packed.heads.is_empty()
    }

    /// The output of this number, if there is one.
    pub fn get(&self, at: usize) -> Option<Output<'_>> {
        (at < self.len()).then(|| self.at(at))
    }

    /// The output of this number.
    ///
    /// # Panics
    ///
    /// When there are not so many.
    pub fn at(&self, at: usize) -> Output<'_> {
        let own = self.packed.as_ref();
        let head = own.heads[at];
        let before = at.checked_sub(1).map_or(Head::default(), |before| own.heads[before]);
        Output {
            name: &own.names[before.name as usize..head.name as usize],
            unit: own.units[usize::from(head.unit)],
            scale: own.scales[at],
            unknowns: own.forms.form(2 * at),
            inputs: own.forms.form(2 * at + 1),
        }
    }

    /// All outputs in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Output<'_>> + Clone {
        (0..self.len()).map(|at| self.at(at))
    }

    /// The number of the first output of this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.iter().position(|output| output.name == name)
    }
}

impl fmt::Debug for Outputs {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_come_back_as_they_were_added() {
        let mut outputs = Outputs::new();
        let form = |terms: &[(usize, f64)]| LinearForm::sum(terms.to_vec());
        let (first, second) = (form(&[(7, -2.0), (3, 0.5)]), form(&[(0, 4.0)]));
        outputs.push("a.force", "N", 2.0, &first, &second);
        outputs.push("b", "m", -1.0, &LinearForm::zero(), &first);
        outputs.push("µ.force", "N", 0.25, &second, &LinearForm::zero());
        outputs.shrink_to_fit();
        let found: Vec<_> =
            outputs.iter().map(|output| (output.name, output.unit, output.scale)).collect();
        assert_eq!(found, [("a.force", "N", 2.0), ("b", "m", -1.0), ("µ.force", "N", 0.25)]);
        assert_eq!(outputs.at(0).unknowns.to_form(), first);
        assert_eq!(outputs.at(0).inputs.to_form(), second);
        assert!(outputs.at(1).unknowns.is_zero() && outputs.at(2).inputs.is_zero());
        assert_eq!(outputs.at(1).inputs.to_form(), first);
        assert_eq!(outputs.find("µ.force"), Some(2));
        assert!(outputs.get(3).is_none() && outputs.find("a").is_none());
    }

    #[test]
    fn a_packed_form_has_the_values_of_its_own() {
        let form = LinearForm::sum(vec![(0, 1.0 / 3.0), (2, -7.0), (5, 1e-9)]);
        let mut outputs = Outputs::new();
        outputs.push("x", "1", 1.0, &form, &LinearForm::zero());
        let (packed, z) = (outputs.at(0).unknowns, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
        assert_eq!(packed.at(&z).to_bits(), form.at(&z).to_bits());
        assert_eq!(packed.magnitude_at(&z).to_bits(), form.magnitude_at(&z).to_bits());
        assert_eq!(packed.terms().collect::<Vec<_>>(), form.terms());
    }
}
