//! The parameters of a network, and a complete set of independent groups of them.

use std::{collections::BTreeMap, fmt::Write as _};

use dashpot_network::{
    Network, Start,
    parameters::{Dimension, InvalidParameter},
};

use super::{
    scale::Basis,
    walk::{Visit, walk},
};

/// A parameter that is a unit for others.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Its letter in formulas.
    pub symbol: &'static str,
    /// What it is; its magnitude is the unit.
    pub quantity: Quantity,
}

/// A parameter over its product of powers of the references.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The parameter.
    pub quantity: Quantity,
    /// What it is, for instance `padding.maxwell.spring δ²/(m V²)`.
    pub formula: String,
    /// Its value, a number; 0 where the parameter is.
    pub value: f64,
}

/// The references of a network and its groups.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// The references: as many as the rank of the dimensions.
    pub references: Vec<Reference>,
    /// The groups, one for each other parameter.
    pub groups: Vec<Group>,
    pub(super) basis: Basis,
}

/// Letters of references by their dimension.
const SYMBOLS: [(Dimension, &str); 10] = [
    (Dimension::MASS, "m"),
    (Dimension::VELOCITY, "V"),
    (Dimension::LENGTH, "δ"),
    (Dimension::STIFFNESS, "K"),
    (Dimension::DAMPING, "C"),
    (Dimension::FORCE, "F"),
    (Dimension::TIME, "T"),
    (Dimension::ACCELERATION, "g"),
    (Dimension::FREQUENCY, "ω"),
    (Dimension::TEMPERATURE, "Θ"),
];

impl Groups {
    /// The groups of a network. The references are the mass and the speed of the first impactor and
    /// the thickness of what it strikes, as far as there are any, then stiffnesses and whatever else
    /// is independent of these and not zero.
    ///
    /// # Errors
    ///
    /// A value of the network that is out of range.
    pub fn of(network: &Network) -> Result<Self, InvalidParameter> {
        let inventory = Inventory::of(network)?;
        let mut basis = Basis::default();
        let mut references = Vec::new();
        for quantity in candidates(network, &inventory) {
            let is_unit = quantity.value != 0.0 && quantity.dimension != Dimension::NUMBER;
            if is_unit && basis.take(quantity.dimension) {
                let symbol = SYMBOLS.iter().find(|own| own.0 == quantity.dimension);
                let symbol = symbol.map_or("q", |symbol| symbol.1);
                references.push(Reference { symbol, quantity: quantity.clone() });
            }
        }
        let mut groups = Self { references, groups: Vec::new(), basis };
        for quantity in inventory.quantities {
            if groups.references.iter().any(|reference| reference.quantity.name == quantity.name) {
                continue;
            }
            let (value, formula) = (groups.number(&quantity), groups.formula(&quantity));
            groups.groups.push(Group { quantity, formula, value });
        }
        Ok(groups)
    }

    /// How many independent dimensions the parameters have.
    pub fn rank(&self) -> usize {
        self.basis.len()
    }

    /// The group of this parameter.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups.iter().find(|group| group.quantity.name == name)
    }

    /// The product of powers of the references that has a dimension. Zero values alone have
    /// dimensions that the references do not make up; they have none.
    pub fn unit(&self, dimension: Dimension) -> Option<f64> {
        let values: Vec<f64> =
            self.references.iter().map(|reference| reference.quantity.value.abs()).collect();
        self.basis.product(&values, dimension)
    }

    fn number(&self, quantity: &Quantity) -> f64 {
        if quantity.value == 0.0 {
            return 0.0;
        }
        self.unit(quantity.dimension).map_or(f64::NAN, |unit| quantity.value / unit)
    }

    fn formula(&self, quantity: &Quantity) -> String {
        let mut text = quantity.name.clone();
        let Some(exponents) = self.basis.exponents(quantity.dimension) else { return text };
        let powers = |sign: f64| -> Vec<String> {
            let all =
                self.references.iter().zip(&exponents).map(|(own, power)| (own, sign * power));
            all.filter(|own| own.1 > 0.0).map(|(own, power)| raised(own.symbol, power)).collect()
        };
        let (above, below) = (powers(-1.0), powers(1.0));
        if !above.is_empty() {
            let _ = write!(text, " {}", above.join(" "));
        }
        match below.as_slice() {
            [] => {}
            [only] => {
                let _ = write!(text, "/{only}");
            }
            all => {
                let _ = write!(text, "/({})", all.join(" "));
            }
        }
        text
    }
}

fn raised(symbol: &str, exponent: f64) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let whole = (1_u8..10).find(|own| (f64::from(*own) - exponent).abs() < f64::EPSILON);
    match whole {
        Some(1) => symbol.to_owned(),
        Some(own) => format!("{symbol}{}", DIGITS[usize::from(own)]),
        None => {
            let parts = (2_u8..=24).find(|own| (exponent * f64::from(*own)).fract() == 0.0);
            match parts {
                Some(parts) => format!("{symbol}^({}/{parts})", exponent * f64::from(parts)),
                None => format!("{symbol}^{exponent}"),
            }
        }
    }
}

/// The parameters in the order in which they are taken as references.
fn candidates<'i>(network: &Network, inventory: &'i Inventory) -> Vec<&'i Quantity> {
    let mut names = Vec::new();
    let impactor = network.nodes().find(|(_, node)| node.start != Start::Rest && node.mass > 0.0);
    if let Some((id, node)) = impactor {
        names.extend([format!("{}.mass", node.name), format!("{}.velocity", node.name)]);
        let struck =
            network.connections().iter().filter(|connection| connection.between.contains(&id));
        names.extend(struck.map(|struck| format!("{}.thickness", struck.name)));
    }
    let of_dimension = |dimension| {
        inventory.quantities.iter().filter(move |quantity| quantity.dimension == dimension)
    };
    let named = names.iter().filter_map(|name| inventory.quantity(name));
    let thick = of_dimension(Dimension::LENGTH).filter(|own| own.name.ends_with(".thickness"));
    named
        .chain(thick)
        .chain(of_dimension(Dimension::MASS))
        .chain(of_dimension(Dimension::STIFFNESS))
        .chain(of_dimension(Dimension::DAMPING))
        .chain(&inventory.quantities)
        .collect()
}

/// A parameter of a network.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Its name, for instance `padding.maxwell.spring`.
    pub name: String,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its value, in SI units.
    pub value: f64,
    /// What all points of a curve have together, of one of them: `pad.table-spring.y`.
    pub of_curve: Option<String>,
}

/// All parameters of a network, and its structure.
///
/// A height of fall counts by the speed at touch. The duration of the run is no parameter of the network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Inventory {
    /// The parameters, in the order of nodes, elements, loads and effects.
    pub quantities: Vec<Quantity>,
    /// What is no number, by name: kinds, words, what stands between what.
    pub structure: BTreeMap<String, String>,
}

impl Inventory {
    /// The parameters and the structure of a network.
    ///
    /// # Errors
    ///
    /// A value of the network that is out of range.
    pub fn of(network: &Network) -> Result<Self, InvalidParameter> {
        let mut inventory = Self::default();
        walk(network, &mut inventory)?;
        Ok(inventory)
    }

    /// The parameter of this name.
    pub fn quantity(&self, name: &str) -> Option<&Quantity> {
        self.quantities.iter().find(|quantity| quantity.name == name)
    }

    pub(super) fn names(&self) -> Vec<&str> {
        let words = self.structure.keys().map(String::as_str);
        let mut names: Vec<&str> =
            self.quantities.iter().map(|quantity| quantity.name.as_str()).chain(words).collect();
        names.sort_unstable();
        names
    }
}

impl Visit for Inventory {
    fn quantity(&mut self, name: &str, dimension: Dimension, value: f64) -> f64 {
        self.quantities.push(Quantity { name: name.to_owned(), dimension, value, of_curve: None });
        value
    }

    fn point(
        &mut self,
        curve: &str,
        (at, axis): (usize, &str),
        dimension: Dimension,
        value: f64,
    ) -> f64 {
        let (name, of_curve) = (format!("{curve}[{at}].{axis}"), Some(format!("{curve}.{axis}")));
        self.quantities.push(Quantity { name, dimension, value, of_curve });
        value
    }

    fn word(&mut self, name: &str, word: &str) {
        self.structure.insert(name.to_owned(), word.to_owned());
    }
}

/// The network with another value of one parameter. Errors: a value that is out of range.
pub(super) fn with_value(
    network: &Network,
    name: &str,
    value: f64,
) -> Result<Network, InvalidParameter> {
    struct Put<'n>(&'n str, f64);
    impl Visit for Put<'_> {
        fn quantity(&mut self, name: &str, _dimension: Dimension, value: f64) -> f64 {
            if name == self.0 { self.1 } else { value }
        }
    }
    walk(network, &mut Put(name, value))
}
