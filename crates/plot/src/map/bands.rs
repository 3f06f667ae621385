//! Bands of colour over a grid: regions in which values are above a level, by marching squares, and blocks where values
//! jump or are missing.

use std::collections::BTreeMap;

/// A corner of a region: a point of the grid, or a place between two neighbouring ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Corner {
    /// A point of the grid, as (column, row).
    Point(usize, usize),
    /// A place between a point and the next one of its row, or of its column where it `is_up`.
    Between(usize, usize, bool),
}

/// A step between neighbours that is a larger part of the range of colours than this, …
const JUMP: f64 = 0.12;
/// … and so many times as large as the steps beside it, is a jump.
const ABRUPT: f64 = 4.0;
/// Values are compared within the range of colours and this part of it around.
const AROUND: f64 = 0.25;

/// Values over a grid as parts of the range of colours, row by row, and between which of them they run smoothly.
#[derive(Debug, Clone)]
pub(super) struct Field {
    shares: Vec<f64>,
    columns: usize,
    rows: usize,
    /// Per square between four points whether they are all known and no step along its sides is a jump.
    smooth: Vec<bool>,
}

impl Field {
    /// `shares` have `columns` in each row; what is not finite is missing.
    pub(super) fn new(shares: Vec<f64>, columns: usize) -> Self {
        Self::with(shares, columns, |field, (i, j)| {
            let sides = [(i, j, false), (i, j + 1, false), (i, j, true), (i + 1, j, true)];
            !sides.into_iter().any(|(column, row, is_up)| field.jumps((column, row), is_up))
        })
    }

    /// The same where no step counts as a jump.
    pub(super) fn whole(shares: Vec<f64>, columns: usize) -> Self {
        Self::with(shares, columns, |_, _| true)
    }

    fn with(
        shares: Vec<f64>,
        columns: usize,
        is_even: impl Fn(&Self, (usize, usize)) -> bool,
    ) -> Self {
        let rows = shares.len().checked_div(columns).unwrap_or(0);
        let field = Self { shares, columns, rows, smooth: Vec::new() };
        let is_known = |own| corners(own).iter().all(|own| field.at(*own).is_finite());
        let smooth = field.squares().map(|own| is_known(own) && is_even(&field, own)).collect();
        Self { smooth, ..field }
    }

    /// The lowest corners of all squares, row by row.
    fn squares(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (columns, rows) = (self.columns.saturating_sub(1), self.rows.saturating_sub(1));
        (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
    }

    /// The value at a point; beyond the grid none.
    pub(super) fn at(&self, (column, row): (usize, usize)) -> f64 {
        if column < self.columns && row < self.rows {
            self.shares[row * self.columns + column]
        } else {
            f64::NAN
        }
    }

    /// Whether values jump from a point to the next one of its row, or of its column.
    fn jumps(&self, (column, row): (usize, usize), is_up: bool) -> bool {
        let at = |steps: isize| {
            let (dx, dy) = if is_up { (0, steps) } else { (steps, 0) };
            match (column.checked_add_signed(dx), row.checked_add_signed(dy)) {
                (Some(column), Some(row)) => self.at((column, row)).clamp(-AROUND, 1.0 + AROUND),
                _ => f64::NAN,
            }
        };
        let step = (at(1) - at(0)).abs();
        let beside = [at(0) - at(-1), at(2) - at(1)].map(f64::abs);
        let largest = beside.into_iter().filter(|own| own.is_finite()).reduce(f64::max);
        step > JUMP && largest.is_some_and(|largest| step > ABRUPT * largest)
    }

    /// Whether values run smoothly in the square whose lowest corner is this point.
    pub(super) fn is_smooth(&self, (column, row): (usize, usize)) -> bool {
        column + 1 < self.columns
            && row + 1 < self.rows
            && self.smooth[row * (self.columns - 1) + column]
    }

    /// The quarters of squares that are no part of a band: a point, and the middle of the square as
    /// (column, row) in steps of the grid.
    pub(super) fn blocks(&self) -> Vec<((usize, usize), (f64, f64))> {
        let rough = self.squares().filter(|own| !self.is_smooth(*own));
        let of_square = |(i, j): (usize, usize)| {
            let known = corners((i, j)).into_iter().filter(|own| self.at(*own).is_finite());
            known.map(move |own| (own, (i as f64 + 0.5, j as f64 + 0.5)))
        };
        rough.flat_map(of_square).collect()
    }

    /// The outlines of where values are at least `level` and run smoothly, as places in steps of the grid; each ends
    /// where it begins. Values run straight along the sides of squares.
    pub(super) fn region(&self, level: f64) -> Vec<Vec<(f64, f64)>> {
        let mut steps: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
        let smooth = self.squares().filter(|own| self.is_smooth(*own));
        for outline in smooth.flat_map(|own| self.within(own, level)) {
            for at in 0..outline.len() {
                walk(&mut steps, outline[at], outline[(at + 1) % outline.len()]);
            }
        }
        let mut outlines = Vec::new();
        while let Some(start) = steps.iter().find(|own| !own.1.is_empty()).map(|own| *own.0) {
            let mut outline = vec![self.place(start, level)];
            let mut last = start;
            while let Some(next) = steps.get_mut(&last).and_then(Vec::pop) {
                outline.push(self.place(next, level));
                last = next;
                if last == start {
                    break;
                }
            }
            steps.retain(|_, next| !next.is_empty());
            outlines.push(outline);
        }
        outlines
    }

    /// The parts of one square in which values are at least `level`, each run around in the same sense.
    fn within(&self, (i, j): (usize, usize), level: f64) -> Vec<Vec<Corner>> {
        let points = corners((i, j));
        let sides = [(i, j, false), (i + 1, j, true), (i, j + 1, false), (i, j, true)];
        let values = points.map(|own| self.at(own));
        let above = values.map(|own| own >= level);
        let mut corners = Vec::new();
        for k in 0..4 {
            if above[k] {
                corners.push(Corner::Point(points[k].0, points[k].1));
            }
            if above[k] != above[(k + 1) % 4] {
                corners.push(Corner::Between(sides[k].0, sides[k].1, sides[k].2));
            }
        }
        let is_middle_below = 0.25 * values.iter().sum::<f64>() < level;
        let is_saddle = above[0] == above[2] && above[1] == above[3] && above[0] != above[1];
        if corners.is_empty() {
            return Vec::new();
        }
        if is_saddle && is_middle_below {
            // Two corners that the middle parts: each is a triangle with the places on both of its sides.
            corners.rotate_left(if above[0] { 5 } else { 0 });
            return corners.chunks(3).map(<[Corner]>::to_vec).collect();
        }
        vec![corners]
    }

    fn place(&self, corner: Corner, level: f64) -> (f64, f64) {
        match corner {
            Corner::Point(column, row) => (column as f64, row as f64),
            Corner::Between(column, row, is_up) => {
                let next = if is_up { (column, row + 1) } else { (column + 1, row) };
                let (one, other) = (self.at((column, row)), self.at(next));
                let share = ((level - one) / (other - one)).clamp(0.0, 1.0);
                let (x, y) = (column as f64, row as f64);
                if is_up { (x, y + share) } else { (x + share, y) }
            }
        }
    }
}

/// The corners of the square whose lowest one this is, around it.
fn corners((i, j): (usize, usize)) -> [(usize, usize); 4] {
    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
}

/// Takes a step along an outline, which a step the other way, of the square beside, takes back.
fn walk(steps: &mut BTreeMap<Corner, Vec<Corner>>, from: Corner, to: Corner) {
    if let Some(back) = steps.get_mut(&to)
        && let Some(at) = back.iter().position(|own| *own == from)
    {
        back.swap_remove(at);
        return;
    }
    steps.entry(from).or_default().push(to);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area within outlines, by the shoelace formula.
    fn area(outlines: &[Vec<(f64, f64)>]) -> f64 {
        let twice = outlines.iter().flat_map(|own| own.windows(2));
        0.5 * twice.map(|pair| pair[0].0 * pair[1].1 - pair[1].0 * pair[0].1).sum::<f64>()
    }

    fn field(columns: usize, rows: usize, value: impl Fn(f64, f64) -> f64) -> Field {
        let row = |j: usize| (0..columns).map(move |i| (i as f64, j as f64));
        let values = (0..rows).flat_map(row).map(|(x, y)| value(x, y)).collect();
        Field::new(values, columns)
    }

    #[test]
    fn a_region_of_a_slope_has_its_area_and_one_outline() {
        let field = field(11, 6, |x, _| 0.1 * x);
        for level in [-1.0, 0.0, 0.123, 0.5, 0.77] {
            let outlines = field.region(level);
            assert_eq!(outlines.len(), 1, "{level}");
            let wide = 10.0 - 10.0 * level.max(0.0);
            assert!((area(&outlines) - 5.0 * wide).abs() < 1e-12, "{level}");
        }
        assert!(field.region(1.1).is_empty() && field.blocks().is_empty());
    }

    #[test]
    fn regions_of_a_bowl_have_the_areas_of_their_circles() {
        let field = field(61, 61, |x, y| 1.0 - ((x - 30.0).powi(2) + (y - 30.0).powi(2)) / 900.0);
        for level in [0.2, 0.5, 0.9] {
            let circle = std::f64::consts::PI * 900.0 * (1.0 - level);
            // Chords lie within arcs by (step²/8r) of the radius r.
            let own = area(&field.region(level));
            assert!((own - circle).abs() < 0.02 * circle, "{own} {circle}");
        }
    }

    #[test]
    fn saddles_are_parted_or_joined_by_their_middle() {
        let values = [1.0, 0.0, 0.0, 1.0];
        let own = Field { smooth: vec![true], ..Field::new(values.to_vec(), 2) };
        assert_eq!(own.region(0.6).len(), 2);
        assert_eq!(own.region(0.4).len(), 1);
        let turned = Field { smooth: vec![true], ..Field::new(vec![0.0, 1.0, 1.0, 0.0], 2) };
        for (own, level) in [(&own, 0.6), (&turned, 0.6)] {
            assert!((area(&own.region(level)) - 2.0 * 0.5 * 0.4 * 0.4).abs() < 1e-12);
        }
        assert!((area(&own.region(0.4)) - (1.0 - 2.0 * 0.5 * 0.4 * 0.4)).abs() < 1e-12);
    }

    #[test]
    fn jumps_and_gaps_are_blocks() {
        let jump = field(8, 4, |x, _| if x < 3.5 { 0.1 + 0.01 * x } else { 0.9 + 0.01 * x });
        // The squares of one column, of four quarters each.
        assert_eq!(jump.blocks().len(), 3 * 4);
        assert!((area(&jump.region(-1.0)) - 6.0 * 3.0).abs() < 1e-12);
        let gap = field(8, 4, |x, y| if (x, y) == (3.0, 1.0) { f64::NAN } else { 0.1 * x });
        assert_eq!(gap.blocks().len(), 4 * 3);
        assert!((area(&gap.region(-1.0)) - (21.0 - 4.0)).abs() < 1e-12);
        let steep = field(8, 4, |x, _| (0.6 * x).exp() / 70.0);
        assert!(steep.blocks().is_empty(), "steep but smooth");
    }

    #[test]
    fn nothing_and_single_rows_have_no_regions() {
        for own in [Field::new(vec![], 0), Field::new(vec![1.0; 3], 3), Field::new(vec![1.0], 1)] {
            assert!(own.region(0.0).is_empty() && own.blocks().is_empty());
        }
    }
}
