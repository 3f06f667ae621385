//! How large the motion of a run is, as far as its drives tell before anything is solved.

use dashpot_dae::Waveform;

use crate::{
    Network, Support,
    elements::{Element, Law},
    network::start_velocity,
};

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
        let thrown = (2.0 * self.given / self.mass).sqrt();
        let (depth, rate) = if stiffness > 0.0 {
            let pressed = first(|depth| steady(depth) >= self.force)
                .min(first(|depth| stored(depth) >= self.given));
            let depth = first(|depth| stored(depth) >= self.energy);
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
