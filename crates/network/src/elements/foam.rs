//! Foam with a plateau and densification.

use dashpot_numerics::quadrature::integral;

use super::{
    Element, Law, Tangent,
    power::{in_range, power},
};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A block of foam with a plateau and densification: `F = A σ(ε)` with `ε = y/h` and
    /// `σ = σ_p (1 − e^(−E ε/σ_p)) + B (ε/(1 − ε))^n` in compression.
    ///
    /// | symbol | field           | unit | range |
    /// |--------|-----------------|------|-------|
    /// | `E`    | `modulus`       | Pa   | > 0   |
    /// | `σ_p`  | `plateau`       | Pa   | > 0   |
    /// | `B`    | `densification` | Pa   | ≥ 0   |
    /// | `n`    | `exponent`      | 1    | ≥ 1   |
    /// | `h`    | `thickness`     | m    | > 0   |
    /// | `A`    | `area`          | m²   | > 0   |
    ///
    /// `σ_p` is the stress of the plateau, and `B` is what densification adds to it at half the thickness. The law is
    /// that of Avalle, Belingardi and Ibba with their exponent `m = 0`: so it rises everywhere, while for `m > 0` it
    /// may fall at the end of the plateau. In tension the foam is linear, with the slope that it has at rest. Strain
    /// and stress are those of the undeformed block.
    ///
    /// The foam stores `h A ∫ σ dε` and dissipates none; foam that does is
    /// [`HystereticFoam`](super::HystereticFoam).
    ///
    /// # Limits
    ///
    /// Beyond the strain 0.99 the law goes on as a straight line with the slope that it has there, so
    /// that it has a value everywhere.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::Foam};
    ///
    /// let foam = Foam {
    ///     modulus: 2e6,
    ///     plateau: 1e5,
    ///     densification: 2e4,
    ///     exponent: 3.0,
    ///     thickness: 0.02,
    ///     area: 0.01,
    /// };
    /// // At half the thickness: the plateau, and what densification adds.
    /// assert!((foam.force(0.01, 0.0) - 1200.0).abs() < 0.1);
    /// ```
    ///
    /// # References
    ///
    /// `avalle2007` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Foam: "foam",
        "block of foam with plateau and densification, elastic", checked by Self::fits
    {
        /// modulus E at rest [Pa], positive
        pub modulus: f64 = Quantity(Dimension::PRESSURE), range Positive;
        /// stress of the plateau sigma_p [Pa], positive
        pub plateau: f64 = Quantity(Dimension::PRESSURE), range Positive;
        /// stress B that densification adds at half the thickness [Pa], zero or positive
        pub densification: f64 = Quantity(Dimension::PRESSURE), range NonNegative;
        /// exponent n of densification [1], 1 or more
        pub exponent: f64 = Quantity(Dimension::NUMBER), range AtLeastOne;
        /// thickness h [m], positive; here or beside the law, none in a material
        pub thickness: f64 = Quantity(Dimension::LENGTH), follows "that of the pad", range Positive;
        /// area A [m^2], positive; here or beside the law, none in a material
        pub area: f64 = Quantity(Dimension::new(0, 2, 0)),
            follows "that of the pad", range Positive;
    }
    sample {
        modulus: 2e6,
        plateau: 1e5,
        densification: 2e4,
        exponent: 3.0,
        thickness: 0.02,
        area: 0.01,
    }
}

/// Strain up to which the law holds; a straight line follows.
const LAST: f64 = 0.99;

impl Foam {
    /// Stress for strains from 0 to [`LAST`].
    fn curve(&self, strain: f64) -> f64 {
        let ratio = strain / (1.0 - strain);
        let decay = -self.modulus * strain / self.plateau;
        self.densification * power(ratio, self.exponent) - self.plateau * decay.exp_m1()
    }

    /// Its slope over the strain there.
    fn slope(&self, strain: f64) -> f64 {
        let (n, void) = (self.exponent, 1.0 - strain);
        let decay = -self.modulus * strain / self.plateau;
        let dense = self.densification * n * power(strain / void, n - 1.0) / (void * void);
        self.modulus * decay.exp() + dense
    }

    /// Stress \[Pa\] at a strain.
    fn stress(&self, strain: f64) -> f64 {
        if strain < 0.0 {
            self.slope(0.0) * strain
        } else if strain > LAST {
            self.curve(LAST) + self.slope(LAST) * (strain - LAST)
        } else {
            self.curve(strain)
        }
    }

    /// Energy per volume \[J/m³\] at a strain.
    fn energy(&self, strain: f64) -> f64 {
        if strain < 0.0 {
            return 0.5 * self.slope(0.0) * strain * strain;
        }
        let (within, beyond) = (strain.min(LAST), (strain - LAST).max(0.0));
        let plateau = self.plateau * self.plateau / self.modulus
            * above_tangent(self.modulus * within / self.plateau);
        let dense = |part: f64| (part / (1.0 - part)).powf(self.exponent);
        let densification = if self.densification > 0.0 {
            self.densification * integral(dense, 0.0, within)
        } else {
            0.0
        };
        let line = if beyond > 0.0 {
            (self.curve(LAST) + 0.5 * self.slope(LAST) * beyond) * beyond
        } else {
            0.0
        };
        plateau + densification + line
    }

    /// Slope of the force at rest \[N/m\].
    pub(super) fn stiffness(&self) -> f64 {
        self.slope(0.0) * self.area / self.thickness
    }

    /// Whether its slopes and energies are numbers.
    fn fits(&self) -> Result<(), InvalidParameter> {
        in_range("modulus", self.modulus, self.stiffness())?;
        in_range("plateau", self.plateau, self.plateau * self.plateau / self.modulus)?;
        let scale = self.area / self.thickness;
        let steepest =
            self.densification * self.exponent * (LAST / (1.0 - LAST)).powf(self.exponent);
        let slope = steepest * scale / (1.0 - LAST);
        if slope.is_finite() { Ok(()) } else { in_range("exponent", self.exponent, slope) }
    }
}

/// `x − (1 − e^(−x))` for `x ≥ 0`.
fn above_tangent(x: f64) -> f64 {
    if x > 0.5 {
        return x + (-x).exp_m1();
    }
    // The difference of two nearly equal numbers: its series, whose terms fall at least by 6.
    let mut term = 0.5 * x * x;
    let mut sum = term;
    let mut order = 2.0;
    while term.abs() > f64::EPSILON * sum {
        order += 1.0;
        term *= -x / order;
        sum += term;
    }
    sum
}

impl Element for Foam {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.area * self.stress(deformation / self.thickness)
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        let slope = self.slope((deformation / self.thickness).clamp(0.0, LAST));
        Tangent { stiffness: slope * self.area / self.thickness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.area * self.thickness * self.energy(deformation / self.thickness)
    }

    fn law(&self) -> Law {
        Law::Nonlinear { stiffness: self.stiffness(), damping: 0.0 }
    }

    fn range(&self) -> Option<(f64, f64)> {
        Some((f64::NEG_INFINITY, LAST * self.thickness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::{Described as _, Kind as _};

    #[test]
    fn energies_are_the_closed_forms_of_whole_exponents() {
        let foam = Foam::sample();
        let dense = |exponent: f64, strain: f64| {
            let own = Foam { modulus: 1e-20, densification: 1.0, exponent, ..foam };
            own.energy(strain)
        };
        for strain in [0.3, 0.6, 0.9, 0.99_f64] {
            let w: f64 = 1.0 - strain;
            let first = -w.ln() - strain;
            let third = 1.5 + 0.5 / (w * w) - 3.0 / w - 3.0 * w.ln() + w;
            assert!((dense(1.0, strain) / first - 1.0).abs() < 1e-13, "{strain}");
            assert!((dense(3.0, strain) - third).abs() < 1e-13 * (1.0 + 3.0 / w + third));
        }
    }

    #[test]
    fn the_excess_over_the_tangent_keeps_its_digits() {
        // The two ways that are used agree where one takes over from the other.
        let direct = |x: f64| x + (-x).exp_m1();
        for x in [0.3, 0.45, 0.5, 0.500_001] {
            assert!((above_tangent(x) / direct(x) - 1.0).abs() < 2e-15, "{x}");
        }
        assert!((above_tangent(1e-9) / 5e-19 - 1.0).abs() < 4e-10);
        assert!(above_tangent(0.0).abs() <= 0.0);
    }

    #[test]
    fn it_rises_from_its_modulus_over_the_plateau_to_the_wall() {
        let foam = Foam::sample();
        let (area, height) = (foam.area, foam.thickness);
        assert!((foam.tangent(0.0, 0.0).stiffness / (2e6 * area / height) - 1.0).abs() < 1e-14);
        assert!((foam.force(-0.001, 0.0) / (-2e6 * area * 0.05) - 1.0).abs() < 1e-14);
        let plain = Foam { densification: 0.0, ..foam };
        assert!((plain.force(0.9 * height, 0.0) / (1e5 * area) - 1.0).abs() < 1e-7);
        let border = LAST * height;
        let steepest = foam.tangent(border, 0.0).stiffness;
        let beyond = foam.force(border, 0.0) + 0.1 * height * steepest;
        assert!((foam.force(border + 0.1 * height, 0.0) / beyond - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_wall_beyond_double_precision_is_refused() {
        let foam = Foam { exponent: 200.0, ..Foam::sample() };
        assert_eq!(foam.validate().unwrap_err().parameter, "exponent");
    }
}
