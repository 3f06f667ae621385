//! Outputs as piecewise polynomials, with a bound of the interpolation error that holds everywhere.

use std::{collections::BTreeMap, sync::Arc};

use dashpot_numerics::{chebyshev::Coefficients, two_sum};

use super::{
    Complex,
    block::{Block, size_of},
    coordinates::SpanCoordinates,
    modal_row::{ModalRow, coordinates_at, sizes_of},
    modes::Modes,
    tables::{COUNT, Course, LINKS, Line, Share, Tables, step_of, width_of},
};
use crate::Budget;

/// Part of the largest size that counts where the solution itself has decayed.
const FLOOR: f64 = 1e-2;
/// Most panels of a signal, so that no input can make it run for ever; the method declines before
/// that, and the error of a last panel that is too wide would be stated.
const MOST: usize = 4_000_000;
/// Narrowest panel, relative to its span.
const NARROWEST: f64 = 1e-18;

/// Rounding of a panel's borders and of a place within it, relative to the time.
const TIMING: f64 = f64::EPSILON;
/// Most steps by which a panel is wider than the one before.
const WIDER: i32 = 8;
/// Panels of a span up to which every other step will do: tables of few widths cost more than the panels saved.
const FEW: usize = 64;
/// Part of the tolerance that all modes which are left out may contribute.
const FAINT: f64 = 1e-4;

/// One polynomial of an output on `[start, end]`, dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    /// Where it begins.
    pub(super) start: f64,
    pub(super) end: f64,
    /// Its Chebyshev coefficients.
    pub(super) coefficients: Coefficients,
}

/// What is known about a piecewise polynomial as a whole.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Tally {
    /// Largest sum of the sizes of all terms: rounding is relative to it.
    pub(super) size: f64,
    /// Bound of the error.
    pub(super) error: f64,
    /// The same of the panels of a span, but for what the coordinates cause.
    worst: f64,
}

impl Tally {
    /// Takes in a panel at whose start the terms are of this size, which may be missed by so much, and at whose end
    /// rounding shifts the output by its rate.
    pub(super) fn add(&mut self, size: f64, missed: f64, (end, rate): (f64, f64)) {
        self.size = self.size.max(size);
        let missed = missed + TIMING * end * rate;
        self.worst = if missed.is_finite() { self.worst.max(missed) } else { f64::INFINITY };
    }

    /// Ends a span at a time, where the coordinates are of these sizes and have caused an error.
    pub(super) fn close(&mut self, row: &ModalRow, inherited: f64, (end, last): (f64, &[f64])) {
        self.size = self.size.max(row.size_at(last));
        let worst = self.worst.max(TIMING * end * row.rate_at(last));
        let error = inherited + worst;
        // Also where it is not a number: then nothing is known.
        self.error = if error.is_finite() { self.error.max(error) } else { f64::INFINITY };
        self.worst = 0.0;
    }
}

/// What a panel may miss of an output whose terms are of the size `local` at its start, and of the size `scale` at most.
pub(super) fn tolerance(local: f64, scale: f64) -> f64 {
    2.0 * f64::EPSILON * (local + FLOOR * scale)
}

/// Appends the output on `[start, start + length]`, a span whose coordinates are given, and updates the `tally`.
///
/// A panel of width `h` misses the solution by at most `4 (h/4)^n/n! · |g^(n)|`, `n = 17`; the derivative is bounded
/// mode by mode by `|r_j| |λ_j|^n |c_j|`, and no mode can contribute more than its own size. The widest of certain
/// widths is taken for which that is below the rounding errors.
pub(super) fn interpolate(
    row: &ModalRow,
    (modes, tables): (&Modes, &Tables),
    span: &SpanCoordinates,
    (start, length): (f64, f64),
    scale: f64,
    (tally, budget): (&mut Tally, &Budget),
    pieces: &mut Vec<Piece>,
) {
    let mut walk = Walk::new(row, (modes, tables), &span.start, length);
    let powers: u64 = modes.blocks.iter().map(|block| block.cost(length)).sum();
    loop {
        let local = row.size_at(&walk.sizes);
        let tolerance = tolerance(local, scale);
        let at = walk.at;
        budget.charge(powers);
        let is_over = budget.charge_step(modes.len());
        let most = if is_over || pieces.len() >= MOST {
            length - at
        } else {
            (NARROWEST * length).max(4.0 * f64::EPSILON * at)
        };
        let width = walk.widen(tolerance, most);
        tally.add(local, walk.missed, (start + at + width, row.rate_at(&walk.sizes)));
        let coefficients = trimmed(&walk.fit(), 0.1 * tolerance);
        walk.go_on();
        pieces.push(Piece { start: start + at, end: start + walk.at, coefficients });
        if walk.at >= length {
            break;
        }
    }
    // The sizes at the starts of all panels are known, and here that at the very end.
    let last = sizes_of(&coordinates_at(modes, &span.start, length));
    tally.close(row, row.error(modes, span), (start + length, &last));
}

/// The coefficients without the last ones, as long as their sum stays below `negligible`.
pub(super) fn trimmed(coefficients: &[f64], negligible: f64) -> Coefficients {
    let (mut dropped, mut count) = (0.0, coefficients.len());
    while count > 1 {
        dropped += coefficients[count - 1].abs();
        if dropped > negligible {
            break;
        }
        count -= 1;
    }
    coefficients[..count].into()
}

#[derive(Debug, Clone, Copy)]
enum Width {
    /// That of a step.
    Step(i32),
    /// Any other.
    Odd(f64),
}

/// A walk along a span, from the start of one panel to that of the next.
struct Walk<'m> {
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
    /// Where it is, from the start of the span.
    at: f64,
    coordinates: Vec<Complex>,
    /// Their sizes, but of those that have no part.
    sizes: Vec<f64>,
    /// The step of the widths that was taken last.
    step: Option<i32>,
    /// How many panels are behind it.
    panels: usize,
    /// Where the coordinates have been found by themselves, as those of a chain of panels.
    anchor: Option<Anchor>,
    width: Width,
    /// By how much the panel that begins here may miss the output.
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
    fn new(
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
            panels: 0,
            anchor: Some(Anchor { coordinates: start.to_vec(), step: None, links: 0 }),
            width: Width::Odd(length),
            missed: 0.0,
            faint: 0.0,
        };
        walk.measure();
        walk
    }

    /// Makes the panel that begins here as wide as is good to `tolerance`, but no narrower than `least`,
    /// and returns its width.
    fn widen(&mut self, tolerance: f64, least: f64) -> f64 {
        self.faint = FAINT * tolerance / self.start.len().max(1) as f64;
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
        let grain = if self.panels < FEW { 2 } else { 1 };
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
            let factor = (tolerance / missed).powf(1.0 / COUNT as f64);
            let factor = if factor > 0.1 { factor } else { 0.1 };
            above = step;
            step = step_of(factor * width).min(step - 1);
            step -= step.rem_euclid(grain);
            missed = self.missed_at(step);
        }
        while step + grain < above {
            let wider = self.missed_at(step + grain);
            if wider.is_nan() || wider > tolerance {
                break;
            }
            (step, missed) = (step + grain, wider);
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
    fn fit(&self) -> [f64; COUNT] {
        let step = match self.width {
            Width::Odd(width) => return self.row.fit(self.modes, &self.coordinates, width),
            Width::Step(step) => step,
        };
        let mut sum = [0.0; COUNT];
        let Some(line) = self.lines.get(&step) else { return sum };
        for (&at, share) in self.active.iter().zip(&line.shares) {
            let block = &self.modes.blocks[at];
            let range = block.range();
            let coordinates = &self.coordinates[range.clone()];
            match (share, line.table.course(self.modes, at)) {
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
        sum
    }

    /// Goes on to the start of the next panel, or to the end of the span.
    fn go_on(&mut self) {
        self.panels += 1;
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
        for number in 0..self.active.len() {
            let at = self.active[number];
            if let Some(link) = table.link(self.modes, at, anchor.links) {
                let mode = self.modes.blocks[at].start;
                self.coordinates[mode] = anchor.coordinates[mode] * link;
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
