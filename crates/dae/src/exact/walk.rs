//! From panel to panel along an output.

use std::{collections::BTreeMap, sync::Arc};

use dashpot_twofold::two_sum;

use super::{
    Complex,
    block::Block,
    modes::Modes,
    number,
    panels::{ModalRow, size_of},
    shares::{Line, Share},
    tables::{COUNT, Course, LINKS, Tables, step_of, width_of},
};

/// Most steps by which a panel is wider than the one before.
const WIDER: i32 = 8;
/// Part of the tolerance that all modes which are left out may contribute.
const FAINT: f64 = 1e-4;

/// The width of a panel.
#[derive(Debug, Clone, Copy)]
enum Width {
    /// That of a step.
    Step(i32),
    /// Any other.
    Odd(f64),
}

/// A walk along a span, from the start of one panel to that of the next.
pub(super) struct Walk<'m> {
    row: &'m ModalRow,
    modes: &'m Modes,
    tables: &'m Tables,
    /// The coordinates at the start of the span.
    start: &'m [Complex],
    /// The length of the span.
    length: f64,
    /// Numbers of the blocks that have a part in the output.
    active: Vec<usize>,
    lines: BTreeMap<i32, Line>,
    /// Where it is.
    at: f64,
    /// The coordinates there.
    coordinates: Vec<Complex>,
    sizes: Vec<f64>,
    /// The step of the widths that was taken last.
    step: Option<i32>,
    /// Where the coordinates have been found by themselves, as those of a chain of panels.
    anchor: Option<Anchor>,
    width: Width,
    missed: f64,
    /// Size below which a mode is left out.
    faint: f64,
}

/// The start of a chain of panels of one width.
struct Anchor {
    coordinates: Vec<Complex>,
    /// Step of the width, once there is a panel.
    step: Option<i32>,
    /// How many panels there are.
    links: usize,
}

impl<'m> Walk<'m> {
    /// A walk along a span of which the coordinates at the start are given.
    pub(super) fn new(
        row: &'m ModalRow,
        (modes, tables): (&'m Modes, &'m Tables),
        start: &'m [Complex],
        length: f64,
    ) -> Self {
        let is_active = |block: &Block| row.has_part(block) && block.moves(start);
        let active = (0..modes.blocks.len()).filter(|&at| is_active(&modes.blocks[at]));
        let mut walk = Self {
            row,
            modes,
            tables,
            start,
            length,
            active: active.collect(),
            lines: BTreeMap::new(),
            at: 0.0,
            coordinates: start.to_vec(),
            sizes: vec![0.0; start.len()],
            step: None,
            anchor: Some(Anchor { coordinates: start.to_vec(), step: None, links: 0 }),
            width: Width::Odd(length),
            missed: 0.0,
            faint: 0.0,
        };
        walk.measure();
        walk
    }

    /// Where it is, from the start of the span.
    pub(super) fn at(&self) -> f64 {
        self.at
    }

    /// The sizes of the modal coordinates there, but of those that have no part.
    pub(super) fn sizes(&self) -> &[f64] {
        &self.sizes
    }

    /// By how much the panel that begins here may miss the output.
    pub(super) fn missed(&self) -> f64 {
        self.missed
    }

    /// Makes the panel that begins here as wide as is good to `tolerance`, but no narrower than `least`,
    /// and returns its width.
    pub(super) fn widen(&mut self, tolerance: f64, least: f64) -> f64 {
        self.faint = FAINT * tolerance / number(self.start.len().max(1));
        let remaining = self.length - self.at;
        let least = least.min(remaining);
        (self.width, self.missed) = self.widest(tolerance, (least, remaining));
        match self.width {
            Width::Step(step) => {
                self.step = Some(step);
                self.missed += FAINT * tolerance;
                width_of(step)
            }
            Width::Odd(width) => width,
        }
    }

    fn widest(&mut self, tolerance: f64, (least, remaining): (f64, f64)) -> (Width, f64) {
        if self.step.is_none() || least >= remaining {
            let missed = self.row.missed(self.modes, &self.sizes, remaining);
            if missed <= tolerance || least >= remaining {
                return (Width::Odd(remaining), missed);
            }
        }
        let most = step_of(remaining);
        let mut step = self.step.unwrap_or(most).min(most);
        let mut above = most.min(step.saturating_add(WIDER)).saturating_add(1);
        let mut missed = self.missed_at(step);
        // What is not a number is too much.
        while missed.is_nan() || missed > tolerance {
            let width = width_of(step);
            if width <= least {
                return (Width::Odd(least), self.row.missed(self.modes, &self.sizes, least));
            }
            let factor = (tolerance / missed).powf(1.0 / number(COUNT));
            let factor = if factor > 0.1 { factor } else { 0.1 };
            above = step;
            step = step_of(factor * width).min(step - 1);
            missed = self.missed_at(step);
        }
        while step + 1 < above {
            let wider = self.missed_at(step + 1);
            if wider.is_nan() || wider > tolerance {
                break;
            }
            (step, missed) = (step + 1, wider);
        }
        let width = width_of(step);
        if width >= remaining {
            (Width::Odd(remaining), missed)
        } else if width < least {
            (Width::Odd(least), self.row.missed(self.modes, &self.sizes, least))
        } else {
            (Width::Step(step), missed)
        }
    }

    /// By how much a panel of the width of this step may miss the output.
    fn missed_at(&mut self, step: i32) -> f64 {
        self.line(step);
        let Some(line) = self.lines.get(&step) else { return f64::INFINITY };
        let part = |(&at, share): (&usize, &Share)| {
            let block = &self.modes.blocks[at];
            let sizes = &self.sizes[block.range()];
            match share {
                Share::Single(weight) => weight * sizes[0],
                Share::Cluster(cluster) => cluster.missed(sizes),
                Share::Apart => self.row.missed_of(block, sizes, line.table.width),
            }
        };
        self.active.iter().zip(&line.shares).map(part).sum()
    }

    fn line(&mut self, step: i32) {
        let (row, modes, active) = (self.row, self.modes, &self.active);
        let tables = self.tables;
        self.lines.entry(step).or_insert_with(|| {
            let table = tables.at(modes, step);
            let share = |&at: &usize| {
                let range = modes.blocks[at].range();
                Share::new(row.sizes_in(range), &table.bounds[at])
            };
            Line { shares: active.iter().map(share).collect(), table }
        });
    }

    /// The interpolating polynomial on the panel.
    pub(super) fn fit(&self) -> Vec<f64> {
        let step = match self.width {
            Width::Odd(width) => return self.row.fit(self.modes, &self.coordinates, width),
            Width::Step(step) => step,
        };
        let mut sum = [0.0; COUNT];
        let Some(line) = self.lines.get(&step) else { return sum.to_vec() };
        let courses = line.table.courses(self.modes);
        for (&at, share) in self.active.iter().zip(&line.shares) {
            let block = &self.modes.blocks[at];
            let range = block.range();
            let coordinates = &self.coordinates[range.clone()];
            match (share, &courses[at]) {
                (Share::Single(_), Course::Single { shape, .. }) => {
                    let is_faint = block.matrix[(0, 0)].re <= 0.0
                        && self.row.sizes_in(range)[0] * self.sizes[block.start] <= self.faint;
                    if !is_faint {
                        let factor = self.row.factors_in(block.range())[0];
                        shape.add_to(factor * coordinates[0], &mut sum);
                    }
                }
                (Share::Cluster(cluster), Course::Cluster(columns)) => {
                    let factors = self.row.factors_in(range);
                    let shapes = cluster.shapes(factors, columns);
                    for (shape, &coordinate) in shapes.iter().zip(coordinates) {
                        shape.add_to(coordinate, &mut sum);
                    }
                }
                _ => {
                    let apart = self.row.fit_block(block, coordinates, line.table.width);
                    sum.iter_mut().zip(apart).for_each(|(sum, own)| *sum += own);
                }
            }
        }
        sum.to_vec()
    }

    /// Goes on to the start of the next panel, or to the end of the span.
    pub(super) fn go_on(&mut self) {
        let before = self.at;
        let (width, step) = match self.width {
            Width::Odd(width) if width >= self.length - before => {
                self.at = self.length;
                return;
            }
            Width::Odd(width) => (width, None),
            Width::Step(step) => (width_of(step), Some(step)),
        };
        let (at, lost) = two_sum(before, width);
        self.at = at.min(self.length);
        if self.at >= self.length {
            return;
        }
        let is_linked = lost == 0.0 && step.is_some_and(|step| self.link(step));
        if !is_linked {
            for number in 0..self.active.len() {
                self.begin(self.active[number]);
            }
            let coordinates = self.coordinates.clone();
            self.anchor = Some(Anchor { coordinates, step: None, links: 0 });
        }
        self.measure();
    }

    /// The coordinates of a block where it is, from those at the start of the span.
    fn begin(&mut self, at: usize) {
        let block = &self.modes.blocks[at];
        let own = &mut self.coordinates[block.range()];
        own.copy_from_slice(&self.start[block.range()]);
        block.advance(self.at, own);
    }

    /// Finds the coordinates from those of the chain's start, if the panel belongs to the chain and that
    /// is not too long.
    fn link(&mut self, step: i32) -> bool {
        let Some(mut anchor) = self.anchor.take() else { return false };
        if anchor.step.is_some_and(|own| own != step) || anchor.links >= LINKS {
            return false;
        }
        let Some(line) = self.lines.get(&step) else { return false };
        let table = Arc::clone(&line.table);
        let courses = table.courses(self.modes);
        for number in 0..self.active.len() {
            let at = self.active[number];
            if let Course::Single { links, .. } = &courses[at] {
                let mode = self.modes.blocks[at].start;
                self.coordinates[mode] = anchor.coordinates[mode] * links[anchor.links];
            } else {
                self.begin(at);
            }
        }
        (anchor.step, anchor.links) = (Some(step), anchor.links + 1);
        self.anchor = Some(anchor);
        true
    }

    fn measure(&mut self) {
        for &at in &self.active {
            let range = self.modes.blocks[at].range();
            let both = self.sizes[range.clone()].iter_mut().zip(&self.coordinates[range]);
            both.for_each(|(size, coordinate)| *size = size_of(*coordinate));
        }
    }
}
