//! Stress relaxation.

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value};

use super::{LONG, deforms};
use crate::rheometer::{
    FROM_THE_MODEL, Figure, ProtocolKind, RheometerError, RheometerReport, Specimen,
    given::{self, check_end, points_used, setting},
    history::{History, Instant},
    rig::Control,
    trial::Trial,
};
use crate::wording::quantity;

/// Part of the model's fastest time that a step takes where it cannot be sudden.
const QUICK: f64 = 0.01;

/// A deformation step that is held: `F(t) = y G(t)`.
///
/// A dashpot beside all else would answer a sudden step with an infinite force; the deformation of
/// such a model rises within a stated time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    /// The deformation \[m\], not zero.
    pub deformation: Option<f64>,
    /// How long reaching it takes \[s\], ≥ 0; `None` for no time, or, where that is impossible, a
    /// hundredth of the model's fastest time.
    pub rise: Option<f64>,
    /// End of the test \[s\], after the rise; `None` for 10 times the slowest time of the model
    /// after it.
    pub end: Option<f64>,
    /// About how many instants are looked at, 2 or more.
    pub points: usize,
}

impl Default for Relaxation {
    fn default() -> Self {
        Self { deformation: None, rise: None, end: None, points: given::USUAL_POINTS }
    }
}

const DEFORMATION: Parameter = Parameter::optional(
    "deformation",
    ParameterKind::Quantity(Dimension::LENGTH),
    "1 mm",
    "height of the deformation step [m], positive in compression, not zero",
);
const RISE: Parameter = Parameter::optional(
    "rise",
    ParameterKind::Quantity(Dimension::TIME),
    FROM_THE_MODEL,
    "how long the step takes [s], zero or positive; else 0 s, or 1/100 of the fastest time of a \
     model that a dashpot keeps from deforming at once",
);

impl ProtocolKind for Relaxation {
    const KIND: &'static str = "relaxation";
    const SUMMARY: &'static str = "a deformation step that is held; force over time";
    const PARAMETERS: &'static [Parameter] = &[DEFORMATION, RISE, given::END, given::POINTS];

    fn from_values(values: &[Option<Value>]) -> Result<Self, InvalidParameter> {
        Ok(Self {
            deformation: given::amplitude(values, 0, "deformation")?,
            rise: given::non_negative(values, 1, "rise")?,
            end: given::positive(values, 2, "end")?,
            points: given::points(values, 3)?,
        })
    }

    fn test(
        &self,
        specimen: &Specimen,
        methods: &[&str],
    ) -> Result<RheometerReport, RheometerError> {
        deforms(Self::KIND, specimen)?;
        let is_blocked = specimen.linear().maxwell().is_some_and(|form| form.dashpot() > 0.0);
        let (fastest, slowest) = specimen.range_of_times();
        let height = setting("deformation", "m", self.deformation, given::USUAL_DEFORMATION);
        let rise = setting("rise", "s", self.rise, if is_blocked { QUICK * fastest } else { 0.0 });
        if is_blocked && rise.value == 0.0 {
            let reason = "a dashpot beside all else answers a sudden deformation with an infinite \
                          force; give the step a `rise` time";
            return Err(RheometerError::Impossible { protocol: Self::KIND, reason });
        }
        let end = setting("end", "s", self.end, rise.value + LONG * slowest);
        check_end(end.value, rise.value)?;
        let history = History::step(height.value, rise.value, end.value);
        let trial = Trial::new(specimen, Control::Deformation, history, self.points, methods)?;
        let settings = vec![height, rise, end, points_used(self.points)];
        let mut report = trial.report(Self::KIND, settings);
        for (name, at) in [
            ("force just after the step", Instant::after(rise.value)),
            ("force at the end", Instant::before(end.value)),
        ] {
            let figure = Figure::of(name, "N", trial.answer(at)).computed(trial.simulated(at));
            report.figures.push(figure);
        }
        if rise.is_chosen && is_blocked {
            report.notes.push(format!(
                "a dashpot beside all else answers a sudden deformation with an infinite force: \
                 the deformation rises within {} instead",
                quantity(rise.value, "s")
            ));
        }
        if specimen.linear().kelvin().is_none() {
            report.notes.push("the model bears no force".to_owned());
        } else if specimen.linear().equilibrium_stiffness() == 0.0 {
            report.notes.push("a liquid: the force relaxes to nothing".to_owned());
        }
        Ok(report)
    }
}
