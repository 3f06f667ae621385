//! Errors where it is open whether an impact ends, or whether something switches before the run does.

use dashpot_dae::{Run, Silent};

use crate::{
    Reading,
    errors::{
        accuracy::excess,
        solved::{ALWAYS, Solved, Task},
    },
    solution::{threshold_at, undecided_ends},
};

/// An impact that may end where its force comes within its error of zero and pushes on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OpenEnd {
    /// When \[s\]; the first of several.
    pub(crate) time: f64,
    /// The measures, by number, to which it makes more of a difference than their errors and a tenth of what
    /// is asked of them.
    pub(crate) measures: Vec<usize>,
    /// The measures that have a value at one of both ends only. Where a force only comes to nothing they are
    /// all that hangs on the end.
    pub(crate) undecided: Vec<usize>,
}

/// What is worth a word, in parts of the accuracy asked for.
const NOTABLE: f64 = 0.1;

impl OpenEnd {
    /// Widens the errors of the last of some solutions so that they cover both ends of such an impact;
    /// `None` where no measure comes by it to miss what is asked of it, or to have a value at all.
    pub(crate) fn cover(
        task: &Task<'_>,
        solved: &[Solved],
        errors: &mut [Option<f64>],
    ) -> Option<Self> {
        let (finest, others) = solved.split_last().filter(|own| !own.1.is_empty())?;
        let ends = undecided_ends(
            &finest.as_read(task.assembly),
            &|| others.iter().map(|other| other.as_read(task.assembly)).collect(),
            threshold_at(Some(finest.rtol)),
        );
        let time = ends.iter().map(|end| end.1).reduce(f64::min)?;
        let earlier = task.read(&mut finest.as_read(task.assembly).ending(ends));
        let (mut measures, mut undecided, mut most) = (Vec::new(), Vec::new(), 0.0_f64);
        for (at, ((error, own), other)) in
            errors.iter_mut().zip(&finest.readings).zip(&earlier).enumerate()
        {
            let Some((value, error)) = own.value.zip(error.as_mut()) else {
                undecided.extend(other.value.and(Some(at)));
                continue;
            };
            let gap = other.value.map_or(f64::INFINITY, |other| (other - value).abs());
            let excess = excess(own, Some(gap), task.settings.accuracy.of(&task.selected[at].key));
            if gap > *error && excess > NOTABLE {
                measures.push(at);
                most = most.max(excess);
            }
            *error += gap;
        }
        let matters = most > 1.0 || !undecided.is_empty();
        matters.then_some(Self { time, measures, undecided })
    }

    /// What one solution alone leaves open: where its force pulls by less than its error may be, and pushes again.
    /// `None` where that makes no difference to a measure beyond what is asked of it.
    pub(crate) fn of_one(task: &Task<'_>, solved: &mut Solved) -> Option<Self> {
        if solved.threshold <= 0.0 {
            return None;
        }
        let known = solved.known.take();
        let mut solution = solved.as_read(task.assembly);
        if let Some(known) = known {
            solution = solution.knowing(known);
        }
        let ends = undecided_ends(&solution, &Vec::new, solved.threshold);
        solved.known = Some(solution.known());
        let time = ends.iter().map(|end| end.1).reduce(f64::min)?;
        let earlier = task.read(&mut solved.as_read(task.assembly).ending(ends));
        let differs = |(at, (own, other)): (usize, (&Reading, &Reading))| {
            let wish = task.settings.accuracy.of(&task.selected[at].key);
            let is_other = match (own.value, other.value) {
                (Some(value), Some(other)) => excess(own, Some((other - value).abs()), wish) > 1.0,
                (None, None) => false,
                _ => true,
            };
            is_other.then_some(at)
        };
        let both = solved.readings.iter().zip(&earlier).enumerate();
        let measures: Vec<usize> = both.filter_map(differs).collect();
        (!measures.is_empty()).then_some(Self { time, measures, undecided: Vec::new() })
    }
}

/// Errors of instants at which something switches, in parts of the tolerance and of the time.
const OF_INSTANTS: f64 = 1e2;
/// How much farther back than to the last switching a run ends before it.
const AMPLE: f64 = 2.0;

/// Errors at events below which those of a solution are tried that hangs on them, in parts of what it took them for.
const SHARPER: f64 = 1e-2;

/// Widens the errors of a solution of a `run` so that they cover what comes of what it took for rest at events, where that
/// moves by less than its error may be: a solution at each tolerance may take it for rest. The run is solved once more with
/// errors at events that are smaller; where that fails nothing is told.
pub(crate) fn cover_threshold(
    task: &Task<'_>,
    run: &Run,
    finest: &Solved,
    errors: &mut [Option<f64>],
) {
    if !finest.trajectory.dense.hangs_on_threshold() {
        return;
    }
    let sharper = finest.sharper.get_or_init(|| {
        let errors_at_events = SHARPER * run.errors_at_events;
        let budget = run.budget.part(ALWAYS.max(run.budget.done()));
        let run = Run { errors_at_events, budget, ..run.clone() }.with_rtol(finest.rtol);
        task.solve(&run, false, &mut Silent).map_or_else(|_| Vec::new(), |own| own.readings)
    });
    widen(errors, &finest.readings, sharper);
}

/// Widens errors by what two readings differ.
fn widen(errors: &mut [Option<f64>], own: &[Reading], other: &[Reading]) {
    for (error, (own, other)) in errors.iter_mut().zip(own.iter().zip(other)) {
        match (own.value, other.value) {
            (Some(value), Some(other)) => {
                *error = error.map(|error| error + (other - value).abs());
            }
            (None, None) => {}
            _ => *error = Some(f64::INFINITY),
        }
    }
}

/// Widens the errors of a solution of a `run` so that they cover what comes of a switching that may lie on
/// either side of the run's end, by the error of the method. The run is solved once more to an end that lies on
/// the other side of it; where that fails, the errors are not known.
pub(crate) fn cover_switching(
    task: &Task<'_>,
    run: &Run,
    finest: &Solved,
    errors: &mut [Option<f64>],
) {
    let t_end = finest.trajectory.t_end;
    if task.assembly.switching.is_none() || t_end < run.t_end {
        return;
    }
    let longer = finest.trajectory.dense.end_margin();
    let last = finest.trajectory.switches.last().map(|switch| t_end - switch.time);
    let shorter = last.filter(|since| *since <= OF_INSTANTS * finest.rtol * t_end);
    let shorter = shorter.map(|since| -AMPLE * since.max(4.0 * f64::EPSILON * t_end));
    for change in longer.into_iter().chain(shorter) {
        let other = Run { t_end: t_end + change, ..run.clone() }.with_rtol(finest.rtol);
        let Ok(other) = task.solve(&other, false, &mut Silent) else {
            errors.fill(None);
            return;
        };
        if other.trajectory.switches.len() == finest.trajectory.switches.len() {
            continue;
        }
        widen(errors, &finest.readings, &other.readings);
    }
}
