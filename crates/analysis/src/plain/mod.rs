//! Single runs of plain impacts: one mass strikes a pad whose laws are not all linear, and is let go.
//!
//! They are solved as the points of [sweeps](crate::sweep) are: the form of the network is
//! instantiated, followed in explicit steps of constant size until the force falls through zero, and measures, with
//! their bars, the balance of energy and what is to be said are read off these steps. What becomes of the pad
//! behind that is followed likewise; what has left it flies. Curves over time are made when somebody looks at them.
//!
//! Everything else, and what turns out not to be plain, is left to [`solve_assembly`](crate::solve_assembly).

pub(crate) mod aftermath;
pub(crate) mod bars;
mod energies;
mod later;
pub(crate) mod powers;
mod scene;
pub(crate) mod shown;
pub(crate) mod stepped;
mod told;

use std::{sync::Arc, time::Instant};

use dashpot_dae::{Budget, Extremum, Observer, Progress, SolveError, Statistics};
use dashpot_network::{Assembly, Instance, Network};
use dashpot_numerics::small::dot;

use self::{
    aftermath::Forms,
    bars::{Found, LOOSEST, TOLERANCES, added, tolerance, with_bars},
    energies::{Balance, Leg},
    scene::Scene,
    stepped::{Course, Stepped},
    told::{Ledgers, Told},
};
use crate::{RunError, RunReport, SolveSettings, report::curves::Struck, run::SINGLE};

/// The largest number of unknowns that are instantiated.
pub(crate) const MOST_STATES: usize = 12;
/// The coarser tolerance in parts of one that is given.
const COARSER: f64 = 100.0;

/// The run of a plain impact; `None` where it is not one, or not certain enough. Errors: a run that the observer ends.
pub(crate) fn solve(
    network: &Network,
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Option<Result<RunReport, RunError>> {
    let started = Instant::now();
    let scene = Scene::of(network, assembly, settings)?;
    let mut told = match scene.released.states() {
        0..=4 => solved::<4>(&scene),
        5..=6 => solved::<6>(&scene),
        7..=8 => solved::<8>(&scene),
        _ => solved::<MOST_STATES>(&scene),
    }?;
    let budget = Budget::of(settings.budget);
    let steps = told.statistics.accepted + told.others.accepted;
    let all = steps + told.statistics.rejected + told.others.rejected;
    budget.charge((all * (16 + scene.parametric.unknowns())) as u64);
    if budget.is_spent() {
        return None;
    }
    told.work = budget.done();
    if observer.progress(Progress { time: settings.duration, steps }).is_break() {
        let time = settings.duration;
        return Some(Err(SolveError::Cancelled { time }.into()));
    }
    told.wall = started.elapsed();
    Some(Ok(told.report(&scene)))
}

fn solved<const N: usize>(scene: &Scene<'_>) -> Option<Told> {
    let Scene { assembly, settings, parametric, numbers, scales, .. } = scene;
    let mut instance: Instance<N> = parametric.instance()?;
    if !parametric.fill(numbers, &mut instance) {
        return None;
    }
    let begin = Instant::now();
    let (time, end) = (scales.time, (settings.duration - scene.fall) / scales.time);
    let stepped = Stepped { instance: &instance, unknowns: parametric.unknowns(), end };
    let (found, rtol) = followed(scene, &stepped)?;
    let Found { values, errors, course, others, work, .. } = found;
    let masses = parametric.masses_and_speeds(numbers, &instance);
    let parts = parametric.parts(&instance);
    let whole = end - course.release;
    let forms = Forms { before: (parametric, &instance), behind: &scene.released, numbers };
    let after = aftermath::follow(forms, &course, (whole, rtol))?;
    let struck = parametric.energy_at_start(numbers, &instance);
    let mut balance =
        Balance::at_touch(assembly, struck, if scene.fall > 0.0 { struck } else { 0.0 });
    let released = (course.release, after.from);
    let leg = Leg { track: &course.track, parts: &parts, masses: &masses, end: released };
    balance.add(assembly, &leg, time);
    let face = parametric.speed_of_face(&instance);
    let way = course.track.signal(&|z| dot(&face, z)).integral((0.0, course.release)) * time;
    let flight = after.flight;
    balance.add_work(scales.mass * flight.pull * way);
    let release = scene.fall + course.release * time;
    let after_impact = balance.ledger(assembly, release);
    balance.let_go(scales.mass, flight, settings.duration - release);
    if let Some(last) = after.track.steps.last() {
        let leg = Leg {
            track: &after.track,
            parts: &after.parts,
            masses: &after.masses,
            end: (last.end(), last.values[last.values.len() - 1]),
        };
        balance.add(assembly, &leg, time);
    }
    let at_end = balance.ledger(assembly, settings.duration);
    let mut statistics = course.track.work;
    added(&mut statistics, &after.track.work);
    statistics.wall = begin.elapsed().saturating_sub(work.wall);
    let at = |own: Extremum| Extremum { time: scene.fall + own.time * time, ..own };
    let (strongest, deepest) = (course.strongest, course.deepest);
    let struck = Struck {
        element: parametric.element(),
        strongest: at(strongest),
        deepest: at(deepest),
        leaves: flight.speed,
    };
    let told = Told {
        values,
        errors,
        rtol,
        struck,
        release,
        windows: scene.windows(&course),
        size_of_work: 0.5 * strongest.value * deepest.value,
        energy: Ledgers { after_impact, at_end },
        statistics,
        others: work,
        solves: others,
        work: 0,
        wall: begin.elapsed(),
    };
    told.closes(scene).then_some(told)
}

/// The solution, its errors where they are asked for, and its tolerance.
fn followed<const N: usize>(
    scene: &Scene<'_>,
    stepped: &Stepped<'_, N>,
) -> Option<(Found<N>, f64)> {
    let settings = scene.settings;
    let read = |course: &Course<N>| scene.read(course);
    if !settings.estimate {
        let rtol = settings.rtol.unwrap_or(SINGLE);
        let course = stepped.follow(rtol)?;
        let values: Vec<f64> = read(&course).into_iter().map(|[value, _]| value).collect();
        let is_finite = values.iter().all(|value| value.is_finite());
        let errors = vec![f64::NAN; values.len()];
        let work = Statistics::default();
        let own = Found { values, errors, course, ratio: 0.0, others: 0, work };
        return is_finite.then_some((own, rtol));
    }
    let tolerances: Vec<f64> = if let Some(rtol) = settings.rtol {
        if COARSER * rtol > tolerance(0, LOOSEST) {
            return None;
        }
        vec![COARSER * rtol, rtol]
    } else {
        let strictest = settings.accuracy.strictest();
        (0..TOLERANCES.len()).map(|level| tolerance(level, strictest)).collect()
    };
    let suffice = |values: &[f64], errors: &[f64]| scene.suffice(values, errors);
    let found = with_bars(stepped, &tolerances, &read, &suffice)?;
    let rtol = tolerances[found.others];
    Some((found, rtol))
}
