//! Whether two networks are similar.

use dashpot_network::{Network, parameters::InvalidParameter};

use super::{
    groups::{Group, Groups},
    inventory::Inventory,
    names::renamed,
    scale::Scale,
};

/// A group of two networks.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupPair {
    /// The parameter that it belongs to.
    pub name: String,
    /// What it is.
    pub formula: String,
    /// Its values in both; a parameter that one of them does not have counts as 0 there.
    pub values: [f64; 2],
    /// How far they are apart, over the larger one.
    pub apart: f64,
}

impl GroupPair {
    /// Whether they are further apart than this; what is not a number always is.
    pub fn is_apart(&self, within: f64) -> bool {
        self.apart > within || self.apart.is_nan()
    }
}

/// Two networks side by side.
#[derive(Debug, Clone)]
pub struct Similarity {
    /// What is built in another way, in words; none where both have one structure.
    pub structure: Vec<String>,
    /// All groups of the first one, with those of the second.
    pub groups: Vec<GroupPair>,
    /// From the first network to the second one: by the references of the first.
    pub scale: Scale,
    /// Groups that are apart by no more than this are equal.
    pub within: f64,
    /// The references and groups of the first one.
    pub first: Groups,
    /// The second network with the names of the first.
    pub second: Network,
}

impl Similarity {
    /// Groups are equal within this, if nothing else is said.
    pub const WITHIN: f64 = 1e-12;

    /// Compares two networks. Nodes, elements and branches with other names are taken by their
    /// places.
    ///
    /// # Errors
    ///
    /// A value of one of them that is out of range.
    pub fn between(
        first: &Network,
        second: &Network,
        within: f64,
    ) -> Result<Self, InvalidParameter> {
        let own = Inventory::of(first)?;
        let mut second = second.clone();
        let mut other = Inventory::of(&second)?;
        if own.names() != other.names()
            && let Some(again) = renamed(&second, first)?
        {
            second = again;
            other = Inventory::of(&second)?;
        }
        let mut structure = differences(&own, &other);
        let groups = Groups::of(first)?;
        let mut factors = Vec::new();
        let mut units = Vec::new();
        for reference in &groups.references {
            let quantity = &reference.quantity;
            let value = other.quantity(&quantity.name).map_or(0.0, |own| own.value);
            if value * quantity.value > 0.0 {
                factors.push((quantity.dimension, value / quantity.value));
            } else {
                let name = &quantity.name;
                structure.push(if value == 0.0 {
                    format!("`{name}` is not there, or zero, in the second")
                } else {
                    format!("`{name}` has the other sign in the second")
                });
            }
            units.push(value.abs());
        }
        let pair = |group: &Group| {
            let quantity = other.quantity(&group.quantity.name);
            let value = quantity.map_or(0.0, |own| own.value);
            let unit = groups.basis.product(&units, group.quantity.dimension);
            let value = match unit {
                Some(unit) if value != 0.0 => value / unit,
                _ => value,
            };
            GroupPair {
                name: group.quantity.name.clone(),
                formula: group.formula.clone(),
                values: [group.value, value],
                apart: apart(group.value, value),
            }
        };
        let pairs = groups.groups.iter().map(pair).collect();
        Ok(Self {
            structure,
            groups: pairs,
            scale: Scale::from_factors(&factors),
            within,
            first: groups,
            second,
        })
    }

    /// Whether both have one structure and equal groups.
    pub fn is_similar(&self) -> bool {
        self.structure.is_empty() && self.different().next().is_none()
    }

    /// The groups that differ.
    pub fn different(&self) -> impl Iterator<Item = &GroupPair> {
        self.groups.iter().filter(|own| own.is_apart(self.within))
    }
}

/// The difference of two numbers over the larger one.
fn apart(one: f64, other: f64) -> f64 {
    let size = one.abs().max(other.abs());
    if size == 0.0 { 0.0 } else { (one - other).abs() / size }
}

/// What is built in another way.
fn differences(first: &Inventory, second: &Inventory) -> Vec<String> {
    let mut all = Vec::new();
    for (name, word) in &first.structure {
        match second.structure.get(name) {
            Some(other) if other == word => {}
            Some(other) => {
                all.push(format!("`{name}` is {word} in the first, {other} in the second"));
            }
            None => all.push(format!("`{name}` ({word}) is in the first only")),
        }
    }
    let added = second.structure.iter().filter(|own| !first.structure.contains_key(own.0));
    all.extend(added.map(|(name, word)| format!("`{name}` ({word}) is in the second only")));
    let missing = |own: &Inventory, other: &Inventory, word: &str| -> Vec<String> {
        let names = own.quantities.iter().filter(|own| other.quantity(&own.name).is_none());
        names.map(|own| format!("`{}` is in the {word} only", own.name)).collect()
    };
    all.extend(missing(first, second, "first"));
    all.extend(missing(second, first, "second"));
    all
}
