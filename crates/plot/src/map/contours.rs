//! Lines of equal value over a grid, by marching squares.

use std::collections::BTreeMap;

/// A place where a line crosses the link between two neighbouring points of the grid: the first of
/// both, and whether the other one stands beyond it along y.
type Crossing = (usize, usize, bool);

/// The lines on which `values` are `level`, as places in units of the grid's steps: `(3.5, 2.0)` lies
/// half-way between the points 3 and 4 of row 2.
///
/// Values stand row by row, `columns` in each. Between points they run straight; squares with a corner
/// that is not finite are left out, and those that are not `wanted`, by their lowest corner as (column, row). A line that closes ends where it begins.
pub(super) fn contours(
    values: &[f64],
    columns: usize,
    level: f64,
    wanted: impl Fn((usize, usize)) -> bool,
) -> Vec<Vec<(f64, f64)>> {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    let mut links: BTreeMap<Crossing, Vec<Crossing>> = BTreeMap::new();
    let mut join = |one: Crossing, other: Crossing| {
        links.entry(one).or_default().push(other);
        links.entry(other).or_default().push(one);
    };
    for row in 1..rows {
        for column in 1..columns {
            let (i, j) = (column - 1, row - 1);
            let at = |column: usize, row: usize| values[row * columns + column];
            let corners = [at(i, j), at(column, j), at(column, row), at(i, row)];
            if corners.iter().any(|corner| !corner.is_finite()) || !wanted((i, j)) {
                continue;
            }
            let above = corners.map(|corner| corner >= level);
            // The four sides in turn, each between the corner of its number and the next one.
            let sides = [(i, j, false), (column, j, true), (i, row, false), (i, j, true)];
            let crossed: Vec<Crossing> =
                (0..4).filter(|&k| above[k] != above[(k + 1) % 4]).map(|k| sides[k]).collect();
            match crossed[..] {
                [one, other] => join(one, other),
                [a, b, c, d] => {
                    let middle = 0.25 * corners.iter().sum::<f64>() >= level;
                    // The middle belongs to one pair of opposite corners.
                    if middle == above[0] {
                        join(a, b);
                        join(c, d);
                    } else {
                        join(d, a);
                        join(b, c);
                    }
                }
                _ => {}
            }
        }
    }
    let place = |&(i, j, is_up): &Crossing| {
        let (first, second) = if is_up { ((i, j), (i, j + 1)) } else { ((i, j), (i + 1, j)) };
        let at = |(i, j): (usize, usize)| values[j * columns + i];
        let share = ((level - at(first)) / (at(second) - at(first))).clamp(0.0, 1.0);
        let (x, y) = (i as f64, j as f64);
        if is_up { (x, y + share) } else { (x + share, y) }
    };
    let paths = traced(links);
    paths.iter().map(|path| path.iter().map(place).collect()).collect()
}

/// Takes links apart into lines, open ones first.
fn traced(mut links: BTreeMap<Crossing, Vec<Crossing>>) -> Vec<Vec<Crossing>> {
    let mut paths = Vec::new();
    let ends: Vec<Crossing> =
        links.iter().filter(|link| link.1.len() == 1).map(|link| *link.0).collect();
    for start in ends {
        paths.extend(trace(&mut links, start));
    }
    while let Some(start) = links.iter().find(|link| !link.1.is_empty()).map(|link| *link.0) {
        paths.extend(trace(&mut links, start));
    }
    paths
}

/// The line from a crossing on, taken out of the links.
fn trace(links: &mut BTreeMap<Crossing, Vec<Crossing>>, start: Crossing) -> Option<Vec<Crossing>> {
    let mut path = vec![start];
    let mut last = start;
    while let Some(next) = links.get_mut(&last).and_then(Vec::pop) {
        if let Some(back) = links.get_mut(&next)
            && let Some(at) = back.iter().position(|own| *own == last)
        {
            back.swap_remove(at);
        }
        path.push(next);
        last = next;
    }
    (path.len() > 1).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_is_crossed_by_one_line_at_the_right_place() {
        let values: Vec<f64> = (0..12).map(|at| f64::from(at % 4)).collect();
        let lines = contours(&values, 4, 1.25, |_| true);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].len(), 3);
        assert!(lines[0].iter().all(|place| (place.0 - 1.25).abs() < 1e-15));
        let upper = contours(&values, 4, 1.25, |(_, row)| row == 1);
        assert_eq!(upper[0].len(), 2);
    }

    #[test]
    fn a_hill_is_ringed() {
        let mut values = vec![0.0; 25];
        values[12] = 1.0;
        let lines = contours(&values, 5, 0.5, |_| true);
        assert_eq!(lines.len(), 1);
        assert_eq!((lines[0].len(), lines[0][0]), (5, lines[0][4]));
    }

    #[test]
    fn gaps_and_flat_grids_have_no_lines() {
        assert!(contours(&[1.0, f64::NAN, 2.0, 3.0], 2, 1.5, |_| true).is_empty());
        assert!(contours(&[1.0; 9], 3, 2.0, |_| true).is_empty());
        assert!(contours(&[], 0, 2.0, |_| true).is_empty());
    }

    #[test]
    fn a_saddle_is_crossed_by_two_lines() {
        let lines = contours(&[1.0, 0.0, 0.0, 1.0], 2, 0.4, |_| true);
        assert_eq!(lines.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
    }
}
