//! Kelvin–Voigt elements in series.

use super::{
    Composed, CompositeKind,
    spectrum::{Term, kelvin_chain, order_note, sorted, terms},
};
use crate::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value};

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
pub struct KelvinChain {
    /// Retardation times `λ_i` \[s\] and the compliances `J_i` \[m/N\] that unfold with them.
    pub terms: Vec<Term>,
}

impl CompositeKind for KelvinChain {
    const KIND: &'static str = "kelvin-chain";
    const SUMMARY: &'static str =
        "Kelvin-Voigt elements in series, J(t) = Σ J_i (1 - exp(-t/λ_i)); a fibre";
    const PARAMETERS: &'static [Parameter] = &[Parameter::required(
        "kelvin-chain",
        ParameterKind::TimeTable,
        "terms [retardation time, compliance], for instance [[\"1 ms\", \"2e-8 m/N\"], …]",
    )];
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let chain = Self { terms: terms(values, 0, "kelvin-chain")? };
        chain.compose().map(|_| chain)
    }

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        let terms = sorted("kelvin-chain", &self.terms)?;
        let model = kelvin_chain("kelvin-chain", &terms)?;
        Ok(Composed { model, note: order_note(&self.terms, &terms, "kelvin-1"), until: None })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Table(self.terms.clone())]
    }

    fn sample() -> Self {
        Self { terms: vec![(1e-3, 5e-8), (0.1, 2e-8)] }
    }
}
