//! Spring with a linear and a cubic part.

use super::{Element, Law, Tangent};
use crate::parameters;

parameters! {
    /// A spring with a linear and a cubic part, `F = k y + k₃ y³`.
    ///
    /// | symbol | field       | unit | range |
    /// |--------|-------------|------|-------|
    /// | `k`    | `stiffness` | N/m  | ≥ 0   |
    /// | `k₃`   | `cubic`     | N/m³ | ≥ 0   |
    ///
    /// Mindlin's "cubic elasticity" of cushions, Duffing's spring. Tension mirrors compression. The
    /// spring stores `½ k y² + ¼ k₃ y⁴` and dissipates none. At the deformation `√(k/k₃)` the force is
    /// twice that of the linear part. `k₃ < 0` is refused: such a law falls beyond `√(−k/(3 k₃))` and
    /// pulls beyond `√(−k/k₃)`. A spring that softens is a [`TableSpring`](super::TableSpring).
    ///
    /// # Limits
    ///
    /// The law has no stroke at which it would bottom: it goes on to any deformation. A cushion that
    /// bottoms is a [`StiffeningSpring`](super::StiffeningSpring) or has a
    /// [`Stop`](crate::effects::Stop).
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::CubicSpring};
    ///
    /// let spring = CubicSpring { stiffness: 2e4, cubic: 2e8 };
    /// assert!((spring.force(0.01, 0.0) - 400.0).abs() < 1e-12);
    /// ```
    ///
    /// # References
    ///
    /// `mindlin1945` in `docs/references.bib`, "Class B".
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct CubicSpring: "cubic-spring",
        "spring with a linear and a cubic part, F = k y + k3 y^3"
    {
        /// slope at rest k [N/m], zero or positive
        pub stiffness: f64 = Quantity(Dimension::STIFFNESS), range NonNegative;
        /// coefficient of the cube k3 [N/m^3], zero or positive
        pub cubic: f64 = Quantity(Dimension::new(1, -2, -2)), range NonNegative;
    }
    sample { stiffness: 2e4, cubic: 2e8 }
}

/// Deformation \[m\] at which the slope of a purely cubic spring counts as typical.
const TYPICAL: f64 = 0.01;

impl Element for CubicSpring {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        (self.stiffness + self.cubic * deformation * deformation) * deformation
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        let stiffness = self.stiffness + 3.0 * self.cubic * deformation * deformation;
        Tangent { stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        let square = deformation * deformation;
        (0.5 * self.stiffness + 0.25 * self.cubic * square) * square
    }

    fn law(&self) -> Law {
        if self.cubic <= 0.0 {
            return Law::Spring(self.stiffness);
        }
        let stiffness = self.stiffness.max(self.cubic * TYPICAL * TYPICAL);
        Law::Nonlinear { stiffness, damping: 0.0 }
    }

    fn cubics(&self) -> Option<Vec<f64>> {
        Some(Vec::new())
    }
}
