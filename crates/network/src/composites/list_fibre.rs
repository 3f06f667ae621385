//! Fibre with a list of retardation times.

use dashpot_rheology::spectra::{List, Retardation};

use super::{
    Composed, CompositeKind,
    fibre::Kept,
    spectrum::{Term, sorted},
};
use crate::{
    parameters,
    parameters::{Described, Dimension, InvalidParameter},
};

parameters! {
    /// A fibre or felt with the listed retardation times `λ` and compliances `J`, in the fewest
    /// Kelvin–Voigt elements that keep its creep `R(t) = Σ J (1 − e^(−t/λ))`: see
    /// [`reduce`](dashpot_rheology::spectra::reduce). `kelvin-chain` keeps them all.
    ///
    /// | symbol  | field        | unit | range                  |
    /// |---------|--------------|------|------------------------|
    /// | `λ`     | first column | s    | > 0, all different     |
    /// | `J`     | second       | m/N  | > 0                    |
    /// |         | `from`, `to` | s    | > 0, `to` after `from` |
    /// |         | `error`      | 1    | 1e-8 … 1               |
    ///
    /// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of
    /// `spring` beside `dashpot`.
    #[derive(Debug, Clone, PartialEq)]
    pub struct ListFibre: "list-fibre",
        "fibre with a list of retardation times, in the fewest Kelvin-Voigt elements"
    {
        /// pairs of retardation time [s] and compliance [m/N], both positive
        pub terms: Vec<Term> = TimeTable;
        /// time from which on the creep is kept [s], positive
        pub from: f64 = Quantity(Dimension::TIME), range Positive;
        /// time up to which the creep is kept [s], later than `from`
        pub to: f64 = Quantity(Dimension::TIME), range Positive;
        /// greatest relative error of the creep in that range, from 1e-6 % to below 100 %
        pub error: f64 = Quantity(Dimension::NUMBER), default "0.1 %";
    }
    sample {
        terms: vec![(1e-4, 1e-8), (1.2e-4, 1e-8), (1e-3, 2e-8), (1e-2, 1e-8)],
        from: 1e-5,
        to: 0.1,
        error: 1e-2,
    }
}

impl ListFibre {
    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

impl CompositeKind for ListFibre {
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        let lines = sorted("terms", &self.terms)?.into_iter();
        let lines = lines.map(|(time, compliance)| Retardation { time, compliance });
        let list = List::new(lines.collect())
            .map_err(|own| InvalidParameter::new("terms", own.range, own.value))?;
        self.kept().composed(&list)
    }
}

#[cfg(test)]
mod tests {
    use dashpot_rheology::LinearModel;

    use super::*;
    use crate::primitive;

    #[test]
    fn a_long_list_keeps_its_creep_in_fewer_elements() {
        let terms: Vec<Term> =
            (0..=40).map(|at| (10_f64.powf(-4.0 + 0.05 * f64::from(at)), 1e-9)).collect();
        let fibre = ListFibre { terms: terms.clone(), from: 1e-4, to: 1e-1, error: 1e-3 };
        let composed = fibre.compose().unwrap();
        let count = composed.model.branches().len();
        assert!(count < 8, "{count} elements");
        assert!(
            composed.note.unwrap().to_string().contains("Kelvin elements keep the creep within")
        );
        let model = LinearModel::of(&composed.model, |part| primitive(part.as_ref()));
        for at in 0..=300 {
            let t = 10_f64.powf(-4.0 + 0.01 * f64::from(at));
            let exact: f64 = terms.iter().map(|term| -term.1 * (-t / term.0).exp_m1()).sum();
            assert!((model.creep(t) / exact - 1.0).abs() <= 1e-3, "{t}");
        }
    }
}
