//! The interval that maximises the head injury criterion.

mod area;
mod hump;
mod search;

use area::{Area, Sense};
use dashpot_dae::Signal;
use search::{Search, better, searched};

/// What may be missed of a maximum, in parts of it: boxes that can exceed the best interval by no more are dropped.
pub const RESOLUTION: f64 = 1e-12;

/// The interval `[t1, t2]` that maximises `(t2 − t1)(V/(t2 − t1))^2.5`, `V = |∫ s dt|`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optimum {
    /// The maximum \[unit^2.5·s\].
    pub value: f64,
    /// Its interval \[s\].
    pub interval: (f64, f64),
    /// How much larger a maximum that was missed could be, beyond [`RESOLUTION`].
    pub threshold: f64,
}

impl Optimum {
    /// That of nothing.
    fn none(window: (f64, f64)) -> Self {
        Self { value: 0.0, interval: (window.0, window.0), threshold: 0.0 }
    }
}

/// Finds the largest head injury criterion of a signal over all intervals in the window that are no longer than `cap`.
///
/// The signal of one axis counts with its sign, as SAE J885 and ISO 6487 have it of a channel: a swing back takes from the
/// area. It is looked at in both senses.
///
/// # What is proved
///
/// Let `V` be the area, `T = t2 − t1`, `m = V/T` and `J = V^2.5/T^1.5`. The signal is cut at its extrema, zeros and
/// jumps into monotone pieces, so that on a range inside one it lies between its values at both ends; areas come from
/// exact antiderivatives. Branch and bound over boxes of pairs `(t1, t2)` begins with one box of all, divides each into
/// closed ones that cover it, and drops a box for one of three reasons.
///
/// 1. *By area and length.* In a box no area exceeds `A`, the positive area from its earliest start to its latest end
///    (and the signed one between the ranges, where they are apart), no signal exceeds `H`, and no interval is shorter
///    than `S`. As `T ≥ max(S, V/H)` and `V^2.5/max(S, V/H)^1.5` rises with `V`, `J ≤ A^2.5/max(S, A/H)^1.5`.
/// 2. *By slopes*, where both ranges lie within pieces and `m` between positive bounds: `∂ln J/∂t1 = (1.5 − 2.5 s(t1)/m)/T`
///    and `∂ln J/∂t2 = (2.5 s(t2)/m − 1.5)/T`. With `g1`, `g2` no smaller than their magnitudes in the box,
///    `ln J ≤ ln J(middle) + (g1 w1 + g2 w2)/2` of its sides `w`.
/// 3. *By signs:* where a derivative has one sign throughout, `J` is no larger than at one edge. That edge is kept where
///    the signal jumps or ends; elsewhere the signal is continuous, so that the derivative has this sign at the edge as
///    well, and a little beyond it, in the neighbouring box, `J` is larger.
///
/// Intervals as long as the cap are a family of their own, over which 1 holds with `T` known, and `dV/dt1 = s(t1 + cap) −
/// s(t1)` stands for 2 and 3. So the maximum is the best interval that was met, or exceeds it by no more than
/// [`RESOLUTION`] and the `threshold`, which is what is left where boxes are given up. A signal with a single hump needs no
/// more than a search over its levels, with a bound as strict.
///
/// Dense output of a run and the line between the samples of a record are both such signals.
pub fn optimum(signal: &Signal, window: (f64, f64), cap: f64) -> Optimum {
    Windows::of(signal, window).optimum(cap)
}

/// A signal in a window, cut and summed for searches with several caps.
#[derive(Debug)]
pub struct Windows<'a> {
    window: (f64, f64),
    /// The area of the magnitude, or of both senses where the signal has both signs: that with more area first, so that
    /// what the other one has to exceed ends its search at once.
    areas: Vec<Area<'a>>,
}

impl<'a> Windows<'a> {
    /// The signal in a window.
    pub fn of(signal: &'a Signal, window: (f64, f64)) -> Self {
        let area = Area::new(signal, window);
        if !area.changes_sign() {
            return Self { window, areas: vec![area] };
        }
        let [with, against] = area.of_signs();
        let first = if with >= against { 1.0 } else { -1.0 };
        let areas = [first, -first].map(|sign| area.in_sense(Sense::Along(sign)));
        Self { window, areas: areas.into() }
    }

    /// The largest criterion over all intervals that are no longer than `cap`, as by [`optimum`].
    pub fn optimum(&self, cap: f64) -> Optimum {
        match self.areas.as_slice() {
            [area] => hump::optimum(area, cap).unwrap_or_else(|| searched(area, self.window, cap)),
            areas => {
                let none = Optimum::none(self.window);
                areas.iter().fold(none, |best, area| better(area, cap, best))
            }
        }
    }

    /// The same over intervals that begin and end at some of these rising times, the samples of a record; they may be as
    /// long as the cap but for rounding, and count as those that are no longer. No value exceeds that of
    /// [`optimum`](Self::optimum), whose interval is `near`.
    pub fn optimum_between(&self, cap: f64, (places, near): (&[f64], (f64, f64))) -> Optimum {
        let from = places.partition_point(|place| *place < near.0);
        let to = places.partition_point(|place| *place <= near.1).saturating_sub(1);
        let ends = places.get(from).copied().zip(places.get(to).copied());
        let in_sense = |best: Optimum, area: &Area<'_>| {
            let mut search = Search::new(area, cap, Some(places), best);
            if let Some((from, to)) = ends {
                search.consider(from, to);
            }
            search.run();
            search.best
        };
        self.areas.iter().fold(Optimum::none(self.window), in_sense)
    }
}

/// The same of the magnitude of a signal that has both signs in the window, as of a resultant; `None` of one that has
/// not, whose magnitude counts as the signal does.
pub(crate) fn optimum_of_magnitude(
    signal: &Signal,
    window: (f64, f64),
    cap: f64,
) -> Option<Optimum> {
    let area = Area::new(signal, window);
    let found = || hump::optimum(&area, cap).unwrap_or_else(|| searched(&area, window, cap));
    area.changes_sign().then(found)
}

/// The same for a signal that is positive in the window and rises to one place, and falls behind it; either may be
/// missing.
pub(crate) fn optimum_of_hump(signal: &Signal, window: (f64, f64), top: f64, cap: f64) -> Optimum {
    let area = Area::of_hump(signal, window, top);
    hump::optimum(&area, cap).unwrap_or_else(|| searched(&area, window, cap))
}

/// The one in the middle of those of rising times that lie between two.
fn middle_of(times: &[f64], from: f64, to: f64) -> Option<f64> {
    let first = rank(times, from, |time| *time <= from);
    let last = rank(times, to, |time| *time < to);
    (first < last).then(|| times[first.midpoint(last)])
}

/// How many of rising times are before something near a time: looked for from where it is if they are even, as samples
/// are, so that long records are not halved from end to end each time.
fn rank(times: &[f64], near: f64, is_before: impl Fn(&f64) -> bool) -> usize {
    let [Some(first), Some(last)] = [times.first(), times.last()] else { return 0 };
    let share = ((near - first) / (last - first)).clamp(0.0, 1.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is a share of the length; of NaN it is 0"
    )]
    let guess = (share * (times.len() - 1) as f64) as usize;
    let (mut low, mut high) = (guess, guess);
    let mut reach = 4;
    while low > 0 && !is_before(&times[low - 1]) {
        (low, reach) = (low.saturating_sub(reach), 2 * reach);
    }
    while high < times.len() && is_before(&times[high]) {
        (high, reach) = ((high + reach).min(times.len()), 2 * reach);
    }
    low + times[low..high].partition_point(is_before)
}

/// `T (V/T)^2.5`; 0 for an interval without length.
fn criterion(area: f64, length: f64) -> f64 {
    if length > 0.0 && area > 0.0 {
        let mean = area / length;
        length * mean * mean * mean.sqrt()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
