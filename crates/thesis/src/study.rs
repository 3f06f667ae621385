//! The impacts that everything else is read off: the base and families with one parameter varied.

use dashpot_numerics::roots::false_position;
use dashpot_report::Table;

use crate::{
    Groups, Impact, Padding, Scales, Support, ThesisError,
    words::{extremes, short, significant},
};

/// A parameter that is varied, all others at base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varied {
    /// The group a.
    A,
    /// The group b.
    B,
    /// The group c, and e with it.
    C,
    /// The group d.
    D,
    /// The spring K₁.
    K1,
    /// The spring K₂.
    K2,
    /// The dashpot C₁.
    C1,
    /// The dashpot C₂.
    C2,
}

/// Impacts that differ in one parameter.
#[derive(Debug)]
pub struct Family {
    /// Which one.
    pub varied: Varied,
    /// Its values, rising, with their impacts.
    pub members: [Member; 5],
}

/// An impact of a family.
#[derive(Debug)]
pub struct Member {
    /// The value of what is varied: a number for groups, SI units for K₁ … C₂.
    pub value: f64,
    /// The impact.
    pub impact: Impact,
}

/// The impacts that are compared.
#[derive(Debug)]
pub struct Study {
    /// The groups that chapter IV prints, α = 0.2.
    pub printed: Impact,
    /// The same with α = 200, which follows from the C₃ that is printed.
    pub printed_stiff: Impact,
    /// The system parameters that chapter IV prints, with C₃ = 10 kN s/m.
    pub system: Impact,
    /// The same with the C₃ that is printed, 10 MN s/m.
    pub system_stiff: Impact,
    /// Families of a, b, c and d around the printed groups.
    pub groups: [Family; 4],
    /// Families of K₁, K₂, C₁ and C₂ around the system parameters.
    pub constants: [Family; 4],
}

impl Varied {
    /// Its symbol.
    pub fn symbol(self) -> &'static str {
        ["a", "b", "c", "d", "K1", "K2", "C1", "C2"][self as usize]
    }

    /// The values of its family, the base among them. Those of the thesis' figures are lost, so they are chosen: on
    /// both sides of the base, and for b and d once beyond the thickness. C₂ keeps to the range that chapter V gives.
    pub fn values(self) -> [f64; 5] {
        match self {
            Self::A => [20.0, 23.0, 26.6, 30.0, 35.0],
            Self::B => [50.0, 58.0, 66.66, 75.0, 80.0],
            Self::C => [5.0, 6.5, 8.0, 10.0, 12.0],
            Self::D => [60.0, 70.0, 80.0, 90.0, 100.0],
            Self::K1 | Self::K2 => [10e6, 15e6, 20e6, 25e6, 30e6],
            Self::C1 => [2e3, 3e3, 4e3, 5e3, 6e3],
            Self::C2 => [5150.0, 5600.0, 6000.0, 6800.0, 7600.0],
        }
    }

    /// The impact with this value and all else at base.
    ///
    /// # Errors
    ///
    /// As [`Impact::of_groups`].
    pub fn impact(self, value: f64) -> Result<Impact, ThesisError> {
        let (base, pad) = (Groups::PRINTED, Padding::CHAPTER_4);
        let system = |padding: Padding| Impact::of_system(&padding, &Support::CHAPTER_4);
        match self {
            Self::A => Impact::of_groups(&Groups { a: value, ..base }),
            Self::B => Impact::of_groups(&Groups { b: value, ..base }),
            Self::C => Impact::of_groups(&Groups { c: value, ..base }),
            Self::D => Impact::of_groups(&Groups { d: value, ..base }),
            Self::K1 => system(Padding { k1: value, ..pad }),
            Self::K2 => system(Padding { k2: value, ..pad }),
            Self::C1 => system(Padding { c1: value, ..pad }),
            Self::C2 => system(Padding { c2: value, ..pad }),
        }
    }

    /// A value as text with its unit.
    pub fn text(self, value: f64) -> String {
        match self {
            Self::A | Self::B | Self::C | Self::D => short(value, 6),
            Self::K1 | Self::K2 => format!("{} MN/m", short(value / 1e6, 6)),
            Self::C1 | Self::C2 => format!("{} kN s/m", short(value / 1e3, 6)),
        }
    }

    /// It and a value of it: `K1 = 10 MN/m`.
    pub(crate) fn equals(self, value: f64) -> String {
        format!("{} = {}", self.symbol(), self.text(value))
    }

    fn family(self) -> Result<Family, ThesisError> {
        let member = |value| Ok::<_, ThesisError>(Member { value, impact: self.impact(value)? });
        let [a, b, c, d, e] = self.values().map(member);
        Ok(Family { varied: self, members: [a?, b?, c?, d?, e?] })
    }

    /// The value between two, on different sides of it, at which the largest deformation is the
    /// thickness, to nine digits; `None` where both are on one side.
    ///
    /// # Errors
    ///
    /// As [`Impact::of_groups`].
    pub fn limit(self, low: f64, high: f64) -> Result<Option<f64>, ThesisError> {
        let excess = |value| Ok::<f64, ThesisError>(self.impact(value)?.deepest().value - 1.0);
        let (low, high) = ((low, excess(low)?), (high, excess(high)?));
        if low.1 * high.1 > 0.0 {
            return Ok(None);
        }
        let [low, high] = false_position(excess, low, high, 1e-9)?;
        Ok(Some(if low.1.abs() < high.1.abs() { low.0 } else { high.0 }))
    }
}

impl Study {
    /// Solves all of it.
    ///
    /// # Errors
    ///
    /// As [`Impact::of_groups`]; the values are such that there are none.
    pub fn new() -> Result<Self, ThesisError> {
        use Varied::{A, B, C, C1, C2, D, K1, K2};
        let (base, pad) = (Groups::PRINTED, Padding::CHAPTER_4);
        let families = |of: [Varied; 4]| {
            let [a, b, c, d] = of.map(Varied::family);
            Ok::<_, ThesisError>([a?, b?, c?, d?])
        };
        Ok(Self {
            printed: Impact::of_groups(&base)?,
            printed_stiff: Impact::of_groups(&Groups { alpha: 200.0, ..base })?,
            system: Impact::of_system(&pad, &Support::CHAPTER_4)?,
            system_stiff: Impact::of_system(&pad, &Support::CHAPTER_4_STIFF)?,
            groups: families([A, B, C, D])?,
            constants: families([K1, K2, C1, C2])?,
        })
    }

    /// All families.
    pub fn families(&self) -> impl Iterator<Item = &Family> {
        self.groups.iter().chain(&self.constants)
    }

    /// The members of all families, each by its parameter and value.
    pub(crate) fn members(&self) -> impl Iterator<Item = (String, &Impact)> {
        self.families().flat_map(|family| {
            let members = family.members.iter();
            members.map(|member| (family.varied.equals(member.value), &member.impact))
        })
    }

    /// The family of a parameter.
    pub fn family(&self, varied: Varied) -> &Family {
        let at = varied as usize;
        self.groups.get(at).unwrap_or_else(|| &self.constants[at - self.groups.len()])
    }

    /// The largest change of the energy at a time \[s\] over the family of each group, relative to its base.
    pub fn energy_changes(&self, time: f64) -> [(&'static str, f64); 4] {
        let tau = time / Scales::CHAPTER_4.time();
        let base = self.printed.energy(tau);
        let change = |family: &Family| {
            let [low, high] = extremes(family.each(|own| own.energy(tau)));
            (family.varied.symbol(), (high - low) / base)
        };
        self.groups.each_ref().map(change)
    }
}

impl Family {
    /// What a quantity is of each member.
    pub fn each<T>(&self, of: impl Fn(&Impact) -> T) -> [T; 5] {
        self.members.each_ref().map(|member| of(&member.impact))
    }

    /// The table that belongs to the figures: padding, q and measures of each member.
    pub fn table(&self) -> Table {
        let symbol = self.varied.symbol();
        let padding = ["K1 MN/m", "C1 kN s/m", "K2 MN/m", "C2 kN s/m", "q"];
        let measures = ["φ max", "at τ*", "ξ max", "at τ*", "release τ*", "thickness"];
        let header = [symbol].into_iter().chain(padding).chain(measures);
        Table::new(
            format!("The family of {symbol}, all else at base"),
            header,
            self.members.iter().map(|member| member.row(self.varied)),
        )
    }
}

impl Member {
    /// Whether the padding would be pressed by more than its thickness.
    pub fn exceeds(&self) -> bool {
        self.impact.deepest().value > 1.0
    }

    /// The padding in SI units, as it is in chapter IV.
    pub fn padding(&self) -> Option<Padding> {
        self.impact.groups.padding(&Scales::CHAPTER_4).ok()
    }

    fn row(&self, varied: Varied) -> Vec<String> {
        let number = |value: f64| significant(value, 4);
        let [k1, c1, k2, c2] = self
            .padding()
            .map_or([f64::NAN; 4], |own| [own.k1 / 1e6, own.c1 / 1e3, own.k2 / 1e6, own.c2 / 1e3]);
        let (own, q) = (&self.impact, self.impact.groups.q());
        let (peak, deepest) = (own.peak(), own.deepest());
        let values = [k1, c1, k2, c2, q, peak.value, peak.time, deepest.value, deepest.time];
        let release = own.release().map_or_else(|| "–".to_owned(), number);
        let exceeds = if self.exceeds() { "exceeds" } else { "within" }.to_owned();
        let values = values.map(number).into_iter().chain([release, exceeds]);
        [varied.text(self.value)].into_iter().chain(values).collect()
    }
}
