//! Spring with a measured curve.

use super::{Element, ElementKind, Law, Tangent};
use crate::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value};

/// A spring whose force is interpolated between points `(y_i, F_i)` of a measured curve.
///
/// | symbol     | field    | unit | range |
/// |------------|----------|------|-------|
/// | `y_i`      | `points` | m    | rising, at least two |
/// | `F_i`      | `points` | N    | never falling; one point is (0, 0) |
///
/// Between the points lie cubics with common slopes at the points (Fritsch and Carlson, slopes by
/// Fritsch and Butland): the curve and its slope are continuous, the curve never falls, and it
/// bends over no further than the points do. Where the force of two points is the same, the curve
/// between them is flat. The spring stores `∫ F dy` and dissipates none.
///
/// # Limits
///
/// Beyond the first and the last point the curve goes on as a straight line with the slope that it
/// has there: for three points or more that of the parabola through the last three, so it is
/// steeper or flatter than the last interval. A run warns of it. So a table that begins at (0, 0) says nothing of tension: the spring pulls with the
/// slope at rest, which is zero where the curve begins bent upwards. A first point such as
/// `["-10 mm", "0 N"]` keeps it from pulling.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::TableSpring};
///
/// let spring = TableSpring::new(vec![(0.0, 0.0), (0.01, 100.0), (0.02, 400.0)])?;
/// assert_eq!(spring.force(0.01, 0.0), 100.0);
/// assert!(spring.force(0.015, 0.0) < 250.0);
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # References
///
/// `fritsch1980` and `fritsch1984` in `docs/references.bib`.
#[derive(Debug, Clone, PartialEq)]
pub struct TableSpring {
    points: Vec<(f64, f64)>,
    /// Slope of the curve at each point \[N/m\].
    slopes: Vec<f64>,
    /// Integral of the force from the first point to each \[J\].
    areas: Vec<f64>,
    /// The integral from the first point to zero deformation \[J\].
    at_rest: f64,
}

const POINTS: &str = "table-spring";

impl TableSpring {
    /// The spring through these points of deformation \[m\] and force \[N\].
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for fewer than two points, numbers that are not finite, deformations
    /// that do not rise, forces that fall, a force that is the same everywhere, and points of which
    /// none is (0, 0).
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, InvalidParameter> {
        check(&points)?;
        let spring = Self::through(points);
        let is_finite = |all: &[f64]| all.iter().all(|own| own.is_finite());
        if is_finite(&spring.slopes) && is_finite(&spring.areas) {
            Ok(spring)
        } else {
            let range = "such that the slopes and areas of the curve fit into double precision";
            Err(InvalidParameter::new(POINTS, range, "beyond that"))
        }
    }

    /// The spring through points that are in order.
    fn through(points: Vec<(f64, f64)>) -> Self {
        let slopes = slopes(&points);
        let mut spring = Self { points, slopes, areas: vec![0.0], at_rest: 0.0 };
        for at in 1..spring.points.len() {
            let area = spring.areas[at - 1] + spring.interval(at - 1).area(1.0);
            spring.areas.push(area);
        }
        let rest = spring.points.iter().position(|&(at, _)| at.abs() <= 0.0);
        spring.at_rest = rest.map_or(0.0, |at| spring.areas[at]);
        spring
    }

    /// Points of deformation \[m\] and force \[N\].
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
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

    /// Where a deformation lies.
    fn place(&self, deformation: f64) -> Place {
        let last = self.points.len() - 1;
        if deformation < self.points[0].0 {
            return Place::Outside(0, deformation - self.points[0].0);
        }
        if deformation > self.points[last].0 {
            return Place::Outside(last, deformation - self.points[last].0);
        }
        let at = self.points.partition_point(|point| point.0 <= deformation).clamp(1, last) - 1;
        let interval = self.interval(at);
        Place::Inside(at, (deformation - self.points[at].0) / interval.width, interval)
    }
}

/// Where a deformation lies in a table.
enum Place {
    /// Beyond the point of this number, by so much \[m\].
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

fn check(points: &[(f64, f64)]) -> Result<(), InvalidParameter> {
    let invalid = |range: &'static str, found: String| InvalidParameter::new(POINTS, range, found);
    if points.len() < 2 {
        return Err(invalid("two points or more", format!("{}", points.len())));
    }
    if let Some(point) = points.iter().find(|own| !own.0.is_finite() || !own.1.is_finite()) {
        return Err(invalid("finite", format!("{point:?}")));
    }
    for pair in points.windows(2) {
        let [(from, start), (to, end)] = [pair[0], pair[1]];
        if to <= from {
            let range = "in rising order of the deformation";
            return Err(invalid(range, format!("{to:?} after {from:?}")));
        }
        if end < start {
            let range = "of forces that never fall as the deformation rises";
            return Err(invalid(range, format!("{end:?} after {start:?}")));
        }
    }
    if points[points.len() - 1].1 <= points[0].1 {
        return Err(invalid("of forces that rise", format!("{:?} everywhere", points[0].1)));
    }
    if points.iter().any(|own| own.0.abs() <= 0.0 && own.1.abs() <= 0.0) {
        Ok(())
    } else {
        let range = "a curve through [0, 0], given as one of its points";
        Err(invalid(range, "without that point".to_owned()))
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

impl Element for TableSpring {
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        match self.place(deformation) {
            Place::Outside(at, beyond) => self.points[at].1 + self.slopes[at] * beyond,
            Place::Inside(_, part, interval) => interval.value(part),
        }
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        let stiffness = match self.place(deformation) {
            Place::Outside(at, _) => self.slopes[at],
            Place::Inside(_, part, interval) => interval.slope(part),
        };
        Tangent { stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        let area = match self.place(deformation) {
            Place::Outside(at, beyond) => {
                self.areas[at] + (self.points[at].1 + 0.5 * self.slopes[at] * beyond) * beyond
            }
            Place::Inside(at, part, interval) => self.areas[at] + interval.area(part),
        };
        area - self.at_rest
    }

    fn law(&self) -> Law {
        let [first, last] = [self.points[0], self.points[self.points.len() - 1]];
        Law::Nonlinear { stiffness: (last.1 - first.1) / (last.0 - first.0), damping: 0.0 }
    }

    fn measured(&self) -> Option<(f64, f64)> {
        Some((self.points[0].0, self.points[self.points.len() - 1].0))
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        check(&self.points)
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Table(self.points.clone())]
    }
}

impl ElementKind for TableSpring {
    const KIND: &'static str = "table-spring";
    const SUMMARY: &'static str =
        "spring through points of a measured curve, smooth and never falling";
    const PARAMETERS: &'static [Parameter] = &[Parameter::required(
        POINTS,
        ParameterKind::Curve(Dimension::LENGTH, Dimension::FORCE),
        "points of deformation [m] and force [N], rising, one of them [0, 0]; straight on beyond \
         them, which a run warns of",
    )];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        match values.first() {
            Some(Value::Table(points)) => Self::new(points.clone()),
            _ => Err(InvalidParameter::new(POINTS, "a list of points", "missing")),
        }
    }

    fn sample() -> Self {
        Self::through(vec![(0.0, 0.0), (0.004, 500.0), (0.012, 800.0), (0.02, 3000.0)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_fritsch_and_butland() {
        // By hand: 9/(5/1 + 4/½) inside, 1 + ½/3 and ½ − 1/3 at the ends.
        let spring = TableSpring::new(vec![(0.0, 0.0), (1.0, 1.0), (3.0, 2.0)]).unwrap();
        for (y, slope) in [(0.0, 7.0 / 6.0), (1.0, 9.0 / 13.0), (3.0, 1.0 / 6.0)] {
            assert!((spring.tangent(y, 0.0).stiffness - slope).abs() < 1e-15, "{y}");
        }
        // Midway a cubic lies off the chord by an eighth of the difference of its end slopes.
        let middle = 0.5 + (7.0 / 6.0 - 9.0 / 13.0) / 8.0;
        assert!((spring.force(0.5, 0.0) - middle).abs() < 1e-15);
        let area = 0.5 + (7.0 / 6.0 - 9.0 / 13.0) / 12.0;
        assert!((spring.stored(1.0) - area).abs() < 1e-15);
    }

    #[test]
    fn points_on_a_line_give_that_line_everywhere() {
        let points = [-0.3, -0.1, 0.0, 0.05, 0.4].map(|y| (y, 700.0 * y)).to_vec();
        let spring = TableSpring::new(points).unwrap();
        for y in [-1.0, -0.3, -0.2, -1e-9, 0.02, 0.3, 2.0] {
            assert!((spring.force(y, 0.0) - 700.0 * y).abs() < 1e-12 * 700.0);
            assert!((spring.stored(y) - 350.0 * y * y).abs() < 1e-12 * 350.0);
            assert!((spring.tangent(y, 0.0).stiffness - 700.0).abs() < 1e-10);
        }
    }

    #[test]
    fn a_curve_with_a_plateau_and_a_wall_never_falls_and_never_overshoots() {
        let points = vec![
            (-0.01, 0.0),
            (0.0, 0.0),
            (0.001, 300.0),
            (0.008, 300.0),
            (0.0081, 5e3),
            (0.01, 5e3 + 1e-9),
            (0.011, 9e5),
        ];
        let spring = TableSpring::new(points.clone()).unwrap();
        for pair in points.windows(2) {
            let mut last = pair[0].1;
            for at in 0..=1000 {
                let y = pair[0].0 + (pair[1].0 - pair[0].0) * f64::from(at) / 1000.0;
                let force = spring.force(y, 0.0);
                assert!(force >= last - 1e-12 * pair[1].1 && force <= pair[1].1 * (1.0 + 1e-12));
                last = force;
            }
        }
        assert!(spring.force(-0.5, 0.0).abs() <= 0.0, "it pulls");
    }

    #[test]
    fn tables_that_are_no_curve_of_a_spring_are_refused() {
        let reason =
            |points: &[(f64, f64)]| TableSpring::new(points.to_vec()).unwrap_err().to_string();
        assert!(reason(&[(0.0, 0.0)]).contains("two points"));
        assert!(reason(&[(0.0, 0.0), (0.0, 1.0)]).contains("rising order"));
        assert!(reason(&[(0.0, 0.0), (1.0, 2.0), (2.0, 1.0)]).contains("never fall"));
        assert!(reason(&[(0.0, 0.0), (1.0, 0.0)]).contains("rise"));
        assert!(reason(&[(0.1, 0.0), (1.0, 2.0)]).contains("[0, 0]"));
        assert!(reason(&[(0.0, 0.0), (1.0, f64::INFINITY)]).contains("finite"));
        assert!(reason(&[(0.0, 0.0), (1e-200, 1e200)]).contains("double precision"));
    }
}
