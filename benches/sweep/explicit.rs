//! An impact by hand: Dormand's and Prince's method of order 5 with a step that follows its error, its dense output,
//! and the peaks, the switchings and the release of one scene, of constant size.

/// The equations of one scene, with the quadratures that its measures take.
pub(crate) trait Impact<const N: usize> {
    fn rates(&self, state: &[f64; N]) -> [f64; N];

    /// The force between what strikes and what is struck.
    fn force(&self, state: &[f64; N]) -> f64;

    /// How fast the force changes.
    fn force_rate(&self, state: &[f64; N]) -> f64;

    /// Deformation and its rate.
    fn depth(&self, state: &[f64; N]) -> [f64; 2];

    /// What falls through zero where other equations follow.
    fn lasts(&self, _state: &[f64; N]) -> f64 {
        1.0
    }

    /// Goes on to those.
    fn switch(&mut self) {}
}

/// What is seen of an impact.
pub(crate) struct Seen<const N: usize> {
    pub(crate) peak: f64,
    pub(crate) depth: f64,
    pub(crate) contact: f64,
    /// The state at the release.
    pub(crate) end: [f64; N],
}

/// The stages of the method, and what its dense output takes of them besides.
const A: [&[f64]; 6] = [
    &[0.2],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -0.025,
];
const DENSE: [f64; 7] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

fn combined<const N: usize>(
    from: &[f64; N],
    slopes: &[[f64; N]],
    weights: &[f64],
    length: f64,
) -> [f64; N] {
    let mut sum = [0.0; N];
    for (slope, weight) in slopes.iter().zip(weights) {
        (0..N).for_each(|at| sum[at] += weight * slope[at]);
    }
    std::array::from_fn(|at| from[at] + length * sum[at])
}

/// A step and its dense output.
struct Step<const N: usize> {
    length: f64,
    rows: [[f64; N]; 5],
}

impl<const N: usize> Step<N> {
    fn of(from: &[f64; N], to: &[f64; N], slopes: &[[f64; N]; 7], length: f64) -> Self {
        let change: [f64; N] = std::array::from_fn(|at| to[at] - from[at]);
        let bend: [f64; N] = std::array::from_fn(|at| length * slopes[0][at] - change[at]);
        let other: [f64; N] =
            std::array::from_fn(|at| change[at] - length * slopes[6][at] - bend[at]);
        let last = combined(&[0.0; N], slopes, &DENSE, length);
        Self { length, rows: [*from, change, bend, other, last] }
    }

    fn at(&self, x: f64) -> [f64; N] {
        let y = 1.0 - x;
        let [a, b, c, d, e] = &self.rows;
        std::array::from_fn(|at| a[at] + x * (b[at] + y * (c[at] + x * (d[at] + y * e[at]))))
    }

    /// Where `f` passes zero in it before a place, by false position.
    fn zero(&self, until: f64, f: impl Fn(&[f64; N]) -> f64) -> f64 {
        let (mut low, mut high) = (0.0, until);
        let (mut at_low, mut at_high) = (f(&self.at(low)), f(&self.at(high)));
        for round in 0..40 {
            let x = low + (high - low) * at_low / (at_low - at_high);
            let value = f(&self.at(x));
            if value.abs() < 1e-12 * (at_low.abs() + at_high.abs()) || high - low < 1e-12 {
                return x;
            }
            if (value > 0.0) == (at_low > 0.0) {
                (low, at_low) = (x, value);
                at_high *= if round > 0 { 0.5 } else { 1.0 };
            } else {
                (high, at_high) = (x, value);
                at_low *= if round > 0 { 0.5 } else { 1.0 };
            }
        }
        0.5 * (low + high)
    }
}

/// Follows an impact until the force falls through zero. Errors are counted in `sizes`; those of quadratures, of
/// infinite size, are as good as what they are of.
pub(crate) fn follow<const N: usize>(
    scene: &mut impl Impact<N>,
    mut state: [f64; N],
    sizes: [f64; N],
    rtol: f64,
) -> Seen<N> {
    let counted = sizes.iter().filter(|size| size.is_finite()).count() as f64;
    let (mut time, mut length) = (0.0, 1e-4);
    let (mut peak, mut depth) = (scene.force(&state), 0.0_f64);
    let mut slopes = [[0.0; N]; 7];
    slopes[0] = scene.rates(&state);
    loop {
        let mut next = state;
        for (at, row) in A.iter().enumerate() {
            next = combined(&state, &slopes[..=at], row, length);
            slopes[at + 1] = scene.rates(&next);
        }
        let off = combined(&[0.0; N], &slopes, &ERROR, length);
        let error: f64 =
            off.iter().zip(sizes).map(|(off, size)| (off / (rtol * size)).powi(2)).sum();
        let error = (error / counted).sqrt();
        let factor = (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.2, 5.0);
        if !error.is_finite() || error > 1.0 {
            length *= if error.is_finite() { factor.min(1.0) } else { 0.2 };
            continue;
        }
        let step = Step::of(&state, &next, &slopes, length);
        let (force, lasts) = (|own: &[f64; N]| scene.force(own), |own: &[f64; N]| scene.lasts(own));
        let mut until = 1.0;
        let switches = lasts(&next) < 0.0;
        if switches {
            until = step.zero(1.0, lasts);
            next = step.at(until);
        }
        let is_over = force(&next) <= 0.0;
        if is_over {
            until = step.zero(until, force);
            next = step.at(until);
        }
        peak = peak.max(force(&next));
        if scene.force_rate(&state) > 0.0 && scene.force_rate(&next) <= 0.0 {
            let top = step.zero(until, |own| scene.force_rate(own));
            peak = peak.max(force(&step.at(top)));
        }
        let [rates, depths] = [1, 0].map(|at| [scene.depth(&state)[at], scene.depth(&next)[at]]);
        depth = depth.max(depths[1]);
        if rates[0] > 0.0 && rates[1] <= 0.0 {
            let place = step.zero(until, |own| scene.depth(own)[1]);
            depth = depth.max(scene.depth(&step.at(place))[0]);
        }
        time += until * step.length;
        if is_over {
            return Seen { peak, depth, contact: time, end: next };
        }
        length *= factor;
        state = next;
        slopes[0] = slopes[6];
        if switches {
            scene.switch();
            peak = peak.max(scene.force(&state));
            slopes[0] = scene.rates(&state);
            length = length.min(1e-4);
        }
    }
}
