//! Records that go out and back.

use super::Row;

/// So much of the way may a deformation fall back without a turn: play and noise of the measurement.
const PLAY: f64 = 0.05;

/// The number of the first row at which the deformation has fallen back from the deepest so far by more than play;
/// `None` where it never turns back.
pub(super) fn turn(rows: &[Row]) -> Option<usize> {
    let (least, most) = rows.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), own| {
        (low.min(own.at), high.max(own.at))
    });
    let play = PLAY * (most - least);
    let mut deepest = f64::NEG_INFINITY;
    rows.iter().position(|own| {
        deepest = deepest.max(own.at);
        own.at < deepest - play
    })
}

/// The rows of loading and those of unloading, split where the deformation is largest. Rows at the same depth
/// between them, where it was held, are of neither.
///
/// # Errors
///
/// The number of the row where a second cycle begins; the number of rows where it never turns back.
pub(crate) fn split(rows: &[Row]) -> Result<(Vec<Row>, Vec<Row>), usize> {
    let deepest = rows.iter().map(|own| own.at).fold(f64::NEG_INFINITY, f64::max);
    let is_deepest = |own: &Row| own.at >= deepest;
    let first = rows.iter().position(is_deepest).unwrap_or(0);
    let last = rows.iter().rposition(is_deepest).unwrap_or(0);
    let (loading, back) = (&rows[..=first.min(rows.len().saturating_sub(1))], &rows[last..]);
    if let Some(at) = turn(loading) {
        return Err(at);
    }
    if turn(rows).is_none() {
        return Err(rows.len());
    }
    let inward: Vec<Row> = back.iter().map(|own| Row { at: -own.at, ..*own }).collect();
    if let Some(at) = turn(&inward) {
        return Err(last + at);
    }
    // It never pulls: what the machine did before it touched is no part of it.
    let pressed = |rows: &[Row]| rows.iter().filter(|own| own.at >= 0.0).copied().collect();
    Ok((pressed(loading), pressed(back)))
}
