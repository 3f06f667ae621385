//! Deformations that are held, or grow at a constant rate: stress relaxation and the ramp.

use dashpot_network::{parameters, parameters::Kind as _};

use super::{
    END, POINTS, USUAL_DEFORMATION, USUAL_POINTS, deforms, end_of_test, points_used, setting,
};
use crate::{
    Choice,
    rheometer::{
        FROM_THE_MODEL, Note, ProtocolKind, RheometerError, Specimen, Tested,
        history::{Drive, History, Instant},
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
        /// End of the test \[s\], after the rise; `None` for 10 times the slowest time of the model after it.
        pub end: Option<f64> => END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { deformation: None, rise: None, end: None, points: USUAL_POINTS }
}

impl ProtocolKind for Relaxation {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        deforms(Self::KIND, specimen)?;
        let is_blocked = specimen.maxwell().is_some_and(|form| form.dashpot() > 0.0);
        let quick = QUICK * specimen.range_of_times().0;
        let height = setting("deformation", "m", self.deformation, USUAL_DEFORMATION);
        let rise = setting("rise", "s", self.rise, if is_blocked { quick } else { 0.0 });
        if is_blocked && rise.value == 0.0 {
            let reason = "a dashpot beside all else answers a sudden deformation with an infinite \
                          force; give the step a `rise` time";
            return Err(RheometerError::Impossible { protocol: Self::KIND, reason });
        }
        let end = end_of_test(self.end, rise.value, specimen)?;
        let history = History::step(height.value, rise.value, end.value);
        let trial = Trial::new(specimen, Drive::Deformation, history, self.points, methods);
        let looks = [
            ("force just after the step", Instant::after(rise.value)),
            ("force at the end", Instant::before(end.value)),
        ];
        let settings = vec![height, rise, end, points_used(self.points)];
        let mut report = trial.report(Self::KIND, settings, &looks);
        if rise.is_chosen && is_blocked {
            report.notes.push(Note::Rise(rise.value));
        }
        match specimen.linear() {
            Some(linear) if linear.kelvin().is_none() => report.notes.push(Note::NoForce),
            Some(linear) if linear.equilibrium_stiffness() == 0.0 => {
                report.notes.push(Note::RelaxesToNothing);
            }
            _ => {}
        }
        Ok(report)
    }
}

parameters! {
    /// A deformation that grows at a constant rate from the time 0 on: `F(t) = v (C + ∫ G dt)`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct ConstantRate: "constant-rate",
        "a deformation that grows at a constant rate; force over time"
    {
        /// deformation rate [m/s], positive in compression, not zero; else 1 mm in the whole test
        pub rate: Option<f64> = Quantity(Dimension::VELOCITY),
            default FROM_THE_MODEL, range NotZero;
        /// End of the test \[s\], positive; `None` for 10 times the slowest time of the model.
        pub end: Option<f64> => END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { rate: None, end: None, points: USUAL_POINTS }
}

impl ProtocolKind for ConstantRate {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        deforms(Self::KIND, specimen)?;
        let end = end_of_test(self.end, 0.0, specimen)?;
        let rate = setting("rate", "m/s", self.rate, USUAL_DEFORMATION / end.value);
        let history = History::ramp(rate.value, end.value);
        let trial = Trial::new(specimen, Drive::Deformation, history, self.points, methods);
        let looks = [
            ("force just after the start", Instant::after(0.0)),
            ("force at the end", Instant::before(end.value)),
        ];
        let settings = vec![rate, end, points_used(self.points)];
        let mut report = trial.report(Self::KIND, settings, &looks);
        if specimen.maxwell().is_some_and(|form| form.dashpot() > 0.0) {
            report.notes.push(Note::ForceJumps);
        }
        if specimen.linear().is_some_and(|linear| linear.kelvin().is_none()) {
            report.notes.push(Note::NoForce);
        }
        Ok(report)
    }
}
