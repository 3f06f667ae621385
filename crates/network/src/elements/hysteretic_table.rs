//! Spring with two measured curves.

use std::sync::Arc;

use dashpot_numerics::quadrature::GaussLegendre;

use super::{
    Element, TableSpring,
    hysteresis::{self, Hysteresis, TwoCurves},
    monotone::MonotoneCurve,
    table_spring::check,
};
use crate::{
    parameters::{
        CurveRole, Dimension, Given, InvalidParameter, Kind, Parameter, ParameterKind, Value,
    },
    phases::{Exit, Phase, PhaseLaw, Phases},
};

/// A padding with a measured curve of loading and another one of unloading.
///
/// While it is pressed deeper than ever before, the force is that of a [`TableSpring`] through the
/// points of `loading`, `F = f(y)`. Where the deformation turns back at `y_m`, it follows
/// `F = f(y) φ(y/y_m)`. It is loaded again on the same curve, up to `y_m`, where the first one goes
/// on. Below the set, the last deformation of `unloading` without force as a part of `y_m`, it is
/// slack: it pushes and never pulls, also when it is new.
///
/// | symbol     | field       | unit | range |
/// |------------|-------------|------|-------|
/// | `y_i, F_i` | `loading`   | m, N | from (0, 0), rising, forces never falling |
/// | `y_j, U_j` | `unloading` | m, N | from a force of zero, rising, to a point of the curve of loading |
///
/// The curve of unloading was measured from one depth `Y`, its last point. What it is at other
/// depths follows from the part `φ_j = U_j/f(y_j)` of the first curve that it is at `y_j/Y`. Between
/// the points `φ` is interpolated as the first curve is, so for `y_m = Y` it goes through all points.
/// `φ` may not exceed 1, and may not fall as the deformation rises: else going deeper would give
/// energy back.
///
/// # Energy
///
/// It stores what it would give back, `W = ∫ f φ dy` from the set to `y` on the curve of unloading;
/// on the first curve, that for `y_m = y`. All else that was put in is dissipated, and at once. A
/// cycle from 0 to `Y` and back dissipates the area between the two curves. A mass that it stops at
/// `Y` leaves with the part `√(∫ U dy / ∫ F dy)` of its speed.
///
/// # Limits
///
/// It has one memory, the greatest deformation: a loop within the curve of unloading takes no
/// energy, nothing heals with time, and no force depends on the rate. A measured curve holds for
/// the rate at which it was measured. Beyond the last point of `loading` that curve goes on as a
/// straight line, of which a run warns.
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
    /// The part of the greatest deformation that remains.
    set: f64,
    /// `φ` over the part of the greatest deformation, from the set to 1.
    factor: MonotoneCurve,
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
        let (set, factor) = factor(&loading, &unloading)?;
        Ok(Self(Arc::new(Curves { loading, unloading, set, factor })))
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

/// The set as a part of the greatest deformation, and `φ` over that part.
fn factor(
    loading: &TableSpring,
    unloading: &[(f64, f64)],
) -> Result<(f64, MonotoneCurve), InvalidParameter> {
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
    let set = parts[0].0;
    let curve = MonotoneCurve::through(parts);
    if curve.is_finite() {
        return Ok((set, curve));
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

impl Phases for HystereticTable {
    fn names(&self) -> &'static [&'static str] {
        hysteresis::NAMES
    }

    fn first(&self, deformation: f64) -> Phase {
        hysteresis::first(deformation)
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        hysteresis::law(self, phase)
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        hysteresis::exits(self, phase)
    }
}

impl Hysteresis for HystereticTable {}

impl TwoCurves for HystereticTable {
    fn loading(&self) -> &dyn Element {
        &self.0.loading
    }

    fn kept(&self, deepest: f64) -> f64 {
        self.0.set * deepest
    }

    fn factor(&self, deformation: f64, deepest: f64) -> (f64, f64) {
        let part = deformation / deepest;
        if part < self.0.set {
            return (0.0, 0.0);
        }
        (self.0.factor.value(part), self.0.factor.slope(part) / deepest)
    }

    fn recoverable(&self, deformation: f64, deepest: f64) -> f64 {
        let from = self.0.set * deepest;
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
        let force = |at: f64| self.0.loading.force(at, 0.0) * self.0.factor.value(at / deepest);
        // A cubic times a part that falls with it: a polynomial of the seventh degree at most.
        let rule = GaussLegendre::with_points(4);
        bends.windows(2).map(|pair| rule.integrate(pair[0], pair[1], force)).sum()
    }

    fn bends(&self) -> Vec<f64> {
        self.0.factor.points().iter().map(|point| point.0).collect()
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
        let factor = MonotoneCurve::through(parts);
        Self(Arc::new(Curves { loading, unloading, set: 0.15, factor }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{
        Foam, HystereticFoam,
        hysteresis::{
            LOADING, SLACK, UNLOADING,
            tests::{never_gives_more_than_it_took, travelled},
        },
    };

    fn curve(of: &HystereticTable, deepest: f64) -> Arc<dyn Element> {
        match Phases::law(of, Phase { index: UNLOADING, memory: deepest }) {
            PhaseLaw::Element(element) => element,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn straight_curves_have_the_areas_of_their_closed_forms() {
        // f = k y, φ = (x − r)/(1 − r): ∫ = k y_m² (1/3 − r/2 + r³/6)/(1 − r).
        let (k, r) = (1e3, 0.2);
        let table =
            HystereticTable::new(vec![(0.0, 0.0), (1.0, k)], vec![(r, 0.0), (1.0, k)]).unwrap();
        let foam = Foam {
            modulus: k,
            plateau: 1e12,
            densification: 0.0,
            exponent: 1.0,
            thickness: 1.0,
            area: 1.0,
        };
        let foam = HystereticFoam { foam, set: r, unloading_exponent: 1.0 };
        for deepest in [0.1, 0.5, 1.0, 1.7] {
            let exact = k * deepest * deepest * (1.0 / 3.0 - r / 2.0 + r.powi(3) / 6.0) / (1.0 - r);
            assert!((table.stored(deepest) / exact - 1.0).abs() < 1e-13);
            assert!((table.stored(deepest) / foam.stored(deepest) - 1.0).abs() < 1e-8);
            let back = curve(&table, deepest);
            for part in [0.1, 0.3, 0.7, 1.0] {
                let y = part * deepest;
                let exact = k * y * ((part - r) / (1.0 - r)).max(0.0);
                assert!((back.force(y, 0.0) - exact).abs() < 1e-12 * k, "{part}");
            }
        }
    }

    #[test]
    fn from_the_depth_of_the_measurement_it_goes_through_all_points() {
        let loading: Vec<_> =
            [0.0, 0.003, 0.007, 0.02].map(|y: f64| (y, 2e3 * y.sqrt() + 1e6 * y * y)).into();
        let there = TableSpring::new(loading.clone()).unwrap();
        let ends = there.force(0.02, 0.0);
        let unloading = vec![(0.0, 0.0), (0.002, 0.0), (0.009, 30.0), (0.015, 120.0), (0.02, ends)];
        let table = HystereticTable::new(loading, unloading.clone()).unwrap();
        let back = curve(&table, 0.02);
        for (y, force) in unloading {
            assert!((back.force(y, 0.0) - force).abs() <= 1e-12 * ends, "{y}");
        }
        // The store is the integral of the force, and continuous where it turns back.
        for deepest in [0.001, 0.0123, 0.02, 0.03] {
            let back = curve(&table, deepest);
            assert!((back.stored(deepest) / table.stored(deepest) - 1.0).abs() < 1e-13);
            assert!((back.force(deepest, 0.0) / table.force(deepest, 0.0) - 1.0).abs() < 1e-13);
            let steps = 20_000;
            let step = deepest / f64::from(steps);
            let middles = (0..steps).map(|at| step * (f64::from(at) + 0.5));
            let sum: f64 = middles.map(|y| step * back.force(y, 0.0)).sum();
            assert!((sum / back.stored(deepest) - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn the_same_curve_twice_is_a_spring_that_never_pulls() {
        let points = vec![(0.0, 0.0), (0.004, 500.0), (0.012, 800.0), (0.02, 3000.0)];
        let table = HystereticTable::new(points.clone(), points.clone()).unwrap();
        let spring = TableSpring::new(points).unwrap();
        for y in [1e-6, 0.003, 0.01, 0.019, 0.025] {
            assert!((table.stored(y) / spring.stored(y) - 1.0).abs() < 1e-12, "{y}");
            let back = curve(&table, 0.02);
            assert!((back.force(y, 0.0) / spring.force(y, 0.0) - 1.0).abs() < 1e-13, "{y}");
        }
    }

    #[test]
    fn it_follows_its_curves_from_phase_to_phase() {
        let table = HystereticTable::sample();
        let (_, phase, _) = travelled(&table, &[0.0, 0.01]);
        assert_eq!(phase.index, LOADING);
        let (work, phase, _) = travelled(&table, &[0.0, 0.02, -0.001]);
        assert_eq!((phase.index, phase.memory), (SLACK, 0.02));
        let lost = table.0.loading.stored(0.02) - table.stored(0.02);
        assert!((work / lost - 1.0).abs() < 1e-4, "{work} {lost}");
        never_gives_more_than_it_took(&table, 0.02);
    }

    #[test]
    fn curves_that_would_create_energy_are_refused_with_the_place() {
        let reason = |unloading: &[(f64, f64)]| {
            let loading = vec![(0.0, 0.0), (1.0, 100.0), (2.0, 200.0), (4.0, 400.0)];
            HystereticTable::new(loading, unloading.to_vec()).unwrap_err().to_string()
        };
        let found = reason(&[(0.0, 0.0), (1.0, 150.0), (2.0, 200.0)]);
        assert!(found.contains("nowhere above") && found.contains("150.0 N at 1.0 m"), "{found}");
        let found = reason(&[(0.0, 0.0), (1.0, 90.0), (3.0, 150.0), (4.0, 400.0)]);
        assert!(
            found.contains("never falls") && found.contains("50.0000 % of it at 3.0 m"),
            "{found}"
        );
        assert!(reason(&[(0.5, 0.0), (2.0, 150.0)]).contains("ends on that of `loading`"));
        assert!(reason(&[(0.5, 10.0), (2.0, 200.0)]).contains("begins at the set"));
        assert!(reason(&[(2.0, 200.0), (0.5, 0.0)]).contains("rising order"));
        assert!(reason(&[(0.5, 0.0)]).contains("two points"));
        let loading = vec![(-1.0, -5.0), (0.0, 0.0), (1.0, 10.0)];
        let found = HystereticTable::new(loading, vec![(0.0, 0.0), (1.0, 10.0)]).unwrap_err();
        assert_eq!(found.parameter, "loading");
    }
}
