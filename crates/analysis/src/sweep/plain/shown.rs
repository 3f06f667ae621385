//! What measures show of an impact, and how it is read off its steps.

use dashpot_network::{
    ParametricSystem,
    parameters::{Value, WindowWish},
};

use super::stepped::Course;
use crate::measures::{
    NO_APPROACH, STANDARD_GRAVITY, hic_search::optimum, powers::power_of, selection::Selected,
};

/// Which integrals are wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Wanted {
    /// `∫ F^n dt` with this exponent.
    pub(crate) power: Option<f64>,
    /// `∫ F dt` and `∫ F ẏ dt`.
    pub(crate) work: bool,
    /// `∫ F ẏ dt` up to the end of the run as well.
    pub(crate) work_at_end: bool,
    /// The force over time.
    pub(crate) course: bool,
}

/// What a measure shows of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shown {
    Force,
    Depth,
    Share,
    Acceleration,
    ContactTime,
    Restitution,
    Impulse,
    Work,
    WorkAtEnd,
    Severity,
    /// Over intervals of at most so many seconds.
    Hic(f64),
}

impl Shown {
    /// What the accuracy of a value is counted in parts of.
    pub(crate) fn size(self, value: f64) -> f64 {
        match self {
            Self::Restitution => 1.0,
            _ => value.abs(),
        }
    }
}

/// The figure that is a measure; `None` where it has to be read off the full solution.
pub(crate) fn shown_by(
    selected: &Selected,
    parametric: &ParametricSystem,
    wanted: &mut Wanted,
) -> Option<Shown> {
    let mut numbers = Vec::new();
    let general = selected.measure.general();
    let measure = general.as_ref().unwrap_or(&selected.measure);
    for value in measure.values() {
        match value {
            Value::Window(WindowWish::Impact) => {}
            Value::Number(number) => numbers.push(number),
            _ => return None,
        }
    }
    let target = match selected.measure.kind() {
        "peak-force"
        | "peak-deformation"
        | "peak-strain"
        | "contact-time"
        | "impulse"
        | "energy"
        | "energy-at-end"
        | "coefficient-of-restitution" => parametric.element(),
        _ => parametric.impactor().index(),
    };
    if selected.target != target {
        return None;
    }
    match (measure.kind(), numbers.as_slice()) {
        ("peak-force", []) => Some(Shown::Force),
        ("peak-deformation", []) => Some(Shown::Depth),
        ("peak-acceleration", []) => Some(Shown::Acceleration),
        ("contact-time", []) => Some(Shown::ContactTime),
        ("coefficient-of-restitution", []) => Some(Shown::Restitution),
        ("impulse", []) => {
            wanted.work = true;
            Some(Shown::Impulse)
        }
        ("energy", []) => {
            wanted.work = true;
            Some(Shown::Work)
        }
        ("energy-at-end", []) if parametric.is_linear() && !parametric.opens() => {
            wanted.work_at_end = true;
            Some(Shown::WorkAtEnd)
        }
        // Nothing acts on the pad behind an impact that parts for good.
        ("energy-at-end", []) if !parametric.is_linear() && parametric.opens() => {
            wanted.work = true;
            wanted.work_at_end = true;
            Some(Shown::WorkAtEnd)
        }
        ("peak-strain", []) => Some(Shown::Share),
        ("hic", &[cap]) => {
            wanted.course = true;
            Some(Shown::Hic(cap))
        }
        // Below one, a power is too steep where the force is zero.
        ("severity-index", &[exponent])
            if exponent >= 1.0
                && wanted.power.is_none_or(|power| power.to_bits() == exponent.to_bits()) =>
        {
            wanted.power = Some(exponent);
            Some(Shown::Severity)
        }
        _ => None,
    }
}

/// What the numbers of an impact, which is followed in a unit of time of its own, are made measures with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scales {
    /// Seconds in that unit.
    pub(crate) time: f64,
    /// The mass that strikes \[kg\].
    pub(crate) mass: f64,
    /// The thickness of what is struck \[m\]; not a number where it has none.
    pub(crate) thickness: f64,
    /// The exponent of the severity index.
    pub(crate) exponent: f64,
}

impl Scales {
    /// A measure of an impact, and what its error is a part of where forces and speeds are off by that part of theirs: an
    /// energy that is lost is a small difference of large ones.
    pub(crate) fn figure<const N: usize>(&self, shown: Shown, course: &Course<N>) -> [f64; 2] {
        let value = self.read(shown, course);
        let unit = match shown {
            Shown::Restitution => 1.0,
            Shown::Work | Shown::WorkAtEnd => course.strongest.value * course.deepest.value,
            Shown::Severity => self.exponent * value.abs(),
            Shown::Hic(_) => 2.5 * value.abs(),
            _ => value.abs(),
        };
        [value, unit]
    }

    /// A measure of an impact.
    fn read<const N: usize>(&self, shown: Shown, course: &Course<N>) -> f64 {
        let Self { time, thickness, exponent, .. } = *self;
        let unit = self.mass * STANDARD_GRAVITY;
        let Course { force, speed, release, strongest, deepest, .. } = course;
        let impact = (0.0, *release);
        match shown {
            Shown::Force => strongest.value,
            Shown::Depth => deepest.value,
            Shown::Share => deepest.value / thickness,
            Shown::Acceleration => strongest.value * STANDARD_GRAVITY / unit,
            Shown::ContactTime => release * time,
            Shown::Restitution => {
                let meeting = speed.value(0.0);
                let least = NO_APPROACH * speed.absolute_maximum(impact).value;
                if meeting.abs() > least { -speed.value(*release) / meeting } else { f64::NAN }
            }
            Shown::Impulse => force.integral(impact) * time,
            Shown::Work | Shown::WorkAtEnd => force.integral_of_product(speed, impact),
            Shown::Severity => power_of(force, *release, exponent) * time / unit.powf(exponent),
            Shown::Hic(cap) => optimum(force, impact, cap / time).value * time / unit.powf(2.5),
        }
    }
}
