//! Impacts of the thesis' form as networks: told from them, and written into them.

use std::sync::Arc;

use dashpot_network::{
    Connection, Model, Network, Node, NodeId, Start, Support,
    effects::{Face, Gravity, Separation},
    elements::{Dashpot, Law, Spring},
    first_nonlinear, linear_model,
    parameters::Kind as _,
    part,
};
use dashpot_rheology::{Branch, Tree};

use super::{
    FourParameterGroups, FourParameterImpact, FourParameterPadding, FourParameterSupport,
    ImpactScales, face, weight,
};
use crate::similarity::{SimilarityError, names::speed_of_fall};

/// A drawing of the padding stands for it if its constants come back within this, relatively.
const SAME: f64 = 1e-9;

impl FourParameterGroups {
    /// A network of the thesis' form with these groups in place of its own, and the same `m1`, `V0`
    /// and `δ`: only numbers change. Names, effects and what they say stay, and so does the drawing of
    /// the padding where it is that of a spring, a dashpot and a Kelvin–Voigt element in a row. A
    /// mass on the face and gravity are added where the network has none and the groups ask for them:
    /// the face then begins with the speed of the impactor, and the support in balance.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::OtherForm`], [`SimilarityError::GroupOutOfRange`],
    /// [`SimilarityError::NoPadding`].
    #[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
    pub fn put_into(&self, network: &Network) -> Result<Network, SimilarityError> {
        let before = FourParameterImpact::of(network)?;
        let after = before.with_groups(self)?;
        let mut again = network.clone();
        for node in again.nodes_mut() {
            if node.name == after.names[2] {
                node.mass = after.support.mass;
            } else if [before.gravity] != [after.gravity] && matches!(node.start, Start::Drop(_)) {
                // The speed at touch stays, from another height.
                let speed = after.scales.speed;
                node.start = if after.gravity > 0.0 {
                    Start::Drop(speed * speed / (2.0 * after.gravity))
                } else {
                    Start::Velocity(speed)
                };
            }
        }
        for own in again.connections_mut() {
            if own.name == after.names[1] {
                own.model = padding(&own.model, &before.padding, &after.padding);
            } else if before.support != after.support {
                own.model = after.support.mount();
            }
        }
        for effect in again.effects_mut() {
            if let Some(own) = effect.of_kind::<Gravity>() {
                *effect = Arc::new(Gravity { acceleration: after.gravity, ..*own });
            } else if let Some(own) = effect.of_kind::<Face>() {
                *effect = Arc::new(Face { mass: after.face_mass, ..own.clone() });
            }
        }
        let has = |kind: &str| network.effects().iter().any(|effect| effect.kind() == kind);
        if after.face_mass > 0.0 && !has(Face::KIND) {
            again.add_effect(face(&after.names[1], &after.names[0], after.face_mass));
        }
        if after.gravity != 0.0 && !has(Gravity::KIND) {
            again.add_effect(weight(after.gravity));
        }
        Ok(again)
    }
}

/// The model of a padding with other constants: in its own drawing where that has these parts.
fn padding(model: &Model, before: &FourParameterPadding, after: &FourParameterPadding) -> Model {
    if before == after {
        return model.clone();
    }
    let drawn = redrawn(model, after);
    let of = |own: &FourParameterPadding| [own.k1, own.c1, own.k2, own.c2];
    let is_same = constants(&drawn).is_some_and(|found| {
        let mut pairs = of(&found).into_iter().zip(of(after));
        pairs.all(|(found, own)| (found - own).abs() <= SAME * own)
    });
    if is_same { drawn } else { after.model() }
}

/// The model with K₁ and C₁ for springs and dashpots that are side by side with others, and with K₂
/// and C₂ for those in a row.
fn redrawn(model: &Model, own: &FourParameterPadding) -> Model {
    let both = model.fold(
        |element| {
            let of = |stiffness, damping| match element.law() {
                Law::Spring(_) => part(Spring { stiffness }),
                Law::Dashpot(_) => part(Dashpot { damping }),
                _ => Tree::Part(Arc::clone(element)),
            };
            (of(own.k2, own.c2), of(own.k1, own.c1))
        },
        |node, parts: Vec<(Model, Model)>| {
            let (in_row, beside): (Vec<Model>, Vec<Model>) = parts.into_iter().unzip();
            let named = |parts: Vec<Model>| -> Vec<Branch<_>> {
                let pairs = node.branches().iter().zip(parts);
                pairs.map(|(own, tree)| Branch::new(own.name.clone(), tree)).collect()
            };
            if node.is_series() {
                (Tree::Series(named(in_row)), Tree::Series(named(beside)))
            } else {
                (Tree::Parallel(named(beside.clone())), Tree::Parallel(named(beside)))
            }
        },
    );
    both.0
}

/// The constants of a linear model that is a spring, a dashpot and a Kelvin–Voigt element in a row from outside.
fn constants(model: &Model) -> Option<FourParameterPadding> {
    if first_nonlinear(model).is_some() {
        return None;
    }
    let linear = linear_model(model);
    let form = linear.kelvin()?;
    let elements = form.elements();
    let [only] = elements.as_slice() else { return None };
    let (compliance, fluidity) = (form.spring_compliance(), form.fluidity());
    (compliance > 0.0 && fluidity > 0.0).then(|| FourParameterPadding {
        k1: only.stiffness,
        c1: only.damping,
        k2: compliance.recip(),
        c2: fluidity.recip(),
    })
}

/// The impact that a network is, or what is different.
pub(super) fn read(network: &Network) -> Result<FourParameterImpact, &'static str> {
    if !network.loads().is_empty() {
        return Err("a load acts on it");
    }
    let nodes: Vec<(NodeId, &Node)> =
        network.nodes().filter(|(id, _)| *id != network.ground()).collect();
    let is_mass = |node: &Node| node.mass > 0.0 && node.support == Support::Free;
    let [(first, one), (second, other)] = nodes[..] else {
        return Err("it has not two nodes besides the ground");
    };
    let (head, panel) = match (one.is_impactor(), other.is_impactor()) {
        (true, false) => ((first, one), (second, other)),
        (false, true) => ((second, other), (first, one)),
        _ => return Err("it has not one impactor"),
    };
    if !(is_mass(head.1) && is_mass(panel.1)) {
        return Err("the impactor and the support are not both free masses");
    }
    if [head.1, panel.1].iter().any(|node| node.position != 0.0) {
        return Err("a mass begins at a position of its own");
    }
    let between = |ends: [NodeId; 2]| {
        let mut found =
            network.connections().iter().filter(move |connection| connection.between == ends);
        found.next().filter(|_| found.next().is_none())
    };
    let padding =
        between([head.0, panel.0]).ok_or("no element lies between impactor and support")?;
    let mount =
        between([panel.0, network.ground()]).ok_or("no element lies between support and ground")?;
    if network.connections().len() != 2 {
        return Err("it has more than two elements");
    }
    let thickness = padding.thickness.ok_or("the padding has no thickness")?;
    if padding.layers.is_some() {
        return Err("the padding is made of layers");
    }
    if first_nonlinear(&padding.model).is_some() {
        return Err("the padding is not linear");
    }
    let names = [&head.1.name, &padding.name, &panel.1.name, &mount.name].map(String::clone);
    let padding = constants(&padding.model).ok_or("the padding is no four-parameter model")?;
    let (stiffness, damping) = holder(mount)?;
    let (face_mass, gravity) = effects(network, &head.1.name)?;
    let speed = match head.1.start {
        Start::Velocity(speed) => speed,
        Start::Drop(height) => speed_of_fall(network, height),
        Start::Rest => 0.0,
    };
    if speed <= 0.0 {
        return Err("the impactor does not move towards the support");
    }
    Ok(FourParameterImpact {
        names,
        scales: ImpactScales { mass: head.1.mass, speed, thickness },
        face_mass,
        gravity,
        padding,
        support: FourParameterSupport { mass: panel.1.mass, stiffness, damping },
    })
}

/// K3 and C3 of the mount.
fn holder(mount: &Connection) -> Result<(f64, f64), &'static str> {
    const OTHER: &str = "the support is not held by a spring and a dashpot in parallel";
    if mount.layers.is_some() || first_nonlinear(&mount.model).is_some() {
        return Err(OTHER);
    }
    let linear = linear_model(&mount.model);
    let form = linear.maxwell().ok_or(OTHER)?;
    if form.elements().is_empty() { Ok((form.spring(), form.dashpot())) } else { Err(OTHER) }
}

/// The mass on the padding's face, and gravity.
fn effects(network: &Network, impactor: &str) -> Result<(f64, f64), &'static str> {
    let (mut face, mut gravity) = (0.0, 0.0);
    for effect in network.effects() {
        if let Some(own) = effect.of_kind::<Gravity>() {
            gravity = own.acceleration;
        } else if let Some(own) = effect.of_kind::<Face>() {
            if own.at.as_ref().is_some_and(|name| name != impactor) {
                return Err("the mass on the padding is not on the impactor's side");
            }
            face = own.mass;
        } else if effect.of_kind::<Separation>().is_none() {
            return Err("an effect acts on it that the thesis leaves out");
        }
    }
    Ok((face, gravity))
}
