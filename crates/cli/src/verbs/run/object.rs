//! The answer as an object, of one shape for every scene.

use dashpot_analysis::SolveSettings;
use dashpot_network::parameters::Dimension;
use serde::Serialize;

use super::{Answer, solving::direction};
use crate::{
    output::{Pairs, VERSION, list, object},
    said,
};
use dashpot_studies::origin;

/// The whole answer, with the largest difference between the first run and any other, relative.
pub(super) fn object(answer: &Answer) -> impl Serialize {
    let scene = &answer.scene;
    let differences = answer.differences().into_iter();
    object! {
        dashpot: VERSION,
        scene: object! {
            title: &scene.title, file: &scene.file,
            sha256: origin::of_text(scene), files: origin::of_files(scene, &crate::input::load),
            warnings: said::warning_objects(scene), notes: said::note_objects(scene),
        },
        settings: answer.asked.first().map(|asked| settings(answer, asked)),
        runs: list(answer.runs.iter().map(|run| answer.object_of(run))),
        failed: list(answer.failed.iter().map(|(method, error)| object! {
            method, error: error.to_string(),
        })),
        difference: differences.map(|difference| (difference.key, difference.relative)).collect::<Pairs<_, _>>(),
    }
}

pub(super) fn settings(answer: &Answer, asked: &SolveSettings) -> impl Serialize {
    let single = asked.accuracy.by_measure.iter().map(|(key, &wish)| (key.as_str(), wish));
    let values = answer.scene.values.iter().map(|value| {
        let unit = value.dimension.and_then(Dimension::named).map(|(_, unit)| unit);
        (&value.name, object! { value: value.value, unit, written: &value.text })
    });
    object! {
        duration: asked.duration,
        samples: answer.scene.run.samples,
        methods: list(answer.asked.iter().map(|own| own.method.name())),
        rtol: asked.rtol,
        estimate: asked.estimate,
        accuracy: [("default", asked.accuracy.default)].into_iter().chain(single).collect::<Pairs<_, _>>(),
        neglect_below: asked.accuracy.neglect_below,
        stop: list(asked.stops.iter().map(|stop| object! {
            output: &stop.output, level: stop.level, direction: direction(stop),
        })),
        values: values.collect::<Pairs<_, _>>(),
    }
}
