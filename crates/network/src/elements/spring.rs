//! Linear spring.

use super::{Element, Law, Tangent};
use crate::parameters;

parameters! {
    /// A linear (Hookean) spring, `F = k y`.
    ///
    /// | symbol | field       | unit | range |
    /// |--------|-------------|------|-------|
    /// | `k`    | `stiffness` | N/m  | ≥ 0   |
    ///
    /// The spring stores the energy `½ k y²` and dissipates none. `k = 0` is no spring at all.
    ///
    /// # Limits
    ///
    /// It has no limit of deformation: it may be pressed in by more than the thickness of what it
    /// stands for, which is warned of where that is known.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::Spring};
    ///
    /// let spring = Spring { stiffness: 200.0 };
    /// assert_eq!(spring.force(0.01, 0.0), 2.0);
    /// ```
    ///
    /// # References
    ///
    /// `hooke1678` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Spring: "spring", "linear spring, F = k y" {
        /// spring constant k [N/m], zero or positive
        pub stiffness as "spring": f64 = Quantity(Dimension::STIFFNESS), range NonNegative;
    }
    sample { stiffness: 200.0 }
}

impl Element for Spring {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.stiffness * deformation
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        0.5 * self.stiffness * deformation * deformation
    }

    fn law(&self) -> Law {
        Law::Spring(self.stiffness)
    }

    fn cubics(&self) -> Option<Vec<f64>> {
        Some(Vec::new())
    }
}
