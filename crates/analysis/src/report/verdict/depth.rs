//! How far everything that has a thickness is pressed.

use dashpot_network::{ConnectionOutputs, SegmentOutputs, SegmentPlace, parameters::Kind as _};

use super::{Found, Peak};
use crate::{Compression, MeasureReport, measures::PeakDeformation};

/// How far a pad is pressed.
#[derive(Debug, Clone, Copy)]
pub struct Depth<'r> {
    /// Its largest deformation.
    pub peak: Peak<'r>,
    /// That beside its thickness, where it has one.
    pub compression: Option<Compression>,
    /// Whether it meets its stop.
    pub is_on_stop: bool,
}

/// How far an element is pressed over the run, that has a thickness.
#[derive(Debug, Clone, Copy)]
pub struct Layer<'r> {
    /// The element.
    pub element: &'r str,
    /// Its largest deformation beside its thickness.
    pub compression: Compression,
    /// Whether it meets its stop.
    pub is_on_stop: bool,
}

impl<'r> Depth<'r> {
    pub(super) fn element(self) -> &'r str {
        match self.peak {
            Peak::Finite { measure, .. } | Peak::Infinite { measure, .. } => &measure.target,
        }
    }
}

impl<'r> Found<'r> {
    pub(super) fn depth(self) -> Option<Depth<'r>> {
        let on_stop = |measure: &MeasureReport| {
            self.0.assembly.position(&measure.target).is_some_and(|at| self.is_on_stop(at))
        };
        let pads = self.of_kind(PeakDeformation::KIND).filter_map(|measure| {
            let at = self.0.assembly.position(&measure.target)?;
            let connection = &self.connections()[at];
            let (thickness, window) = connection.thickness.zip(measure.window)?;
            let solution = self.0.solution();
            let deformation = solution.signal(connection.deformation);
            Some((measure, Compression::of(deformation, window, thickness)))
        });
        let strain = |own: &(_, Compression)| -own.1.strain();
        let tightest = pads.min_by(|one, other| strain(one).total_cmp(&strain(other)));
        if let Some((measure, own)) = tightest {
            let peak = self.finite(measure, measure.value?);
            return Some(Depth { peak, compression: Some(own), is_on_stop: on_stop(measure) });
        }
        let (measure, value) = self.largest(PeakDeformation::KIND)?;
        let peak = self.finite(measure, value);
        Some(Depth { peak, compression: None, is_on_stop: on_stop(measure) })
    }

    /// Whether a pad meets its stop.
    fn is_on_stop(self, element: usize) -> bool {
        let stop = self.0.assembly.pads.iter().find(|own| own.element == element);
        let stop = stop.and_then(|own| self.connections()[own.stop?].force);
        let solution = stop.is_some().then(|| self.0.solution());
        solution.zip(stop).is_some_and(|(own, force)| {
            own.keeps(force) && own.signal(force).maximum((0.0, own.end())).value > 0.0
        })
    }

    /// All elements with a thickness but this one, and the parts of elements that have one, as far as they are kept.
    pub(super) fn layers(self, but: Option<&str>) -> Vec<Layer<'r>> {
        let compression = |deformation: usize, thickness: f64| {
            let solution = self.0.solution();
            let run = (0.0, solution.end());
            solution
                .keeps(deformation)
                .then(|| Compression::of(solution.signal(deformation), run, thickness))
        };
        let layers = |(at, own): (usize, &'r ConnectionOutputs)| {
            let is_other = but != Some(own.name.as_str());
            let whole = own.thickness.filter(|_| is_other).and_then(|thickness| {
                let compression = compression(own.deformation, thickness)?;
                Some(Layer { element: &own.name, compression, is_on_stop: self.is_on_stop(at) })
            });
            // One that is as thick as all of it is no layer of it.
            let is_layer = |part: &&SegmentOutputs| own.thickness != Some(part.thickness);
            let part = move |part: &'r SegmentOutputs| {
                let SegmentPlace::Branch { path } = &part.place else { return None };
                let compression = compression(part.deformation, part.thickness)?;
                Some(Layer { element: path, compression, is_on_stop: false })
            };
            whole
                .into_iter()
                .chain(own.segments.iter().filter(is_layer).filter_map(part))
                .collect::<Vec<_>>()
        };
        let all = self.connections().iter().enumerate().filter(|own| !own.1.is_rigid);
        all.flat_map(layers).collect()
    }
}
