//! Flight of masses that are dropped on something they can part from.

use crate::{
    Model, Network, NodeId, Start, Support,
    elements::{Contact, ElementKind},
    network::Connection,
    part,
};

/// Lets every dropped mass fall from its height: it starts without speed, and the gaps below it
/// become wider by the height.
///
/// A mass falls where gravity pulls it towards the support and only contacts touch it, each of them
/// between the mass and something that does not begin with a speed. All others begin at touch, with
/// the speed of the fall.
pub(super) fn begin(network: &mut Network) {
    let gravity = network.effects.iter().find_map(|effect| effect.gravity()).unwrap_or(0.0);
    if gravity <= 0.0 {
        return;
    }
    for at in 0..network.nodes.len() {
        let Start::Drop(height) = network.nodes[at].start else { continue };
        let id = NodeId(at);
        let touching = |own: &&Connection| own.between.contains(&id);
        let mut count = 0;
        let falls = network.nodes[at].support == Support::Free
            && network.connections.iter().filter(touching).all(|own| {
                count += 1;
                let below = network.node(own.between[1]);
                own.between[0] == id && !below.is_impactor() && contact_of(&own.model).is_some()
            });
        if !falls || count == 0 {
            continue;
        }
        network.nodes[at].start = Start::Velocity(0.0);
        for own in network.connections.iter_mut().filter(|own| own.between[0] == id) {
            if let Some(contact) = contact_of(&own.model) {
                own.model = part(Contact { gap: contact.gap + height, ..contact });
            }
        }
    }
}

/// The contact that a model is.
fn contact_of(model: &Model) -> Option<Contact> {
    let dashpot_rheology::Tree::Part(element) = model else { return None };
    let is_contact = element.kind() == Contact::KIND;
    is_contact.then(|| Contact::from_values(&element.values()).ok()).flatten()
}
