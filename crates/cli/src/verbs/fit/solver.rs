//! What solves the scene of a test for given numbers: contact forces of one compiled form, or single signals, where those
//! agree with runs that are judged, else those.

use std::sync::{
    Arc,
    atomic::{AtomicU8, Ordering},
};

use dashpot_analysis::{
    RunError, Solve as _, solve_signals,
    sweep::{ContactForce, ContactForces, PoseAt, ScenePoint},
};
use dashpot_dae::Silent;
use dashpot_fit::network::Curve;
use dashpot_network::Model;
use dashpot_plot::Of;
use dashpot_scene::{Posed, Tunables};

use super::{among::Replaced, target::Compared};
use crate::input::AsCommanded as _;
use crate::{
    input::Input,
    output::list,
    varied::{Varied, messages, point, posed},
    verbs::run::recorded::Recorded,
};

/// Tolerance of runs by stepping methods: slopes are differences over 4e-4 of a number, which it makes good to a few
/// millionths of a peak. That is more than steps of a search or intervals need, and what exact records leave.
pub(super) const RTOL: f64 = 1e-9;
/// What is solved in a quicker way may differ by this part of the peak.
const ALIKE: f64 = 1e-6;
/// Places at which they are compared.
const LOOKS: usize = 200;

/// Why a scene cannot be solved, in words.
type Solved<T> = Result<T, String>;
/// What stands in a scene, and the scene where it is another one.
type Written = (Vec<(usize, String)>, Option<Tunables>);

/// A scene whose numbers are written into its text.
pub(super) struct Poser<'s> {
    pub(super) input: &'s Input,
    pub(super) tunables: &'s Tunables,
    /// The numbers that are written, in the order of their values.
    pub(super) numbers: Vec<&'s Varied>,
    /// A form in the place of a model, by its constants among the numbers.
    pub(super) replaced: Option<&'s Replaced>,
    /// What is set besides.
    pub(super) set: Vec<(String, String)>,
}

impl Poser<'_> {
    /// What stands in the scene where the numbers have these values in SI units; its text, where a model in it is
    /// another one.
    fn written(&self, values: &[f64]) -> Solved<Written> {
        let each = || self.numbers.iter().zip(values);
        let texts = each().filter_map(|(own, value)| Some((own.at?, own.exact(*value))));
        let texts = list(texts);
        let Some(replaced) = self.replaced else { return Ok((texts, None)) };
        let constants = each().filter(|own| own.0.at.is_none()).map(|own| *own.1);
        let text = replaced.text(&self.tunables.text_with(&texts), &list(constants), "");
        let text = text.map_err(|own| own.to_string())?;
        let other = Tunables::of(&text, Some(&self.input.file)).map_err(|own| messages(&own))?;
        Ok((Vec::new(), Some(other)))
    }

    /// The scene there.
    pub(super) fn posed(&self, values: &[f64]) -> Solved<Posed> {
        let (values, other) = self.written(values)?;
        posed((other.as_ref().unwrap_or(self.tunables), &values), self.input, &self.set)
    }

    /// One of its models there, and whether it is a material.
    pub(super) fn model(&self, name: &str, values: &[f64]) -> Solved<(Model, bool)> {
        let (values, other) = self.written(values)?;
        let tunables = other.as_ref().unwrap_or(self.tunables);
        let model = tunables.model(&values, name, &self.input.options(&self.set));
        model.map_err(|own| messages(&own))
    }

    /// The same with what is asked of a run of which differences are taken.
    pub(super) fn point(&self, values: &[f64]) -> Solved<ScenePoint> {
        let mut point = point(self.posed(values)?, None)?;
        point.settings.estimate = false;
        point.settings.accuracy.neglect_below = None;
        // Differences of runs are taken, which exact ones bear anyhow.
        point.settings.rtol = point.settings.rtol.or(Some(RTOL));
        Ok(point)
    }
}

/// Ways to the curve of a test: contact forces of one form, solutions of which the one signal is read, and those that are
/// judged by their energy.
const FORMS: u8 = 0;
const SIGNALS: u8 = 1;
const JUDGED: u8 = 2;

/// What solves the scene of a test.
pub(super) struct Solver<'s> {
    poser: &'s Poser<'s>,
    of: &'s Compared,
    forces: Option<ContactForces<'s>>,
    /// The quickest way that was not found to differ from those that are judged.
    way: AtomicU8,
}

impl<'s> Solver<'s> {
    /// For what a test is compared with; a form is taken at a point within bounds, where what is judged must agree with it.
    pub(super) fn new(
        poser: &'s Poser<'s>,
        point: &'s PoseAt<'s>,
        of: &'s Compared,
        at: &[f64],
        bounds: &[[f64; 2]],
    ) -> Self {
        let output = if let Compared::Output(own) = of { Some(own) } else { None };
        let forces = output.and_then(|_| ContactForces::of(point, at, bounds));
        let forces = forces.zip(output).filter(|(own, output)| {
            let network = point(at).map(|own| own.network);
            network.is_ok_and(|network| match output.of {
                Of::Force => network.connections()[own.element()].name == output.name(),
                Of::Acceleration => network
                    .nodes()
                    .nth(own.impactor())
                    .is_some_and(|own| own.1.name == output.name()),
                _ => false,
            })
        });
        let way = AtomicU8::new(if forces.is_some() { FORMS } else { SIGNALS });
        let own = Self { poser, of, forces: forces.map(|own| own.0), way };
        if own.forces.is_some() {
            own.agrees(at);
        }
        own
    }

    /// Whether what is solved where the numbers have these values is what one that is judged is; from where it is not, a
    /// slower way is gone.
    pub(super) fn agrees(&self, values: &[f64]) -> bool {
        let way = self.way.load(Ordering::Relaxed);
        if way == JUDGED {
            return true;
        }
        let judged = self.by(JUDGED, values);
        let is_alike = |way: &u8| {
            let both = self.by(*way, values).ok().zip(judged.as_ref().ok());
            both.is_some_and(|((own, _), (judged, (from, to)))| {
                let peak = judged.peak().1.abs();
                (0..=LOOKS).all(|at| {
                    let time = from + (to - from) * at as f64 / LOOKS as f64;
                    (own.value(time) - judged.value(time)).abs() <= ALIKE * peak
                })
            })
        };
        let alike = (way..JUDGED).find(is_alike).unwrap_or(JUDGED);
        self.way.store(alike, Ordering::Relaxed);
        alike == way
    }

    /// The curve of the test where the numbers have these values.
    pub(super) fn curve(&self, values: &[f64]) -> Solved<Box<dyn Curve>> {
        Ok(self.by(self.way.load(Ordering::Relaxed), values)?.0)
    }

    /// The same in one of the ways, and between which times it is known.
    fn by(&self, way: u8, values: &[f64]) -> Solved<(Box<dyn Curve>, (f64, f64))> {
        let output = match self.of {
            Compared::Alone(own) => {
                let curve = own.curve(self.poser, values, way == JUDGED)?;
                return Ok((curve, own.span()));
            }
            Compared::Output(own) => own,
        };
        let force = self.forces.as_ref().filter(|_| way == FORMS).and_then(|own| own.at(values));
        if let Some(force) = force {
            let unit = if output.of == Of::Acceleration { force.mass } else { 1.0 };
            return Ok((Box::new(Pushed { force, unit }), (0.0, 0.0)));
        }
        let ScenePoint { network, mut settings } = self.poser.point(values)?;
        settings.measures.clear();
        settings.limits.clear();
        let words = |error: RunError| error.to_string();
        let recorded = if way == JUDGED {
            Recorded::of(&network.solve_with(&settings).map_err(words)?, output)
        } else {
            let assembly = network.compile(settings.duration).map_err(|own| words(own.into()))?;
            let place = output.place(&assembly).map(|own| own.0);
            let run = solve_signals(&Arc::new(assembly), &settings, place, &mut Silent);
            Recorded::of_signals(&run.map_err(words)?, output)
        };
        let own = recorded.ok_or_else(|| format!("`{}` is not kept in this run", output.key()))?;
        let end = own.end - own.zero;
        Ok((Box::new(own), (0.0, end)))
    }
}

/// A contact force, or the acceleration that it gives.
struct Pushed {
    force: ContactForce,
    unit: f64,
}

impl Curve for Pushed {
    fn value(&self, time: f64) -> f64 {
        self.force.value(time) / self.unit
    }

    fn peak(&self) -> (f64, f64) {
        let (time, force) = self.force.peak();
        (time, force / self.unit)
    }
}

impl Curve for Recorded {
    fn value(&self, time: f64) -> f64 {
        self.value(time)
    }

    fn peak(&self) -> (f64, f64) {
        let peak = self.signal.absolute_maximum((0.0, self.end));
        let sides = [self.signal.left_value(peak.time), self.signal.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time - self.zero, peak.value.copysign(signed))
    }
}
