//! The stress–energy method beside the curves: all of them as one, where that holds.
//!
//! The method takes the dynamic stress `y = G σ` of a material for a function of the dynamic energy `x = σ h/t` alone,
//! whatever the height `h`, the thickness `t` and the static stress `σ`, and fits it as `y = a e^(b x)`. For a law that
//! knows no rate the work up to the deepest strain `ε` is `∫ s dε = σ (h/t + ε)`, so that `y` is a function of that; what
//! the method leaves out is the small `σ ε`. Where the force depends on the rate it does not hold: the rate goes with
//! `√(2 g h)/t`, and drops of the same energy differ in it.
//!
//! # References
//!
//! `clemson135` in `docs/references.bib`.

use dashpot_numerics::decompositions::singular;
use nalgebra::{DMatrix, DVector};

use super::{Curve, CushionPoint, Known};

/// Points scatter about a polynomial of this degree in the logarithm of the energy.
const DEGREE: usize = 4;
/// Fewer points than so many for each number of the polynomial tell nothing.
const FEWEST: usize = 4;
/// The method holds where the curves scatter by less than this, relative, root mean square …
const COLLAPSED: f64 = 0.12;
/// … and an exponential says what it predicts where that leaves no more than this.
const EXPONENTIAL: f64 = 0.12;

dashpot_units::words! {
    /// Whether curves are one.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Collapse, pub fn word(self) {
        /// They are, and the exponential goes through them.
        Holds = "holds",
        /// They are, but of another form than the exponential.
        OtherForm = "other-form",
        /// They are not: the force does not depend on the deformation alone.
        Fails = "fails",
    }
}

/// Dynamic stress over dynamic energy.
#[derive(Debug, Clone, PartialEq)]
pub struct StressEnergy {
    /// `a` \[Pa\] and `b` \[1/Pa\] of `G σ = a e^(b σ h/t)`, with the smallest relative deviations.
    pub fit: [f64; 2],
    /// What that leaves, relative, root mean square.
    pub left: f64,
    /// By how much all curves scatter about one smooth curve, relative, root mean square.
    pub scatter: f64,
    /// Whether they are one.
    pub collapse: Collapse,
    /// The energies between which it is known \[J/m³\].
    pub range: [f64; 2],
    /// How many points of how many curves it is of.
    pub of: [usize; 2],
    /// Dynamic energy \[J/m³\] and dynamic stress \[Pa\] of each point.
    pub points: Vec<[f64; 2]>,
    /// The smooth curve: the logarithm of the stress as a polynomial of that of the energy, which goes from 0 to 1.
    smooth: Vec<f64>,
}

impl StressEnergy {
    /// The method for curves of several heights or thicknesses; `None` of a single one, or where too few points can be
    /// used. Drops on a stop are not of the material and left out.
    pub(super) fn of(curves: &[Curve], unit: f64) -> Option<Self> {
        let is_of_material = |own: &&CushionPoint| own.is_usable() && own.known == Known::Whole;
        let mut count = 0;
        let (mut energies, mut stresses) = (Vec::new(), Vec::new());
        for curve in curves {
            let before = energies.len();
            for own in curve.points.iter().filter(is_of_material) {
                energies.push(own.stress * curve.height / curve.thickness);
                stresses.push((own.peak / unit * own.stress).ln());
            }
            count += usize::from(energies.len() > before);
        }
        if count < 2 || energies.len() < FEWEST * (DEGREE + 1) {
            return None;
        }
        let range = energies
            .iter()
            .fold([f64::INFINITY, 0.0_f64], |[low, high], own| [low.min(*own), high.max(*own)]);
        let (line, left) = polynomial(&energies, &stresses, 1, range[1])?;
        let logs: Vec<f64> = energies.iter().map(|own| (own / range[0]).ln()).collect();
        let scale = (range[1] / range[0]).ln();
        let (smooth, scatter) = polynomial(&logs, &stresses, DEGREE, scale)?;
        let collapse = match (scatter <= COLLAPSED, left <= EXPONENTIAL) {
            (false, _) => Collapse::Fails,
            (true, false) => Collapse::OtherForm,
            (true, true) => Collapse::Holds,
        };
        let fit = [line[0].exp(), line[1] / range[1]];
        let of = [energies.len(), count];
        let points = energies.iter().zip(&stresses).map(|(x, y)| [*x, y.exp()]).collect();
        Some(Self { fit, left, scatter, collapse, range, of, points, smooth })
    }

    /// The stress \[Pa\] of the smooth curve at an energy \[J/m³\] within the range.
    pub fn smooth(&self, energy: f64) -> f64 {
        let place = (energy / self.range[0]).ln() / (self.range[1] / self.range[0]).ln();
        self.smooth.iter().rev().fold(0.0, |sum, own| sum * place + own).exp()
    }

    /// The stress \[Pa\] of the exponential at an energy \[J/m³\].
    pub fn exponential(&self, energy: f64) -> f64 {
        self.fit[0] * (self.fit[1] * energy).exp()
    }

    /// The peak in multiples of g that the method predicts for a drop; `None` where it does not hold, or was not seen
    /// at such an energy.
    pub fn predicted(&self, height: f64, thickness: f64, stress: f64) -> Option<f64> {
        let energy = stress * height / thickness;
        let is_within = energy >= self.range[0] && energy <= self.range[1];
        let peak = || self.exponential(energy) / stress;
        (self.collapse == Collapse::Holds && is_within).then(peak)
    }
}

/// The polynomial of `x/scale` with the least squares of what it leaves, and the root mean square of that.
fn polynomial(x: &[f64], y: &[f64], degree: usize, scale: f64) -> Option<(Vec<f64>, f64)> {
    let rows = x.len();
    let powers = DMatrix::from_fn(rows, degree + 1, |row, power| {
        (x[row] / scale).powi(i32::try_from(power).unwrap_or(0))
    });
    let values = DVector::from_column_slice(y);
    let found = singular(&powers)?.solve(&values, f64::EPSILON).ok()?;
    let left = values - powers * &found;
    let rms = (left.norm_squared() / rows as f64).sqrt();
    rms.is_finite().then(|| (found.as_slice().to_vec(), rms))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Curves of three heights and two thicknesses with this peak in m/s², of height, thickness and stress.
    fn curves(peak: impl Fn(f64, f64, f64) -> f64) -> Vec<Curve> {
        let one = |height: f64, thickness: f64| Curve {
            height,
            thickness,
            floor: None,
            points: (0..12)
                .map(|at| {
                    let stress = 1e3 * 1.3_f64.powi(at);
                    let peak = peak(height, thickness, stress);
                    CushionPoint { stress, peak, error: 0.0, strain: 0.5, known: Known::Whole }
                })
                .collect(),
            best: None,
            passing: None,
            repeated: Vec::new(),
            bands: Vec::new(),
            best_band: None,
        };
        let all = [0.3, 0.6, 0.9].into_iter().flat_map(|own| [(own, 0.03), (own, 0.06)]);
        all.map(|(height, thickness)| one(height, thickness)).collect()
    }

    #[test]
    fn an_exponential_is_found_and_predicts_what_was_left_out() {
        let law = |h: f64, t: f64, s: f64| 9.8 * 5e4 * (2e-5 * s * h / t).exp() / s;
        let own = StressEnergy::of(&curves(law), 9.8).unwrap();
        assert!((own.fit[0] / 5e4 - 1.0).abs() < 1e-9 && (own.fit[1] / 2e-5 - 1.0).abs() < 1e-9);
        assert!(own.left < 1e-9 && own.collapse == Collapse::Holds, "{own:?}");
        for [energy, stress] in &own.points {
            assert!((own.exponential(*energy) / stress - 1.0).abs() < 1e-9);
        }
        let left = |[energy, stress]: &[f64; 2]| (own.smooth(*energy) / stress).ln().powi(2);
        let mean = own.points.iter().map(left).sum::<f64>() / own.points.len() as f64;
        assert!((mean.sqrt() - own.scatter).abs() < 1e-9, "{} {}", mean.sqrt(), own.scatter);
        let peak = own.predicted(0.45, 0.05, 2e3).unwrap();
        assert!((peak / (law(0.45, 0.05, 2e3) / 9.8) - 1.0).abs() < 1e-9);
        assert!(own.predicted(9.0, 0.01, 2e4).is_none(), "never seen there");
    }

    #[test]
    fn what_depends_on_the_height_besides_does_not_collapse() {
        let law = |h: f64, t: f64, s: f64| 9.8 * 5e4 * (2e-5 * s * h / t).exp() / s * (h / 0.3);
        let own = StressEnergy::of(&curves(law), 9.8).unwrap();
        assert_eq!(own.collapse, Collapse::Fails);
        assert!(own.predicted(0.45, 0.05, 2e3).is_none());
        // A square root is one curve, but no exponential.
        let law = |h: f64, t: f64, s: f64| 9.8 * 5e4 * (1e-5 * s * h / t).powf(0.8) / s;
        assert_eq!(StressEnergy::of(&curves(law), 9.8).unwrap().collapse, Collapse::OtherForm);
    }

    #[test]
    fn a_single_curve_says_nothing() {
        let law = |_: f64, _: f64, s: f64| 1e5 / s;
        assert!(StressEnergy::of(&curves(law)[..1], 9.8).is_none());
    }
}
