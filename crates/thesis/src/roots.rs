//! Roots of a function on an interval where it is monotone.

/// The root between `low` and `high` of a function that is monotone there, to the last digits;
/// `None` where both ends have the same sign. An end that is zero itself counts.
pub(crate) fn monotone_root(of: &impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let (mut low, mut high) = (low, high);
    let begins = of(low);
    let ends = of(high);
    if begins == 0.0 {
        return Some(low);
    }
    if !(begins.is_finite() && ends.is_finite()) || begins * ends > 0.0 {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if of(middle) * begins > 0.0 { low = middle } else { high = middle }
    }
}
