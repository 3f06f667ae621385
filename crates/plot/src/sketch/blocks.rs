//! Series and parallel connections as nested blocks, in pixels or in characters alike.

use super::SketchTree;
use super::order::Extent;

/// Sizes that blocks are built with.
pub(super) struct Sizes<'a> {
    /// Extent of a single element.
    pub(super) leaf: &'a dyn Fn(&SketchTree) -> Extent,
    /// Vertical distance between branches.
    pub(super) gap: f64,
    /// Room at each end of a parallel connection for the wire that joins its branches.
    pub(super) rail: f64,
    /// Thickness of a wire: one character, or next to nothing.
    pub(super) wire: f64,
}

/// Where blocks are drawn to.
pub(super) trait Pen {
    /// A straight wire, both ends included.
    fn wire(&mut self, from: (f64, f64), to: (f64, f64));
    /// A single element with its left end at `at`.
    fn symbol(&mut self, leaf: &SketchTree, at: (f64, f64), extent: Extent);
}

impl Sizes<'_> {
    /// Extent of a whole tree around its connecting line.
    pub(super) fn extent(&self, tree: &SketchTree) -> Extent {
        match tree {
            SketchTree::Series(parts) if !parts.is_empty() => {
                let all = parts.iter().map(|part| self.extent(part));
                all.fold(Extent::default(), |sum, part| {
                    let (up, down) = (sum.up.max(part.up), sum.down.max(part.down));
                    Extent { width: sum.width + part.width, up, down }
                })
            }
            SketchTree::Parallel(branches) if !branches.is_empty() => {
                let (lines, extents) = self.branches(branches);
                let (first, last) = (lines[0], lines[lines.len() - 1]);
                let widest = extents.iter().map(|e| e.width).fold(0.0, f64::max);
                Extent {
                    width: widest + 2.0 * self.rail,
                    up: extents[0].up - first,
                    down: last + extents[extents.len() - 1].down,
                }
            }
            leaf => (self.leaf)(leaf),
        }
    }

    /// Heights of the branches' lines about the connecting line, which is in their middle, and their extents.
    fn branches(&self, branches: &[SketchTree]) -> (Vec<f64>, Vec<Extent>) {
        let extents: Vec<Extent> = branches.iter().map(|branch| self.extent(branch)).collect();
        let mut lines = vec![0.0];
        for pair in extents.windows(2) {
            let above = lines[lines.len() - 1];
            lines.push(above + pair[0].down + self.gap + pair[1].up);
        }
        let middle = (0.5 * lines[lines.len() - 1]).floor();
        (lines.into_iter().map(|line| line - middle).collect(), extents)
    }

    /// Draws a tree with its left end at `at`; `reversed` draws it from right to left.
    pub(super) fn draw(
        &self,
        tree: &SketchTree,
        at: (f64, f64),
        reversed: bool,
        pen: &mut dyn Pen,
    ) {
        let (x, y) = at;
        match tree {
            SketchTree::Series(parts) if !parts.is_empty() => {
                let mut end = x;
                let mut draw = |part: &SketchTree| {
                    if end > x {
                        pen.wire((end - self.wire, y), (end, y));
                    }
                    self.draw(part, (end, y), reversed, pen);
                    end += self.extent(part).width;
                };
                if reversed {
                    parts.iter().rev().for_each(&mut draw);
                } else {
                    parts.iter().for_each(&mut draw);
                }
            }
            SketchTree::Parallel(branches) if !branches.is_empty() => {
                let (lines, extents) = self.branches(branches);
                let (left, right) = (x, x + self.extent(tree).width - self.wire);
                for rail in [left, right] {
                    pen.wire((rail, y + lines[0]), (rail, y + lines[lines.len() - 1]));
                }
                for ((branch, line), extent) in branches.iter().zip(&lines).zip(&extents) {
                    let start = (0.5 * (left + right + self.wire - extent.width)).floor();
                    pen.wire((left, y + line), (start, y + line));
                    pen.wire((start + extent.width - self.wire, y + line), (right, y + line));
                    self.draw(branch, (start, y + line), reversed, pen);
                }
            }
            leaf => pen.symbol(leaf, at, (self.leaf)(leaf)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::tests::{dashpot, spring};

    fn sizes(leaf: &dyn Fn(&SketchTree) -> Extent) -> Sizes<'_> {
        Sizes { leaf, gap: 4.0, rail: 10.0, wire: 0.0 }
    }

    #[test]
    fn series_add_widths_and_parallels_add_heights() {
        let leaf = |_: &SketchTree| Extent { width: 50.0, up: 20.0, down: 10.0 };
        let pair = vec![spring("a"), dashpot("b")];
        let series = sizes(&leaf).extent(&SketchTree::Series(pair.clone()));
        assert_eq!(series, Extent { width: 100.0, up: 20.0, down: 10.0 });
        let parallel = sizes(&leaf).extent(&SketchTree::Parallel(pair));
        assert_eq!(parallel, Extent { width: 70.0, up: 37.0, down: 27.0 });
    }

    #[test]
    fn symbols_are_drawn_once_each_inside_the_extent() {
        struct Recorder(Vec<(f64, f64, Extent)>);
        impl Pen for Recorder {
            fn wire(&mut self, _: (f64, f64), _: (f64, f64)) {}
            fn symbol(&mut self, _: &SketchTree, at: (f64, f64), extent: Extent) {
                self.0.push((at.0, at.1, extent));
            }
        }
        let leaf = |_: &SketchTree| Extent { width: 50.0, up: 20.0, down: 10.0 };
        let branches =
            SketchTree::Parallel(vec![spring("a"), dashpot("b"), SketchTree::element("rigid", "")]);
        let tree = SketchTree::Series(vec![branches, spring("c")]);
        let sizes = sizes(&leaf);
        let whole = sizes.extent(&tree);
        for reversed in [false, true] {
            let mut recorder = Recorder(Vec::new());
            sizes.draw(&tree, (0.0, 0.0), reversed, &mut recorder);
            assert_eq!(recorder.0.len(), 4);
            for (x, y, extent) in recorder.0 {
                assert!(x >= 0.0 && x + extent.width <= whole.width);
                assert!(y - extent.up >= -whole.up && y + extent.down <= whole.down);
            }
        }
    }
}
