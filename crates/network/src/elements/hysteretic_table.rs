//! Spring with two measured curves.

use std::sync::Arc;

use dashpot_numerics::{
    chebyshev::{self, Interpolation},
    quadrature::integral,
};

use super::{
    Element, TableSpring,
    hysteresis::{TwoCurves, two_curves},
    monotone::MonotoneCurve,
    table_spring::check,
};
use crate::parameters::{
    CurveRole, Dimension, Given, InvalidParameter, Kind, Parameter, ParameterKind, Value,
};

/// A padding with a measured curve of loading and another one of unloading.
///
/// While it is pressed deeper than ever before, the force is that of a [`TableSpring`] through the points of `loading`,
/// `F = f(y)`. Where the deformation turns back at `y_m`, it follows `F = f(y) φ(y/y_m)`. It is loaded again on the
/// same curve, up to `y_m`, where the first one goes on. Below the set, the last deformation of `unloading` without
/// force as a part of `y_m`, it is slack: it pushes and never pulls, also when it is new.
///
/// | symbol     | field       | unit | range |
/// |------------|-------------|------|-------|
/// | `y_i, F_i` | `loading`   | m, N | from (0, 0), rising, forces never falling |
/// | `y_j, U_j` | `unloading` | m, N | from a force of zero, rising, to a point of the curve of loading |
///
/// The curve of unloading was measured from one depth `Y`, its last point: from there it is the curve `U` through its
/// points, drawn as that of a [`TableSpring`]. What it is at other depths follows from the part of the first curve that
/// it is, `φ(x) = U(x Y)/f(x Y)`: a straight line beside a straight line stays straight at all depths. At its points
/// `φ` may not exceed 1, and may not fall as the deformation rises: else going deeper would give energy back. Where it
/// would fall between two points all the same, `φ` is drawn through its values there as `f` is.
///
/// # Energy
///
/// It stores what it would give back, `W = ∫ f φ dy` from the set to `y` on the curve of unloading; on the first curve,
/// that for `y_m = y`. All else that was put in is dissipated, and at once. A cycle from 0 to `Y` and back dissipates
/// the area between the two curves. A mass that it stops at `Y` leaves with the part `√(∫ U dy / ∫ F dy)` of its speed.
///
/// # Limits
///
/// It has one memory, the greatest deformation: a loop within the curve of unloading takes no energy, nothing heals
/// with time, and no force depends on the rate. A measured curve holds for the rate at which it was measured. Beyond
/// the last point of `loading` that curve goes on as a straight line, of which a run warns.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::HystereticTable};
///
/// let loading = vec![(0.0, 0.0), (0.01, 100.0), (0.02, 400.0)];
/// let unloading = vec![(0.004, 0.0), (0.01, 20.0), (0.02, 400.0)];
/// let foam = HystereticTable::new(loading.clone(), unloading)?;
/// assert_eq!(foam.force(0.01, 1.0), 100.0);
/// let above = vec![(0.0, 0.0), (0.01, 120.0), (0.02, 400.0)];
/// assert!(HystereticTable::new(loading, above).is_err());
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # References
///
/// `hallquist2006` in `docs/references.bib`, material types 57 and 83, for unloading on the first
/// curve times a factor; `fritsch1980` and `fritsch1984` for the curves between points.
#[derive(Debug, Clone, PartialEq)]
pub struct HystereticTable(Arc<Curves>);

#[derive(Debug, PartialEq)]
struct Curves {
    loading: TableSpring,
    /// The points of unloading as they were given.
    unloading: Vec<(f64, f64)>,
    factor: Factor,
}

/// The part `φ` of the first curve that the second one is, over the part `x` of the greatest deformation, from the
/// set to 1.
#[derive(Debug, PartialEq)]
struct Factor {
    /// The curve of unloading, from the set to the depth that it was measured from.
    curve: MonotoneCurve,
    /// `φ` at the points of unloading, over `x`.
    points: MonotoneCurve,
    /// The intervals between these points in which `φ` is that of the curves, and does not fall.
    of_curves: Vec<bool>,
    /// The depth that it was measured from \[m\], and the least one at which both curves can be compared.
    depth: f64,
    least: f64,
}

const LOADING: &str = "loading";
const UNLOADING: &str = "unloading";
/// So much of a force counts as rounding where two curves are compared.
const ROUNDING: f64 = 1e-9;

impl HystereticTable {
    /// The padding with these points of deformation \[m\] and force \[N\].
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for points that are no curves as described, and for a curve of
    /// unloading that lies above that of loading, or whose part of it falls.
    pub fn new(
        loading: Vec<(f64, f64)>,
        unloading: Vec<(f64, f64)>,
    ) -> Result<Self, InvalidParameter> {
        check(LOADING, &loading)?;
        if let Some(point) = loading.first().filter(|point| point.0 < 0.0) {
            let range = "of compression, from [0, 0] on: it never pulls";
            return Err(InvalidParameter::new(LOADING, range, format!("{point:?}")));
        }
        let loading = TableSpring::new(loading)
            .map_err(|own| InvalidParameter::new(LOADING, own.range, own.found))?;
        let factor = factor(&loading, &unloading)?;
        Ok(Self(Arc::new(Curves { loading, unloading, factor })))
    }

    /// Points of deformation \[m\] and force \[N\] of the first curve.
    pub fn loading_points(&self) -> &[(f64, f64)] {
        self.0.loading.points()
    }

    /// Points of deformation \[m\] and force \[N\] of unloading.
    pub fn unloading_points(&self) -> &[(f64, f64)] {
        &self.0.unloading
    }
}

/// So much of a depth beyond one at which there is no force, the forces are compared.
const BESIDE: f64 = 1e-7;

impl Factor {
    /// Of these curves of loading and unloading, with `φ` at the points of the latter.
    fn new(loading: &TableSpring, unloading: Vec<(f64, f64)>, parts: Vec<(f64, f64)>) -> Self {
        let [set, depth] = [unloading[0].0, unloading[unloading.len() - 1].0];
        let has_force = loading.force(set, 0.0) > 0.0;
        let least = if has_force { set } else { set + BESIDE * (depth - set) };
        let intervals: Vec<(f64, f64)> =
            unloading.windows(2).map(|pair| (pair[0].0, pair[1].0)).collect();
        let (curve, points) = (MonotoneCurve::through(unloading), MonotoneCurve::through(parts));
        let mut factor = Self { curve, points, of_curves: Vec::new(), depth, least };
        factor.of_curves =
            intervals.into_iter().map(|interval| factor.rises(loading, interval)).collect();
        factor
    }

    /// Whether `U/f` does not fall between two depths: `U' f − U f'`, of the fifth degree between bends, is positive.
    fn rises(&self, loading: &TableSpring, (from, to): (f64, f64)) -> bool {
        let bends = loading.points().iter().map(|point| point.0);
        let bends: Vec<f64> = bends.filter(|bend| *bend > from && *bend < to).collect();
        let starts = [from].into_iter().chain(bends.iter().copied());
        let ends = bends.iter().copied().chain([to]);
        let interpolation = Interpolation::of_degree(5);
        starts.zip(ends).all(|(start, end)| {
            let terms = |node: &f64| {
                let y = f64::midpoint(start, end) + 0.5 * (end - start) * node;
                let (force, slope) = (loading.force(y, 0.0), loading.tangent(y, 0.0).stiffness);
                [self.curve.slope(y) * force, self.curve.value(y) * slope]
            };
            let terms: Vec<[f64; 2]> = interpolation.nodes().iter().map(terms).collect();
            let size = terms.iter().map(|own| own[0] + own[1]).fold(0.0, f64::max);
            let values: Vec<f64> =
                terms.iter().map(|own| own[0] - own[1] + ROUNDING * size).collect();
            let mut coefficients = [0.0; 6];
            interpolation.coefficients(&values, &mut coefficients);
            values.iter().all(|value| *value >= 0.0)
                && chebyshev::sign_changes(&coefficients).is_empty()
        })
    }

    /// The set, as a part of the greatest deformation.
    fn set(&self) -> f64 {
        self.points.ends()[0].0
    }

    /// `φ` and its slope.
    fn at(&self, loading: &TableSpring, part: f64) -> (f64, f64) {
        let after = self.points.points().partition_point(|point| point.0 <= part);
        if !self.of_curves[after.clamp(1, self.of_curves.len()) - 1] {
            return (self.points.value(part), self.points.slope(part));
        }
        let y = (part * self.depth).max(self.least);
        let force = loading.force(y, 0.0);
        let value = self.curve.value(y) / force;
        let slope = (self.curve.slope(y) - value * loading.tangent(y, 0.0).stiffness) / force;
        (value, slope * self.depth)
    }
}

/// `φ` of two curves.
fn factor(loading: &TableSpring, unloading: &[(f64, f64)]) -> Result<Factor, InvalidParameter> {
    let invalid =
        |range: &str, found: String| Err(InvalidParameter::new(UNLOADING, range.to_owned(), found));
    check_order(unloading)?;
    let (depth, most) = unloading[unloading.len() - 1];
    let there = loading.force(depth, 0.0);
    if (most - there).abs() > ROUNDING * there {
        let range = "a curve that ends on that of `loading`, from where it was unloaded";
        return invalid(range, format!("{most:?} N at {depth:?} m, where that has {there:?} N"));
    }
    let slack = unloading.iter().rposition(|point| point.1 <= 0.0).unwrap_or(0);
    let mut parts: Vec<(f64, f64)> = vec![(unloading[slack].0 / depth, 0.0)];
    let mut last = 0.0;
    for &(at, force) in &unloading[slack + 1..] {
        let above = loading.force(at, 0.0);
        if force > above * (1.0 + ROUNDING) {
            let range = "nowhere above the curve of `loading`: it would create energy";
            return invalid(range, format!("{force:?} N at {at:?} m, where that has {above:?} N"));
        }
        let part = (force / above).min(1.0);
        if part < last - ROUNDING {
            let range =
                "a part of the curve of `loading` that never falls as the deformation rises";
            let [before, after] = [last, part].map(|own| 100.0 * own);
            return invalid(range, format!("{after:.4} % of it at {at:?} m, after {before:.4} %"));
        }
        last = part.max(last);
        parts.push((at / depth, last));
    }
    // From the origin on both forces begin: their ratio there is that of the first interval.
    if parts[0].0 <= 0.0 {
        parts[0].1 = parts[1].1;
    }
    if let Some(end) = parts.last_mut() {
        *end = (1.0, 1.0);
    }
    let mut unloading = unloading[slack..].to_vec();
    if let Some(end) = unloading.last_mut() {
        end.1 = there;
    }
    let factor = Factor::new(loading, unloading, parts);
    if factor.curve.is_finite() && factor.points.is_finite() {
        return Ok(factor);
    }
    invalid("such that its slopes fit into double precision", "beyond that".to_owned())
}

/// Refuses points that are no curve from zero force upwards.
fn check_order(points: &[(f64, f64)]) -> Result<(), InvalidParameter> {
    let invalid =
        |range: &str, found: String| Err(InvalidParameter::new(UNLOADING, range.to_owned(), found));
    if points.len() < 2 {
        return invalid("two points or more", format!("{}", points.len()));
    }
    if let Some(point) = points.iter().find(|point| !point.0.is_finite() || !point.1.is_finite()) {
        return invalid("finite", format!("{point:?}"));
    }
    for pair in points.windows(2) {
        let [(from, start), (to, end)] = [pair[0], pair[1]];
        if to <= from {
            let range = "in rising order of the deformation, whichever way it was measured";
            return invalid(range, format!("{to:?} m after {from:?} m"));
        }
        if end < start {
            let range = "of forces that never fall as the deformation rises";
            return invalid(range, format!("{end:?} N after {start:?} N"));
        }
    }
    let first = points[0];
    if first.0 < 0.0 || first.1.abs() > 0.0 {
        let range = "a curve that begins at the set, where its force is zero";
        return invalid(range, format!("{:?} N at {:?} m", first.1, first.0));
    }
    Ok(())
}

two_curves!(HystereticTable);

impl TwoCurves for HystereticTable {
    fn loading(&self) -> &dyn Element {
        &self.0.loading
    }

    fn kept(&self, deepest: f64) -> f64 {
        self.0.factor.set() * deepest
    }

    fn factor(&self, deformation: f64, deepest: f64) -> (f64, f64) {
        let part = deformation / deepest;
        if part < self.0.factor.set() {
            return (0.0, 0.0);
        }
        let (value, slope) = self.0.factor.at(&self.0.loading, part);
        (value, slope / deepest)
    }

    fn recoverable(&self, deformation: f64, deepest: f64) -> f64 {
        let from = self.kept(deepest);
        if deformation <= from {
            return 0.0;
        }
        let between = |at: &f64| *at > from && *at < deformation;
        let mut bends: Vec<f64> =
            self.loading_points().iter().map(|loading_point| loading_point.0).collect();
        bends.extend(self.bends().iter().map(|part| part * deepest));
        bends.retain(between);
        bends.extend([from, deformation]);
        bends.sort_by(f64::total_cmp);
        let force = |at: f64| self.0.loading.force(at, 0.0) * self.factor(at, deepest).0;
        bends.windows(2).map(|pair| integral(force, pair[0], pair[1])).sum()
    }

    fn bends(&self) -> Vec<f64> {
        let Factor { points, depth, .. } = &self.0.factor;
        let loading = self.loading_points().iter().map(|point| point.0 / depth);
        let loading = loading.filter(|part| *part > self.0.factor.set() && *part < 1.0);
        points.points().iter().map(|point| point.0).chain(loading).collect()
    }
}

const CURVE: ParameterKind = ParameterKind::Curve(Dimension::LENGTH, Dimension::FORCE);

impl Kind for HystereticTable {
    const KIND: &'static str = "hysteretic-table";
    const SUMMARY: &'static str =
        "padding with measured curves of loading and unloading; keeps a set, never pulls";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::new(
            LOADING,
            CURVE,
            "points of deformation [m] and force [N], rising from [0, 0]; straight on beyond them, \
             which a run warns of",
        )
        .curve(CurveRole::FromRest),
        Parameter::new(
            UNLOADING,
            CURVE,
            "points of deformation [m] and force [N], rising from the set, where the force is zero, \
             to a point of the curve of loading; nowhere above that",
        )
        .curve(CurveRole::Unloading),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let mut given = Given::new(Self::PARAMETERS, values);
        Self::new(given.take()?, given.take()?)
    }

    fn fields(&self) -> Vec<Value> {
        [self.loading_points(), self.unloading_points()]
            .map(|points| Value::Table(points.to_vec()))
            .into()
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        Self::from_values(&self.fields()).map(|_| ())
    }

    fn sample() -> Self {
        let loading =
            TableSpring::through(vec![(0.0, 0.0), (0.004, 500.0), (0.012, 800.0), (0.02, 3000.0)]);
        let unloading = vec![(0.003, 0.0), (0.012, 200.0), (0.02, 3000.0)];
        let parts = vec![(0.15, 0.0), (0.6, 0.25), (1.0, 1.0)];
        let factor = Factor::new(&loading, unloading.clone(), parts);
        Self(Arc::new(Curves { loading, unloading, factor }))
    }
}

#[cfg(test)]
mod tests;
