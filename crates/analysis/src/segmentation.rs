//! What the segments of layers make of the measures of a run.
//!
//! A pad of layers is cut into segments, and a method may solve these as exactly as it likes: the
//! layers are not those segments. So the network is solved once more with half as many, and the
//! measures are compared. What is smooth is right to the second order of the length of a segment: of
//! the difference, a third is the error. A front, as wide as the cube root of the segments that it has
//! passed, is right to the order of ⅓ only at worst, where the error is 3.9 times the difference.
//!
//! Where a body strikes the layers directly, the front is as steep as the segments. The ripples behind it have no
//! order at all, so that two numbers of segments may agree by chance: a third number is solved, forces are known to
//! the height of the ripples, and the times at which they let go to the width of the front. A force that comes within
//! the ripples of zero may have let go there: what that makes of the measures is their error as well.
//!
//! How high they are follows from the dispersion of the chain, `ω = (2/Δt) sin(k h/2)` with the passage `Δt` of a wave
//! through a segment of length `h`: by the method of stationary phase a step that has been travelling for `T` is followed
//! at the time `t` by a ripple of `√(Δt/(π T)) ((t/T)² − 1)^(−3/4)` of its velocity, and `T/t` of that in the force on a
//! face that it meets. It falls with the root of the number of segments.

use std::{f64::consts::PI, sync::Arc, time::Instant};

use dashpot_dae::Observer;
use dashpot_network::{
    Network, NetworkWarning,
    parameters::Kind as _,
    segments::{Recut, recut},
};

use crate::{
    Choice, MeasureReport, RunError, RunReport, Segmentation, SolveSettings, Warning,
    impact::interval::front,
    measures::{
        ContactTime, PeakAcceleration, PeakForce, PeakStrain, PeakStress, TransmittedForce,
        selection::select,
    },
    run::{solve_assembly, words},
    solution::releases_in_ripples,
};

/// What the error is taken as at least, in parts of the difference.
const SAFETY: f64 = 4.0;
/// The parts of the segments that a run is compared with, the second one where a front is steep.
const PARTS: [f64; 2] = [0.5, 2.0 / 3.0];

/// By how much a front exceeds its step at most, where its ripples begin: the largest integral of Airy's function.
const HIGHEST: f64 = 0.275;
/// So many steps are looked at.
const MOST_ECHOES: usize = 1000;

/// The run with the errors of its measures widened by what the segments of its layers make of them: one further
/// solution where there are any, and errors are wanted; two where a front is steep. Errors: as [`solve_assembly`].
pub(crate) fn with_segments(
    network: &Network,
    mut report: RunReport,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    if !settings.estimate {
        return Ok(report);
    }
    let started = Instant::now();
    let steep = Steep::of(&report);
    let parts = if steep.is_empty() { &PARTS[..1] } else { &PARTS[..] };
    let mut off = vec![Off::default(); report.measures.len()];
    let mut told: Option<(f64, [usize; 2])> = None;
    let mut others = Vec::new();
    for &part in parts {
        let Some(cut) = recut(network, part) else { return Ok(report) };
        let counts = [cut.segments, cut.others];
        if told.is_some_and(|own| own.1 == counts) {
            continue;
        }
        let assembly = Arc::new(cut.network.compile(settings.duration)?);
        // A method with steps is as good for the others, and they tell of the segments alone.
        let method = match report.solver.rtol {
            Some(_) => Choice::named(report.solver.method)?,
            None => settings.method.clone(),
        };
        let (rtol, estimate) = (report.solver.rtol, false);
        let own = SolveSettings { method, rtol, estimate, ..settings.clone() };
        let other = solve_assembly(&assembly, &words(&cut.network), &own, observer)?;
        told.get_or_insert((cut.stated, counts));
        others.push((safety(&cut), other));
    }
    for (safety, other) in &others {
        let values = other.by_key();
        for (off, measure) in off.iter_mut().zip(&report.measures) {
            let opposite = values.get(measure.key.as_str()).and_then(|own| own.value);
            off.widen(measure.value, opposite, *safety);
        }
    }
    report.solver.solves_for_error += others.len();
    let Some((stated, counts)) = told else { return Ok(report) };
    for (off, earlier) in off.iter_mut().zip(let_go(&report, &steep, settings, &others)?) {
        off.earlier = earlier;
    }
    let mut worst: Vec<(String, f64)> = Vec::new();
    for (off, measure) in off.iter().zip(&mut report.measures) {
        let least = steep.iter().map(|own| own.least(measure)).fold(0.0, f64::max);
        let Some(error) = &mut measure.error else { continue };
        // When it lets go is known to the width of a front, and does not hang on the segments otherwise.
        let added = if !steep.is_empty() && measure.kind == ContactTime::KIND {
            off.largest.max(off.earlier).max(least)
        } else {
            off.error.max(least) + off.earlier
        };
        *error += added;
        if added > 0.0 {
            measure.excess = *error / (settings.accuracy.of(&measure.key) * measure.size);
        }
        let part = if off.difference > 0.0 { off.difference / measure.size } else { 0.0 };
        if part > stated {
            worst.push((measure.key.clone(), part));
        }
    }
    if !worst.is_empty() {
        worst.sort_by(|one, other| other.1.total_cmp(&one.1));
        report.warnings.push(Warning::Segments { measures: worst, stated, counts });
    }
    report.solver.wall_for_error += started.elapsed();
    let [segments, others] = counts;
    report.segmentation = Some(Segmentation { segments, others });
    Ok(report)
}

/// By how much each measure changes if what is struck lets go where its force comes within the ripples of zero, and the
/// `others` do not agree that it pushes on; nothing where it does not come so near.
fn let_go(
    report: &RunReport,
    steep: &[Steep],
    settings: &SolveSettings,
    others: &[(f64, RunReport)],
) -> Result<Vec<f64>, RunError> {
    if steep.is_empty() {
        return Ok(Vec::new());
    }
    let solution = report.solution();
    let impact = solution.scene_impact();
    let height = |own: &Steep| own.ripples(impact.end - impact.start);
    let level = steep.iter().map(height).fold(0.0, f64::max);
    let make_others = || others.iter().map(|own| own.1.solution()).collect::<Vec<_>>();
    let ends = releases_in_ripples(&solution, &make_others, level);
    let earlier = report.solution().ending(ends);
    let selected = select(&report.assembly, &settings.measures, &settings.limits)?;
    let changes = selected.iter().zip(&report.measures).map(|(entry, own)| {
        let other = entry.measure.read(&earlier, entry.target).value;
        own.value.zip(other).map_or(0.0, |(own, other)| (own - other).abs())
    });
    Ok(changes.collect())
}

/// What the error is, in parts of the difference of two numbers of segments, where it falls with their cube root.
fn safety(recut: &Recut) -> f64 {
    let ratio = (recut.segments as f64 / recut.others as f64).cbrt();
    SAFETY.max((ratio - 1.0).abs().recip())
}

/// By how much a measure is off by other numbers of segments.
#[derive(Debug, Clone, Copy, Default)]
struct Off {
    /// The difference to the first of them.
    difference: f64,
    /// The largest difference.
    largest: f64,
    /// The error that all of them tell of.
    error: f64,
    /// The difference that an earlier end of the impact makes.
    earlier: f64,
}

impl Off {
    fn widen(&mut self, one: Option<f64>, other: Option<f64>, safety: f64) {
        let difference = match (one, other) {
            (Some(one), Some(other)) => (one - other).abs(),
            (None, None) => 0.0,
            _ => f64::INFINITY,
        };
        if self.error == 0.0 {
            self.difference = difference;
        }
        self.largest = self.largest.max(difference);
        self.error = self.error.max(safety * difference);
    }
}

/// A front that is as steep as the segments of the layers that it runs through.
struct Steep {
    /// The element, and the node that strikes it.
    names: [String; 2],
    /// The part by which the ripples behind the front exceed it, where that is known.
    excess: Option<f64>,
    /// Time in which a wave crosses a segment \[s\].
    passage: f64,
    /// How many segments there are.
    segments: usize,
}

impl Steep {
    fn of(report: &RunReport) -> Vec<Self> {
        let steep = report.warnings.iter().filter_map(|warning| {
            let Warning::Network(warning) = warning else { return None };
            let (front, excess) = match warning {
                NetworkWarning::SteepFront { front, excess } => (front, Some(*excess)),
                NetworkWarning::DampedFront(front) | NetworkWarning::NonlinearFront(front) => {
                    (front, None)
                }
                _ => return None,
            };
            let element = report.assembly.connection(&front.element)?;
            let (passage, segments) = (element.passage, element.segments.len());
            let names = [front.element.clone(), front.node.clone()];
            Some(Self { names, excess, passage, segments })
        });
        steep.collect()
    }

    /// Height of the ripples in the force on what strikes the layers, in parts of its largest, at the time `after` \[s\]:
    /// that of all steps that have come back from the other end until then. The largest force is no less than a step with
    /// what its front exceeds it by.
    fn ripples(&self, after: f64) -> f64 {
        let there_and_back = 2.0 * self.passage * self.segments as f64;
        let height = |echo: f64| {
            let (travelled, part) = (echo * there_and_back, echo * there_and_back / after);
            let spread = (self.passage / (PI * travelled)).sqrt();
            (spread * (part.powi(-2) - 1.0).powf(-0.75) * part).min(HIGHEST)
        };
        let echoes = (1_u32..).map(f64::from).take_while(|echo| echo * there_and_back < after);
        let all: f64 = echoes.take(MOST_ECHOES).map(height).sum();
        (all / (1.0 + self.excess.unwrap_or(0.0))).min(HIGHEST)
    }

    /// What the error of a measure is at least.
    fn least(&self, measure: &MeasureReport) -> f64 {
        /// Measures that the height of ripples goes into.
        const HEIGHTS: [&str; 5] = [
            PeakForce::KIND,
            PeakStress::KIND,
            PeakStrain::KIND,
            TransmittedForce::KIND,
            PeakAcceleration::KIND,
        ];
        let Some(value) = measure.value.filter(|_| self.names.contains(&measure.target)) else {
            return 0.0;
        };
        match self.excess {
            _ if measure.kind == ContactTime::KIND => front(self.passage, value),
            Some(excess) if HEIGHTS.contains(&measure.kind) => excess * value,
            _ => 0.0,
        }
    }
}
