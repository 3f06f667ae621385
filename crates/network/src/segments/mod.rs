//! Layers cut into segments: what stands in a network in their place.

mod front;
mod recut;
mod resolve;
mod slice;

#[cfg(test)]
mod tests;

pub use self::recut::{Recut, recut};
pub(crate) use self::{front::warnings, resolve::resolve};
use crate::{
    layers::Wave,
    network::{Connection, Network},
    parameters::InvalidParameter,
};

/// What becomes of one layer of a network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolved<'l> {
    /// Name of the layer.
    pub name: &'l str,
    /// Number of its segments.
    pub segments: usize,
    /// The wave of the highest frequency that is resolved; `None` where none travels, or where its
    /// speed goes with the strain.
    pub wave: Option<Wave>,
}

/// The layers of a connection as they are resolved.
///
/// # Errors
///
/// [`InvalidParameter`] where they cannot be resolved as asked.
pub fn resolved<'l>(
    network: &Network,
    connection: &'l Connection,
) -> Result<Vec<Resolved<'l>>, InvalidParameter> {
    let Some(layers) = &connection.layers else { return Ok(Vec::new()) };
    let struck = struck_mass(network, connection);
    let counts = layers.segments(struck)?;
    let omega = layers.frequency(struck);
    let all = layers.all.iter().zip(counts).map(|(layer, segments)| Resolved {
        name: &layer.name,
        segments,
        wave: omega.filter(|_| layer.is_linear()).and_then(|omega| layer.wave(omega)),
    });
    Ok(all.collect())
}

/// The smaller mass \[kg\] of those at the ends of a connection, where there is one.
fn struck_mass(network: &Network, connection: &Connection) -> Option<f64> {
    let masses = connection.between.map(|id| network.node(id).mass).into_iter();
    masses.filter(|mass| *mass > 0.0).reduce(f64::min)
}
