//! A fit of numbers of a scene as an object of JSON.

use dashpot_fit::network::{Kind, Source};
use serde::Serialize;

use super::{among::Among, scene::FittedScene};
use crate::{
    output::{Pairs, VERSION, list, object},
    said,
};

/// All that is known of a fit.
pub(super) fn object_of<'a>(own: &'a FittedScene<'a>) -> impl Serialize + 'a {
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
        let half = own.band.half;
        let [low, high] = [-1.0, 1.0].map(|sign| half.ok().map(|half| value + sign * half));
        (own.key.as_str(), object! { value, low, high, unit, curved, no_band: half.err() })
    });
    object! {
        dashpot: VERSION,
        title: &own.plan.scene.title,
        file: &own.plan.scene.file,
        unevaluated: &own.unevaluated,
        parameters: (0..own.numbers.len()).map(|at| parameter(own, at)).collect::<Pairs<_, _>>(),
        determined: list(shown),
        measures: measures.collect::<Pairs<_, _>>(),
        tests: list((0..own.plan.tests.len()).map(|at| test(own, at))),
        converged: own.fit.is_converged(),
        convergence: own.fit.convergence,
        stopped: own.fit.is_stopped,
        floor: None::<f64>,
        among: own.among.as_ref().map(Among::object),
        starts: own.fit.reached,
        others: list(others.map(|own| object! { values: &own.values, cost: own.cost })),
        outliers: own.fit.outliers,
        scene_warnings: said::warning_objects(&own.plan.scene),
        scene_notes: said::note_objects(&own.plan.scene),
    }
}

/// A number that was fitted, by its name.
fn parameter<'a>(own: &'a FittedScene<'a>, at: usize) -> (&'a str, impl Serialize + 'a) {
    let (number, found) = (&own.numbers[at], &own.fit.numbers[at]);
    let [low, high] = found.ends;
    let identified = own.verdict(at) == "identified";
    let on_bound = found.is_on_bound;
    let profiled = found.source == Source::Profile;
    let (value, unit) = (found.value, &number.si);
    (number.name.as_str(), object! { value, low, high, unit, identified, on_bound, profiled })
}

/// A test, with its rows.
fn test<'a>(all: &'a FittedScene<'a>, at: usize) -> impl Serialize + 'a {
    let ((asked, curve), own) = (&all.plan.curves[at], &all.fit.tests[at]);
    let known = all.plan.known[at].iter().zip(&own.known);
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
        later_jump: own.later_jump,
        cfc: all.plan.tests[at].filter.map(|own| own.0.class()),
        noise: own.noise,
        noise_at_rest: own.noise_at_rest,
        structured: own.is_structured,
        missed: own.is_missed,
        opposed: own.is_opposed,
        clipped: own.clipped,
        other_zero: own.other_zero,
        scatter: own.scatter,
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
