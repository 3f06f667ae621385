use std::ops::ControlFlow;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::*;
use crate::{
    Budget, Input, LinearForm, Outcome, Outputs, Piece, Progress, Unknown, UnknownKind, Waveform,
};

/// A system of unknowns `u0, u1, …` with this matrix and no input.
fn system(kinds: &[UnknownKind], entries: &[(usize, usize, f64)], initial: &[f64]) -> System {
    let mut jacobian = CooMatrix::new(kinds.len(), kinds.len());
    for &(row, column, value) in entries {
        jacobian.push(row, column, value);
    }
    let unknown = |(at, &kind)| Unknown { name: format!("u{at}"), kind, scale: 1.0, unit: "m" };
    System {
        unknowns: kinds.iter().enumerate().map(unknown).collect(),
        jacobian: CsrMatrix::from(&jacobian),
        input_matrix: CsrMatrix::zeros(kinds.len(), 0),
        inputs: Vec::new(),
        waveforms: Vec::new(),
        terms: Vec::new(),
        initial: initial.to_vec(),
        outputs: Outputs::new(),
        time_scale: 1.0,
    }
}

const ONE: &[UnknownKind] = &[UnknownKind::Differential];

#[test]
fn numbers_that_are_not_finite_are_errors_with_the_name_of_the_unknown() {
    let lost = |system: &System, method: &dyn Method| {
        let result = method.integrate(system, &Run::to(10.0), &mut Silent);
        match result {
            Err(SolveError::NotFinite { unknown, .. }) => assert_eq!(unknown, "u0"),
            other => panic!("{}: {other:?}", method.name()),
        }
    };
    for method in steppers().filter_map(by_name) {
        lost(&system(ONE, &[(0, 0, f64::NAN)], &[1.0]), &*method);
        lost(&system(ONE, &[(0, 0, -1.0)], &[f64::INFINITY]), &*method);
        // e^(1000·10) is beyond all numbers.
        lost(&system(ONE, &[(0, 0, 1000.0)], &[1.0]), &*method);
    }
}

#[test]
fn what_ends_within_no_time_at_all_is_followed_to_its_end() {
    // x' = v, v' = −C v: it stops at 1/C.
    for damping in [1e30, 1e60, 1e100] {
        let kinds = [UnknownKind::Differential; 2];
        let own = system(&kinds, &[(0, 1, 1.0), (1, 1, -damping)], &[0.0, 1.0]);
        for name in ["bdf", "tr-bdf2", "esdirk34"] {
            let run = Run::to(1.0);
            let solved = by_name(name).unwrap().integrate(&own, &run, &mut Silent).unwrap();
            let end = solved.dense.sample(&own, &[1.0]);
            let (place, speed) = (end[0] * damping, end[1].abs());
            // A rough bound: a thousand tolerances.
            assert!((place - 1.0).abs() < 1e-3 && speed < 1e-3, "{name} {damping:e}: {end:?}");
        }
    }
}

#[test]
fn settings_out_of_range_are_refused() {
    let decay = system(ONE, &[(0, 0, -1.0)], &[1.0]);
    for method in steppers().filter_map(by_name) {
        for run in [
            Run::to(1.0).with_rtol(1e-14),
            Run::to(1.0).with_rtol(0.5),
            Run::to(1.0).with_rtol(f64::NAN),
            Run::to(-1.0),
            Run::to(f64::NAN),
            Run::to(f64::INFINITY),
        ] {
            let result = method.integrate(&decay, &run, &mut Silent);
            assert!(matches!(result, Err(SolveError::InvalidSetting { .. })), "{}", method.name());
        }
    }
}

#[test]
fn tolerances_at_both_ends_of_the_range_are_met() {
    let decay = system(ONE, &[(0, 0, -1.0)], &[1.0]);
    for method in steppers().filter_map(by_name) {
        for (rtol, error) in [(1e-1, 0.3), (1e-12, 1e-8)] {
            let run = Run::to(1.0).with_rtol(rtol);
            let trajectory = method.integrate(&decay, &run, &mut Silent).unwrap();
            let value = trajectory.dense.sample(&decay, &[1.0])[0];
            assert!((value - (-1.0_f64).exp()).abs() < error, "{} {value}", method.name());
        }
    }
}

#[test]
fn a_run_of_no_length_is_its_initial_state() {
    let problem = problems::underdamped();
    for method in all() {
        let run = Run::to(0.0);
        let trajectory = method.integrate(&problem.system, &run, &mut Silent).unwrap();
        assert_eq!(trajectory.outcome, Outcome::Finished);
        assert_eq!(trajectory.t_end, 0.0);
        let state = trajectory.dense.sample(&problem.system, &[0.0]);
        assert_eq!(state, problem.system.initial, "{}", method.name());
        let signal = trajectory.signal(&problem.system, 0);
        assert_eq!((signal.start(), signal.end()), (0.0, 0.0), "{}", method.name());
        assert_eq!(signal.value(0.0), 0.5, "{}", method.name());
    }
}

#[test]
fn spans_of_any_length_are_solved_alike() {
    // The same decay seen over 10⁻⁹ and 10⁹ units of time.
    for method in steppers().filter_map(by_name) {
        for length in [1e-9, 1e9] {
            let decay = system(ONE, &[(0, 0, -1.0 / length)], &[1.0]);
            let trajectory = method.integrate(&decay, &Run::to(length), &mut Silent).unwrap();
            let value = trajectory.dense.sample(&decay, &[length])[0];
            assert!((value - (-1.0_f64).exp()).abs() < 1e-4, "{} {length}", method.name());
        }
    }
}

#[test]
fn rates_fifteen_decades_apart_are_followed() {
    let kinds = [UnknownKind::Differential; 2];
    let stiff = system(&kinds, &[(0, 0, -1.0), (1, 0, 1e15), (1, 1, -1e15)], &[1.0, 0.0]);
    for name in ["bdf", "tr-bdf2", "esdirk34"] {
        let run = Run::to(5.0).with_rtol(1e-8);
        let trajectory = by_name(name).unwrap().integrate(&stiff, &run, &mut Silent).unwrap();
        let state = trajectory.dense.sample(&stiff, &[1.0]);
        for value in state {
            assert!((value - (-1.0_f64).exp()).abs() < 1e-6, "{name}: {value}");
        }
    }
}

#[test]
fn without_unknowns_the_outputs_follow_the_inputs() {
    let mut still = system(&[], &[], &[]);
    let pieces = vec![
        Piece { value: 1.0, slope: 0.5, ..Piece::default() },
        Piece { start: 2.0, value: -1.0, sine: 2.0, cosine: 0.3, omega: 400.0, ..Piece::default() },
    ];
    still.waveforms = vec![Waveform::new(pieces).unwrap()];
    still.inputs = vec![Input { waveform: 0, derivative: 0 }, Input { waveform: 0, derivative: 1 }];
    still.input_matrix = CsrMatrix::zeros(0, 2);
    let inputs = LinearForm::term(0, 3.0).plus(1.0, &LinearForm::term(1, 0.25));
    still.outputs = Outputs::new();
    still.outputs.push("sum", "N", 2.0, &LinearForm::zero(), &inputs);
    for method in steppers().filter_map(by_name) {
        let trajectory = method.integrate(&still, &Run::to(5.0), &mut Silent).unwrap();
        let signal = trajectory.signal(&still, 0);
        for k in 0..=1000 {
            let t = f64::from(k) * 0.005;
            let piece = still.waveforms[0].piece_at(t);
            let expected = 2.0 * (3.0 * piece.derivative(0, t) + 0.25 * piece.derivative(1, t));
            // The phase 400 t is rounded to 10⁻¹³ in several places, and rates reach 400.
            assert!((signal.value(t) - expected).abs() < 1e-9, "{} at {t}", method.name());
        }
    }
}

#[test]
fn more_waves_than_can_be_kept_are_refused_before_they_are_followed() {
    let mut still = system(&[], &[], &[]);
    still.inputs = vec![Input { waveform: 0, derivative: 0 }];
    still.input_matrix = CsrMatrix::zeros(0, 1);
    still.outputs = Outputs::new();
    still.outputs.push("sine", "N", 1.0, &LinearForm::zero(), &LinearForm::term(0, 1.0));
    // From 3·10⁷ panels on.
    for (omega, duration) in [(1e9, 0.5), (1e20, 1.0), (600.0, 1e30)] {
        let piece = Piece { sine: 1.0, omega, ..Piece::default() };
        still.waveforms = vec![Waveform::new(vec![piece]).unwrap()];
        for method in steppers().filter_map(by_name) {
            let free = method.integrate(&still, &Run::to(duration), &mut Silent);
            assert!(matches!(free, Err(SolveError::TooLarge { .. })), "{free:?}");
            let run = Run { budget: Budget::of(1_000_000_000), ..Run::to(duration) };
            let bound = method.integrate(&still, &run, &mut Silent);
            assert!(matches!(bound, Err(SolveError::BudgetSpent { .. })), "{bound:?}");
            assert!((1_000_000_000..3_000_000_000).contains(&run.budget.done()));
        }
    }
}

#[test]
fn balances_that_determine_nothing_are_refused_by_name() {
    use UnknownKind::{Algebraic, Differential};
    // u1 and u2 share the only balance that contains them; the other one speaks of u0 alone.
    let entries = [(0, 0, -1.0), (1, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)];
    let missing = system(&[Differential, Algebraic, Algebraic], &entries, &[1.0, 0.0, 0.0]);
    for name in ["bdf", "tr-bdf2", "esdirk34"] {
        let result = by_name(name).unwrap().integrate(&missing, &Run::to(1.0), &mut Silent);
        let Err(SolveError::NotApplicable { reason, .. }) = result else { panic!("{result:?}") };
        assert!(reason.contains("u2"), "{reason}");
    }
    // Two equal balances, in dense and in sparse matrices.
    for size in [3, 41] {
        let mut entries = vec![(0, 0, -1.0)];
        entries.extend([(1, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0), (2, 1, 1.0), (2, 2, 1.0)]);
        entries.extend((3..size).map(|at| (at, at, 1.0)));
        let mut kinds = vec![Algebraic; size];
        kinds[0] = Differential;
        let mut initial = vec![0.0; size];
        initial[0] = 1.0;
        let equal = system(&kinds, &entries, &initial);
        for name in ["bdf", "tr-bdf2", "esdirk34"] {
            let result = by_name(name).unwrap().integrate(&equal, &Run::to(1.0), &mut Silent);
            assert!(matches!(result, Err(SolveError::NotApplicable { .. })), "{name}: {result:?}");
        }
    }
    let result = Tsit45.integrate(&missing, &Run::to(1.0), &mut Silent);
    assert!(matches!(result, Err(SolveError::NotApplicable { .. })));
}

#[test]
fn an_observer_sees_every_step_and_may_end_the_run() {
    struct Count(usize);
    impl Observer for Count {
        fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
            self.0 += 1;
            assert_eq!(progress.steps, self.0);
            if self.0 == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        }
    }
    let problem = problems::underdamped();
    for method in steppers().filter_map(by_name) {
        let mut count = Count(0);
        let result = method.integrate(&problem.system, &Run::to(problem.t_end), &mut count);
        assert!(matches!(result, Err(SolveError::Cancelled { .. })), "{}", method.name());
        assert_eq!(count.0, 7);
    }
}
