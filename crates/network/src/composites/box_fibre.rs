//! Fibre with a box spectrum.

use dashpot_rheology::spectra::PowerLaw;

use super::{
    Composed, CompositeKind,
    fibre::{Kept, invalid},
};
use crate::{
    parameters,
    parameters::{Described, Dimension, InvalidParameter},
};

parameters! {
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
    pub struct BoxFibre: "box-fibre",
        "fibre with retardation times alike between two, in the fewest Kelvin-Voigt elements"
    {
        /// total compliance J, the creep after all time [m/N], positive
        pub compliance: f64 = Quantity(Dimension::COMPLIANCE), range Positive;
        /// shortest retardation time [s], positive
        pub shortest: f64 = Quantity(Dimension::TIME), range Positive;
        /// longest retardation time [s], longer than `shortest`
        pub longest: f64 = Quantity(Dimension::TIME), range Positive;
        /// time from which on the creep is kept [s], positive
        pub from: f64 = Quantity(Dimension::TIME), range Positive;
        /// time up to which the creep is kept [s], later than `from`
        pub to: f64 = Quantity(Dimension::TIME), range Positive;
        /// greatest relative error of the creep in that range, from 1e-6 % to below 100 %
        pub error: f64 = Quantity(Dimension::NUMBER), default "0.1 %";
    }
    sample { compliance: 5e-8, shortest: 1e-5, longest: 0.1, from: 1e-5, to: 0.1, error: 1e-3 }
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
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        self.kept().composed(&self.spectrum()?)
    }
}
