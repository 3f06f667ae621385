//! What tests over time have in common.

use super::{
    Specimen,
    history::{self, Drive, History, Instant, Parts, instants},
    report::{Computation, Figure, RheometerReport, Series, Setting, series},
    rig::Rig,
    simulation::Simulation,
};
use crate::{Choice, Column};

/// A model under a history, in closed form and simulated.
pub(super) struct Trial<'a> {
    specimen: &'a Specimen,
    history: History,
    drive: Drive,
    instants: Vec<Instant>,
    times: Vec<f64>,
    methods: &'a [Choice],
    simulations: Vec<Simulation>,
}

impl<'a> Trial<'a> {
    /// Simulates the specimen under `history`, looked at about `points` times.
    pub(super) fn new(
        specimen: &'a Specimen,
        drive: Drive,
        history: History,
        points: usize,
        methods: &'a [Choice],
    ) -> Self {
        let instants = instants(&history, specimen.range_of_times().0, points);
        let rig = Rig::new(specimen.model(), drive, &history);
        let simulate = |method: &Choice| Simulation::new(&rig, method, &instants);
        let simulations = methods.iter().map(simulate).collect();
        let times = instants.iter().map(|instant| instant.time).collect();
        Self { specimen, history, drive, instants, times, methods, simulations }
    }

    /// The parts of the deformation at an instant, in closed form; zero for what bears no force.
    pub(super) fn parts(&self, at: Instant) -> Parts {
        let form = self.specimen.kelvin();
        form.map_or_else(Parts::default, |form| history::deformation(form, &self.history, at))
    }

    /// The answer of a linear model at an instant, in closed form: deformation \[m\] or force \[N\];
    /// infinite where it has none.
    pub(super) fn answer(&self, at: Instant) -> f64 {
        if self.specimen.linear().is_none() {
            return f64::INFINITY;
        }
        match (self.drive, self.specimen.maxwell()) {
            (Drive::Force, _) => self.parts(at).total(),
            (Drive::Deformation, Some(form)) => history::force(form, &self.history, at),
            (Drive::Deformation, None) => f64::INFINITY,
        }
    }

    /// The row of an instant that was looked at.
    pub(super) fn row(&self, at: Instant) -> Option<usize> {
        self.instants.iter().position(|&instant| instant == at)
    }

    /// The answer that the first simulation found at an instant that it was looked at.
    pub(super) fn simulated(&self, at: Instant) -> Option<f64> {
        let row = self.row(at)?;
        self.simulations.first()?.tracks.first()?.values.get(row).copied().flatten()
    }

    /// The answer over time.
    pub(super) fn series(&self) -> Series {
        let is_linear = self.specimen.linear().is_some();
        let known = self.instants.iter().filter(|_| is_linear);
        let model = known.map(|&at| self.answer(at)).collect();
        let tracks = self.simulations.iter().filter_map(|simulation| simulation.tracks.first());
        let (name, unit) = match self.drive {
            Drive::Force => ("deformation", "m"),
            Drive::Deformation => ("force", "N"),
        };
        series(name, unit, &self.times, model, tracks)
    }

    /// The parts of the deformation over time, simulated with the Kelvin form in place of the model.
    pub(super) fn series_of_parts(&self) -> Vec<Series> {
        let parts: Vec<Parts> = self.instants.iter().map(|&at| self.parts(at)).collect();
        let chain = self.specimen.kelvin_chain();
        let names: Vec<&str> = chain.iter().map(|(name, _)| *name).collect();
        let mut simulations = Vec::new();
        if !chain.is_empty() {
            let rig = Rig::chain(chain, self.drive, &self.history);
            let simulate = |method: &Choice| Simulation::new(&rig, method, &self.instants);
            simulations.extend(self.methods.iter().map(simulate));
        }
        let of = |name: &'static str, value: fn(&Parts) -> f64| {
            let track = names.iter().position(|&known| known == name);
            let tracks = simulations.iter().filter_map(|simulation| simulation.tracks.get(track?));
            series(name, "m", &self.times, parts.iter().map(value).collect(), tracks)
        };
        vec![
            of("instantaneous", |parts| parts.instantaneous),
            of("delayed", |parts| parts.delayed),
            of("viscous", |parts| parts.viscous),
        ]
    }

    /// The report without notes; of the figures of the test it has the answers at these instants.
    pub(super) fn report(
        &self,
        protocol: &'static str,
        settings: Vec<Setting>,
        looks: &[(&'static str, Instant)],
    ) -> RheometerReport {
        let (name, unit) = match self.drive {
            Drive::Force => ("force", "N"),
            Drive::Deformation => ("deformation", "m"),
        };
        let values = self.instants.iter().map(|&at| self.history.value(at)).collect();
        let computation = |simulation: &Simulation| Computation {
            method: simulation.method,
            reach: simulation.reach,
            obstacle: simulation.obstacle.clone(),
        };
        let series = self.series();
        let look = |&(name, at): &(&'static str, Instant)| {
            Figure::of(name, series.unit, self.answer(at)).computed(self.simulated(at))
        };
        let figures = self.specimen.figures().into_iter().chain(looks.iter().map(look)).collect();
        RheometerReport {
            protocol,
            settings,
            abscissa: Column { name: "time".to_owned(), unit: "s", values: self.times.clone() },
            drive: Some(Column { name: name.to_owned(), unit, values }),
            figures: Figure::settled(figures),
            series: vec![series],
            computations: self.simulations.iter().map(computation).collect(),
            notes: Vec::new(),
        }
    }
}
