//! The peaks of the steady oscillation at one frequency.

use std::{cell::OnceCell, f64::consts::TAU};

use nalgebra::Complex;
use serde::Serialize;

use super::{
    Drive, DriveKind, Swing, Vibration, VibrationError, VibrationWarning,
    curve::Curve,
    error,
    observed::{Found, Observed, supports},
};

/// A network in steady oscillation under a drive of a given amplitude.
///
/// All amplitudes are deviations from rest; weights and other constant forces come on top.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Steady {
    /// What shakes the network.
    #[serde(skip)]
    pub drive: Drive,
    /// The frequency \[Hz\].
    pub frequency: f64,
    /// Amplitude of the drive \[m or N\].
    pub amplitude: f64,
    /// The nodes that move.
    pub nodes: Vec<SteadyNode>,
    /// The elements.
    pub elements: Vec<SteadyElement>,
    /// What is held or moved.
    pub supports: Vec<SteadySupport>,
    /// Mean power that the drive puts in and the dashpots turn into heat \[W\], ≥ 0 up to rounding;
    /// `None` where the force of the drive is not known.
    pub power: Option<f64>,
    /// What is wrong with the oscillation as a picture of the scene.
    #[serde(flatten, serialize_with = "error::serialize")]
    pub warnings: Vec<VibrationWarning>,
}

/// The oscillation of a node.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SteadyNode {
    /// The node.
    pub name: String,
    /// Displacement \[m\].
    pub displacement: Swing,
    /// Acceleration \[m/s²\].
    pub acceleration: Swing,
}

/// The oscillation of an element.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SteadyElement {
    /// The element.
    pub name: String,
    /// Deformation \[m\], positive in compression.
    pub deformation: Swing,
    /// Force \[N\], positive in compression; `None` where it is undetermined.
    pub force: Option<Swing>,
    /// Mean power that its dashpots dissipate \[W\].
    pub power: f64,
    /// Its thickness \[m\], where it is a pad.
    #[serde(skip)]
    pub thickness: Option<f64>,
}

/// The force on a node that is held or moved.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SteadySupport {
    /// The node.
    pub name: String,
    /// The force of all elements on it \[N\].
    pub force: Swing,
}

impl Vibration {
    /// The steady oscillation at `frequency` \[Hz\] under a drive of this `amplitude` \[m or N\].
    ///
    /// # Errors
    ///
    /// [`VibrationError::InvalidSetting`] for a frequency or amplitude that is not positive, and
    /// [`VibrationError::Unbounded`] at an undamped resonance.
    pub fn steady(&self, frequency: f64, amplitude: f64) -> Result<Steady, VibrationError> {
        for (setting, value) in [("frequency", frequency), ("amplitude", amplitude)] {
            if !(value.is_normal() && value > 0.0) {
                let range = "positive";
                return Err(VibrationError::InvalidSetting { setting, range, value });
            }
        }
        let omega = TAU * frequency;
        let unbounded = || VibrationError::Unbounded { frequency };
        let harmonic = self.at(Complex::new(0.0, omega));
        let poles = OnceCell::new();
        let found = |observed: &Observed| {
            let rate = Complex::new(0.0, omega);
            let direct = harmonic.as_ref().and_then(|harmonic| observed.at(harmonic, rate));
            if direct.is_some_and(|direct| direct.is_clear()) {
                return direct;
            }
            let poles = poles.get_or_init(|| self.poles().unwrap_or_default());
            Curve::new(self, &observed.clone().into(), poles, [omega, omega]).at(omega)
        };
        let read = |observed: &Observed| {
            let found = found(observed)?;
            let is_known = found.value.norm() == 0.0 || found.error < 0.5 * found.value.norm();
            let rounding = found.error <= f64::EPSILON.sqrt();
            (is_known || rounding).then_some((found.value * amplitude, found.error * amplitude))
        };
        let swing = |observed: &Observed| read(observed).map(|own| Swing::of(own.0, own.1));
        let mut nodes = Vec::new();
        for id in self.ids() {
            let is_moved = self.drive.kind == DriveKind::Motion && id == self.node;
            if self.is_held(id.index()) && !is_moved {
                continue;
            }
            let observed = Observed::motion(&self.assembly, id, 0);
            let (value, error) = read(&observed).ok_or_else(unbounded)?;
            let twice = Complex::new(0.0, omega).powu(2);
            nodes.push(SteadyNode {
                name: observed.name,
                displacement: Swing::of(value, error),
                acceleration: Swing::of(value * twice, error * omega * omega),
            });
        }
        let mut elements = Vec::new();
        for (at, own) in self.assembly.connections.iter().enumerate() {
            let deformation = Observed::deformation(&self.assembly, at);
            let force = Observed::force(&self.assembly, at);
            let dashpots = Observed::dashpots(&self.assembly, at);
            let roots = dashpots.iter().map(|own| Some(read(own)?.0.norm_sqr()));
            elements.push(SteadyElement {
                name: own.name.clone(),
                deformation: swing(&deformation).ok_or_else(unbounded)?,
                force: force.as_ref().and_then(swing),
                power: roots.sum::<Option<f64>>().ok_or_else(unbounded)?,
                thickness: own.thickness,
            });
        }
        let mut held = Vec::new();
        for (body, name) in supports(&self.assembly) {
            let force = swing(&Observed::support(&self.assembly, body, &name));
            let force = force.ok_or_else(unbounded)?;
            held.push(SteadySupport { name, force });
        }
        Ok(Steady {
            drive: self.drive.clone(),
            frequency,
            amplitude,
            warnings: [self.exceeded(found, frequency, amplitude), pressed_through(&elements)]
                .concat(),
            nodes,
            elements,
            supports: held,
            power: self.power(found).map(|own| own * amplitude * amplitude),
        })
    }

    /// The mean power of the drive \[W\] at one unit of its amplitude: `½ Re(F v*)`.
    fn power(&self, read: impl Fn(&Observed) -> Option<Found>) -> Option<f64> {
        let own = self.driving()?;
        let value = |output: usize| Some(read(&Observed::output("", output, 0))?.value);
        let (force, velocity) = (value(own.force)?, value(own.velocity?)?);
        Some(0.5 * (force * velocity.conj()).re)
    }
}

/// Pads that would be pressed in by more than their thickness.
fn pressed_through(elements: &[SteadyElement]) -> Vec<VibrationWarning> {
    let too_deep = elements.iter().filter(|element| {
        element.thickness.is_some_and(|thickness| element.deformation.amplitude > thickness)
    });
    too_deep
        .map(|too_deep| VibrationWarning::PressedThrough { element: too_deep.name.clone() })
        .collect()
}
