//! The groups of the thesis, for impacts of its form.

mod groups;
mod networks;
mod parts;
#[cfg(test)]
mod tests;

use dashpot_network::{
    Model, Network, Node,
    effects::{Face, Gravity, GravityStart, Touch},
};

pub use self::{
    groups::FourParameterGroups,
    parts::{FourParameterPadding, FourParameterSupport, ImpactScales, Ranges},
};
use super::SimilarityError;

/// An impact of the thesis' form: a mass `m1` at the speed `V0` on a four-parameter padding, whose
/// face may have a mass `m2`, on a mass `m3` that a spring and a dashpot hold to the ground.
///
/// Any linear padding that is a spring, a dashpot and one Kelvin–Voigt element in a row from outside
/// counts as a four-parameter one, two Maxwell elements side by side, for instance.
#[derive(Debug, Clone, PartialEq)]
pub struct FourParameterImpact {
    /// Names of the impactor, the padding, the support and its mount.
    pub names: [String; 4],
    /// Mass, speed and thickness.
    pub scales: ImpactScales,
    /// Mass of the face of the padding m₂ \[kg\], ≥ 0.
    pub face_mass: f64,
    /// Gravitational acceleration g \[m/s²\], which acts on each mass; 0 where gravity is off.
    pub gravity: f64,
    /// Its padding.
    pub padding: FourParameterPadding,
    /// Its support.
    pub support: FourParameterSupport,
}

impl FourParameterImpact {
    /// Reads a network of this form.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::OtherForm`], and what is different.
    pub fn of(network: &Network) -> Result<Self, SimilarityError> {
        networks::read(network).map_err(|reason| SimilarityError::OtherForm { reason })
    }

    /// `p1 = C1/C2`, `p2 = K1/K2`, `p3 = K2 J/C2`, `p4 = m1/(J C2)`.
    pub fn ratios(&self) -> [f64; 4] {
        let FourParameterPadding { k1, c1, k2, c2 } = self.padding;
        let time = self.scales.time();
        [c1 / c2, k1 / k2, k2 * time / c2, self.scales.mass / (time * c2)]
    }

    /// Its groups.
    pub fn groups(&self) -> FourParameterGroups {
        let ImpactScales { mass, speed, thickness } = self.scales;
        FourParameterGroups {
            gravity: self.gravity * thickness / (speed * speed),
            share: mass / (mass + self.face_mass),
            ..FourParameterGroups::of(&self.scales, &self.padding, &self.support)
        }
    }

    /// The impact with other groups and the same `m1`, `V0` and `δ` (appendix D). What belongs to
    /// groups that stay the same stays the same to the last digit.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::GroupOutOfRange`] and [`SimilarityError::NoPadding`].
    #[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
    pub fn with_groups(&self, groups: &FourParameterGroups) -> Result<Self, SimilarityError> {
        groups.validate()?;
        let (before, scales) = (self.groups(), &self.scales);
        let of_padding = |own: &FourParameterGroups| [own.a, own.b, own.c, own.d];
        let of_support = |own: &FourParameterGroups| [own.alpha, own.beta, own.gamma];
        let mut again = self.clone();
        if of_padding(groups) != of_padding(&before) {
            again.padding = groups.padding(scales)?;
        }
        if of_support(groups) != of_support(&before) {
            again.support = groups.support(scales);
        }
        if [groups.share] != [before.share] {
            again.face_mass = face_mass(groups.share, scales);
        }
        if [groups.gravity] != [before.gravity] {
            again.gravity = acceleration(groups.gravity, scales);
        }
        Ok(again)
    }

    /// The impact as a network. A face with mass begins with the speed of the impactor, as in the
    /// thesis, and gravity with the support in balance.
    pub fn network(&self) -> Network {
        let beside = (self.face_mass, self.gravity);
        network(&self.names, &self.scales, self.padding.model(), &self.support, beside)
    }
}

impl FourParameterGroups {
    /// The impact with these groups: `head` on `padding` on `panel` on `mount`.
    ///
    /// The weight of the support is borne by its spring from the beginning, as in 2.9.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::NoPadding`] where q ≤ 0.
    pub fn network(&self, scales: &ImpactScales) -> Result<Network, SimilarityError> {
        Ok(self.network_with(scales, self.padding(scales)?.model()))
    }

    /// The same with another model as the padding.
    pub fn network_with(&self, scales: &ImpactScales, padding: Model) -> Network {
        let names = ["head", "padding", "panel", "mount"].map(str::to_owned);
        let beside = (face_mass(self.share, scales), acceleration(self.gravity, scales));
        network(&names, scales, padding, &self.support(scales), beside)
    }
}

/// The mass m₂ with a share B.
fn face_mass(share: f64, scales: &ImpactScales) -> f64 {
    (scales.mass / share - scales.mass).max(0.0)
}

/// The gravitational acceleration of a group A.
fn acceleration(gravity: f64, scales: &ImpactScales) -> f64 {
    gravity * scales.speed * scales.speed / scales.thickness
}

fn network(
    [impactor, padding, panel, mount]: &[String; 4],
    scales: &ImpactScales,
    model: Model,
    support: &FourParameterSupport,
    (face_mass, gravity): (f64, f64),
) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass(&**impactor, scales.mass).moving(scales.speed));
    let held = network.add_node(Node::mass(&**panel, support.mass));
    network.connect(&**padding, head, held, model).thickness = Some(scales.thickness);
    network.connect(&**mount, held, network.ground(), support.mount());
    if face_mass > 0.0 {
        network.add_effect(face(padding, impactor, face_mass));
    }
    if gravity != 0.0 {
        network.add_effect(weight(gravity));
    }
    network
}

/// A face with mass that begins with the speed of the impactor.
fn face(padding: &str, impactor: &str, mass: f64) -> Face {
    let (element, at) = (padding.to_owned(), Some(impactor.to_owned()));
    Face { element, mass, at, touch: Touch::Moving }
}

/// Gravity with the support in balance.
fn weight(acceleration: f64) -> Gravity {
    Gravity { acceleration, start: GravityStart::Equilibrium }
}
