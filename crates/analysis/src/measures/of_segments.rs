//! The largest of what the segments of a pad feel.

use dashpot_network::{SegmentOutputs, SegmentPlace};

use super::{
    Reading,
    reading::{peak, peaks_below_zero},
};
use crate::{Note, Solution, impact::interval::Span};

/// The largest magnitude over `segments` of an output over a size, with the layer where it occurs.
/// A peak of a negative value is noted with the word for it. `None` without segments.
pub(super) fn largest<'s>(
    solution: &Solution<'_>,
    span: &Span,
    segments: impl Iterator<Item = (&'s SegmentOutputs, usize, f64)>,
    negative: Note,
) -> Option<Reading> {
    // There may be thousands of segments, so signals are not kept.
    let system = &solution.assembly().system;
    let signal = |output: usize| solution.trajectory().signal(system, output);
    let mut most: Option<(Reading, &SegmentOutputs, usize)> = None;
    // The largest of several values is as wrong as the worst of them may be.
    let mut error = Some(0.0);
    let mut noise = 0.0_f64;
    for (segment, output, size) in segments {
        let own = over(peak(&signal(output), span), size);
        if own.value.is_none() {
            return Some(own);
        }
        error = error.zip(own.error).map(|(worst, own): (f64, f64)| worst.max(own));
        noise = noise.max(own.noise);
        if most.as_ref().is_none_or(|(known, ..)| own.value > known.value) {
            most = Some((own, segment, output));
        }
    }
    let (reading, segment, output) = most?;
    let mut reading = Reading { error, noise, ..reading };
    match &segment.place {
        SegmentPlace::Whole => {}
        SegmentPlace::Layer { name, depth } => {
            reading = reading.noting(Note::InLayer(name.clone(), *depth));
        }
        SegmentPlace::Branch { path } => reading = reading.noting(Note::InBranch(path.clone())),
    }
    if peaks_below_zero(&signal(output), span) {
        reading = reading.noting(negative);
    }
    Some(reading)
}

/// A reading over a constant.
fn over(reading: Reading, size: f64) -> Reading {
    Reading {
        value: reading.value.map(|value| value / size),
        size: reading.size / size,
        error: reading.error.map(|error| error / size),
        noise: reading.noise / size,
        end_rate: reading.end_rate / size,
        ..reading
    }
}
