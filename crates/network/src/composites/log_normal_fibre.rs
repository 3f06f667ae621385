//! Fibre with a log-normal spectrum.

use dashpot_rheology::spectra::LogNormal;

use super::{
    Composed, CompositeKind,
    fibre::{Kept, invalid},
};
use crate::{
    parameters,
    parameters::{Described, Dimension, InvalidParameter},
};

parameters! {
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
    pub struct LogNormalFibre: "log-normal-fibre",
        "fibre with a bell of retardation times, in the fewest Kelvin-Voigt elements"
    {
        /// total compliance J, the creep after all time [m/N], positive
        pub compliance: f64 = Quantity(Dimension::COMPLIANCE), range Positive;
        /// median of the retardation times [s], positive
        pub time: f64 = Quantity(Dimension::TIME), range Positive;
        /// standard deviation of their decimal logarithms [decades], positive, at most 100
        pub width: f64 = Quantity(Dimension::NUMBER);
        /// time from which on the creep is kept [s], positive
        pub from: f64 = Quantity(Dimension::TIME), range Positive;
        /// time up to which the creep is kept [s], later than `from`
        pub to: f64 = Quantity(Dimension::TIME), range Positive;
        /// greatest relative error of the creep in that range, from 1e-6 % to below 100 %
        pub error: f64 = Quantity(Dimension::NUMBER), default "0.1 %";
    }
    sample { compliance: 5e-8, time: 2e-4, width: 1.0, from: 1e-5, to: 0.1, error: 1e-3 }
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
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        self.kept().composed(&self.spectrum()?)
    }
}
