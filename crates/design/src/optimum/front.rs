//! The best designs of two aims: the least of one for every bound on the other.

use super::{
    Aim, Design, DesignError, Effort, Front, FrontPoint, Problem, Requirement,
    search::{ROOM, SAME, Search},
};

/// By which part of itself the least of an aim is exceeded where the other one is made least at it.
const AT_LEAST: f64 = 1e-6;

/// The front of a problem's aim and another one, by so many points from the least of one to the least of the other:
/// each has the least of the first aim that a bound on the second allows. One point where a design has the least of both,
/// or where nothing keeps everything.
///
/// # Errors
///
/// [`DesignError`].
///
/// # Examples
///
/// 4 kg at 2 m/s on a spring: the peak force and the depth have the product `m v²`.
///
/// ```
/// use dashpot_analysis::{Bound, Limit, SolveSettings, sweep::ScenePoint};
/// use dashpot_design::optimum::{Aim, Effort, Problem, Variable, front};
/// use dashpot_network::{Network, Node, spring};
///
/// let pose = |values: &[f64]| {
///     let mut network = Network::new();
///     let head = network.add_node(Node::mass("head", 4.0).moving(2.0));
///     network.connect("pad", head, network.ground(), spring(values[0]));
///     Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
/// };
/// let variables = [Variable { low: 1e4, high: 1e6, start: 1e5 }];
/// let [force, depth] = ["pad.peak-force", "pad.peak-deformation"].map(|own| Aim::Measure(own.to_owned()));
/// let tests = [&pose as _];
/// let problem = Problem { variables: &variables, totals: &[], aim: &depth, tests: &tests };
/// let front = front(&problem, &force, Effort::default(), 5)?;
/// assert_eq!(front.points.len(), 5);
/// assert!(front.points.iter().all(|own| (own.design.aim * own.other / 16.0 - 1.0).abs() < 1e-5));
/// # Ok::<(), dashpot_design::optimum::DesignError>(())
/// ```
pub fn front(
    problem: &Problem<'_>,
    other: &Aim,
    effort: Effort,
    points: usize,
) -> Result<Front, DesignError> {
    let mut search = Search::of(problem, Some(other), effort)?;
    let known = search.known(&problem.begin())?;
    let slack = search.no_slack();
    let (best, searched) = search.best(&known, &slack);
    let first = search.settled(best, searched, &known, slack.clone())?;
    if !first.is_feasible {
        return Ok(Front { points: vec![FrontPoint::of(first)] });
    }
    // The least of the other aim, and what it is at the least of this one.
    let turned = problem.with_aim(other);
    let mut turned = Search::of(&turned, Some(problem.aim), effort)?;
    let known_of_other = turned.known(&first.values)?;
    let least = turned.best(&known_of_other, &turned.no_slack()).0.values[0];
    turned.set_ceiling(first.aim);
    let begun = [turned.space.unknowns(&first.values)];
    let at_first = turned.best_from(&known_of_other, &turned.no_slack(), &begun).0;
    let from = if at_first.values[1] <= ROOM { at_first.values[0] } else { ceiling(&first) };
    // Where one design has the least of both, there is no more of it.
    let count = if from - least <= SAME * from.abs() { 1 } else { points.max(2) };
    let mut found: Vec<((), FrontPoint)> = Vec::new();
    let mut begun = vec![turned.space.values(&at_first.unknowns)];
    for level in levels(from, least, count) {
        search.set_ceiling(level);
        let starts: Vec<Vec<f64>> = begun.iter().map(|own| search.space.unknowns(own)).collect();
        let (best, searched) = search.best_from(&known, &slack, &starts);
        let own = search.settled(best, searched, &known, slack.clone())?;
        begun = vec![own.values.clone()];
        if own.is_feasible {
            found.push(((), FrontPoint::of(own)));
        }
    }
    Ok(Front { points: undominated(found).into_iter().map(|own| own.1).collect() })
}

/// Bounds on an aim from one value down to another: at equal ratios where both are above zero.
fn levels(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |at| {
        let share = at as f64 / (count - 1).max(1) as f64;
        if to > 0.0 { from * (to / from).powf(share) } else { from + (to - from) * share }
    })
}

/// Those than which no other has less of both aims, each with what belongs to it; of alike ones the first.
pub fn undominated<T>(all: Vec<(T, FrontPoint)>) -> Vec<(T, FrontPoint)> {
    let pairs: Vec<[f64; 2]> = all.iter().map(|own| [own.1.design.aim, own.1.other]).collect();
    let room = |own: f64| SAME * own.abs();
    let is_worse = |own: &[f64; 2]| {
        pairs.iter().any(|other| {
            other[0] < own[0] - room(own[0]) && other[1] <= own[1] + room(own[1])
                || other[1] < own[1] - room(own[1]) && other[0] <= own[0] + room(own[0])
        })
    };
    let mut kept: Vec<(T, FrontPoint)> = Vec::new();
    for (own, pair) in all.into_iter().zip(&pairs) {
        let is_told = |told: &(T, FrontPoint)| (told.1.other - pair[1]).abs() <= room(pair[1]);
        if !is_worse(pair) && !kept.iter().any(is_told) {
            kept.push(own);
        }
    }
    kept
}

/// What a design has of the other aim, in the worst test.
fn ceiling(design: &Design) -> f64 {
    let of_other = design.kept.iter().filter_map(|own| match own.required.what {
        Requirement::Ceiling(..) => Some(own.value),
        _ => None,
    });
    of_other.fold(f64::NEG_INFINITY, f64::max)
}

impl FrontPoint {
    fn of(design: Design) -> Self {
        Self { other: ceiling(&design), design }
    }
}

impl Search<'_> {
    /// Bounds the other aim, but for what cannot be told from it.
    fn set_ceiling(&mut self, most: f64) {
        self.evaluator.set_ceiling(most + AT_LEAST * most.abs());
    }
}
