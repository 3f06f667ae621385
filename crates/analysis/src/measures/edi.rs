//! Effective displacement index.

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    first_nonlinear,
    parameters::{
        Dimension, InvalidParameter, ModelValue, Parameter, ParameterKind, Value, WindowWish,
        positive,
    },
    part,
};
use dashpot_rheology::Tree;

use super::{Family, MeasureKind, Needs, Reading, WHOLE_RUN, window};
use crate::{
    Solution,
    driven::{Oscillator, largest_deformation},
};

/// The effective displacement index, `EDI = max |y|` \[m\]: how far a mass on a model of springs and
/// dashpots is displaced by what an accelerometer on the body reads.
///
/// | symbol | field   | unit | range    |
/// |--------|---------|------|----------|
/// |        | `model` |      | linear springs and dashpots |
/// | `m`    | `mass`  | kg   | positive |
///
/// `m y″ + F = m a(t)`, where `F` is the force of the model at the deformation `y`, from rest at the
/// start of the window. Jumps of the speed act as impulses. The body does not feel the mass.
///
/// # References
///
/// The thesis, chapter II, asks for it with a Maxwell model (`thesis` in `docs/references.bib`).
#[derive(Debug, Clone)]
pub struct Edi {
    /// What the mass hangs on.
    pub model: Model,
    /// The mass \[kg\].
    pub mass: f64,
    /// The part of the run that drives it, and in which its largest displacement is sought.
    pub window: WindowWish,
}

impl Default for Edi {
    /// An example, not one from the literature: 1 kg on a Maxwell element of 4 kN/m and 100 N s/m.
    fn default() -> Self {
        let maxwell = [part(Spring { stiffness: 4e3 }), part(Dashpot { damping: 100.0 })];
        Self { model: Tree::series(maxwell), mass: 1.0, window: WindowWish::Run }
    }
}

impl Edi {
    fn oscillator(&self) -> Option<Oscillator> {
        Oscillator::of(&self.model, self.mass)
    }
}

impl MeasureKind for Edi {
    const KIND: &'static str = "edi";
    const SUMMARY: &'static str =
        "largest displacement of a mass on a model that the acceleration drives [m]";
    const UNIT: &'static str = "m";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            "model",
            ParameterKind::Model,
            "what the mass hangs on: linear springs and dashpots",
        ),
        Parameter::optional(
            "mass",
            ParameterKind::Quantity(Dimension::MASS),
            "1 kg",
            "the mass m [kg], positive",
        ),
        WHOLE_RUN,
    ];
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let invalid = |found: &str| {
            let range = "made of linear springs and dashpots that can deform";
            InvalidParameter::new("model", range, found)
        };
        let Some(Value::Model(ModelValue(model))) = values.first() else {
            return Err(invalid("missing"));
        };
        if let Some(element) = first_nonlinear(model) {
            return Err(invalid(&format!("not linear (`{}`)", element.kind())));
        }
        let mass = values.get(1).and_then(Value::number);
        let mass = mass.ok_or_else(|| InvalidParameter::new("mass", "a number", "missing"))?;
        positive("mass", mass)?;
        let measure = Self { model: model.clone(), mass, window: window(values, 2)? };
        if measure.oscillator().is_some() { Ok(measure) } else { Err(invalid("rigid")) }
    }

    fn values(&self) -> Vec<Value> {
        let model = Value::Model(ModelValue(self.model.clone()));
        vec![model, Value::Number(self.mass), Value::Window(self.window)]
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        match self.oscillator() {
            Some(own) => largest_deformation(solution, target, (&own, 1.0), self.window),
            None => Reading::undefined("its model is not linear, or cannot deform"),
        }
    }
}
