//! What solves the scene of a test for given numbers: contact forces of one compiled form where that agrees with full
//! runs, else full runs.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

use dashpot_analysis::{
    Solve as _,
    sweep::{ContactForce, ContactForces, PoseAt, ScenePoint},
};
use dashpot_fit::network::Curve;
use dashpot_plot::Of;
use dashpot_scene::{NamedModel, Posed, Tunables, read_named_model};

use super::among::Replaced;
use crate::{
    input::Input,
    output::list,
    varied::{Varied, messages, point, posed},
    verbs::run::{beside::Output, recorded::Recorded},
};

/// Tolerance of runs by stepping methods.
pub(super) const RTOL: f64 = 1e-9;
/// Runs that are kept for each test, because they are asked for again.
const KEPT: usize = 4;
/// Forces of one form may differ from full runs by this part of the peak.
const ALIKE: f64 = 1e-6;
/// Places at which they are compared.
const LOOKS: usize = 200;

/// Why a scene cannot be solved, in words.
type Solved<T> = Result<T, String>;

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
    /// The text of the scene where the numbers have these values in SI units.
    fn text(&self, values: &[f64]) -> Solved<String> {
        let each = || self.numbers.iter().zip(values);
        let texts = each().filter_map(|(own, value)| Some((own.at?, own.exact(*value))));
        let text = self.tunables.text_with(&list(texts));
        let Some(replaced) = self.replaced else { return Ok(text) };
        let constants = each().filter(|own| own.0.at.is_none()).map(|own| *own.1);
        replaced.text(&text, &list(constants), "").map_err(|own| own.to_string())
    }

    /// The scene there.
    pub(super) fn posed(&self, values: &[f64]) -> Solved<Posed> {
        posed(&self.text(values)?, self.input, &self.set)
    }

    /// One of its models there.
    pub(super) fn model(&self, name: &str, values: &[f64]) -> Solved<NamedModel> {
        let model = read_named_model(&self.text(values)?, name, &self.input.options(&self.set));
        model.map(|own| own.value).map_err(|own| messages(&own))
    }

    /// The same with what is asked of a run of which differences are taken.
    pub(super) fn point(&self, values: &[f64]) -> Solved<ScenePoint> {
        let mut point = point(self.posed(values)?, None)?;
        point.settings.estimate = false;
        // Differences of runs are taken, which exact ones bear anyhow.
        point.settings.rtol = point.settings.rtol.or(Some(RTOL));
        Ok(point)
    }
}

/// A run for these numbers.
type Kept = (Vec<f64>, Arc<Recorded>);

/// What solves the scene of a test.
pub(super) struct Solver<'s> {
    poser: &'s Poser<'s>,
    output: &'s Output,
    forces: Option<ContactForces<'s>>,
    /// Whether the forces were found to be those of full runs.
    is_fast: AtomicBool,
    /// The last full runs.
    kept: Mutex<Vec<Kept>>,
}

impl<'s> Solver<'s> {
    /// For an output of a scene; its form is taken at a point within bounds, where full runs must agree with it.
    pub(super) fn new(
        poser: &'s Poser<'s>,
        point: &'s PoseAt<'s>,
        output: &'s Output,
        at: &[f64],
        bounds: &[[f64; 2]],
    ) -> Self {
        let forces = ContactForces::of(point, at, bounds).filter(|own| {
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
        let kept = Mutex::default();
        let own = Self { poser, output, forces, is_fast: AtomicBool::new(true), kept };
        own.agrees(at);
        own
    }

    /// Whether forces of one form are those of a full run where the numbers have these values; from where they are not
    /// full runs alone are solved.
    pub(super) fn agrees(&self, values: &[f64]) -> bool {
        let Some(fast) = self.fast(values) else { return true };
        let is_alike = self.full(values).is_ok_and(|full| {
            let (end, peak) = (full.0.end - full.0.zero, full.peak().1.abs());
            (0..=LOOKS).all(|at| {
                let time = end * at as f64 / LOOKS as f64;
                (fast.value(time) - full.value(time)).abs() <= ALIKE * peak
            })
        });
        if !is_alike {
            self.is_fast.store(false, Ordering::Relaxed);
        }
        is_alike
    }

    fn fast(&self, values: &[f64]) -> Option<Pushed> {
        let forces = self.forces.as_ref().filter(|_| self.is_fast.load(Ordering::Relaxed))?;
        let force = forces.at(values)?;
        let unit = if self.output.of == Of::Acceleration { force.mass } else { 1.0 };
        Some(Pushed { force, unit })
    }

    /// The curve of the test where the numbers have these values.
    pub(super) fn curve(&self, values: &[f64]) -> Solved<Box<dyn Curve>> {
        match self.fast(values) {
            Some(own) => Ok(Box::new(own)),
            None => Ok(Box::new(self.full(values)?)),
        }
    }

    fn full(&self, values: &[f64]) -> Solved<Shared> {
        let is_it = |own: &&Kept| {
            own.0.iter().zip(values).all(|(one, other)| one.to_bits() == other.to_bits())
        };
        let kept = || self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(own) = kept().iter().find(is_it) {
            return Ok(Shared(Arc::clone(&own.1)));
        }
        let ScenePoint { network, mut settings } = self.poser.point(values)?;
        settings.measures.clear();
        settings.limits.clear();
        let run = network.solve_with(&settings).map_err(|error| error.to_string())?;
        let lacks = || format!("`{}` is not kept in this run", self.output.key());
        let own = Arc::new(Recorded::of(&run, self.output).ok_or_else(lacks)?);
        let mut kept = kept();
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((values.to_vec(), Arc::clone(&own)));
        Ok(Shared(own))
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

/// A record that is asked for again.
struct Shared(Arc<Recorded>);

impl Curve for Shared {
    fn value(&self, time: f64) -> f64 {
        self.0.value(time)
    }

    fn peak(&self) -> (f64, f64) {
        let Recorded { signal, zero, end, .. } = &*self.0;
        let peak = signal.absolute_maximum((0.0, *end));
        let sides = [signal.left_value(peak.time), signal.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time - zero, peak.value.copysign(signed))
    }
}
