//! A fit of numbers of a scene as an object of JSON.

use dashpot_fit::network::{Convergence, Kind, Source};
use serde::Serialize;

use super::{among::Among, scene::FittedScene};
use crate::{
    output::{Pairs, VERSION, list, object},
    said,
};

/// All that is known of a fit.
pub(super) fn object_of(own: &FittedScene) -> impl Serialize + '_ {
    let shown = own.shown.iter().map(|own| {
        let constants = own.constants.iter().map(|(name, value, ends, unit)| {
            let [low, high] = ends.map_or([None; 2], |ends| ends.map(Some));
            object! { name, value, low, high, unit }
        });
        object! { element: &own.element, parameters: &own.numbers, constants: list(constants) }
    });
    let others = own.fit.others.iter();
    let measures = own.measures.iter().map(|own| {
        let (value, unit, curved) = (own.band.value, own.unit, own.band.is_bent);
        let [low, high] = [-1.0, 1.0].map(|sign| own.band.half.map(|half| value + sign * half));
        (own.key.as_str(), object! { value, low, high, unit, curved })
    });
    object! {
        dashpot: VERSION,
        title: &own.scene.title,
        file: &own.scene.file,
        unevaluated: &own.unevaluated,
        parameters: (0..own.numbers.len()).map(|at| parameter(own, at)).collect::<Pairs<_, _>>(),
        determined: list(shown),
        measures: measures.collect::<Pairs<_, _>>(),
        tests: list((0..own.tests.len()).map(|at| test(own, at))),
        converged: own.fit.is_converged(),
        convergence: match own.fit.convergence {
            Convergence::Reached => "reached",
            Convergence::Alone => "one-start-alone",
            Convergence::Unsettled => "no-minimum",
        },
        stopped: own.fit.is_stopped,
        floor: None::<f64>,
        among: own.among.as_ref().map(Among::object),
        starts: own.fit.reached,
        others: list(others.map(|own| object! { values: &own.values, cost: own.cost })),
        outliers: own.fit.outliers,
        scene_warnings: said::warning_objects(&own.scene),
        scene_notes: said::note_objects(&own.scene),
    }
}

/// A number that was fitted, by its name.
fn parameter(own: &FittedScene, at: usize) -> (&str, impl Serialize + '_) {
    let (number, found) = (&own.numbers[at], &own.fit.numbers[at]);
    let [low, high] = found.ends;
    let identified = own.verdict(at) == "identified";
    let on_bound = found.is_on_bound;
    let profiled = found.source == Source::Profile;
    let (value, unit) = (found.value, &number.si);
    (number.name.as_str(), object! { value, low, high, unit, identified, on_bound, profiled })
}

/// A test, with its rows.
fn test(all: &FittedScene, at: usize) -> impl Serialize + '_ {
    let ((asked, curve), own) = (&all.curves[at], &all.fit.tests[at]);
    let known = all.known[at].iter().zip(&own.known);
    let known = known.map(|(own, value)| (own.name.as_str(), object! { value, unit: &own.si }));
    let is_modulus = curve.output.kind() == Kind::Modulus;
    let model = curve.rows.iter().zip(&own.residual);
    let model = model.map(|(row, left)| if is_modulus { row.1 * left.exp() } else { row.1 + left });
    object! {
        file: &asked.file,
        output: curve.output.key(),
        unit: curve.output.unit(),
        rms: own.rms,
        shift: own.shift,
        offset: own.offset,
        measured_peak: own.measured_peak,
        model_peak: own.model_peak,
        held_out: own.held_out.map(|own| own.peak),
        held_out_rms: own.held_out.map(|own| own.rms),
        jump: own.jump,
        later_jump: own.later_jump.map(|own| object! { time: own.time, height: own.height }),
        cfc: all.tests[at].filter.map(|own| own.0.class()),
        noise: own.noise,
        noise_at_rest: own.noise_at_rest,
        other_zero: own.other_zero.map(|own| object! { rows: own.rows, median: own.median }),
        scatter: own.scatter.map(|own| object! {
            deviation: own.deviation,
            correlation: own.correlation,
            records: own.records,
        }),
        gain: own.gain,
        known: known.collect::<Pairs<_, _>>(),
        curve: object! {
            time: list(curve.rows.iter().map(|row| row.0)),
            measured: list(curve.rows.iter().map(|row| row.1)),
            model: list(model),
            band: &own.band,
        },
    }
}
