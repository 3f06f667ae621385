#![expect(clippy::float_cmp, reason = "what is promised to the last bit is compared so")]

use std::{ops::ControlFlow, sync::Arc};

use super::{IntervalEnd, ModeInterval, Switch, Switching, integrate};
use crate::{
    Budget, Direction, Event, Guard, Method, Observer, Outcome, Progress, Run, Shared, Silent,
    SolveError,
    methods::{all, by_name},
    tests::problems,
};

/// A body between two walls, at the dimensionless places 0 and 1, from which it is thrown back with
/// `restitution` times its speed. It starts at 1/4 with the speed −1/2.
#[derive(Debug)]
struct Walls {
    restitution: f64,
}

const NAMES: [&str; 2] = ["floor", "ceiling"];
const SPEED: f64 = 0.5;

impl Walls {
    fn interval(state: [f64; 2], switches: Vec<Switch>) -> ModeInterval {
        let mut system = problems::free_motion().system;
        system.initial = state.to_vec();
        let scale = system.outputs.at(0).scale;
        let guard = |(wall, direction): (usize, Direction)| Guard {
            name: NAMES[wall].to_owned(),
            output: 0,
            level: if wall == 0 { 0.0 } else { scale },
            direction,
            stops: true,
            begins: Some(wall == 0),
            rate_of: None,
        };
        let guards = [(0, Direction::Falling), (1, Direction::Rising)].map(guard).to_vec();
        ModeInterval {
            system: Arc::new(system),
            phases: vec![(0, 0.0)],
            guards,
            switches,
            predicted: None,
            until: None,
            tried: 1,
            hangs_on_threshold: false,
        }
    }
}

impl Switching for Walls {
    fn first(&self, _threshold: f64) -> Result<ModeInterval, SolveError> {
        Ok(Self::interval([0.25, -SPEED], Vec::new()))
    }

    fn next(&self, end: &IntervalEnd<'_>) -> Result<ModeInterval, SolveError> {
        let wall = end.fired[0];
        let place = if wall == 0 { 0.0 } else { 1.0 };
        let switch = Switch {
            time: end.time,
            part: wall,
            name: NAMES[wall].to_owned(),
            phase: 0,
            what: "impact",
            memory: 0.0,
            impulse: 1.0,
            lost: 0.0,
            worked: 0.0,
        };
        Ok(Self::interval([place, -self.restitution * end.state[1]], vec![switch]))
    }
}

/// A wall through which the body goes on: it fires again at once.
#[derive(Debug)]
struct Sticky;

impl Switching for Sticky {
    fn first(&self, threshold: f64) -> Result<ModeInterval, SolveError> {
        Walls { restitution: 1.0 }.first(threshold)
    }

    fn next(&self, end: &IntervalEnd<'_>) -> Result<ModeInterval, SolveError> {
        Walls { restitution: -1.0 }.next(end)
    }
}

fn methods() -> Vec<Box<dyn Method>> {
    all().into_iter().filter(|method| method.name() != "auto").collect()
}

fn scale() -> f64 {
    problems::free_motion().system.time_scale
}

/// When the walls are hit, dimensionless.
fn hits(restitution: f64) -> impl Iterator<Item = f64> {
    let mut time = 0.25 / SPEED;
    let mut speed = SPEED;
    std::iter::from_fn(move || {
        let now = time;
        speed *= restitution;
        time += speed.recip();
        Some(now)
    })
}

fn crossing(output: usize, level: f64, stops: bool) -> Guard {
    let (name, direction) = ("user".to_owned(), Direction::Either);
    Guard { name, output, level, direction, stops, begins: None, rate_of: None }
}

#[test]
fn a_body_between_walls_hits_them_at_the_times_of_the_closed_form() {
    let restitution = 0.8;
    for method in methods() {
        let run = Run::to(30.0 * scale()).with_rtol(1e-9);
        let walls = Walls { restitution };
        let found = integrate(&*method, &walls, &run, &mut Silent).unwrap();
        let expected: Vec<f64> = hits(restitution).take_while(|&time| time < 30.0).collect();
        assert_eq!(found.switches.len(), expected.len(), "{}", method.name());
        // A straight line costs every method but roundings.
        for (switch, time) in found.switches.iter().zip(expected) {
            let error = switch.time / scale() / time - 1.0;
            assert!(error.abs() < 1e-12, "{}: {error:e}", method.name());
        }
        let parts: Vec<usize> = found.switches.iter().map(|switch| switch.part).take(4).collect();
        assert_eq!(parts, [0, 1, 0, 1]);
        assert_eq!(found.outcome, Outcome::Finished);
        assert_eq!(found.t_end, run.t_end);
        let system = problems::free_motion().system;
        let velocity = found.signal(&system, 1);
        let first = found.switches[0].time;
        let unit = system.outputs.at(1).scale;
        assert!((velocity.left_value(first) + SPEED * unit).abs() < 1e-13);
        assert!((velocity.value(first) - restitution * SPEED * unit).abs() < 1e-13);
        assert_eq!(velocity.end(), run.t_end);
    }
}

#[test]
fn exact_states_an_error_that_covers_the_closed_form_through_all_legs() {
    let restitution = 0.9;
    let run = Run::to(20.0 * scale());
    let walls = Walls { restitution };
    let exact = by_name("exact").unwrap();
    let found = integrate(&*exact, &walls, &run, &mut Silent).unwrap();
    let system = problems::free_motion().system;
    let position = found.signal(&system, 0);
    let error = position.error.expect("a bound");
    // 64 roundings of each interval's state, which shift the intervals after it.
    assert!(error < 1e-11, "{error:e}");
    let (mut before, mut place, mut speed) = (0.0, 0.25, -SPEED);
    for hit in hits(restitution).take_while(|&time| time < 20.0) {
        let middle = 0.5 * (before + hit);
        let expected = (place + speed * (middle - before)) * system.outputs.at(0).scale;
        let value = position.value(middle * scale());
        assert!((value - expected).abs() <= error + 1e-15, "{value} {expected} {error:e}");
        (before, place) = (hit, if speed < 0.0 { 0.0 } else { 1.0 });
        speed *= -restitution;
    }
}

#[test]
fn guards_of_the_user_are_watched_across_legs() {
    let unit = problems::free_motion().system.outputs.at(0).scale;
    for method in methods() {
        let walls = Walls { restitution: 1.0 };
        // The middle is passed once between two hits, which are 2 apart.
        let guards = vec![crossing(0, 0.5 * unit, false)];
        let run = Run { guards, ..Run::to(9.0 * scale()) };
        let found = integrate(&*method, &walls, &run, &mut Silent).unwrap();
        let times: Vec<f64> = found.events.iter().map(|event| event.time / scale()).collect();
        assert_eq!(times.len(), 4, "{}: {times:?}", method.name());
        for (time, expected) in times.iter().zip([1.5, 3.5, 5.5, 7.5]) {
            assert!((time - expected).abs() < 1e-9, "{}: {time}", method.name());
        }
        let rising: Vec<bool> = found.events.iter().map(|event| event.rising).collect();
        assert_eq!(rising, [true, false, true, false]);
    }
}

#[test]
fn a_stop_in_a_later_leg_ends_the_run_there() {
    let unit = problems::free_motion().system.outputs.at(0).scale;
    for method in methods() {
        let walls = Walls { restitution: 0.5 };
        let guards =
            vec![Guard { direction: Direction::Falling, ..crossing(0, 0.75 * unit, true) }];
        let run = Run { guards, ..Run::to(90.0 * scale()) };
        let found = integrate(&*method, &walls, &run, &mut Silent).unwrap();
        // Hits at 1/2 and 9/2, and then a quarter of the way down at the speed 1/8.
        assert_eq!(found.outcome, Outcome::Stopped { guard: 0 }, "{}", method.name());
        assert!((found.t_end / scale() - 6.5).abs() < 1e-9, "{}", method.name());
        assert_eq!(found.switches.len(), 2);
        let [Event { time, guard: 0, rising: false }] = found.events[..] else {
            panic!("{:?}", found.events)
        };
        assert_eq!(time, found.t_end);
    }
}

#[test]
fn endless_switching_is_an_error_that_names_what_switches() {
    for method in methods() {
        let run = Run::to(9.0 * scale());
        let error = integrate(&*method, &Sticky, &run, &mut Silent).unwrap_err();
        let SolveError::Switching { time, reason } = &error else { panic!("{error}") };
        assert!(reason.contains("`floor` switches without end"), "{reason}");
        assert!((time / scale() - 0.5).abs() < 1e-9, "{time}");
    }
}

/// What it is told, until it ends the run after so many times.
struct Watching(Vec<Progress>, usize);

impl Observer for Watching {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        self.0.push(progress);
        self.1 -= 1;
        if self.1 == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn progress_goes_on_at_the_end_while_errors_are_estimated_and_may_end_the_run_there() {
    let (walls, exact) = (Walls { restitution: 1.0 }, by_name("exact").unwrap());
    let run = Run::to(9.0 * scale());
    let mut watching = Watching(Vec::new(), usize::MAX);
    let found = integrate(&*exact, &walls, &run, &mut watching).unwrap();
    let afterwards = watching.0.iter().filter(|own| own.time >= found.t_end).count();
    assert!(afterwards > found.switches.len(), "{afterwards}");
    let mut watching = Watching(Vec::new(), watching.0.len());
    let error = integrate(&*exact, &walls, &run, &mut watching).unwrap_err();
    assert!(matches!(error, SolveError::Cancelled { .. }), "{error}");
}

#[test]
fn progress_never_goes_back_and_steps_are_counted_over_all_legs() {
    let walls = Walls { restitution: 1.0 };
    let run = Run::to(9.0 * scale());
    for method in methods() {
        let mut watching = Watching(Vec::new(), usize::MAX);
        integrate(&*method, &walls, &run, &mut watching).unwrap();
        let told = watching.0;
        assert!(!told.is_empty());
        for pair in told.windows(2) {
            assert!(pair[0].steps <= pair[1].steps, "{}: {pair:?}", method.name());
        }
        // An interval may be told beyond its end, up to the step that finds it.
        let intervals = told.iter().map(|own| own.time).fold(0.0, f64::max);
        assert!(intervals <= run.t_end * (1.0 + 1e-12), "{}: {intervals}", method.name());
    }
    let mut watching = Watching(Vec::new(), 2);
    let bdf = by_name("bdf").unwrap();
    let error = integrate(&*bdf, &walls, &run, &mut watching).unwrap_err();
    assert!(matches!(error, SolveError::Cancelled { .. }), "{error}");
}

#[test]
fn a_run_of_no_length_has_one_leg_and_its_start() {
    let walls = Walls { restitution: 1.0 };
    for method in methods() {
        let found = integrate(&*method, &walls, &Run::to(0.0), &mut Silent).unwrap();
        assert_eq!((found.t_end, found.outcome), (0.0, Outcome::Finished));
        assert!(found.switches.is_empty() && found.events.is_empty());
        let system = problems::free_motion().system;
        assert_eq!(found.signal(&system, 0).value(0.0), 0.25 * system.outputs.at(0).scale);
    }
}

#[test]
fn the_same_run_twice_is_the_same_to_the_last_bit() {
    let system = problems::free_motion().system;
    for method in methods() {
        let run = Run::to(30.0 * scale());
        let walls = Walls { restitution: 0.83 };
        let [one, two] = [0, 1].map(|_| integrate(&*method, &walls, &run, &mut Silent).unwrap());
        assert_eq!(one.switches, two.switches);
        assert_eq!(one.signal(&system, 0), two.signal(&system, 0));
    }
}

#[test]
fn more_legs_than_are_followed_are_an_error_of_its_own() {
    let exact = by_name("exact").unwrap();
    // A hit in every 2 units of time.
    let run = Run::to(1e6 * scale());
    let walls = Walls { restitution: 1.0 };
    let error = integrate(&*exact, &walls, &run, &mut Silent).unwrap_err();
    let SolveError::TooManySwitches { intervals, parts, .. } = &error else { panic!("{error}") };
    assert_eq!(*intervals, 200_000);
    assert_eq!(parts, "`ceiling`, `floor`");
}

#[test]
fn an_interval_of_known_equations_is_the_same_and_mostly_without_another_decomposition() {
    let exact = by_name("exact").unwrap();
    let mut count = 0;
    for problem in problems::all() {
        let system = &problem.system;
        let interval = |shared: &mut Shared| {
            let run = Run { budget: Budget::of(u64::MAX), ..Run::to(problem.t_end) };
            let found = exact.integrate_interval(system, &run, shared, &mut Silent).ok()?;
            let work = run.budget.done();
            Some((found.signal(system, 0), work))
        };
        let mut shared = Shared::default();
        let Some((first, least)) = interval(&mut shared) else { continue };
        let (other, work) = interval(&mut shared).unwrap();
        assert_eq!(first, other, "{}", problem.name);
        // Where the bounds of the first are none too good, other modes are looked for.
        assert!(work <= least, "{}: {work} {least}", problem.name);
        count += usize::from(work < least);
    }
    assert!(count > 5, "{count}");
}
