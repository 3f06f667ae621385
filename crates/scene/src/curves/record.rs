//! Records that go out and back.

use super::Row;

/// So much of the way may a deformation fall back without a turn: play and noise of the measurement.
const PLAY: f64 = 0.05;

/// The number of the first row at which the deformation has fallen back from the deepest so far by more than play;
/// `None` where it never turns back.
fn turn(rows: &[Row]) -> Option<usize> {
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

/// The row of the deepest deformation before the first turn.
pub(crate) fn turning_row(rows: &[Row]) -> Option<&Row> {
    let before = &rows[..turn(rows).unwrap_or(rows.len())];
    before.iter().max_by(|one, other| one.at.total_cmp(&other.at))
}

/// The rows up to the deepest one, apart from noise; those behind it only lead back. `None` where they do not, or
/// where the rows begin deep.
pub(crate) fn outward(rows: &[Row]) -> Option<&[Row]> {
    let [first, last] = deepest(rows)?;
    let out = if last + 1 == rows.len() { rows } else { &rows[..=first] };
    let least = |rows: &[Row]| rows.iter().map(|own| own.at).fold(f64::INFINITY, f64::min);
    let begins = least(out) - least(rows) <= PLAY * (rows[last].at - least(rows));
    (begins && turn(out).is_none() && turn(&inward(&rows[last..])).is_none()).then_some(out)
}

/// The first and the last row of the largest deformation.
fn deepest(rows: &[Row]) -> Option<[usize; 2]> {
    let most = rows.iter().map(|own| own.at).fold(f64::NEG_INFINITY, f64::max);
    let is_deepest = |own: &Row| own.at >= most;
    Some([rows.iter().position(is_deepest)?, rows.iter().rposition(is_deepest)?])
}

/// The rows with the way back as a way out.
fn inward(rows: &[Row]) -> Vec<Row> {
    rows.iter().map(|own| Row { at: -own.at, ..*own }).collect()
}

/// The rows of loading and those of unloading, split where the deformation is largest. Rows at the same depth
/// between them, where it was held, are of neither.
///
/// # Errors
///
/// The number of the row where a second cycle begins; the number of rows where it never turns back.
pub(crate) fn split(rows: &[Row]) -> Result<(Vec<Row>, Vec<Row>), usize> {
    let Some([first, last]) = deepest(rows) else { return Err(rows.len()) };
    let (loading, back) = (&rows[..=first], &rows[last..]);
    if let Some(at) = turn(loading) {
        return Err(at);
    }
    if turn(rows).is_none() {
        return Err(rows.len());
    }
    if let Some(at) = turn(&inward(back)) {
        return Err(last + at);
    }
    // It never pulls: what the machine did before it touched is no part of it.
    let pressed = |rows: &[Row]| rows.iter().filter(|own| own.at >= 0.0).copied().collect();
    Ok((pressed(loading), pressed(back)))
}
