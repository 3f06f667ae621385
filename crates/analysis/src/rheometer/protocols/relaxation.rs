//! Stress relaxation.

use dashpot_network::{parameters, parameters::Kind as _};

use super::{LONG, deforms};
use crate::{
    Choice,
    rheometer::{
        FROM_THE_MODEL, Figure, Note, ProtocolKind, RheometerError, RheometerReport, Specimen,
        given::{self, check_end, points_used, setting},
        history::{History, Instant},
        simulation::Control,
        trial::Trial,
    },
};

/// Part of the model's fastest time that a step takes where it cannot be sudden.
const QUICK: f64 = 0.01;

parameters! {
    /// A deformation step that is held: `F(t) = y G(t)`.
    ///
    /// A dashpot beside all else would answer a sudden step with an infinite force; the deformation of
    /// such a model rises within a stated time.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Relaxation: "relaxation", "a deformation step that is held; force over time" {
        /// height of the deformation step [m], positive in compression, not zero
        pub deformation: Option<f64> = Quantity(Dimension::LENGTH), default "1 mm", range NotZero;
        /// how long the step takes [s], zero or positive; else 0 s, or 1/100 of the fastest time of
        /// a model that a dashpot keeps from deforming at once
        pub rise: Option<f64> = Quantity(Dimension::TIME),
            default FROM_THE_MODEL, range NonNegative;
        /// End of the test \[s\], after the rise; `None` for 10 times the slowest time of the model
        /// after it.
        pub end: Option<f64> => given::END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => given::POINTS;
    }
    default { deformation: None, rise: None, end: None, points: given::USUAL_POINTS }
}

impl ProtocolKind for Relaxation {
    fn test(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
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
        let trial = Trial::new(specimen, Control::Deformation, history, self.points, methods);
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
            report.notes.push(Note::Rise(rise.value));
        }
        if specimen.linear().kelvin().is_none() {
            report.notes.push(Note::NoForce);
        } else if specimen.linear().equilibrium_stiffness() == 0.0 {
            report.notes.push(Note::RelaxesToNothing);
        }
        Ok(report)
    }
}
