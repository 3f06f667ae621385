//! What becomes of a design along one of its numbers.

use super::{DesignError, Effort, Looked, Problem, search::Search};

/// Designs over the bounds of one number, the others as they are; where it has a given sum with others, what it takes is
/// taken from those behind it. None for the last number of a sum.
///
/// # Errors
///
/// [`DesignError`].
pub fn along(
    problem: &Problem<'_>,
    values: &[f64],
    number: usize,
    (count, effort): (usize, Effort),
) -> Result<Vec<Looked>, DesignError> {
    let search = Search::of(problem, None, effort)?;
    let Some(unknown) = search.space.free().position(|own| own == number) else {
        return Ok(Vec::new());
    };
    let begin = search.space.unknowns(values);
    let place = |at: usize| {
        let mut own = begin.clone();
        own[unknown] = at as f64 / (count - 1).max(1) as f64;
        own
    };
    let places: Vec<Vec<f64>> = (0..count).map(place).collect();
    Ok(search.looked(&places).0)
}
