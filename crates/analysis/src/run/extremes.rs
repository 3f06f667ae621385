//! Warnings of paddings that are pressed further than they go, and of laws further than they are
//! known.

use dashpot_network::{ConnectionOutputs, PrimitiveOutputs, SegmentOutputs, SegmentPlace};

use crate::{Beyond, Solution, Through, Warning, report::warning::ROUNDING};

/// Two thicknesses that differ by less, in parts of themselves, are one.
const SAME: f64 = 1e-9;

impl Through {
    fn of(solution: &Solution<'_>, name: &str, output: usize, thickness: f64) -> Option<Self> {
        if !solution.keeps(output) {
            return None;
        }
        let deformation = solution.glance(output);
        let deepest = deformation.maximum((0.0, solution.end()));
        let noise = deformation.error.unwrap_or(0.0).max(ROUNDING * thickness);
        (deepest.value > thickness + noise).then(|| Self {
            name: name.to_owned(),
            deepest: deepest.value,
            time: deepest.time,
            thickness,
        })
    }

    fn strain(&self) -> f64 {
        self.deepest / self.thickness
    }
}

/// Pads that are pressed in by more than their thickness, and of those within a pad the worst one.
pub(crate) fn pressed_through(solution: &Solution<'_>) -> Vec<Warning> {
    let of_connection = |own: &ConnectionOutputs| {
        let whole = own
            .thickness
            .and_then(|thickness| Through::of(solution, &own.name, own.deformation, thickness));
        let parts = own.segments.iter().filter(|part| {
            // What is as thick as the whole lies between the same ends.
            own.thickness.is_none_or(|whole| part.thickness < (1.0 - SAME) * whole)
        });
        let parts: Vec<Through> = parts
            .filter_map(|part: &SegmentOutputs| match &part.place {
                SegmentPlace::Branch { path } => {
                    Through::of(solution, path, part.deformation, part.thickness)
                }
                SegmentPlace::Whole | SegmentPlace::Layer { .. } => None,
            })
            .collect();
        let others = parts.len().saturating_sub(1);
        let worst = parts.into_iter().max_by(|one, other| one.strain().total_cmp(&other.strain()));
        let worst = worst.map(|through| Warning::PressedThrough { through, others });
        whole.map(|through| Warning::PressedThrough { through, others: 0 }).into_iter().chain(worst)
    };
    solution.assembly().connections.iter().flat_map(of_connection).collect()
}

/// Measured laws that are followed beyond their points: of each element the one that is followed
/// furthest on either side.
pub(crate) fn beyond_measured(solution: &Solution<'_>) -> Vec<Warning> {
    let assembly = solution.assembly();
    let of_connection = |own: &ConnectionOutputs| {
        let parts = assembly.primitives.get(own.primitives.clone()).unwrap_or(&[]);
        let beyond: Vec<Beyond> =
            parts.iter().flat_map(|part| Beyond::of(solution, part)).collect();
        let furthest = |is_pressed: bool| {
            let of_side = beyond.iter().filter(|own| own.is_pressed == is_pressed);
            let found = of_side.max_by(|one, other| one.excess.total_cmp(&other.excess));
            found.cloned().map(Warning::BeyondMeasured)
        };
        [true, false].map(furthest).into_iter().flatten()
    };
    assembly.connections.iter().flat_map(of_connection).collect()
}

impl Beyond {
    fn of(solution: &Solution<'_>, part: &PrimitiveOutputs) -> Vec<Self> {
        let measured = part.element.measured().filter(|_| solution.keeps(part.deformation));
        let Some((first, last)) = measured else { return Vec::new() };
        let deformation = solution.glance(part.deformation);
        let run = (0.0, solution.end());
        let noise = deformation.error.unwrap_or(0.0).max(ROUNDING * (last - first));
        let (deepest, longest) = (deformation.maximum(run), deformation.minimum(run));
        let name = || part.name.clone();
        let pressed = (deepest.value > last + noise).then(|| Self {
            name: name(),
            is_pressed: true,
            excess: deepest.value - last,
            time: deepest.time,
            point: last,
        });
        // A law that begins flat is meant to have no more force before.
        let [before, there] = [longest.value, first].map(|at| part.element.force(at, 0.0));
        let stretched = (longest.value < first - noise && before < there).then(|| Self {
            name: name(),
            is_pressed: false,
            excess: first - longest.value,
            time: longest.time,
            point: first,
        });
        pressed.into_iter().chain(stretched).collect()
    }
}
