//! A smooth curve through points that never falls.

/// Cubics between points `(x_i, v_i)` with common slopes at the points (Fritsch and Carlson, slopes
/// by Fritsch and Butland), and straight lines with the slopes at the ends beyond them.
///
/// Where the values of the points never fall, the curve does not either, and lies between those of its neighbours.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MonotoneCurve {
    points: Vec<(f64, f64)>,
    /// Slope of the curve at each point.
    slopes: Vec<f64>,
    /// Integral of the value from the first point to each.
    areas: Vec<f64>,
}

impl MonotoneCurve {
    /// The curve through two points or more, which are in rising order of `x`.
    pub(super) fn through(points: Vec<(f64, f64)>) -> Self {
        let slopes = slopes(&points);
        let mut curve = Self { points, slopes, areas: vec![0.0] };
        for at in 1..curve.points.len() {
            let area = curve.areas[at - 1] + curve.interval(at - 1).area(1.0);
            curve.areas.push(area);
        }
        curve
    }

    pub(super) fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The first and the last point.
    pub(super) fn ends(&self) -> [(f64, f64); 2] {
        [self.points[0], self.points[self.points.len() - 1]]
    }

    /// Whether its slopes and areas fit into double precision.
    pub(super) fn is_finite(&self) -> bool {
        self.slopes.iter().chain(&self.areas).all(|slope| slope.is_finite())
    }

    pub(super) fn value(&self, x: f64) -> f64 {
        match self.place(x) {
            Place::Outside(at, beyond) => self.points[at].1 + self.slopes[at] * beyond,
            Place::Inside(_, part, interval) => interval.value(part),
        }
    }

    pub(super) fn slope(&self, x: f64) -> f64 {
        match self.place(x) {
            Place::Outside(at, _) => self.slopes[at],
            Place::Inside(_, part, interval) => interval.slope(part),
        }
    }

    /// The integral of the value from the first point to `x`.
    pub(super) fn area(&self, x: f64) -> f64 {
        match self.place(x) {
            Place::Outside(at, beyond) => {
                self.areas[at] + (self.points[at].1 + 0.5 * self.slopes[at] * beyond) * beyond
            }
            Place::Inside(at, part, interval) => self.areas[at] + interval.area(part),
        }
    }

    fn interval(&self, at: usize) -> Interval {
        let [(from, start), (to, end)] = [self.points[at], self.points[at + 1]];
        let width = to - from;
        let rise = end - start;
        let [first, last] = [self.slopes[at] * width, self.slopes[at + 1] * width];
        Interval {
            width,
            // The cubic over the part s of the interval, from 0 to 1.
            coefficients: [
                start,
                first,
                3.0 * rise - 2.0 * first - last,
                first + last - 2.0 * rise,
            ],
        }
    }

    /// Where `x` lies.
    fn place(&self, x: f64) -> Place {
        let last = self.points.len() - 1;
        if x < self.points[0].0 {
            return Place::Outside(0, x - self.points[0].0);
        }
        if x > self.points[last].0 {
            return Place::Outside(last, x - self.points[last].0);
        }
        let at = self.points.partition_point(|point| point.0 <= x).clamp(1, last) - 1;
        let interval = self.interval(at);
        Place::Inside(at, (x - self.points[at].0) / interval.width, interval)
    }
}

/// Where a number lies among the points.
enum Place {
    /// Beyond the point of this number, by so much.
    Outside(usize, f64),
    /// At this part of the interval of this number.
    Inside(usize, f64, Interval),
}

/// A cubic over the part of an interval.
struct Interval {
    width: f64,
    coefficients: [f64; 4],
}

impl Interval {
    fn value(&self, part: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        a + part * (b + part * (c + part * d))
    }

    fn slope(&self, part: f64) -> f64 {
        let [_, b, c, d] = self.coefficients;
        (b + part * (2.0 * c + part * 3.0 * d)) / self.width
    }

    /// The integral of the value from the interval's beginning.
    fn area(&self, part: f64) -> f64 {
        let [a, b, c, d] = self.coefficients;
        self.width * part * (a + part * (b / 2.0 + part * (c / 3.0 + part * d / 4.0)))
    }
}

/// Slopes at the points: between two intervals the weighted harmonic mean of theirs, at the ends
/// that of the parabola through three points, bounded so that the curve does not fall.
fn slopes(points: &[(f64, f64)]) -> Vec<f64> {
    let widths: Vec<f64> = points.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
    let secants: Vec<f64> = points
        .windows(2)
        .zip(&widths)
        .map(|(pair, width)| (pair[1].1 - pair[0].1) / width)
        .collect();
    let last = secants.len() - 1;
    if last == 0 {
        return vec![secants[0]; 2];
    }
    let inner = |at: usize| {
        let (before, after) = (secants[at - 1], secants[at]);
        if before <= 0.0 || after <= 0.0 {
            return 0.0;
        }
        let (w, z) = (widths[at - 1] + 2.0 * widths[at], 2.0 * widths[at - 1] + widths[at]);
        (w + z) / (w / before + z / after)
    };
    let end = |own: usize, next: usize| {
        let (h, s) = (widths[own], secants[own]);
        let slope = s + (s - secants[next]) * h / (h + widths[next]);
        slope.clamp(0.0, 3.0 * s)
    };
    let mut slopes = vec![end(0, 1)];
    slopes.extend((1..=last).map(inner));
    slopes.push(end(last, last - 1));
    slopes
}
