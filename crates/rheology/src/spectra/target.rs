//! The creep function that a sum has to follow, on the logarithm of time.

use std::f64::consts::PI;

use dashpot_numerics::{
    chebyshev::{self, Interpolation},
    roots::bisect,
};

use super::{Spectrum, kinds::Sum, whole};

/// Degree of the polynomials that stand for a function in one panel.
const DEGREE: usize = 14;
/// Greatest half width of a panel in `ln t`.
const HALF_PANEL: f64 = 0.2;
/// Places per panel at which a polynomial is looked at when it is bounded.
const LOOKS: usize = 1100;

/// Creep of a spectrum over a range of time, divided by the total compliance.
///
/// `ln t` is cut into panels with the Chebyshev nodes of a polynomial of degree 14 each. For every positive spectrum
/// and `|θ| < π/2`, `|R(t e^(iθ))| ≥ cos θ R(t)` because R rises and is concave, and `|R(t e^(iθ))| ≤ 2.4 R(t)` because
/// `|1 − e^(−z)| ≤ min(|z|, 2)`. Hence a ratio of two creep functions is analytic in the strip `|Im ln t| < π/2` and
/// bounded there, whatever the spectra: in the ellipse around a panel whose axes add to 12 half widths, by 30 times its
/// value in the panel. So it is a polynomial of degree 14 but for `30 · 4 · 12^(−14) / 11`, about 1e-14.
#[derive(Debug)]
pub(super) struct Target<'a> {
    spectrum: &'a dyn Spectrum,
    start: f64,
    end: f64,
    half: f64,
    panels: Vec<Panel>,
}

#[derive(Debug)]
struct Panel {
    /// Shares of the compliance at the nodes.
    shares: Vec<f64>,
    /// Chebyshev coefficients of their logarithm.
    logarithm: Vec<f64>,
}

impl<'a> Target<'a> {
    /// The creep of `spectrum` for `ln t` from `start` to `end`.
    pub(super) fn new(spectrum: &'a dyn Spectrum, start: f64, end: f64) -> Self {
        let count = ((end - start) / (2.0 * HALF_PANEL)).ceil().max(1.0);
        let half = 0.5 * (end - start) / count;
        let mut target = Self { spectrum, start, end, half, panels: Vec::new() };
        let nodes = Interpolation::of_degree(DEGREE);
        let panel = |panel: usize| {
            let share = |&node: &f64| target.share(target.place(panel, node));
            let shares: Vec<f64> = nodes.nodes().iter().map(share).collect();
            let logarithms: Vec<f64> = shares.iter().map(|share| share.ln()).collect();
            let mut logarithm = vec![0.0; DEGREE + 1];
            nodes.coefficients(&logarithms, &mut logarithm);
            Panel { shares, logarithm }
        };
        target.panels = (0..whole(count)).map(panel).collect();
        target
    }

    /// Both ends of the range of `ln t`.
    pub(super) fn range(&self) -> [f64; 2] {
        [self.start, self.end]
    }

    /// The part of the range outside of which the creep is a straight line before it and constant
    /// after it, but for a thousandth of how much it differs from these over the whole range.
    pub(super) fn steep_range(&self) -> [f64; 2] {
        let [start, end] = self.range();
        let logarithm = |place| self.quick_share(place).ln();
        let (first, last) = (logarithm(start), logarithm(end));
        let bend = |place| place - start - (logarithm(place) - first);
        let rest = |place| last - logarithm(place);
        // Creep rises and is concave, so that both conditions hold from one place on.
        let (least_bend, least_rest) = (1e-3 * bend(end), 1e-3 * rest(start));
        let from = bisect(start, end, 20, |place| bend(place) > least_bend);
        let to = bisect(start, end, 20, |place| rest(place) < least_rest);
        let [from, to] = [from, to].map(|(before, after)| f64::midpoint(before, after));
        if from < to { [from, to] } else { [start, end] }
    }

    /// Share of the total compliance at `ln t = place`, from the spectrum itself.
    pub(super) fn share(&self, place: f64) -> f64 {
        self.spectrum.creep(place.exp()) / self.spectrum.compliance()
    }

    /// The same, quickly and with a relative error of 1e-13, at a place within the range.
    pub(super) fn quick_share(&self, place: f64) -> f64 {
        let count = self.panels.len();
        let panel = whole((place - self.start) / (2.0 * self.half));
        let panel = panel.min(count - 1);
        let x = (place - self.place(panel, 0.0)) / self.half;
        chebyshev::evaluate(&self.panels[panel].logarithm, x).exp()
    }

    /// `ln t` at `node` within \[−1, 1\] of a panel.
    fn place(&self, panel: usize, node: f64) -> f64 {
        self.start + self.half * (2.0 * panel as f64 + 1.0 + node)
    }

    /// An upper bound of `|sum/R − 1|` over the whole range, at most 2e-4 of itself (and 1e-13) above the maximum.
    ///
    /// A polynomial of degree `d` is nowhere greater than `1/cos(π d/2N)` times its greatest value at
    /// `N` Chebyshev nodes.
    pub(super) fn bound(&self, sum: &Sum) -> f64 {
        let looks: Vec<f64> =
            (0..LOOKS).map(|look| -((look as f64 + 0.5) * PI / LOOKS as f64).cos()).collect();
        let nodes = Interpolation::of_degree(DEGREE);
        let (mut deviation, mut values) = (vec![0.0; DEGREE + 1], vec![0.0; LOOKS]);
        let mut worst = 0.0_f64;
        for (index, panel) in self.panels.iter().enumerate() {
            let at_node =
                |(node, share): (&f64, &f64)| (sum.share(self.place(index, *node)) - share) / share;
            let at_nodes: Vec<f64> = nodes.nodes().iter().zip(&panel.shares).map(at_node).collect();
            if at_nodes.iter().any(|value| !value.is_finite()) {
                return f64::INFINITY;
            }
            nodes.coefficients(&at_nodes, &mut deviation);
            if chebyshev::bound(&deviation) > worst {
                chebyshev::evaluate_all(&deviation, &looks, &mut values);
                worst = values.iter().fold(worst, |most, value| most.max(value.abs()));
            }
        }
        worst / (0.5 * PI * DEGREE as f64 / LOOKS as f64).cos() + 1e-13
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectra::{LogNormal, PowerLaw};

    #[test]
    fn quick_values_are_those_of_the_spectrum() {
        let spectra: [&dyn Spectrum; 3] = [
            &LogNormal::new(3.0, 1e-2, 1.0).unwrap(),
            &LogNormal::new(3.0, 1e-2, 1e-3).unwrap(),
            &PowerLaw::uniform(3.0, 1e-3, 1e-1).unwrap(),
        ];
        for spectrum in spectra {
            let target = Target::new(spectrum, -12.0, 5.0);
            for index in 0..=1700 {
                let place = -12.0 + 0.01 * f64::from(index);
                let (quick, slow) = (target.quick_share(place), target.share(place));
                assert!((quick / slow - 1.0).abs() < 1e-13, "{place}: {quick} {slow}");
            }
        }
    }

    #[test]
    fn the_bound_is_above_the_maximum_by_little() {
        let spectrum = PowerLaw::uniform(1.0, 1e-3, 1e-1).unwrap();
        let target = Target::new(&spectrum, -9.0, 1.0);
        let sum = Sum { terms: vec![(-6.0, -0.7), (-3.0, -0.6)] };
        let found = (0..=100_000)
            .map(|index| -9.0 + 1e-4 * f64::from(index))
            .map(|place| (sum.share(place) / target.share(place) - 1.0).abs())
            .fold(0.0, f64::max);
        let bound = target.bound(&sum);
        assert!(bound >= found && bound <= found * (1.0 + 3e-4), "{bound} {found}");
    }

    #[test]
    fn a_sum_that_is_not_a_number_has_no_bound() {
        let spectrum = PowerLaw::uniform(1.0, 1e-3, 1e-1).unwrap();
        let sum = Sum { terms: vec![(f64::NAN, 0.0)] };
        assert!(Target::new(&spectrum, -9.0, 1.0).bound(&sum).is_infinite());
    }
}
