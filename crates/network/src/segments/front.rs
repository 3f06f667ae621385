//! Fronts that are steeper than segments can be.
//!
//! A body that strikes a layer, or a load that jumps at its face, sends a step into it. A chain of segments answers to
//! a step with ripples that get narrower with more segments, but not lower: the force on the face rises to `∫₀ᶻ J₀ =
//! 1.470` of the true one at `z = 2.405`. Where a dashpot leads from face to face, a body of start speed `v` meets `2 n
//! c v` at once, and without segments a force without limit.

use super::Recut;
use crate::{
    Connection, Front, Network, NetworkWarning, NodeId,
    effects::Face,
    layers::{Layer, Layers, MOST_SEGMENTS, Resolution},
    model::stiffness::Stiffness,
    network::start_velocity,
};

/// Largest excess of the force on a face over that of a step, `∫₀^2.405 J₀ − 1`.
const EXCESS: f64 = 0.470_3;
/// Part of the peak of the impact from which on the force at the first touch may be the larger one.
const COMPARABLE: f64 = 0.5;
/// Loss angle \[rad\] from which on a layer resists like a dashpot.
const LOSSY: f64 = 1.5;

/// What of the forces in layers depends on their segments, however many there are.
pub(crate) fn warnings(network: &Network, duration: f64) -> Vec<NetworkWarning> {
    let mut warnings = Vec::new();
    for connection in &network.connections {
        let Some(layers) = &connection.layers else { continue };
        for (at, id) in connection.between.into_iter().enumerate() {
            let face = if at == 0 { layers.all.first() } else { layers.all.last() };
            let Some(face) = face.filter(|layer| layer.mass() > 0.0) else { continue };
            warnings.extend(blow(network, connection, layers, (at, face)));
            warnings.extend(step(network, connection, face, (id, duration)));
        }
    }
    warnings
}

/// A body with a start speed at a face.
fn blow(
    network: &Network,
    connection: &Connection,
    layers: &Layers,
    (at, face): (usize, &Layer),
) -> Option<NetworkWarning> {
    let ends = connection.between.map(|id| network.node(id));
    let body = ends[at];
    let speed = start_velocity(network, body.start) - start_velocity(network, ends[1 - at].start);
    // A mass of the face itself blunts what comes.
    let mut faces = network.effects.iter().filter_map(|effect| effect.of_kind::<Face>());
    let is_faced = faces.any(|face| face.element == connection.name);
    if is_faced || body.mass <= 0.0 || speed == 0.0 {
        return None;
    }
    let struck = super::struck_mass(network, connection);
    let omega = layers.frequency(struck)?;
    let counts = layers.segments(struck).ok()?;
    let count = if at == 0 { *counts.first()? } else { *counts.last()? } as f64;
    let stiffnesses: Vec<_> =
        layers.all.iter().map(|layer| Stiffness::of(&layer.model, omega)).collect();
    // Forces over the speed: that of the whole impact, and those at the first touch.
    let impact = (Stiffness::in_series(&stiffnesses).size() * body.mass).sqrt();
    let highest = omega * MOST_SEGMENTS as f64 * MOST_SEGMENTS as f64;
    let stiffness = Stiffness::of(&face.model, highest);
    let front = Front {
        node: body.name.clone(),
        element: connection.name.clone(),
        layer: face.name.clone(),
    };
    if stiffness.angle() > LOSSY {
        let touch = 2.0 * count * stiffness.size() / highest;
        return (touch > COMPARABLE * impact).then_some(NetworkWarning::DampedFront(front));
    }
    if !face.is_linear() {
        // The slopes of the law where it is pressed are not known, and neither is the excess.
        return Some(NetworkWarning::NonlinearFront(front));
    }
    let step = (face.mass() * stiffness.size()).sqrt();
    let excess = EXCESS * step / (step + impact);
    let wanted = match layers.resolution {
        Resolution::Accuracy(accuracy) => accuracy,
        Resolution::Segments(_) => Recut::EXPECTED,
    };
    (excess > wanted).then_some(NetworkWarning::SteepFront { front, excess })
}

/// A load that jumps at a face.
fn step(
    network: &Network,
    connection: &Connection,
    face: &Layer,
    (node, duration): (NodeId, f64),
) -> Option<NetworkWarning> {
    let layers = connection.layers.as_ref()?;
    let omega = layers.frequency(super::struck_mass(network, connection))?;
    let highest = omega * MOST_SEGMENTS as f64;
    let is_damped = Stiffness::of(&face.model, highest).angle() > LOSSY;
    let is_light = network.node(node).mass <= 0.0;
    let load = network.loads.iter().find(|load| {
        let jumps = || load.force.jumps().any(|(time, _)| time <= duration);
        load.node == node && (load.force.value(0.0) != 0.0 || jumps())
    });
    let load = load.filter(|_| is_light && !is_damped)?;
    let (load, element) = (load.name.clone(), connection.name.clone());
    Some(NetworkWarning::LoadJumps { load, element })
}

#[cfg(test)]
mod tests {
    use dashpot_dae::{Piece, Waveform};
    use dashpot_rheology::Tree;

    use super::*;
    use crate::{
        Model, Node,
        elements::{Dashpot, Spring},
        part,
    };

    /// 2 cm of 100 cm² and 100 kg/m³: 20 g, struck by a body of some mass.
    fn struck(mass: f64, model: Model, resolution: Resolution) -> Network {
        let name = "foam".to_owned();
        let layer = Layer { name, thickness: 0.02, area: 0.01, density: 100.0, model };
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", mass).moving(3.0));
        let layers = Layers { all: vec![layer], resolution };
        network.connect_layers("pad", head, network.ground(), layers);
        network
    }

    #[test]
    fn a_light_body_is_warned_of_and_a_heavy_one_is_not() {
        let spring = || part(Spring { stiffness: 5e5 });
        let said =
            |ratio: f64| warnings(&struck(0.02 * ratio, spring(), Resolution::Segments(10)), 0.01);
        // 0.47/(1 + √ratio) is 15 % and 0.99 %.
        assert!(said(5.0)[0].to_string().contains("up to 15 %"), "{:?}", said(5.0));
        assert!(said(2200.0).is_empty(), "{:?}", said(2200.0));
    }

    #[test]
    fn a_dashpot_from_face_to_face_is_warned_of_where_its_force_matters() {
        let kelvin =
            || Tree::parallel([part(Spring { stiffness: 5e5 }), part(Dashpot { damping: 50.0 })]);
        // 2 n c = 700 N s/m beside √(K M) = 100 and 7071 N s/m.
        let said = |mass: f64| warnings(&struck(mass, kelvin(), Resolution::Segments(7)), 0.01);
        assert!(said(0.02)[0].to_string().contains("without limit"), "{:?}", said(0.02));
        assert!(said(100.0).is_empty(), "{:?}", said(100.0));
    }

    #[test]
    fn a_step_at_a_free_face_is_warned_of_and_a_smooth_load_is_not() {
        let said = |piece: Piece| {
            let mut network = struck(0.0, part(Spring { stiffness: 5e5 }), Resolution::Segments(9));
            let head = network.node_named("head").unwrap();
            network.add_load("push", head, Waveform::new(vec![piece]).unwrap());
            warnings(&network, 0.01)
        };
        assert!(
            said(Piece { value: 1.0, ..Piece::default() })[0].to_string().contains("`push` jumps")
        );
        assert!(said(Piece { slope: 1.0, ..Piece::default() }).is_empty());
    }
}
