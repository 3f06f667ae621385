//! Contacts and stops of a network that shakes. As long as a weight keeps a contact closed, and a
//! stop is not reached, the network answers as if it had neither.

use std::borrow::Cow;

use dashpot_dae::{Waveform, frequency::FrequencyResponse};
use dashpot_network::{
    Assembly, Connection, Detail, Effect, Network,
    effects::{Separation, Stop},
};

use super::{
    DriveKind, Vibration, VibrationError, VibrationWarning,
    curve::Curve,
    observed::{Found, Observed},
};

/// A contact counts as loose at rest where it carries less than this part of the largest force.
const LOOSE: f64 = 1e-9;

/// A force or deformation at rest is known better than this, relatively, or not at all.
const LOST: f64 = 1e-6;

/// Why a response holds for small oscillations only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitKind {
    /// A contact parts where its force swings by more than a weight presses on it \[N\].
    Parting,
    /// An element reaches its stop where its deformation swings by more than it has left \[m\].
    Stop,
}

impl LimitKind {
    /// SI unit of what is limited.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Parting => "N",
            Self::Stop => "m",
        }
    }
}

/// A contact or stop of the network, which is as at rest in small oscillations.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// What happens beyond it.
    pub kind: LimitKind,
    /// The contact or stop, for instance `padding.contact`.
    pub name: String,
    /// By how much its force \[N\] or deformation \[m\] may swing: the force at rest, or what is left to the stop.
    pub reserve: f64,
    /// The element, in [`Assembly::connections`].
    element: usize,
    /// Whether it is the second end of the element that parts.
    at_second: bool,
}

/// Where an oscillation reaches a limit first.
#[derive(Debug, Clone, PartialEq)]
pub struct Onset {
    /// The limit.
    pub limit: Limit,
    /// The frequency \[Hz\] at which the smallest drive does: the smallest force of a load, or the
    /// smallest acceleration of a motion.
    pub frequency: f64,
    /// The amplitude of the drive there \[N or m\].
    pub amplitude: f64,
}

/// The network without its separations and stops, and these.
pub(super) fn closed(network: &Network) -> (Cow<'_, Network>, Vec<Opening<'_>>) {
    let effects = network.effects().iter().enumerate();
    let (details, openings): (Vec<Detail>, Vec<Opening<'_>>) =
        effects.filter_map(|(at, own)| Some((Detail::Effect(at), opening(own.as_ref())?))).unzip();
    if openings.is_empty() {
        return (Cow::Borrowed(network), openings);
    }
    (Cow::Owned(network.without(&details)), openings)
}

/// An effect that opens or closes something.
pub(super) enum Opening<'n> {
    Separation(&'n Separation),
    Stop(&'n Stop),
}

fn opening(effect: &dyn Effect) -> Option<Opening<'_>> {
    let stop = || effect.of_kind().map(Opening::Stop);
    effect.of_kind().map(Opening::Separation).or_else(stop)
}

/// The force \[N\] that presses the contact of an element together.
fn contact_force(assembly: &Assembly, element: usize, at_second: bool) -> Option<usize> {
    // A face with mass is linked by a contact of its own.
    let contact = assembly.pad(element).and_then(|pad| pad.contact);
    let own = &assembly.connections[element];
    let through = if at_second { own.transmitted } else { own.force };
    contact.map_or(through, |contact| assembly.connections[contact].force)
}

impl Limit {
    /// What swings up to the reserve, over `(iω)^order`.
    fn observed(&self, vibration: &Vibration, order: i32) -> Option<Observed> {
        let assembly = &vibration.assembly;
        let output = match self.kind {
            LimitKind::Parting => contact_force(assembly, self.element, self.at_second)?,
            LimitKind::Stop => assembly.connections[self.element].deformation,
        };
        Some(Observed::output(&self.name, output, order))
    }
}

impl Vibration {
    /// What `openings` of `network`, which are closed here, limit.
    ///
    /// The network rests under all that acts for good, which is its response at the frequency 0.
    pub(super) fn limits_of(
        &self,
        network: &Network,
        openings: &[Opening<'_>],
    ) -> Result<Vec<Limit>, VibrationError> {
        if openings.is_empty() {
            return Ok(Vec::new());
        }
        let Assembly { system, connections, .. } = &self.assembly;
        let is_still = |own: (&Waveform, &f64)| if *own.1 == 0.0 { own.0.value(0.0) } else { 0.0 };
        let units: Vec<f64> = system.waveforms.iter().zip(&self.units).map(is_still).collect();
        let acts = units.iter().any(|unit| *unit != 0.0);
        let still = FrequencyResponse::new(system, &units).and_then(|own| own.at(0.0));
        if acts && still.is_none() {
            return Err(VibrationError::Rest);
        }
        let still = still.as_ref().filter(|_| acts);
        let at_rest = |output: usize| still.map(|still| still.amplitude(&[(output, 1.0)]));
        let forces = connections.iter().filter_map(|connection| connection.force);
        let size = |output: usize| at_rest(output).map_or(0.0, |own| own.value.norm());
        let largest = forces.map(size).fold(0.0, f64::max);
        // Where something drifts, rounding alone may give it a place of rest.
        let value = |output: usize, size: f64| match at_rest(output) {
            Some(own) if own.error > LOST * size => Err(VibrationError::Rest),
            own => Ok(own.map_or(0.0, |own| own.value.re)),
        };
        let whole = network.with_effects()?;
        let mut limits = Vec::new();
        for opening in openings {
            let (Opening::Separation(Separation { element, .. })
            | Opening::Stop(Stop { element, .. })) = opening;
            let named = |connection: &Connection| connection.name == *element;
            let Some(element) = network.connections().iter().position(named) else { continue };
            let own = &network.connections()[element];
            let name = |at: Option<usize>| Some(whole.connections()[at?].name.clone());
            let Some(pad) = whole.pad(element) else { continue };
            match opening {
                Opening::Separation(separation) => {
                    let second = &network.node(own.between[1]).name;
                    let at_second = separation.at.as_ref() == Some(second);
                    let Some(name) = name(pad.contact) else { continue };
                    let force = contact_force(&self.assembly, element, at_second);
                    let reserve = force.map_or(Ok(0.0), |force| value(force, largest))?;
                    if reserve <= LOOSE * largest {
                        return Err(VibrationError::Loose { contact: name });
                    }
                    limits.push(Limit {
                        kind: LimitKind::Parting,
                        name,
                        reserve,
                        element,
                        at_second,
                    });
                }
                Opening::Stop(stop) => {
                    let at = stop.at.or(own.thickness).zip(name(pad.stop));
                    let Some((at, name)) = at else { continue };
                    let reserve = at - value(connections[element].deformation, at)?;
                    if reserve <= 0.0 {
                        return Err(VibrationError::OnStop { stop: name });
                    }
                    let kind = LimitKind::Stop;
                    limits.push(Limit { kind, name, reserve, element, at_second: false });
                }
            }
        }
        Ok(limits)
    }

    /// The contacts and stops beyond which the response does not hold.
    pub fn limits(&self) -> &[Limit] {
        &self.limits
    }

    /// The limits that an oscillation of this amplitude exceeds; `read` is what it is for one unit of the drive.
    pub(super) fn exceeded(
        &self,
        read: impl Fn(&Observed) -> Option<Found>,
        frequency: f64,
        amplitude: f64,
    ) -> Vec<VibrationWarning> {
        let over = |limit: &Limit| {
            let swing = read(&limit.observed(self, 0)?)?.value.norm() * amplitude;
            (swing > limit.reserve).then(|| VibrationWarning::Exceeded {
                limit: limit.clone(),
                frequency,
                amplitude: swing,
            })
        };
        self.limits.iter().filter_map(over).collect()
    }

    /// Where each limit is reached first, over a range of frequencies \[Hz\].
    pub(super) fn onsets(&self, range: [f64; 2], poles: &[(f64, f64)]) -> Vec<Onset> {
        let tau = std::f64::consts::TAU;
        let order = if self.drive.kind == DriveKind::Motion { 2 } else { 0 };
        let onset = |limit: &Limit| {
            let response = limit.observed(self, order)?.into();
            let [low, high] = range.map(|own| tau * own);
            let curve = Curve::new(self, &response, poles, [low, high]);
            let extrema = curve.extrema(low, high, poles);
            let first =
                extrema.iter().max_by(|a, b| a.probe.level.total_cmp(&b.probe.level))?.probe;
            let size = limit.reserve / (0.5 * first.level).exp();
            let over = if order == 0 { 1.0 } else { first.omega * first.omega };
            let (frequency, amplitude) = (first.omega / tau, size / over);
            Some(Onset { limit: limit.clone(), frequency, amplitude })
        };
        self.limits.iter().filter_map(onset).collect()
    }
}
