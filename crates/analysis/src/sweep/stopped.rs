//! Pads with stops: until one is met it takes no force, and the pad is as if it had none.

use std::borrow::Cow;

use dashpot_network::{Detail, Network, effects::Stop};

/// The stops of a network, by their elements.
fn stops(network: &Network) -> impl Iterator<Item = (usize, &Stop)> {
    let all = network.effects().iter().enumerate();
    all.filter_map(|(at, own)| own.of_kind::<Stop>().map(|own| (at, own)))
}

/// The network as it is as long as no stop is met.
pub(super) fn unmet(network: &Network) -> Cow<'_, Network> {
    let details: Vec<Detail> = stops(network).map(|own| Detail::Effect(own.0)).collect();
    if details.is_empty() { Cow::Borrowed(network) } else { Cow::Owned(network.without(&details)) }
}

/// Whether all stops are at this element.
pub(super) fn are_at(network: &Network, element: &str) -> bool {
    stops(network).all(|own| own.1.element == element)
}

/// The deformation \[m\] at which the stop of an element with a thickness \[m\] is met; not a number where it has none.
pub(super) fn gap(network: &Network, element: &str, thickness: Option<f64>) -> f64 {
    let own = stops(network).filter(|own| own.1.element == element);
    own.filter_map(|own| own.1.at.or(thickness)).fold(f64::NAN, f64::min)
}
