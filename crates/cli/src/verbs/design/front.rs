//! The front of two aims, over all choices.

use dashpot_design::optimum::{FrontPoint, front, undominated};

use super::{
    DesignArguments,
    among::Choice,
    answer::Found,
    asked::{Asked, Least},
    posing::Posing,
    with_problem,
};
use crate::error::CliError;

/// A design of the front, with the choice of its words and steps.
pub(super) struct Point {
    pub(super) choice: Choice,
    pub(super) own: FrontPoint,
}

/// The front of both aims; nothing where only one is asked for, or where no choice keeps everything.
pub(super) fn found(
    arguments: &DesignArguments,
    posing: &Posing<'_>,
    all: &[Found],
) -> Result<Vec<Point>, CliError> {
    let asked = posing.asked;
    let Some(and) = &asked.and else { return Ok(Vec::new()) };
    let is_kept = |own: &&Found| own.design.as_ref().is_ok_and(|own| own.is_feasible);
    let mut points = Vec::new();
    for Found { choice, .. } in all.iter().filter(is_kept) {
        let other = and.aim(asked, choice);
        let front = with_problem(posing, choice, |problem| {
            front(problem, &other, arguments.effort(), arguments.points)
        });
        let front = front.map_err(|fault| CliError::NoDesign { reason: fault.to_string() })?;
        points.extend(front.points.into_iter().map(|own| (choice.clone(), own)));
    }
    let mut kept = undominated(points);
    kept.sort_by(|one, other| one.1.design.aim.total_cmp(&other.1.design.aim));
    Ok(kept.into_iter().map(|(choice, own)| Point { choice, own }).collect())
}

impl Point {
    /// The values of both aims with their absolute errors, where they have any that are known.
    pub(super) fn aims(&self, asked: &Asked) -> [(f64, Option<f64>); 2] {
        let error = |least: &Least, value: f64| match least {
            Least::Measure(key) => {
                // That of the worst test.
                let all = self.own.design.runs.iter().filter_map(|run| run.measure(key));
                let off = |own: Option<f64>| own.map_or(f64::INFINITY, |own| (own - value).abs());
                all.min_by(|one, other| off(one.value).total_cmp(&off(other.value)))?.error
            }
            Least::Number(_) | Least::Step(_) => None,
        };
        let (aim, other) = (self.own.design.aim, self.own.other);
        let of_other = asked.and.as_ref().and_then(|own| error(own, other));
        [(aim, error(&asked.least, aim)), (other, of_other)]
    }
}
