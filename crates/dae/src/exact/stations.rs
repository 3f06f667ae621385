//! Panels that outputs share: what the modes do on them is found once, and an output adds it up.

use std::sync::Arc;

use dashpot_numerics::chebyshev::Interpolation;

use super::{
    Complex,
    block::{Block, exponential_of},
    coordinates::SpanCoordinates,
    modal_row::{ModalRow, coordinates_at, sizes_of},
    modes::Modes,
    panels::{Piece, Tally, tolerance, trimmed},
    tables::{Bounds, COUNT, DEGREE, Shape, is_told},
};
use crate::Budget;

/// Most modes of a system whose outputs share panels: with many, few outputs need what the others do.
pub(super) const MOST_MODES: usize = 16;
/// Most spans of a run whose panels are shared, as these are kept.
pub(super) const MOST_SPANS: usize = 64;
/// Most panels of a span that are shared.
const MOST: usize = 64;
/// By how much a panel may be wider than the one before, and part of the width that its bound allows.
const WIDER: f64 = 4.0;
const SAFETY: f64 = 0.98;
/// Widths that are tried for a panel.
const TRIALS: usize = 40;

/// The modal form of an output, and the largest size of its terms.
pub(super) type Told<'r> = (&'r ModalRow, f64);

/// All outputs, and panels of each span that are good for all of them.
#[derive(Debug)]
pub(super) struct Common {
    pub(super) rows: Arc<[ModalRow]>,
    /// For each the largest size of its terms.
    pub(super) scales: Vec<f64>,
    pub(super) spans: Vec<Stations>,
}

/// Panels of a span.
#[derive(Debug)]
pub(super) struct Stations {
    all: Vec<Station>,
    /// The sizes of the coordinates at the end of the span.
    last: Vec<f64>,
}

/// A panel.
#[derive(Debug)]
struct Station {
    start: f64,
    end: f64,
    /// The sizes of the coordinates at its start.
    sizes: Vec<f64>,
    /// What bounds the interpolation error, by block.
    bounds: Vec<Bounds>,
    /// What each coordinate does.
    curves: Vec<Shape>,
}

impl Stations {
    /// Panels of a span of some length, as wide as is good for all of these rows; `None` where they would be
    /// many, or nothing bounds their errors.
    pub(super) fn of(
        (modes, budget): (&Modes, &Budget),
        start: &[Complex],
        length: f64,
        rows: &[Told<'_>],
    ) -> Option<Self> {
        let is_moving = |block: &Block| block.weight > 0.0 && block.moves(start);
        let is_bounded = |block| !is_moving(block) || is_told(block);
        if length == 0.0 || !modes.blocks.iter().all(is_bounded) {
            return None;
        }
        let bounds_at = |width: f64| -> Vec<Bounds> {
            let own =
                |block| if is_moving(block) { Bounds::of(block, width) } else { Bounds::None };
            modes.blocks.iter().map(own).collect()
        };
        let powers: u64 = modes.blocks.iter().map(|block| block.cost(length)).sum();
        let (mut all, mut at, mut width) = (Vec::new(), 0.0, length);
        while at < length && all.len() < MOST {
            let coordinates = coordinates_at(modes, start, at);
            let sizes = sizes_of(&coordinates);
            let mut trials = 0;
            let (bounds, excess) = loop {
                let bounds = bounds_at(width);
                let excess = |(row, scale): &Told<'_>| {
                    let missed = row.missed_within(modes, &bounds, &sizes);
                    excess_of(missed, tolerance(row.size_at(&sizes), *scale))
                };
                let excess = rows.iter().map(excess).fold(0.0, f64::max);
                if excess <= 1.0 {
                    break (bounds, excess);
                }
                trials += 1;
                if trials == TRIALS || budget.charge_step(modes.len()) {
                    return None;
                }
                width *= factor(excess).max(1.0 / WIDER);
            };
            if budget.charge(powers) || budget.charge_step(modes.len()) {
                return None;
            }
            let end = if width < length - at { at + width } else { length };
            let curves = curves(modes, &coordinates, end - at);
            all.push(Station { start: at, end, sizes, bounds, curves });
            (at, width) = (end, (width * factor(excess).min(WIDER)).min(length - end));
        }
        let last = sizes_of(&coordinates_at(modes, start, length));
        (at >= length).then_some(Self { all, last })
    }

    /// Appends an output on the span, which begins at a time, as [`interpolate`](super::panels::interpolate);
    /// `None`, and nothing, where these panels are too wide for it.
    pub(super) fn interpolate(
        &self,
        (row, scale): Told<'_>,
        modes: &Modes,
        (span, start): (&SpanCoordinates, f64),
        tally: &mut Tally,
        pieces: &mut Vec<Piece>,
    ) -> Option<()> {
        let mut own = *tally;
        let before = pieces.len();
        for station in &self.all {
            let local = row.size_at(&station.sizes);
            let tolerance = tolerance(local, scale);
            let missed = row.missed_within(modes, &station.bounds, &station.sizes);
            if excess_of(missed, tolerance) > 1.0 {
                pieces.truncate(before);
                return None;
            }
            let end = start + station.end;
            own.add(local, missed, (end, row.rate_at(&station.sizes)));
            let mut sum = [0.0; COUNT];
            for block in modes.blocks.iter().filter(|block| row.has_part(block)) {
                let factors = row.factors_in(block.range());
                let curves = &station.curves[block.range()];
                curves.iter().zip(factors).for_each(|(curve, &own)| curve.add_to(own, &mut sum));
            }
            let coefficients = trimmed(&sum, 0.1 * tolerance);
            pieces.push(Piece { start: start + station.start, end, coefficients });
        }
        let end = start + self.all.last().map_or(0.0, |last| last.end);
        own.close(row, row.error(modes, span), (end, &self.last));
        *tally = own;
        Some(())
    }
}

/// What is missed in parts of what may be.
fn excess_of(missed: f64, tolerance: f64) -> f64 {
    match missed / tolerance {
        _ if missed == 0.0 => 0.0,
        own if own.is_nan() => f64::INFINITY,
        own => own,
    }
}

/// What a width may be multiplied by where the error is so much of what it may be.
fn factor(excess: f64) -> f64 {
    SAFETY * excess.powf(-1.0 / COUNT as f64)
}

/// What each coordinate does on a panel of this width at whose start they are given.
fn curves(modes: &Modes, coordinates: &[Complex], width: f64) -> Vec<Shape> {
    let nodes = Interpolation::of_degree(DEGREE);
    let mut all = vec![Shape::ZERO; coordinates.len()];
    let moving = |block: &&Block| block.weight > 0.0 && block.moves(coordinates);
    for block in modes.blocks.iter().filter(moving) {
        let times = nodes.nodes().iter().map(|x| 0.5 * width * (1.0 + x));
        let own = &coordinates[block.range()];
        let mut values = vec![[Complex::default(); COUNT]; own.len()];
        if let ([own], [values]) = (own, values.as_mut_slice()) {
            let (high, low) = (block.matrix[(0, 0)], block.low[(0, 0)]);
            let all = values.iter_mut().zip(times);
            all.for_each(|(value, time)| *value = own * exponential_of(high, low, time));
        } else {
            let (motion, mut vector) = (block.motion(), own.to_vec());
            for (node, time) in times.enumerate() {
                vector.copy_from_slice(own);
                motion.advance(time, &mut vector);
                vector.iter().zip(&mut values).for_each(|(own, values)| values[node] = *own);
            }
        }
        all[block.range()].iter_mut().zip(&values).for_each(|(all, own)| *all = Shape::of(own));
    }
    all
}
