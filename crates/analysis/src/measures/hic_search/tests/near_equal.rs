//! Pulses whose two best intervals are nearly as good as each other, against all intervals of a grid.

use dashpot_dae::{Panel, Signal};
use dashpot_numerics::Stream;

use super::*;

/// Straight lines through points of time and height; a jump where two points have one time.
struct Pulse(Vec<(f64, f64)>);

impl Pulse {
    fn end(&self) -> f64 {
        self.0[self.0.len() - 1].0
    }

    fn signal(&self) -> Signal {
        let lines = self.0.windows(2).filter(|pair| pair[1].0 > pair[0].0);
        let panels = lines.map(|pair| Panel {
            start: pair[0].0,
            end: pair[1].0,
            coefficients: [0.5 * (pair[0].1 + pair[1].1), 0.5 * (pair[1].1 - pair[0].1)].into(),
        });
        Signal::new(panels.collect(), None, 0.0)
    }

    /// Times, among them all points, and areas up to there.
    fn areas(&self, step: f64) -> Vec<(f64, f64)> {
        let mut all = vec![(0.0, 0.0)];
        let mut area = 0.0;
        for pair in self.0.windows(2) {
            let [(from, first), (to, last)] = [pair[0], pair[1]];
            let parts = ((to - from) / step).ceil();
            let mut part = 1.0;
            while part <= parts {
                let share = part / parts;
                let mean = first + 0.5 * share * (last - first);
                let until = area + share * (to - from) * mean;
                all.push((from + share * (to - from), until));
                part += 1.0;
            }
            area += 0.5 * (to - from) * (first + last);
        }
        all
    }

    /// The largest criterion of intervals between times of a grid.
    fn brute(&self, step: f64, cap: f64) -> f64 {
        let all = self.areas(step);
        let mut best = 0.0_f64;
        for (at, from) in all.iter().enumerate() {
            for to in &all[at + 1..] {
                let (length, area) = (to.0 - from.0, to.1 - from.1);
                if length > cap {
                    break;
                }
                let (square, cube) = (area * area, length * length * length);
                best = best.max(square * square * area.abs() / cube);
            }
        }
        best.sqrt()
    }
}

/// A height in a range at which two numbers that depend on it are equal, one rising faster than the other.
fn balanced(range: (f64, f64), lead: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = range;
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if lead(middle) > 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// A number between two.
fn within(stream: &mut Stream, low: f64, high: f64) -> f64 {
    low + (high - low) * stream.share()
}

/// What a window over an area is worth.
fn worth(area: f64, length: f64) -> f64 {
    area.powf(2.5) / length.powf(1.5)
}

/// A peak with a shoulder that is as good with it as without it, but for a little.
fn shoulder(stream: &mut Stream) -> Pulse {
    let (rise, fall) = (within(stream, 0.5, 3.0), within(stream, 0.5, 3.0));
    let length = within(stream, 1.0, 8.0);
    // Of a triangle, the upper 4/7 count; with the shoulder, what is above it.
    let alone = worth(20.0 / 49.0 * (rise + fall), 4.0 / 7.0 * (rise + fall));
    let height = balanced((0.0, 0.9), |height| {
        let foot = (1.0 - height) * (rise + fall);
        worth(height * (foot + length) + 0.5 * (1.0 - height) * foot, foot + length) - alone
    });
    let height = height * within(stream, 0.97, 1.03);
    let down = rise + fall * (1.0 - height);
    let slope = within(stream, 0.0, 0.02);
    let points = vec![
        (0.0, 0.0),
        (rise, 1.0),
        (down, height),
        (down + length, height * (1.0 - slope)),
        (down + length * within(stream, 1.0, 1.2) + 0.1, 0.0),
    ];
    Pulse(points)
}

/// Two humps, about as good alone as together.
fn humps(stream: &mut Stream) -> Pulse {
    let width = within(stream, 0.6, 2.0);
    let alone = worth(20.0 / 49.0 * width, 4.0 / 7.0 * width);
    let dip = balanced((0.0, 0.9), |dip| {
        let (foot, gap) = ((1.0 - dip) * width, 0.5);
        worth(2.0 * (dip * foot + 0.5 * (1.0 - dip) * foot) + gap * dip, 2.0 * foot + gap) - alone
    });
    let dip = dip * within(stream, 0.97, 1.03);
    let second = 1.0 + 1e-3 * within(stream, -1.0, 1.0);
    let foot = 0.5 * width * (1.0 - dip);
    let down = 0.5 * width + foot;
    let up = down + 0.5;
    Pulse(vec![
        (0.0, 0.0),
        (0.5 * width, 1.0),
        (down, dip),
        (up, dip),
        (up + foot, second),
        (up + foot + 0.5 * width, 0.0),
    ])
}

/// Stairs of plateaus with jumps or ramps between them, each as good with the ones above as these alone.
fn stairs(stream: &mut Stream) -> Pulse {
    let ramp = if stream.below(2) == 0 { 0.0 } else { 1e-3 };
    let (mut area, mut length, mut time) = (1.0, 1.0, 1.0);
    let mut points = vec![(0.0, 1.0), (1.0, 1.0)];
    for _ in 0..2 + stream.below(3) {
        let more = within(stream, 0.2, 2.0);
        let level = balanced((0.0, 1.0), |level| {
            worth(area + level * more, length + more) - worth(area, length)
        });
        let level = level * within(stream, 0.99, 1.01);
        points.push((time + ramp, level));
        time += ramp + more;
        points.push((time, level));
        area += level * more;
        length += more;
    }
    points.push((time + ramp, 0.0));
    points.push((time + 1.0, 0.0));
    Pulse(points)
}

/// A measured pulse of a head on a pad: a peak, and a shoulder at 58 g; every 0.5 ms \[g0\].
const HEAD: [f64; 27] = [
    20.099, 51.388, 74.938, 93.831, 108.545, 119.841, 131.153, 129.458, 129.320, 117.737, 97.941,
    90.637, 78.189, 63.776, 60.569, 58.435, 58.426, 58.382, 58.329, 57.951, 57.672, 57.658, 46.873,
    42.239, 27.965, 16.125, 1.862,
];

/// That pulse with heights and times bent a little.
fn warped(stream: &mut Stream) -> Pulse {
    let [lean, bend, wave] = [0.15, 0.1, 0.03].map(|most| within(stream, -most, most));
    let mut time = 0.0;
    let points = HEAD.iter().enumerate().map(|(at, height)| {
        let place = at as f64 / 26.0;
        let bent = 1.0 + lean * (place - 0.5) + bend * (2.0 * PI * place).sin();
        let point = (time, height * bent * (1.0 + wave * (20.0 * place).sin()));
        time += 0.5 * within(stream, 0.8, 1.2);
        point
    });
    Pulse(points.collect())
}

/// Compares so many pulses of each kind; the ones at which the search has less than the grid.
fn compare(kind: fn(&mut Stream) -> Pulse, count: usize, seed: u64) {
    let stream = &mut Stream::new(seed);
    for at in 0..count {
        let pulse = kind(stream);
        let (signal, end) = (pulse.signal(), pulse.end());
        let cap = if at % 4 == 0 { end * within(stream, 0.2, 1.0) } else { f64::INFINITY };
        let windows = Windows::of(&signal, (0.0, end));
        let found = windows.optimum(cap);
        let step = end / 120.0;
        let grid = pulse.brute(step, cap);
        assert!(found.value >= grid * (1.0 - 1e-9), "{at}: {found:?}, and {grid}: {:?}", pulse.0);
        assert!(found.threshold <= 1e-9 * found.value, "{at}: {found:?}: {:?}", pulse.0);
        // The best interval moved inwards to the grid loses no more area than this.
        let length = found.interval.1 - found.interval.0;
        let area = (found.value * length.powf(1.5)).powf(0.4);
        let highest = pulse.0.iter().map(|point| point.1).fold(0.0, f64::max);
        let least = worth((area - 2.0 * step * highest).max(0.0), length);
        assert!(grid >= least, "{at}: {found:?}, and {grid}: {:?}", pulse.0);
        assert!(length <= cap * (1.0 + 1e-12), "{at}: {found:?}, up to {cap}");
        let samples: Vec<f64> = pulse.0.iter().map(|point| point.0).collect();
        let by_samples = windows.optimum_between(cap, (&samples, found.interval));
        let most = found.value * (1.0 + RESOLUTION);
        assert!(by_samples.value <= most, "{at}: {found:?}, {by_samples:?}");
    }
}

#[test]
fn of_two_intervals_that_are_nearly_as_good_the_better_one_is_found() {
    for (seed, kind) in [(1, shoulder as fn(&mut Stream) -> Pulse), (2, humps), (3, stairs)] {
        compare(kind, 2500, seed);
    }
    compare(warped, 2500, 4);
}
