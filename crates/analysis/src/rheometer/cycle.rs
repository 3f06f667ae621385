//! One cycle of loading and unloading: what its loop of force over deformation tells, read off a solution and,
//! of a linear model, in closed form.

use dashpot_dae::Signal;
use dashpot_numerics::{quadrature::integral_to, roots::monotone_root};
use dashpot_rheology::MaxwellForm;

use super::{
    Figure, Note, Obstacle,
    history::{self, History, Instant},
    perturbation::{CAUTION, SEEDS},
    rig::{NAME, Rig},
    solved::solve,
    track::{Track, estimated, read},
};
use crate::{Choice, Signals, Solution, energy::ledger::ledger};

/// How many numbers a loop has.
const COUNT: usize = 9;
/// Their names and SI units; see [`Loop`].
const NAMES: [(&str, &str); COUNT] = [
    ("peak force", "N"),
    ("deformation at the peak force", "m"),
    ("energy absorbed", "J"),
    ("energy returned", "J"),
    ("energy lost", "J"),
    ("hysteresis ratio", "1"),
    ("dissipated until then, by the ledger", "J"),
    ("still stored then, by the ledger", "J"),
    ("residual deformation", "m"),
];
/// Tolerances of a method that states no bound; its error follows from their differences.
const TOLERANCES: [f64; 3] = [1e-8, 1e-9, 1e-10];
/// Places in these.
const PEAK: usize = 0;
const RESIDUAL: usize = 8;
/// Rounding of the sums of a loop, and of differences, in parts of their largest term.
pub(super) const ROUNDING: f64 = 1e-14;

/// A deformation out and back.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cycle {
    /// How far \[m\], not zero.
    pub(super) height: f64,
    /// How fast \[m/s\], positive.
    pub(super) rate: f64,
    /// How fast back \[m/s\], positive.
    pub(super) back: f64,
}

impl Cycle {
    pub(super) fn history(self) -> History {
        History::there_and_back(self.height, self.rate, self.back)
    }

    /// When it turns \[s\].
    fn turn(self) -> f64 {
        self.height.abs() / self.rate
    }

    fn end(self) -> f64 {
        self.turn() + self.height.abs() / self.back
    }

    /// The deformation at a time on the way back \[m\].
    fn deformation_back(self, time: f64) -> f64 {
        let way = self.height.signum();
        (self.height - way * self.back * (time - self.turn())) * f64::from(time < self.end())
    }

    /// About `points` instants, as many on the way out as on the way back, at equal distances; the corners
    /// from both sides.
    pub(super) fn instants(self, points: usize) -> Vec<Instant> {
        let each = (points / 2).max(2);
        let mut all = Vec::with_capacity(2 * each + 4);
        for (start, end) in [(0.0, self.turn()), (self.turn(), self.end())] {
            all.extend([Instant::before(start), Instant::after(start)]);
            let part = |at: usize| start + (end - start) * (at as f64 / each as f64);
            all.extend((1..each).map(|at| Instant::after(part(at))));
        }
        all.push(Instant::before(self.end()));
        all
    }
}

/// What a loop tells: a value for each name, and how far it may be off.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Loop {
    values: [Option<f64>; COUNT],
    errors: [Option<f64>; COUNT],
    /// The force at the end of the way back \[N\], in the direction of the motion out.
    left: f64,
}

/// The time at which the force comes to zero after the turn, and what is got until then.
struct Return {
    /// When it does \[s\]; `None` where it does not.
    zero: Option<f64>,
    absorbed: f64,
    returned: f64,
}

impl Loop {
    fn of(peak: (f64, f64), work: &Return, ledger: [Option<f64>; 2], cycle: Cycle) -> Self {
        let lost = work.absorbed - work.returned;
        let ratio = (work.absorbed > 0.0).then(|| lost / work.absorbed);
        let residual = work.zero.map(|time| cycle.deformation_back(time));
        let [dissipated, stored] = ledger;
        let (force, place) = peak;
        let numbers = [Some(force), Some(place), Some(work.absorbed), Some(work.returned)];
        let [a, b, c, d] = numbers;
        let values = [a, b, c, d, Some(lost), ratio, dissipated, stored, residual];
        Self { values, errors: [None; COUNT], left: 0.0 }
    }

    /// The loop of a linear model, in closed form but for quadrature.
    pub(super) fn in_closed_form(form: &MaxwellForm, cycle: Cycle) -> Self {
        let history = cycle.history();
        let way = cycle.height.signum();
        let force = |at: Instant| way * history::force(form, &history, at);
        let (turn, end) = (cycle.turn(), cycle.end());
        let peak = force(Instant::before(turn));
        let tolerance = 1e-14 * peak.abs() * turn;
        let integral = |from: f64, to: f64, tolerance: f64| {
            integral_to(|time| force(Instant::after(time)), from, to, tolerance)
        };
        // The force of a linear model falls all the way back.
        let zero = if force(Instant::after(turn)) <= 0.0 {
            Some(turn)
        } else {
            let over = |time: f64| {
                let is_end = time >= end;
                force(if is_end { Instant::before(end) } else { Instant::after(time) })
            };
            let floor = ROUNDING * peak.abs();
            if over(end) > floor { None } else { monotone_root(over, turn, end).or(Some(end)) }
        };
        let until = zero.unwrap_or(end);
        let work = Return {
            zero,
            absorbed: cycle.rate * integral(0.0, turn, tolerance),
            returned: cycle.back * integral(turn, until, 1e-14 * peak.abs() * (end - turn)),
        };
        Self::of((way * peak, cycle.height), &work, [None, None], cycle)
    }

    /// The loop of a solution of the rig, with the bounds that its method states.
    fn read(solution: &Solution<'_>, cycle: Cycle) -> Option<Self> {
        let connection = solution.assembly().connection(NAME)?;
        let way = cycle.height.signum();
        let force = solution.glance(connection.force?).scaled(way);
        let (turn, end) = (cycle.turn(), cycle.end());
        let peak = force.maximum((0.0, end));
        let place = if peak.time <= turn {
            way * cycle.rate * peak.time
        } else {
            cycle.deformation_back(peak.time)
        };
        let zero = zero_after(&force, turn, end);
        let until = zero.unwrap_or(end);
        let work = Return {
            zero,
            absorbed: cycle.rate * force.integral((0.0, turn)),
            returned: cycle.back * force.integral((turn, until)),
        };
        let energy = ledger(solution, until);
        let stored = energy.total_stored() - energy.start;
        let mut own = Self::of(
            (way * peak.value, place),
            &work,
            [Some(energy.total_dissipated()), Some(stored)],
            cycle,
        );
        own.left = force.left_value(end);
        let Some(error) = force.error else { return Some(own) };
        let on_work = error * cycle.height.abs();
        let slope = force.slope(until).abs();
        let on_place = if until <= turn { 0.0 } else { cycle.back * error / slope };
        own.errors = [
            Some(error),
            (peak.time.to_bits() == turn.to_bits()).then_some(0.0),
            Some(on_work),
            Some(on_work),
            Some(2.0 * on_work),
            Some(2.0 * on_work / work.absorbed),
            energy.error,
            energy.error,
            Some(on_place),
        ];
        Some(own)
    }

    /// Its errors widened by what moves in other solutions of as much worth.
    fn moved(mut self, others: &[Self]) -> Self {
        for (at, error) in self.errors.iter_mut().enumerate() {
            let moves = others.iter().map(|own| apart(own.values[at], self.values[at]));
            let most = moves.reduce(|one, other| Some(one?.max(other?))).flatten();
            *error = error.zip(most).map(|(bound, moved)| bound + CAUTION * moved);
        }
        self
    }

    /// The finest of three loops, with the errors that their differences tell.
    fn estimated(mut loops: [Self; 3]) -> Self {
        let [early, late] = [[0, 1], [1, 2]].map(|[a, b]| (loops[a].left - loops[b].left).abs());
        // A force that its error hides at the end has come to zero there.
        if loops[2].left <= (2.0 * late).max(0.5 * early) {
            loops
                .iter_mut()
                .for_each(|own| own.values[RESIDUAL] = own.values[RESIDUAL].or(Some(0.0)));
        }
        let [coarse, middle, fine] = loops;
        let mut own = fine;
        for (at, error) in own.errors.iter_mut().enumerate() {
            let late = apart(fine.values[at], middle.values[at]);
            let early = apart(middle.values[at], coarse.values[at]);
            *error = late.zip(early).map(|(late, early)| (2.0 * late).max(0.5 * early));
        }
        own
    }

    /// Rounding is added to what is known of the errors.
    fn rounded(mut self) -> Self {
        let most = |unit: &str| {
            let same = NAMES.iter().zip(self.values).filter(|(name, _)| name.1 == unit);
            same.filter_map(|(_, value)| value).map(f64::abs).fold(0.0, f64::max)
        };
        let floors = NAMES.map(|name| ROUNDING * most(name.1));
        for (error, floor) in self.errors.iter_mut().zip(floors) {
            *error = error.map(|error| error + floor);
        }
        self
    }

    /// The figures of a test, from a loop in closed form and one of the network, where there are such.
    pub(super) fn figures(closed: Option<&Self>, computed: Option<&Self>) -> Vec<Figure> {
        let value = |own: Option<&Self>, at: usize| own.and_then(|own| own.values[at]);
        let one = |(at, (name, unit)): (usize, &(&'static str, &'static str))| {
            let error = computed.and_then(|own| own.errors[at]);
            let figure = Figure::of(name, unit, value(closed, at).unwrap_or(f64::NAN));
            let figure = figure.computed(value(computed, at)).within(error);
            let is_missing = figure.model.is_none() && figure.computed.is_none();
            if at == RESIDUAL && is_missing { figure.noting(Note::ForceLeft) } else { figure }
        };
        NAMES.iter().enumerate().map(one).collect()
    }

    /// Whether the force is zero at once as the motion turns.
    pub(super) fn gives_nothing_back(&self, cycle: Cycle) -> bool {
        self.values[PEAK].is_some_and(|peak| peak != 0.0)
            && self.values[RESIDUAL].is_some_and(|own| own.to_bits() == cycle.height.to_bits())
    }
}

fn apart(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.zip(other).map(|(one, other)| (one - other).abs())
}

/// When a force that is positive before the turn comes to zero after it: where it passes zero, or begins to
/// rest there; `None` where it does not.
fn zero_after(force: &Signal, turn: f64, end: f64) -> Option<f64> {
    if force.value(turn) <= 0.0 {
        return Some(turn);
    }
    let passage = force.first_crossing(0.0, (turn, end), Some(false)).map(|found| found.time);
    let rest = force.panels.iter().filter(|panel| panel.start > turn && panel.length() > 0.0);
    let size = |coefficients: &[f64]| coefficients.iter().map(|own| own.abs()).sum::<f64>();
    let rest = rest.into_iter().find(|panel| size(&panel.coefficients) <= force.noise);
    let rest = rest.map(|panel| panel.start).filter(|&time| time < end);
    let first = [passage, rest].into_iter().flatten().reduce(f64::min);
    let floor = force.noise.max(force.error.unwrap_or(0.0));
    first.or_else(|| (force.left_value(end) <= floor).then_some(end))
}

/// A cycle as a method finds it.
pub(super) struct Simulated {
    /// Name of the method that was used.
    pub(super) method: &'static str,
    /// The force over time.
    pub(super) track: Track,
    /// What the loop tells; `None` where there is none.
    pub(super) found: Option<Loop>,
    /// Why there is none.
    pub(super) obstacle: Option<Obstacle>,
}

impl Simulated {
    /// The cycle by a method, and the force at these instants.
    pub(super) fn new(rig: &Rig<'_>, choice: &Choice, cycle: Cycle, instants: &[Instant]) -> Self {
        match simulate(rig, choice, cycle, instants) {
            Ok(own) => own,
            Err(obstacle) => Self {
                method: choice.method().name(),
                track: Track { values: vec![None; instants.len()], error: None },
                found: None,
                obstacle: Some(obstacle),
            },
        }
    }
}

fn simulate(
    rig: &Rig<'_>,
    choice: &Choice,
    cycle: Cycle,
    instants: &[Instant],
) -> Result<Simulated, Obstacle> {
    let end = cycle.end();
    let both = |solved: &Signals| {
        let solution = solved.solution();
        let own = Loop::read(&solution, cycle);
        let force = solution.assembly().connection(NAME).and_then(|own| own.force);
        let track = force.map(|force| read(&solution.glance(force), end, instants));
        own.zip(track).ok_or(Obstacle::Undetermined)
    };
    let [coarse, middle, fine] = TOLERANCES;
    let first = solve(rig, choice, (end, coarse), Vec::new(), true)?;
    let (own, track) = both(&first)?;
    let (found, track) = if first.rtol.is_none() {
        let again = |seed| solve(&rig.perturbed(seed), choice, (end, coarse), Vec::new(), true);
        let others = SEEDS.map(again).into_iter().map(|own| Ok(both(&own?)?.0));
        let others = others.collect::<Result<Vec<Loop>, Obstacle>>()?;
        (own.moved(&others), track)
    } else {
        let solved = |rtol| both(&solve(rig, choice, (end, rtol), Vec::new(), true)?);
        let (second, third) = (solved(middle)?, solved(fine)?);
        let loops = Loop::estimated([own, second.0, third.0]);
        let mut tracks = estimated(&[track], &[second.1], vec![third.1]);
        (loops, tracks.remove(0))
    };
    let found = Some(found.rounded());
    Ok(Simulated { method: first.trajectory.method, track, found, obstacle: None })
}
