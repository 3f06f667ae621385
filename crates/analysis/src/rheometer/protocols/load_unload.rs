//! Loading and unloading at given rates.

use dashpot_dae::Direction;
use dashpot_network::{parameters, parameters::Kind as _};
use dashpot_numerics::roots::monotone_root;

use super::{USUAL_DEFORMATION, USUAL_POINTS, deforms, points_used, setting};
use crate::{
    Choice, Column, Stop,
    rheometer::{
        Computation, FROM_THE_MODEL, Figure, Note, ProtocolKind, RheometerError, RheometerReport,
        Setting, Specimen, Tested,
        cycle::{Cycle, Loop, Simulated},
        history::{self, Drive, History, Instant},
        report::series,
        rig::{NAME, Rig},
        solved::solve,
        track::TOLERANCES,
    },
};

/// Where the search for a force begins \[m\], and up to where it goes.
const FIRST: f64 = 1e-3;
const FARTHEST: f64 = 1e3;
/// What each step of the search takes the deformation times.
const STEP: f64 = 2.0;

parameters! {
    /// A deformation at a constant rate, and back: the loop of force over deformation.
    ///
    /// | figure                 | law                                                              |
    /// |------------------------|------------------------------------------------------------------|
    /// | energy absorbed        | `∫ F dy` on the way out, what is taken up                        |
    /// | energy returned        | `∫ F dy` on the way back, until the force comes to zero          |
    /// | energy lost            | what is taken up less what is returned: the area of the loop     |
    /// | hysteresis ratio       | lost over taken up                                               |
    /// | residual deformation   | the deformation at which the force comes to zero                 |
    ///
    /// What is lost is what the parts dissipate until the force comes to zero, and what stays stored in
    /// springs that press against each other; both are read off the energy ledger. Any model is taken;
    /// of a linear one the figures are found in closed form as well.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct LoadUnload: "load-unload",
        "a deformation at a constant rate and back; force over deformation, energy lost"
    {
        /// how far [m], positive in compression, not zero; with `force` at most; else 1 mm, or as far as
        /// the force asks for
        pub deformation: Option<f64> = Quantity(Dimension::LENGTH),
            default FROM_THE_MODEL, range NotZero;
        /// force at which the motion turns [N], positive; else it turns at the deformation
        pub force: Option<f64> = Quantity(Dimension::FORCE), default FROM_THE_MODEL, range Positive;
        /// deformation rate [m/s], positive; else the deformation within the slowest time of the model, or within 1 s
        pub rate: Option<f64> = Quantity(Dimension::VELOCITY),
            default FROM_THE_MODEL, range Positive;
        /// deformation rate of the way back [m/s], positive; else that of the way out
        pub return_rate as "return-rate": Option<f64> = Quantity(Dimension::VELOCITY),
            default FROM_THE_MODEL, range Positive;
        /// number of points, from 2 to 100000, at equal distances
        pub points: usize = Quantity(Dimension::NUMBER), default "200", range Count;
    }
    default {
        deformation: None,
        force: None,
        rate: None,
        return_rate: None,
        points: USUAL_POINTS,
    }
}

impl ProtocolKind for LoadUnload {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        deforms(Self::KIND, specimen)?;
        let most = self.deformation.unwrap_or(USUAL_DEFORMATION);
        let chosen = most.abs() / specimen.range_of_times().1;
        let rate = setting("rate", "m/s", self.rate, chosen);
        let height = match self.force {
            None => most,
            Some(force) => self.turn_at(force, rate.value, specimen, methods)?,
        };
        let back = setting("return-rate", "m/s", self.return_rate, rate.value);
        let cycle = Cycle { height, rate: rate.value, back: back.value };
        let mut settings = vec![Setting {
            name: "deformation",
            unit: "m",
            value: height,
            is_chosen: self.deformation.is_none() || self.force.is_some(),
        }];
        settings.extend(self.force.map(|force| setting("force", "N", Some(force), force)));
        settings.extend([rate, back, points_used(self.points)]);
        Ok(self.report(specimen, cycle, methods, settings))
    }
}

impl LoadUnload {
    /// The deformation at which the force first reaches `force` \[N\] at this rate \[m/s\].
    fn turn_at(
        &self,
        force: f64,
        rate: f64,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<f64, RheometerError> {
        let way = self.deformation.unwrap_or(1.0).signum();
        let farthest = self.deformation.map_or(FARTHEST, f64::abs);
        let mut reach = FIRST.min(farthest);
        loop {
            if let Some(time) = reached(force, way * rate, reach / rate, specimen, methods)? {
                return Ok(way * rate * time);
            }
            if reach >= farthest {
                break;
            }
            reach = (STEP * reach).min(farthest);
        }
        match self.deformation {
            Some(deformation) => Ok(deformation),
            None => Err(RheometerError::ForceNotReached { force, deformation: farthest }),
        }
    }

    fn report(
        &self,
        specimen: &Specimen,
        cycle: Cycle,
        methods: &[Choice],
        settings: Vec<Setting>,
    ) -> RheometerReport {
        let history = cycle.history();
        let instants = cycle.instants(self.points);
        let times: Vec<f64> = instants.iter().map(|instant| instant.time).collect();
        let rig = Rig::new(specimen.model(), Drive::Deformation, &history);
        let simulate = |choice: &Choice| Simulated::new(&rig, choice, cycle, &instants);
        let simulated: Vec<Simulated> = methods.iter().map(simulate).collect();
        let closed = specimen.maxwell().map(|form| Loop::in_closed_form(form, cycle));
        let model = specimen.maxwell().map(|form| {
            instants.iter().map(|&at| history::force(form, &history, at)).collect::<Vec<f64>>()
        });
        let tracks = simulated.iter().map(|own| &own.track);
        let force = series("force", "N", &times, model.unwrap_or_default(), tracks);
        let computed = simulated.first().and_then(|own| own.found.as_ref());
        let mut figures = specimen.figures();
        figures.extend(Loop::figures(closed.as_ref(), computed));
        let is_sudden =
            closed.as_ref().or(computed).is_some_and(|own| own.gives_nothing_back(cycle));
        let reach = |own: &Simulated| own.found.is_some().then(|| history.end());
        let computation = |own: &Simulated| Computation {
            method: own.method,
            reach: reach(own),
            obstacle: own.obstacle.clone(),
        };
        RheometerReport {
            protocol: Self::KIND,
            settings,
            computations: simulated.iter().map(computation).collect(),
            drive: Some(Column {
                name: "deformation".to_owned(),
                unit: "m",
                values: instants.iter().map(|&at| history.value(at)).collect(),
            }),
            abscissa: Column { name: "time".to_owned(), unit: "s", values: times },
            series: vec![force],
            figures: Figure::settled(figures),
            notes: is_sudden.then_some(Note::NothingBack).into_iter().collect(),
        }
    }
}

/// The time \[s\] at which the force of a specimen that is deformed at a constant rate \[m/s\] reaches `force`
/// \[N\] in the direction of the motion; `None` where it does not until `end`.
fn reached(
    force: f64,
    rate: f64,
    end: f64,
    specimen: &Specimen,
    methods: &[Choice],
) -> Result<Option<f64>, RheometerError> {
    let history = History::ramp(rate, end);
    let level = force * rate.signum();
    if let Some(form) = specimen.maxwell() {
        let lacks = |time: f64| history::force(form, &history, Instant::after(time)).abs() - force;
        if lacks(0.0) >= 0.0 {
            let reason = "the force is reached as the motion begins: give a lower rate";
            return Err(RheometerError::Impossible { protocol: LoadUnload::KIND, reason });
        }
        return Ok(monotone_root(lacks, 0.0, end));
    }
    let rig = Rig::new(specimen.model(), Drive::Deformation, &history);
    let direction = if rate > 0.0 { Direction::Rising } else { Direction::Falling };
    let stop = Stop { output: format!("{NAME}.force"), level, direction };
    let choice = methods.first().cloned().unwrap_or_default();
    let [.., finest] = TOLERANCES;
    let solved = solve(&rig, &choice, (end, finest), vec![stop], true)
        .map_err(|obstacle| RheometerError::NoTurn { obstacle: Box::new(obstacle) })?;
    let time = solved.trajectory.t_end;
    Ok((time < end).then_some(time))
}
