//! Fibres: spectra of retardation times in the fewest Kelvin–Voigt elements.

use dashpot_rheology::spectra::{
    InvalidSpectrum, List, LogNormal, MOST_BRANCHES, PowerLaw, Reduced, ReductionError,
    Retardation, SMALLEST_ERROR, Spectrum, reduce,
};

use super::{
    Composed, CompositeKind, CompositeNote,
    note::{percent, time},
    spectrum::{Term, kelvin_chain, sorted},
};
use crate::{
    parameters,
    parameters::{Dimension, InvalidParameter, Kind},
};

/// A spectrum of which the creep is kept.
trait Fibre: Kind {
    fn spectrum(&self) -> Result<impl Spectrum, InvalidParameter>;

    fn kept(&self) -> Kept;
}

impl<F: Fibre> CompositeKind for F {
    const AMPLITUDE: Dimension = Dimension::COMPLIANCE;

    fn compose(&self) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        self.kept().composed(&self.spectrum()?)
    }
}

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

impl Fibre for ListFibre {
    fn spectrum(&self) -> Result<impl Spectrum, InvalidParameter> {
        let lines = sorted("terms", &self.terms)?.into_iter();
        let lines = lines.map(|(time, compliance)| Retardation { time, compliance });
        List::new(lines.collect())
            .map_err(|own| InvalidParameter::new("terms", own.range, own.value))
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

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

impl Fibre for LogNormalFibre {
    fn spectrum(&self) -> Result<impl Spectrum, InvalidParameter> {
        LogNormal::new(self.compliance, self.time, self.width).map_err(invalid)
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

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
    /// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of `spring` beside
    /// `dashpot`. With two times that all but meet it is the single Kelvin element of the thesis.
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

impl Fibre for BoxFibre {
    fn spectrum(&self) -> Result<impl Spectrum, InvalidParameter> {
        PowerLaw::uniform(self.compliance, self.shortest, self.longest).map_err(invalid)
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

parameters! {
    /// A fibre or felt with a power law of retardation times between two, in the fewest Kelvin–Voigt
    /// elements that keep its creep `R(t)`: see [`PowerLaw`] for the law and
    /// [`reduce`](dashpot_rheology::spectra::reduce) for the proof.
    ///
    /// | symbol  | field        | unit | range                  |
    /// |---------|--------------|------|------------------------|
    /// | `J`     | `compliance` | m/N  | > 0                    |
    /// |         | `exponent`   | 1    | finite; 0 is a box     |
    /// | `λ_min` | `shortest`   | s    | > 0                    |
    /// | `λ_max` | `longest`    | s    | > `shortest`           |
    /// |         | `from`, `to` | s    | > 0, `to` after `from` |
    /// |         | `error`      | 1    | 1e-8 … 1               |
    ///
    /// The model is the series of `kelvin-1`, `kelvin-2`, … in rising order of time, each made of `spring` beside
    /// `dashpot`. With two times that all but meet it is the single Kelvin element of the thesis.
    #[derive(Debug, Clone, PartialEq)]
    pub struct PowerLawFibre: "power-law-fibre",
        "fibre with a power law of retardation times, in the fewest Kelvin-Voigt elements"
    {
        /// total compliance J, the creep after all time [m/N], positive
        pub compliance: f64 = Quantity(Dimension::COMPLIANCE), range Positive;
        /// exponent m of the density over ln λ, as λ^m; any finite number, 0 is a box
        pub exponent: f64 = Quantity(Dimension::NUMBER);
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
    sample {
        compliance: 5e-8,
        exponent: 0.3,
        shortest: 1e-5,
        longest: 0.1,
        from: 1e-5,
        to: 0.1,
        error: 1e-3,
    }
}

impl Fibre for PowerLawFibre {
    fn spectrum(&self) -> Result<impl Spectrum, InvalidParameter> {
        PowerLaw::new(self.compliance, self.exponent, self.shortest, self.longest).map_err(invalid)
    }

    fn kept(&self) -> Kept {
        Kept { from: self.from, to: self.to, error: self.error }
    }
}

/// What of a fibre's creep is to be kept: the range of time \[s\] and the greatest relative error.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kept {
    from: f64,
    to: f64,
    error: f64,
}

impl Kept {
    /// Accepts what a reduction can work with.
    fn validate(&self) -> Result<(), InvalidParameter> {
        if self.to <= self.from {
            return Err(InvalidParameter::new("to", "later than `from`", time(self.to)));
        }
        if !(SMALLEST_ERROR..1.0).contains(&self.error) {
            return Err(error_out_of_range(self.error));
        }
        Ok(())
    }

    /// The series `kelvin-1`, `kelvin-2`, … that stands for `spectrum`, with the note that says how well.
    fn composed(&self, spectrum: &dyn Spectrum) -> Result<Composed, InvalidParameter> {
        self.validate()?;
        let reduced = reduce(spectrum, [self.from, self.to], self.error).map_err(refused)?;
        let terms: Vec<Term> =
            reduced.branches.iter().map(|branch| (branch.time, branch.compliance)).collect();
        let model = kelvin_chain("compliance", &terms)?;
        Ok(Composed { model, note: Some(self.note(&reduced)), until: Some(self.to) })
    }

    fn note(&self, reduced: &Reduced) -> CompositeNote {
        CompositeNote::CreepKept {
            elements: reduced.branches.len(),
            error: reduced.error,
            range: [self.from, self.to],
            one_less: reduced.is_fewest.then_some(reduced.one_less),
        }
    }
}

/// A spectrum's fault as that of the key of the same name.
fn invalid(fault: InvalidSpectrum) -> InvalidParameter {
    InvalidParameter::new(fault.parameter, fault.range, fault.value)
}

fn refused(reason: ReductionError) -> InvalidParameter {
    match reason {
        ReductionError::Range { end, .. } => {
            InvalidParameter::new("to", "later than `from` by a millionth or more", time(end))
        }
        ReductionError::Error { error } => error_out_of_range(error),
        ReductionError::NotReached { reached, error, .. } => {
            let reached = percent(reached, f64::ceil);
            let range = format!("{reached} or more, what up to {MOST_BRANCHES} elements keep");
            InvalidParameter::new("error", range, percent(error, f64::floor))
        }
        other => InvalidParameter::new("compliance", "such that the creep is a number", other),
    }
}

fn error_out_of_range(error: f64) -> InvalidParameter {
    InvalidParameter::new("error", "from 1e-6 % to below 100 %", format!("{} %", error * 100.0))
}

#[cfg(test)]
mod tests {
    use dashpot_rheology::LinearModel;

    use super::*;
    use crate::{elements::Law, linear_model, parameters::Described as _, primitive};

    #[test]
    fn errors_are_rounded_to_the_safe_side() {
        assert_eq!(percent(8.321e-4, f64::ceil), "0.084 %");
        assert_eq!(percent(3.19e-3, f64::floor), "0.31 %");
        assert_eq!(percent(1e-3, f64::ceil), "0.1 %");
        assert_eq!(percent(0.999, f64::ceil), "100 %");
        assert_eq!(percent(0.1451, f64::ceil), "15 %");
        assert_eq!(percent(7.39e-7, f64::ceil), "0.000074 %");
        assert_eq!(percent(7.39e-9, f64::ceil), "7.4e-7 %");
    }

    #[test]
    fn times_have_handy_units() {
        let cases = [(1e-5, "10 µs"), (0.1, "100 ms"), (1.0, "1 s"), (86_400.0, "86400 s")];
        for (seconds, text) in cases {
            assert_eq!(time(seconds), text);
        }
        assert_eq!(time(1e-12), "0.001 ns");
    }

    #[test]
    fn a_fibre_keeps_the_creep_of_its_spectrum() {
        let fibre = LogNormalFibre::sample();
        let composed = fibre.compose().unwrap();
        let model = linear_model(&composed.model);
        let spectrum = LogNormal::new(fibre.compliance, fibre.time, fibre.width).unwrap();
        let worst = (0..=4000)
            .map(|index| 1e-5 * 10.0_f64.powf(0.001 * f64::from(index)))
            .map(|time| (model.creep(time) / spectrum.creep(time) - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(worst <= fibre.error, "{worst}");
        let note = composed.note.unwrap().to_string();
        let range = "from 10 µs to 100 ms (6 cannot do better than ";
        let kept = percent(worst, f64::ceil);
        let start = format!("7 Kelvin elements keep the creep within {kept} {range}");
        assert!(note.starts_with(&start), "{note}");
    }

    #[test]
    fn narrow_fibres_are_the_single_kelvin_element_of_the_thesis() {
        let time = 2e-4;
        let longest = time * (1.0 + 1e-9);
        let fibres = [
            LogNormalFibre { time, width: 1e-9, ..LogNormalFibre::sample() }.compose(),
            BoxFibre { shortest: time, longest, ..BoxFibre::sample() }.compose(),
            PowerLawFibre { shortest: time, longest, ..PowerLawFibre::sample() }.compose(),
        ];
        for composed in fibres.map(Result::unwrap) {
            assert!(
                composed
                    .note
                    .unwrap()
                    .to_string()
                    .starts_with("1 Kelvin element keeps the creep within")
            );
            let [element] = composed.model.branches() else { panic!("more than one element") };
            let laws: Vec<Law> = element.tree.branches().iter().map(leaf).collect();
            let [Law::Spring(stiffness), Law::Dashpot(damping)] = laws[..] else {
                panic!("{laws:?}")
            };
            assert!((stiffness * 5e-8 - 1.0).abs() < 1e-8, "{stiffness}");
            assert!((damping / stiffness / time - 1.0).abs() < 1e-8, "{damping}");
        }
    }

    fn leaf(branch: &dashpot_rheology::Branch<std::sync::Arc<dyn crate::Element>>) -> Law {
        match &branch.tree {
            dashpot_rheology::Tree::Part(element) => element.law(),
            _ => panic!("`{}` is composed", branch.name),
        }
    }

    #[test]
    fn notes_say_what_is_not_proved() {
        let kept = Kept { from: 1.0, to: 10.0, error: 0.1 };
        let branches = vec![Retardation { time: 1.0, compliance: 1.0 }; 2];
        let reduced = Reduced { branches, error: 0.05, one_less: 0.0, is_fewest: false };
        assert_eq!(
            kept.note(&reduced).to_string(),
            "2 Kelvin elements keep the creep within 5 % from 1 s to 10 s (whether fewer could is not \
             proved)"
        );
    }

    #[test]
    fn impossible_fibres_are_refused_at_the_right_key() {
        let refused = |fibre: PowerLawFibre| {
            let early = PowerLawFibre::from_values(&fibre.values()).err();
            let late = fibre.compose().err();
            assert!(early.is_none() || early == late, "{early:?} {late:?}");
            late.unwrap().to_string()
        };
        let sample = PowerLawFibre::sample;
        let text = refused(PowerLawFibre { compliance: 0.0, ..sample() });
        assert_eq!(text, "`compliance` must be positive and finite, but it is 0");
        let text = refused(PowerLawFibre { longest: 1e-6, ..sample() });
        assert!(text.starts_with("`longest` must be longer than `shortest`"), "{text}");
        let text = refused(PowerLawFibre { to: 1e-6, ..sample() });
        assert_eq!(text, "`to` must be later than `from`, but it is 1 µs");
        let text = refused(PowerLawFibre { error: 1.0, ..sample() });
        assert_eq!(text, "`error` must be from 1e-6 % to below 100 %, but it is 100 %");
        let text = refused(PowerLawFibre { exponent: f64::NAN, ..sample() });
        assert!(text.starts_with("`exponent` must be finite"), "{text}");
        let wide = PowerLawFibre { shortest: 1e-12, longest: 1e8, error: 1e-8, ..sample() };
        let text = refused(PowerLawFibre { from: 1e-12, to: 1e8, ..wide });
        assert!(text.starts_with("`error` must be") && text.contains("or more"), "{text}");
    }

    #[test]
    fn spectra_that_underflow_are_refused() {
        let line = Retardation { time: 1e200, compliance: 1e-200 };
        let kept = Kept { from: 1.0, to: 10.0, error: 0.1 };
        let error = kept.composed(&List::new(vec![line]).unwrap()).unwrap_err();
        assert!(error.to_string().contains("no relative error"), "{error}");
    }

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
