//! Points that are listed in the scene.

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind};

use super::parameters::KindReader;
use crate::text::{
    document::{Content, Item},
    table::wrong_type,
};

impl KindReader<'_> {
    pub(super) fn points(
        self,
        item: &Item,
        parameter: &Parameter,
        dimensions: [Dimension; 2],
    ) -> Option<Vec<(f64, f64)>> {
        let (faults, kind) = (self.quantities.faults, parameter.kind);
        let quiet = Self { quantities: self.quantities.unwatched(), ..self };
        let Content::List(points) = &item.value else {
            let example = self.example().parameter(parameter);
            let expected =
                format!("a list of pairs or the name of a file, for example `{example}`");
            wrong_type(item, &format!("`{}`", parameter.name), &expected, faults);
            return None;
        };
        let point = |item: &Item| {
            let pair: Option<&[Item; 2]> = match &item.value {
                Content::List(pair) => (**pair).try_into().ok(),
                _ => None,
            };
            if pair.is_none() {
                let pair = if kind == ParameterKind::TimeTable {
                    "a pair [time, value]"
                } else {
                    "a pair of quantities"
                };
                wrong_type(item, "a point", pair, faults);
            }
            let [first, second] = pair?;
            let first = quiet.coordinate(parameter, first, dimensions[0]);
            let second = match kind {
                ParameterKind::TimeTable => quiet.amplitude(second),
                _ => quiet.coordinate(parameter, second, dimensions[1]),
            };
            first.zip(second)
        };
        // Every point is read, so that all faults are found.
        let read = points.iter().map(point).collect::<Vec<_>>();
        let read = read.into_iter().collect::<Option<Vec<_>>>()?;
        self.check_largest(points, &read, dimensions);
        Some(read)
    }

    fn coordinate(self, parameter: &Parameter, item: &Item, dimension: Dimension) -> Option<f64> {
        let value = self.quantities.read(item, dimension)?;
        self.fitting(parameter.name, item, dimension, value)
    }

    /// Looks whether points are unusual, by the largest of their values in each place.
    fn check_largest(self, points: &[Item], read: &[(f64, f64)], dimensions: [Dimension; 2]) {
        let sizes = |at: usize| {
            let size = move |own: &(f64, f64)| if at == 0 { own.0 } else { own.1 };
            read.iter().map(size).zip(points)
        };
        for (at, dimension) in dimensions.into_iter().enumerate() {
            let largest = sizes(at).max_by(|first, other| first.0.abs().total_cmp(&other.0.abs()));
            if let Some((value, Item { value: Content::List(pair), .. })) = largest {
                let dimension = self.quantities.basis.dimension(dimension);
                let is_bare = self.quantities.is_bare(&pair[at]);
                self.quantities.warn(&pair[at], is_bare, dimension, value);
            }
        }
    }
}
