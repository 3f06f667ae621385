//! The response of a whole network at two of its nodes, in closed form.
//!
//! A pair of forces `F` pushes two nodes *a* and *b* against each other, as an element between them
//! would be loaded: `+F` on *a*, `−F` on *b*. They approach each other by `y = x_a − x_b`, and the
//! receptance is `H(s) = y/F`. All that is fixed or prescribed is held; loads, weights and start
//! speeds do not matter. What effects put into the network does, as do the masses of layers.
//!
//! Without masses the response is that of a linear model: [`Massless`]. With masses it is a sum over
//! complex poles: [`Receptance`]. Both are computed in twice the digits of a double, twice, with
//! different units of time, and the difference is given as their error. How many poles there are,
//! and how many of them are at zero or at infinity, follows from the graph.

mod circuit;
mod comparison;
mod complex;
mod dynamic;
mod hessenberg;
mod jacobi;
mod limits;
mod links;
mod massless;
mod modes;
mod receptance;
mod response;
mod spectrum;
mod terms;

#[cfg(test)]
mod tests;

use dashpot_rheology::{LinearModel, Primitive};
use thiserror::Error;

use self::circuit::Circuit;
pub use self::{
    comparison::Agreement,
    receptance::{Pole, Receptance},
};
use crate::{Network, NetworkErrors, NodeId};

/// Why a response cannot be given.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum DrivingPointError {
    /// The network itself is at fault.
    #[error(transparent)]
    Network(#[from] NetworkErrors),
    /// The force at a node meets neither a mass nor a held point.
    #[error(
        "nothing resists a force on `{node}`: no spring or dashpot leads from it to the other \
         node, a mass, or a fixed or prescribed node"
    )]
    NothingResists { node: String },
    /// An element that has no linear response.
    #[error("`{kind}`, element `{element}`, is not linear: run it in a scene")]
    NotLinear {
        /// Path of the element, for instance `padding.foam`.
        element: String,
        kind: &'static str,
    },
    /// The part that moves is larger than what is computed with twice the digits.
    #[error("the response of {bodies} free bodies is asked for; {most} is the most")]
    TooLarge { bodies: usize, most: usize },
    /// The constants are too far apart for the poles to be told.
    #[error("the poles of the network cannot be told: its time constants are too far apart")]
    NoConvergence,
}

/// Poles of a network that do not show in the response: a zero cancels each.
///
/// A strength counts as nothing where it comes and goes with the last digits of the constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hidden {
    /// The pole \[1/s\], real and imaginary part.
    pub rate: [f64; 2],
    /// How many poles there.
    pub count: usize,
}

/// The response of springs and dashpots without masses.
#[derive(Debug, Clone)]
pub struct Massless {
    /// The model that responds in the same way.
    pub model: LinearModel,
    /// Modes of the network that do not show.
    pub hidden: Vec<Hidden>,
    /// Relative error of every rate and residue that the model keeps: the largest difference of
    /// two computations.
    pub error: f64,
}

/// The response of a network at two nodes.
#[derive(Debug, Clone)]
pub enum Response {
    /// No mass moves.
    Massless(Massless),
    /// Masses move.
    Massive(Receptance),
}

impl Network {
    /// The response to a pair of forces that acts between the nodes `a` and `b`.
    ///
    /// Nodes that are rigidly linked or both held respond as a rigid link.
    ///
    /// # Errors
    ///
    /// [`DrivingPointError`] for a network that is at fault, an element that is not linear between
    /// bodies that are not held, a force that meets nothing, and more
    /// than 200 free bodies (80 where masses move).
    ///
    /// # Examples
    ///
    /// A bridge whose arms are in balance: the dashpot across does not show.
    ///
    /// ```
    /// use dashpot_network::{
    ///     Network, Node,
    ///     driving_point::Response,
    ///     elements::{Dashpot, Spring},
    ///     part,
    /// };
    ///
    /// let mut network = Network::new();
    /// let ground = network.ground();
    /// let [top, left, right] = ["top", "left", "right"].map(|n| network.add_node(Node::massless(n)));
    /// network.connect("k1", top, left, part(Spring { stiffness: 1.0 }));
    /// network.connect("k2", left, ground, part(Spring { stiffness: 2.0 }));
    /// network.connect("k3", top, right, part(Spring { stiffness: 3.0 }));
    /// network.connect("k4", right, ground, part(Spring { stiffness: 6.0 }));
    /// network.connect("across", left, right, part(Dashpot { damping: 5.0 }));
    /// let Response::Massless(found) = network.driving_point(top, ground)? else { unreachable!() };
    /// assert_eq!(found.model.least_elements(), 1);
    /// assert!((found.model.equilibrium_stiffness() - 8.0 / 3.0).abs() < 1e-15);
    /// assert_eq!(found.hidden.len(), 1);
    /// # Ok::<(), dashpot_network::driving_point::DrivingPointError>(())
    /// ```
    pub fn driving_point(&self, a: NodeId, b: NodeId) -> Result<Response, DrivingPointError> {
        let Some(circuit) = Circuit::of(&*self.with_effects()?, a, b)? else {
            let model = LinearModel::primitive(Primitive::Rigid);
            return Ok(Response::Massless(Massless { model, hidden: Vec::new(), error: 0.0 }));
        };
        let receptance = response::response(&circuit)?;
        Ok(if circuit.is_massless() {
            Response::Massless(receptance.massless())
        } else {
            Response::Massive(receptance)
        })
    }
}
