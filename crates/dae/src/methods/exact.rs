//! The exact solution of linear systems.

use std::time::Instant;

use super::check;
use crate::{
    Event, Guard, Method, MethodKind, Observer, Outcome, Progress, Run, Shared, SolveError,
    Statistics, System, Trajectory, Waveform,
    events::{Stop, scan},
    exact::{Augmented, Solution},
};

/// Most states.
const STATES: usize = 200;
/// Most states with the generators of the driving functions.
const SIZE: usize = 300;
/// `‖A‖T` beyond which rounding of the entries may change all that is slow.
const STIFFNESS: f64 = 1e15;
/// `‖A‖T` beyond which no mode is looked for: they would be sought among numbers whose squares leave the range.
const BEYOND_MODES: f64 = 1e20;
/// The most by which rounding of the entries may change a mode until the end of its life or of the run.
const BLUR: f64 = 1e-9;
/// `‖A‖T` up to which the number of panels needs no counting.
const QUICK: f64 = 6e6;
/// Most radians that all oscillations together may pass through: some two million panels.
const RADIANS: f64 = 6e6;
/// Radians of a part of a run that has too many.
const REACH: f64 = 1e4;
/// Lifetimes after which a mode is forgotten.
const LIFETIMES: f64 = 45.0;

/// Largest part of a run that is searched for a stop first, and the radians that it may hold.
const FIRST_SHARE: f64 = 1.0 / 64.0;
const FIRST_RADIANS: f64 = 1e3;
/// How many times as long the next part is.
const NEXT_SHARE: f64 = 4.0;
/// Share of a part before which what stops the run is looked for again, in a part that reaches so many times
/// as far as it.
const NEAR: f64 = 0.75;
const BEYOND: f64 = 1.25;

/// The solution by the matrix exponential: no steps, and no error but rounding.
///
/// `ẏ = A y + B w(t)` is solved between breakpoints of the driving functions as `z(t) = e^{Ā t} z(0)`, where `z` holds
/// the unknowns and the generators of cubics and sines. Samples on a uniform grid come from one exponential of the
/// step; outputs come from the modal form, as piecewise polynomials whose interpolation error is bounded mode by mode,
/// so that no extremum and no crossing is missed for lying between samples. Nothing is computed before it is asked for.
///
/// # When exact stops being exact
///
/// - The values are those of the matrices as given. Their entries are rounded, and where an entry is a difference of
///   great numbers the slow motion of the *matrices* differs from that of the scene, whoever solves them; no bound
///   knows of that. Beyond `‖A‖T = 1e15` scenes are declined unless no mode is changed by it.
/// - The modal form is refined in twice the digits of a double, so the error of a signal is that of
///   its evaluation: about `16 ε` of the largest sum of its modes' sizes, which is more than that of
///   the signal itself where modes cancel. The stated bound says how much.
/// - Samples on a uniform grid come from the propagator where `‖A‖T ≤ 1e6` and nothing moves freely;
///   their error is about `ε ‖A‖ T`. All other samples come from the modal form.
/// - Rates that are equal, or so nearly equal that rounding decides, share one block of the modal
///   form. Chains of many such rates cost digits; the bound says how many.
/// - A bound of a signal covers the largest error over its spans, the rounding of times included. Where no modal form
///   is found that a bound can be given for, the values are those of the matrix exponential, and no bound is stated.
/// - A driving function whose frequency changes (a chirp) has no finite set of generators, so scenes
///   that are driven by one are declined.
/// - The work of a signal grows with the number of oscillations; beyond six million radians of all
///   undamped modes together the scene is declined.
///
/// Moler and Van Loan, Nineteen dubious ways to compute the exponential of a matrix, twenty-five
/// years later, SIAM Rev. 45 (2003) 3–49.
#[derive(Debug, Clone, Copy, Default)]
pub struct Exact;

impl Exact {
    fn decline<T>(reason: String) -> Result<T, SolveError> {
        Err(SolveError::NotApplicable { method: Self::KIND, reason })
    }

    /// How far it follows a run that has too many oscillations for it \[s\]; `None` where it follows the
    /// whole run, or nothing of it.
    pub fn reach(system: &System, run: &Run) -> Option<f64> {
        let augmented = Self::structured(system, run).ok()?;
        let end = run.t_end / system.time_scale;
        let norm = augmented.norm() * end;
        if norm <= QUICK || !norm.is_finite() {
            return None;
        }
        // Modes are found where they do not pass through more than there are digits for.
        let near = run.t_end * (QUICK / norm);
        let solution = Solution::new(augmented, (run.t_end, system.time_scale), run.budget.clone());
        let radians = solution.until(near).radians_beyond(end, LIFETIMES);
        if radians <= RADIANS || !radians.is_finite() {
            return None;
        }
        let reach = run.t_end * (REACH / radians);
        let part = Run { t_end: reach, ..run.clone() };
        (reach > 0.0 && Self::solve(system, &part).is_ok()).then_some(reach)
    }

    /// The most radians \[rad\] through which an oscillation passes within a run if it goes on for so many of its
    /// lifetimes; `None` where it does not follow the run.
    pub fn radians(system: &System, run: &Run, lifetimes: f64) -> Option<f64> {
        let solution = Self::solve(system, run).ok()?;
        Some(solution.most_radians(run.t_end / system.time_scale, lifetimes))
    }

    /// The system with its generators, if its structure permits.
    fn structured(system: &System, run: &Run) -> Result<Augmented, SolveError> {
        check(system, run)?;
        match system.terms.len() {
            0 => {}
            1 => return Self::decline("one of its parts is not linear".to_owned()),
            count => return Self::decline(format!("{count} of its parts are not linear")),
        }
        if system.linear().is_none() {
            let count = system.algebraic();
            return Self::decline(format!(
                "{count} of its unknowns follow from balances that were not eliminated"
            ));
        }
        let states = system.len();
        if states > STATES {
            return Self::decline(format!(
                "it has {states} states, and dense matrices are kept up to {STATES}"
            ));
        }
        let end = run.t_end / system.time_scale;
        if is_swept(system, end) {
            return Self::decline(
                "the frequency of a driving function changes (a chirp), and only constant \
                 frequencies have a matrix exponential"
                    .to_owned(),
            );
        }
        let augmented = Augmented::new(system, end);
        if augmented.size() > SIZE {
            return Self::decline(format!(
                "its driving functions have {} frequencies and powers of time of their own",
                augmented.size() - states
            ));
        }
        Ok(augmented)
    }

    /// Whether the oscillations of the modes until `end` are few enough.
    fn count(solution: &Solution, end: f64) -> Result<(), SolveError> {
        let radians = solution.radians(end, LIFETIMES);
        if radians > RADIANS {
            return Self::decline(format!(
                "its modes pass through {radians:.1e} radians, and {RADIANS:.0e} are followed"
            ));
        }
        Ok(())
    }

    fn solve(system: &System, run: &Run) -> Result<Solution, SolveError> {
        let augmented = Self::structured(system, run)?;
        let end = run.t_end / system.time_scale;
        let stiffness = augmented.norm() * end;
        let quick = stiffness <= QUICK;
        let solution = Solution::new(augmented, (run.t_end, system.time_scale), run.budget.clone());
        let is_far = !stiffness.is_finite() || stiffness > BEYOND_MODES;
        let is_blurred = || stiffness > STIFFNESS && solution.blur(end) > BLUR;
        if is_far || is_blurred() {
            return Self::decline(format!(
                "too stiff for the exact method in double precision: ‖A‖T = {stiffness:.1e}"
            ));
        }
        // A run that may stop is counted as far as it is searched.
        if !quick && !may_stop(run) {
            Self::count(&solution, end)?;
        }
        Ok(solution)
    }
}

/// Whether a guard may end the run early.
fn may_stop(run: &Run) -> bool {
    run.guards.iter().any(|guard| guard.stops)
}

/// The parts of a run of so many radians that are searched for a stop one after the other.
fn shares(radians: f64) -> Vec<f64> {
    let mut share = FIRST_SHARE.min(FIRST_RADIANS / radians.max(1.0));
    let mut shares = Vec::new();
    while share < 1.0 {
        shares.push(share);
        share *= NEXT_SHARE;
    }
    shares.push(1.0);
    shares
}

/// The events until a time \[s\], and the one that stops the run.
fn search(
    solution: &Solution,
    system: &System,
    run: &Run,
    until: f64,
) -> (Vec<Event>, Option<Stop>) {
    let part = solution.clone().until(until).apart();
    let signal = |guard: &Guard| crate::Dense::signal(&part, system, guard.output);
    let signals: Vec<_> = run.guards.iter().map(signal).collect();
    run.budget.charge_watched_panels(signals.iter().map(|own| own.panels.len()).sum());
    scan(&run.guards, &signals)
}

/// The same, and the time \[s\] up to which it was looked: an event far before the end of a part lies in the rounding of a
/// polynomial that reaches there, and is looked for again in a shorter one.
fn search_near(
    solution: &Solution,
    system: &System,
    run: &Run,
    until: f64,
) -> (Vec<Event>, Option<Stop>, f64) {
    let mut part = until;
    let (mut events, mut stop) = search(solution, system, run, part);
    while let Some(near) = stop.filter(|stop| 0.0 < stop.time && stop.time < NEAR * part) {
        let nearer = BEYOND * near.time;
        let again = search(solution, system, run, nearer);
        if again.1.is_none() {
            break;
        }
        (events, stop, part) = (again.0, again.1, nearer);
    }
    (events, stop, part)
}

/// Whether the frequency of a driving function in use is swept on a piece that begins before `end`.
fn is_swept(system: &System, end: f64) -> bool {
    let swept = |waveform: &Waveform| {
        waveform.pieces().iter().any(|piece| piece.is_swept() && piece.start < end)
    };
    system.inputs.iter().any(|input| swept(&system.waveforms[input.waveform]))
}

impl Method for Exact {
    fn name(&self) -> &'static str {
        Self::KIND
    }

    fn summary(&self) -> &'static str {
        "the matrix exponential: for linear systems up to 200 states, exact up to rounding"
    }

    fn applies(&self, system: &System, run: &Run) -> Result<String, SolveError> {
        Self::solve(system, run)?;
        Ok(format!("the scene is linear with {} states", system.len()))
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn integrate(
        &self,
        system: &System,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        Self::follow(system, run, None, observer)
    }

    fn integrate_interval(
        &self,
        system: &System,
        run: &Run,
        shared: &mut Shared,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        Self::follow(system, run, Some(shared), observer)
    }
}

impl Exact {
    fn follow(
        system: &System,
        run: &Run,
        mut shared: Option<&mut Shared>,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        let begin = Instant::now();
        let mut solution = Self::solve(system, run)?;
        if let Some(shared) = &shared {
            solution = solution.alike(shared);
        }
        if let Some(lost) = solution.lost() {
            let unknown = system.unknowns.get(lost).map_or(String::new(), |u| u.name.clone());
            return Err(SolveError::NotFinite { method: Self::KIND, time: run.t_end, unknown });
        }
        let (mut t_end, mut outcome, mut events) = (run.t_end, Outcome::Finished, Vec::new());
        if !run.guards.is_empty() {
            solution = solution.decomposed();
            let end = run.t_end / system.time_scale;
            // Where a run may stop, the first part of it is looked at first.
            let shares =
                if may_stop(run) { shares(solution.radians(end, LIFETIMES)) } else { vec![1.0] };
            let mut parts: Vec<f64> = shares.into_iter().map(|own| own * run.t_end).collect();
            // To the bit the part in which the same interval ended: an end that hangs on roundings is the same there.
            if let Some(before) = shared.as_deref_mut().and_then(Shared::part) {
                parts.retain(|part| *part > before);
                parts.insert(0, before);
            }
            let mut last = None;
            for until in parts {
                if may_stop(run) {
                    Self::count(&solution, until / system.time_scale)?;
                }
                let (found, stop, part) = search_near(&solution, system, run, until);
                if run.budget.is_spent() {
                    let (time, work) = (until, run.budget.done());
                    return Err(SolveError::BudgetSpent { method: Self::KIND, time, work });
                }
                events = found;
                if let Some(stop) = stop {
                    (t_end, outcome) = (stop.time, Outcome::Stopped { guard: stop.guard });
                    last = Some(part);
                    solution = solution.until(t_end);
                    break;
                }
                let progress = Progress { time: until, steps: 0 };
                if observer.progress(progress).is_break() {
                    return Err(SolveError::Cancelled { time: progress.time });
                }
            }
            if let Some(shared) = shared.as_deref_mut() {
                shared.found_in(last);
            }
        }
        if observer.progress(Progress { time: t_end, steps: 0 }).is_break() {
            return Err(SolveError::Cancelled { time: t_end });
        }
        let statistics = Statistics { wall: begin.elapsed(), ..Statistics::default() };
        if let Some(shared) = shared {
            solution.share(shared);
        }
        // What was made on the way to the end.
        solution.clear();
        Ok(Trajectory {
            method: Self::KIND,
            outcome,
            t_end,
            events,
            first_phases: Vec::new(),
            switches: Vec::new(),
            statistics,
            dense: Box::new(solution),
        })
    }
}

impl MethodKind for Exact {
    const KIND: &'static str = "exact";
}
