use std::convert::Infallible;

use super::*;

/// `ż = z²` from 1: `1/(1 − t)`, beside something that rests.
fn blow_up(z: &[f64], slopes: &mut [f64]) {
    slopes.copy_from_slice(&[z[0] * z[0], 0.0]);
}

/// The step from `start` over this length, with its dense output.
fn taken<V>(start: V, length: f64, f: fn(&[f64], &mut [f64])) -> Step<V>
where
    V: AsRef<[f64]> + AsMut<[f64]> + Clone,
{
    let mut f = |_: f64, z: &V, slopes: &mut V| {
        f(z.as_ref(), slopes.as_mut());
        Ok::<(), Infallible>(())
    };
    let mut step = Step::new(start);
    let Ok(()) = step.begin(&mut f);
    let Ok(()) = step.attempt(length, &mut f);
    let Ok(()) = step.close(&mut f);
    let Ok(()) = step.fit(&mut f);
    step
}

fn at(step: &Step<[f64; 2]>, x: f64) -> f64 {
    let mut values = [0.0; 2];
    step.look(x, &mut values);
    values[0]
}

#[test]
fn steps_are_of_order_8_and_what_is_between_of_order_7() {
    let errors = |length: f64| {
        let step = taken([1.0, 0.0], length, blow_up);
        let exact = |t: f64| (1.0 - t).recip();
        [step.end()[0] - exact(length), at(&step, 0.4) - exact(0.4 * length)].map(f64::abs)
    };
    let [coarse, fine] = [errors(0.2), errors(0.1)];
    // Halving divides an error of local order n + 1 by 2^(n + 1).
    for (at, order) in [(0, 9.0), (1, 8.0)] {
        let found = (coarse[at] / fine[at]).log2();
        assert!(found > order - 0.3, "{at}: {found}");
    }
}

#[test]
fn slopes_that_hang_on_time_are_asked_for_at_their_stages() {
    // `ż = 8 t⁷` is integrated without error, from where the last step ended.
    let mut step = Step::new(vec![0.0]);
    let power = |from: f64| {
        move |x: f64, _: &Vec<f64>, slopes: &mut Vec<f64>| {
            slopes[0] = 8.0 * (from + 0.5 * x).powi(7);
            Ok::<(), Infallible>(())
        }
    };
    let Ok(()) = step.begin(&mut power(0.0));
    for from in [0.0, 0.5] {
        let Ok(()) = step.attempt(0.5, &mut power(from));
        let Ok(()) = step.close(&mut power(from));
        assert!((step.end()[0] - (from + 0.5).powi(8)).abs() < 1e-14, "{from}");
        assert!((step.slopes().last().unwrap()[0] - 8.0 * (from + 0.5).powi(7)).abs() < 1e-14);
        step.go_on();
    }
    assert!((step.slopes()[0][0] - 8.0).abs() < 1e-14);
}

#[test]
fn a_step_ends_where_slopes_cannot_be_told() {
    let mut step = Step::new(vec![1.0]);
    let mut calls = 0;
    let outcome = step.attempt(0.1, &mut |x, _: &Vec<f64>, _: &mut Vec<f64>| {
        calls += 1;
        if x > 0.3 { Err(x) } else { Ok(()) }
    });
    assert_eq!((outcome.map_err(|x| x < 0.34), calls), (Err(true), 5));
}

#[test]
fn unknowns_on_the_heap_are_those_on_the_stack() {
    let stack = taken([1.0, 0.0], 0.3, blow_up);
    let heap = taken(vec![1.0, 0.0], 0.3, blow_up);
    let mut inside = vec![0.0; 2];
    heap.look(0.4, &mut inside);
    assert_eq!(heap.end().as_slice(), stack.end());
    assert_eq!(inside[0].to_bits(), at(&stack, 0.4).to_bits());
}

#[test]
fn dense_output_meets_both_ends_with_their_slopes() {
    let step = taken([1.0, 0.0], 0.1, blow_up);
    let near = 1e-6;
    let rate = |a: f64, b: f64| (at(&step, b) - at(&step, a)) / (0.1 * (b - a));
    assert!((at(&step, 0.0) - 1.0).abs() < 1e-15);
    assert!((at(&step, 1.0) - step.end()[0]).abs() < 1e-15);
    assert!((rate(0.0, near) - 1.0).abs() < 1e-6);
    assert!((rate(1.0 - near, 1.0) / step.end()[0].powi(2) - 1.0).abs() < 1e-6);
}

#[test]
fn the_error_counts_what_has_a_unit() {
    let f = |z: &[f64], slopes: &mut [f64]| slopes.copy_from_slice(&[z[0] * z[0], 3.0 * z[1]]);
    let mut step = taken([1.0, 1.0], 0.3, f);
    let unit = |at: usize, size: f64| if at == 0 { 1e-6 * size } else { 0.0 };
    let first = step.error(1.0, unit);
    let both = step.error(1.0, |_, size| 1e-6 * size);
    let alone = |length: f64| taken([1.0, 0.0], length, blow_up).error(1.0, unit);
    assert!((first / alone(0.3) - 1.0).abs() < 1e-12);
    assert!(both > 0.0 && (both - first).abs() > 0.0);
    assert!((step.error(100.0, unit) / first - 100.0).abs() < 1e-12);
    // Three times shorter is some 3^8 better.
    assert!(alone(0.1) < 1e-3 * first);
}

#[test]
fn steps_show_their_fastest_rate() {
    let mut own = Step::new([1.0, 0.0]);
    let mut f = |_: f64, z: &[f64; 2], slopes: &mut [f64; 2]| {
        *slopes = [-4.0 * z[0], 0.0];
        Ok::<(), Infallible>(())
    };
    let Ok(()) = own.begin(&mut f);
    let Ok(()) = own.attempt(0.3, &mut f);
    let Ok(()) = own.close(&mut f);
    assert!((own.rate() - 4.0).abs() < 1e-9, "{}", own.rate());
}

#[test]
fn the_next_step_is_what_the_error_lets_it_be() {
    let mut own = Controller::default();
    // Twice the step has 2⁸ times the error.
    assert!((own.factor(0.5_f64.powi(8)) - 1.8).abs() < 1e-12);
    assert!((own.factor(0.0) - 6.0).abs() < 1e-12);
    // One that is rejected is followed by a shorter one, and this one by none that is longer.
    assert!((own.factor(2.0_f64.powi(8)) - 0.45).abs() < 1e-12);
    assert!((own.factor(1e9) - 1.0 / 3.0).abs() < 1e-12);
    assert!((own.factor(1e-9) - 1.0).abs() < 1e-12);
    assert!((own.factor(1e-9) - 6.0).abs() < 1e-12);
    assert!((own.factor(1.0 + 1e-9) - 0.9).abs() < 1e-8);
    assert!((own.factor(f64::NAN) - 0.25).abs() < 1e-12);
    assert!((allowed(0.5, 1e-8) - 4.5).abs() < 1e-12);
}
