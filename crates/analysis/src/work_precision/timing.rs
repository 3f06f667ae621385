//! How long a solution takes.

use std::{hint::black_box, time::Instant};

use dashpot_dae::{Method, Run, Silent, SolveError, Statistics, switching};
use dashpot_network::Assembly;

use super::Spread;
use crate::{Solution, measures::selection::Selected, solution::threshold_at};

/// Steps that all repeats of a solution take together, about.
const STEPS: usize = 20_000;
/// Fewest and most repeats that are chosen by the number of steps.
const REPEATS: (usize, usize) = (5, 51);
/// Repeats of a method that takes no steps.
const STEPLESS: usize = 25;

/// Number of repeats that suits a solution of this work.
pub(super) fn repeats(work: &Statistics) -> usize {
    let (fewest, most) = REPEATS;
    match work.accepted + work.rejected {
        0 => STEPLESS,
        // An odd number has a median of its own.
        steps => (STEPS / steps).clamp(fewest, most) | 1,
    }
}

/// The times to solve and to read all measures, and of the first part alone \[s\].
pub(super) fn times(
    assembly: &Assembly,
    method: &dyn Method,
    run: &Run,
    selected: &[Selected],
    repeats: usize,
) -> Result<(Spread, Spread), SolveError> {
    let (mut whole, mut integration) = (Vec::new(), Vec::new());
    for _ in 0..repeats {
        let begin = Instant::now();
        let trajectory = match &assembly.switching {
            None => method.integrate(&assembly.system, run, &mut Silent)?,
            Some(phased) => switching::integrate(method, phased.as_ref(), run, &mut Silent)?,
        };
        integration.push(begin.elapsed().as_secs_f64());
        let threshold = threshold_at((!method.is_exact()).then_some(run.rtol));
        let solution = Solution::new(assembly, &trajectory).doubting(threshold);
        for entry in selected {
            black_box(entry.measure.read(&solution, entry.target));
        }
        whole.push(begin.elapsed().as_secs_f64());
    }
    Ok((spread(whole), spread(integration)))
}

/// Median and quartiles, by linear interpolation between the values in order.
pub(super) fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * values.len().saturating_sub(1) as f64;
        let below = values.get(whole(place)).copied().unwrap_or(0.0);
        let above = values.get(whole(place.ceil())).copied().unwrap_or(below);
        below + place.fract() * (above - below)
    };
    Spread { median: at(0.5), lower: at(0.25), upper: at(0.75) }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a place in a list, below 2^52"
)]
fn whole(place: f64) -> usize {
    place as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_the_values_in_order() {
        let own = spread(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!((own.lower, own.median, own.upper), (2.0, 3.0, 4.0));
        let own = spread(vec![1.0, 2.0]);
        assert_eq!((own.lower, own.median, own.upper), (1.25, 1.5, 1.75));
        let own = spread(vec![7.0]);
        assert_eq!((own.lower, own.median, own.upper), (7.0, 7.0, 7.0));
    }

    #[test]
    fn short_solutions_are_repeated_more_often() {
        let of = |accepted| repeats(&Statistics { accepted, ..Statistics::default() });
        assert_eq!([of(0), of(100), of(1000), of(1_000_000)], [25, 51, 21, 5]);
    }
}
