//! Transmissibility over a range of frequencies.

use std::{f64::consts::TAU, ops::ControlFlow};

use super::{
    Drive, Mode, Onset, Resonance, Swing, Vibration, VibrationError, VibrationWarning,
    curve::Curve, observed::Form, quantities::Receiver, resonance::resonances,
};
use crate::sweep::Watch;
use dashpot_dae::frequency::poles;
use dashpot_network::NodeId;

/// Peaks are sought so far beyond the range, lest their flanks be cut off.
const BEYOND: f64 = 8.0;
/// The range that is chosen reaches so far beyond the natural frequencies.
const AROUND: f64 = 10.0;
/// The range where there are none \[Hz\].
const USUAL: [f64; 2] = [1.0, 200.0];
/// Poles that are smaller than this part of the largest one are what rounding makes of zero.
const NOISE: f64 = 1e-7;
/// Frequencies below all others, relatively, from which the limit at rest is taken where the
/// equations have none at rest itself; and those where it is lost in rounding there, as that of a body that nothing holds.
const SLOW: [[f64; 2]; 2] = [[1e-6, 1e-9], [3e-4, 1e-4]];
/// A limit is known better than this, relatively, or not at all.
const KNOWN: f64 = 1e-6;

/// What is asked of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepSettings {
    /// The lowest frequency \[Hz\], positive; `None` for a tenth of the lowest natural frequency.
    pub from: Option<f64>,
    /// The highest frequency \[Hz\], above the lowest; `None` for ten times the highest natural one.
    pub to: Option<f64>,
    /// How many frequencies are listed, at equal ratios, 2 or more.
    pub points: usize,
    /// What is looked at: nodes, or supports and elements where a load drives, or a [quantity](super::QUANTITIES) of
    /// something, as `padding.force`; empty for every mass, or every support.
    pub of: Vec<String>,
    /// A frequency at which each response is told besides \[Hz\], positive.
    pub at: Option<f64>,
}

impl Default for SweepSettings {
    fn default() -> Self {
        Self { from: None, to: None, points: 200, of: Vec::new(), at: None }
    }
}

/// Responses over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// What shakes the network.
    pub drive: Drive,
    /// The frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// The response of each node or support, or of what else is asked for.
    pub transmissions: Vec<Transmission>,
    /// Where each contact parts and each stop is reached first, at its smallest drive.
    pub onsets: Vec<Onset>,
    /// The free oscillations.
    pub modes: Vec<Mode>,
    /// What should be known about it.
    pub notes: Vec<VibrationWarning>,
}

/// A response over frequency: what arrives at a node or support (`X/X_drive` of displacements, velocities or
/// accelerations where a motion drives; `F/F_drive`, the force on the support over the load, where a load does), or
/// another [quantity](super::QUANTITIES).
#[derive(Debug, Clone, PartialEq)]
pub struct Transmission {
    /// The node, or the support; or what was asked for, as `padding.force`.
    pub name: String,
    /// The word of its [quantity](super::QUANTITIES).
    pub quantity: &'static str,
    /// SI unit of the ratio.
    pub unit: &'static str,
    /// Whether it has a phase; a mean power has none.
    pub has_phase: bool,
    /// The ratio at each frequency, in its unit; `None` where it cannot be told, at an undamped resonance.
    pub swings: Vec<Option<Swing>>,
    /// The peaks within the range, by rising frequency. They are those of the response itself, not
    /// of its values at the frequencies of the list.
    pub resonances: Vec<Resonance>,
    /// The ratio at the [frequency that is asked for](SweepSettings::at); `None` where it cannot be told.
    pub at: Option<Swing>,
    /// The limit at slow oscillation; `None` where there is none.
    pub at_rest: Option<Swing>,
}

impl Transmission {
    /// The largest error of a ratio, relative to it.
    pub fn worst_error(&self) -> f64 {
        let relative =
            |swing: &Swing| if swing.amplitude > 0.0 { swing.error / swing.amplitude } else { 0.0 };
        self.swings.iter().flatten().map(relative).fold(0.0, f64::max)
    }
}

impl Vibration {
    /// What arrives at the masses or at the supports, or what else is asked for, over a range of frequencies.
    ///
    /// # Errors
    ///
    /// [`VibrationError`] for a range or a node that cannot be, and where nothing is to be seen.
    pub fn sweep(&self, settings: &SweepSettings) -> Result<Sweep, VibrationError> {
        self.sweep_watched(settings, &mut |_, _| ControlFlow::Continue(()))
    }

    /// The same; before each response `watch` is told how many of them are done, and may end it.
    ///
    /// # Errors
    ///
    /// As [`sweep`](Self::sweep), and [`VibrationError::Cancelled`].
    pub fn sweep_watched(
        &self,
        settings: &SweepSettings,
        watch: &mut Watch<'_>,
    ) -> Result<Sweep, VibrationError> {
        let poles = self.poles();
        let range = range(settings, poles.as_deref().unwrap_or_default())?;
        let frequencies = frequencies(range, settings.points)?;
        let mut notes = Vec::new();
        if poles.is_none() {
            notes.push(VibrationWarning::ManyUnknowns);
        }
        let poles = poles.unwrap_or_default();
        let onsets = self.onsets(range, &poles);
        notes.extend(onsets.iter().map(|onset| VibrationWarning::Onset {
            onset: onset.clone(),
            drive: self.drive.clone(),
        }));
        let slowest = poles.iter().map(|pole| pole.0.hypot(pole.1)).fold(TAU * range[0], f64::min);
        let transmission = |receiver: &Receiver| {
            let [low, high] = [TAU * range[0] / BEYOND, TAU * range[1] * BEYOND];
            let [first, last] =
                settings.at.map_or([low, high], |at| [low.min(TAU * at), high.max(TAU * at)]);
            let curve = Curve::new(self, &receiver.response, &poles, [first, last]);
            let swing = |frequency: &f64| curve.swing(TAU * frequency).filter(Swing::is_known);
            let extrema = curve.extrema(low, high, &poles);
            Transmission {
                name: receiver.name.clone(),
                quantity: receiver.quantity.word,
                unit: receiver.quantity.unit(self.drive.kind),
                has_phase: receiver.response.form != Form::Power,
                swings: frequencies.iter().map(swing).collect(),
                resonances: resonances(&curve, &extrema, range),
                at: settings.at.as_ref().and_then(swing),
                at_rest: curve.at_rest(slowest),
            }
        };
        let receivers = self.receivers(&settings.of)?;
        let mut transmissions = Vec::with_capacity(receivers.len());
        for (at, receiver) in receivers.iter().enumerate() {
            if watch(at, receivers.len()).is_break() {
                return Err(VibrationError::Cancelled);
            }
            transmissions.push(transmission(receiver));
        }
        let drive = self.drive.clone();
        Ok(Sweep { drive, frequencies, transmissions, onsets, modes: self.modes(), notes })
    }

    /// The natural frequencies and dampings, or the rates of decay, of the network \[rad/s\].
    pub(super) fn poles(&self) -> Option<Vec<(f64, f64)>> {
        let poles = poles(&self.assembly.system)?;
        let largest = poles.iter().map(|pole| pole.norm()).fold(0.0, f64::max);
        let is_own = |own: &&nalgebra::Complex<f64>| own.im >= 0.0 && own.norm() > NOISE * largest;
        Some(poles.iter().filter(is_own).map(|pole| (pole.im, pole.re.abs())).collect())
    }
}

impl Swing {
    fn is_known(&self) -> bool {
        self.amplitude == 0.0 || self.error < 0.5 * self.amplitude
    }
}

impl Curve<'_> {
    /// The limit of slow oscillation, below the angular frequency `slowest` \[rad/s\].
    fn at_rest(&self, slowest: f64) -> Option<Swing> {
        let is_good =
            |swing: &Swing| swing.amplitude > 0.0 && swing.error <= KNOWN * swing.amplitude;
        if let Some(found) = self.swing(0.0).filter(is_good) {
            return Some(found);
        }
        let slow = |shares: [f64; 2]| {
            let [early, late] = shares.map(|share| self.swing(share * slowest));
            let (early, late) = (early?, late?);
            // What is lost in rounding is not zero.
            let fall = early.amplitude / (late.amplitude + late.error);
            let power = fall.ln() / (shares[0] / shares[1]).ln();
            if early.amplitude == 0.0 || power > 0.5 {
                return Some(Swing { amplitude: 0.0, phase: 0.0, error: late.amplitude });
            }
            let error = late.error + (early.amplitude - late.amplitude).abs();
            (error <= KNOWN * late.amplitude).then_some(Swing { error, ..late })
        };
        SLOW.into_iter().find_map(slow)
    }
}

/// The range that is asked for \[Hz\], or one around all natural frequencies.
fn range(settings: &SweepSettings, poles: &[(f64, f64)]) -> Result<[f64; 2], VibrationError> {
    let swinging: Vec<f64> =
        poles.iter().map(|pole| pole.0 / TAU).filter(|own| *own > 0.0).collect();
    let chosen = if swinging.is_empty() {
        USUAL
    } else {
        let low = swinging.iter().copied().fold(f64::INFINITY, f64::min) / AROUND;
        let high = swinging.iter().copied().fold(0.0, f64::max) * AROUND;
        [round(low, f64::floor), round(high, f64::ceil)]
    };
    let low = settings.from.unwrap_or(chosen[0].min(settings.to.unwrap_or(f64::INFINITY) / AROUND));
    let high = settings.to.unwrap_or(chosen[1].max(low * AROUND));
    let is_usable = |own: f64| own.is_normal() && own > 0.0 && (own * TAU * BEYOND).is_finite();
    let invalid = |setting, range, value| VibrationError::InvalidSetting { setting, range, value };
    if !is_usable(low) {
        return Err(invalid("from", "a positive frequency", low));
    }
    if !is_usable(high) {
        return Err(invalid("to", "a positive frequency", high));
    }
    if high <= low {
        return Err(VibrationError::EmptyRange { low, high });
    }
    Ok([low, high])
}

/// A frequency to one digit.
fn round(value: f64, towards: impl Fn(f64) -> f64) -> f64 {
    let power = 10.0_f64.powf(value.log10().floor());
    towards(value / power) * power
}

/// Frequencies at equal ratios, both ends included.
fn frequencies([low, high]: [f64; 2], points: usize) -> Result<Vec<f64>, VibrationError> {
    const MOST: usize = 1_000_000;
    if !(2..=MOST).contains(&points) {
        let (setting, range) = ("points", "from 2 to 1000000");
        return Err(VibrationError::InvalidSetting { setting, range, value: points as f64 });
    }
    let last = points - 1;
    let place = |at: usize| match at {
        0 => low,
        at if at == last => high,
        at => low * (high / low).powf(at as f64 / last as f64),
    };
    Ok((0..points).map(place).collect())
}

impl Vibration {
    /// All nodes of what was compiled.
    pub(super) fn ids(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.network.nodes().map(|node| node.0)
    }
}
