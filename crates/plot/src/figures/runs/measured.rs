//! Measured curves over those of runs.

use super::{super::unit::Unit, MeasuredSeries, Of, RunSeries};
use crate::{Pattern, Series};

/// The measured curves of a figure of `y` over `x`, as far as the runs are shown.
pub(super) fn measured(runs: &[RunSeries], (x, y): (Of, Of)) -> Vec<MeasuredSeries> {
    let times = || runs.iter().flat_map(|run| &run.time).copied();
    let (from, to) =
        (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max));
    let mut found: Vec<MeasuredSeries> = Vec::new();
    for own in runs.iter().flat_map(|run| &run.measured).filter(|own| x == Of::Time && own.of == y)
    {
        let points = own.points.iter().filter(|point| (from..=to).contains(&point.0));
        let own = MeasuredSeries { points: points.copied().collect(), ..own.clone() };
        if !own.points.is_empty() && !found.contains(&own) {
            found.push(own);
        }
    }
    found
}

/// The curves in the units of the axes: one as what was measured, more of them dotted in the colours after the first
/// `taken` ones.
pub(super) fn series(
    all: &[MeasuredSeries],
    taken: usize,
    (x, y): (Unit, Unit),
) -> impl Iterator<Item = Series> {
    let pattern = if all.len() == 1 { Pattern::Measured } else { Pattern::Dotted };
    all.iter().enumerate().map(move |(at, own)| {
        let points = own.points.iter().map(|point| (point.0 / x.factor, point.1 / y.factor));
        Series::drawn(&own.name, (taken + at, pattern), points)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{ACCELERATION_TIME, FIGURES, FORCE_DEFORMATION, FORCE_TIME, tests::runs};

    #[test]
    fn a_measured_curve_stands_once_in_the_figure_of_its_output_in_the_units_of_the_axes() {
        let mut runs = runs();
        let own = MeasuredSeries {
            name: "measured, drop.csv".into(),
            of: Of::Force,
            // The runs last 20 ms.
            points: vec![(-1e-3, 0.0), (0.0, 1e3), (5e-3, 50e3), (21e-3, 900e3)],
        };
        runs.iter_mut().for_each(|run| run.measured = vec![own.clone()]);
        let chart = FORCE_TIME.chart(&runs);
        let [.., last] = &chart.series[..] else { panic!() };
        assert_eq!((chart.series.len(), last.name.as_str()), (5, "measured, drop.csv"));
        assert_eq!(last.points, [(0.0, 1.0), (5.0, 50.0)]);
        let strokes: Vec<_> = chart.series.iter().map(|own| own.stroke).collect();
        assert!(
            strokes[..4]
                .iter()
                .all(|own| own.map(|own| own.colour) != last.stroke.map(|own| own.colour))
        );
        assert_eq!(
            (
                ACCELERATION_TIME.chart(&runs).series.len(),
                FORCE_DEFORMATION.chart(&runs).series.len()
            ),
            (4, 4)
        );
        assert!(FIGURES.iter().all(|figure| figure.chart(&runs).svg().is_ok()));
    }
}
