use super::*;

/// `ż = z²` from 1: `1/(1 − t)`, beside something that rests.
fn blow_up(z: &[f64; 2]) -> [f64; 2] {
    [z[0] * z[0], 0.0]
}

#[test]
fn steps_are_of_order_8_and_what_is_between_of_order_7() {
    let errors = |length: f64| {
        let mut step = Step::from([1.0, 0.0], &mut blow_up);
        step.attempt(length, &mut blow_up);
        step.fit(&mut blow_up);
        let exact = |t: f64| (1.0 - t).recip();
        [step.end()[0] - exact(length), step.at(0.4)[0] - exact(0.4 * length)].map(f64::abs)
    };
    let [coarse, fine] = [errors(0.2), errors(0.1)];
    // Halving divides an error of local order n + 1 by 2^(n + 1).
    for (at, order) in [(0, 9.0), (1, 8.0)] {
        let found = (coarse[at] / fine[at]).log2();
        assert!(found > order - 0.3, "{at}: {found}");
    }
}

#[test]
fn dense_output_meets_both_ends_with_their_slopes() {
    let mut step = Step::from([1.0, 0.0], &mut blow_up);
    step.attempt(0.1, &mut blow_up);
    step.fit(&mut blow_up);
    let near = 1e-6;
    let rate = |a: f64, b: f64| (step.at(b)[0] - step.at(a)[0]) / (0.1 * (b - a));
    assert!((step.at(0.0)[0] - 1.0).abs() < 1e-15);
    assert!((step.at(1.0)[0] - step.end()[0]).abs() < 1e-15);
    assert!((rate(0.0, near) - 1.0).abs() < 1e-6);
    assert!((rate(1.0 - near, 1.0) / step.end()[0].powi(2) - 1.0).abs() < 1e-6);
}

#[test]
fn the_error_counts_what_has_a_unit() {
    let mut f = |z: &[f64; 2]| [z[0] * z[0], 3.0 * z[1]];
    let mut step = Step::from([1.0, 1.0], &mut f);
    step.attempt(0.3, &mut f);
    let unit = |at: usize, size: f64| if at == 0 { 1e-6 * size } else { 0.0 };
    let first = step.error(unit);
    let both = step.error(|_, size| 1e-6 * size);
    let mut alone = Step::from([1.0, 0.0], &mut blow_up);
    alone.attempt(0.3, &mut blow_up);
    assert!((first / alone.error(unit) - 1.0).abs() < 1e-12);
    assert!(both > 0.0 && (both - first).abs() > 0.0);
    // Three times shorter is some 3^8 better.
    alone.attempt(0.1, &mut blow_up);
    assert!(alone.error(unit) < 1e-3 * first);
}
