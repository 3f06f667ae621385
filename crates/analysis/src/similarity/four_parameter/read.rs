//! Impacts of the thesis' form, told from their networks.

use dashpot_network::{
    Connection, Network, Node, NodeId, Start, Support,
    effects::{Face, Gravity, Separation},
    first_nonlinear, linear_model,
};

use super::{FourParameterImpact, rewrite::constants};
use crate::measures::STANDARD_GRAVITY;

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
    let [k1, c1, k2, c2] = burgers(padding)?;
    let (support_stiffness, support_damping) = holder(mount)?;
    let (face_mass, gravity) = effects(network, &head.1.name)?;
    let speed = match head.1.start {
        Start::Velocity(speed) => speed,
        Start::Drop(height) => {
            let own = network.effects().iter().find_map(|effect| effect.gravity());
            (2.0 * own.unwrap_or(STANDARD_GRAVITY) * height).max(0.0).sqrt()
        }
        Start::Rest => 0.0,
    };
    if speed <= 0.0 {
        return Err("the impactor does not move towards the support");
    }
    Ok(FourParameterImpact {
        names: [&head.1.name, &padding.name, &panel.1.name, &mount.name].map(String::clone),
        mass: head.1.mass,
        speed,
        thickness,
        face_mass,
        gravity,
        k1,
        c1,
        k2,
        c2,
        support_mass: panel.1.mass,
        support_stiffness,
        support_damping,
    })
}

/// K1, C1, K2, C2 of a padding.
fn burgers(padding: &Connection) -> Result<[f64; 4], &'static str> {
    if padding.layers.is_some() {
        return Err("the padding is made of layers");
    }
    if first_nonlinear(&padding.model).is_some() {
        return Err("the padding is not linear");
    }
    constants(&padding.model).ok_or("the padding is no four-parameter model")
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
