//! Prony series.

use dashpot_rheology::{Branch, Tree};

use super::{
    Composed, CompositeKind,
    spectrum::{Term, constant, order_note, pair, sorted},
};
use crate::{
    elements::Spring,
    model::part,
    parameters,
    parameters::{Described, Dimension, InvalidParameter},
};

parameters! {
    /// A Prony series, the generalized Maxwell model: `G(t) = K_e + Σ K_j exp(−t/τ_j)`.
    ///
    /// | symbol | field         | unit   | range                                   |
    /// |--------|---------------|--------|-----------------------------------------|
    /// | `K_e`  | `equilibrium` | N/m    | ≥ 0; 0 is a liquid                      |
    /// | `τ_j`  | `terms`       | s      | > 0, all different, in any order        |
    /// | `K_j`  | `terms`       | N/m    | > 0                                     |
    ///
    /// The model is the spring `equilibrium` (where `K_e` > 0) beside the Maxwell elements `maxwell-1`,
    /// `maxwell-2`, … in rising order of time, each made of `spring` `K_j` and `dashpot` `K_j τ_j`.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::composites::{CompositeKind, Prony};
    ///
    /// let foam = Prony { equilibrium: 2e6, terms: vec![(1e-3, 3e6), (0.1, 1e6)] }.compose()?;
    /// let names: Vec<_> = foam.model.branches().iter().map(|own| own.name.as_ref()).collect();
    /// assert_eq!(names, ["equilibrium", "maxwell-1", "maxwell-2"]);
    /// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
    /// ```
    #[derive(Debug, Clone, PartialEq)]
    pub struct Prony: "prony", "spring beside Maxwell elements, G(t) = K_e + Σ K_j exp(-t/τ_j)" {
        /// stiffness after all relaxation K_e [N/m], zero or positive
        pub equilibrium: f64 = Quantity(Dimension::STIFFNESS), default "0 N/m", range NonNegative;
        /// terms [relaxation time, stiffness], for instance [["1 ms", "3 MN/m"], …]
        pub terms: Vec<Term> = TimeTable;
    }
    sample { equilibrium: 2e6, terms: vec![(1e-3, 3e6), (0.1, 1e6)] }
}

impl CompositeKind for Prony {
    const AMPLITUDE: Dimension = Dimension::STIFFNESS;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        let terms = sorted("terms", &self.terms)?;
        let mut branches = Vec::with_capacity(terms.len() + 1);
        if self.equilibrium > 0.0 {
            let spring = part(Spring { stiffness: self.equilibrium });
            branches.push(Branch::new("equilibrium", spring));
        }
        for (at, &(time, stiffness)) in terms.iter().enumerate() {
            let damping = constant("terms", (time, stiffness), stiffness * time)?;
            let maxwell = Tree::Series(pair(stiffness, damping));
            branches.push(Branch::new(format!("maxwell-{}", at + 1), maxwell));
        }
        let note = order_note(&self.terms, &terms, "maxwell-1");
        Ok(Composed { model: Tree::Parallel(branches), note, until: None })
    }
}
