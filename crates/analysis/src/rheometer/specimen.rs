//! A model on the rheometer.

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    first_nonlinear, linear_model,
    parameters::InvalidParameter,
    part,
};
use dashpot_numerics::extrema::maxima;
use dashpot_rheology::{KelvinForm, LinearModel, MaxwellForm};

use super::{Figure, Note, RheometerError, history::logarithmic};

/// The time that stands for those of a model that has none \[s\].
const NO_TIME: f64 = 1.0;

/// A two-terminal model, ready to be tested.
#[derive(Debug, Clone)]
pub struct Specimen {
    model: Model,
    linear: Option<LinearModel>,
    nonlinear: Option<&'static str>,
    relaxation_times: Vec<f64>,
    retardation_times: Vec<f64>,
}

impl Specimen {
    /// The specimen of a model.
    ///
    /// # Errors
    ///
    /// [`RheometerError::Invalid`] for a constant out of its range or a series or parallel without
    /// parts, and [`RheometerError::OutOfScale`] where constants of a linear model are so far apart that the model's
    /// own leave the range of numbers.
    pub fn new(model: &Model) -> Result<Self, RheometerError> {
        check(model)?;
        if let Some(element) = first_nonlinear(model) {
            return Ok(Self {
                model: model.clone(),
                linear: None,
                nonlinear: Some(element.kind()),
                relaxation_times: Vec::new(),
                retardation_times: Vec::new(),
            });
        }
        let linear = linear_model(model);
        if !linear.is_in_range() {
            return Err(RheometerError::OutOfScale);
        }
        let times = |form: &MaxwellForm| -> Vec<f64> {
            form.elements().iter().map(|element| element.relaxation_time).collect()
        };
        let delays = |form: &KelvinForm| -> Vec<f64> {
            form.elements().iter().map(|element| element.retardation_time).collect()
        };
        Ok(Self {
            model: model.clone(),
            relaxation_times: linear.maxwell().map(times).unwrap_or_default(),
            retardation_times: linear.kelvin().map(delays).unwrap_or_default(),
            linear: Some(linear),
            nonlinear: None,
        })
    }

    /// The model as it was given.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The model, seen from outside; `None` where it is not linear, and simulation alone tells of it.
    pub fn linear(&self) -> Option<&LinearModel> {
        self.linear.as_ref()
    }

    /// Word of the first element that is not linear.
    pub fn nonlinear(&self) -> Option<&'static str> {
        self.nonlinear
    }

    /// Its Maxwell form, where it is linear and has one.
    pub(super) fn maxwell(&self) -> Option<&MaxwellForm> {
        self.linear()?.maxwell()
    }

    /// Its Kelvin form, where it is linear and has one.
    pub(super) fn kelvin(&self) -> Option<&KelvinForm> {
        self.linear()?.kelvin()
    }

    /// Its relaxation times \[s\], rising.
    pub fn relaxation_times(&self) -> &[f64] {
        &self.relaxation_times
    }

    /// Its retardation times \[s\], rising.
    pub fn retardation_times(&self) -> &[f64] {
        &self.retardation_times
    }

    /// The fastest and the slowest of all its times \[s\]; 1 s where it has none, or is not linear.
    pub fn range_of_times(&self) -> (f64, f64) {
        let all = || self.relaxation_times.iter().chain(&self.retardation_times).copied();
        let fastest = all().reduce(f64::min).unwrap_or(NO_TIME);
        (fastest, all().reduce(f64::max).unwrap_or(NO_TIME))
    }

    /// The slowest retardation time \[s\], or the slowest time of any kind where it has none.
    pub(super) fn slowest_retardation(&self) -> f64 {
        self.retardation_times.last().copied().unwrap_or_else(|| self.range_of_times().1)
    }

    /// The parts of the Kelvin form by the names of what they do, from the head on; those that the
    /// model has not are left out.
    pub(super) fn kelvin_chain(&self) -> Vec<(&'static str, Model)> {
        let Some((linear, form)) = self.linear().zip(self.kelvin()) else { return Vec::new() };
        let mut chain = Vec::new();
        if form.spring_compliance() > 0.0 {
            let stiffness = linear.instantaneous_stiffness();
            chain.push(("instantaneous", part(Spring { stiffness })));
        }
        let delayed: Vec<Model> = form
            .elements()
            .iter()
            .map(|element| {
                let spring = part(Spring { stiffness: element.stiffness });
                Model::parallel([spring, part(Dashpot { damping: element.damping })])
            })
            .collect();
        if !delayed.is_empty() {
            chain.push(("delayed", Model::series(delayed)));
        }
        if form.fluidity() > 0.0 {
            chain.push(("viscous", part(Dashpot { damping: linear.viscosity() })));
        }
        chain
    }

    /// What characterises a linear model whatever the test.
    pub(super) fn figures(&self) -> Vec<Figure> {
        let Some(linear) = self.linear() else { return Vec::new() };
        let figure = |name, unit, value: f64, note| Figure::of(name, unit, value).noting(note);
        vec![
            figure(
                "instantaneous stiffness",
                "N/m",
                linear.instantaneous_stiffness(),
                Note::NoInstantaneousStiffness,
            ),
            figure("equilibrium stiffness", "N/m", linear.equilibrium_stiffness(), Note::Rigid),
            figure("viscosity", "N s/m", linear.viscosity(), Note::Solid),
        ]
    }
}

/// Looks at every part of a model; its depth has no limit.
fn check(model: &Model) -> Result<(), InvalidParameter> {
    let mut left = vec![model];
    while let Some(tree) = left.pop() {
        match tree {
            Model::Part(element) => element.validate()?,
            Model::Series(branches) | Model::Parallel(branches) => {
                if branches.is_empty() {
                    let range = "one part or more";
                    return Err(InvalidParameter::new("series or parallel", range, "empty"));
                }
                left.extend(branches.iter().map(|branch| &branch.tree));
            }
        }
    }
    Ok(())
}

/// How far beyond the model's times peaks are looked for.
const BEYOND: f64 = 10.0;
/// Frequencies in each decade at which the search begins; peaks are wider than a decade.
const EACH_DECADE: f64 = 24.0;
/// Steps of the golden section: `0.618^60` is beyond what the peak can resolve.
const STEPS: usize = 60;

/// The highest of the peaks that the loss factor has at finite frequencies, as its angular frequency \[rad/s\], good to
/// about 1e-8 of itself, and its value; `None` where it has none.
pub(super) fn highest_loss_factor(specimen: &Specimen) -> Option<(f64, f64)> {
    let linear = specimen.linear()?;
    let (fastest, slowest) = specimen.range_of_times();
    let (low, high) = (1.0 / (BEYOND * slowest), BEYOND / fastest);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
    let count = (EACH_DECADE * (high / low).log10()).ceil() as usize + 1;
    let places = logarithmic(low, high, count);
    let (peaks, _) = maxima(&places, STEPS, |omega| linear.loss_factor(omega));
    peaks.into_iter().max_by(|one, other| one.1.total_cmp(&other.1))
}
