//! Points of a sweep that are solved by instantiating: one compiled form, other numbers.

use dashpot_network::{
    ConnectionOutputs, Instance, ParametricSystem, SegmentPlace,
    parameters::{Value, WindowWish},
};

use super::{
    Column, Grid, Pose, ScenePoint as Scene,
    report::Notice,
    scene_point::{Figure, Impact, ScenePoint, Wanted},
    table::Table,
};
use crate::{
    Compression,
    measures::{
        STANDARD_GRAVITY,
        selection::{Selected, select},
    },
};

/// A value that is less certain than this part of itself is left to the full solution.
const LOOSEST: f64 = 1e-6;

/// What a column shows of an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shown {
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
    loosest: Vec<f64>,
    wanted: Wanted,
    duration: f64,
}

impl<'g> Plan<'g> {
    /// A plan, where the scene at the first point and the columns allow one.
    pub(super) fn of(
        grid: &'g Grid,
        pose: &Pose<'_>,
        first: &Scene,
        columns: &[Column],
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
        // Another padding, or a part of one, would have to be watched as well.
        let is_other = |(at, own): (usize, &ConnectionOutputs)| {
            let has_parts = own.segments.iter().any(|part| part.place != SegmentPlace::Whole);
            has_parts || at != struck && own.thickness.is_some()
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
        let loosest =
            columns.iter().map(|column| settings.accuracy.of(&column.key).min(LOOSEST)).collect();
        let table = Table::of(&parametric, grid, pose, duration)?;
        let element = first.network.connections()[struck].name.clone();
        Some(Self { grid, parametric, element, table, shown, loosest, wanted, duration })
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

    fn notice(&self, impact: &Impact, numbers: &[f64]) -> Notice {
        let time = self.parametric.time_scale();
        let thickness = numbers[numbers.len() - 1];
        let Figure { value: depth, error } = impact.depth;
        let release = impact.release.value * time;
        Notice {
            pulls: (release < self.duration).then_some(release),
            pressed: Some(Compression::new(
                [depth, impact.deepest_at * time],
                Some(error),
                thickness,
            ))
            .filter(Compression::is_through),
        }
    }

    fn figure(&self, shown: Shown, impact: &Impact, numbers: &[f64]) -> Figure {
        let time = self.parametric.time_scale();
        let mass = self.parametric.impactor_mass(numbers);
        let thickness = numbers[numbers.len() - 1];
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
            Shown::Restitution => impact.restitution,
            Shown::Impulse => times(impact.impulse, time),
            Shown::Work => impact.work,
            Shown::WorkAtEnd => impact.work_at_end,
            Shown::Severity => {
                let exponent = self.wanted.power.unwrap_or(1.0);
                times(impact.power, time / (mass * STANDARD_GRAVITY).powf(exponent))
            }
        }
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
    for value in selected.measure.values() {
        match value {
            Value::Window(WindowWish::Impact) => {}
            Value::Number(number) => numbers.push(number),
            _ => return None,
        }
    }
    let target = match selected.measure.kind() {
        "peak-force"
        | "peak-deformation"
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
    match (selected.measure.kind(), numbers.as_slice()) {
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
        ("energy-at-end", []) => {
            wanted.work_at_end = true;
            Some(Shown::WorkAtEnd)
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
        if !plan.table.write(&self.places, &mut self.numbers) {
            return None;
        }
        plan.parametric.fill(&self.numbers, &mut self.instance);
        let instance = &self.instance;
        let scene_point = ScenePoint {
            matrix: &instance.matrix,
            start: &instance.start,
            force: &instance.force,
            deformation: &instance.deformation,
            end: plan.duration / plan.parametric.time_scale(),
        };
        let impact = scene_point.solve(plan.wanted)?;
        let places = plan.shown.iter().zip(&plan.loosest).zip(values).zip(errors);
        for (((shown, loosest), value), error) in places {
            let own = plan.figure(*shown, &impact, &self.numbers);
            if own.error.is_nan() || own.error > loosest * own.value.abs() {
                return None;
            }
            (*value, *error) = (own.value, own.error);
        }
        Some(plan.notice(&impact, &self.numbers))
    }
}
