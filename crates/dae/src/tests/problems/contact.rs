//! A ball against a half-space.

use dashpot_numerics::quadrature::GaussLegendre;

use super::{
    Problem, TIME_SCALE,
    nonlinear::{Law, mass_under, term},
};
use crate::LinearForm;

/// A ball that touches with `v = 1`, is pushed by `f = x^(3/2)` while it is pressed in, and flies off.
///
/// With `v = cos θ` the time is `t = x_m ⅘ ∫ sin^(−1/5) θ dθ` and the depth `x = x_m sin^(4/5) θ`, where
/// `x_m = (5/4)^(2/5)`; the flight begins at `θ = π`.
pub(crate) fn hertz_contact() -> Problem {
    let law = Law {
        value: |x| if x > 0.0 { x * x.sqrt() } else { 0.0 },
        slope: |x| if x > 0.0 { 1.5 * x.sqrt() } else { 0.0 },
    };
    let push = term(2, law, &[(0, 1.0)], LinearForm::zero());
    let deepest = 1.25_f64.powf(0.4);
    let half = deepest * phase_time(std::f64::consts::FRAC_PI_2.powf(0.2));
    let solution = move |t: f64| {
        if t >= 2.0 * half {
            return vec![2.0 * half - t, -1.0, 0.0];
        }
        let (elapsed, sign) = if t <= half { (t, 1.0) } else { (2.0 * half - t, -1.0) };
        let angle = phase(elapsed / deepest).powi(5);
        let x = deepest * angle.sin().powf(0.8);
        vec![x, sign * angle.cos(), x * x.sqrt()]
    };
    Problem {
        name: "contact of Hertz",
        difficulty: "a law that begins and ends with an infinite curvature",
        system: mass_under(&[], push, [0.0, 1.0]),
        t_end: 4.0 * TIME_SCALE,
        stiff: false,
        solution: Box::new(solution),
    }
}

/// `⅘ ∫ sin^(−1/5) θ dθ` from 0 to `q⁵`; in `q` the integrand is analytic.
fn phase_time(q: f64) -> f64 {
    GaussLegendre::with_points(32).integrate(0.0, q, rate)
}

/// Its derivative over `q`.
fn rate(q: f64) -> f64 {
    let angle = q.powi(5);
    let sinc = if angle < 1e-9 { 1.0 } else { angle.sin() / angle };
    4.0 * q.powi(3) * sinc.powf(-0.2)
}

/// The `q` at which [`phase_time`] is `time`, by Newton's method from where the sine is its angle.
fn phase(time: f64) -> f64 {
    let mut q = time.max(0.0).powf(0.25);
    for _ in 0..50 {
        if q == 0.0 {
            break;
        }
        let step = (phase_time(q) - time) / rate(q);
        q -= step;
        if step.abs() <= 1e-16 * q {
            break;
        }
    }
    q
}
