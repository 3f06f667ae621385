//! Where e^z meets a straight line (3.39), by Lambert's W.

use lambert_w::{lambert_w0, lambert_wm1};

/// Steps of Newton's method after the closed form.
const STEPS: usize = 4;
/// Nearer than this to the place where the line touches the curve, such steps gain nothing.
const TOUCHES: f64 = 1e-3;

/// The places z at which `e^z = slope z + intercept`, in order: none, one or two.
///
/// With `v = z + intercept/slope` that is `v e^(−v) = e^(−intercept/slope)/slope`, so `v = −W`. For a positive slope W₀
/// gives the lower place and W₋₁ the upper one, both real where `intercept/slope + ln slope ≥ 1`; for a negative slope
/// W₀ gives the only one. A line that is flat meets the curve at `ln intercept`. Places where the line only touches the
/// curve are known to half of the digits.
pub fn intersections(slope: f64, intercept: f64) -> Vec<f64> {
    if slope == 0.0 {
        return Some(intercept.ln()).filter(|z| z.is_finite()).into_iter().collect();
    }
    let ratio = intercept / slope;
    let argument = -(-ratio).exp() / slope;
    // v − ln |v| of every solution; it has a value where the argument is beyond the doubles.
    let level = ratio + slope.abs().ln();
    let below = 1.0 - level;
    let branches = if slope < 0.0 {
        let start = if level < 0.0 { level + (-level).max(1.0).ln() } else { -(-level).exp() };
        vec![or_else(-lambert_w0(argument), start)]
    } else if below > 0.0 {
        Vec::new()
    } else if -below < TOUCHES * TOUCHES {
        // Half of the digits are gone: W itself may have none.
        let span = (-2.0 * below).sqrt();
        vec![1.0 - span, 1.0 + span]
    } else {
        let far = level + level.ln();
        vec![or_else(-lambert_w0(argument), (-level).exp()), or_else(-lambert_wm1(argument), far)]
    };
    let place = |v: f64| if v.abs() < 1.0 { v - ratio } else { (slope * v).ln() };
    let mut places: Vec<f64> =
        branches.into_iter().map(|start| place(refined(start, level))).collect();
    places.retain(|z| z.is_finite());
    places.dedup();
    places
}

/// The value of a branch where it is a number other than zero, else a start for Newton's method.
fn or_else(value: f64, start: f64) -> f64 {
    if value.is_finite() && value != 0.0 { value } else { start }
}

/// Newton's method for `v − ln |v| = level`.
fn refined(start: f64, level: f64) -> f64 {
    let mut v = start;
    for _ in 0..STEPS {
        let next = v * (level + v.abs().ln() - 1.0) / (v - 1.0);
        if (v - 1.0).abs() < TOUCHES || !next.is_finite() || next * v <= 0.0 {
            break;
        }
        v = next;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance of a place from the true one, by the slope of what is to be zero.
    fn miss(slope: f64, intercept: f64, z: f64) -> f64 {
        (z.exp() - slope * z - intercept) / (z.exp() - slope)
    }

    #[test]
    fn a_line_meets_the_exponential_twice_once_or_never() {
        // Figure 4, a to c: a falling line, one above the tangent, and one below it.
        for (slope, intercept, count) in [
            (-1.0, 3.0, 1),
            (-1.0, -3.0, 1),
            (2.0, 3.0, 2),
            (2.0, 0.0, 0),
            (0.057, 1.355, 2),
            (1.0, 1.0, 1),
            (0.0, 2.0, 1),
            (0.0, -2.0, 0),
            (1e-9, 1e3, 2),
            (-1e-3, 5e3, 1),
            (3.0, 1e6, 2),
        ] {
            let places = intersections(slope, intercept);
            assert_eq!(places.len(), count, "{slope} {intercept}: {places:?}");
            assert!(places.is_sorted());
            for z in places {
                let miss = miss(slope, intercept, z).abs();
                let is_tangent = (slope, intercept) == (1.0, 1.0);
                assert!(is_tangent || miss < 1e-14 * z.abs().max(1.0), "{slope} {intercept} {z}");
            }
        }
        assert_eq!(intersections(1.0, 1.0), [0.0]);
    }

    #[test]
    fn the_tangent_is_where_the_two_places_meet() {
        // e^z touches θ z + ψ where θ = e^z and ψ = θ (1 − z).
        for z in [-2.0_f64, 0.5, 3.0] {
            let (slope, intercept) = (z.exp(), z.exp() * (1.0 - z));
            for off in [1e-4, 1e-8] {
                let places = intersections(slope, intercept + off * slope);
                assert_eq!(places.len(), 2);
                // e^z − θ z − ψ ≈ ½ θ (z − z₀)².
                let span = (2.0 * off).sqrt();
                assert!((places[1] - places[0] - 2.0 * span).abs() < span * span, "{places:?}");
            }
            assert!(intersections(slope, intercept - 1e-8 * slope).is_empty());
        }
    }
}
