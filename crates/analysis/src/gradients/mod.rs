//! Derivatives of measures, and of the times of events, with respect to numbers of a scene.
//!
//! A derivative is a difference of solutions next to each other, of which each follows its own events: release,
//! contact, stop and stick move with the number, and so do peaks and the windows of indices. By the exact method,
//! whose solutions are known to some 13 digits, one solution to each side gives 8 digits; two to each side, by a
//! stepping method at a tighter tolerance, give a few digits more than the run was asked for. Where a derivative
//! does not exist, at a peak of two equal maxima or where events meet, differences do not settle, and it is refused.

mod beside;
mod neighbours;
mod report;
mod serialized;
mod stencil;

pub use self::report::{
    Derivative, GradientReport, MeasureGradient, NoDerivative, Number, unit_of,
};
use self::{
    beside::Beside,
    neighbours::{Neighbour, neighbours},
};
use crate::{
    Choice, RunError, RunReport, Solve, SolveSettings,
    sweep::{ScenePoint, SweepError, columns},
};

/// Poses the scene where each number has this value, or says why there is none.
pub type PoseNumbers<'p> = dyn Fn(&[f64]) -> Result<ScenePoint, String> + Sync + 'p;

/// The steps of the exact method in parts of a number: their square, and errors of some 1e-14 over them, are alike.
const EXACT_STEPS: [f64; 2] = [3e-5, 5e-6];
/// The largest and the least first step of other methods.
const WIDEST: f64 = 1e-2;
const NARROWEST: f64 = 1e-3;
/// Tolerances of solutions next to each other, in parts of that of the run: the first at which one of them takes no more
/// than so many times the work of the run with all its solutions.
const TIGHTER: [f64; 3] = [1e-3, 1e-2, 1e-1];
const MOST_WORK: u64 = 4;
/// So much work is always allowed, some 0.1 s.
const LEAST_WORK: u64 = 3_000_000;
/// The tightest tolerance there is.
const TIGHTEST: f64 = 1e-13;
/// Errors of stepping methods in parts of their tolerance.
const ERRORS_PER_TOLERANCE: f64 = 1e2;
/// Below this relative error no better one is looked for.
const GOOD: f64 = 1e-7;

/// How the neighbours of a run are solved.
struct Plan {
    settings: SolveSettings,
    is_exact: bool,
    steps: [f64; 2],
}

impl Plan {
    /// As the run was, but once and at a tolerance that is so many times tighter.
    fn of(settings: &SolveSettings, run: &RunReport, tighter: f64) -> Self {
        let rtol = run.solver.rtol.map(|rtol| (tighter * rtol).max(TIGHTEST));
        // What is chosen for a run may be given up beside it: other methods are chosen there anew.
        let method = if rtol.is_none() { Choice::named(run.solver.method).ok() } else { None };
        let method = method.unwrap_or_else(|| settings.method.clone());
        let most = MOST_WORK.saturating_mul(run.solver.work).max(LEAST_WORK);
        let budget = settings.budget.min(most);
        let settings = SolveSettings { method, rtol, estimate: false, budget, ..settings.clone() };
        let steps = rtol.map_or(EXACT_STEPS, |rtol| {
            let step = (ERRORS_PER_TOLERANCE * rtol).cbrt().clamp(NARROWEST, WIDEST);
            [step, 0.25 * step]
        });
        Self { settings, is_exact: rtol.is_none(), steps }
    }

    /// A scene posed beside the run's, with what is asked of it.
    fn ask(&self, posed: ScenePoint) -> ScenePoint {
        // A length that was found depends on the numbers, and the run's end is no part of the scene.
        let found = posed.settings.is_duration_found;
        let duration = if found { self.settings.duration } else { posed.settings.duration };
        let settings = SolveSettings { duration, ..self.settings.clone() };
        ScenePoint { settings, ..posed }
    }
}

/// The derivatives of these measures, of none all that the scene reports, and of the times of events, with respect to
/// these numbers.
///
/// It takes the run itself and two solutions for each number by the exact method; four, and one more for all,
/// by others and where the first two do not pass the same events and peaks, or are too near a graze.
///
/// # Examples
///
/// ```
/// use dashpot_analysis::{SolveSettings, gradients::{Number, gradients}, sweep::ScenePoint};
/// use dashpot_network::{Network, Node, elements::Spring, part};
///
/// let numbers = [Number::new("K", "N/m", 4e4), Number::new("m", "kg", 4.0)];
/// let keys = ["pad.peak-force".to_owned()];
/// let report = gradients(&numbers, &keys, 1, &|values| {
///     let &[stiffness, mass] = values else { return Err("two numbers".to_owned()) };
///     let mut network = Network::new();
///     let head = network.add_node(Node::mass("head", mass).moving(2.0));
///     network.connect("pad", head, network.ground(), part(Spring { stiffness }));
///     Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
/// })?;
/// // V √(K m): half a percent per percent.
/// let own = report.derivative("pad.peak-force", "K").unwrap().clone()?;
/// assert!((own.elasticity.unwrap() - 0.5).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// A fault of the scene, a measure that it does not have, and a run that fails. What has no derivative is
/// [in the report](NoDerivative).
pub fn gradients(
    numbers: &[Number],
    keys: &[String],
    threads: usize,
    pose: &PoseNumbers<'_>,
) -> Result<GradientReport, SweepError> {
    let values: Vec<f64> = numbers.iter().map(|own| own.value).collect();
    let mut point = pose(&values).map_err(SweepError::NotPosed)?;
    let (columns, wishes) = columns(&point, keys)?;
    point.settings.measures = wishes;
    point.settings.accuracy.neglect_below = None;
    let columns = columns.into_iter().filter(|own| !own.is_share);
    let keys: Vec<String> = columns.map(|own| own.key).collect();
    let run = point.network.solve_with(&point.settings)?;
    let own = Neighbour::of(&run, &keys);
    let planned = |tighter: f64| {
        let plan = Plan::of(&point.settings, &run, tighter);
        if plan.is_exact {
            return Ok((plan, own.clone()));
        }
        let again = plan.ask(point.clone());
        let here = again.network.solve_with(&again.settings)?;
        Ok::<_, RunError>((plan, Neighbour::of(&here, &keys)))
    };
    let [first, others @ ..] = TIGHTER;
    let (plan, here) = others
        .into_iter()
        .fold(planned(first), |found, tighter| found.or_else(|_| planned(tighter)))?;
    let first = 1 + run.solver.solves_for_error + usize::from(!plan.is_exact);
    let is_sharp = plan.is_exact && run.segmentation.is_none();
    let search = Search { numbers, keys: &keys, plan, pose, threads, run: own, here, is_sharp };
    let (found, others) = search.found();
    Ok(GradientReport::made(&run, (&keys, numbers), &found, first + others))
}

/// What is known of each value of a run: its derivative with respect to one number.
type Found = Vec<Result<Derivative, NoDerivative>>;

/// A run, and where its neighbours are looked for.
struct Search<'a> {
    numbers: &'a [Number],
    keys: &'a [String],
    plan: Plan,
    pose: &'a PoseNumbers<'a>,
    threads: usize,
    run: Neighbour,
    /// The run once more as its neighbours are solved.
    here: Neighbour,
    /// Whether one solution to each side is enough where they are of the run's kind.
    is_sharp: bool,
}

impl Search<'_> {
    /// The derivatives with respect to each number, and how many solutions they took.
    fn found(&self) -> (Vec<Found>, usize) {
        let nothing = vec![Err(NoDerivative::NumberIsZero); self.here.count()];
        let mut found = vec![nothing; self.numbers.len()];
        let mut open: Vec<usize> =
            (0..self.numbers.len()).filter(|at| self.numbers[*at].value != 0.0).collect();
        let mut solutions = 0;
        for step in self.plan.steps {
            let (all, count) = self.at(&open, step);
            solutions += count;
            for (number, own) in open.iter().zip(all) {
                for (known, own) in found[*number].iter_mut().zip(own) {
                    if is_better(known, &own) {
                        *known = own;
                    }
                }
            }
            open.retain(|number| found[*number].iter().any(|own| self.is_open(own)));
        }
        (found, solutions)
    }

    /// Whether a smaller step may give a better derivative.
    fn is_open(&self, own: &Result<Derivative, NoDerivative>) -> bool {
        match own {
            Ok(own) => self.plan.is_exact && own.relative_error > GOOD,
            Err(own) => !matches!(own, NoDerivative::NoValue { .. }),
        }
    }

    /// The derivatives with respect to these numbers by steps of this part of them, and how many solutions they took.
    fn at(&self, numbers: &[usize], step: f64) -> (Vec<Found>, usize) {
        let outer = self.solved(numbers, step);
        let is_close = |(number, sides): (usize, &[Neighbour; 2])| {
            let beside = self.beside((number, step), sides, None);
            let is_near_a_graze = |at: usize| beside.is_near_a_graze(at);
            self.is_sharp
                && sides.iter().all(|own| own.is_like(&self.here))
                && !(0..self.here.count()).any(is_near_a_graze)
        };
        let pairs = || numbers.iter().copied().zip(&outer);
        let close: Vec<bool> = pairs().map(is_close).collect();
        let of_inner: Vec<usize> =
            numbers.iter().zip(&close).filter(|own| !*own.1).map(|own| *own.0).collect();
        let mut inner = self.solved(&of_inner, 0.5 * step).into_iter();
        let accuracy = |at: usize| {
            let all = &self.plan.settings.accuracy;
            self.keys.get(at).map_or(all.default, |key| all.of(key))
        };
        let all = pairs().zip(close).map(|((number, sides), is_close)| {
            let near = if is_close { None } else { inner.next() };
            let beside = self.beside((number, step), sides, near.as_ref());
            (0..self.here.count()).map(|at| beside.derivative(at, accuracy(at))).collect()
        });
        let all = all.collect();
        (all, 2 * (numbers.len() + of_inner.len()))
    }

    /// The run, and what is solved a step, and half a step, beside a number.
    fn beside<'a>(
        &'a self,
        (number, step): (usize, f64),
        sides: &'a [Neighbour; 2],
        near: Option<&'a [Neighbour; 2]>,
    ) -> Beside<'a> {
        let Self { run, here, .. } = self;
        let number = self.numbers[number].value;
        let steps_error = self.plan.settings.rtol.map(|rtol| ERRORS_PER_TOLERANCE * rtol);
        Beside { run, here, sides, near, number, step, steps_error }
    }

    /// The solutions a step below and above each of these numbers.
    fn solved(&self, numbers: &[usize], step: f64) -> Vec<[Neighbour; 2]> {
        let sides = numbers.iter().flat_map(|&at| [(at, 1.0 - step), (at, 1.0 + step)]);
        let solve = |&(at, factor): &(usize, f64)| {
            let mut values: Vec<f64> = self.numbers.iter().map(|own| own.value).collect();
            values[at] *= factor;
            let point = match (self.pose)(&values) {
                Ok(posed) => self.plan.ask(posed),
                Err(reason) => return Neighbour::none(reason),
            };
            match point.network.solve_with(&point.settings) {
                Ok(run) => Neighbour::of(&run, self.keys),
                Err(error) => Neighbour::none(error.to_string()),
            }
        };
        neighbours(&sides.collect::<Vec<_>>(), self.threads, &solve)
    }
}

/// Whether what was found later is to replace what is known.
fn is_better(
    known: &Result<Derivative, NoDerivative>,
    own: &Result<Derivative, NoDerivative>,
) -> bool {
    match (known, own) {
        (Ok(known), Ok(own)) => own.error < known.error,
        (known, own) => known.is_err() || own.is_ok(),
    }
}

#[cfg(test)]
mod tests;
