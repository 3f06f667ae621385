//! Equations of motion written out by hand, solved by the classical Runge–Kutta method.

/// One step of length `h` from `t`.
pub(super) fn step<const N: usize>(
    t: f64,
    h: f64,
    state: [f64; N],
    rates: &impl Fn(f64, &[f64; N]) -> [f64; N],
) -> [f64; N] {
    let moved = |by: f64, rate: &[f64; N]| std::array::from_fn(|at| state[at] + by * rate[at]);
    let first = rates(t, &state);
    let second = rates(t + 0.5 * h, &moved(0.5 * h, &first));
    let third = rates(t + 0.5 * h, &moved(0.5 * h, &second));
    let fourth = rates(t + h, &moved(h, &third));
    std::array::from_fn(|at| {
        state[at] + h / 6.0 * (first[at] + 2.0 * (second[at] + third[at]) + fourth[at])
    })
}

/// One step as by [`step`], or a shorter one to where `guard` falls to zero. The time and the state at
/// its end, and whether the guard fell.
pub(super) fn guarded<const N: usize>(
    t: f64,
    h: f64,
    state: [f64; N],
    rates: &impl Fn(f64, &[f64; N]) -> [f64; N],
    guard: impl Fn(&[f64; N]) -> f64,
) -> (f64, [f64; N], bool) {
    let whole = step(t, h, state, rates);
    if guard(&whole) >= 0.0 || guard(&state) <= 0.0 {
        return (t + h, whole, false);
    }
    let part = zero(0.0, h, |part| guard(&step(t, part, state, rates)));
    (t + part, step(t, part, state, rates), true)
}

/// The largest of values given one after another, between them as well: by parabolas through three.
#[derive(Clone, Copy)]
pub(super) struct Peak {
    last: [(f64, f64); 2],
    pub(super) value: f64,
}

impl Peak {
    pub(super) const NONE: Self = Self { last: [(0.0, 0.0); 2], value: 0.0 };

    pub(super) fn see(&mut self, t: f64, value: f64) {
        let [(t0, first), (t1, second)] = self.last;
        self.last = [(t1, second), (t, value)];
        self.value = self.value.max(value);
        if t0 < t1 && first < second && second > value {
            let (left, right) = ((second - first) / (t1 - t0), (value - second) / (t - t1));
            let bend = (right - left) / (t - t0);
            let slope = left + bend * (t1 - t0);
            self.value = self.value.max(second - 0.25 * slope * slope / bend);
        }
    }
}

/// Solves with two step lengths, and returns the finer results and how wrong each of them may be:
/// twice what separates them, which covers order 1 and better, and rounding.
///
/// `results` is given a step length and returns what is to be known, to 10⁻⁵ at the longer one.
pub(super) fn refined<const M: usize>(
    length: f64,
    results: impl Fn(f64) -> [f64; M],
) -> [(f64, f64); M] {
    let (coarse, fine) = (results(length), results(0.5 * length));
    std::array::from_fn(|at| {
        let apart = (coarse[at] - fine[at]).abs();
        assert!(apart <= 1e-5 * fine[at].abs(), "result {at}: {} and {}", coarse[at], fine[at]);
        (fine[at], 2.0 * apart + 1e-8 * fine[at].abs())
    })
}

/// The zero of a function that changes its sign between `low` and `high`, by bisection.
pub(super) fn zero(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (low, high);
    let rises = f(high) > f(low);
    assert!(f(low) * f(high) <= 0.0, "no sign change: {} and {}", f(low), f(high));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == rises { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The integral of a smooth function by Simpson's rule on 4000 intervals.
pub(super) fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let h = (to - from) / 4000.0;
    let point = |at: u32| f(from + h * f64::from(at));
    let inner: f64 = (1..4000).map(|at| if at % 2 == 1 { 4.0 } else { 2.0 } * point(at)).sum();
    h / 3.0 * (point(0) + inner + point(4000))
}
