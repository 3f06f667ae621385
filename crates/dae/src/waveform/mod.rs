//! Functions of time that drive a system.

mod piece;

pub use piece::Piece;

/// Part of a derivative that it may jump by from rounding.
const ROUNDING: f64 = 1e-9;

/// A function of time made of smooth pieces; it may jump, or have a kink, where they meet.
///
/// Cubics and sines are what the exact method can follow without quadrature; a sine whose frequency
/// is swept can only be stepped through.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    pieces: Vec<Piece>,
    given: Option<Given>,
}

/// The times at which the values of a waveform have been given, where that is not at all times. Its pieces
/// continue it before and after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Given {
    /// The first time \[s\].
    pub from: f64,
    /// The last time \[s\].
    pub to: f64,
    /// How often the values have been integrated since.
    pub integrals: u32,
    /// Whether they are those of a formula that is followed up to an end, and not of a table.
    pub is_formula: bool,
    /// Whether it must not be used at other times; else nobody has said what holds there.
    pub is_strict: bool,
}

impl Waveform {
    /// A waveform from its pieces, which must be in strictly rising order of their starts.
    ///
    /// Returns `None` when there is no piece, or the order is not strict, or a number is not finite.
    pub fn new(pieces: Vec<Piece>) -> Option<Self> {
        let ordered = pieces.windows(2).all(|pair| pair[0].start < pair[1].start);
        let finite = pieces.iter().all(|piece| piece.numbers().iter().all(|x| x.is_finite()));
        (!pieces.is_empty() && ordered && finite).then_some(Self { pieces, given: None })
    }

    /// The same function, of which it is known at which times its values have been given.
    #[must_use]
    pub fn given_at(self, given: Given) -> Self {
        Self { given: Some(given), ..self }
    }

    /// The times at which its values have been given; `None` where that is at all times.
    pub fn given(&self) -> Option<Given> {
        self.given
    }

    /// The function that is `value` at all times.
    pub fn constant(value: f64) -> Self {
        Self { pieces: vec![Piece { value, ..Piece::default() }], given: None }
    }

    /// The pieces in order of time.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The piece that holds on the interval that begins at `t`.
    pub fn piece_at(&self, t: f64) -> &Piece {
        &self.pieces[self.index_at(t)]
    }

    /// The same, and when the next one begins.
    pub(crate) fn piece_until(&self, t: f64) -> (&Piece, Option<f64>) {
        let at = self.index_at(t);
        (&self.pieces[at], self.pieces.get(at + 1).map(|next| next.start))
    }

    /// The first and the last of the pieces that hold anywhere on `[start, end)`.
    pub(crate) fn range(&self, start: f64, end: f64) -> (usize, usize) {
        let first = self.index_at(start);
        let later = self.pieces[first + 1..].partition_point(|piece| piece.start < end);
        (first, first + later)
    }

    /// The piece of those in this range that holds at `t`; the outer ones go on beyond it.
    pub(crate) fn piece_of(&self, (first, last): (usize, usize), t: f64) -> &Piece {
        let later = || self.pieces[first + 1..=last].partition_point(|piece| piece.start <= t);
        &self.pieces[if first == last { first } else { first + later() }]
    }

    /// The times at which a derivative of up to this order jumps by more than rounding, an oscillation begins or ends,
    /// or a motion that is not uniform.
    pub(crate) fn breaks(&self, order: u32) -> impl Iterator<Item = f64> + '_ {
        let is_broken = move |pair: &&[Piece]| {
            let [before, after] = [&pair[0], &pair[1]];
            let jumps = |order| {
                let [one, other] = [before, after].map(|own| own.derivative(order, after.start));
                (one - other).abs() > ROUNDING * one.abs().max(other.abs())
            };
            before.is_wave()
                || after.is_wave()
                || before.is_constant(1) != after.is_constant(1)
                || (0..=order).any(jumps)
        };
        self.pieces.windows(2).filter(is_broken).map(|pair| pair[1].start)
    }

    /// The value at `t`, from the right where the function jumps.
    pub fn value(&self, t: f64) -> f64 {
        self.piece_at(t).derivative(0, t)
    }

    /// The times after the first piece's start at which a new piece begins.
    pub fn breakpoints(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().skip(1).map(|piece| piece.start)
    }

    /// The times at which the value jumps by more than rounding, and by how much.
    pub fn jumps(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.pieces.windows(2).filter_map(|pair| {
            let (before, after, t) = (&pair[0], &pair[1], pair[1].start);
            let jump = after.derivative(0, t) - before.derivative(0, t);
            (jump.abs() > before.noise(t) + after.noise(t)).then_some((t, jump))
        })
    }

    /// The same function with time and value measured in other units: `û(t̂) = u(t̂ · time) / value`.
    #[must_use]
    pub fn in_units(&self, time: f64, value: f64) -> Self {
        let pieces = self.pieces.iter().map(|piece| piece.in_units(time, value)).collect();
        let scaled = |given: Given| Given { from: given.from / time, to: given.to / time, ..given };
        Self { pieces, given: self.given.map(scaled) }
    }

    /// The integral from `t = 0` on: it is zero there, continuous, and has this function as its rate
    /// at all later times. The piece that holds at 0 is its first one.
    ///
    /// Returns `None` when a piece has no integral that a piece can hold, which is so for a swept
    /// frequency and for a cubic, or when a number becomes too large.
    pub fn integral(&self) -> Option<Self> {
        let mut pieces: Vec<Piece> = Vec::with_capacity(self.pieces.len());
        for piece in &self.pieces[self.index_at(0.0)..] {
            let (start, reached) = match pieces.last() {
                Some(last) => (piece.start, last.derivative(0, piece.start)),
                None => (0.0, 0.0),
            };
            let mut whole = piece.integral(start)?;
            whole.value += reached;
            pieces.push(whole);
        }
        let given = self.given.map(|given| Given { integrals: given.integrals + 1, ..given });
        Self::new(pieces).map(|own| Self { given, ..own })
    }

    /// The motion whose acceleration this is from `t = 0` on: it begins at zero with this velocity. Lines between points
    /// are integrated to cubics.
    ///
    /// Returns `None` as [`integral`](Self::integral) does.
    pub fn motion(&self, velocity: f64) -> Option<Self> {
        self.integral()?.plus(velocity).integral()
    }

    /// The same function, larger by a constant at all times.
    #[must_use]
    pub fn plus(&self, constant: f64) -> Self {
        let raised = |piece: &Piece| Piece { value: piece.value + constant, ..*piece };
        Self { pieces: self.pieces.iter().map(raised).collect(), given: self.given }
    }

    /// The same function with time counted from `start`; what lies before it is cut off.
    #[must_use]
    pub fn since(&self, start: f64) -> Self {
        let first = self.pieces.partition_point(|piece| piece.start <= start).saturating_sub(1);
        let shifted = |piece: &Piece| Piece { start: piece.start - start, ..*piece };
        let given = self.given.map(|given| Given {
            from: given.from - start,
            to: given.to - start,
            ..given
        });
        Self { pieces: self.pieces[first..].iter().map(shifted).collect(), given }
    }

    /// The same function, which goes on smoothly where a piece begins at `end` or later.
    #[must_use]
    pub fn until(&self, end: f64) -> Self {
        let last = self.pieces.partition_point(|piece| piece.start < end).max(1);
        Self { pieces: self.pieces[..last].to_vec(), given: self.given }
    }

    /// The pieces that hold anywhere on `[0, end]`.
    pub(crate) fn within(&self, end: f64) -> Self {
        Self {
            pieces: self.pieces[self.index_at(0.0)..=self.index_at(end)].to_vec(),
            given: self.given,
        }
    }

    /// The largest absolute value on `[0, end]`, bounded from above.
    pub fn bound(&self, end: f64) -> f64 {
        self.bounds(end).map(|(_, bound)| bound).fold(0.0, f64::max)
    }

    /// The integral of the absolute value over `[0, end]`, bounded from above: the sum over all pieces
    /// of the largest value times the length.
    pub fn area_bound(&self, end: f64) -> f64 {
        self.bounds(end).map(|(length, bound)| length * bound).sum()
    }

    /// The length of each piece on `[0, end]`, and the bound of its values there.
    fn bounds(&self, end: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let first = self.index_at(0.0);
        let pieces = self.pieces.iter().enumerate().skip(first);
        let pieces = pieces.take_while(move |(at, piece)| *at == first || piece.start <= end);
        pieces.map(move |(at, piece)| {
            let from = if at == first { 0.0 } else { piece.start };
            let next = self.pieces.get(at + 1).map_or(f64::INFINITY, |next| next.start);
            let until = next.min(end);
            (until - from, piece.bound(from, until))
        })
    }

    fn index_at(&self, t: f64) -> usize {
        self.pieces.partition_point(|piece| piece.start <= t).saturating_sub(1)
    }
}

#[cfg(test)]
mod tests;
