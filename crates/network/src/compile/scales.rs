//! Units in which the system is of order one.

use super::{
    bodies::{Bodies, Role},
    structure::Structure,
};
use crate::NetworkError;

/// What drives the network, as magnitudes in SI units.
#[derive(Debug, Clone, Default)]
pub(super) struct Drives {
    /// Forces on bodies.
    pub(super) forces: Vec<Force>,
    /// Body and largest displacement \[m\].
    pub(super) motions: Vec<(usize, f64)>,
}

/// A force as magnitudes in SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Force {
    /// The body that it acts on.
    pub(super) body: usize,
    /// The largest one \[N\].
    pub(super) largest: f64,
    /// A bound of its impulse during the run \[N s\]: all that it can do to a mass, however large it is
    /// for a short time.
    pub(super) impulse: f64,
}

/// By how much amplitudes are lifted: 2⁶⁰⁰.
const LIFT: f64 = power(600);
/// Up to this size of all amplitudes they are: 2⁻⁹⁰⁰.
const TINY: f64 = 1.0 / power(900);

/// Largest rate of a mass in its dashpots, in units of the time: its square is a number by far.
const FAST: f64 = 1e100;
/// The same where the network switches, which is judged by derivatives of up to the seventh order: the
/// square of such a power is a number.
const FAST_AT_SWITCHES: f64 = 1e20;

/// A power of two.
const fn power(exponent: u32) -> f64 {
    let mut power = 1.0;
    let mut left = exponent;
    while left > 0 {
        power *= 2.0;
        left -= 1;
    }
    power
}

/// SI values of the dimensionless value 1, times the [`lift`](Self::lift).
///
/// They rest on the energy `E` that the drives can bring in: a spring cannot be compressed by more
/// than √(2E/k), a mass not be faster than √(2E/m). The square root of the energy is added up, so
/// that no amplitude is too small or too large to be squared. All scales are powers of two, so that
/// scaling rounds nothing: rows that cancel exactly in SI still do. Time is counted in that of a swing, or
/// in smaller units where a dashpot stops a mass so soon that numbers would not do.
///
/// Where all amplitudes are so small that their reciprocals are beyond the range of numbers, lengths,
/// velocities and forces are counted larger by one factor, the lift. Linear equations do not notice.
#[derive(Debug, Clone)]
pub(super) struct Scales {
    /// Time \[s\].
    pub(super) time: f64,
    /// Displacement of each body \[m\].
    pub(super) length: Vec<f64>,
    /// Velocity of each body \[m/s\].
    pub(super) velocity: Vec<f64>,
    /// By how much amplitudes are counted larger than they are: a power of two, and mostly 1.
    pub(super) lift: f64,
}

impl Scales {
    pub(super) fn of(
        bodies: &Bodies,
        structure: &Structure,
        drives: &Drives,
        duration: f64,
        switches: bool,
    ) -> Result<Self, NetworkError> {
        let count = bodies.all.len();
        // What switches does so at levels, which cannot be lifted.
        let lift = if switches { 1.0 } else { lift(bodies, drives) };
        let time = if duration > 0.0 { duration } else { 1.0 };
        let stiffness = sums(count, &structure.springs);
        let damping = sums(count, &structure.dashpots);
        let mass = |body: usize| match bodies.all[body].role {
            Role::Mass(mass) => mass,
            _ => 0.0,
        };
        let kinetic = (0..count)
            .map(|body| (0.5 * mass(body)).sqrt() * (bodies.all[body].velocity.abs() * lift))
            .fold(0.0, f64::hypot);
        let forced = drives.forces.iter().map(|&Force { body, largest, impulse }| {
            let by_spring = (largest * lift) * (2.0 * stiffness[body]).sqrt().recip();
            let by_mass = (impulse * lift) * (2.0 * mass(body)).sqrt().recip();
            let root = by_spring.min(by_mass);
            if root.is_finite() { root } else { largest * lift * (time / damping[body]).sqrt() }
        });
        let moved = drives.motions.iter().map(|&(body, way)| {
            let root = (0.5 * stiffness[body]).sqrt().hypot((damping[body] / time).sqrt());
            (way * lift) * root
        });
        let root = forced.chain(moved).filter(|root| root.is_finite()).fold(kinetic, f64::hypot);
        let root_energy = if root > 0.0 { root } else { 1.0 };

        let fastest = bodies.all.iter().map(|body| body.velocity.abs() * lift).fold(0.0, f64::max);
        let cap = if kinetic > 0.0 { fastest * (root_energy / kinetic) } else { f64::INFINITY };
        let of_mass = |body: usize| ((2.0 / mass(body)).sqrt() * root_energy).min(cap);
        let top = (0..count).filter(|&body| mass(body) > 0.0).map(of_mass).fold(0.0, f64::max);
        let length: Vec<f64> = (0..count)
            .map(|body| {
                let sprung = (2.0 / stiffness[body]).sqrt() * root_energy;
                let travelled = if mass(body) > 0.0 {
                    of_mass(body) * time
                } else if top > 0.0 {
                    top * time
                } else {
                    f64::INFINITY
                };
                let damped = (time / damping[body]).sqrt() * root_energy;
                [sprung.min(travelled), damped]
                    .into_iter()
                    .find(|way| way.is_finite())
                    .unwrap_or(1.0)
            })
            .collect();
        let own_time = |body: usize| length[body] / of_mass(body);
        let masses = || (0..count).filter(|&body| mass(body) > 0.0);
        let impact = masses().filter(|&body| bodies.all[body].is_impactor).map(own_time);
        let unit = impact.reduce(f64::min).or_else(|| masses().map(own_time).reduce(f64::min));
        let unit = unit.unwrap_or(0.1 * time).min(time);
        let braked = masses().map(|body| damping[body] / mass(body)).fold(0.0, f64::max);
        let fast = if switches { FAST_AT_SWITCHES } else { FAST };
        let unit = if braked * unit > fast { fast / braked } else { unit };
        let velocity = (0..count)
            .map(|body| if mass(body) > 0.0 { of_mass(body) } else { length[body] / unit })
            .map(power_of_two)
            .collect();
        let scales = Self {
            time: power_of_two(unit),
            length: length.into_iter().map(power_of_two).collect(),
            velocity,
            lift,
        };
        scales.check()?;
        if switches {
            scales.check_unlifted()?;
        }
        Ok(scales)
    }

    /// Whether amplitudes that are not lifted can be divided by.
    fn check_unlifted(&self) -> Result<(), NetworkError> {
        let is_faint = |value: &&f64| value.recip().is_infinite();
        let too_faint = |what, value, unit| Err(NetworkError::TooFaint { what, value, unit });
        if let Some(&value) = self.velocity.iter().find(is_faint) {
            return too_faint("the scale of a velocity", value, "m/s");
        }
        if let Some(&value) = self.length.iter().find(is_faint) {
            return too_faint("the scale of a displacement", value, "m");
        }
        Ok(())
    }

    fn check(&self) -> Result<(), NetworkError> {
        let is_usable = |value: &f64| value.is_finite() && *value > 0.0;
        let out_of_scale = |what, value, unit| Err(NetworkError::OutOfScale { what, value, unit });
        if !is_usable(&self.time) {
            return out_of_scale("the unit of time", self.time, "s");
        }
        if let Some(&value) = self.length.iter().find(|value| !is_usable(value)) {
            return out_of_scale("the scale of a displacement", value, "m");
        }
        if let Some(&value) = self.velocity.iter().find(|value| !is_usable(value)) {
            return out_of_scale("the scale of a velocity", value, "m/s");
        }
        Ok(())
    }
}

/// By how much all amplitudes are to be counted larger.
fn lift(bodies: &Bodies, drives: &Drives) -> f64 {
    let speeds = bodies.all.iter().map(|body| body.velocity.abs());
    let forces = drives.forces.iter().map(|force| force.largest);
    let motions = drives.motions.iter().map(|motion| motion.1);
    let largest = speeds.chain(forces).chain(motions).fold(0.0, f64::max);
    if largest > 0.0 && largest < TINY { LIFT } else { 1.0 }
}

/// The power of two nearest to a positive number on a logarithmic scale; what is not positive and
/// finite stays as it is.
pub(super) fn power_of_two(value: f64) -> f64 {
    if value.is_finite() && value > 0.0 { value.log2().round().exp2() } else { value }
}

fn sums(count: usize, edges: &[super::structure::Edge]) -> Vec<f64> {
    let mut sums = vec![0.0; count];
    for edge in edges {
        for end in edge.ends {
            sums[end] += edge.constant;
        }
    }
    sums
}
