//! The contact force of scenes of one form over time, for any numbers: compiled once, and solved for each.

use std::cmp::Ordering;

use dashpot_dae::Signal;
use dashpot_network::{Instance, ParametricSystem};
use dashpot_numerics::{
    exponential::Powers,
    small::{apply, dot},
};

use super::{
    ScenePoint,
    plain::{MOST_STATES, stepped::Stepped},
    products::Products,
    scene_point::ScenePoint as Posed,
    sums::Recorder,
};

/// A step of a linear scene in units of the shortest time of its system; see the panels of [`Recorder`].
const STEP: f64 = 3.0;
/// A run has at least so many steps, and at most so many: beyond, it is not followed here.
const FEWEST: f64 = 16.0;
const MOST: f64 = 20_000.0;
/// The tolerance of scenes that are not linear, in parts of the unknowns.
const RTOL: f64 = 1e-9;

/// Poses a scene where parameters have these values in SI units, or says why there is none.
pub type PoseAt<'p> = dyn Fn(&[f64]) -> Result<ScenePoint, String> + Sync + 'p;

/// Scenes of one form, which one impactor strikes.
pub struct ContactForces<'p> {
    pose: &'p PoseAt<'p>,
    parametric: ParametricSystem,
    /// The numbers over the parameters, where they are products of their powers.
    products: Option<Products>,
    duration: f64,
}

/// A contact force over time, counted from the touch. Behind a release it is zero.
#[derive(Debug, Clone)]
pub struct ContactForce {
    force: Signal,
    /// Seconds in a unit of its time.
    unit: f64,
    /// When it ends, in that unit: the release, or the end of the run.
    end: f64,
    is_released: bool,
    /// Mass of the impactor and all that moves with it \[kg\].
    pub mass: f64,
}

impl ContactForce {
    /// The force at a time \[s, N\].
    pub fn value(&self, time: f64) -> f64 {
        let time = time / self.unit;
        match time.total_cmp(&self.end) {
            _ if time < 0.0 => 0.0,
            Ordering::Greater if self.is_released => 0.0,
            _ => self.force.value(time.min(self.end)),
        }
    }

    /// When it is largest \[s\], and how large it is then \[N\], with its sign.
    pub fn peak(&self) -> (f64, f64) {
        let peak = self.force.absolute_maximum((0.0, self.end));
        let sides = [self.force.left_value(peak.time), self.force.value(peak.time)];
        let signed = if sides[0].abs() > sides[1].abs() { sides[0] } else { sides[1] };
        (peak.time * self.unit, peak.value.copysign(signed))
    }
}

impl<'p> ContactForces<'p> {
    /// The form of the scene that is posed at a point within bounds; `None` where it is of another kind. Scenes that
    /// are not linear must open.
    pub fn of(pose: &'p PoseAt<'p>, at: &[f64], bounds: &[[f64; 2]]) -> Option<Self> {
        let first = pose(at).ok()?;
        let settings = &first.settings;
        let is_exact = matches!(settings.method.name(), "auto" | "exact");
        let is_plain = settings.stops.is_empty()
            && settings.accuracy.neglect_below.is_none()
            && !settings.is_duration_found;
        if !is_exact || !is_plain {
            return None;
        }
        let duration = settings.duration;
        let parametric = ParametricSystem::of(&first.network, duration)?;
        if parametric.states() > MOST_STATES || !parametric.is_linear() && !parametric.opens() {
            return None;
        }
        let read = |values: &[f64]| parametric.numbers(&pose(values).ok()?.network);
        let products = Products::of(at, bounds, &read);
        Some(Self { pose, parametric, products, duration })
    }

    /// Position among the connections of the element that is struck.
    pub fn element(&self) -> usize {
        self.parametric.element()
    }

    /// Position among the nodes of what strikes.
    pub fn impactor(&self) -> usize {
        self.parametric.impactor().index()
    }

    /// The force where the parameters have these values; `None` where the scene is of another form there, or its
    /// impact not of the plain kind.
    pub fn at(&self, values: &[f64]) -> Option<ContactForce> {
        let numbers = match &self.products {
            Some(own) => own.at(values),
            None => self.parametric.numbers(&(self.pose)(values).ok()?.network)?,
        };
        match self.parametric.states() {
            0..=2 => self.solved::<2>(&numbers),
            3..=4 => self.solved::<4>(&numbers),
            5..=6 => self.solved::<6>(&numbers),
            7..=8 => self.solved::<8>(&numbers),
            _ => self.solved::<MOST_STATES>(&numbers),
        }
    }

    fn solved<const N: usize>(&self, numbers: &[f64]) -> Option<ContactForce> {
        let parametric = &self.parametric;
        let mut instance: Instance<N> = parametric.instance()?;
        if !parametric.fill(numbers, &mut instance) {
            return None;
        }
        let (unit, mass) = (parametric.time_scale(), parametric.impactor_mass(numbers));
        let last = self.duration / unit;
        if !parametric.is_linear() {
            let stepped =
                Stepped { instance: &instance, unknowns: parametric.unknowns(), end: last };
            let own = stepped.follow(RTOL)?;
            let (force, end) = (own.force, own.release);
            return Some(ContactForce { force, unit, end, is_released: true, mass });
        }
        let force = self.carried(&instance, last)?;
        let release =
            parametric.opens().then(|| force.first_crossing(0.0, (0.0, last), Some(false)));
        let release = release.flatten().map(|own| own.time).filter(|own| *own > 0.0);
        let (end, is_released) = (release.unwrap_or(last), release.is_some());
        Some(ContactForce { force, unit, end, is_released, mass })
    }

    /// The force of a linear scene, up to the end of the step in which it lets go.
    fn carried<const N: usize>(&self, instance: &Instance<N>, last: f64) -> Option<Signal> {
        let powers = Powers::of(instance.matrix);
        let step = (STEP / powers.rate()).min(last / FEWEST);
        if !(step > 0.0 && last / step <= MOST) {
            return None;
        }
        let scene_point = Posed {
            matrix: &instance.matrix,
            start: &instance.start,
            force: &instance.force,
            deformation: &instance.deformation,
            end: last,
            opens: self.parametric.opens(),
        };
        let carry = powers.exponential(step);
        let mut recorder = Recorder::new(&scene_point, step);
        let (mut z, mut time) = (instance.start, 0.0);
        while time < last {
            recorder.add(&z, time);
            z = apply(&carry, &z);
            time += step;
            if self.parametric.opens() && dot(&instance.force, &z) <= 0.0 {
                break;
            }
        }
        Some(Signal::new(recorder.panels, None, 0.0))
    }
}
