//! Named outputs, packed.
//!
//! A large network has some twelve of them for each of its masses. They lie one behind the other in a
//! few vectors: an output takes 16 bytes, the name of its owner once for all its outputs in a row, and its
//! terms 12 bytes each, unless they are those of one just before.

use std::{fmt, sync::Arc};

use dashpot_numerics::{Forms, packed};

use crate::{FormRef, LinearForm};

/// A named scalar that a system can report: `scale · (unknowns·y + inputs·w)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Output<'s> {
    /// Its name, for instance `padding.force`.
    pub name: OutputName<'s>,
    /// SI unit of the reported value.
    pub unit: &'static str,
    /// SI value of the dimensionless value 1.
    pub scale: f64,
    /// Coefficients over the unknowns.
    pub unknowns: FormRef<'s>,
    /// Coefficients over the inputs.
    pub inputs: FormRef<'s>,
}

/// The name of an output: that of its owner and, behind a point, the quantity, where it has both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OutputName<'s> {
    owner: &'s str,
    quantity: &'s str,
}

impl<'s> OutputName<'s> {
    fn of(name: &'s str) -> Self {
        let parts = name.rsplit_once('.').filter(|parts| !parts.1.is_empty());
        let (owner, quantity) = parts.unwrap_or((name, ""));
        Self { owner, quantity }
    }
}

impl fmt::Display for OutputName<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let point = if self.quantity.is_empty() { "" } else { "." };
        write!(formatter, "{}{point}{}", self.owner, self.quantity)
    }
}

impl PartialEq<str> for OutputName<'_> {
    fn eq(&self, name: &str) -> bool {
        *self == OutputName::of(name)
    }
}

impl PartialEq<&str> for OutputName<'_> {
    fn eq(&self, name: &&str) -> bool {
        *self == **name
    }
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
    /// The names of owners, where each ends, and what they own.
    owners: String,
    ends: Vec<u32>,
    quantities: Vec<Box<str>>,
    /// The units and scales that occur.
    units: Vec<&'static str>,
    scales: Vec<f64>,
    heads: Vec<Head>,
    /// For each output whose sum is another than before that over its unknowns, then that over its inputs.
    forms: Forms,
}

/// Outputs and scales before one of which one may be the same.
const LAST: usize = 32;
/// Sums before one of which one may be the same: of a spring and a dashpot side by side deformation and rate are.
const LAST_FORMS: u32 = 4;

/// Where the parts of an output stand.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Head {
    owner: u32,
    form: u32,
    scale: u32,
    quantity: u8,
    unit: u8,
}

/// The number of `own` in a list, to which it is added where it is not among the `last` ones.
fn number<T>(
    list: &mut Vec<T>,
    last: usize,
    is_own: impl Fn(&T) -> bool,
    own: impl FnOnce() -> T,
) -> usize {
    let behind = list.iter().rev().take(last).position(is_own);
    if behind.is_none() {
        list.push(own());
    }
    list.len() - 1 - behind.unwrap_or(0)
}

impl Packed {
    fn owner(&self, at: u32) -> &str {
        let at = at as usize;
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.owners[start as usize..self.ends[at] as usize]
    }

    /// The number of the owner of this name, which is the last one or a further one.
    fn push_owner(&mut self, owner: &str) -> u32 {
        let count = packed(self.ends.len());
        match count.checked_sub(1) {
            Some(last) if self.owner(last) == owner => last,
            _ => {
                self.owners.push_str(owner);
                self.ends.push(packed(self.owners.len()));
                count
            }
        }
    }

    /// The number of these forms.
    fn push_forms(&mut self, both: [&LinearForm; 2]) -> u32 {
        let count = packed(self.forms.len() / 2);
        let is_own = |own: FormRef<'_>, form: &LinearForm| {
            let same = |(one, other): ((usize, f64), &(usize, f64))| {
                one.0 == other.0 && one.1.to_bits() == other.1.to_bits()
            };
            own.terms().len() == form.terms().len() && own.terms().zip(form.terms()).all(same)
        };
        let is_same = |at: &u32| {
            (0..2).all(|part| is_own(self.forms.form(2 * *at as usize + part), both[part]))
        };
        let known = (count.saturating_sub(LAST_FORMS)..count).rev().find(is_same);
        known.unwrap_or_else(|| {
            both.iter().for_each(|form| self.forms.push(form.terms().iter().copied()));
            count
        })
    }
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
    /// When there are more than 256 different units or quantities, or 2³² terms or bytes of names in all.
    pub fn push(
        &mut self,
        name: &str,
        unit: &'static str,
        scale: f64,
        unknowns: &LinearForm,
        inputs: &LinearForm,
    ) -> usize {
        let own = Arc::make_mut(&mut self.packed);
        let name = OutputName::of(name);
        let one_byte = |number: usize, what: &str| {
            u8::try_from(number).unwrap_or_else(|_| panic!("too many {what}"))
        };
        let quantity = number(
            &mut own.quantities,
            usize::MAX,
            |known| **known == *name.quantity,
            || name.quantity.into(),
        );
        let unit = number(&mut own.units, usize::MAX, |known| *known == unit, || unit);
        let is_scale = |known: &f64| known.to_bits() == scale.to_bits();
        let head = Head {
            owner: own.push_owner(name.owner),
            form: own.push_forms([unknowns, inputs]),
            scale: packed(number(&mut own.scales, LAST, is_scale, || scale)),
            quantity: one_byte(quantity, "quantities"),
            unit: one_byte(unit, "units"),
        };
        own.heads.push(head);
        own.heads.len() - 1
    }

    /// Whether these are copies of one another.
    pub(crate) fn are_those(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.packed, &other.packed)
    }

    /// Gives back memory that was set aside for more.
    pub fn shrink_to_fit(&mut self) {
        let own = Arc::make_mut(&mut self.packed);
        own.owners.shrink_to_fit();
        own.ends.shrink_to_fit();
        own.heads.shrink_to_fit();
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
        let Head { owner, form, scale, quantity, unit } = own.heads[at];
        let (owner, quantity) = (own.owner(owner), &*own.quantities[usize::from(quantity)]);
        Output {
            name: OutputName { owner, quantity },
            unit: own.units[usize::from(unit)],
            scale: own.scales[scale as usize],
            unknowns: own.forms.form(2 * form as usize),
            inputs: own.forms.form(2 * form as usize + 1),
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
        let found: Vec<_> = outputs
            .iter()
            .map(|output| (output.name.to_string(), output.unit, output.scale))
            .collect();
        let wanted = [("a.force", "N", 2.0), ("b", "m", -1.0), ("µ.force", "N", 0.25)];
        assert_eq!(found, wanted.map(|(name, unit, scale)| (name.to_owned(), unit, scale)));
        assert_eq!(outputs.at(0).unknowns.to_form(), first);
        assert_eq!(outputs.at(0).inputs.to_form(), second);
        assert!(outputs.at(1).unknowns.is_zero() && outputs.at(2).inputs.is_zero());
        assert_eq!(outputs.at(1).inputs.to_form(), first);
        assert_eq!(outputs.find("µ.force"), Some(2));
        assert!(outputs.get(3).is_none() && outputs.find("a").is_none());
    }

    #[test]
    fn what_outputs_share_is_kept_once() {
        let mut outputs = Outputs::new();
        let (form, none) = (LinearForm::sum(vec![(3, 0.5), (7, -2.0)]), LinearForm::zero());
        let other = LinearForm::term(3, 0.5);
        for owner in ["a.spring", "a.dashpot", "a", "a."] {
            outputs.push(&format!("{owner}.force"), "N", 2.0, &other, &none);
            outputs.push(&format!("{owner}.deformation"), "m", 1.0, &form, &none);
        }
        outputs.push("a.", "m", 1.0, &none, &form);
        let own = &outputs.packed;
        assert_eq!((own.forms.len(), own.scales.len(), own.quantities.len()), (6, 2, 3));
        assert_eq!((own.ends.len(), own.owners.as_str()), (4, "a.springa.dashpotaa."));
        let name = |at| outputs.at(at).name;
        assert!(name(3) == "a.dashpot.deformation" && name(6) == "a..force" && name(8) == "a.");
        assert!(name(5) != "adeformation" && name(5) != "a");
        assert_eq!(name(4).to_string(), "a.force");
        assert_eq!(outputs.at(8).inputs.to_form(), form);
        assert_eq!((outputs.at(5).unknowns.to_form(), outputs.at(5).scale), (form, 1.0));
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
