//! The independent way: the network of the model, compiled and solved.

use dashpot_dae::{Method, Run, Signal, Silent, System, Waveform, methods};

use super::{
    RheometerError,
    history::{Instant, Side},
    rig::Rig,
    shaking::{CAUTION, SEEDS, shake},
};

/// Tolerances of a method that states no bound; its error follows from their differences.
const TOLERANCES: [f64; 3] = [1e-7, 1e-8, 1e-9];
/// Number of coupled unknowns up to which the exact method takes any number of decades.
const FEW: usize = 8;
/// Fastest rate times duration up to which it takes more.
const WIDE: f64 = 1e9;
/// By how much the time is shortened each time that a simulation is declined.
const SHORTENING: f64 = 10.0;

/// What a simulation found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Simulation {
    /// Name of the method.
    pub(super) method: &'static str,
    /// One for each output of the rig.
    pub(super) tracks: Vec<Track>,
    /// The time \[s\] up to which it could be solved; `None` if not at all.
    pub(super) reach: Option<f64>,
    /// Why it could not be solved to the end.
    pub(super) obstacle: Option<String>,
}

/// An output at the instants.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    /// The values; `None` beyond the reach of the simulation.
    pub(super) values: Vec<Option<f64>>,
    /// The largest error of the values, as far as it is known.
    pub(super) error: Option<f64>,
}

impl Simulation {
    /// Solves the network of `rig` by the method of this name and reads it at `instants`, which
    /// rise. What cannot be solved to its end is solved as far as tenths of the time go.
    ///
    /// # Errors
    ///
    /// [`RheometerError::UnknownMethod`].
    pub(super) fn new(
        rig: &Rig<'_>,
        method: &str,
        instants: &[Instant],
    ) -> Result<Self, RheometerError> {
        let Some(method) = methods::by_name(method) else {
            let known = methods::all().iter().map(|method| method.name()).collect();
            return Err(RheometerError::UnknownMethod { name: method.to_owned(), known });
        };
        let name = method.name();
        let first = instants.iter().map(|instant| instant.time).find(|&time| time > 0.0);
        let first = first.unwrap_or(f64::INFINITY);
        let mut reach = rig.history().end();
        let mut obstacle = None;
        while reach >= first {
            match solve(rig, method.as_ref(), reach, instants) {
                Ok(tracks) => {
                    return Ok(Self { method: name, tracks, reach: Some(reach), obstacle });
                }
                Err(reason) => {
                    obstacle.get_or_insert(reason);
                    reach /= SHORTENING;
                }
            }
        }
        let nothing = Track { values: vec![None; instants.len()], error: None };
        let tracks = vec![nothing; rig.outputs.len()];
        Ok(Self { method: name, tracks, reach: None, obstacle })
    }
}

/// The outputs over a run to `reach` with their errors, or why there are none.
fn solve(
    rig: &Rig<'_>,
    method: &dyn Method,
    reach: f64,
    instants: &[Instant],
) -> Result<Vec<Track>, String> {
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
/// the equations after shaking.
fn tracks(
    rig: &Rig<'_>,
    method: &dyn Method,
    (reach, rtol): (f64, f64),
    seed: Option<u64>,
    instants: &[Instant],
) -> Result<Vec<Track>, String> {
    let network = seed.map_or_else(|| rig.network(), |seed| rig.shaken(seed).network());
    let network = network.ok_or("two changes of the test cannot be told apart")?;
    let mut assembly = network.compile(reach).map_err(|errors| errors.to_string())?;
    let numbers: Option<Vec<usize>> = rig.outputs.iter().map(|own| assembly.output(own)).collect();
    let numbers = numbers.ok_or("the force in a rigid link is undetermined")?;
    if let Some(seed) = seed {
        shake(&mut assembly.system, seed);
    }
    if method.is_exact() {
        check_width(&assembly.system, reach)?;
    }
    let run = Run::to(reach).with_rtol(rtol);
    let trajectory = method.integrate(&assembly.system, &run, &mut Silent);
    let trajectory = trajectory.map_err(|error| error.to_string())?;
    let signals = numbers.iter().map(|&at| trajectory.signal(&assembly.system, at));
    Ok(signals.map(|signal| read(&signal, reach, instants)).collect())
}

/// Declines systems of many unknowns over so many decades that the exact solution has no useful
/// bound, or takes long: those that are coupled, and those that are driven by lines, because what is
/// slow then belongs together with the drive.
fn check_width(system: &System, reach: f64) -> Result<(), String> {
    let entries = || system.jacobian.triplet_iter();
    let is_coupled = entries().any(|(row, column, _)| row != column);
    let fastest = entries().map(|(_, _, value)| value.abs()).fold(0.0, f64::max);
    let end = reach / system.time_scale;
    let width = fastest * end;
    let is_sloped = |own: &Waveform, time: f64| own.piece_at(time).derivative(1, time) != 0.0;
    let is_line = |own: &Waveform| [0.0, 0.5 * end].iter().any(|&time| is_sloped(own, time));
    let is_together = is_coupled || system.waveforms.iter().any(is_line);
    if is_together && system.len() > FEW && width > WIDE {
        let (count, decades) = (system.len(), width.log10());
        return Err(format!(
            "{count} unknowns over {decades:.0} decades of time leave the exact solution without \
             a useful bound"
        ));
    }
    Ok(())
}

fn read(signal: &Signal, reach: f64, instants: &[Instant]) -> Track {
    let value = |instant: &Instant| {
        (instant.time <= reach).then(|| match instant.side {
            Side::After => signal.value(instant.time),
            Side::Before if instant.time > 0.0 => signal.left_value(instant.time),
            Side::Before => 0.0,
        })
    };
    Track { values: instants.iter().map(value).collect(), error: signal.error }
}

/// The finest of three solutions, with the errors that their differences tell.
fn estimated(coarse: &[Track], middle: &[Track], fine: Vec<Track>) -> Vec<Track> {
    let tracks = fine.into_iter().zip(middle).zip(coarse);
    let estimated = tracks.map(|((fine, middle), coarse)| {
        let late = difference(&fine.values, &middle.values);
        let early = difference(&middle.values, &coarse.values);
        let error = late.zip(early).map(|(late, early)| (2.0 * late).max(0.5 * early));
        Track { error, ..fine }
    });
    estimated.collect()
}

/// The largest difference.
fn difference(one: &[Option<f64>], other: &[Option<f64>]) -> Option<f64> {
    let pairs = one.iter().zip(other).filter_map(|(one, other)| one.zip(*other));
    pairs.map(|(one, other)| (one - other).abs()).reduce(f64::max)
}
