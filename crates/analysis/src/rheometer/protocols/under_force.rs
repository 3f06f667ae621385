//! Forces that are put on, held, and taken away: creep, recovery, and figure 2 of the thesis.

use dashpot_network::{parameters, parameters::Kind as _};

use super::{
    END, FORCE, HELD, HOLD, POINTS, USUAL_FORCE, USUAL_POINTS, bears_force, end_of_test,
    notes_under_force, points_used, setting,
};
use crate::{
    Choice,
    rheometer::{
        Figure, ProtocolKind, RheometerReport, Specimen, Tested,
        cycle::ROUNDING,
        history::{Drive, History, Instant},
        trial::Trial,
    },
};

parameters! {
    /// A force step that is held: `y(t) = F J(t)`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Creep: "creep", "a force step that is held; deformation over time" {
        /// The force \[N\], not zero.
        pub force: Option<f64> => FORCE;
        /// End of the test \[s\], positive; `None` for 10 times the slowest time of the model.
        pub end: Option<f64> => END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { force: None, end: None, points: USUAL_POINTS }
}

impl ProtocolKind for Creep {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        bears_force(Self::KIND, specimen)?;
        let force = setting("force", "N", self.force, USUAL_FORCE);
        let end = end_of_test(self.end, 0.0, specimen)?;
        let history = History::step(force.value, 0.0, end.value);
        let trial = Trial::new(specimen, Drive::Force, history, self.points, methods);
        let looks = [
            ("deformation at once", Instant::after(0.0)),
            ("deformation at the end", Instant::before(end.value)),
        ];
        let settings = vec![force, end, points_used(self.points)];
        let mut report = trial.report(Self::KIND, settings, &looks);
        if specimen.linear().is_some() {
            let flow = specimen.kelvin().map_or(0.0, |form| form.fluidity() * force.value);
            report.figures.push(Figure::of("rate of flow", "m/s", flow));
        }
        report.notes = notes_under_force(specimen);
        Ok(report)
    }
}

parameters! {
    /// A force step that is held for a time and then taken away: `y(t) = F (J(t) − J(t − t_hold))`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct CreepRecovery: "creep-recovery",
        "a force step that is held, then taken away; deformation over time"
    {
        /// The force \[N\], not zero.
        pub force: Option<f64> => FORCE;
        /// How long it is held \[s\], positive; `None` for 5 times the slowest retardation time.
        pub hold: Option<f64> => HOLD;
        /// End of the test \[s\], after the hold; `None` for 10 times the slowest time of the model after it.
        pub end: Option<f64> => END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { force: None, hold: None, end: None, points: USUAL_POINTS }
}

impl ProtocolKind for CreepRecovery {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        bears_force(Self::KIND, specimen)?;
        let force = setting("force", "N", self.force, USUAL_FORCE);
        let hold = setting("hold", "s", self.hold, HELD * specimen.slowest_retardation());
        let end = end_of_test(self.end, hold.value, specimen)?;
        let history = History::pulse(force.value, 0.0, hold.value, end.value);
        let trial = Trial::new(specimen, Drive::Force, history, self.points, methods);
        let looks = [
            ("deformation at the end of the hold", Instant::before(hold.value)),
            ("deformation just after", Instant::after(hold.value)),
            ("deformation at the end", Instant::before(end.value)),
        ];
        let settings = vec![force, hold, end, points_used(self.points)];
        let notes = notes_under_force(specimen);
        Ok(RheometerReport { notes, ..trial.report(Self::KIND, settings, &looks) })
    }
}

parameters! {
    /// A force that is put on, held and taken away, with the parts of the deformation apart (figure 2 of the thesis).
    ///
    /// The parts are those of the model's Kelvin form, whatever form it was given in:
    ///
    /// | part            | thesis | law                              | after unloading     |
    /// |-----------------|--------|----------------------------------|---------------------|
    /// | `instantaneous` | `ε₂`   | `J_g F`                          | comes back at once  |
    /// | `delayed`       | `ε₁`   | `ε̇ + z ε = φ F` for each element | comes back late     |
    /// | `viscous`       | `ε₃`   | `ε̇ = φ₀ F`                       | stays               |
    ///
    /// The deformation is simulated with the model as it was given, the parts with its Kelvin form. A model
    /// that is not linear has no such parts: of it the deformation alone is told.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct LoadHoldUnload: "load-hold-unload",
        "a force put on, held and taken away; what of the deformation comes back at once, late, and not at all"
    {
        /// The force \[N\], not zero.
        pub force: Option<f64> => FORCE;
        /// how long loading and unloading take [s], zero or positive
        pub rise: f64 = Quantity(Dimension::TIME), default "0 s", range NonNegative;
        /// How long it is held in between \[s\], positive; `None` for 5 times the slowest retardation time.
        pub hold: Option<f64> => HOLD;
        /// End of the test \[s\], after unloading; `None` for 10 times the slowest time of the model after it.
        pub end: Option<f64> => END;
        /// About how many instants are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { force: None, rise: 0.0, hold: None, end: None, points: USUAL_POINTS }
}

impl ProtocolKind for LoadHoldUnload {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        bears_force(Self::KIND, specimen)?;
        let force = setting("force", "N", self.force, USUAL_FORCE);
        let rise = setting("rise", "s", Some(self.rise), 0.0);
        let hold = setting("hold", "s", self.hold, HELD * specimen.slowest_retardation());
        let held = rise.value + hold.value;
        let unloaded = if rise.value > 0.0 { held + rise.value } else { held };
        let end = end_of_test(self.end, unloaded, specimen)?;
        let history = History::pulse(force.value, rise.value, hold.value, end.value);
        let trial = Trial::new(specimen, Drive::Force, history, self.points, methods);
        let settings = vec![force, rise, hold, end, points_used(self.points)];
        let [held, unloaded, end] =
            [Instant::before(held), Instant::after(unloaded), Instant::before(end.value)];
        if specimen.linear().is_none() {
            let looks = [
                ("deformation at the end of the hold", held),
                ("deformation just after unloading", unloaded),
                ("left at the end", end),
            ];
            return Ok(trial.report(Self::KIND, settings, &looks));
        }
        let mut report = trial.report(Self::KIND, settings, &[]);
        report.series.extend(trial.series_of_parts());
        report.figures.extend(Self::figures(&trial, &report, [held, unloaded, end]));
        report.notes = notes_under_force(specimen);
        Ok(report)
    }
}

impl LoadHoldUnload {
    /// The parts at the end of the hold, and what becomes of them.
    fn figures(
        trial: &Trial<'_>,
        report: &RheometerReport,
        [held, unloaded, end]: [Instant; 3],
    ) -> Vec<Figure> {
        let (under, after, last) = (trial.parts(held), trial.parts(unloaded), trial.parts(end));
        let part = |name: &'static str, series: &str, value: f64| {
            let computed = trial.row(held).and_then(|row| {
                report.series(series)?.computed.first()?.values.get(row).copied().flatten()
            });
            Figure::of(name, "m", value).computed(computed)
        };
        let less = |one: Instant, other: Instant| {
            trial.simulated(one).zip(trial.simulated(other)).map(|(one, other)| back(one, other))
        };
        let back_at_once = back(under.instantaneous, after.instantaneous)
            + back(under.delayed, after.delayed)
            + back(under.viscous, after.viscous);
        let back_late = back(after.instantaneous, last.instantaneous)
            + back(after.delayed, last.delayed)
            + back(after.viscous, last.viscous);
        vec![
            part(
                "ε2, instantaneous part at the end of the hold",
                "instantaneous",
                under.instantaneous,
            ),
            part("ε1, delayed part at the end of the hold", "delayed", under.delayed),
            part("ε3, viscous part at the end of the hold", "viscous", under.viscous),
            Figure::of("deformation at the end of the hold", "m", under.total())
                .computed(trial.simulated(held)),
            Figure::of("comes back while unloading", "m", back_at_once)
                .computed(less(held, unloaded)),
            Figure::of("comes back late, until the end", "m", back_late)
                .computed(less(unloaded, end)),
            Figure::of("left at the end", "m", last.total()).computed(trial.simulated(end)),
            Figure::of("stays for good", "m", last.viscous),
        ]
    }
}

/// What of a deformation comes back until another one; no more than their rounding is nothing.
fn back(from: f64, to: f64) -> f64 {
    let back = from - to;
    if back.abs() <= ROUNDING * from.abs() { 0.0 } else { back }
}
