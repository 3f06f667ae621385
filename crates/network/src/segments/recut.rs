//! The same pads in other segments, to tell what the number of segments makes of a result.

use super::struck_mass;
use crate::{
    layers::{MOST_SEGMENTS, Resolution},
    network::Network,
};

/// A network whose pads of layers are cut into other numbers of segments.
#[derive(Debug, Clone)]
pub struct Recut {
    /// The network with the other numbers.
    pub network: Network,
    /// The segments of all pads as they are.
    pub segments: usize,
    /// Those of the network returned.
    pub others: usize,
    /// The loosest accuracy that is stated for one of the pads; [`Recut::EXPECTED`] where numbers of
    /// segments are given.
    pub stated: f64,
}

impl Recut {
    /// Accuracy that is expected where a number of segments is given.
    pub const EXPECTED: f64 = 0.01;
}

/// The network with its pads cut into this part of their segments, below 1, or where that would leave a layer
/// without any into twice as many; `None` where no pad is cut, or can be.
pub fn recut(network: &Network, part: f64) -> Option<Recut> {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of a small count"
    )]
    let fewer = |own: usize| (part * own as f64) as usize;
    let mut found = Vec::new();
    for (at, connection) in network.connections.iter().enumerate() {
        let Some(layers) = &connection.layers else { continue };
        let counts = layers.segments(struck_mass(network, connection)).ok()?;
        let (own, least) =
            (counts.iter().sum::<usize>(), counts.iter().filter(|count| **count > 0).count());
        if own > 0 {
            found.push((at, own, least));
        }
    }
    if found.is_empty() {
        return None;
    }
    let is_coarser = found.iter().all(|(_, own, least)| fewer(*own) >= *least);
    let mut recut = Recut { network: network.clone(), segments: 0, others: 0, stated: 0.0 };
    for (at, own, _) in found {
        let other = if is_coarser { fewer(own) } else { (2 * own).min(MOST_SEGMENTS) };
        recut.segments += own;
        recut.others += other;
        if let Some(layers) = &mut recut.network.connections[at].layers {
            let stated = match layers.resolution {
                Resolution::Accuracy(accuracy) => accuracy,
                Resolution::Segments(_) => Recut::EXPECTED,
            };
            recut.stated = recut.stated.max(stated);
            layers.resolution = Resolution::Segments(other);
        }
    }
    Some(recut)
}
