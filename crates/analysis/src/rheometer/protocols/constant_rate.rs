//! Deformation at constant rate.

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
        pub end: Option<f64> => given::END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => given::POINTS;
    }
    default { rate: None, end: None, points: given::USUAL_POINTS }
}

impl ProtocolKind for ConstantRate {
    fn test(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<RheometerReport, RheometerError> {
        deforms(Self::KIND, specimen)?;
        let end = setting("end", "s", self.end, LONG * specimen.range_of_times().1);
        check_end(end.value, 0.0)?;
        let rate = setting("rate", "m/s", self.rate, given::USUAL_DEFORMATION / end.value);
        let history = History::ramp(rate.value, end.value);
        let trial = Trial::new(specimen, Control::Deformation, history, self.points, methods);
        let mut report = trial.report(Self::KIND, vec![rate, end, points_used(self.points)]);
        for (name, at) in [
            ("force just after the start", Instant::after(0.0)),
            ("force at the end", Instant::before(end.value)),
        ] {
            let figure = Figure::of(name, "N", trial.answer(at)).computed(trial.simulated(at));
            report.figures.push(figure);
        }
        if specimen.linear().maxwell().is_some_and(|form| form.dashpot() > 0.0) {
            report.notes.push(Note::ForceJumps);
        }
        if specimen.linear().kelvin().is_none() {
            report.notes.push(Note::NoForce);
        }
        Ok(report)
    }
}
