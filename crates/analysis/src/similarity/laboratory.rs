//! The laboratory test that stands for a real impact.

use dashpot_network::{
    Network,
    parameters::{Dimension, InvalidParameter},
};
use thiserror::Error;

use super::{
    Groups, Inventory, Quantity, Ranges, Scale, groups::with_value, names::gravity, scale::Basis,
    scaled,
};

/// Wishes that follow from others may differ from them by so much, relatively: they are given with few digits.
const SAME: f64 = 1e-9;
/// The parameter of gravity.
const GRAVITY: &str = "gravity.value";

/// A value that a laboratory chooses.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// Name of a parameter of the scene, or `mass`, `speed` or `thickness`, which mean the
    /// references of these dimensions.
    pub name: String,
    /// Its value in the laboratory, in SI units.
    pub value: f64,
}

/// A parameter in the real scene and in the laboratory.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The parameter of the real scene.
    pub real: Quantity,
    /// Its value in the laboratory, in SI units.
    pub value: f64,
}

/// A scene that is similar to a real one, with the values that a laboratory has.
#[derive(Debug, Clone)]
pub struct Laboratory {
    /// From the real scene to the laboratory.
    pub scale: Scale,
    /// The laboratory's network.
    pub network: Network,
    /// What was chosen.
    pub chosen: Vec<Chosen>,
    /// What stays as it is because nothing was said of it: references of the real scene.
    pub kept: Vec<Quantity>,
    /// Gravity in the laboratory \[m/s²\], which is to be that of the real scene times the factor of
    /// accelerations; `None` where gravity is off.
    pub gravity: Option<[f64; 2]>,
}

impl Laboratory {
    /// The scene that is similar to `real` with these values; what they leave open is kept: the
    /// references of the real scene, in their order.
    ///
    /// # Errors
    ///
    /// Any [`SimilarityError`]: unknown names, values that no scale reaches, wishes that contradict each other.
    pub fn design(real: &Network, wishes: &[Wish]) -> Result<Self, SimilarityError> {
        let (groups, inventory) = (Groups::of(real)?, Inventory::of(real)?);
        let mut basis = Basis::default();
        let mut factors: Vec<(Dimension, f64)> = Vec::new();
        let mut chosen = Vec::new();
        for wish in wishes {
            let quantity = named(&groups, &inventory, &wish.name)?;
            let factor = wish.value / quantity.value;
            if !(factor > 0.0 && factor.is_finite()) {
                return Err(SimilarityError::NoFactor {
                    name: quantity.name.clone(),
                    from: quantity.value,
                    to: wish.value,
                    dimension: quantity.dimension,
                });
            }
            let values: Vec<f64> = factors.iter().map(|factor| factor.1).collect();
            if let Some(follows) = basis.product(&values, quantity.dimension) {
                if (factor / follows - 1.0).abs() > SAME {
                    return Err(SimilarityError::Contradiction {
                        name: quantity.name.clone(),
                        to: wish.value,
                        follows: follows * quantity.value,
                        dimension: quantity.dimension,
                    });
                }
            } else {
                basis.take(quantity.dimension);
                factors.push((quantity.dimension, factor));
            }
            chosen.push(Chosen { real: quantity.clone(), value: wish.value });
        }
        let mut kept = Vec::new();
        for reference in &groups.references {
            if basis.take(reference.quantity.dimension) {
                factors.push((reference.quantity.dimension, 1.0));
                kept.push(reference.quantity.clone());
            }
        }
        let scale = Scale::from_factors(&factors);
        let gravity = gravity(real);
        Ok(Self {
            network: scaled(real, &scale)?,
            scale,
            chosen,
            kept,
            gravity: gravity.map(|gravity| [gravity, gravity * scale.of(Dimension::ACCELERATION)]),
        })
    }

    /// The laboratory's network under the gravity of the real scene: where no laboratory can scale
    /// gravity, that is what it tests. The same network where gravity is off.
    ///
    /// # Errors
    ///
    /// A value out of its range.
    pub fn under_real_gravity(&self) -> Result<Network, SimilarityError> {
        match self.gravity {
            Some([real, _]) => Ok(with_value(&self.network, GRAVITY, real)?),
            None => Ok(self.network.clone()),
        }
    }

    /// The parameter that a laboratory chooses by this name.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::UnknownQuantity`] where the scene has none.
    pub fn parameter(real: &Network, name: &str) -> Result<Quantity, SimilarityError> {
        named(&Groups::of(real)?, &Inventory::of(real)?, name).cloned()
    }
}

fn named<'q>(
    groups: &'q Groups,
    inventory: &'q Inventory,
    name: &str,
) -> Result<&'q Quantity, SimilarityError> {
    let reference = |short: &str| {
        let (dimension, ending) = match short {
            "mass" => (Dimension::MASS, ".mass"),
            "speed" | "velocity" => (Dimension::VELOCITY, ".velocity"),
            "thickness" => (Dimension::LENGTH, ".thickness"),
            _ => return None,
        };
        let mut all = groups.references.iter().map(|reference| &reference.quantity);
        all.find(|own| own.dimension == dimension && own.name.ends_with(ending))
    };
    reference(name).or_else(|| inventory.quantity(name)).ok_or_else(|| {
        let short = ["mass", "speed", "thickness"].into_iter();
        let short = short.filter(|short| reference(short).is_some()).map(str::to_owned);
        let own = inventory.quantities.iter().map(|quantity| quantity.name.clone());
        SimilarityError::UnknownQuantity {
            name: name.to_owned(),
            known: short.chain(own).collect(),
        }
    })
}

/// Why there is no similar scene.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SimilarityError {
    /// A parameter that the scene does not have.
    #[error("the scene has no parameter `{name}`")]
    UnknownQuantity {
        /// The name.
        name: String,
        /// The parameters that it has.
        known: Vec<String>,
    },
    /// A parameter that cannot be scaled.
    #[error(
        "`{name}` is {} in the scene, so no scale makes it {}",
        said(*.from, *.dimension),
        said(*.to, *.dimension)
    )]
    NoFactor {
        /// The parameter.
        name: String,
        /// Its value in the scene, in SI units.
        from: f64,
        /// The value wanted, in SI units.
        to: f64,
        /// What it measures.
        dimension: Dimension,
    },
    /// Wishes that contradict each other.
    #[error(
        "`{name}` cannot be {} as well: the other wishes make it {}",
        said(*.to, *.dimension),
        said(*.follows, *.dimension)
    )]
    Contradiction {
        /// The parameter.
        name: String,
        /// The value wanted, in SI units.
        to: f64,
        /// What follows from the wishes before, in SI units.
        follows: f64,
        /// What it measures.
        dimension: Dimension,
    },
    /// A group that a scene of this form cannot have.
    #[error("the group {name} is {value}, and must be {range}")]
    GroupOutOfRange {
        /// The group.
        name: &'static str,
        /// The value wanted.
        value: f64,
        /// What it may be.
        range: &'static str,
    },
    /// Groups that no padding has together.
    #[error(
        "no padding has these groups: q = a − b c/d − d/c is {q:.6}, and must be positive; with the \
         other groups as they are there is one for: {ranges}"
    )]
    NoPadding {
        /// The value of q.
        q: f64,
        /// Where there is one.
        ranges: Box<Ranges>,
    },
    /// A scene that has not the form in question.
    #[error("the scene has not the form of the thesis: {reason}")]
    OtherForm {
        /// What is different.
        reason: &'static str,
    },
    /// A value out of its range.
    #[error(transparent)]
    Invalid(#[from] InvalidParameter),
}

/// A value with its unit, where that has a name.
fn said(value: f64, dimension: Dimension) -> String {
    match dimension.named().filter(|_| dimension != Dimension::NUMBER) {
        Some((_, unit)) => format!("{value} {unit}"),
        None => value.to_string(),
    }
}
