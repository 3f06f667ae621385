//! Stresses and strains: the largest of what the segments of a pad feel.

use dashpot_network::{SegmentOutputs, SegmentPlace};

use super::{MeasureKind, MeasureTraits, Needs, Reading, reading::peaks_below_zero};
use crate::{Note, Solution, impact::interval::Span};

windowed! {
    /// The largest magnitude of the stress in any segment of a pad, `max |F(t)|/A` \[Pa\], with its time
    /// and its layer; a peak in tension is noted.
    ///
    /// `F` is the force in the segment and `A` the area of its layer: the stress is that on the undeformed
    /// area. Pads of layers have segments; another element with a `thickness` and an `area` is a single
    /// one, and so is each branch of its model with a size of its own. Without an area there is no stress, and where masses meet in the element and speeds jump, it
    /// is infinite.
    PeakStress: "peak-stress", "largest stress in any segment of a pad, force over area [Pa]"
}

impl MeasureKind for PeakStress {
    const ABOUT: MeasureTraits = MeasureTraits {
        needs: Needs::Area,
        of_layers: true,
        ..MeasureTraits::of_element::<Self>("Pa")
    };

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let connection = &solution.assembly().connections[target];
        let segments = connection.segments.iter();
        let with_area = segments.filter_map(|segment| Some((segment, segment.area?)));
        if with_area.clone().next().is_none() {
            return Err(Note::NoArea);
        }
        let span = solution.element_span(target, self.window)?;
        if let Some(reading) = Reading::infinite(&span, solution.element_jumps(target)) {
            return Ok(reading);
        }
        let forces = with_area.filter_map(|(own, area)| Some((own, own.force?, area)));
        largest(solution, &span, forces, Note::InTension).ok_or(Note::NoForce)
    }
}

windowed! {
    /// The largest magnitude of the strain in any segment of a pad, `max |y(t)|/h` \[1\], with its time and
    /// its layer; a peak in elongation is noted.
    ///
    /// `y` is the deformation of the segment and `h` its thickness at rest. Pads of layers have segments; another
    /// element with a `thickness` is a single one, and so is each branch of its model with a thickness of its own.
    PeakStrain: "peak-strain",
        "largest strain in any segment of a pad, deformation over thickness [1]"
}

impl MeasureKind for PeakStrain {
    const ABOUT: MeasureTraits = MeasureTraits {
        needs: Needs::Thickness,
        of_layers: true,
        ..MeasureTraits::of_element::<Self>("1")
    };

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let connection = &solution.assembly().connections[target];
        if connection.segments.is_empty() {
            return Err(Note::NoThickness);
        }
        let span = solution.element_span(target, self.window)?;
        let segments = connection.segments.iter();
        let deformations =
            segments.map(|segment| (segment, segment.deformation, segment.thickness));
        let reading =
            largest(solution, &span, deformations, Note::InElongation).ok_or(Note::NoThickness)?;
        // The note is on the largest strain, unless that is one in elongation.
        let is_crushed = reading.value.is_some_and(|value| value > 1.0);
        let is_crushed = is_crushed && !reading.notes.contains(&Note::InElongation);
        Ok(reading.noting_if(is_crushed, Note::Crushed))
    }
}

/// The largest magnitude over `segments` of an output over a size, with the layer where it occurs.
/// A peak of a negative value is noted with the word for it. `None` without segments.
fn largest<'s>(
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
        let own = over(Reading::peak(&signal(output), span), size);
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
