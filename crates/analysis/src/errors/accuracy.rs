//! How accurate measures are: error bars from several solutions.

use crate::{Reading, Solution, measures::STANDARD_GRAVITY};

/// Error in parts of a value whose first digit is just known.
pub(crate) const FIRST_DIGIT: f64 = 0.1;
/// Roundings, in units of the measure's size, that no error bar falls short of: the solutions that
/// it is taken from may agree by chance.
const ROUNDINGS: f64 = 64.0;

/// How many solutions error bars are taken from, that which is reported included.
pub(crate) const SOLUTIONS: usize = 4;
/// By how much errors may exceed what the differences of solutions tell.
const SAFETY: f64 = 5.4;
/// Part of the relative bars of the same run that is added to a bar, as the root of squares.
const SHARED: f64 = 0.2;
/// How many of the relative bars of a run are smaller than that part is taken of.
const RANK: f64 = 0.9;
/// Part of itself that no measure of a stepping method is known better than: balances are solved no better, and
/// where a kink ends the steps of all solutions alike they have that in common.
const SOLVED: f64 = 1e-12;
/// The power of the energy that forces, speeds and lengths go with: no measure is known better than the energy lost
/// makes of it.
const OF_ENERGY: f64 = 0.5;

/// What error bars are taken from.
#[derive(Debug)]
pub(crate) struct Evidence<'a> {
    /// Tolerance and readings of further solutions, in any order.
    pub(crate) others: Vec<(f64, &'a [Reading])>,
    /// Tolerance and readings of the finest one, which is reported.
    pub(crate) finest: (f64, &'a [Reading]),
    /// What energy that is lost makes of each measure: see [`of_energy`].
    pub(crate) least: Vec<f64>,
    /// The power of the tolerance with which the method's errors fall.
    pub(crate) fall: f64,
}

impl Evidence<'_> {
    /// The error bars of the finest solution.
    ///
    /// 1. Every further solution is off by about what it differs from the finest one, and errors fall
    ///    as the tolerance r to a power p, so each gives an estimate `|Q − Qₖ| (r/rₖ)^p` of the error
    ///    of Q. The bar is 5.4 times the root of the sum of their squares.
    /// 2. A fifth of what nine in ten bars of the same run do not exceed, in parts of the measures'
    ///    sizes, is added to the squares: where one measure agrees by chance, others do not.
    /// 3. What the loss of energy makes of the measure is added to the squares, and roundings come on top.
    ///
    /// Infinite where only some of the solutions have a value, or where the run might end before there
    /// is one, by the bar or by 5.4 times the largest difference; `None` where none has. A value that
    /// changes with the end of its window differs, besides, by what the window does at that rate.
    ///
    /// The numbers were chosen on 2400 generated scenes, and are tested on others.
    pub(crate) fn error_bars(&self) -> Vec<Option<f64>> {
        let (_, finest) = self.finest;
        let own: Vec<Option<f64>> = (0..finest.len()).map(|at| self.of_differences(at)).collect();
        let shared = self.shared(&own);
        let bar = |((reading, own), least): ((&Reading, Option<f64>), &f64)| {
            let whole =
                |own: f64| own.hypot(shared * reading.size).hypot(*least) + rounding(reading);
            let may_be_none = |bar: f64| reading.room.is_some_and(|room| bar > room);
            own.map(whole).map(|bar| if may_be_none(bar) { f64::INFINITY } else { bar })
        };
        finest.iter().zip(own).zip(&self.least).map(bar).collect()
    }

    /// The bar of one measure from its own differences.
    fn of_differences(&self, at: usize) -> Option<f64> {
        let (rtol, finest) = (self.finest.0, &self.finest.1[at]);
        let valued = self.others.iter().filter(|(_, other)| other[at].value.is_some()).count();
        let value = match finest.value {
            Some(value) if valued == self.others.len() => value,
            None if valued == 0 => return None,
            _ => return Some(f64::INFINITY),
        };
        let (mut root, mut largest) = (0.0_f64, 0.0_f64);
        for &(coarser, other) in &self.others {
            let other = &other[at];
            let gap = (other.value.unwrap_or(value) - value).abs() + of_window(finest, other);
            // Gaps of any size, whose squares may be no numbers.
            root = root.hypot(gap * (rtol / coarser).powf(self.fall));
            largest = largest.max(gap);
        }
        // Such a time is that of a release which hangs on the last digits: no tolerance mends it.
        let may_be_none = finest.room.is_some_and(|room| room < SAFETY * largest);
        Some(if may_be_none { f64::INFINITY } else { SAFETY * root })
    }

    /// What the others add to a bar, in parts of its measure's size.
    fn shared(&self, bars: &[Option<f64>]) -> f64 {
        let relative = self.finest.1.iter().zip(bars).filter_map(|(reading, bar)| {
            bar.filter(|bar| bar.is_finite() && reading.size > 0.0).map(|bar| bar / reading.size)
        });
        let mut relative: Vec<f64> = relative.collect();
        relative.sort_by(f64::total_cmp);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a small count"
        )]
        let at = (RANK * relative.len().saturating_sub(1) as f64).round() as usize;
        relative.get(at).map_or(0.0, |relative| SHARED * relative)
    }
}

/// How well a measure can be known at best where a solution loses the part `closure` of the energy `turned_over` \[J\]:
/// an energy to what is lost, an amplitude to half of that part, and an index, the power 2.5 of one, to 2.5 times as
/// much. It tells of what all solutions miss alike, because no tolerance but the room between their steps made them so.
pub(crate) fn of_energy(reading: &Reading, unit: &str, (closure, turned_over): (f64, f64)) -> f64 {
    let lost = closure.abs();
    let power = if unit == "s" { INJURY } else { 1.0 };
    let of_size = (power * OF_ENERGY * lost).max(SOLVED) * reading.size;
    if unit == "J" { of_size.max(lost * turned_over) } else { of_size }
}

/// What the difference of the windows' ends makes.
fn of_window(one: &Reading, other: &Reading) -> f64 {
    let Some((one_end, other_end)) =
        one.window.zip(other.window).map(|(one, other)| (one.1, other.1))
    else {
        return 0.0;
    };
    let fastest = one.end_rate.max(other.end_rate);
    if fastest > 0.0 { fastest * (one_end - other_end).abs() } else { 0.0 }
}

/// The error that rounding alone makes, in the value and in what it is the sum of.
pub(crate) fn rounding(reading: &Reading) -> f64 {
    (ROUNDINGS * f64::EPSILON * reading.size).max(reading.noise)
}

/// Part of the largest signal of a unit up to which an error cannot be told from none.
const NOTHING: f64 = 1e-12;
/// The same in parts of the relative accuracy wanted.
const LITTLE: f64 = 1e-3;

/// Whether a value might be zero, and would be of no account if it were not, where the largest
/// signal of its unit is `largest` and the relative accuracy `wish` is wanted.
pub(crate) fn is_as_good_as_zero(
    reading: &Reading,
    error: Option<f64>,
    (largest, wish): (f64, f64),
) -> bool {
    let is_within = |error: f64| reading.value.is_some_and(|value| value.abs() <= error);
    let limit = NOTHING.max(LITTLE * wish) * largest;
    error.is_some_and(|error| is_within(error) && error <= limit)
}

/// Part of the largest measure of its kind that one counts for at least: the wish for a smaller one is no
/// stricter, unless it is asked for by name.
pub(crate) const SMALL: f64 = 1e-3;
/// Whether the first digit of a value is known, as far as errors are.
pub(crate) fn is_determined(reading: &Reading, error: Option<f64>) -> bool {
    error.is_none_or(|error| error <= FIRST_DIGIT * reading.size)
}

/// Error that no number can do without: some of the smallest ones.
const SMALLEST: f64 = 64.0 * f64::MIN_POSITIVE * f64::EPSILON;

/// How large an error is in parts of what the relative accuracy wanted allows; at most 1 is good
/// enough. The error of what cannot be told from zero is.
pub(crate) fn excess(reading: &Reading, error: Option<f64>, wish: f64) -> f64 {
    let Some(error) = error.filter(|&error| error > 0.0) else { return 0.0 };
    if is_lost_in_noise(reading, Some(error)) {
        0.0
    } else {
        // Nothing is known better than to the smallest numbers that there are.
        error / (wish * reading.size).max(SMALLEST)
    }
}

/// Whether neither the value nor its error, which the noise is a part of, stands out of the noise.
pub(crate) fn is_lost_in_noise(reading: &Reading, error: Option<f64>) -> bool {
    let vanishes = reading.value.is_some_and(|value| value.abs() <= reading.noise);
    vanishes && error.is_some_and(|error| error <= 4.0 * reading.noise)
}

/// How many outputs are looked at, of those that were kept; fewer can only make a quantity seem smaller.
const MOST_OUTPUTS: usize = 1000;
/// An error so many times the largest of its kind tells nothing.
const FAR_BEYOND: f64 = 10.0;
/// The exponent of the injury measures.
const INJURY: f64 = 2.5;

/// The largest magnitude of any signal of this unit in the run in which so much energy is `turned_over` \[J\], or for units that no signal has,
/// what the largest signals would add up to; of impulses the largest momentum. It is 1 for what has no unit.
pub(crate) fn largest(solution: &Solution<'_>, turned_over: f64, unit: &str) -> f64 {
    match unit {
        "J" => turned_over,
        "N s" => largest_momentum(solution),
        "s" => {
            let highest = largest_signal(solution, "m/s^2") / STANDARD_GRAVITY;
            highest.powf(INJURY) * solution.end()
        }
        "1" => 1.0,
        unit => largest_signal(solution, unit),
    }
}

/// The largest momentum of a mass \[N s\]; 0 where none moves.
fn largest_momentum(solution: &Solution<'_>) -> f64 {
    let nodes = solution.assembly().nodes.iter().filter(|node| node.mass > 0.0);
    let speeds = nodes.filter_map(|node| Some((node.mass, node.velocity?)));
    let kept = speeds.filter(|(_, speed)| solution.keeps(*speed)).take(MOST_OUTPUTS);
    kept.map(|(mass, speed)| mass * solution.glance(speed).bound()).fold(0.0, f64::max)
}

/// Whether a value is not known at all: its error exceeds it, and what is wanted, and is far beyond the
/// largest of its kind.
pub(crate) fn is_open(
    reading: &Reading,
    error: Option<f64>,
    wish: f64,
    largest: impl FnOnce() -> f64,
) -> bool {
    let Some((value, error)) = reading.value.zip(error.filter(|error| error.is_finite())) else {
        return false;
    };
    error > value.abs() && error > wish * reading.size && error > FAR_BEYOND * largest()
}

fn largest_signal(solution: &Solution<'_>, unit: &str) -> f64 {
    let outputs = solution.assembly().system.outputs.iter().enumerate();
    let kept = outputs.filter(|(at, _)| solution.keeps(*at)).take(MOST_OUTPUTS);
    let alike = kept.filter(|(_, output)| output.unit == unit);
    alike.map(|(at, _)| solution.glance(at).bound()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(value: Option<f64>) -> Reading {
        Reading { value, size: value.unwrap_or(0.0).abs(), ..Reading::default() }
    }

    /// Bars of readings at falling tolerances, each a list of one solution's measures.
    fn bars(solutions: &[&[Reading]], least: f64) -> Vec<Option<f64>> {
        let rtol = |at: usize| 10.0_f64.powf(-4.0 - 0.5 * at as f64);
        let all = solutions.iter().enumerate();
        let mut all: Vec<_> = all.map(|(at, &readings)| (rtol(at), readings)).collect();
        let finest = all.pop().unwrap();
        let least = vec![least; finest.1.len()];
        Evidence { others: all, finest, least, fall: 0.8 }.error_bars()
    }

    #[expect(clippy::needless_pass_by_value, reason = "readings are made where they are used")]
    fn bar_of(readings: [Reading; 4], least: f64) -> Option<f64> {
        let solutions = readings.each_ref().map(std::slice::from_ref);
        bars(&solutions, least)[0]
    }

    /// What a measure adds to its own bar where it is alone.
    fn alone() -> f64 {
        1.0_f64.hypot(SHARED)
    }

    #[test]
    fn bar_sums_up_the_errors_that_all_solutions_tell_of() {
        // Each solution alone, and what is left of its difference at the finest tolerance.
        for (at, decades) in [(0, 1.5), (1, 1.0), (2, 0.5)] {
            let mut values = [1.0; 4];
            values[at] = 1.3;
            let bar = bar_of(values.map(|value| reading(Some(value))), 0.0).unwrap();
            let expected = alone() * SAFETY * 0.3 * 10.0_f64.powf(-0.8 * decades);
            assert!((bar - expected).abs() < 1e-12, "{at}: {bar}, not {expected}");
        }
        let three = [
            1.0 + 10.0_f64.powf(0.4 * 3.0),
            1.0 + 10.0_f64.powf(0.8),
            1.0 + 10.0_f64.powf(0.4),
            1.0,
        ];
        let bar = bar_of(three.map(|value| reading(Some(value))), 0.0).unwrap();
        assert!((bar - alone() * SAFETY * 3.0_f64.sqrt()).abs() < 1e-9, "{bar}");
        assert!(bar_of([1.0; 4].map(|value| reading(Some(value))), 0.0).unwrap() > 0.0);
    }

    #[test]
    fn measure_that_agrees_by_chance_gets_a_part_of_what_others_are_off_by() {
        let solution = |shift: f64| {
            let off = |size: f64| reading(Some(size * (1.0 + shift)));
            [off(1.0), off(10.0), off(100.0), reading(Some(5.0))]
        };
        let all = [solution(0.0), solution(0.0), solution(0.01), solution(0.0)];
        let solutions = all.each_ref().map(<[Reading; 4]>::as_slice);
        let found = bars(&solutions, 0.0);
        let whole = SAFETY * 0.01 * 10.0_f64.powf(-0.4);
        assert!((found[1].unwrap() / 10.0 - alone() * whole).abs() < 1e-12);
        assert!((found[3].unwrap() / 5.0 - 0.2 * whole).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn bar_does_not_depend_on_the_size_of_what_it_is_about() {
        let bar = |size: f64| {
            bar_of([1.3, 1.1, 1.01, 1.0].map(|value| reading(Some(size * value))), 0.0).unwrap()
        };
        for size in [1e-300, 1e-170, 1e170, 1e300] {
            assert!((bar(size) / size / bar(1.0) - 1.0).abs() < 1e-9, "{size:e}: {}", bar(size));
        }
    }

    #[test]
    fn energy_that_is_lost_widens_the_bar() {
        let force = reading(Some(4.0));
        assert!((of_energy(&force, "N", (-0.01, 50.0)) - 0.02).abs() < 1e-12);
        assert!((of_energy(&force, "s", (-0.01, 50.0)) - 0.05).abs() < 1e-12);
        assert!((of_energy(&force, "J", (-0.01, 50.0)) - 0.5).abs() < 1e-12);
        let bar = bar_of([(); 4].map(|()| force.clone()), 0.5).unwrap();
        assert!((bar - 0.5).abs() < 1e-12);
    }

    #[test]
    fn value_that_comes_and_goes_has_an_infinite_bar() {
        let at = |values: [Option<f64>; 4]| bar_of(values.map(reading), 0.0);
        assert_eq!(at([None, Some(1.0), Some(1.0), Some(1.0)]), Some(f64::INFINITY));
        assert_eq!(at([Some(1.0), Some(1.0), Some(1.0), None]), Some(f64::INFINITY));
        assert_eq!(at([None; 4]), None);
    }

    #[test]
    fn time_that_might_lie_beyond_the_run_has_an_infinite_bar() {
        let at = |value: f64| Reading { room: Some(1.0), ..reading(Some(value)) };
        let bar = |other: f64| bar_of([at(other), at(5.0), at(5.0), at(5.0)], 0.0).unwrap();
        assert!(bar(5.0 + 0.99 / SAFETY).is_finite());
        assert!(bar(5.0 - 1.01 / SAFETY).is_infinite());
    }

    #[test]
    fn end_of_the_window_that_moves_widens_the_bar() {
        let at =
            |end: f64| Reading { window: Some((0.0, end)), end_rate: 3.0, ..reading(Some(5.0)) };
        let bar = bar_of([at(1.0), at(1.0), at(1.02), at(1.0)], 0.0).unwrap();
        let expected = alone() * SAFETY * 3.0 * 0.02 * 10.0_f64.powf(-0.4);
        assert!((bar - expected).abs() < 1e-12, "{bar}");
    }

    #[test]
    fn bar_is_no_smaller_than_the_rounding_of_what_cancels() {
        let same = Reading { noise: 1e-9, ..reading(Some(1e-12)) };
        assert!(bar_of([(); 4].map(|()| same.clone()), 0.0).unwrap() >= 1e-9);
    }

    #[test]
    fn zero_with_an_error_that_is_nothing_counts_as_zero() {
        let zero = reading(Some(1e-30));
        assert!(is_as_good_as_zero(&zero, Some(1e-27), (1.0, 1e-3)));
        assert!(!is_as_good_as_zero(&zero, Some(1e-27), (1e-22, 1e-3)), "it is large here");
        // A thousandth of what is wanted of the largest one.
        assert!(is_as_good_as_zero(&zero, Some(9e-7), (1.0, 1e-3)));
        assert!(!is_as_good_as_zero(&zero, Some(2e-6), (1.0, 1e-3)));
        assert!(
            !is_as_good_as_zero(&reading(Some(1e-20)), Some(1e-27), (1.0, 1e-3)),
            "it is a number"
        );
    }
}
