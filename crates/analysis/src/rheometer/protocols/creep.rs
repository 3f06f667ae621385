//! Creep.

use dashpot_network::{parameters, parameters::Kind as _};

use super::{LONG, bears_force, notes_under_force};
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
    /// A force step that is held: `y(t) = F J(t)`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Creep: "creep", "a force step that is held; deformation over time" {
        /// The force \[N\], not zero.
        pub force: Option<f64> => given::FORCE;
        /// End of the test \[s\], positive; `None` for 10 times the slowest time of the model.
        pub end: Option<f64> => given::END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => given::POINTS;
    }
    default { force: None, end: None, points: given::USUAL_POINTS }
}

impl ProtocolKind for Creep {
    fn test(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<RheometerReport, RheometerError> {
        bears_force(Self::KIND, specimen)?;
        let force = setting("force", "N", self.force, given::USUAL_FORCE);
        let end = setting("end", "s", self.end, LONG * specimen.range_of_times().1);
        check_end(end.value, 0.0)?;
        let history = History::step(force.value, 0.0, end.value);
        let trial = Trial::new(specimen, Control::Force, history, self.points, methods);
        let mut report = trial.report(Self::KIND, vec![force, end, points_used(self.points)]);
        for (name, at) in [
            ("deformation at once", Instant::after(0.0)),
            ("deformation at the end", Instant::before(end.value)),
        ] {
            let figure = Figure::of(name, "m", trial.answer(at)).computed(trial.simulated(at));
            report.figures.push(figure);
        }
        let flow = specimen.linear().kelvin().map_or(0.0, |form| form.fluidity() * force.value);
        report.figures.push(Figure::of("rate of flow", "m/s", flow));
        report.notes = notes_under_force(specimen);
        Ok(report)
    }
}
