//! Fewer points for the same picture.

/// Points of one stretch of a curve, in display coordinates \[px\].
pub(crate) type Path = Vec<(f64, f64)>;

/// Splits a curve at values that are not finite.
pub(crate) fn stretches(points: impl Iterator<Item = (f64, f64)>) -> Vec<Path> {
    let mut stretches = vec![Path::new()];
    for (x, y) in points {
        if x.is_finite() && y.is_finite() {
            if let Some(last) = stretches.last_mut() {
                last.push((x, y));
            }
        } else {
            stretches.push(Path::new());
        }
    }
    stretches.retain(|stretch| !stretch.is_empty());
    stretches
}

/// Keeps of each run of neighbouring points in one column of `width` \[px\] the first, the lowest, the highest and
/// the last one, in their order. Loops stay loops, since runs follow the curve and not the axis; no extreme is lost.
pub(crate) fn decimate(points: &[(f64, f64)], width: f64) -> Path {
    let column = |p: &(f64, f64)| (p.0 / width).floor();
    let mut kept = Path::new();
    for run in points.chunk_by(|a, b| column(a).total_cmp(&column(b)).is_eq()) {
        let by_height = |a: &usize, b: &usize| run[*a].1.total_cmp(&run[*b].1);
        let last = run.len() - 1;
        let lowest = (0..run.len()).min_by(by_height).unwrap_or(0);
        let highest = (0..run.len()).max_by(by_height).unwrap_or(last);
        let mut picks = [0, lowest, highest, last];
        picks.sort_unstable();
        for (i, pick) in picks.iter().enumerate() {
            if i == 0 || picks[i - 1] != *pick {
                kept.push(run[*pick]);
            }
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_are_not_finite_open_a_gap() {
        let points = [(0.0, 1.0), (1.0, f64::NAN), (2.0, 3.0), (f64::INFINITY, 0.0)];
        assert_eq!(stretches(points.into_iter()), vec![vec![(0.0, 1.0)], vec![(2.0, 3.0)]]);
    }

    #[test]
    fn thinning_keeps_the_extremes_and_the_ends() {
        let wave = |i: i32| (f64::from(i) * 0.01, (f64::from(i) * 0.37).sin() * f64::from(i));
        let points: Path = (0..60_000).map(wave).collect();
        let decimated = decimate(&points, 0.5);
        assert!(decimated.len() <= 4 * 1201, "{}", decimated.len());
        let bounds = |path: &Path| {
            path.iter().fold((0.0_f64, 0.0_f64), |(low, high), p| (low.min(p.1), high.max(p.1)))
        };
        assert_eq!(bounds(&points), bounds(&decimated));
        assert_eq!((points.first(), points.last()), (decimated.first(), decimated.last()));
    }

    #[test]
    fn a_sparse_curve_stays_as_it_is() {
        let points = vec![(0.0, 0.0), (10.0, 4.0), (5.0, 9.0), (0.0, 0.0)];
        assert_eq!(decimate(&points, 0.5), points);
    }
}
