use std::sync::Arc;

use diffsol::{FaerSparseMat, NalgebraMat};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::*;
use crate::{
    Argument, Characteristic, LinearForm, Method, Outputs, Run, Silent, SolveError, System, Term,
    Unknown, UnknownKind, derivatives,
    methods::{Bdf, Esdirk34, TrBdf2},
};

#[derive(Debug, Clone, Copy)]
struct Law(fn(f64) -> f64, fn(f64) -> f64);

impl Characteristic for Law {
    fn value(&self, [z, _]: [f64; 2]) -> f64 {
        (self.0)(z)
    }

    fn slopes(&self, [z, _]: [f64; 2]) -> [f64; 2] {
        [(self.1)(z), 0.0]
    }
}

const ROOT: Law = Law(|z| z.abs().sqrt().copysign(z), |z| 0.5 / z.abs().sqrt());
const CUBE: Law = Law(|z| z * z * z, |z| 3.0 * z * z);
const STEEP: Law = Law(|z| (40.0 * z).exp_m1(), |z| 40.0 * (40.0 * z).exp());
const ONE_SIDED: Law = Law(|z| z.max(0.0) * z.max(0.0).sqrt(), |z| 1.5 * z.max(0.0).sqrt());
const SATURATED: Law = Law(|z| (50.0 * z).tanh(), |z| 50.0 / (50.0 * z).cosh().powi(2));
const SLACK: Law = Law(
    |z| 1e4 * ((z - 0.1).max(0.0) + (z + 0.1).min(0.0)),
    |z| if z.abs() > 0.1 { 1e4 } else { 0.0 },
);

/// A row, a law in it and the law's argument.
type Part<'p> = (usize, Law, &'p [(usize, f64)]);

/// The unknown `x`, differential, and algebraic ones `a1, a2, …`.
fn system(
    algebraic: usize,
    entries: &[(usize, usize, f64)],
    terms: &[Part<'_>],
    initial: &[f64],
) -> System {
    let size = algebraic + 1;
    let mut jacobian = CooMatrix::new(size, size);
    for &(row, column, value) in entries {
        jacobian.push(row, column, value);
    }
    let unknown = |at: usize| {
        let kind = if at == 0 { UnknownKind::Differential } else { UnknownKind::Algebraic };
        let name = if at == 0 { "x".to_owned() } else { format!("a{at}") };
        Unknown { name, kind, scale: 1.0, unit: "N" }
    };
    let term = |&(row, law, unknowns): &Part<'_>| {
        let unknowns = LinearForm::sum(unknowns.to_vec());
        let argument = Argument { scale: 1.0, unknowns, inputs: LinearForm::zero() };
        Term { row, factor: 1.0, law: Arc::new(law), arguments: [argument, Argument::default()] }
    };
    System {
        unknowns: (0..size).map(unknown).collect(),
        jacobian: CsrMatrix::from(&jacobian),
        input_matrix: CsrMatrix::zeros(size, 0),
        inputs: Vec::new(),
        waveforms: Vec::new(),
        terms: terms.iter().map(term).collect(),
        initial: initial.to_vec(),
        outputs: Outputs::new(),
        time_scale: 1.0,
    }
}

/// The consistent state of `system`, in both worlds of matrices.
fn settled(system: &System) -> Result<Vec<f64>, Imbalance> {
    fn within<M: Algebra>(system: &System) -> Result<Vec<f64>, Imbalance> {
        let mut equations = Equations::<M>::new(system)?;
        let mut state = system.initial.clone();
        equations.enter(0.0, &state);
        let mut balance = Balance::<M>::new(system)?.ok_or(Imbalance::Singular)?;
        settle(&mut balance, &equations, &mut state)?;
        Ok(state)
    }
    let dense = within::<NalgebraMat<f64>>(system)?;
    let sparse = within::<FaerSparseMat<f64>>(system)?;
    for (a, b) in dense.iter().zip(&sparse) {
        assert!((a - b).abs() <= 1e-13 * (1.0 + a.abs()), "{dense:?} {sparse:?}");
    }
    Ok(dense)
}

/// The root of a function that falls, between two bounds.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..2000 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn a_force_in_its_own_law_is_found_from_anywhere() {
    let laws = [ROOT, CUBE, STEEP, ONE_SIDED, SATURATED, SLACK];
    for (index, law) in laws.into_iter().enumerate() {
        for x in [0.0, 1e-9, 0.1, 0.3, 1.0, 10.0, -2.0] {
            for guess in [0.0, 0.1, x, 100.0, -1e-20] {
                // 0 = −f + law(x − f).
                let of = [(0, 1.0), (1, -1.0)];
                let own = system(1, &[(1, 1, -1.0)], &[(1, law, &of)], &[x, guess]);
                let found = settled(&own).unwrap()[1];
                let root = bisect(-1e3, 1e3, |f| (law.0)(x - f) - f);
                let what = format!("law {index} at {x} from {guess}: {found}, not {root}");
                let rounding = 4.0 * f64::EPSILON * (x.abs() + root.abs());
                assert!((found - root).abs() <= rounding + 1e-300, "{what}");
            }
        }
    }
}

#[test]
fn joints_between_laws_find_their_place() {
    for (first, second) in [(CUBE, CUBE), (ROOT, CUBE), (CUBE, ONE_SIDED), (ROOT, STEEP)] {
        for x in [1e-3, 0.7, 6.0] {
            // 0 = −f + first(z), 0 = −f + second(x − z).
            let terms: [Part<'_>; 2] =
                [(1, first, &[(2, 1.0)]), (2, second, &[(0, 1.0), (2, -1.0)])];
            let own = system(2, &[(1, 1, -1.0), (2, 1, -1.0)], &terms, &[x, 0.0, 0.0]);
            let found = settled(&own).unwrap();
            let place = bisect(0.0, x, |z| (second.0)(x - z) - (first.0)(z));
            // A place is as accurate as the flatter law lets it be.
            assert!((found[2] - place).abs() < 1e-10 * x, "{found:?} {place}");
            let force = (first.0)(place);
            assert!((found[1] - force).abs() < 1e-9 * force, "{found:?} {force}");
        }
    }
}

#[test]
fn many_laws_in_series_share_one_force() {
    // The ends of all but the last law are unknown: 0 = −f + law(z_k − z_{k+1}), z_0 = x, z_n = 0.
    let laws = [CUBE, ROOT, SATURATED, ONE_SIDED, CUBE, ROOT];
    let count = laws.len();
    let ends: Vec<Vec<(usize, f64)>> = (0..count)
        .map(|k| {
            let upper = (if k == 0 { 0 } else { k + 1 }, 1.0);
            if k + 1 < count { vec![upper, (k + 2, -1.0)] } else { vec![upper] }
        })
        .collect();
    let terms: Vec<Part<'_>> = (0..count).map(|k| (k + 1, laws[k], &*ends[k])).collect();
    let entries: Vec<_> = (0..count).map(|k| (k + 1, 1, -1.0)).collect();
    let mut initial = vec![0.0; count + 1];
    initial[0] = 3.0;
    let found = settled(&system(count, &entries, &terms, &initial)).unwrap();
    let force = bisect(0.0, 1.0, |f| {
        let stretched = 2.0 * f.cbrt() + 2.0 * f * f + (f.atanh() / 50.0) + f.powf(2.0 / 3.0);
        3.0 - stretched
    });
    assert!((found[1] - force).abs() < 1e-12, "{found:?} {force}");
}

#[test]
fn flat_points_keep_the_balances_regular() {
    // Two cubes in series at rest: no slope says where the joint goes.
    let terms: [Part<'_>; 2] = [(1, CUBE, &[(2, 1.0)]), (2, CUBE, &[(0, 1.0), (2, -1.0)])];
    let own = system(2, &[(1, 1, -1.0), (2, 1, -1.0)], &terms, &[0.0; 3]);
    let found = derivatives(&own, &[0.0; 3], 1).unwrap();
    assert_eq!(found.values[0], [0.0; 3]);
    assert!(found.values[1].iter().all(|value| value.is_finite()));
}

#[test]
fn a_mass_starts_on_two_cubes_in_series() {
    // x″ = −x³/8 from rest position with x′ = 1: the energy ½ = x⁴/32 at x = 2.
    let terms: [Part<'_>; 2] = [(1, CUBE, &[(2, 1.0)]), (2, CUBE, &[(0, 1.0), (2, -1.0)])];
    let entries = [(0, 3, 1.0), (1, 1, -1.0), (2, 1, -1.0), (3, 1, -1.0)];
    let mut own = system(3, &entries, &terms, &[0.0, 0.0, 0.0, 1.0]);
    own.unknowns[3].kind = UnknownKind::Differential;
    // At the way back's end both slopes vanish at once and nothing determines the joint.
    let run = Run::to(4.5).with_rtol(1e-8);
    for method in [&Bdf as &dyn Method, &TrBdf2, &Esdirk34] {
        let trajectory = method.integrate(&own, &run, &mut Silent).unwrap();
        let times: Vec<f64> = (0..=900).map(|k| 0.005 * f64::from(k)).collect();
        let samples = trajectory.dense.sample(&own, &times);
        let deepest = samples.chunks(4).map(|row| row[0]).fold(0.0, f64::max);
        assert!((deepest - 2.0).abs() < 1e-4, "{} {deepest}", method.name());
        for row in samples.chunks(4) {
            let energy = 0.5 * row[3] * row[3] + row[0].powi(4) / 32.0;
            assert!((energy - 0.5).abs() < 1e-4, "{} {energy}", method.name());
        }
    }
}

#[test]
fn balances_without_a_solution_are_reported_by_name() {
    const PARABOLA: Law = Law(|z| z * z + 1.0, |z| 2.0 * z);
    // 0 = a1² + 1, and a second balance that is fine.
    let own = system(2, &[(2, 2, -1.0)], &[(1, PARABOLA, &[(1, 1.0)])], &[0.0, 0.5, 3.0]);
    assert_eq!(settled(&own), Err(Imbalance::Unsettled { unknown: 1 }));
    for method in [&Bdf as &dyn Method, &TrBdf2, &Esdirk34] {
        let error = method.integrate(&own, &Run::to(1.0), &mut Silent).unwrap_err();
        assert!(matches!(&error, SolveError::Inconsistent { unknown, .. } if unknown == "a1"));
        assert!(error.to_string().contains("`a1`"), "{error}");
    }
    assert!(matches!(derivatives(&own, &own.initial, 2), Err(SolveError::Inconsistent { .. })));
}

#[test]
fn laws_that_say_nothing_leave_a_singular_balance() {
    const NOTHING: Law = Law(|_| 0.0, |_| 0.0);
    let own = system(1, &[(1, 0, 1.0)], &[(1, NOTHING, &[(1, 1.0)])], &[1.0, 0.0]);
    assert_eq!(settled(&own), Err(Imbalance::Singular));
    let error = Bdf.integrate(&own, &Run::to(1.0), &mut Silent).unwrap_err();
    assert!(matches!(error, SolveError::NotApplicable { .. }), "{error}");
}

#[test]
fn a_law_counts_for_what_it_determines() {
    // Nothing but the law contains a1.
    let own = system(1, &[(1, 0, -1.0)], &[(1, CUBE, &[(1, 1.0)])], &[8.0, 0.0]);
    assert!((settled(&own).unwrap()[1] - 2.0).abs() < 1e-15);
}

#[test]
fn a_law_in_a_row_with_a_rate_is_refused() {
    let own = system(1, &[(1, 1, 1.0)], &[(0, CUBE, &[(1, 1.0)])], &[1.0, 0.0]);
    let error = Bdf.integrate(&own, &Run::to(1.0), &mut Silent).unwrap_err();
    assert!(error.to_string().contains("row of `x`"), "{error}");
    assert!(derivatives(&own, &own.initial, 1).is_err());
}
