//! Fibre with a log-normal spectrum.

use dashpot_rheology::spectra::LogNormal;

use super::{
    Composed, CompositeKind,
    fibre::{COMPLIANCE, ERROR, FROM, Kept, TO, invalid},
};
use crate::{
    elements::number,
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value},
};

/// A fibre or felt with a bell of retardation times on a logarithmic axis, in the fewest
/// Kelvin–Voigt elements that keep its creep `R(t)`: see
/// [`LogNormal`] for the law and [`reduce`](dashpot_rheology::spectra::reduce) for the proof.
///
/// | symbol | field         | unit    | range                  |
/// |--------|---------------|---------|------------------------|
/// | `J`    | `compliance`  | m/N     | > 0                    |
/// | `λ_m`  | `time`        | s       | > 0                    |
/// |        | `width`       | decades | > 0, ≤ 100             |
/// |        | `from`, `to`  | s       | > 0, `to` after `from` |
/// |        | `error`       | 1       | 1e-8 … 1               |
///
/// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of
/// `spring` beside `dashpot`. With a small width it is the single Kelvin element of the thesis.
#[derive(Debug, Clone, PartialEq)]
pub struct LogNormalFibre {
    /// Total compliance `J` \[m/N\].
    pub compliance: f64,
    /// Median of the retardation times \[s\].
    pub time: f64,
    /// Standard deviation of `log10 λ` \[decades\].
    pub width: f64,
    /// Start of the range of time in which the creep is kept \[s\].
    pub from: f64,
    /// Its end \[s\].
    pub to: f64,
    /// Greatest relative error of the creep in that range.
    pub error: f64,
}

impl LogNormalFibre {
    fn spectrum(&self) -> Result<LogNormal, InvalidParameter> {
        LogNormal::new(self.compliance, self.time, self.width).map_err(invalid)
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

impl CompositeKind for LogNormalFibre {
    const KIND: &'static str = "log-normal-fibre";
    const SUMMARY: &'static str =
        "fibre with a bell of retardation times, in the fewest Kelvin-Voigt elements";
    const PARAMETERS: &'static [Parameter] = &[
        COMPLIANCE,
        Parameter::required(
            "time",
            ParameterKind::Quantity(Dimension::TIME),
            "median of the retardation times [s], positive",
        ),
        Parameter::required(
            "width",
            ParameterKind::Quantity(Dimension::NUMBER),
            "standard deviation of their decimal logarithms [decades], positive, at most 100",
        ),
        FROM,
        TO,
        ERROR,
    ];
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let fibre = Self {
            compliance: number(values, 0, "compliance")?,
            time: number(values, 1, "time")?,
            width: number(values, 2, "width")?,
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
        [self.compliance, self.time, self.width, self.from, self.to, self.error]
            .map(Value::Number)
            .to_vec()
    }

    fn sample() -> Self {
        Self { compliance: 5e-8, time: 2e-4, width: 1.0, from: 1e-5, to: 0.1, error: 1e-3 }
    }
}
