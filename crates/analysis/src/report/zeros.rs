//! Values that cannot be told from zero.

use std::collections::HashMap;

use crate::MeasureReport;

/// What is smaller than this part of its size is what rounding leaves of zero.
const ROUNDING: f64 = 1e-12;
/// A value within its error is zero where the error is at most this part of its size.
const SMALL: f64 = 1e-2;

/// Sets to zero what cannot be told from it: values within errors that are small beside their size, or where none are
/// known within the relative tolerance `rtol` of it. Their errors grow by what they were. The size is what a value is
/// the remainder of, at least the largest value of its kind and of energies what is `turned_over` \[J\].
pub(crate) fn settle_zeros(measures: &mut [MeasureReport], turned_over: f64, rtol: f64) {
    let mut largest: HashMap<&str, f64> = HashMap::new();
    for own in measures.iter() {
        let value = own.value.unwrap_or(0.0).abs();
        largest.entry(own.kind).and_modify(|most| *most = most.max(value)).or_insert(value);
    }
    for own in measures {
        let Some(value) = own.value else { continue };
        let of_energy = if own.unit == "J" { turned_over } else { 0.0 };
        let size = own.size.max(largest[own.kind]).max(of_energy);
        let (value, error) = settled(value, own.error, size, rtol * own.size);
        (own.value, own.error) = (Some(value), error);
    }
}

/// A value of this size and its error: zero where it cannot be told from that, within its error or, where none is known,
/// within `otherwise`.
pub(crate) fn settled(
    value: f64,
    error: Option<f64>,
    size: f64,
    otherwise: f64,
) -> (f64, Option<f64>) {
    let within = match error {
        Some(error) if error <= SMALL * size => error,
        Some(_) => 0.0,
        None => otherwise,
    };
    let is_zero = value.abs() <= within.max(ROUNDING * size);
    if is_zero { (0.0, error.map(|error| error + value.abs())) } else { (value, error) }
}
