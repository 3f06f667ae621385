//! Where something ends that holds on one side.

/// Steps after which an edge is taken as it is.
const MOST_STEPS: usize = 60;

/// A place, and by how much what is asked for is exceeded there: zero or less where it holds, infinite where it does
/// not and nobody knows by how much.
pub(super) type Seen = (f64, f64);

/// The last place seen towards `without` at which something holds that holds at `with`, and the first one at which it
/// does not: no further apart than `nearest`. Steps are those of false position, each second one at least halves.
pub(super) fn edge(
    mut with: Seen,
    mut without: Seen,
    nearest: f64,
    mut excess: impl FnMut(f64) -> f64,
) -> [Seen; 2] {
    let mut halve = false;
    for _ in 0..MOST_STEPS {
        let width = without.0 - with.0;
        if width.abs() <= nearest {
            break;
        }
        let share = with.1 / (with.1 - without.1);
        let least = (0.5 * nearest / width.abs()).min(0.5);
        let is_known = share.is_finite() && without.1.is_finite() && !halve;
        let share = if is_known { share.clamp(least, 1.0 - least) } else { 0.5 };
        let place = with.0 + share * width;
        let own = (place, excess(place));
        *(if own.1 <= 0.0 { &mut with } else { &mut without }) = own;
        halve = (without.0 - with.0).abs() > 0.5 * width.abs();
    }
    [with, without]
}

/// The first place on the way from `edge` away from what lies beyond it, in growing steps of `nearest`, at which
/// something is `held` for certain; `inner` if there is none before.
pub(super) fn surely(edge: f64, inner: f64, nearest: f64, held: impl Fn(f64) -> bool) -> f64 {
    let (mut place, mut step) = (edge, nearest.copysign(inner - edge));
    while (inner - place) * step > 0.0 {
        if held(place) {
            return place;
        }
        place += step;
        step *= 2.0;
    }
    inner
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn an_edge_is_enclosed_in_few_steps_from_the_side_that_holds() {
        for turned in [1.0, -1.0] {
            let steps = Cell::new(0);
            let excess = |x: f64| {
                steps.set(steps.get() + 1);
                (turned * x).exp() - 2.0
            };
            let ends = [0.0, turned].map(|x| (x, excess(x)));
            let [with, without] = edge(ends[0], ends[1], 1e-6, excess);
            let right = turned * 2.0_f64.ln();
            assert!(with.1 <= 0.0 && without.1 > 0.0 && (with.0 - right).abs() <= 1e-6);
            assert!((without.0 - right).abs() <= 1e-6 && steps.get() < 16, "{}", steps.get());
        }
    }

    #[test]
    fn an_edge_of_which_only_the_side_is_known_is_halved() {
        let excess = |x: f64| if x < 0.3 { -1.0 } else { f64::INFINITY };
        let [with, without] = edge((0.0, -1.0), (1.0, f64::INFINITY), 1e-6, excess);
        assert!(with.0 < 0.3 && without.0 >= 0.3 && without.0 - with.0 <= 1e-6);
    }

    #[test]
    fn what_is_not_certain_at_an_edge_is_so_further_in() {
        assert!((surely(1.0, 0.0, 1e-3, |x| x < 0.99) - 0.985).abs() < 1e-12);
        assert_eq!(surely(1.0, 0.0, 1e-3, |_| true).to_bits(), 1.0_f64.to_bits());
        assert_eq!(surely(0.0, 1.0, 1e-3, |_| false).to_bits(), 1.0_f64.to_bits());
    }
}
