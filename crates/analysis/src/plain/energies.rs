//! Where the energy of a plain impact goes.

use dashpot_network::{Assembly, PartRow, elements::Law};
use dashpot_numerics::small::dot;

use super::{aftermath::Flight, stepped::Track};
use crate::{Ledger, energy::roles::EnergyRole};

fn stored_in<const N: usize>(assembly: &Assembly, part: &PartRow<N>, z: &[f64; N]) -> f64 {
    let element = &assembly.primitives[part.primitive].element;
    if EnergyRole::of(element.as_ref()).stores {
        element.stored(dot(&part.deformation, z))
    } else {
        0.0
    }
}

/// A part of a run in which one set of equations holds.
pub(super) struct Leg<'l, const N: usize> {
    pub(super) track: &'l Track<N>,
    pub(super) parts: &'l [PartRow<N>],
    pub(super) masses: &'l [(f64, [f64; N])],
    /// When it ends, dimensionless, and the unknowns then.
    pub(super) end: (f64, [f64; N]),
}

/// The balance as it grows.
#[derive(Debug, Clone)]
pub(super) struct Balance {
    start: f64,
    kinetic: f64,
    /// What of the kinetic energy has left the pad.
    flying: f64,
    /// By primitive.
    stored: Vec<f64>,
    done: Vec<f64>,
    work_in: f64,
    most: f64,
}

impl Balance {
    /// That of masses which hold so much energy \[J\] at the touch, of which what pulls them has done the part
    /// `fallen` before.
    pub(super) fn at_touch(assembly: &Assembly, energy: f64, fallen: f64) -> Self {
        let none = vec![0.0; assembly.primitives.len()];
        Self {
            start: energy - fallen,
            kinetic: energy,
            flying: 0.0,
            stored: none.clone(),
            done: none,
            work_in: fallen,
            most: energy,
        }
    }

    /// Adds a leg, whose unit of time is `time` \[s\].
    pub(super) fn add<const N: usize>(&mut self, assembly: &Assembly, leg: &Leg<'_, N>, time: f64) {
        let window = (0.0, leg.end.0);
        for part in leg.parts {
            let element = assembly.primitives[part.primitive].element.as_ref();
            if EnergyRole::of(element).dissipates {
                let power = leg.track.signal(&|z| {
                    let rate = dot(&part.rate, z);
                    element.force(dot(&part.deformation, z), rate) * rate
                });
                self.done[part.primitive] += power.integral(window) * time;
            }
            self.stored[part.primitive] = stored_in(assembly, part, &leg.end.1);
            let depth = |z: &&[f64; N]| dot(&part.deformation, z).abs();
            let deepest = leg.track.nodes().max_by(|one, two| depth(one).total_cmp(&depth(two)));
            self.most = deepest.map_or(0.0, |z| stored_in(assembly, part, z)).max(self.most);
        }
        let energy = |(mass, row): &(f64, [f64; N])| 0.5 * mass * dot(row, &leg.end.1).powi(2);
        self.kinetic = self.flying + leg.masses.iter().map(energy).sum::<f64>();
    }

    /// Adds the work \[J\] of what pulls the masses.
    pub(super) fn add_work(&mut self, work: f64) {
        self.work_in += work;
    }

    /// Lets a mass \[kg\] fly, after so many seconds of which the balance is taken.
    pub(super) fn let_go(&mut self, mass: f64, flight: Flight, seconds: f64) {
        let [before, after] =
            [flight.speed, flight.speed_after(seconds)].map(|speed| 0.5 * mass * speed * speed);
        self.flying = after;
        self.work_in += after - before;
        self.most = self.most.max(after);
    }

    /// The ledger at `end` \[s\].
    pub(super) fn ledger(&self, assembly: &Assembly, end: f64) -> Ledger {
        let (mut stored, mut dissipated) = (Vec::new(), Vec::new());
        for (at, primitive) in assembly.primitives.iter().enumerate() {
            let own = EnergyRole::of(primitive.element.as_ref());
            let is_phased = primitive.element.law() == Law::Phased;
            let gained = if own.stores && !is_phased { self.stored[at] } else { 0.0 };
            if own.stores {
                stored.push((primitive.name.clone(), gained));
            }
            if own.dissipates {
                dissipated.push((primitive.name.clone(), self.done[at] - gained));
            }
        }
        let drives = assembly.drives.iter();
        let work_in: Vec<(String, f64)> =
            drives.map(|drive| (drive.name.clone(), self.work_in)).collect();
        let total = |entries: &[(String, f64)]| entries.iter().map(|own| own.1).sum::<f64>();
        let supplied = self.start + self.work_in.max(0.0);
        let kept = self.kinetic + total(&stored) + total(&dissipated);
        let most = if assembly.drives.is_empty() { 0.0 } else { self.most };
        Ledger {
            time: end,
            start: self.start,
            kinetic: self.kinetic,
            in_layers: Vec::new(),
            turned_over: supplied.max(kept).max(most),
            stored,
            dissipated,
            work_in,
            error: None,
        }
    }
}
