//! At which frequency two receptances disagree most.

use dashpot_numerics::extrema::maximum;

use super::{Receptance, complex::Complex};

/// Points between neighbouring frequencies at which something may happen.
const BETWEEN: usize = 8;
/// Steps of the search for a maximum between two points.
const STEPS: usize = 60;
/// How far beyond the poles the limits are taken.
const FAR: f64 = 1e8;

/// The angular frequency of the largest relative difference of `H(iω)`, and that difference.
///
/// It changes on the scale of the poles' own frequencies and dampings: points are placed there and
/// between them, and every local maximum is enclosed by a golden section.
pub(super) fn worst(a: &Receptance, b: &Receptance) -> (f64, f64) {
    let mut marks = Vec::new();
    for term in a.terms.iter().chain(&b.terms).filter(|term| term.at.size() > 0.0) {
        let (damping, frequency) = (term.at.re.high().abs(), term.at.im.high().abs());
        marks.extend([term.at.size(), frequency, frequency - damping, frequency + damping]);
    }
    marks.retain(|mark| *mark > 0.0);
    marks.sort_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (marks.first(), marks.last()) else {
        return (0.0, apart(a, b, 1.0));
    };
    let mut points = vec![low / FAR, low / FAR.sqrt()];
    marks.insert(0, low * 1e-3);
    marks.push(high * 1e3);
    for pair in marks.windows(2) {
        let ratio = (pair[1] / pair[0]).ln() / BETWEEN as f64;
        points.extend((0..BETWEEN).map(|at| pair[0] * (ratio * at as f64).exp()));
    }
    points.extend([high * 1e3, high * FAR.sqrt(), high * FAR]);
    points.dedup();
    let values: Vec<f64> = points.iter().map(|&omega| apart(a, b, omega)).collect();
    let last = points.len() - 1;
    let mut best = (0.0, values[0]);
    for at in 1..last {
        let is_peak = values[at] >= values[at - 1] && values[at] >= values[at + 1];
        if is_peak && values[at] > 0.0 {
            let value = |x: f64| apart(a, b, x.exp());
            let (place, height) = maximum(points[at - 1].ln(), points[at + 1].ln(), STEPS, value);
            let peak = (place.exp(), height);
            let peak = if peak.1 > values[at] { peak } else { (points[at], values[at]) };
            // Beyond the limits' own rounding, so that a plateau is reported as a limit.
            if peak.1 > best.1 * (1.0 + 1e-6) {
                best = peak;
            }
        }
    }
    if values[last] > best.1 * (1.0 - 1e-6) && values[last] > values[0] {
        best = (f64::INFINITY, values[last]);
    }
    best
}

/// Relative difference at one frequency.
fn apart(a: &Receptance, b: &Receptance, omega: f64) -> f64 {
    let s = Complex::new(0.0, omega);
    let (a, b) = (a.value(s), b.value(s));
    let size = a.size().max(b.size());
    if size > 0.0 && size.is_finite() { (a - b).size() / size } else { 0.0 }
}
