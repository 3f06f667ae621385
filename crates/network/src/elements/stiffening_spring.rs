//! Spring that stiffens without bound towards a limit of its deformation.

use std::f64::consts::FRAC_PI_2;

use super::{Element, Law, Tangent, power::in_range};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A spring that stiffens without bound towards a limit of its deformation, `F = (2 k L/π) tan(π y/(2 L))`.
    ///
    /// | symbol | field       | unit | range |
    /// |--------|-------------|------|-------|
    /// | `k`    | `stiffness` | N/m  | > 0   |
    /// | `L`    | `limit`     | m    | > 0   |
    ///
    /// Mindlin's "tangent elasticity" of cushions that bottom: near rest it is the linear spring `k`, at
    /// half the limit it has 1.27 times the force of that spring and twice its slope. Tension mirrors
    /// compression. The spring stores `−(2 k L/π)·(2 L/π) ln cos(π y/(2 L))` and dissipates none.
    ///
    /// # Limits
    ///
    /// Beyond 0.999 `L` the law goes on as a straight line with the slope that it has there, 4.05·10⁵ k,
    /// so that it has a value everywhere; a run warns of it. A force of more than 811 k L would press it over its limit.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::StiffeningSpring};
    ///
    /// let spring = StiffeningSpring { stiffness: 2e4, limit: 0.02 };
    /// assert!((spring.force(0.01, 0.0) - 800.0 / std::f64::consts::PI).abs() < 1e-9);
    /// ```
    ///
    /// # References
    ///
    /// `mindlin1945` in `docs/references.bib`, "Class C".
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct StiffeningSpring: "stiffening-spring",
        "spring that bottoms at L, F = (2 k L/pi) tan(pi y/(2 L))", checked by Self::fits
    {
        /// slope at rest k [N/m], positive
        pub stiffness: f64 = Quantity(Dimension::STIFFNESS), range Positive;
        /// deformation L that it cannot reach [m], positive
        pub limit: f64 = Quantity(Dimension::LENGTH), range Positive;
    }
    sample { stiffness: 2e4, limit: 0.02 }
}

/// Part of the limit up to which the law holds; a straight line follows.
const LAST: f64 = 0.999;

impl StiffeningSpring {
    /// The part of the limit at which the law is taken, and how far the deformation is beyond \[m\].
    fn place(&self, deformation: f64) -> (f64, f64) {
        let part = deformation.abs() / self.limit;
        (part.min(LAST), ((part - LAST) * self.limit).max(0.0))
    }

    /// `2 L/π` \[m\].
    fn length(&self) -> f64 {
        self.limit / FRAC_PI_2
    }

    fn slope(&self, part: f64) -> f64 {
        self.stiffness / (FRAC_PI_2 * part).cos().powi(2)
    }

    fn value(&self, part: f64) -> f64 {
        self.stiffness * self.length() * (FRAC_PI_2 * part).tan()
    }

    /// Whether its steepest slope is a number.
    fn fits(&self) -> Result<(), InvalidParameter> {
        in_range("stiffness", self.stiffness, self.slope(LAST))
    }
}

impl Element for StiffeningSpring {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        let (part, beyond) = self.place(deformation);
        (self.value(part) + self.slope(part) * beyond).copysign(deformation)
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.slope(self.place(deformation).0), damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        let (part, beyond) = self.place(deformation);
        // −ln cos x = ½ ln(1 + tan² x), which keeps its digits where x is small.
        let curved =
            0.5 * self.stiffness * self.length().powi(2) * (FRAC_PI_2 * part).tan().powi(2).ln_1p();
        curved + (self.value(part) + 0.5 * self.slope(part) * beyond) * beyond
    }

    fn law(&self) -> Law {
        Law::Nonlinear { stiffness: self.stiffness, damping: 0.0 }
    }

    fn range(&self) -> Option<(f64, f64)> {
        Some((-LAST * self.limit, LAST * self.limit))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_linear_at_rest_and_goes_on_straight_near_the_limit() {
        let spring = StiffeningSpring { stiffness: 2e4, limit: 0.02 };
        assert!((spring.force(1e-8, 0.0) / 2e-4 - 1.0).abs() < 1e-12);
        assert!((spring.stored(1e-8) / 1e-12 - 1.0).abs() < 1e-12);
        assert!((spring.tangent(0.01, 0.0).stiffness / 4e4 - 1.0).abs() < 1e-14);
        let border = LAST * 0.02;
        let steepest = spring.tangent(border, 0.0).stiffness;
        assert!((steepest / 2e4 / 4.05e5 - 1.0).abs() < 1e-3);
        let (force, step) = (spring.force(border, 0.0), 1e-5);
        assert!((spring.force(border + step, 0.0) / (force + steepest * step) - 1.0).abs() < 1e-12);
        let energy = spring.stored(border) + (force + 0.5 * steepest * step) * step;
        assert!((spring.stored(border + step) / energy - 1.0).abs() < 1e-12);
        assert!((spring.force(0.02, 0.0) / (2e4 * 0.02) / 811.0 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn what_it_stores_is_the_closed_form() {
        let spring = StiffeningSpring { stiffness: 3.0, limit: FRAC_PI_2 };
        for y in [0.1, 0.7, 1.5_f64] {
            assert!((spring.force(-y, 0.0) + 3.0 * y.tan()).abs() < 1e-13 * y.tan() * 30.0);
            assert!((spring.stored(-y) + 3.0 * y.cos().ln()).abs() < 1e-13);
        }
    }
}
