//! The report of a plain impact.

use std::{sync::Arc, time::Duration};

use dashpot_dae::{MethodKind as _, Run, Statistics, Switch, methods};
use dashpot_network::PhasedNetwork;

use super::{later, scene::Scene, shown::Shown};
use crate::{
    Contact, ContactReport, Impact, Ledger, MeasureReport, Reading, RunReport, SolverReport,
    SystemReport,
    errors::instants::Instants,
    report::{
        compression::{Compression, ROUNDING},
        curves::Struck,
        zeros::settle_zeros,
    },
    run::{events, outcome::measure_report},
};

/// Roundings of a time that is found by itself.
const ROUNDINGS: f64 = 4.0;

/// The balances of a run.
pub(super) struct Ledgers {
    pub(super) after_impact: Ledger,
    pub(super) at_end: Ledger,
}

/// What is known of an impact.
pub(super) struct Told {
    /// The measures, then the length of the impact \[s\] …
    pub(super) values: Vec<f64>,
    /// … and how far off each may be; not numbers where nobody asked.
    pub(super) errors: Vec<f64>,
    pub(super) rtol: f64,
    pub(super) struck: Struck,
    /// When the force falls through zero \[s\].
    pub(super) release: f64,
    /// The intervals of criteria that look for one \[s\].
    pub(super) windows: Vec<Option<(f64, f64)>>,
    /// What a spring of this peak force and deformation takes up \[J\].
    pub(super) size_of_work: f64,
    pub(super) energy: Ledgers,
    pub(super) statistics: Statistics,
    /// Work of the solutions besides the last one, and how many they are.
    pub(super) others: Statistics,
    pub(super) solves: usize,
    pub(super) work: u64,
    pub(super) wall: Duration,
}

impl Told {
    /// Whether the energy closes as well as measures are known, the pad is not pressed through, and all of it are
    /// numbers.
    pub(super) fn closes(&self, scene: &Scene<'_>) -> bool {
        let strictest = scene.settings.accuracy.strictest();
        let relative = self.errors.iter().zip(&self.values).map(|(error, value)| error / value);
        let known = relative.filter(|own| own.is_finite()).fold(0.0, f64::max);
        let most = if known > 0.0 { known } else { strictest }.max(ROUNDING);
        let Ledgers { after_impact, at_end } = &self.energy;
        let is_closed = [after_impact, at_end].iter().all(|own| own.closure().abs() <= most);
        let deepest = scene.shown.iter().position(|own| *own == Shown::Depth);
        let is_through = deepest.is_some_and(|at| {
            let own = [self.values[at], self.struck.deepest.time];
            Compression::new(own, Some(self.errors[at]), scene.scales.thickness).is_through()
        });
        is_closed && !is_through && self.values.iter().all(|value| value.is_finite())
    }

    pub(super) fn report(self, scene: &Scene<'_>) -> RunReport {
        let Scene { assembly, settings, parametric, effects, .. } = scene;
        let measures = self.measures(scene);
        let impact = Impact {
            start: scene.fall,
            end: self.release,
            end_error: None,
            contact: Contact::Parted,
        };
        let element = assembly.connections[parametric.element()].name.clone();
        let contacts = vec![ContactReport { element, impact, is_glued: false, again: 0 }];
        let method = methods::Dop853::KIND;
        let (phases, statistics) = (self.phases(scene), self.statistics);
        let end = settings.duration;
        let shell = move || later::shell(method, end, phases.clone(), statistics);
        let skeleton = shell();
        let error = self.errors.last().copied().filter(|error| !error.is_nan());
        let touch = ROUNDINGS * f64::EPSILON * scene.fall;
        let known =
            |switch: &Switch| error.map(|error| if switch.phase > 0 { touch } else { error });
        let switches = skeleton.switches.iter().map(known).collect();
        let instants = Instants { switches, crossings: Vec::new() };
        let run = Run::to(end);
        let events =
            events::collect(&run, assembly, &skeleton, &contacts, &instants, |_: &str| error);
        let Ledgers { after_impact, at_end } = self.energy;
        RunReport {
            solver: SolverReport {
                method,
                why: scene.why.clone(),
                rtol: Some(self.rtol),
                threshold: crate::threshold_at(Some(self.rtol)),
                statistics,
                solves_for_error: self.solves,
                wall_for_error: self.others.wall,
                wall_in_all: self.wall,
                work: self.work,
            },
            system: SystemReport { effects: effects.clone(), ..SystemReport::of(assembly) },
            measures,
            only: Vec::new(),
            contacts,
            energy: at_end,
            energy_after_impact: Some(after_impact),
            events,
            partial: None,
            segmentation: None,
            warnings: Vec::new(),
            limits: settings.limits.clone(),
            scatter: None,
            trajectory: {
                let how = (end, self.rtol, settings.budget);
                later::curves(assembly, how, self.struck, shell)
            },
            assembly: Arc::clone(assembly),
        }
    }

    fn measures(&self, scene: &Scene<'_>) -> Vec<MeasureReport> {
        let Struck { strongest, deepest, .. } = self.struck;
        let (strongest, deepest, release) = (strongest.time, deepest.time, self.release);
        let impact = (scene.fall, release);
        let report = |at: usize| {
            let (entry, shown) = (&scene.selected[at], scene.shown[at]);
            let value = self.values[at];
            let reading = Reading {
                value: Some(value),
                size: shown.size(value),
                window: Some(self.windows[at].unwrap_or(impact)),
                ..Reading::default()
            };
            let reading = match shown {
                Shown::Force | Shown::Acceleration => reading.at(strongest),
                Shown::Depth | Shown::Share => reading.at(deepest),
                Shown::ContactTime => Reading { window: None, ..reading.at(release) },
                Shown::Restitution => reading.at(release),
                Shown::Work => reading.of_size(self.size_of_work),
                Shown::WorkAtEnd => {
                    let window = Some((0.0, scene.settings.duration));
                    Reading { window, ..reading.of_size(self.size_of_work) }
                }
                Shown::Impulse | Shown::Severity | Shown::Hic(_) => reading,
            };
            let error = Some(self.errors[at]).filter(|error| !error.is_nan());
            measure_report(entry, reading, error, scene.settings.accuracy.of(&entry.key))
        };
        let mut reports: Vec<MeasureReport> = (0..scene.selected.len()).map(report).collect();
        settle_zeros(&mut reports, self.size_of_work, self.rtol);
        reports
    }

    /// The phase in which the contact begins, and what switches.
    fn phases(&self, scene: &Scene<'_>) -> (Vec<(usize, f64)>, Vec<Switch>) {
        let parts = scene.assembly.switching.as_deref().map_or(Vec::new(), PhasedNetwork::parts);
        let first = usize::from(scene.fall <= 0.0);
        let switch = |part: usize, time: f64, phase: usize| Switch {
            time,
            part,
            name: parts[part].name.clone(),
            phase,
            what: parts[part].phases.get(phase).copied().unwrap_or_default(),
            memory: 0.0,
            impulse: 0.0,
            lost: 0.0,
            worked: 0.0,
        };
        let touch = (0..parts.len()).filter(|_| first == 0).map(|at| switch(at, scene.fall, 1));
        let release = (0..parts.len()).map(|at| switch(at, self.release, 0));
        (vec![(first, 0.0); parts.len()], touch.chain(release).collect())
    }
}
