//! Fewer points for the same curve.

/// Curves of so many points are left as they are.
const FEW: usize = 300;
/// Straight lines between the points that stay are within this part of the peak of those that go.
pub(super) const WITHIN: f64 = 1e-4;

/// The points that matter: those of Ramer, Douglas and Peucker, with distances in the values alone.
pub(super) fn thinned(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    if points.len() <= FEW {
        return points;
    }
    let peak = points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
    let mut stays = vec![false; points.len()];
    // Rest stays rest.
    let rest = points.iter().position(|point| point.0 == 0.0);
    let ends = [Some(0), rest, Some(points.len() - 1)];
    let ends: Vec<usize> = ends.into_iter().flatten().collect();
    ends.iter().for_each(|&at| stays[at] = true);
    let mut open: Vec<(usize, usize)> = ends.windows(2).map(|pair| (pair[0], pair[1])).collect();
    while let Some((from, to)) = open.pop() {
        let [(start, low), (end, high)] = [points[from], points[to]];
        let off = |at: usize| {
            let part = (points[at].0 - start) / (end - start);
            (points[at].1 - (low + part * (high - low))).abs()
        };
        let farthest = (from + 1..to).max_by(|&one, &other| off(one).total_cmp(&off(other)));
        if let Some(at) = farthest.filter(|&at| off(at) > WITHIN * peak) {
            stays[at] = true;
            open.extend([(from, at), (at, to)]);
        }
    }
    points.into_iter().zip(stays).filter_map(|(point, stays)| stays.then_some(point)).collect()
}
