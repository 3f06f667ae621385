//! Which runs are of plain impacts, and what is asked of one.

use std::sync::Arc;

use dashpot_dae::{Method as _, Run, SolveError, methods};
use dashpot_network::{Assembly, ConnectionOutputs, Network, ParametricSystem, SegmentPlace};

use super::{
    MOST_STATES,
    shown::{Scales, Shown, Wanted, shown_by},
    stepped::Course,
};
use crate::{
    Choice, SolveSettings,
    measures::{
        hic_search::optimum,
        selection::{Selected, select},
    },
    report::compression::is_as_thick,
};

/// A run that may be of a plain impact.
pub(super) struct Scene<'s> {
    pub(super) assembly: &'s Arc<Assembly>,
    pub(super) effects: Vec<&'static str>,
    pub(super) settings: &'s SolveSettings,
    pub(super) parametric: ParametricSystem,
    /// The pad once it has let go what struck it.
    pub(super) released: ParametricSystem,
    pub(super) numbers: Vec<f64>,
    pub(super) selected: Vec<Selected>,
    pub(super) shown: Vec<Shown>,
    /// The part of a value that each measure may be off by.
    wishes: Vec<f64>,
    pub(super) scales: Scales,
    /// How long what strikes falls before it touches \[s\].
    pub(super) fall: f64,
    /// Why it is by explicit steps.
    pub(super) why: String,
}

impl<'s> Scene<'s> {
    /// `None` where something else acts, another method is asked for, or a measure that the impact alone does not tell.
    pub(super) fn of(
        network: &Network,
        assembly: &'s Arc<Assembly>,
        settings: &'s SolveSettings,
    ) -> Option<Self> {
        let is_auto = matches!(settings.method, Choice::Auto);
        if !is_auto || !settings.stops.is_empty() || assembly.switching.is_none() {
            return None;
        }
        if !(assembly.warnings.is_empty() && assembly.held.is_empty()) {
            return None;
        }
        let run = Run::to(settings.duration);
        let Err(SolveError::NotApplicable { method, reason }) =
            methods::Exact.applies(&assembly.system, &run)
        else {
            return None;
        };
        let (parametric, numbers) = ParametricSystem::with_numbers(network, settings.duration)?;
        let are_all_told = assembly.primitives.len() == parametric.primitives();
        let is_covered = !parametric.is_linear() && are_all_told && assembly.drives.len() <= 1;
        let released =
            parametric.released().filter(|own| is_covered && own.states() <= MOST_STATES)?;
        let struck = parametric.element();
        let is_whole = |(at, own): (usize, &ConnectionOutputs)| {
            let is_one = own.segments.iter().all(|part| {
                part.place == SegmentPlace::Whole
                    || own.thickness.is_some_and(|whole| is_as_thick(part.thickness, whole))
            });
            if at == struck { is_one } else { own.segments.is_empty() && own.thickness.is_none() }
        };
        if !assembly.connections.iter().enumerate().all(is_whole) {
            return None;
        }
        let selected = select(assembly, &settings.measures, &settings.limits).ok()?;
        let is_known = |key: &String| selected.iter().any(|own| own.key == *key);
        if !settings.accuracy.by_measure.keys().all(is_known) {
            return None;
        }
        let mut wanted = Wanted::default();
        let shown = |own: &Selected| shown_by(own, &parametric, &mut wanted);
        let shown: Vec<Shown> = selected.iter().map(shown).collect::<Option<_>>()?;
        let wishes = selected.iter().map(|own| settings.accuracy.of(&own.key)).collect();
        let scales = Scales {
            time: parametric.time_scale(),
            mass: parametric.impactor_mass(&numbers),
            thickness: assembly.connections[struck].thickness.unwrap_or(f64::NAN),
            exponent: wanted.power.unwrap_or(1.0),
        };
        let fall = assembly.nodes[parametric.impactor().index()].fall;
        let effects = network.effects().iter().map(|effect| effect.kind()).collect();
        Some(Self {
            assembly,
            effects,
            settings,
            parametric,
            released,
            numbers,
            selected,
            shown,
            wishes,
            scales,
            fall,
            why: format!("`{method}` declines: {reason}"),
        })
    }

    /// The measures, and when the impact ends \[s\] after the touch, each with what its error is a part of.
    pub(super) fn read<const N: usize>(&self, course: &Course<N>) -> Vec<[f64; 2]> {
        let own = self.shown.iter().map(|&shown| self.scales.figure(shown, course));
        own.chain([[course.release * self.scales.time; 2]]).collect()
    }

    /// Whether no error exceeds what is wanted.
    pub(super) fn suffice(&self, values: &[f64], errors: &[f64]) -> bool {
        let strictest = self.settings.accuracy.strictest();
        let wishes = self.wishes.iter().copied().chain([strictest]);
        let sizes = self.shown.iter().zip(values).map(|(shown, value)| shown.size(*value));
        let sizes = sizes.chain(values.last().copied());
        wishes.zip(sizes).zip(errors).all(|((wish, size), error)| *error <= wish * size)
    }

    /// The intervals of criteria that look for one \[s\], by measure.
    pub(super) fn windows<const N: usize>(&self, course: &Course<N>) -> Vec<Option<(f64, f64)>> {
        let time = self.scales.time;
        let own = self.shown.iter().map(|shown| {
            let Shown::Hic(cap) = shown else { return None };
            let (from, to) = optimum(&course.force, (0.0, course.release), cap / time).interval;
            Some((self.fall + from * time, self.fall + to * time))
        });
        own.collect()
    }
}
