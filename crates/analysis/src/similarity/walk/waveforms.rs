//! Parameters of driving functions.

use dashpot_dae::{Given, Piece, Waveform};
use dashpot_network::{
    parameters::{Dimension, InvalidParameter, ParameterKind, Value},
    waveforms::Recognized,
};

use super::Visit;

/// The motion of a node: as it is, or by the acceleration that it was made of.
pub(super) fn walk_motion(
    node: &str,
    motion: &Waveform,
    visit: &mut dyn Visit,
) -> Result<Waveform, InvalidParameter> {
    if Recognized::of(motion).is_none()
        && let Some((own, speed)) = Recognized::as_acceleration(motion)
    {
        let name = format!("{node}.acceleration");
        let acceleration = walk_kind(&name, &own, Dimension::ACCELERATION, visit)?;
        let speed = match speed {
            0.0 => 0.0,
            speed => visit.quantity(&format!("{node}.velocity"), Dimension::VELOCITY, speed),
        };
        let again = acceleration.motion(speed);
        let range = "such that its displacement fits into double precision";
        return again.ok_or_else(|| InvalidParameter::new("acceleration", range, name));
    }
    walk_waveform(&format!("{node}.motion"), motion, Dimension::LENGTH, visit)
}

/// The values of a driving function whose kind is known; those that are zero stay so and are not told.
fn walk_kind(
    name: &str,
    own: &Recognized,
    driven: Dimension,
    visit: &mut dyn Visit,
) -> Result<Waveform, InvalidParameter> {
    visit.word(&format!("{name}.law"), own.word);
    let mut number = |name: &str, dimension: Dimension, value: f64| {
        if value == 0.0 { 0.0 } else { visit.quantity(name, dimension, value) }
    };
    let mut values = Vec::with_capacity(own.values.len());
    for (parameter, value) in own.parameters.iter().zip(&own.values) {
        let name = format!("{name}.{}", parameter.name);
        let dimension = match parameter.kind {
            ParameterKind::Quantity(own) => own,
            _ => driven,
        };
        values.push(match value {
            Value::Number(own) => Value::Number(number(&name, dimension, *own)),
            Value::Table(points) => {
                let point = |(at, (x, y)): (usize, &(f64, f64))| {
                    let x = number(&format!("{name}[{at}].time"), Dimension::TIME, *x);
                    (x, number(&format!("{name}[{at}].value"), driven, *y))
                };
                Value::Table(points.iter().enumerate().map(point).collect())
            }
            other => other.clone(),
        });
    }
    own.with(&values)
}

/// The numbers of a driving function: those of its kind, or where it shows none those of its pieces;
/// those that are zero stay so and are not told.
pub(super) fn walk_waveform(
    name: &str,
    waveform: &Waveform,
    driven: Dimension,
    visit: &mut dyn Visit,
) -> Result<Waveform, InvalidParameter> {
    if let Some(own) = Recognized::of(waveform) {
        return walk_kind(name, &own, driven, visit);
    }
    let over = |times: i8| Dimension { time: driven.time - times, ..driven };
    let (per_second, per_second_squared) = (Dimension::FREQUENCY, Dimension::new(0, 0, -2));
    let mut pieces = Vec::with_capacity(waveform.pieces().len());
    visit.word(&format!("{name}.pieces"), &waveform.pieces().len().to_string());
    for (at, own) in waveform.pieces().iter().enumerate() {
        let mut of = |key: &str, dimension, value: f64| {
            if value == 0.0 {
                return 0.0;
            }
            visit.quantity(&format!("{name}[{at}].{key}"), dimension, value)
        };
        // The first piece holds before its start as well; one that is constant may begin anywhere.
        let is_open = at == 0 && own.is_constant(0);
        pieces.push(Piece {
            start: if is_open { own.start } else { of("start", Dimension::TIME, own.start) },
            value: of("value", driven, own.value),
            slope: of("slope", over(1), own.slope),
            curvature: of("curvature", over(2), own.curvature),
            jerk: of("jerk", over(3), own.jerk),
            sine: of("sine", driven, own.sine),
            cosine: of("cosine", driven, own.cosine),
            omega: of("omega", per_second, own.omega),
            sweep: of("sweep", per_second_squared, own.sweep),
        });
    }
    if let [first, second, ..] = pieces.as_mut_slice()
        && first.is_constant(0)
    {
        first.start = second.start.min(0.0) - 1.0 - second.start.abs();
    }
    let range = "finite, with its ends apart in double precision";
    let again = Waveform::new(pieces);
    let again = match waveform.given() {
        Some(given) => {
            let mut time = |key: &str, value: f64| {
                visit.quantity(&format!("{name}.{key}"), Dimension::TIME, value)
            };
            let (from, to) = (time("from", given.from), time("to", given.to));
            again.map(|again| again.given_at(Given { from, to, ..given }))
        }
        None => again,
    };
    again.ok_or_else(|| InvalidParameter::new("waveform", range, format!("`{name}`")))
}
