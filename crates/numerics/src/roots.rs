//! Roots of functions of one number that are known to lie in an interval.

/// Halvings after which no interval of doubles can be halved once more.
pub const TO_THE_LAST_BIT: usize = 2200;

/// Bisection: the places between which a condition begins to hold, the first without it and the second
/// with it, after so many `halvings` of the interval between such places, or when there is no number
/// left between them. Either place may be the larger one.
///
/// # Examples
///
/// ```
/// use dashpot_numerics::roots::{TO_THE_LAST_BIT, bisect};
///
/// let (below, above) = bisect(1.0, 2.0, TO_THE_LAST_BIT, |x| x * x >= 2.0);
/// assert!(below * below < 2.0 && above == below.next_up());
/// ```
#[expect(clippy::float_cmp, reason = "the middle of neighbours is one of them")]
pub fn bisect(
    mut without: f64,
    mut with: f64,
    halvings: usize,
    mut holds: impl FnMut(f64) -> bool,
) -> (f64, f64) {
    for _ in 0..halvings {
        let middle = f64::midpoint(without, with);
        if middle == without || middle == with {
            break;
        }
        *(if holds(middle) { &mut with } else { &mut without }) = middle;
    }
    (without, with)
}

/// The root between `low` and `high` of a function that is monotone there, to the last digits;
/// `None` where both ends have the same sign. An end that is zero itself counts.
pub fn monotone_root(of: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let (begins, ends) = (of(low), of(high));
    if begins == 0.0 {
        return Some(low);
    }
    if !(begins.is_finite() && ends.is_finite()) || begins * ends > 0.0 {
        return None;
    }
    let (before, after) = bisect(low, high, TO_THE_LAST_BIT, |at| of(at) * begins <= 0.0);
    Some(f64::midpoint(before, after))
}

/// An interval in which a root is known to lie, for Newton's method to keep to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Bracket {
    /// Makes `at` the lower end where the root `is_beyond` it, else the upper one.
    #[inline]
    pub fn cut(&mut self, at: f64, is_beyond: bool) {
        *(if is_beyond { &mut self.low } else { &mut self.high }) = at;
    }

    /// `next` where it lies inside, else the middle.
    #[inline]
    pub fn within(&self, next: f64) -> f64 {
        if next > self.low && next < self.high { next } else { 0.5 * (self.low + self.high) }
    }
}

/// Steps to a root by false position; each second one at least halves the bracket.
const MOST_STEPS: usize = 200;

/// False position: the last bracket `(x, f(x))` of a root, from one in which `f` has different signs
/// at both ends. Wherever a step does not halve the bracket by itself, the next one halves it.
///
/// It ends when the bracket is no wider than `narrowest` times its upper end, and when there is no number left in it.
///
/// # Errors
///
/// Those of `f`.
pub fn false_position<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    start: (f64, f64),
    end: (f64, f64),
    narrowest: f64,
) -> Result<[(f64, f64); 2], E> {
    let (mut left, mut right) = (start, end);
    let is_positive = left.1 > 0.0;
    let mut halve = false;
    for _ in 0..MOST_STEPS {
        let width = right.0 - left.0;
        if width <= narrowest * right.0.abs() {
            break;
        }
        let share = if halve { 0.5 } else { (left.1 / (left.1 - right.1)).clamp(0.02, 0.98) };
        let place = left.0 + share * width;
        if place <= left.0 || place >= right.0 {
            break;
        }
        let middle = (place, f(place)?);
        *(if (middle.1 > 0.0) == is_positive { &mut left } else { &mut right }) = middle;
        halve = right.0 - left.0 > 0.5 * width;
    }
    Ok([left, right])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bisection_ends_at_neighbours_whichever_end_is_the_larger() {
        let (below, above) = bisect(0.0, 4.0, TO_THE_LAST_BIT, |x| x.exp() >= 3.0);
        assert_eq!(above.to_bits(), below.next_up().to_bits());
        let turned = bisect(4.0, 0.0, TO_THE_LAST_BIT, |x| x.exp() < 3.0);
        assert_eq!((turned.1.to_bits(), turned.0.to_bits()), (below.to_bits(), above.to_bits()));
        // Down to the smallest number, and no further.
        assert_eq!(bisect(0.0, f64::MAX, TO_THE_LAST_BIT, |_| true).1.to_bits(), 1);
        assert_eq!(bisect(0.0, 1.0, 2, |x| x > 0.3), (0.25, 0.5));
    }

    #[test]
    fn monotone_functions_have_one_root_or_none() {
        let root = monotone_root(|x| x * x - 2.0, 0.0, 2.0);
        assert!((root.unwrap() - 2.0_f64.sqrt()).abs() <= f64::EPSILON);
        assert_eq!(monotone_root(|x| x, 0.0, 1.0), Some(0.0));
        assert_eq!(monotone_root(|x| x - 1.0, 0.0, 1.0).map(f64::round), Some(1.0));
        assert_eq!(monotone_root(|x| x + 1.0, 0.0, 1.0), None);
        assert_eq!(monotone_root(f64::ln, 0.0, 2.0), None);
    }

    #[test]
    fn newton_steps_do_not_leave_their_bracket() {
        let mut bracket = Bracket { low: 0.0, high: 1.0 };
        bracket.cut(0.5, true);
        let nexts = [0.7, 3.0, f64::NAN].map(|next| bracket.within(next));
        assert_eq!((bracket.low, nexts), (0.5, [0.7, 0.75, 0.75]));
    }

    #[test]
    fn false_position_finds_roots_of_steep_flat_and_jumping_functions() {
        let root = |f: fn(f64) -> f64, from: f64, to: f64| {
            let ends = (from, f(from));
            let [left, right] =
                false_position(|x| Ok::<f64, ()>(f(x)), ends, (to, f(to)), 0.0).unwrap();
            assert!(left.1 * right.1 <= 0.0);
            if left.1.abs() < right.1.abs() { left.0 } else { right.0 }
        };
        assert!((root(|x| x.exp() - 5.0, 0.0, 700.0) - 5_f64.ln()).abs() < 4.0 * f64::EPSILON);
        assert!((root(|x| (x - 1.0).powi(9), 0.0, 3.0) - 1.0).abs() < 1e-12);
        assert!((root(|x| if x < 0.3 { -1.0 } else { 1e9 }, 0.0, 1.0) - 0.3).abs() < 1e-15);
        let failed = false_position(|_| Err::<f64, i32>(3), (0.0, -1.0), (1.0, 1.0), 0.0);
        assert_eq!(failed, Err(3));
    }
}
