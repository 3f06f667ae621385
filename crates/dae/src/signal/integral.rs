//! Areas under signals.

use std::f64::consts::FRAC_PI_4;

use dashpot_numerics::{
    Accumulator,
    chebyshev::{self, Coefficients, bracketed_root, evaluate, sign_changes},
    quadrature::integral_to,
};

use super::{Panel, Signal};

/// Difference of two rules at which the better one is taken, in parts of the typical integrand.
const TOLERANCE: f64 = 1e-12;

impl Signal {
    /// The integral over the window \[unit·s\], exact up to rounding.
    pub fn integral(&self, window: (f64, f64)) -> f64 {
        let mut sum = Accumulator::default();
        for panel in self.panels_in(window) {
            sum.add(panel.integral());
        }
        sum.value()
    }

    /// `∫ self · other dt` over the part of the window that both cover, exact up to rounding.
    pub fn integral_of_product(&self, other: &Self, window: (f64, f64)) -> f64 {
        let mut sum = Accumulator::default();
        self.overlaps(other, window, |one, two, start, end| {
            let (one, two) = (one.cut(start, end), two.cut(start, end));
            let product = chebyshev::integral_of_product(&one.coefficients, &two.coefficients);
            sum.add(0.5 * (end - start) * product);
        });
        sum.value()
    }

    /// `∫ |self| dt` over the window \[unit·s\], exact up to rounding: the area on both sides of zero.
    pub fn absolute_integral(&self, window: (f64, f64)) -> f64 {
        let mut sum = Accumulator::default();
        for panel in self.panels_in(window) {
            let zeros = sign_changes(&panel.coefficients);
            if zeros.is_empty() {
                sum.add(panel.integral().abs());
                continue;
            }
            let area = chebyshev::antiderivative(&panel.coefficients);
            let mut before = evaluate(&area, -1.0);
            for x in zeros.into_iter().chain([1.0]) {
                let after = evaluate(&area, x);
                sum.add(0.5 * panel.length() * (after - before).abs());
                before = after;
            }
        }
        sum.value()
    }

    /// A bound of `∫ |self| dt` over the window \[unit·s\]: itself where the signal keeps its sign, and as a
    /// rule two fifths more where it oscillates.
    pub fn area_bound(&self, window: (f64, f64)) -> f64 {
        let mut sum = Accumulator::default();
        for panel in self.panels_in(window) {
            let coefficients = &panel.coefficients;
            let middle = coefficients.first().map_or(0.0, |coefficient| coefficient.abs());
            let variation = chebyshev::variation(coefficients);
            sum.add(if middle > variation {
                panel.integral().abs()
            } else {
                panel.length() * mean_bound(coefficients).min(middle + variation)
            });
        }
        sum.value()
    }

    /// `∫ f(s(t)) dt` over the window to about 1e-13 of `∫ |f(s(t))| dt`.
    ///
    /// `f` must be smooth but at the `breaks`, values of the signal at which it may have a kink, a
    /// jump or a power such as `|s|^2.5`: the integral is split where the signal takes them, and in
    /// panels in which it does so at its extrema.
    pub fn integral_of(&self, window: (f64, f64), breaks: &[f64], f: impl Fn(f64) -> f64) -> f64 {
        let panels = self.panels_in(window);
        let middle = |panel: &Panel| panel.coefficients.first().map_or(0.0, |&c| f(c).abs());
        let rough: f64 = panels.clone().map(|panel| panel.length() * middle(&panel)).sum();
        let length: f64 = panels.clone().map(|panel| panel.length()).sum();
        let density = if length > 0.0 { rough / length } else { 0.0 };
        let mut sum = Accumulator::default();
        for panel in panels.filter(|panel| panel.length() > 0.0) {
            let curve = Curve { panel: &panel, f: &f, density };
            let places = places(&panel.coefficients, breaks);
            for pair in places.windows(2) {
                sum.add(0.5 * panel.length() * curve.piece(pair[0], pair[1]));
            }
        }
        sum.value()
    }
}

/// A bound of the mean of `|p|`: the mean of squares, weighted by `(1 − x²)^(-1/2) ≥ 1`, in which Chebyshev
/// polynomials are orthogonal.
fn mean_bound(coefficients: &[f64]) -> f64 {
    let largest = coefficients.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    let square = |own: &f64| (own / largest) * (own / largest);
    let all: f64 = coefficients.iter().map(square).sum();
    let first = coefficients.first().map_or(0.0, square);
    largest * (FRAC_PI_4 * (all + first)).sqrt() * (1.0 + 64.0 * f64::EPSILON)
}

/// A place and whether the signal takes a value there at which the integrand is not smooth.
type Place = (f64, bool);

/// The places that divide a panel: its ends, extrema and passages of the breaks.
fn places(coefficients: &[f64], breaks: &[f64]) -> Vec<Place> {
    let middle = coefficients.first().copied().unwrap_or(0.0);
    let spread = chebyshev::variation(coefficients) * (1.0 + 8.0 * f64::EPSILON);
    let met: Vec<f64> =
        breaks.iter().copied().filter(|level| (middle - level).abs() <= spread).collect();
    if met.is_empty() {
        return vec![(-1.0, false), (1.0, false)];
    }
    let slope = chebyshev::derivative(coefficients);
    let mut turns = vec![-1.0];
    turns.extend(sign_changes(&slope));
    turns.push(1.0);
    let mut places: Vec<Place> = turns.iter().map(|&x| (x, false)).collect();
    for level in met {
        let mut gap = Coefficients::from(coefficients);
        gap[0] -= level;
        let noise = 4.0 * f64::EPSILON * (spread + middle.abs() + level.abs());
        for (at, pair) in turns.windows(2).enumerate() {
            let (a, b) = ((pair[0], evaluate(&gap, pair[0])), (pair[1], evaluate(&gap, pair[1])));
            for (end, (_, gap)) in [(at, a), (at + 1, b)] {
                places[end].1 |= gap.abs() <= noise;
            }
            if a.1.abs() > noise && b.1.abs() > noise && (a.1 < 0.0) != (b.1 < 0.0) {
                places.push((bracketed_root(&gap, &slope, a, b), true));
            }
        }
    }
    places.sort_by(|one, two| one.0.total_cmp(&two.0));
    places
}

/// The integrand on a panel.
struct Curve<'a, F> {
    panel: &'a Panel,
    f: &'a F,
    /// Typical size of the integrand, against which errors are judged.
    density: f64,
}

impl<F: Fn(f64) -> f64> Curve<'_, F> {
    fn at(&self, x: f64) -> f64 {
        (self.f)(evaluate(&self.panel.coefficients, x))
    }

    /// The integral over `x` between two places.
    fn piece(&self, a: Place, b: Place) -> f64 {
        let width = b.0 - a.0;
        let tolerance = self.tolerance(0.5 * (a.0 + b.0)) * width;
        // x = a + width u³ makes a power of x − a smooth enough for the rule.
        let cubic = |u: f64| (width * u * u * u, 3.0 * width * u * u);
        match (a.1, b.1) {
            (false, false) => integral_to(|x| self.at(x), a.0, b.0, tolerance),
            (true, false) => {
                integral_to(|u| cubic(u).1 * self.at(a.0 + cubic(u).0), 0.0, 1.0, tolerance)
            }
            (false, true) => {
                integral_to(|u| cubic(u).1 * self.at(b.0 - cubic(u).0), 0.0, 1.0, tolerance)
            }
            (true, true) => {
                let middle = (0.5 * (a.0 + b.0), false);
                self.piece(a, middle) + self.piece(middle, b)
            }
        }
    }

    /// The error of the integrand near `x` that does not count, or that its rounding makes.
    fn tolerance(&self, x: f64) -> f64 {
        let coefficients = &self.panel.coefficients;
        let rounding = 4.0 * f64::EPSILON * chebyshev::bound(coefficients);
        let value = evaluate(coefficients, x);
        let noise = (self.f)(value + rounding) - (self.f)(value - rounding);
        noise.abs().max(TOLERANCE * self.density)
    }
}
