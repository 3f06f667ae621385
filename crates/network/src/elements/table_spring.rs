//! Spring with a measured curve.

use super::{Element, Law, Tangent, monotone::MonotoneCurve};
use crate::parameters::{
    CurveRole, Dimension, Given, InvalidParameter, Kind, Parameter, ParameterKind, Value,
};

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
/// Beyond the first and the last point the curve goes on as a straight line with the slope that it has there: for three
/// points or more that of the parabola through the last three, so it is steeper or flatter than the last interval. A
/// run warns of it. So a table that begins at (0, 0) says nothing of tension: the spring pulls with the slope at rest,
/// which is zero where the curve begins bent upwards. A first point such as `["-10 mm", "0 N"]` keeps it from pulling.
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
    curve: MonotoneCurve,
    /// The integral of the curve from the first point to zero deformation \[J\].
    at_rest: f64,
}

const POINTS: &str = "table-spring";

impl TableSpring {
    /// The spring through these points of deformation \[m\] and force \[N\].
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for fewer than two points, numbers that are not finite, deformations
    /// that do not rise, forces that fall, a force that is the same everywhere, and points of which none is (0, 0).
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, InvalidParameter> {
        check(POINTS, &points)?;
        let spring = Self::through(points);
        if spring.curve.is_finite() {
            Ok(spring)
        } else {
            let range = "such that the slopes and areas of the curve fit into double precision";
            Err(InvalidParameter::new(POINTS, range, "beyond that"))
        }
    }

    /// The spring through points that are in order.
    pub(crate) fn through(points: Vec<(f64, f64)>) -> Self {
        let curve = MonotoneCurve::through(points);
        let at_rest = curve.area(0.0);
        Self { curve, at_rest }
    }

    /// Points of deformation \[m\] and force \[N\].
    pub fn points(&self) -> &[(f64, f64)] {
        self.curve.points()
    }
}

/// Refuses points that are no curve of a spring through (0, 0).
pub(super) fn check(name: &'static str, points: &[(f64, f64)]) -> Result<(), InvalidParameter> {
    check_order(name, points)?;
    if points.iter().any(|point| point.0.abs() <= 0.0 && point.1.abs() <= 0.0) {
        return Ok(());
    }
    let range = "a curve through [0, 0], given as one of its points";
    Err(InvalidParameter::new(name, range, "without that point"))
}

/// Refuses points of which the forces fall, or are the same everywhere.
pub(super) fn check_order(
    name: &'static str,
    points: &[(f64, f64)],
) -> Result<(), InvalidParameter> {
    let invalid = |range: &'static str, found: String| InvalidParameter::new(name, range, found);
    if points.len() < 2 {
        return Err(invalid("two points or more", format!("{}", points.len())));
    }
    if let Some(point) = points.iter().find(|point| !point.0.is_finite() || !point.1.is_finite()) {
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
    Ok(())
}

impl Element for TableSpring {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.curve.value(deformation)
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.curve.slope(deformation), damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.curve.area(deformation) - self.at_rest
    }

    fn law(&self) -> Law {
        let [first, last] = self.curve.ends();
        Law::Nonlinear { stiffness: (last.1 - first.1) / (last.0 - first.0), damping: 0.0 }
    }

    fn range(&self) -> Option<(f64, f64)> {
        Some(self.curve.ends().map(|end| end.0).into())
    }

    fn cubics(&self) -> Option<Vec<f64>> {
        Some(self.points().iter().map(|point| point.0).collect())
    }
}

impl Kind for TableSpring {
    const KIND: &'static str = "table-spring";
    const SUMMARY: &'static str =
        "spring through points of a measured curve, smooth and never falling";
    const PARAMETERS: &'static [Parameter] = &[Parameter::new(
        POINTS,
        ParameterKind::Curve(Dimension::LENGTH, Dimension::FORCE),
        "points of deformation [m] and force [N], rising, one of them [0, 0]; straight on beyond \
         them, which a run warns of",
    )
    .curve(CurveRole::FromRest)];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Self::new(Given::new(Self::PARAMETERS, values).take()?)
    }

    fn fields(&self) -> Vec<Value> {
        vec![Value::Table(self.points().to_vec())]
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        check(POINTS, self.points())
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
