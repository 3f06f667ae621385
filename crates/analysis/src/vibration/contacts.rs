//! Contacts and stops of a network that shakes. As long as a weight keeps a contact closed, and a
//! stop is not reached, the network answers as if it had neither.

use std::borrow::Cow;

use dashpot_dae::Silent;
use dashpot_network::{
    Assembly, Connection, Detail, Effect, Network, Start,
    effects::{Gravity, GravityStart, Separation, Stop},
};

use super::{
    Drive, DriveKind, Vibration, VibrationError, VibrationWarning,
    curve::Curve,
    drive::Driven,
    error,
    observed::{Found, Observed},
};
use crate::{Solution, SolveSettings, solve_assembly};

/// A contact counts as loose at rest where it carries less than this part of the largest force.
const LOOSE: f64 = 1e-9;

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

/// The network without its separations and stops, and what they limit.
pub(super) fn closed(
    network: &Network,
    duration: f64,
) -> Result<(Cow<'_, Network>, Vec<Limit>), VibrationError> {
    let effects = network.effects().iter().enumerate();
    let found: Vec<_> =
        effects.filter_map(|(at, own)| Some((at, opening(own.as_ref())?))).collect();
    if found.is_empty() {
        return Ok((Cow::Borrowed(network), Vec::new()));
    }
    let details: Vec<Detail> = found.iter().map(|own| Detail::Effect(own.0)).collect();
    let linear = network.without(&details);
    let mut limits = Vec::new();
    let rest = Rest::of(&linear, duration)?;
    let solution = rest.report.solution();
    let whole = network.with_effects()?;
    for (_, opening) in found {
        let (Opening::Separation(Separation { element, .. }) | Opening::Stop(Stop { element, .. })) =
            opening;
        let named = |connection: &Connection| connection.name == *element;
        let Some(element) = network.connections().iter().position(named) else { continue };
        let own = &network.connections()[element];
        let name = |at: Option<usize>| Some(whole.connections()[at?].name.as_str());
        let pad = whole.pad(element);
        let limit = match opening {
            Opening::Separation(separation) => {
                let second = &network.node(own.between[1]).name;
                let at_second = separation.at.as_ref() == Some(second);
                let Some(name) = pad.and_then(|pad| name(pad.contact)) else { continue };
                parting(&solution, name, (element, at_second))?
            }
            Opening::Stop(own_stop) => {
                let at = own_stop.at.or(own.thickness);
                let Some((at, pad)) = at.zip(pad) else { continue };
                let Some(name) = name(pad.stop) else { continue };
                stop(&solution, name, (element, at))?
            }
        };
        limits.push(limit);
    }
    Ok((Cow::Owned(linear), limits))
}

/// An effect that opens or closes something.
enum Opening<'n> {
    Separation(&'n Separation),
    Stop(&'n Stop),
}

fn opening(effect: &dyn Effect) -> Option<Opening<'_>> {
    let stop = || effect.of_kind().map(Opening::Stop);
    effect.of_kind().map(Opening::Separation).or_else(stop)
}

/// A linear network under its weights, with nothing that moves.
struct Rest {
    report: crate::RunReport,
}

impl Rest {
    fn of(network: &Network, duration: f64) -> Result<Self, VibrationError> {
        let assembly = network.compile(duration)?;
        error::require_linear_system(&assembly)?;
        let silence = Drive {
            name: String::new(),
            kind: DriveKind::Load,
            node: network.node(network.ground()).name.clone(),
        };
        let still = Driven::new(network, &assembly, &silence, duration)?.network;
        let own = still.effects().iter().enumerate();
        let own: Vec<_> = own.filter_map(|(at, own)| Some((at, own.gravity()?))).collect();
        let weights: Vec<Detail> = own.iter().map(|own| Detail::Effect(own.0)).collect();
        let mut still = still.without(&weights);
        still.nodes_mut().iter_mut().for_each(|node| node.start = Start::Rest);
        for (_, acceleration) in own {
            still.add_effect(Gravity { acceleration, start: GravityStart::Equilibrium });
        }
        let settings = SolveSettings { estimate: false, ..SolveSettings::lasting(duration) };
        let assembly = std::sync::Arc::new(still.compile(duration)?);
        let report = solve_assembly(&assembly, &[], &settings, &mut Silent);
        Ok(Self {
            report: report.map_err(|error| VibrationError::Rest { error: error.to_string() })?,
        })
    }
}

/// The force \[N\] that presses the contact of an element together.
fn contact_force(assembly: &Assembly, element: usize, at_second: bool) -> Option<usize> {
    // A face with mass is linked by a contact of its own.
    let contact = assembly.pad(element).and_then(|pad| pad.contact);
    let own = &assembly.connections[element];
    let through = if at_second { own.transmitted } else { own.force };
    contact.map_or(through, |contact| assembly.connections[contact].force)
}

fn parting(
    rest: &Solution<'_>,
    name: &str,
    (element, at_second): (usize, bool),
) -> Result<Limit, VibrationError> {
    let assembly = rest.assembly();
    let force = |at: usize| rest.signal(at).value(0.0);
    let reserve = contact_force(assembly, element, at_second).map_or(0.0, force);
    let all = assembly.connections.iter().filter_map(|connection| connection.force);
    let largest = all.map(|at| force(at).abs()).fold(0.0, f64::max);
    let name = name.to_owned();
    if reserve > LOOSE * largest {
        Ok(Limit { kind: LimitKind::Parting, name, reserve, element, at_second })
    } else {
        Err(VibrationError::Loose { contact: name })
    }
}

fn stop(
    rest: &Solution<'_>,
    name: &str,
    (element, at): (usize, f64),
) -> Result<Limit, VibrationError> {
    let own = rest.assembly().connections[element].deformation;
    let (reserve, name) = (at - rest.signal(own).value(0.0), name.to_owned());
    if reserve > 0.0 {
        Ok(Limit { kind: LimitKind::Stop, name, reserve, element, at_second: false })
    } else {
        Err(VibrationError::OnStop { stop: name })
    }
}

impl Limit {
    /// What swings up to the reserve, over `(iω)^order`.
    fn observed(&self, vibration: &Vibration, order: u32) -> Option<Observed> {
        let assembly = &vibration.assembly;
        let output = match self.kind {
            LimitKind::Parting => contact_force(assembly, self.element, self.at_second)?,
            LimitKind::Stop => assembly.connections[self.element].deformation,
        };
        Some(Observed::output(&self.name, output, order))
    }
}

impl Vibration {
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
            let observed = limit.observed(self, order)?;
            let [low, high] = range.map(|own| tau * own);
            let curve = Curve::new(self, &observed, poles, [low, high]);
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
