//! Points of a sweep that are solved by instantiating: one compiled form, other numbers.

use dashpot_network::{
    ConnectionOutputs, Instance, ParametricSystem,
    parameters::{Value, WindowWish},
};

use super::{
    Column, Estimates, Grid, Pose, ScenePoint as Scene,
    report::Notice,
    scene_point::{Figure, Impact, ScenePoint, Wanted},
    stepped::{Course, Stepped},
    sums::power_of,
    table::{Besides, Table},
};
use crate::{
    Compression,
    measures::{
        STANDARD_GRAVITY,
        hic_search::optimum,
        selection::{Selected, select},
    },
    report::compression::is_as_thick,
};

/// A value of a linear scene that is less certain than this part of itself is left to the full solution.
const LOOSEST: f64 = 1e-6;
/// Tolerances of scenes that are not linear, in parts of the accuracy that is wanted.
const TOLERANCES: [f64; 3] = [1e-2, 1e-4, 1e-6];
/// The finest of them.
const FINEST: f64 = 1e-13;
/// What is doubted of each value, in parts of the largest relative difference of two solutions: one of them may
/// agree by chance.
const DOUBT: f64 = 0.1;
/// What rounding leaves, in parts of a value.
const ROUNDING: f64 = 1e-12;

/// What a column shows of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shown {
    Force,
    Depth,
    Share,
    Acceleration,
    ContactTime,
    Impulse,
    Work,
    WorkAtEnd,
    Severity,
    /// Over intervals of at most so many seconds.
    Hic(f64),
}

/// How the points of a sweep are solved by instantiating.
#[derive(Debug)]
pub(super) struct Plan<'g> {
    grid: &'g Grid,
    parametric: ParametricSystem,
    /// The element that is struck.
    element: String,
    table: Table,
    shown: Vec<Shown>,
    /// For each column the part of a value that it may be off by.
    wishes: Vec<f64>,
    wanted: Wanted,
    /// Whether the errors of scenes that are not linear are estimated.
    has_errors: bool,
    duration: f64,
}

impl<'g> Plan<'g> {
    /// A plan, where the scene at the first point and the columns allow one.
    pub(super) fn of(
        grid: &'g Grid,
        pose: &Pose<'_>,
        first: &Scene,
        columns: &[Column],
        estimates: Estimates,
    ) -> Option<Self> {
        let settings = &first.settings;
        if settings.is_duration_found {
            return None;
        }
        let is_exact = matches!(settings.method.name(), "auto" | "exact");
        if !is_exact || !settings.stops.is_empty() || settings.accuracy.neglect_below.is_some() {
            return None;
        }
        let duration = settings.duration;
        let parametric = ParametricSystem::of(&first.network, duration)?;
        if parametric.states() > MOST_STATES {
            return None;
        }
        let struck = parametric.element();
        let assembly = first
            .network
            .compile(duration)
            .ok()
            .filter(|own| own.warnings.is_empty() && own.held.is_empty())?;
        // Another padding would have to be watched as well.
        let is_other = |(at, own): (usize, &ConnectionOutputs)| {
            at != struck && !(own.segments.is_empty() && own.thickness.is_none())
        };
        if assembly.connections.iter().enumerate().any(is_other) {
            return None;
        }
        let selected = select(&assembly, &settings.measures, &settings.limits).ok()?;
        let mut wanted = Wanted::default();
        let mut shown = Vec::with_capacity(columns.len());
        for column in columns {
            let own = selected.iter().find(|own| own.key == column.key)?;
            let own = shown_by(own, &parametric, &mut wanted)?;
            shown.push(if column.is_share { Shown::Share } else { own });
        }
        let wishes = columns.iter().map(|column| settings.accuracy.of(&column.key)).collect();
        let has_errors = estimates != Estimates::Off;
        let table = Table::of(&parametric, grid, pose, duration)?;
        let element = first.network.connections()[struck].name.clone();
        Some(Self { grid, parametric, element, table, shown, wishes, wanted, has_errors, duration })
    }

    /// The element that is struck.
    pub(super) fn element(&self) -> &str {
        &self.element
    }

    /// Whether the numbers at a point are those of its network.
    pub(super) fn agrees(&self, point: usize, scene: &Scene) -> bool {
        let mut places = vec![0; self.grid.counts().len()];
        self.grid.locate(point, &mut places);
        self.table.agrees(&self.parametric, &places, &scene.network)
    }

    /// What solves points; one for each thread.
    pub(super) fn stamper(&self) -> Option<Box<dyn Stamper + '_>> {
        match self.parametric.states() {
            0..=2 => self.sized::<2>(),
            3..=4 => self.sized::<4>(),
            5..=6 => self.sized::<6>(),
            7..=8 => self.sized::<8>(),
            9..=10 => self.sized::<10>(),
            11..=MOST_STATES => self.sized::<MOST_STATES>(),
            _ => None,
        }
    }

    fn sized<const N: usize>(&self) -> Option<Box<dyn Stamper + '_>> {
        Some(Box::new(Sized {
            plan: self,
            instance: self.parametric.instance::<N>()?,
            places: vec![0; self.grid.counts().len()],
            numbers: vec![0.0; self.table.len()],
        }))
    }

    /// What is to be said of an impact whose largest deformation \[m\], with its error, is reached so long \[s\]
    /// after the touch, and whose force falls through zero so long after it.
    fn notice(&self, (depth, deepest): (Figure, f64), release: f64, numbers: &[f64]) -> Notice {
        let Besides { thickness, fall, .. } = Besides::of(numbers);
        let is_glued = !self.parametric.opens();
        let [deepest, release] = [deepest, release].map(|own| fall + own);
        let compression = Compression::new([depth.value, deepest], Some(depth.error), thickness);
        Notice {
            pulls: (is_glued && release < self.duration).then_some(release),
            pressed: Some(compression).filter(Compression::is_through),
        }
    }

    /// How long a run with these numbers goes on after the touch, dimensionless.
    fn end(&self, numbers: &[f64]) -> f64 {
        (self.duration - Besides::of(numbers).fall) / self.parametric.time_scale()
    }

    fn figure(&self, shown: Shown, impact: &Impact, numbers: &[f64]) -> Figure {
        let time = self.parametric.time_scale();
        let mass = self.parametric.impactor_mass(numbers);
        let thickness = Besides::of(numbers).thickness;
        let times = |own: Figure, factor: f64| Figure {
            value: own.value * factor,
            error: own.error * factor,
        };
        match shown {
            Shown::Force => impact.force,
            Shown::Depth => impact.depth,
            Shown::Share => times(impact.depth, thickness.recip()),
            Shown::Acceleration => times(impact.force, mass.recip()),
            Shown::ContactTime => times(impact.release, time),
            Shown::Impulse => times(impact.impulse, time),
            Shown::Work => impact.work,
            Shown::WorkAtEnd => impact.work_at_end,
            Shown::Severity => {
                let exponent = self.wanted.power.unwrap_or(1.0);
                times(impact.power, time / (mass * STANDARD_GRAVITY).powf(exponent))
            }
            Shown::Hic(cap) => {
                let Some(force) = &impact.course else { return Figure::UNKNOWN };
                let unit = mass * STANDARD_GRAVITY;
                let found = optimum(force, (0.0, impact.release.value), cap / time);
                let length = found.interval.1 - found.interval.0;
                let growth = 2.5 * (found.value / length).powf(0.6) * length;
                let error = growth * impact.force.error + found.threshold;
                times(Figure { value: found.value, error }, time / unit.powf(2.5))
            }
        }
    }

    /// The same of a solution in steps.
    fn read(&self, shown: Shown, course: &Course, numbers: &[f64]) -> f64 {
        let time = self.parametric.time_scale();
        let unit = self.parametric.impactor_mass(numbers) * STANDARD_GRAVITY;
        let thickness = Besides::of(numbers).thickness;
        let Course { force, depth, speed, release } = course;
        let impact = (0.0, *release);
        match shown {
            Shown::Force => force.maximum(impact).value,
            Shown::Depth => depth.maximum(impact).value,
            Shown::Share => depth.maximum(impact).value / thickness,
            Shown::Acceleration => force.maximum(impact).value * STANDARD_GRAVITY / unit,
            Shown::ContactTime => release * time,
            Shown::Impulse => force.integral(impact) * time,
            Shown::Work => force.integral_of_product(speed, impact),
            Shown::WorkAtEnd => f64::NAN,
            Shown::Severity => {
                let exponent = self.wanted.power.unwrap_or(1.0);
                power_of(force, *release, exponent) * time / unit.powf(exponent)
            }
            Shown::Hic(cap) => optimum(force, impact, cap / time).value * time / unit.powf(2.5),
        }
    }

    /// What is looked at over the steps of a scene that is not linear.
    fn seen(&self, course: &Course, numbers: &[f64]) -> Vec<f64> {
        self.shown.iter().map(|&shown| self.read(shown, course, numbers)).collect()
    }
}

/// The largest number of unknowns that are instantiated.
const MOST_STATES: usize = 12;

/// The figure that is a measure; `None` where it has to be read off the full solution.
fn shown_by(
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
        "peak-force" | "peak-deformation" | "peak-strain" | "contact-time" | "impulse"
        | "energy" | "energy-at-end" => parametric.element(),
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
        ("impulse", []) => {
            wanted.work = true;
            Some(Shown::Impulse)
        }
        ("energy", []) => {
            wanted.work = true;
            Some(Shown::Work)
        }
        // What happens after the impact is another story where it parts, or is not linear.
        ("energy-at-end", []) if parametric.is_linear() && !parametric.opens() => {
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

/// Solves points, one after the other.
pub(super) trait Stamper {
    /// Writes the columns of a point and their errors, and returns what is to be said of it. `None` where
    /// the point has to be solved in full: it is of another form, or its impact is not of the plain kind,
    /// or not certain enough. Nothing is allocated.
    fn write(&mut self, point: usize, values: &mut [f64], errors: &mut [f64]) -> Option<Notice>;
}

struct Sized<'p, const N: usize> {
    plan: &'p Plan<'p>,
    instance: Instance<N>,
    places: Vec<usize>,
    numbers: Vec<f64>,
}

impl<const N: usize> Stamper for Sized<'_, N> {
    fn write(&mut self, point: usize, values: &mut [f64], errors: &mut [f64]) -> Option<Notice> {
        let plan = self.plan;
        plan.grid.locate(point, &mut self.places);
        let is_known = plan.table.write(&self.places, &mut self.numbers)
            && !self.has_thinner_part()
            && plan.parametric.fill(&self.numbers, &mut self.instance);
        if !is_known {
            return None;
        }
        if plan.parametric.is_linear() {
            self.carry(values, errors)
        } else {
            self.step(values, errors)
        }
    }
}

impl<const N: usize> Sized<'_, N> {
    /// Solves a linear scene by powers of its exponential.
    fn carry(&self, values: &mut [f64], errors: &mut [f64]) -> Option<Notice> {
        let (plan, instance) = (self.plan, &self.instance);
        let time = plan.parametric.time_scale();
        let scene_point = ScenePoint {
            matrix: &instance.matrix,
            start: &instance.start,
            force: &instance.force,
            deformation: &instance.deformation,
            end: plan.end(&self.numbers),
            opens: plan.parametric.opens(),
        };
        let impact = scene_point.solve(plan.wanted)?;
        let places = plan.shown.iter().zip(&plan.wishes).zip(values).zip(errors);
        for (((shown, wish), value), error) in places {
            let own = plan.figure(*shown, &impact, &self.numbers);
            if own.error.is_nan() || own.error > wish.min(LOOSEST) * own.value.abs() {
                return None;
            }
            (*value, *error) = (own.value, own.error);
        }
        let deepest = (impact.depth, impact.deepest_at * time);
        Some(plan.notice(deepest, impact.release.value * time, &self.numbers))
    }

    /// Solves a scene that is not linear in steps, as often as its errors ask for.
    fn step(&self, values: &mut [f64], errors: &mut [f64]) -> Option<Notice> {
        let plan = self.plan;
        let time = plan.parametric.time_scale();
        let stepped = Stepped {
            instance: &self.instance,
            unknowns: plan.parametric.unknowns(),
            end: plan.end(&self.numbers),
        };
        let strictest = plan.wishes.iter().copied().fold(f64::INFINITY, f64::min);
        let tolerance = |at: usize| (TOLERANCES[at] * strictest).max(FINEST);
        let mut course = stepped.follow(tolerance(usize::from(!plan.has_errors)))?;
        let mut seen = plan.seen(&course, &self.numbers);
        errors.fill(f64::NAN);
        for at in 1..TOLERANCES.len() {
            if !plan.has_errors {
                break;
            }
            let finer = stepped.follow(tolerance(at))?;
            let found = plan.seen(&finer, &self.numbers);
            let differences = || found.iter().zip(&seen).map(|(one, other)| (one - other).abs());
            let relative = differences().zip(&found).map(|(off, value)| off / value.abs());
            let most = relative.fold(0.0, f64::max);
            for ((error, off), value) in errors.iter_mut().zip(differences()).zip(&found) {
                *error = off + (DOUBT * most + ROUNDING) * value.abs();
            }
            (course, seen) = (finer, found);
            if self.suffice(&seen, errors) {
                break;
            }
        }
        if seen.iter().any(|value| !value.is_finite())
            || plan.has_errors && !self.suffice(&seen, errors)
        {
            return None;
        }
        values.copy_from_slice(&seen);
        let deepest = course.depth.maximum((0.0, course.release));
        let depth = Figure { value: deepest.value, error: strictest * deepest.value };
        Some(plan.notice((depth, deepest.time * time), course.release * time, &self.numbers))
    }

    fn suffice(&self, values: &[f64], errors: &[f64]) -> bool {
        let all = values.iter().zip(errors).zip(&self.plan.wishes);
        all.map(|((value, error), wish)| (error, wish * value.abs()))
            .all(|(error, most)| !error.is_nan() && *error <= most)
    }

    /// Whether a part of the pad would have to be watched by itself.
    fn has_thinner_part(&self) -> bool {
        let Besides { thickness, thinnest, .. } = Besides::of(&self.numbers);
        !thinnest.is_nan() && !is_as_thick(thinnest, thickness)
    }
}
