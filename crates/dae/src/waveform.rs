//! Functions of time that drive a system.

/// One smooth piece of a [`Waveform`], from its `start` to the start of the next:
/// `u(t) = value + slope·s + sine·sin(ω s) + cosine·cos(ω s)` with `s = t − start`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Piece {
    /// Where the piece begins; the first one holds before its start as well.
    pub start: f64,
    /// Constant part.
    pub value: f64,
    /// Slope of the linear part.
    pub slope: f64,
    /// Amplitude of the sine.
    pub sine: f64,
    /// Amplitude of the cosine.
    pub cosine: f64,
    /// Angular frequency `ω` of sine and cosine.
    pub omega: f64,
}

impl Piece {
    /// The `order`-th derivative of the piece at `t`.
    pub fn derivative(&self, order: u32, t: f64) -> f64 {
        let s = t - self.start;
        let polynomial = match order {
            0 => self.value + self.slope * s,
            1 => self.slope,
            _ => 0.0,
        };
        if self.omega == 0.0 || (self.sine == 0.0 && self.cosine == 0.0) {
            return if order == 0 { polynomial + self.cosine } else { polynomial };
        }
        let (sin, cos) = (self.omega * s).sin_cos();
        let (sine, cosine) = match order % 4 {
            0 => (sin, cos),
            1 => (cos, -sin),
            2 => (-sin, -cos),
            _ => (-cos, sin),
        };
        polynomial
            + self.omega.powi(order.cast_signed()) * (self.sine * sine + self.cosine * cosine)
    }
}

/// A function of time made of smooth pieces; it may jump, or have a kink, where they meet.
///
/// Constants, lines and sines are all that a piece holds, because those are what the exact method
/// can follow without quadrature.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    pieces: Vec<Piece>,
}

impl Waveform {
    /// A waveform from its pieces, which must be in strictly rising order of their starts.
    ///
    /// Returns `None` when there is no piece, or the order is not strict, or a number is not finite.
    pub fn new(pieces: Vec<Piece>) -> Option<Self> {
        let ordered = pieces.windows(2).all(|pair| pair[0].start < pair[1].start);
        let finite = pieces.iter().all(|p| {
            [p.start, p.value, p.slope, p.sine, p.cosine, p.omega].iter().all(|x| x.is_finite())
        });
        (!pieces.is_empty() && ordered && finite).then_some(Self { pieces })
    }

    /// The function that is `value` at all times.
    pub fn constant(value: f64) -> Self {
        Self { pieces: vec![Piece { value, ..Piece::default() }] }
    }

    /// The pieces in order of time.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The piece that holds on the interval that begins at `t`.
    pub fn piece_at(&self, t: f64) -> &Piece {
        let after = self.pieces.partition_point(|piece| piece.start <= t);
        &self.pieces[after.saturating_sub(1)]
    }

    /// The value at `t`, from the right where the function jumps.
    pub fn value(&self, t: f64) -> f64 {
        self.piece_at(t).derivative(0, t)
    }

    /// The times after the first piece's start at which a new piece begins.
    pub fn breakpoints(&self) -> impl Iterator<Item = f64> + '_ {
        self.pieces.iter().skip(1).map(|piece| piece.start)
    }

    /// The jump of the value at `t`, zero where the function is continuous up to rounding.
    #[expect(clippy::float_cmp, reason = "a breakpoint is met exactly or not at all")]
    pub fn jump(&self, t: f64) -> f64 {
        let Some(at) = self.pieces.iter().skip(1).position(|piece| piece.start == t) else {
            return 0.0;
        };
        let (before, after) =
            (self.pieces[at].derivative(0, t), self.pieces[at + 1].derivative(0, t));
        let noise = 1e-12 * (self.pieces[at].scale_at(t) + self.pieces[at + 1].scale_at(t));
        if (after - before).abs() <= noise { 0.0 } else { after - before }
    }

    /// The same function with time and value measured in other units:
    /// `û(t̂) = u(t̂ · time) / value`.
    #[must_use]
    pub fn in_units(&self, time: f64, value: f64) -> Self {
        let scaled = |p: &Piece| Piece {
            start: p.start / time,
            value: p.value / value,
            slope: p.slope * time / value,
            sine: p.sine / value,
            cosine: p.cosine / value,
            omega: p.omega * time,
        };
        Self { pieces: self.pieces.iter().map(scaled).collect() }
    }

    /// The largest absolute value on `[0, end]`, bounded from above.
    pub fn bound(&self, end: f64) -> f64 {
        let mut bound = 0.0_f64;
        for (at, piece) in self.pieces.iter().enumerate() {
            let stop = self.pieces.get(at + 1).map_or(end, |next| next.start.min(end));
            if at > 0 && piece.start > end {
                break;
            }
            bound = bound.max(piece.scale_at(piece.start)).max(piece.scale_at(stop));
        }
        bound
    }
}

impl Piece {
    fn scale_at(&self, t: f64) -> f64 {
        (self.value + self.slope * (t - self.start)).abs() + self.sine.hypot(self.cosine)
    }
}
