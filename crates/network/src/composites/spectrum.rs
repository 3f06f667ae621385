//! Lists of times and strengths, and the elements that they stand for.

use dashpot_rheology::{Branch, Tree};

use super::CompositeNote;
use crate::{
    Model,
    elements::{Dashpot, Spring},
    model::part,
    parameters::InvalidParameter,
};

/// A time \[s\] and the strength that belongs to it, a stiffness \[N/m\] or a compliance \[m/N\].
pub(super) type Term = (f64, f64);

/// The terms in rising order of time. Errors: [`InvalidParameter`] that blames `parameter` when there are no terms,
/// when a number is not positive and finite, or when a time stands twice.
pub(super) fn sorted(
    parameter: &'static str,
    terms: &[Term],
) -> Result<Vec<Term>, InvalidParameter> {
    let invalid = |range, found: String| Err(InvalidParameter::new(parameter, range, found));
    if terms.is_empty() {
        return invalid("one term or more", "empty".to_owned());
    }
    let is_valid = |number: f64| number.is_finite() && number > 0.0;
    if let Some(term) = terms.iter().find(|term| !(is_valid(term.0) && is_valid(term.1))) {
        return invalid("of positive and finite numbers", format!("one with {term:?}"));
    }
    let mut sorted = terms.to_vec();
    sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
        let range = "a list of different times (terms of one time are one term with their sum)";
        return invalid(range, format!("one with {:?} s twice", pair[0].0));
    }
    Ok(sorted)
}

/// What is said where the terms were not given in rising order of time.
pub(super) fn order_note(
    given: &[Term],
    sorted: &[Term],
    fastest: &'static str,
) -> Option<CompositeNote> {
    (given != sorted).then_some(CompositeNote::Reordered { fastest })
}

/// The number, or an error that blames the term from which it comes: zero, infinite and subnormal
/// constants have lost digits or all of them.
pub(super) fn constant(
    parameter: &'static str,
    term: Term,
    number: f64,
) -> Result<f64, InvalidParameter> {
    const RANGE: &str = "such that all springs and dashpots of it fit into double precision";
    if number.is_normal() {
        Ok(number)
    } else {
        Err(InvalidParameter::new(parameter, RANGE, format!("one with {term:?}")))
    }
}

/// The branches `spring` and `dashpot`.
pub(super) fn pair(
    stiffness: f64,
    damping: f64,
) -> Vec<Branch<std::sync::Arc<dyn crate::Element>>> {
    vec![
        Branch::new("spring", part(Spring { stiffness })),
        Branch::new("dashpot", part(Dashpot { damping })),
    ]
}

/// Kelvin–Voigt elements in series, `kelvin-1` first, one for each term of retardation time `λ`
/// \[s\] and compliance `J` \[m/N\]: spring `1/J` beside dashpot `λ/J`.
/// Errors: [`InvalidParameter`] that blames `parameter` when a constant does not fit into double precision.
pub(super) fn kelvin_chain(
    parameter: &'static str,
    terms: &[Term],
) -> Result<Model, InvalidParameter> {
    let element = |(at, &(time, compliance)): (usize, &Term)| {
        let term = (time, compliance);
        let stiffness = constant(parameter, term, compliance.recip())?;
        let damping = constant(parameter, term, time / compliance)?;
        let element = Tree::Parallel(pair(stiffness, damping));
        Ok(Branch::new(format!("kelvin-{}", at + 1), element))
    };
    terms.iter().enumerate().map(element).collect::<Result<_, _>>().map(Tree::Series)
}
