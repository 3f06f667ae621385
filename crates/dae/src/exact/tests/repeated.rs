//! Rates that are equal, nearly equal or defective: matrices `S D S⁻¹` of whole numbers, whose
//! solutions are known in closed form.

use super::{Scene, Sequence};
use crate::Signal;

/// The unit in which the entries of `D` are whole numbers.
const UNIT: f64 = 1.0 / (1_u64 << 40) as f64;

/// A block of `D` in real form.
#[derive(Debug, Clone, Copy)]
struct Rate {
    /// The growth rate in units.
    growth: i128,
    /// The frequency in units; zero for a real rate.
    frequency: i128,
    /// The length of its Jordan chain.
    chain: usize,
}

impl Rate {
    fn width(self) -> usize {
        if self.frequency == 0 { 1 } else { 2 }
    }

    fn size(self) -> usize {
        self.chain * self.width()
    }

    /// Writes the block into `D` from row `at` on.
    fn write(self, d: &mut [Vec<i128>], at: usize) {
        let width = self.width();
        for k in 0..self.size() {
            d[at + k][at + k] = self.growth;
            if k + width < self.size() {
                d[at + k][at + k + width] = 1 << 40;
            }
        }
        if width == 2 {
            for k in (0..self.size()).step_by(2) {
                d[at + k][at + k + 1] = self.frequency;
                d[at + k + 1][at + k] = -self.frequency;
            }
        }
    }

    /// `e^{block t} c`.
    fn advance(self, t: f64, c: &[f64]) -> Vec<f64> {
        let width = self.width();
        let decay = (self.growth as f64 * UNIT * t).exp();
        let (sin, cos) = (self.frequency as f64 * UNIT * t).sin_cos();
        let mut out = vec![0.0; c.len()];
        for k in 0..c.len() {
            let (mut factor, mut order) = (decay, 1.0);
            for source in (k..c.len()).step_by(width) {
                out[k] += factor * c[source];
                factor *= t / order;
                order += 1.0;
            }
        }
        if width == 2 {
            for pair in out.chunks_exact_mut(2) {
                let (p, q) = (pair[0], pair[1]);
                (pair[0], pair[1]) = (cos * p + sin * q, cos * q - sin * p);
            }
        }
        out
    }
}

type Matrix = Vec<Vec<i128>>;

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let size = a.len();
    let entry = |i: usize, j: usize| (0..size).map(|k| a[i][k] * b[k][j]).sum();
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}

/// A matrix of whole numbers with an inverse of whole numbers.
fn basis(random: &mut Sequence, size: usize) -> (Matrix, Matrix) {
    let identity: Matrix =
        (0..size).map(|i| (0..size).map(|j| i128::from(i == j)).collect()).collect();
    let (mut s, mut inverse) = (identity.clone(), identity);
    for _ in 0..random.index(3 * size) {
        let (i, j) = (random.index(size), random.index(size));
        let factor = [1, -1, 2, -3][random.index(4)];
        if i != j {
            // S ← (1 + f e_i e_jᵀ) S, S⁻¹ ← S⁻¹ (1 − f e_i e_jᵀ).
            for k in 0..size {
                s[i][k] += factor * s[j][k];
                inverse[k][j] -= factor * inverse[k][i];
            }
        }
    }
    (s, inverse)
}

/// Rates of a few kinds, many of which are alike.
fn rates(random: &mut Sequence) -> Vec<Rate> {
    let one = 1_i128 << 40;
    let kinds =
        [(0, 0), (0, 0), (-one, 0), (-one / 4, 0), (-8 * one, 0), (-one / 8, one), (0, one)];
    let chosen = [kinds[random.index(7)], kinds[random.index(7)], kinds[random.index(7)]];
    let spread = [0, 0, 1, 1 << 10, 1 << 20, 1 << 30][random.index(6)];
    let mut rates = Vec::new();
    for _ in 0..2 + random.index(7) {
        let (growth, frequency) = chosen[random.index(3)];
        let growth = growth - spread * random.index(3) as i128;
        let chain = [1, 1, 1, 1, 2, 3, 4][random.index(7)];
        rates.push(Rate { growth, frequency, chain });
    }
    while rates.iter().map(|rate| rate.size()).sum::<usize>() > 14 {
        rates.pop();
    }
    rates
}

/// A random matrix of whole numbers with the rates that it was made of.
struct Case {
    rates: Vec<Rate>,
    basis: Matrix,
    rows: Vec<Vec<f64>>,
    initial: Vec<f64>,
    /// `S⁻¹` times the initial state.
    modal: Vec<f64>,
}

impl Case {
    /// Nothing where the matrix has no exact form in doubles.
    fn new(random: &mut Sequence) -> Option<Self> {
        let rates = rates(random);
        let size = rates.iter().map(|rate| rate.size()).sum();
        let mut d = vec![vec![0; size]; size];
        let mut at = 0;
        for rate in &rates {
            rate.write(&mut d, at);
            at += rate.size();
        }
        let (basis, inverse) = basis(random, size);
        let a = product(&product(&basis, &d), &inverse);
        if a.iter().flatten().any(|&x| (x as f64) as i128 != x) {
            return None;
        }
        let rows = a.iter().map(|row| row.iter().map(|&x| x as f64 * UNIT).collect()).collect();
        let start: Vec<i128> = (0..size).map(|_| random.index(7) as i128 - 3).collect();
        let modal = |row: &Vec<i128>| row.iter().zip(&start).map(|(a, b)| a * b).sum::<i128>();
        let modal = inverse.iter().map(|row| modal(row) as f64).collect();
        let initial = start.iter().map(|&x| x as f64).collect();
        Some(Self { rates, basis, rows, initial, modal })
    }

    /// The states at a time, and bounds of the rounding errors of this closed form.
    fn solution(&self, t: f64) -> Vec<(f64, f64)> {
        let mut coordinates = Vec::new();
        for rate in &self.rates {
            let from = coordinates.len();
            coordinates.extend(rate.advance(t, &self.modal[from..from + rate.size()]));
        }
        let state = |row: &Vec<i128>| {
            let terms = || row.iter().zip(&coordinates).map(|(&s, c)| s as f64 * c);
            (terms().sum(), 8.0 * f64::EPSILON * terms().map(f64::abs).sum::<f64>())
        };
        self.basis.iter().map(state).collect()
    }

    /// The largest stated error relative to the largest state, infinite where none is stated.
    fn judge(&self, end: f64) -> f64 {
        let views: Vec<&[f64]> = self.rows.iter().map(Vec::as_slice).collect();
        let solved = Scene::new(&views, &self.initial).solve(end);
        let signals: Vec<_> = (0..views.len()).map(|output| solved.signal(output)).collect();
        let scale = signals.iter().fold(0.0_f64, |scale, signal| scale.max(signal.bound()));
        let error = |signal: &Signal| signal.error.unwrap_or(f64::INFINITY);
        for k in 0..=25 {
            let t = end * f64::from(k) / 25.0;
            for (i, (expected, rounding)) in self.solution(t).into_iter().enumerate() {
                let off = (signals[i].value(t) - expected).abs();
                // Where nothing is stated the values are still those of a matrix exponential.
                let allowed = error(&signals[i]).min(1e-6 * scale);
                assert!(
                    off <= allowed + rounding,
                    "output {i} at {t}: off by {off:e}, {:e} stated, {scale:e} large, {:?}",
                    error(&signals[i]),
                    self.rates
                );
            }
        }
        let most = signals.iter().map(error).fold(0.0, f64::max);
        if most == 0.0 { 0.0 } else { most / scale }
    }
}

#[test]
fn the_bound_holds_whatever_rates_are_equal() {
    let mut random = Sequence(20_260_301);
    let mut errors = Vec::new();
    for number in 0..1500 {
        let state = random.0;
        let case = Case::new(&mut random);
        let end = [0.1, 1.0, 10.0, 100.0][random.index(4)] * (1.0 + random.next());
        let Some(case) = case else { continue };
        let judged = std::panic::catch_unwind(|| case.judge(end));
        assert!(judged.is_ok(), "matrix {number}, sequence {state}");
        errors.extend(judged);
    }
    errors.sort_by(f64::total_cmp);
    let share = |part: usize| errors[(errors.len() - 1) * part / 1000];
    assert!(errors.len() > 1400, "{} matrices", errors.len());
    assert!(share(500) < 1e-13, "half of all: {:e}", share(500));
    assert!(share(950) < 1e-11, "nearly all: {:e}", share(950));
    assert!(share(995) < 1e-6, "but for chains of chains: {:e}", share(995));
}

/// Mass, two springs and seven dashpots in series: positions that nothing depends on, so that zero
/// is a rate seven times over. Position and velocity of the mass, then positions within the series.
fn seven_dashpots() -> (Scene, f64) {
    let entries = [
        (0, 1, 1.0),
        (1, 0, -7.044_268_158_271_795),
        (1, 2, -2.459_298_322_052_388_7),
        (1, 7, -0.998_058_075_175_037_2),
        (1, 8, 0.998_058_075_175_037_2),
        (2, 0, -8.999_213_363_473_608),
        (2, 2, -3.141_809_741_952_209_7),
        (2, 7, -1.275_041_972_542_038_2),
        (2, 8, 1.275_041_972_542_038_2),
        (3, 0, -0.021_087_300_300_482_77),
        (3, 2, -0.007_362_008_526_704_805),
        (3, 7, -0.002_987_727_025_102_523),
        (3, 8, 0.002_987_727_025_102_523),
        (4, 0, -0.048_541_883_891_695_92),
        (4, 2, -0.016_946_966_089_575_653),
        (4, 7, -0.006_877_594_395_015_489),
        (4, 8, 0.006_877_594_395_015_488),
        (5, 0, -35.362_814_972_853_21),
        (5, 2, -12.345_883_145_244_03),
        (5, 7, -5.010_334_963_346_390_5),
        (5, 8, 5.010_334_963_346_390_5),
        (6, 0, -35.433_705_383_344_29),
        (6, 2, -12.370_632_439_798_586),
        (6, 7, -5.020_378_979_992_748),
        (6, 8, 5.020_378_979_992_748),
        (7, 0, -253.414_059_948_444_5),
        (7, 2, -88.472_039_736_856_17),
        (7, 7, -35.904_645_196_881_106),
        (7, 8, 35.904_645_196_881_106),
        (8, 0, 39.858_523_092_069_42),
        (8, 2, 13.915_426_948_178_73),
        (8, 7, 5.647_303_586_800_175),
        (8, 8, -5.647_303_586_800_175),
    ];
    let mut rows = vec![vec![0.0; 9]; 9];
    for (i, j, value) in entries {
        rows[i][j] = value;
    }
    let mut initial = [0.0; 9];
    initial[1] = 1.0;
    let views: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    (Scene::new(&views, &initial), 1.0)
}

#[test]
fn a_series_of_seven_dashpots_starts_where_it_is_and_ends_where_it_must() {
    let (scene, end) = seven_dashpots();
    let solved = scene.solve(end);
    let times: Vec<f64> = (0..=20).map(|k| end * f64::from(k) / 20.0).collect();
    let samples = solved.samples(&times);
    for output in 0..9 {
        let signal = solved.signal(output);
        let error = signal.error.unwrap();
        assert!(error < 1e-12 * signal.bound(), "{error:e}");
        let start = if output == 1 { 1.0 } else { 0.0 };
        assert!((signal.value(0.0) - start).abs() <= error);
        for (k, &t) in times.iter().enumerate() {
            let off = (signal.value(t) - samples[9 * k + output]).abs();
            assert!(off <= error + 1e-12 * signal.bound(), "output {output} at {t}: {off:e}");
        }
    }
    // Closed form of the mass on one spring and one dashpot in series, 3.1023 m for each unit; the
    // matrix holds the springs and dashpots to sixteen digits.
    let last = solved.signal(0).value(end) * 3.1023;
    assert!((last - 2.879_370_877_971_76).abs() < 1e-12, "{last}");
}
