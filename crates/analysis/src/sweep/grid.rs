//! The points of a sweep.

/// Every combination of the values of some parameters, by their positions; the last parameter varies
/// fastest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    counts: Vec<usize>,
}

impl Grid {
    /// The grid of so many values of each parameter. `None` where there is no parameter, one has no
    /// value, or there are more than `usize::MAX` points.
    pub fn new(counts: Vec<usize>) -> Option<Self> {
        let count = counts.iter().try_fold(1_usize, |count, own| count.checked_mul(*own))?;
        (!counts.is_empty() && count > 0).then_some(Self { counts })
    }

    /// How many values each parameter takes.
    pub fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Number of points.
    #[expect(clippy::len_without_is_empty, reason = "a grid has a point at least")]
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Writes which value each parameter takes at a point.
    pub fn locate(&self, point: usize, places: &mut [usize]) {
        let mut rest = point;
        for (place, count) in places.iter_mut().zip(&self.counts).rev() {
            (*place, rest) = (rest % count, rest / count);
        }
    }

    /// Which value each parameter takes at a point.
    pub fn places(&self, point: usize) -> Vec<usize> {
        let mut places = vec![0; self.counts.len()];
        self.locate(point, &mut places);
        places
    }

    /// The point at which each parameter takes the value at this position; `None` where one has no such
    /// value.
    pub fn point(&self, places: &[usize]) -> Option<usize> {
        let is_one = places.len() == self.counts.len();
        let mut pairs = places.iter().zip(&self.counts);
        pairs
            .try_fold(0, |point, (place, count)| (place < count).then_some(point * count + place))
            .filter(|_| is_one)
    }

    /// The point at which one parameter takes a value, and all others their first one.
    pub fn on_axis(&self, axis: usize, place: usize) -> usize {
        place * self.counts[axis + 1..].iter().product::<usize>()
    }

    /// All points at which every parameter takes its first or its last value, rising.
    pub fn corners(&self) -> Vec<usize> {
        let mut corners = vec![0];
        for (axis, count) in self.counts.iter().enumerate() {
            let last = self.on_axis(axis, count - 1);
            if last > 0 {
                corners.extend(corners.clone().into_iter().map(|corner| corner + last));
            }
        }
        corners.sort_unstable();
        corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_parameter_varies_fastest() {
        let grid = Grid::new(vec![2, 3]).unwrap();
        let all: Vec<Vec<usize>> = (0..grid.len()).map(|at| grid.places(at)).collect();
        assert_eq!(all, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        assert!((0..grid.len()).all(|at| grid.point(&grid.places(at)) == Some(at)));
        assert!(grid.point(&[2, 0]).is_none() && grid.point(&[1]).is_none());
        assert_eq!(grid.corners(), [0, 2, 3, 5]);
        assert_eq!((grid.on_axis(0, 1), grid.on_axis(1, 2)), (3, 2));
        assert!(Grid::new(vec![2, 0]).is_none() && Grid::new(vec![]).is_none());
        assert!(Grid::new(vec![usize::MAX, 2]).is_none());
    }
}
