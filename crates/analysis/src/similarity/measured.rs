//! What the measures of similar scenes have to do with each other.

use dashpot_dae::Silent;
use dashpot_network::{Network, parameters::Dimension};

use super::{Scale, Similarity, inventory::with_value};
use crate::{
    MeasureReport, MeasureWish, RunError, RunReport, SolveSettings, Stop, selection::select, solve,
};

/// A measure of one scene, and of another at the scale of the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Its key in the first scene.
    pub key: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its values, where it has any: that of the first, and that of the second over the factor of
    /// the measure.
    pub values: [Option<f64>; 2],
    /// How far they are apart, in parts of the larger size, to which errors refer as well.
    pub apart: Option<f64>,
    /// By how much errors alone may part them, in the same parts; `None` where they are not known.
    pub error: Option<f64>,
    /// The factor of the measure from the first scene to the second one.
    pub factor: f64,
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
        match wish.measure.of_similar(scale) {
            Some(measure) => measures.push(MeasureWish { target: wish.target.clone(), measure }),
            None => left_out.push(format!("{}.{}", wish.target, wish.measure.kind())),
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
        ..settings.clone()
    };
    (similar, left_out)
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
    let (similar, _) = similar_settings(&own, scale);
    let one = solve(first, &own, &mut Silent)?;
    let other = solve(second, &similar, &mut Silent)?;
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
    let one = solve(first, &own, &mut Silent)?;
    let mut all = Vec::new();
    for pair in similarity.different() {
        let Some(group) = similarity.first.group(&pair.name) else { continue };
        let unit = similarity.first.unit(group.quantity.dimension);
        let Some(value) = unit.map(|unit| unit * pair.values[1]) else { continue };
        let changed = with_value(first, &pair.name, value);
        let Ok(changed) = changed else { continue };
        let other = solve(&changed, &own, &mut Silent)?;
        let measures = side_by_side(&one, &other, &Scale::ONE, &own)?;
        all.push(Alone { name: pair.name.clone(), measures });
    }
    Ok(all)
}

/// The settings without the measures that have no counterpart at a scale.
fn with_counterparts(settings: &SolveSettings, scale: &Scale) -> SolveSettings {
    let has_one = |wish: &&MeasureWish| wish.measure.of_similar(scale).is_some();
    let measures = settings.measures.iter().filter(has_one).cloned().collect();
    SolveSettings { measures, ..settings.clone() }
}

fn side_by_side(
    one: &RunReport,
    other: &RunReport,
    scale: &Scale,
    settings: &SolveSettings,
) -> Result<Vec<Measured>, RunError> {
    let kinds = select(&one.assembly, &settings.measures)?;
    let wished = kinds.iter().zip(&one.measures);
    let pairs = wished.enumerate().filter_map(|(at, (selected, own))| {
        // Measures with times of their own have other words there, so their place tells them.
        let opposite = other.measures.get(at)?;
        Some(pair(own, opposite, scale.of_measure(selected.measure.as_ref())))
    });
    Ok(pairs.collect())
}

fn pair(own: &MeasureReport, opposite: &MeasureReport, factor: f64) -> Measured {
    let second = opposite.value.map(|value| value / factor);
    let size = own.size.max(opposite.size / factor);
    let over = |number: f64| if size > 0.0 { number / size } else { 0.0 };
    let errors = own.error.zip(opposite.error);
    Measured {
        key: own.key.clone(),
        unit: own.unit,
        values: [own.value, second],
        apart: own.value.zip(second).map(|(one, other)| over((one - other).abs())),
        error: errors.map(|(one, other)| over(one + other / factor)),
        factor,
    }
}
