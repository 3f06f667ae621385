use std::{cell::RefCell, sync::Mutex};

use super::*;
use crate::{network::residuals::Task, optimum::Residuals as _};

fn fitted(most: usize) -> (NetworkFit, Vec<Search>) {
    let seen = RefCell::new(Vec::new());
    let watch = |own: Search| {
        seen.borrow_mut().push(own);
        if seen.borrow().len() > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let tests = [test(1, 5.0), test(2, 5.0)];
    let found = fit_watched(&numbers(), &tests, SETTINGS, &|_, own| Ok(pulse(own)), &watch);
    (found.unwrap(), seen.into_inner())
}

#[test]
fn each_phase_is_told_in_order_with_sums_that_fall() {
    let (found, seen) = fitted(usize::MAX);
    assert!(!found.is_stopped && found.is_converged());
    let place = |phase: Phase| match phase {
        Phase::Start { at, of } => {
            assert_eq!(of, 4);
            at
        }
        Phase::Refinement => 4,
        Phase::Certainty => 5,
        Phase::LeftOut { at, of } => {
            assert_eq!(of, 2);
            6 + at
        }
    };
    let places: Vec<usize> = seen.iter().map(|own| place(own.phase)).collect();
    assert!(places.is_sorted(), "{places:?}");
    // Two starts that agree are enough.
    for expected in [0, 1, 4, 6, 7] {
        assert!(places.contains(&expected), "{expected} is not in {places:?}");
    }
    for pair in seen.windows(2).filter(|pair| pair[0].phase == pair[1].phase) {
        assert!(pair[1].steps <= pair[0].steps || pair[1].cost <= pair[0].cost, "{pair:?}");
    }
}

#[test]
fn a_search_that_is_ended_gives_the_best_so_far() {
    let (whole, _) = fitted(usize::MAX);
    let mut last = f64::INFINITY;
    for most in [1, 3, 6] {
        let (found, seen) = fitted(most);
        assert!(found.is_stopped && !found.is_converged(), "{most}");
        assert_eq!(seen.len(), most + 1);
        assert!(found.tests.iter().all(|own| own.held_out.is_none()));
        let rms = found.tests[0].rms;
        assert!(rms <= last && rms >= 0.99 * whole.tests[0].rms, "{most}: {rms}");
        last = rms;
    }
}

#[test]
fn nothing_is_solved_again_where_it_has_just_been() {
    let asked = Mutex::new([0; 2]);
    let tests = [test(1, 5.0), test(2, 5.0)];
    let model = |test: usize, own: &[f64]| {
        asked.lock().unwrap()[test] += 1;
        Ok(pulse(own))
    };
    let numbers = numbers();
    let task = Task::new(&numbers, &tests, &model).ok().unwrap();
    let start = task.begin(&TRUE).unwrap();
    *asked.lock().unwrap() = [0; 2];
    task.residual(&start);
    task.jacobian(&start);
    // There at most, and to either side of each number.
    assert!(asked.lock().unwrap().iter().all(|own| *own <= 5), "{asked:?}");
}
