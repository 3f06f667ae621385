//! Springs of straight lines.

use std::sync::Arc;

use super::{Element, Law, Tangent, line::Line, table_spring::check_order};
use crate::{
    parameters::{Dimension, Given, InvalidParameter, Kind, Parameter, ParameterKind, Value},
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// A piecewise linear spring: straight lines between points `(y_i, F_i)`.
///
/// | symbol | field    | unit | range |
/// |--------|----------|------|-------|
/// | `y_i`  | `points` | m    | rising, at least two |
/// | `F_i`  | `points` | N    | never falling |
///
/// The first and the last line go on without end. Each line is a phase of its own: the corners are located as
/// switchings, and between them the law is linear, so that the exact method has it. The spring stores `∫ F dy` from
/// where it has no force, and dissipates none. A curve that does not go through (0, 0) is that of a preloaded spring.
///
/// # Limits
///
/// For a measured curve of many points a [`TableSpring`](super::TableSpring) is smooth and needs no switching.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::PiecewiseSpring};
///
/// let spring = PiecewiseSpring::new(vec![(0.0, 0.0), (0.01, 100.0), (0.02, 400.0)])?;
/// assert_eq!(spring.force(0.015, 0.0), 250.0);
/// assert_eq!(spring.force(0.03, 0.0), 700.0);
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # References
///
/// None: it is interpolation.
#[derive(Debug, Clone, PartialEq)]
pub struct PiecewiseSpring {
    points: Vec<(f64, f64)>,
    /// One for each pair of points.
    lines: Vec<Line>,
}

const POINTS: &str = "piecewise-spring";
const WORDS: &[&str] = &[
    "line 1", "line 2", "line 3", "line 4", "line 5", "line 6", "line 7", "line 8", "line 9",
    "line 10", "line 11", "line 12", "line 13", "line 14", "line 15", "line 16", "line 17",
    "line 18", "line 19", "line 20",
];

impl PiecewiseSpring {
    /// The spring through these points of deformation \[m\] and force \[N\].
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for fewer than two points, more than 21, numbers that are not
    /// finite, deformations that do not rise, and forces that fall or are the same everywhere.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, InvalidParameter> {
        check(&points)?;
        let spring = Self::through(points);
        if spring.lines.iter().all(Line::is_finite) {
            return Ok(spring);
        }
        let range = "such that the slopes and areas of the lines fit into double precision";
        Err(InvalidParameter::new(POINTS, range, "beyond that"))
    }

    fn through(points: Vec<(f64, f64)>) -> Self {
        let mut lines: Vec<Line> = points
            .windows(2)
            .map(|pair| {
                let [(from, start), (to, end)] = [pair[0], pair[1]];
                let stiffness = (end - start) / (to - from);
                Line::new(stiffness, start - stiffness * from)
            })
            .collect();
        // Each stores at the corner towards that which passes zero what its neighbour does there.
        let inner = &points[1..points.len() - 1];
        let at_rest = inner.partition_point(|point| point.1 < 0.0);
        for at in at_rest + 1..lines.len() {
            lines[at] = lines[at].going_on(&lines[at - 1], points[at].0);
        }
        for at in (0..at_rest).rev() {
            lines[at] = lines[at].going_on(&lines[at + 1], points[at + 1].0);
        }
        Self { points, lines }
    }

    fn line(&self, deformation: f64) -> &Line {
        &self.lines[line_at(&self.points, deformation)]
    }
}

/// Most points of a piecewise linear spring: each line has a word.
const MOST_POINTS: usize = WORDS.len() + 1;

/// The number of the line that holds at a deformation.
fn line_at(points: &[(f64, f64)], deformation: f64) -> usize {
    let inner = &points[1..points.len() - 1];
    inner.partition_point(|point| point.0 <= deformation)
}

fn check(points: &[(f64, f64)]) -> Result<(), InvalidParameter> {
    check_order(POINTS, points)?;
    if points.len() > MOST_POINTS {
        let range = "21 points or fewer; `table-spring` takes more";
        return Err(InvalidParameter::new(POINTS, range, points.len().to_string()));
    }
    Ok(())
}

impl Element for PiecewiseSpring {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.line(deformation).force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.line(deformation).tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.line(deformation).stored(deformation)
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn cubics(&self) -> Option<Vec<f64>> {
        Some(self.points[1..self.points.len() - 1].iter().map(|point| point.0).collect())
    }
}

impl Phases for PiecewiseSpring {
    fn names(&self) -> &'static [&'static str] {
        &WORDS[..self.lines.len()]
    }

    fn first(&self, deformation: f64) -> Phase {
        Phase { index: line_at(&self.points, deformation), memory: 0.0 }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        PhaseLaw::Element(Arc::new(self.lines[phase.index]))
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        let exit = |corner: usize, rising, to| Exit {
            watched: Watched::Deformation,
            level: self.points[corner].0,
            rising,
            to,
            remembers: false,
        };
        let at = phase.index;
        let down = (at > 0).then(|| exit(at, false, at - 1));
        let up = (at + 1 < self.lines.len()).then(|| exit(at + 1, true, at + 1));
        down.into_iter().chain(up).collect()
    }

    fn at_rest(&self) -> Option<Law> {
        let [first, last] = [self.points[0], self.points[self.points.len() - 1]];
        let stiffness = (last.1 - first.1) / (last.0 - first.0);
        Some(Law::Nonlinear { stiffness, damping: 0.0 })
    }
}

impl Kind for PiecewiseSpring {
    const KIND: &'static str = POINTS;
    const SUMMARY: &'static str = "piecewise linear spring, with exact corners";
    const PARAMETERS: &'static [Parameter] = &[Parameter::new(
        POINTS,
        ParameterKind::Curve(Dimension::LENGTH, Dimension::FORCE),
        "points of deformation [m] and force [N], rising; the first and the last line go on",
    )];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Self::new(Given::new(Self::PARAMETERS, values).take()?)
    }

    fn fields(&self) -> Vec<Value> {
        vec![Value::Table(self.points.clone())]
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        check(&self.points)
    }

    fn sample() -> Self {
        Self::through(vec![(0.0, 0.0), (0.004, 400.0), (0.012, 600.0), (0.02, 2000.0)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stores_the_area_below_its_lines() {
        let points = vec![(-0.02, -1.0), (-0.01, -1.0), (0.01, 3.0), (0.02, 9.0)];
        let spring = PiecewiseSpring::new(points).unwrap();
        for (y, force, area) in [
            (-0.005, 0.0, 0.0),
            (0.0, 1.0, 0.0025),
            (0.01, 3.0, 0.0225),
            (0.02, 9.0, 0.0825),
            (0.03, 15.0, 0.2025),
            (-0.01, -1.0, 0.0025),
            (-0.04, -1.0, 0.0325),
        ] {
            assert!((spring.force(y, 0.0) - force).abs() < 1e-14, "{y}");
            assert!((spring.stored(y) - area).abs() < 1e-15, "{y}: {}", spring.stored(y));
        }
    }
}
