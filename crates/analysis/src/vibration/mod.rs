//! Steady periodic response: transmissibility over frequency, resonances, and the peaks of the
//! steady oscillation at one frequency. Other [quantities](QUANTITIES) over frequency are those of elements, and driving
//! points: dynamic stiffness, impedance and apparent mass.
//!
//! One load or one motion of a network is a sine, all else that drives it is silent, and transients
//! have died away. Then every quantity is a sine of the same frequency, and its complex amplitude
//! follows from the equations of the network at `s = iω`, without time stepping. Start speeds,
//! weights and the functions of time of the scene do not matter.
//!
//! Contacts of separated elements count as closed, and stops as not reached. That holds as long as
//! the oscillation is smaller than what weights make of them at rest: these [`Limit`]s are told.
//!
//! # Examples
//!
//! ```
//! use dashpot_analysis::vibration::{SweepSettings, Vibration};
//! use dashpot_network::{Model, Network, Node, elements::{Dashpot, Spring}, part};
//!
//! let mut network = Network::new();
//! let device = network.add_node(Node::mass("device", 2.0));
//! let mount = Model::parallel([part(Spring { stiffness: 8e4 }), part(Dashpot { damping: 80.0 })]);
//! network.connect("mount", device, network.ground(), mount);
//! let vibration = Vibration::new(&network, 1.0, Some("ground"))?;
//! let sweep = vibration.sweep(&SweepSettings::default())?;
//! let resonance = &sweep.transmissions[0].resonances[0];
//! // A little below the natural frequency of 31.83 Hz, as the damping is a tenth of critical.
//! assert!((resonance.frequency - 31.523).abs() < 1e-3);
//! # Ok::<(), dashpot_analysis::vibration::VibrationError>(())
//! ```

use serde::Serialize;

mod contacts;
mod curve;
mod drive;
mod error;
mod modes;
mod observed;
mod quantities;
mod resonance;
mod steady;
mod sweep;

#[cfg(test)]
mod tests;

use dashpot_dae::frequency::{FrequencyResponse, Harmonic};
use dashpot_network::{Assembly, Network, NodeId};
use nalgebra::Complex;

pub use self::{
    contacts::{Limit, LimitKind, Onset},
    drive::{Drive, DriveKind, drives},
    error::{VibrationError, VibrationWarning},
    modes::{Displacement, Mode},
    quantities::{QUANTITIES, Quantity},
    resonance::Resonance,
    steady::{Steady, SteadyElement, SteadyNode, SteadySupport},
    sweep::{Sweep, SweepSettings, Transmission},
};

/// A sinusoidal quantity: `amplitude · cos(ωt + phase)` where the drive is `cos(ωt)`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Swing {
    /// Amplitude, ≥ 0, in the unit of the quantity.
    pub amplitude: f64,
    /// Phase \[rad\] in (−π, π]; negative where the quantity lags behind the drive.
    pub phase: f64,
    /// How wrong the amplitude may be, from rounding.
    pub error: f64,
}

impl Swing {
    fn of(value: Complex<f64>, error: f64) -> Self {
        Self { amplitude: value.norm(), phase: value.arg(), error }
    }
}

/// A network that one load or motion shakes.
#[derive(Debug, Clone)]
pub struct Vibration {
    drive: Drive,
    network: Network,
    assembly: Assembly,
    node: NodeId,
    /// The amplitude of each waveform of the system.
    units: Vec<f64>,
    limits: Vec<Limit>,
}

impl Vibration {
    /// The network shaken by the load or node called `drive`; without a name by its only load or
    /// given motion. A node that is fixed, as `ground` is, may be shaken as well.
    ///
    /// `duration` \[s\] is that of the scene's run; it only scales the equations.
    ///
    /// # Errors
    ///
    /// [`VibrationError`] for a network that does not compile or is not linear, and for a drive
    /// that is not there.
    pub fn new(
        network: &Network,
        duration: f64,
        drive: Option<&str>,
    ) -> Result<Self, VibrationError> {
        error::require_linear(network)?;
        let drive = drive::chosen(network, drive)?;
        let (linear, openings) = contacts::closed(network);
        let still = linear.compile(duration)?;
        error::require_linear_system(&still)?;
        let known = || drives(&linear).into_iter().map(|drive| drive.name).collect();
        let unknown = || VibrationError::UnknownDrive { name: drive.name.clone(), known: known() };
        let node = linear.node_named(&drive.node).ok_or_else(unknown)?;
        let driven = drive::driven(&linear, &still, &drive, node, duration)?;
        let assembly = driven.compile(duration)?;
        error::require_linear_system(&assembly)?;
        // Motions and loads come before what effects bring, and one of them only is a sine.
        let waveforms = &assembly.system.waveforms;
        let mut units = vec![0.0; waveforms.len()];
        let mut sines = waveforms.iter().map(|own| own.pieces()[0].sine).enumerate();
        let (at, sine) = sines
            .find(|own| own.1 != 0.0)
            .ok_or(VibrationError::NothingToSee { sought: "part" })?;
        units[at] = sine;
        let limits = Vec::new();
        let mut own = Self { drive, network: driven, assembly, node, units, limits };
        if own.drive.kind == DriveKind::Load && own.is_held(node.index()) {
            let Drive { name: load, node, .. } = own.drive;
            return Err(VibrationError::LoadOnSupport { load, node });
        }
        own.limits = own.limits_of(network, &openings)?;
        Ok(own)
    }

    /// What shakes the network.
    pub fn drive(&self) -> &Drive {
        &self.drive
    }

    /// The answer to a drive of one unit that goes as `e^{st}`, with the complex `rate` s \[1/s\].
    fn at(&self, rate: Complex<f64>) -> Option<Harmonic<'_>> {
        FrequencyResponse::new(&self.assembly.system, &self.units)?.at_rate(rate)
    }

    /// Whether a node, by its number, is moved or held, alone or with others.
    fn is_held(&self, node: usize) -> bool {
        let body = self.assembly.nodes[node].body;
        self.assembly.nodes.iter().any(|node| node.body == body && !node.free)
    }
}
