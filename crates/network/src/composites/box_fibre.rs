//! Fibre with a box spectrum.

use dashpot_rheology::spectra::PowerLaw;

use super::{
    Composed, CompositeKind,
    fibre::{COMPLIANCE, ERROR, FROM, Kept, LONGEST, SHORTEST, TO, invalid},
};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, Value},
};

/// A fibre or felt with all retardation times between two alike on a logarithmic axis, in the
/// fewest Kelvin–Voigt elements that keep its creep `R(t)`: see
/// [`PowerLaw::uniform`] for the law and [`reduce`](dashpot_rheology::spectra::reduce) for the proof.
///
/// | symbol  | field        | unit | range                  |
/// |---------|--------------|------|------------------------|
/// | `J`     | `compliance` | m/N  | > 0                    |
/// | `λ_min` | `shortest`   | s    | > 0                    |
/// | `λ_max` | `longest`    | s    | > `shortest`           |
/// |         | `from`, `to` | s    | > 0, `to` after `from` |
/// |         | `error`      | 1    | 1e-8 … 1               |
///
/// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of
/// `spring` beside `dashpot`. With two times that all but meet it is the single Kelvin element of
/// the thesis.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxFibre {
    /// Total compliance `J` \[m/N\].
    pub compliance: f64,
    /// Shortest retardation time \[s\].
    pub shortest: f64,
    /// Longest retardation time \[s\].
    pub longest: f64,
    /// Start of the range of time in which the creep is kept \[s\].
    pub from: f64,
    /// Its end \[s\].
    pub to: f64,
    /// Greatest relative error of the creep in that range.
    pub error: f64,
}

impl BoxFibre {
    fn spectrum(&self) -> Result<PowerLaw, InvalidParameter> {
        PowerLaw::uniform(self.compliance, self.shortest, self.longest).map_err(invalid)
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

impl CompositeKind for BoxFibre {
    const KIND: &'static str = "box-fibre";
    const SUMMARY: &'static str =
        "fibre with retardation times alike between two, in the fewest Kelvin-Voigt elements";
    const PARAMETERS: &'static [Parameter] = &[COMPLIANCE, SHORTEST, LONGEST, FROM, TO, ERROR];
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let fibre = Self {
            compliance: number(values, 0, "compliance")?,
            shortest: number(values, 1, "shortest")?,
            longest: number(values, 2, "longest")?,
            from: number(values, 3, "from")?,
            to: number(values, 4, "to")?,
            error: number(values, 5, "error")?,
        };
        fibre.spectrum()?;
        fibre.kept().validate()?;
        Ok(fibre)
    }

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.kept().composed(&self.spectrum()?)
    }

    fn values(&self) -> Vec<Value> {
        [self.compliance, self.shortest, self.longest, self.from, self.to, self.error]
            .map(Value::Number)
            .to_vec()
    }

    fn sample() -> Self {
        Self { compliance: 5e-8, shortest: 1e-5, longest: 0.1, from: 1e-5, to: 0.1, error: 1e-3 }
    }
}
