//! For how long a signal exceeds a level, and clip: what is exceeded for a given time, and for 3 ms.

use std::sync::Arc;

use dashpot_dae::{Panel, Signal};
use dashpot_network::{choices, parameters, parameters::WindowWish};
use dashpot_numerics::{
    chebyshev,
    roots::{TO_THE_LAST_BIT, bisect},
};

use super::{Measure, MeasureKind, MeasureTraits, Reading, WINDOW};
use crate::{Note, Solution};

choices! {
    /// Which times count as those of a level.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Counted {
        /// All times, added up.
        #[default]
        Together = "together",
        /// The times of one stretch, in which the level is never left.
        AtOnce = "at-once",
    }
}

/// The magnitude of a signal over a window, in pieces on which it rises or falls.
#[derive(Debug)]
pub struct Exceedance {
    pieces: Vec<Piece>,
}

#[derive(Debug)]
struct Piece {
    panel: Panel,
    /// The signal at both ends.
    ends: [f64; 2],
}

/// The level that is reached for a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Its value.
    pub value: f64,
    /// Whether it is still reached at the end of the window.
    pub reaches_end: bool,
    /// The least slope with which the signal passes it; 0 where it does not.
    pub slope: f64,
}

impl Exceedance {
    /// Looks at a signal in a window.
    pub fn new(signal: &Signal, window: (f64, f64)) -> Self {
        let turns = signal.extrema(window).into_iter().map(|extremum| extremum.time);
        let zeros = signal.crossings(0.0, window).into_iter().map(|crossing| crossing.time);
        let mut cuts: Vec<f64> = turns.chain(zeros).collect();
        cuts.sort_by(f64::total_cmp);
        let mut pieces = Vec::new();
        for panel in &signal.panels {
            let (start, end) = (panel.start.max(window.0), panel.end.min(window.1));
            if start >= end {
                continue;
            }
            let first = cuts.partition_point(|cut| *cut <= start);
            let inside = cuts[first..].iter().copied().take_while(|cut| *cut < end);
            let mut from = start;
            for to in inside.chain([end]).filter(|to| *to > start) {
                if to > from {
                    let part = panel.part(from, to);
                    let ends = [-1.0, 1.0].map(|x| chebyshev::evaluate(&part.coefficients, x));
                    pieces.push(Piece { panel: part, ends });
                }
                from = to;
            }
        }
        Self { pieces }
    }

    /// The largest level that is reached for `duration` \[s\], to the last digits.
    pub fn level(&self, duration: f64, counted: Counted) -> Level {
        let ends = self.pieces.iter().flat_map(|piece| piece.ends);
        let most = ends.map(f64::abs).fold(0.0, f64::max);
        // The time falls as the level rises.
        let is_missed = |level: f64| self.longest(level, counted) < duration;
        let low =
            if is_missed(most) { bisect(0.0, most, TO_THE_LAST_BIT, is_missed).0 } else { most };
        let is_passed = |piece: &&Piece| {
            let [first, last] = piece.ends.map(f64::abs);
            first.min(last) < low && first.max(last) >= low
        };
        let steepness = |piece: &Piece| {
            let at = passage(piece, low);
            let slope = chebyshev::evaluate(&piece.panel.derivative().coefficients, at);
            slope.abs()
        };
        let slopes = self.pieces.iter().filter(is_passed).map(steepness);
        Level {
            value: low,
            reaches_end: low > 0.0
                && self.pieces.last().is_some_and(|piece| piece.ends[1].abs() >= low),
            slope: slopes.reduce(f64::min).unwrap_or(0.0),
        }
    }

    /// For how long the magnitude is not below `level`: all times, or those of the longest stretch.
    fn longest(&self, level: f64, counted: Counted) -> f64 {
        let (mut sum, mut most, mut stretch) = (0.0, 0.0_f64, [f64::NEG_INFINITY; 2]);
        for piece in &self.pieces {
            let [first, last] = piece.ends.map(|end| end.abs() >= level);
            let (start, end) = (piece.panel.start, piece.panel.end);
            let passage = || piece.panel.time(passage(piece, level));
            let (from, to) = match (first, last) {
                (true, true) => (start, end),
                (true, false) => (start, passage()),
                (false, true) => (passage(), end),
                (false, false) => continue,
            };
            stretch = if stretch[1] >= from { [stretch[0], to] } else { [from, to] };
            sum += to - from;
            most = most.max(stretch[1] - stretch[0]);
        }
        match counted {
            Counted::Together => sum,
            Counted::AtOnce => most,
        }
    }
}

/// The place in a piece at which its magnitude passes a level between those at its ends.
fn passage(piece: &Piece, level: f64) -> f64 {
    let [first, last] = piece.ends.map(f64::abs);
    if piece.panel.coefficients.len() <= 2 {
        // A straight line, as records have.
        return (2.0 * (level - first) / (last - first) - 1.0).clamp(-1.0, 1.0);
    }
    let value = |x: f64| chebyshev::evaluate(&piece.panel.coefficients, x).abs() - level;
    let rises = last >= first;
    // The magnitude is monotone, so halving finds it to the last bit.
    let (from, to) = bisect(-1.0, 1.0, 53, |x| (value(x) >= 0.0) == rises);
    0.5 * (from + to)
}

#[cfg(test)]
mod tests;

parameters! {
    /// The largest acceleration that is reached or exceeded for a given time: the largest `A` \[m/s²\]
    /// with `|a| ≥ A` for at least the `duration`, where `a` is what an accelerometer on the body reads.
    ///
    /// | symbol | field      | unit | range    |
    /// |--------|------------|------|----------|
    /// | `d`    | `duration` | s    | positive |
    /// |        | `counted`  |      | [`Counted`] |
    ///
    /// Times are counted `together` (all of them are added up) or `at-once` (within one stretch). It is 0
    /// where the whole window is shorter than the duration. Where the speed jumps it is not infinite,
    /// because a jump takes no time.
    ///
    /// A half-sine of height `A` and length `T` has `A cos(π d/(2 T))`, counted either way; of two equal
    /// ones apart from each other the times count together as those of one of twice the length.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Clip: "clip", "largest acceleration that is exceeded for a given time [m/s^2]" {
        /// the time d [s], positive
        pub duration: f64 = Quantity(Dimension::TIME), default "3 ms", range Positive;
        /// `together`: all times are added up; `at-once`: those of one stretch
        pub counted: Counted = Choice(Counted::WORDS), default "together";
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
    default { duration: 0.003, counted: Counted::Together, window: WindowWish::Impact }
}

impl MeasureKind for Clip {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("m/s^2");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let acceleration = solution.node_acceleration(target)?;
        let span = solution.node_span(target, self.window)?;
        let found = Exceedance::new(acceleration, span.window()).level(self.duration, self.counted);
        // Values move by the error of the signal, and a longer window moves the level no faster than
        // the signal itself.
        let end_rate = if found.reaches_end { found.slope } else { 0.0 };
        let error = acceleration.error.zip(span.to_error);
        let error =
            error.map(|(error, shift)| error + if shift > 0.0 { end_rate * shift } else { 0.0 });
        let reading = Reading::over(&span, found.value, error).of_size(found.value);
        let reading = reading.above(acceleration.noise).changing(end_rate);
        Ok(reading.noting_if(span.length() < self.duration, Note::WindowTooShort))
    }
}

parameters! {
    /// The largest acceleration that is reached or exceeded for 3 ms \[m/s²\]; otherwise as [`Clip`].
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Clip3ms: "clip-3ms", "largest acceleration that is exceeded for 3 ms [m/s^2]" {
        /// Which times count.
        pub counted: Counted => Clip::PARAMETERS[1];
        /// The part of the run that it looks at.
        pub window: WindowWish => WINDOW;
    }
}

impl Clip3ms {
    fn clip(self) -> Clip {
        Clip { duration: 0.003, counted: self.counted, window: self.window }
    }
}

impl MeasureKind for Clip3ms {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("m/s^2");

    fn general(&self) -> Option<Arc<dyn Measure>> {
        Some(Arc::new(self.clip()))
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        MeasureKind::read(&self.clip(), solution, target)
    }
}
