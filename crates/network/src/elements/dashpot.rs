//! Linear dashpot.

use super::{Element, Law, Tangent};
use crate::parameters;

parameters! {
    /// A linear (Newtonian) dashpot, `F = c ẏ`.
    ///
    /// | symbol | field     | unit    | range |
    /// |--------|-----------|---------|-------|
    /// | `c`    | `damping` | N·s/m   | ≥ 0   |
    ///
    /// The dashpot stores nothing and dissipates the power `c ẏ²`. `c = 0` is no dashpot at all.
    ///
    /// # Limits
    ///
    /// Where the rate jumps, so does the force. Alone it carries no weight at rest.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::Dashpot};
    ///
    /// let dashpot = Dashpot { damping: 6000.0 };
    /// assert_eq!(dashpot.force(0.01, 2.0), 12_000.0);
    /// ```
    ///
    /// # References
    ///
    /// `newton1687` in `docs/references.bib`, book II, section IX: resistance in proportion to the
    /// speed with which parts of a liquid are separated.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Dashpot: "dashpot", "linear dashpot, F = c y'" {
        /// dashpot constant c [N s/m], zero or positive
        pub damping as "dashpot": f64 = Quantity(Dimension::DAMPING), range NonNegative;
    }
    sample { damping: 50.0 }
}

impl Element for Dashpot {
    fn force(&self, _deformation: f64, rate: f64) -> f64 {
        self.damping * rate
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: 0.0, damping: self.damping }
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn law(&self) -> Law {
        Law::Dashpot(self.damping)
    }
}
