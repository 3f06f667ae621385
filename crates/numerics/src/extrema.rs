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

/// The local maxima of `f` between rising positive `places`, each refined by [`maximum`] between its neighbours in the
/// logarithm of the place, and the values at the first and at the last place.
pub fn maxima(
    places: &[f64],
    steps: usize,
    mut f: impl FnMut(f64) -> f64,
) -> (Vec<(f64, f64)>, [f64; 2]) {
    let values: Vec<f64> = places.iter().map(|&place| f(place)).collect();
    let tops = (1..places.len().saturating_sub(1))
        .filter(|&at| values[at] > values[at - 1] && values[at] >= values[at + 1]);
    let mut refined = |at: usize| {
        let [low, high] = [at - 1, at + 1].map(|beside| places[beside].ln());
        let (place, value) = maximum(low, high, steps, |place| f(place.exp()));
        if value > values[at] { (place.exp(), value) } else { (places[at], values[at]) }
    };
    let ends = [values.first(), values.last()].map(|own| own.copied().unwrap_or(f64::NAN));
    (tops.map(&mut refined).collect(), ends)
}

/// The largest value of `f` over all positive numbers and its place, by [`maxima`] between `places` of which the first
/// and the last stand for the limits: 0 or infinity where a limit is the largest to some 10⁻⁶, and 0 where `f` is the
/// same everywhere.
pub fn largest_on_half_line(places: &[f64], steps: usize, f: impl FnMut(f64) -> f64) -> (f64, f64) {
    /// On a plateau rounding would decide, so a maximum has to stand out.
    const FLAT: f64 = 1.0 + 1e-6;
    let (maxima, [first, last]) = maxima(places, steps, f);
    let limit = if last > first { (f64::INFINITY, last) } else { (0.0, first) };
    let top = maxima.into_iter().filter(|own| own.1 > limit.1 * FLAT);
    top.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(limit)
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

/// Steps after which a maximum is taken as it is.
const MOST_STEPS: usize = 60;
/// The part of an interval in which a golden section steps.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// A maximum of `f` between the outer two of three places `(x, f(x))` in rising order, of which the middle one is no
/// lower than they are: its place to about `apart`, and its value. The steps are those of Brent's method, parabolas
/// through the best three places, and golden sections where these do not help. Where there are several maxima one of
/// them is found.
///
/// # Examples
///
/// ```
/// use dashpot_numerics::extrema::maximum_within;
///
/// let three = [1.0, 1.4, 2.0].map(|x: f64| (x, x.sin()));
/// let (place, value) = maximum_within(three, 1e-6, f64::sin);
/// assert!((place - std::f64::consts::FRAC_PI_2).abs() < 2e-6 && value <= 1.0);
/// ```
///
/// # References
///
/// `brent1973` in `docs/references.bib`.
pub fn maximum_within(
    [a, b, c]: [(f64, f64); 3],
    apart: f64,
    mut f: impl FnMut(f64) -> f64,
) -> (f64, f64) {
    let (mut low, mut high) = (a.0, c.0);
    let (mut best, [mut second, mut third]) = (b, if a.1 > c.1 { [a, c] } else { [c, a] });
    let (mut step, mut before) = (high - low, high - low);
    for _ in 0..MOST_STEPS {
        let middle = f64::midpoint(low, high);
        if (best.0 - middle).abs() + 0.5 * (high - low) <= 2.0 * apart {
            break;
        }
        let fall = (best.0 - third.0) * (best.1 - second.1);
        let rise = (best.0 - second.0) * (best.1 - third.1);
        let vertex =
            ((best.0 - second.0) * rise - (best.0 - third.0) * fall) / (2.0 * (fall - rise));
        let place = best.0 + vertex;
        let is_taken = vertex.abs() < 0.5 * before.abs() && place > low && place < high;
        let way = if is_taken {
            before = step;
            let is_at_end = place - low < 2.0 * apart || high - place < 2.0 * apart;
            if is_at_end { apart.copysign(middle - best.0) } else { vertex }
        } else {
            before = if best.0 < middle { high - best.0 } else { low - best.0 };
            GOLDEN * before
        };
        step = if way.abs() >= apart { way } else { apart.copysign(way) };
        let place = best.0 + step;
        let own = (place, f(place));
        if own.1 >= best.1 {
            *(if own.0 >= best.0 { &mut low } else { &mut high }) = best.0;
            (third, second, best) = (second, best, own);
        } else {
            *(if own.0 < best.0 { &mut low } else { &mut high }) = own.0;
            if own.1 >= second.1 {
                (third, second) = (second, own);
            } else if own.1 >= third.1 {
                third = own;
            }
        }
    }
    best
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
    fn a_maximum_within_three_places_takes_few_looks() {
        let mut looks = 0;
        let mut seen = |x: f64| {
            looks += 1;
            -(2.0 * x.exp() - 5.0 * x)
        };
        let three = [0.2, 0.8, 1.6].map(|x| (x, seen(x)));
        let (place, value) = maximum_within(three, 1e-5, seen);
        let right = 2.5_f64.ln();
        assert!((place - right).abs() < 2e-5, "{place} {right}");
        assert!((value + 5.0 - 5.0 * right).abs() < 1e-9 && looks <= 14, "{value}, {looks}");
        // Where nothing is known on one side, and at a kink.
        let cliff = |x: f64| if x < 0.7 { x } else { f64::NEG_INFINITY };
        let found = maximum_within([0.0, 0.5, 1.0].map(|x| (x, cliff(x))), 1e-6, cliff);
        assert!((found.0 - 0.7).abs() < 4e-6, "{found:?}");
        let kink = |x: f64| -(x - 0.3).abs();
        let found = maximum_within([0.0, 0.5, 1.0].map(|x| (x, kink(x))), 1e-6, kink);
        assert!((found.0 - 0.3).abs() < 4e-6, "{found:?}");
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
