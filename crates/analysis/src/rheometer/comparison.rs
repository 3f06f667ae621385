//! The model object against an independent computation.

use super::{
    report::{Computed, Disagreement, Series},
    simulation::Track,
};

/// The series of a quantity over `times` \[s\], with its differences relative to its largest value.
pub(super) fn series<'a>(
    name: &'static str,
    unit: &'static str,
    times: &[f64],
    model: Vec<f64>,
    tracks: impl IntoIterator<Item = &'a Track>,
) -> Series {
    let compared = |track: &Track| Computed {
        difference: difference(times, &model, track),
        values: track.values.clone(),
    };
    let computed = tracks.into_iter().map(compared).collect();
    Series { name, unit, model, computed }
}

fn difference(times: &[f64], model: &[f64], track: &Track) -> Option<Disagreement> {
    let pairs = || {
        let both = model.iter().zip(&track.values);
        both.zip(times).filter_map(|((&own, &other), &at)| Some((own, other?, at)))
    };
    let of_model = pairs().map(|(own, ..)| own.abs()).reduce(f64::max)?;
    let scale = if of_model > 0.0 {
        of_model
    } else {
        pairs().map(|(_, other, _)| other.abs()).fold(0.0, f64::max)
    };
    let (largest, at) = pairs()
        .map(|(own, other, at)| ((own - other).abs(), at))
        .max_by(|one, other| one.0.total_cmp(&other.0))?;
    let relative = |size: f64| if size == 0.0 { 0.0 } else { size / scale };
    Some(Disagreement {
        largest,
        at,
        relative: relative(largest),
        stated: track.error.map(relative),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_computation_does_not_reach_does_not_count() {
        let values = vec![Some(1.0), Some(1.5), None];
        let track = Track { values, error: Some(0.1) };
        let series = series("deformation", "m", &[1.0, 2.0, 3.0], vec![1.0, 2.0, 9.0], [&track]);
        let found = series.computed[0].difference.unwrap();
        assert_eq!((found.largest, found.at, found.relative), (0.5, 2.0, 0.25));
        assert_eq!(found.stated, Some(0.05));
    }

    #[test]
    fn nothing_differs_from_nothing_by_nothing() {
        let track = Track { values: vec![Some(0.0)], error: None };
        let series = series("force", "N", &[1.0], vec![0.0], [&track]);
        assert_eq!(series.computed[0].difference.map(|own| own.relative), Some(0.0));
    }
}
