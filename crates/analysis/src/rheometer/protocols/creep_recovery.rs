//! Creep and recovery.

use dashpot_network::{parameters, parameters::Kind as _};

use super::{HELD, LONG, bears_force, notes_under_force};
use crate::{
    Choice,
    rheometer::{
        Figure, ProtocolKind, RheometerError, RheometerReport, Specimen,
        given::{self, check_end, points_used, setting},
        history::{History, Instant},
        simulation::Control,
        trial::Trial,
    },
};

parameters! {
    /// A force step that is held for a time and then taken away: `y(t) = F (J(t) − J(t − t_hold))`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct CreepRecovery: "creep-recovery",
        "a force step that is held, then taken away; deformation over time"
    {
        /// The force \[N\], not zero.
        pub force: Option<f64> => given::FORCE;
        /// How long it is held \[s\], positive; `None` for 5 times the slowest retardation time.
        pub hold: Option<f64> => given::HOLD;
        /// End of the test \[s\], after the hold; `None` for 10 times the slowest time of the model
        /// after it.
        pub end: Option<f64> => given::END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => given::POINTS;
    }
    default { force: None, hold: None, end: None, points: given::USUAL_POINTS }
}

impl ProtocolKind for CreepRecovery {
    fn test(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<RheometerReport, RheometerError> {
        bears_force(Self::KIND, specimen)?;
        let force = setting("force", "N", self.force, given::USUAL_FORCE);
        let hold = setting("hold", "s", self.hold, HELD * specimen.slowest_retardation());
        let chosen = hold.value + LONG * specimen.range_of_times().1;
        let end = setting("end", "s", self.end, chosen);
        check_end(end.value, hold.value)?;
        let history = History::pulse(force.value, 0.0, hold.value, end.value);
        let trial = Trial::new(specimen, Control::Force, history, self.points, methods);
        let settings = vec![force, hold, end, points_used(self.points)];
        let mut report = trial.report(Self::KIND, settings);
        for (name, at) in [
            ("deformation at the end of the hold", Instant::before(hold.value)),
            ("deformation just after", Instant::after(hold.value)),
            ("deformation at the end", Instant::before(end.value)),
        ] {
            let figure = Figure::of(name, "m", trial.answer(at)).computed(trial.simulated(at));
            report.figures.push(figure);
        }
        report.notes = notes_under_force(specimen);
        Ok(report)
    }
}
