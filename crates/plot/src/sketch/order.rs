//! Vertical places in columns: who stands above whom, and where.

/// Extent of a box above and below its connecting line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Extent {
    pub(super) width: f64,
    pub(super) up: f64,
    pub(super) down: f64,
}

/// Something in a column that keeps its room: a node, a link, or a wire passing through.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Vertex {
    pub(super) column: usize,
    pub(super) extent: Extent,
    /// Vertices in the columns beside that it is wired to.
    pub(super) left: Vec<usize>,
    pub(super) right: Vec<usize>,
}

/// Sweeps over the columns; orders and places settle after a few.
const SWEEPS: usize = 12;

/// Heights of the connecting lines, whole numbers growing downwards from 0 at the top edge; boxes of one column are
/// at least `gap` apart.
pub(super) fn heights(vertices: &[Vertex], gap: f64) -> Vec<f64> {
    let mut columns = by_column(vertices);
    for sweep in 0..SWEEPS {
        sort_by_neighbours(vertices, &mut columns, sweep % 2 == 0);
    }
    let mut heights = vec![0.0; vertices.len()];
    for column in &columns {
        settle(vertices, column, &vec![0.0; column.len()], gap, &mut heights);
    }
    for sweep in 0..SWEEPS {
        let from_left = sweep % 2 == 0;
        let count = columns.len();
        for step in 0..count {
            let column = &columns[if from_left { step } else { count - 1 - step }];
            // Towards one side while things move, towards both in the end.
            let is_late = sweep + 2 >= SWEEPS;
            let wish = |v: &usize| {
                let left = vertices[*v].left.iter().filter(|_| from_left || is_late);
                let right = vertices[*v].right.iter().filter(|_| !from_left || is_late);
                mean(left.chain(right).map(|n| heights[*n])).unwrap_or(heights[*v])
            };
            let wishes: Vec<f64> = column.iter().map(wish).collect();
            settle(vertices, column, &wishes, gap, &mut heights);
        }
    }
    straighten(vertices, &columns, gap, &mut heights);
    let top =
        vertices.iter().zip(&heights).map(|(v, h)| h - v.extent.up).fold(f64::INFINITY, f64::min);
    heights.iter().map(|h| h - top).collect()
}

/// Takes small steps out of wires: moves what has one neighbour to its height, and what has several to a near one,
/// where the column has room.
fn straighten(vertices: &[Vertex], columns: &[Vec<usize>], gap: f64, heights: &mut [f64]) {
    for pass in 0..4 {
        let from_left = pass % 2 == 0;
        for step in 0..columns.len() {
            let column = &columns[if from_left { step } else { columns.len() - 1 - step }];
            for (place, v) in column.iter().enumerate() {
                let vertex = &vertices[*v];
                let (behind, ahead) = if from_left {
                    (&vertex.left, &vertex.right)
                } else {
                    (&vertex.right, &vertex.left)
                };
                let step_to = |n: &usize| (heights[*n] - heights[*v]).abs();
                let is_straight = |side: &[usize]| side.iter().any(|n| step_to(n) < 0.25);
                let all = behind.iter().chain(ahead);
                let target = match behind[..] {
                    [only] if from_left || !is_straight(ahead) => Some(only),
                    _ if is_straight(behind) || is_straight(ahead) => None,
                    _ => all
                        .filter(|n| step_to(n) < vertex.extent.up.min(vertex.extent.down).max(1.5))
                        .min_by(|a, b| step_to(a).total_cmp(&step_to(b)))
                        .copied(),
                };
                let Some(height) = target.map(|n| heights[n]) else { continue };
                let above = place.checked_sub(1).map(|i| column[i]);
                let below = column.get(place + 1);
                let fits_above = above.is_none_or(|a| {
                    heights[a] + vertices[a].extent.down + gap + vertex.extent.up <= height
                });
                let fits_below = below.is_none_or(|b| {
                    height + vertex.extent.down + gap + vertices[*b].extent.up <= heights[*b]
                });
                if fits_above && fits_below {
                    heights[*v] = height;
                }
            }
        }
    }
}

fn by_column(vertices: &[Vertex]) -> Vec<Vec<usize>> {
    let count = vertices.iter().map(|v| v.column + 1).max().unwrap_or(0);
    let mut columns = vec![Vec::new(); count];
    for (index, vertex) in vertices.iter().enumerate() {
        columns[vertex.column].push(index);
    }
    columns
}

/// Orders each column by the mean place of the neighbours in the column before it, which lets few wires cross.
fn sort_by_neighbours(vertices: &[Vertex], columns: &mut [Vec<usize>], from_left: bool) {
    let mut place = vec![0.0; vertices.len()];
    let count = columns.len();
    for step in 0..count {
        let index = if from_left { step } else { count - 1 - step };
        let column = &mut columns[index];
        let key = |(own, v): (usize, &usize)| {
            let neighbours = if from_left { &vertices[*v].left } else { &vertices[*v].right };
            (mean(neighbours.iter().map(|n| place[*n])).unwrap_or(own as f64), *v)
        };
        let mut keyed: Vec<(f64, usize)> = column.iter().enumerate().map(key).collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
        *column = keyed.into_iter().map(|(_, v)| v).collect();
        for (position, v) in column.iter().enumerate() {
            place[*v] = position as f64;
        }
    }
}

/// Places a column as near to the `wishes` as its boxes allow: least squares under the distances between neighbours,
/// solved by pooling neighbours that want to pass each other.
fn settle(vertices: &[Vertex], column: &[usize], wishes: &[f64], gap: f64, heights: &mut [f64]) {
    let mut offsets = Vec::with_capacity(column.len());
    let mut offset = 0.0;
    for (i, v) in column.iter().enumerate() {
        if i > 0 {
            offset += vertices[column[i - 1]].extent.down + gap + vertices[*v].extent.up;
        }
        offsets.push(offset);
    }
    let mut pools: Vec<(f64, f64)> = Vec::new();
    for (wish, offset) in wishes.iter().zip(&offsets) {
        let mut pool = (wish - offset, 1.0);
        while let Some(above) = pools.pop_if(|above| above.0 > pool.0) {
            pool = ((above.0 * above.1 + pool.0 * pool.1) / (above.1 + pool.1), above.1 + pool.1);
        }
        pools.push(pool);
    }
    // Rounding keeps the order of the pools, so the distances stay.
    let places = pools.iter().flat_map(|(place, size)| repeated(place.round(), *size));
    for ((v, offset), place) in column.iter().zip(&offsets).zip(places) {
        heights[*v] = place + offset;
    }
}

fn repeated(value: f64, times: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(1.0), |n| Some(n + 1.0))
        .take_while(move |n| *n <= times)
        .map(move |_| value)
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(column: usize, left: &[usize], right: &[usize]) -> Vertex {
        let extent = Extent { width: 1.0, up: 3.0, down: 2.0 };
        Vertex { column, extent, left: left.to_vec(), right: right.to_vec() }
    }

    #[test]
    fn a_chain_is_straight() {
        let chain = [vertex(0, &[], &[1]), vertex(1, &[0], &[2]), vertex(2, &[1], &[])];
        assert_eq!(heights(&chain, 1.0), [3.0, 3.0, 3.0]);
    }

    #[test]
    fn a_wire_beside_a_branch_has_no_small_steps() {
        let mut fork = vec![
            vertex(0, &[], &[1, 2]),
            vertex(1, &[0], &[3]),
            vertex(1, &[0], &[]),
            vertex(2, &[1], &[4]),
            vertex(3, &[3], &[]),
        ];
        fork[3].extent.up = 9.0;
        let heights = heights(&fork, 1.0);
        assert!((heights[1] - heights[3]).abs() + (heights[3] - heights[4]).abs() < 1e-12);
    }

    #[test]
    fn branches_stand_apart_and_around_their_ends() {
        let fork = [
            vertex(0, &[], &[1, 2]),
            vertex(1, &[0], &[3]),
            vertex(1, &[0], &[3]),
            vertex(2, &[1, 2], &[]),
        ];
        let heights = heights(&fork, 1.0);
        assert!((heights[2] - heights[1] - 6.0).abs() < 1e-12, "{heights:?}");
        assert!(heights[1] < heights[0] && heights[0] < heights[2], "{heights:?}");
    }
}
