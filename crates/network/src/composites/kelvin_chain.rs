//! Kelvin–Voigt elements in series.

use super::{
    Composed, CompositeKind,
    spectrum::{Term, kelvin_chain, order_note, sorted},
};
use crate::{
    parameters,
    parameters::{Dimension, InvalidParameter},
};

parameters! {
    /// Kelvin–Voigt elements in series: `J(t) = Σ J_i (1 − exp(−t/λ_i))`, a fibre of the thesis with a
    /// list of retardation times. Its single Kelvin element is a list of one.
    ///
    /// | symbol | field   | unit | range                            |
    /// |--------|---------|------|----------------------------------|
    /// | `λ_i`  | `terms` | s    | > 0, all different, in any order |
    /// | `J_i`  | `terms` | m/N  | > 0                              |
    ///
    /// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of
    /// `spring` `1/J_i` beside `dashpot` `λ_i/J_i`.
    #[derive(Debug, Clone, PartialEq)]
    pub struct KelvinChain: "kelvin-chain",
        "Kelvin-Voigt elements in series, J(t) = Σ J_i (1 - exp(-t/λ_i)); a fibre"
    {
        /// terms [retardation time, compliance], for instance [["1 ms", "2e-8 m/N"], …]
        pub terms as "kelvin-chain": Vec<Term> = TimeTable;
    }
    sample { terms: vec![(1e-3, 5e-8), (0.1, 2e-8)] }
}

impl CompositeKind for KelvinChain {
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        let terms = sorted("kelvin-chain", &self.terms)?;
        let model = kelvin_chain("kelvin-chain", &terms)?;
        Ok(Composed { model, note: order_note(&self.terms, &terms, "kelvin-1"), until: None })
    }
}
