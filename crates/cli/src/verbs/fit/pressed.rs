//! Curves without times: a force over a deformation, pressed and let go of at a rate that is stated.

/// A turn is one where the deformation goes back by more than this part of its range: less is noise.
const TURNS: f64 = 0.02;

/// When each row was reached at this rate, from no deformation on \[s\]; of rows that do not go on before the motion
/// turns, and would be met at one time with others, there is none.
pub(super) fn times(deformations: &[f64], rate: f64) -> Vec<Option<f64>> {
    let turns = turns(deformations);
    let mut times = vec![None; deformations.len()];
    // From no deformation to the first row at once.
    let mut passed = deformations.first().map_or(0.0, |own| own.abs());
    let mut from = 0;
    for to in turns {
        let sign = (deformations[to] - deformations[from]).signum();
        let begin = deformations[from];
        let mut farthest = if from == 0 { -1.0 } else { 0.0 };
        for at in from..=to {
            let way = sign * (deformations[at] - begin);
            if way > farthest {
                times[at] = Some((passed + way) / rate);
                farthest = way;
            }
        }
        passed += sign * (deformations[to] - begin);
        from = to;
    }
    times
}

/// The rows at which the motion turns, and the last one.
fn turns(deformations: &[f64]) -> Vec<usize> {
    let (low, high) = deformations
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |own, at| (own.0.min(*at), own.1.max(*at)));
    let noise = TURNS * (high - low);
    let mut turns = Vec::new();
    // The farthest row either way since the last turn, until it is known which way it goes.
    let (mut top, mut bottom, mut is_rising) = (0, 0, None);
    for (at, own) in deformations.iter().enumerate() {
        if *own > deformations[top] {
            top = at;
        }
        if *own < deformations[bottom] {
            bottom = at;
        }
        if is_rising != Some(false) && deformations[top] - own > noise {
            if is_rising.is_some() {
                turns.push(top);
            }
            (is_rising, bottom) = (Some(false), at);
        } else if is_rising != Some(true) && own - deformations[bottom] > noise {
            if is_rising.is_some() {
                turns.push(bottom);
            }
            (is_rising, top) = (Some(true), at);
        }
    }
    turns.extend(deformations.len().checked_sub(1));
    turns.dedup();
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_met_on_the_way_there_and_back() {
        let own = times(&[0.0, 1.0, 2.0, 4.0, 3.0, 1.0], 2.0);
        assert_eq!(own, [0.0, 0.5, 1.0, 2.0, 2.5, 3.5].map(Some));
        // A start that is not at zero takes its time, and a row that steps back by noise has none.
        let own = times(&[1.0, 2.0, 1.99, 3.0], 1.0);
        assert_eq!(own, [Some(1.0), Some(2.0), None, Some(3.0)]);
        // Twice there and back, with noise at the ends.
        let own = times(&[0.0, 10.0, 9.95, 10.0, 5.0, 0.0, 0.0, 5.0, 10.0], 10.0);
        let known: Vec<f64> = own.iter().flatten().copied().collect();
        // What lies behind the first of two tops is on the way back.
        let right = [0.0, 1.0, 1.005, 1.5, 2.0, 2.5, 3.0];
        let is_near = |own: (&f64, &f64)| (own.0 - own.1).abs() < 1e-12;
        assert!(known.len() == right.len() && known.iter().zip(&right).all(is_near), "{known:?}");
        assert!(times(&[], 1.0).is_empty());
    }
}
