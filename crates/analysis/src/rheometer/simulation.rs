//! The independent way: the network around a model, compiled and solved.

use dashpot_dae::{Method, Run, Silent, System, Waveform};

use super::{
    Obstacle,
    history::Instant,
    perturbation::{CAUTION, SEEDS, perturb},
    rig::Rig,
    solved,
    track::{TOLERANCES, Track, difference, estimated, read},
};
use crate::Choice;

/// Number of coupled unknowns up to which the exact method takes any number of decades.
const FEW: usize = 8;
/// Fastest rate times duration up to which it takes more.
const WIDE: f64 = 1e9;
/// By how much the time is shortened each time that a simulation is declined.
const SHORTENING: f64 = 10.0;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Simulation {
    /// Name of the method.
    pub(super) method: &'static str,
    /// One for each output of the rig.
    pub(super) tracks: Vec<Track>,
    /// The time \[s\] up to which it could be solved; `None` if not at all.
    pub(super) reach: Option<f64>,
    /// Why it could not be solved to the end.
    pub(super) obstacle: Option<Obstacle>,
}

impl Simulation {
    /// Solves the network of `rig` by a method and reads it at `instants`, which
    /// rise. What cannot be solved to its end is solved as far as tenths of the time go.
    pub(super) fn new(rig: &Rig<'_>, choice: &Choice, instants: &[Instant]) -> Self {
        let method = choice.method();
        let name = method.name();
        let first = instants.iter().map(|instant| instant.time).find(|&time| time > 0.0);
        let first = first.unwrap_or(f64::INFINITY);
        let mut reach = rig.history().end();
        let mut obstacle = None;
        while reach >= first {
            let found = if rig.is_nonlinear() {
                solved::tracks(rig, choice, reach, instants)
            } else {
                solve(rig, method.as_ref(), reach, instants).map(|tracks| (name, tracks))
            };
            match found {
                Ok((method, tracks)) => {
                    return Self { method, tracks, reach: Some(reach), obstacle };
                }
                Err(reason) => {
                    obstacle.get_or_insert(reason);
                    reach /= SHORTENING;
                }
            }
        }
        let nothing = Track { values: vec![None; instants.len()], error: None };
        let tracks = vec![nothing; rig.outputs.len()];
        Self { method: name, tracks, reach: None, obstacle }
    }
}

/// The outputs over a run to `reach` with their errors, or why there are none.
fn solve(
    rig: &Rig<'_>,
    method: &dyn Method,
    reach: f64,
    instants: &[Instant],
) -> Result<Vec<Track>, Obstacle> {
    let solved = |rtol: f64, seed| tracks(rig, method, (reach, rtol), seed, instants);
    if !method.is_exact() {
        let [coarse, middle, fine] = TOLERANCES.map(|rtol| solved(rtol, None));
        return Ok(estimated(&coarse?, &middle?, fine?));
    }
    let mut own = solved(TOLERANCES[0], None)?;
    let bounds: Vec<Option<f64>> = own.iter().map(|track| track.error).collect();
    for seed in SEEDS {
        let again = solved(TOLERANCES[0], Some(seed))?;
        for ((track, again), bound) in own.iter_mut().zip(&again).zip(&bounds) {
            let error = bound.zip(difference(&track.values, &again.values));
            let error = error.map(|(bound, moved)| bound + CAUTION * moved);
            track.error = track.error.zip(error).map(|(one, other)| one.max(other));
        }
    }
    Ok(own)
}

/// The outputs over one run to `reach`, with the bounds that the method states; with a seed those of
/// the equations after that.
fn tracks(
    rig: &Rig<'_>,
    method: &dyn Method,
    (reach, rtol): (f64, f64),
    seed: Option<u64>,
    instants: &[Instant],
) -> Result<Vec<Track>, Obstacle> {
    let network = seed.map_or_else(|| rig.network(), |seed| rig.perturbed(seed).network());
    let network = network.ok_or(Obstacle::ChangesAtOnce)?;
    let mut assembly = network.compile(reach)?;
    let numbers: Option<Vec<usize>> =
        rig.outputs.iter().map(|output| assembly.output(output)).collect();
    let numbers = numbers.ok_or(Obstacle::Undetermined)?;
    if let Some(seed) = seed {
        perturb(&mut assembly.system, seed);
    }
    if method.is_exact() {
        check_width(&assembly.system, reach)?;
    }
    let run = Run::to(reach).with_rtol(rtol);
    let trajectory = method.integrate(&assembly.system, &run, &mut Silent)?;
    let signals = numbers.iter().map(|&at| trajectory.signal(&assembly.system, at));
    Ok(signals.map(|signal| read(&signal, reach, instants)).collect())
}

/// Declines systems of many unknowns over so many decades that the exact solution has no useful
/// bound, or takes long: those that are coupled, and those that are driven by lines, because what is
/// slow then belongs together with the drive.
fn check_width(system: &System, reach: f64) -> Result<(), Obstacle> {
    let entries = || system.jacobian.triplet_iter();
    let is_coupled = entries().any(|(row, column, _)| row != column);
    let fastest = entries().map(|(_, _, value)| value.abs()).fold(0.0, f64::max);
    let end = reach / system.time_scale;
    let width = fastest * end;
    let is_sloped = |own: &Waveform, time: f64| own.piece_at(time).derivative(1, time) != 0.0;
    let is_line =
        |waveform: &Waveform| [0.0, 0.5 * end].iter().any(|&time| is_sloped(waveform, time));
    let is_together = is_coupled || system.waveforms.iter().any(is_line);
    if is_together && system.len() > FEW && width > WIDE {
        return Err(Obstacle::TooWide { unknowns: system.len(), decades: width.log10() });
    }
    Ok(())
}
