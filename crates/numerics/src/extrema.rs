//! Extrema of functions of one number.

use std::ops::ControlFlow;

/// A maximum of `f` between two places by golden section, as its place and value: that of the better one
/// of the two places that are left after so many `steps`, each of which narrows the interval by 0.618.
///
/// Where there are several maxima one of them is found. The place of a smooth one is good to half of
/// the digits, its value to all of them.
pub fn maximum(low: f64, high: f64, steps: usize, mut f: impl FnMut(f64) -> f64) -> (f64, f64) {
    let found =
        maximum_unless(low, high, steps, |x| ControlFlow::<(f64, f64), f64>::Continue(f(x)));
    match found {
        ControlFlow::Continue(found) | ControlFlow::Break(found) => found,
    }
}

/// As [`maximum`], unless `f` breaks the search off.
pub fn maximum_unless<B>(
    mut low: f64,
    mut high: f64,
    steps: usize,
    mut f: impl FnMut(f64) -> ControlFlow<B, f64>,
) -> ControlFlow<B, (f64, f64)> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut p, mut q) = (high - golden * (high - low), low + golden * (high - low));
    let (mut at_p, mut at_q) = (f(p)?, f(q)?);
    for _ in 0..steps {
        if at_p > at_q {
            (high, q, at_q) = (q, p, at_p);
            p = high - golden * (high - low);
            at_p = f(p)?;
        } else {
            (low, p, at_p) = (p, q, at_q);
            q = low + golden * (high - low);
            at_q = f(q)?;
        }
    }
    ControlFlow::Continue(if at_p > at_q { (p, at_p) } else { (q, at_q) })
}

/// The vertex of the parabola through three points in rising order, as its place, no farther than the
/// outer ones, and its value there; `None` where they are in line or no numbers.
///
/// # Panics
///
/// When the places are not in rising order.
pub fn vertex([a, b, c]: [(f64, f64); 3]) -> Option<(f64, f64)> {
    let [rise, fall] = [(a, b), (b, c)].map(|(p, q)| (q.1 - p.1) / (q.0 - p.0));
    let bend = (fall - rise) / (c.0 - a.0);
    if bend.is_nan() || bend == 0.0 {
        return None;
    }
    let place = (f64::midpoint(a.0, b.0) - 0.5 * rise / bend).clamp(a.0, c.0);
    Some((place, a.1 + rise * (place - a.0) + bend * (place - a.0) * (place - b.0)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maxima_inside_and_at_the_ends_are_found() {
        let (place, value) = maximum(0.0, 3.0, 60, f64::sin);
        assert!((place - std::f64::consts::FRAC_PI_2).abs() < 1e-7 && (value - 1.0).abs() < 1e-15);
        assert!((maximum(0.0, 1.0, 60, |x| x).0 - 1.0).abs() < 1e-12);
        assert!(maximum(0.0, 1.0, 60, |x| -x).0 < 1e-12);
        let steep = maximum(0.0, 1.0, 60, |x| if x < 0.3 { x } else { 0.3 - 1e9 * (x - 0.3) });
        assert!((steep.0 - 0.3).abs() < 1e-12);
    }

    #[test]
    fn the_vertex_of_a_parabola_is_found_from_uneven_points() {
        let value = |x: f64| (x, 3.0 - 2.0 * (x - 1.25) * (x - 1.25));
        let (place, height) = vertex([0.5, 1.0, 2.0].map(value)).unwrap();
        assert!((place - 1.25).abs() < 1e-14 && (height - 3.0).abs() < 1e-14);
        assert_eq!(vertex([(0.0, 1.0), (1.0, 1.0), (2.0, 1.0)]), None);
    }

    #[test]
    fn a_search_is_broken_off() {
        let mut looks = 0;
        let found = maximum_unless(0.0, 1.0, 60, |x| {
            looks += 1;
            if x > 0.9 { ControlFlow::Break(x) } else { ControlFlow::Continue(x) }
        });
        assert!(matches!(found, ControlFlow::Break(x) if x > 0.9) && looks < 10);
    }
}
