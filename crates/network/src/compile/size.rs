//! How large the motion of a run is, as far as its drives tell before anything is solved.

use dashpot_dae::Waveform;
use dashpot_numerics::roots::bisect;

use crate::{
    Network, Support,
    elements::{Element, Law},
    network::start_velocity,
};

/// A law whose force grows by more than this over an octave of its deformation has its slope within that, in so many
/// halvings.
const STEEP: f64 = 100.0;
const CLOSER: usize = 10;

/// What drives a run, in all, in SI units.
///
/// From it follow the slopes of laws that have no typical ones ([`Element::grows_from`]). They need to
/// be right to a few powers of ten only, but must not depend on how a law is written.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Size {
    /// Kinetic energy at the start \[J\].
    energy: f64,
    /// The fastest speed that the start or a given motion brings \[m/s\].
    speed: f64,
    /// The largest displacement that is given \[m\].
    way: f64,
    /// Sum of the largest forces of loads and effects \[N\].
    force: f64,
    /// What these can give to the masses that they act on within the run: an energy \[J\], infinite where
    /// there is no mass.
    given: f64,
    /// The masses that they act on \[kg\].
    mass: f64,
}

impl Size {
    /// The size of the run of a network for a `duration` \[s\].
    pub(super) fn of(network: &Network, duration: f64) -> Self {
        let mut size = Self::default();
        for node in &network.nodes {
            let speed = start_velocity(network, node.start).abs();
            size.energy += 0.5 * node.mass * speed * speed;
            size.speed = size.speed.max(if node.mass > 0.0 { speed } else { 0.0 });
            size.way = size.way.max(node.position.abs());
            if let Support::Prescribed(motion) = &node.support {
                size.way = size.way.max(motion.bound(duration));
                size.speed = size.speed.max(fastest(motion, duration));
            }
        }
        for load in &network.loads {
            size.push(network.nodes[load.node.0].mass, &load.force, duration);
        }
        for (node, weight) in network.effects.iter().flat_map(|effect| effect.body_forces(network))
        {
            size.push(network.nodes[node.0].mass, &weight, duration);
        }
        let is_driven =
            [size.energy, size.speed, size.way, size.force].iter().any(|own| *own > 0.0);
        if is_driven { size } else { Self { energy: 1.0, speed: 1.0, ..size } }
    }

    fn push(&mut self, mass: f64, force: &Waveform, duration: f64) {
        let (largest, impulse) = (force.bound(duration), force.area_bound(duration));
        if largest > 0.0 {
            self.force += largest;
            self.given += 0.5 * impulse * impulse / mass;
            self.mass += mass;
        }
    }

    /// What stands for the law of an element in such a run: its own slopes where it has typical ones, or else
    /// the secants at the deformation and the rate to which such a run brings it.
    pub(super) fn law(&self, element: &dyn Element) -> Law {
        let law = element.law();
        let (Law::Nonlinear { stiffness, damping }, Some(origin)) = (law, element.grows_from())
        else {
            return law;
        };
        let steady = |depth: f64| element.force(origin + depth, 0.0);
        let stored = |depth: f64| element.stored(origin + depth);
        // A foam at the end of its way grows by powers of ten within an octave.
        let depth_at = |holds: &dyn Fn(f64) -> bool| {
            let high = first(holds);
            let is_steep = steady(high) > STEEP * steady(0.5 * high);
            if is_steep { bisect(0.5 * high, high, CLOSER, holds).1 } else { high }
        };
        let thrown = (2.0 * self.given / self.mass).sqrt();
        let (depth, rate) = if stiffness > 0.0 {
            let pressed = depth_at(&|depth| steady(depth) >= self.force)
                .min(depth_at(&|depth| stored(depth) >= self.given));
            let depth = depth_at(&|depth| stored(depth) >= self.energy);
            let pushed = (2.0 * self.force * pressed / self.mass).sqrt();
            (largest([depth, pressed, self.way]), largest([self.speed, pushed.min(thrown)]))
        } else {
            let dragged = first(|rate| element.force(origin, rate) >= self.force);
            (0.0, largest([self.speed, dragged.min(thrown)]))
        };
        let force = steady(depth);
        let own = |typical: f64, slope: f64| if typical > 0.0 { slope } else { 0.0 };
        let slopes = [
            own(stiffness, force / depth),
            own(damping, (element.force(origin + depth, rate) - force) / rate),
        ];
        if slopes.iter().all(|slope| slope.is_normal() || *slope <= 0.0) {
            Law::Nonlinear { stiffness: slopes[0], damping: slopes[1] }
        } else {
            law
        }
    }
}

/// The largest of these that is a number; 1 where there is none that is not zero.
fn largest<const N: usize>(all: [f64; N]) -> f64 {
    let most = all.into_iter().filter(|own| own.is_normal()).fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

/// The first power of two at which a condition holds that holds for all larger ones; infinite where it
/// never does, and 0 where it does for all.
pub(super) fn first(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (-1023_i32, 1024_i32);
    while high - low > 1 {
        let middle = (low + high).div_euclid(2);
        if holds(f64::from(middle).exp2()) {
            high = middle;
        } else {
            low = middle;
        }
    }
    match high {
        -1022 => 0.0,
        1024 => f64::INFINITY,
        _ => f64::from(high).exp2(),
    }
}

/// A bound of the rate of a given motion on `[0, duration]`.
fn fastest(motion: &Waveform, duration: f64) -> f64 {
    let pieces = motion.pieces();
    let rates =
        pieces.iter().enumerate().filter(|own| own.1.start < duration).map(|(at, piece)| {
            let end = pieces.get(at + 1).map_or(duration, |next| next.start.min(duration));
            let length = (end - piece.start).max(0.0);
            let bent = length * (piece.curvature.abs() + 0.5 * length * piece.jerk.abs());
            let frequency = piece.frequency(piece.start).max(piece.frequency(end));
            piece.slope.abs() + bent + frequency * piece.sine.hypot(piece.cosine)
        });
    rates.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::elements::{Foam, Foundation, Indenter, Shape};

    #[test]
    fn the_slope_of_a_foam_at_the_end_of_its_way_is_that_to_where_its_energy_is_taken_up() {
        let indenter = Indenter {
            shape: Shape::Sphere,
            radius: Some(0.085),
            diameter: None,
            length: None,
            pad_radius: Some(-0.11),
        };
        for exponent in [1.0, 2.0, 5.0] {
            let foam = Foam {
                modulus: 2e6,
                plateau: 1e5,
                densification: 2e4,
                exponent,
                thickness: 0.03,
                area: indenter.area().unwrap(),
            };
            let pad = Foundation::new(Arc::new(foam), indenter).unwrap();
            let pressed = pad.phases().unwrap();
            let crate::phases::PhaseLaw::Element(pressed) = pressed.law(pressed.first(0.0)) else {
                panic!("it is pressed")
            };
            for energy in [2.0, 20.0, 73.0] {
                let size = Size { energy, ..Size::default() };
                let Law::Nonlinear { stiffness, .. } = size.law(pressed.as_ref()) else {
                    panic!("it is not linear")
                };
                let (_, depth) = bisect(0.0, 0.04, 60, |depth| pad.stored(depth) >= energy);
                let slope = pad.force(depth, 0.0) / depth;
                let factor = stiffness / slope;
                assert!((0.1..100.0).contains(&factor), "{exponent}, {energy} J: {factor}");
            }
        }
    }
}
