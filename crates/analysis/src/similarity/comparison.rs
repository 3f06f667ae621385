//! Whether two networks are similar.

use dashpot_network::{Network, parameters::InvalidParameter};
use serde::Serialize;

use super::{
    groups::{Group, Groups, Inventory},
    names::renamed,
    scale::Scale,
    views::{completed, drawn_as_burgers, mirrored, sorted},
};

/// A group of two networks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroupPair {
    /// The parameter that it belongs to.
    #[serde(rename = "parameter")]
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
    /// Both networks as they are compared, the second one with the names of the first.
    pub networks: [Network; 2],
}

impl Similarity {
    /// Groups are equal within this, if nothing else is said.
    pub const WITHIN: f64 = 1e-12;
    /// Constants of a model that is drawn in another way agree within this.
    pub const DRAWN: f64 = 1e-11;

    /// Compares two networks. Nodes, elements and branches with other names are taken by their places.
    ///
    /// What one can draw in several ways is one: the order of branches; a four-parameter padding as a
    /// Burgers model or as two Maxwell elements, whose constants are compared within
    /// [`DRAWN`](Self::DRAWN) if `within` is less; the whole seen from the other side. Gravity and
    /// mass on a face that are not there count as 0.
    ///
    /// # Errors
    ///
    /// A value of one of them that is out of range.
    pub fn between(
        first: &Network,
        second: &Network,
        within: f64,
    ) -> Result<Self, InvalidParameter> {
        let mut best = Self::as_drawn(first, second, within)?;
        if best.is_similar() {
            return Ok(best);
        }
        let first = &completed(first, second)?;
        let second = &completed(second, first)?;
        for second in [second.clone(), mirrored(second)] {
            let drawn = drawn_as_burgers(first).zip(drawn_as_burgers(&second));
            let ordered = sorted(first, None);
            let like = sorted(&second, Some(&ordered));
            let views = [
                Some((first.clone(), second.clone(), within)),
                Some((ordered, like, within)),
                drawn.map(|(one, other)| (one, other, within.max(Self::DRAWN))),
            ];
            for (first, second, within) in views.into_iter().flatten() {
                let found = Self::as_drawn(&first, &second, within)?;
                if found.is_similar() {
                    return Ok(found);
                }
                if found.structure.len() < best.structure.len() {
                    best = found;
                }
            }
        }
        Ok(best)
    }

    /// Compares two networks as they are drawn.
    fn as_drawn(first: &Network, second: &Network, within: f64) -> Result<Self, InvalidParameter> {
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
            let value = quantity.map_or(0.0, |quantity| quantity.value);
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
            networks: [first.clone(), second],
        })
    }

    /// Whether both have one structure and equal groups.
    pub fn is_similar(&self) -> bool {
        self.structure.is_empty() && self.different().next().is_none()
    }

    /// Whether effects are all that is built in another way.
    pub fn differs_in_effects(&self) -> bool {
        let effects = self.networks.iter().flat_map(Network::effects);
        let names: Vec<String> = effects
            .map(|effect| match effect.target() {
                Some(target) => format!("`{}.{target}", effect.kind()),
                None => format!("`{}", effect.kind()),
            })
            .collect();
        let is_of_effect = |line: &String| names.iter().any(|name| line.starts_with(name.as_str()));
        !self.structure.is_empty() && self.structure.iter().all(is_of_effect)
    }

    /// The groups that differ.
    pub fn different(&self) -> impl Iterator<Item = &GroupPair> {
        self.groups.iter().filter(|group| group.is_apart(self.within))
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
        if let Some(other) = second.structure.get(name).filter(|own| *own != word) {
            all.push(format!("`{name}` is {word} in the first, {other} in the second"));
        }
    }
    all.extend(alone(first, second).map(|own| format!("{own} is in the first only")));
    all.extend(alone(second, first).map(|own| format!("{own} is in the second only")));
    all
}

/// What one has and the other has not; of a thing and what it says, the thing alone.
fn alone<'i>(inventory: &'i Inventory, other: &'i Inventory) -> impl Iterator<Item = String> + 'i {
    let is_new = |name: &str| other.quantity(name).is_none() && !other.structure.contains_key(name);
    let is_part = move |name: &str| {
        name.match_indices('.')
            .any(|(at, _)| inventory.structure.contains_key(&name[..at]) && is_new(&name[..at]))
    };
    let words = inventory.structure.iter().map(|(name, word)| (name.as_str(), word.as_str()));
    let numbers = inventory.quantities.iter().map(|quantity| (quantity.name.as_str(), ""));
    let new = words.chain(numbers).filter(move |word| is_new(word.0) && !is_part(word.0));
    new.map(|(name, word)| match word {
        "" | "on" => format!("`{name}`"),
        word => format!("`{name}` ({word})"),
    })
}
