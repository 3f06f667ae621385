//! What the measures of similar scenes have to do with each other.

use dashpot_network::{Network, parameters::Dimension};

use super::{Scale, Similarity, groups::with_value, scale::similar_measure};
use crate::{
    MeasureReport, MeasureWish, RunError, RunReport, Solve, SolveSettings, Stop,
    measures::selection::{select, wish},
    report::over,
};

/// Differences below this part of a measure's size are those of rounding.
const ROUNDING: f64 = 1e-13;

/// What is smaller than this part of its size is what rounding leaves of zero.
const VANISHING: f64 = 1e-12;

/// A measure of one scene, and of another at the scale of the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Its key in the first scene.
    pub key: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its values, where it has any: that of the first, and that of the second over the factor of the measure.
    pub values: [Option<f64>; 2],
    /// How far they are apart, over the larger one of the two values.
    pub apart: Option<f64>,
    /// By how much errors alone may part them, over the same; `None` where they are not known.
    pub error: Option<f64>,
    /// How far they are apart over the larger size, which is that of what the measure is made of: a
    /// small rest of large terms is no closer than these.
    pub of_size: Option<f64>,
    /// What cannot be told from zero: the errors of both, or rounding, in the units of the values.
    pub noise: [f64; 2],
    /// The factor of the measure from the first scene to the second one.
    pub factor: f64,
}

impl Measured {
    /// Whether errors alone, or rounding, may part the two.
    pub fn is_within_errors(&self) -> bool {
        let is_known = self.apart.zip(self.error).is_some_and(|(apart, error)| apart <= error);
        is_known || self.of_size.is_some_and(|of_size| of_size <= ROUNDING)
    }
}

/// By how much one group alone moves the measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Alone {
    /// The parameter that the group belongs to.
    pub name: String,
    /// The measures of the first scene, and with the group of the second one.
    pub measures: Vec<Measured>,
}

/// What is to be asked of a scene that is similar to one of which `settings` are asked; and the
/// measures that have no counterpart there, because they have times of their own.
pub fn similar_settings(settings: &SolveSettings, scale: &Scale) -> (SolveSettings, Vec<String>) {
    let (mut measures, mut left_out) = (Vec::new(), Vec::new());
    for wish in &settings.measures {
        match similar_measure(wish.measure.as_ref(), scale) {
            Some(measure) => measures.push(MeasureWish { target: wish.target.clone(), measure }),
            None => left_out.push(format!("{}.{}", wish.target, wish.measure.kind())),
        }
    }
    let mut limits = Vec::new();
    for limit in &settings.limits {
        let own = wish(&limit.key).and_then(|wish| similar_measure(wish.measure.as_ref(), scale));
        match own {
            Some(measure) => limits.push(limit.scaled(scale.of_measure(measure.as_ref()))),
            None => left_out.push(limit.key.clone()),
        }
    }
    let stop = |stop: &Stop| {
        let output = stop.output.rsplit('.').next().unwrap_or_default();
        let dimension = match output {
            "force" => Dimension::FORCE,
            "velocity" | "rate" => Dimension::VELOCITY,
            "acceleration" => Dimension::ACCELERATION,
            _ => Dimension::LENGTH,
        };
        Stop { level: stop.level * scale.of(dimension), ..stop.clone() }
    };
    let similar = SolveSettings {
        duration: settings.duration * scale.time,
        stops: settings.stops.iter().map(stop).collect(),
        measures,
        limits,
        ..settings.clone()
    };
    (similar, left_out)
}

/// How long \[s\] the second run is to be: from touch on as long as the first one, at its scale. A free
/// fall before it takes its own time, which is another one where gravity is not to scale.
fn similar_duration(duration: f64, scale: &Scale, networks: [&Network; 2]) -> f64 {
    let [own, other] = networks.map(Network::time_of_fall);
    let is_of_scale = (own * scale.time - other).abs() <= ROUNDING * other;
    if is_of_scale || own >= duration {
        return duration * scale.time;
    }
    (duration - own) * scale.time + other
}

/// Solves two scenes of one structure, the second one as long and with the same measures as the
/// first at its `scale`, and compares what is measured.
///
/// # Errors
///
/// Any [`RunError`] of one of them.
pub fn measured(
    first: &Network,
    second: &Network,
    scale: &Scale,
    settings: &SolveSettings,
) -> Result<Vec<Measured>, RunError> {
    let own = with_counterparts(settings, scale);
    let (mut similar, _) = similar_settings(&own, scale);
    similar.duration = similar_duration(own.duration, scale, [first, second]);
    let one = first.solve_with(&own)?;
    let other = second.solve_with(&similar)?;
    side_by_side(&one, &other, scale, &own)
}

/// By how much each group that differs moves the measures of the first scene if it alone has the
/// value that it has in the second.
///
/// # Errors
///
/// Any [`RunError`] of one of the runs.
pub fn alone(
    first: &Network,
    similarity: &Similarity,
    settings: &SolveSettings,
) -> Result<Vec<Alone>, RunError> {
    let own = with_counterparts(settings, &Scale::ONE);
    let one = first.solve_with(&own)?;
    let mut all = Vec::new();
    for pair in similarity.different() {
        let Some(group) = similarity.first.group(&pair.name) else { continue };
        let unit = similarity.first.unit(group.quantity.dimension);
        let Some(value) = unit.map(|unit| unit * pair.values[1]) else { continue };
        let changed = with_value(first, &pair.name, value);
        let Ok(changed) = changed else { continue };
        let duration = similar_duration(own.duration, &Scale::ONE, [first, &changed]);
        let other = changed.solve_with(&SolveSettings { duration, ..own.clone() })?;
        let measures = side_by_side(&one, &other, &Scale::ONE, &own)?;
        all.push(Alone { name: pair.name.clone(), measures });
    }
    Ok(all)
}

/// The settings without the measures that have no counterpart at a scale.
fn with_counterparts(settings: &SolveSettings, scale: &Scale) -> SolveSettings {
    let has_one = |wish: &&MeasureWish| similar_measure(wish.measure.as_ref(), scale).is_some();
    let measures = settings.measures.iter().filter(has_one).cloned().collect();
    SolveSettings { measures, limits: Vec::new(), ..settings.clone() }
}

fn side_by_side(
    one: &RunReport,
    other: &RunReport,
    scale: &Scale,
    settings: &SolveSettings,
) -> Result<Vec<Measured>, RunError> {
    let kinds = select(&one.assembly, &settings.measures, &settings.limits)?;
    let (all, by_key) = (&other.measures, other.by_key());
    let wished = kinds.iter().zip(&one.measures);
    let pairs = wished.enumerate().filter_map(|(at, (selected, own))| {
        // Measures with times of their own have other words there, so their place tells them.
        let is_alike = one.measures.len() == all.len();
        let by_name = || by_key.get(own.key.as_str()).copied();
        let opposite = if is_alike { all.get(at) } else { by_name() }?;
        Some(pair(own, opposite, scale.of_measure(selected.measure.as_ref())))
    });
    Ok(pairs.collect())
}

fn pair(measure_report: &MeasureReport, opposite: &MeasureReport, factor: f64) -> Measured {
    let second = opposite.value.map(|value| value / factor);
    let both = measure_report.value.zip(second);
    let larger = both.map_or(0.0, |(one, other)| one.abs().max(other.abs()));
    let difference = both.map(|(one, other)| (one - other).abs());
    let errors = measure_report.error.zip(opposite.error).map(|(one, other)| one + other / factor);
    let errors = errors.filter(|error| error.is_finite());
    Measured {
        key: measure_report.key.clone(),
        unit: measure_report.unit,
        values: [measure_report.value, second],
        apart: difference.map(|difference| over(difference, larger)),
        error: errors.map(|error| over(error, larger)),
        of_size: difference.map(|by| over(by, measure_report.size.max(opposite.size / factor))),
        noise: [noise(measure_report), noise(opposite) / factor],
        factor,
    }
}

/// What of a measure cannot be told from zero.
fn noise(measure_report: &MeasureReport) -> f64 {
    measure_report
        .error
        .filter(|error| error.is_finite())
        .unwrap_or(0.0)
        .max(VANISHING * measure_report.size)
}
