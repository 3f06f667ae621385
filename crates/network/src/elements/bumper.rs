//! Contact with a wanted restitution.

use dashpot_numerics::roots::{TO_THE_LAST_BIT, bisect};

use super::{
    Element, Tangent,
    impact_law::{Impact, ImpactLaw},
    power::PowerLaw,
};
use crate::{
    parameters,
    parameters::{Described, InvalidParameter, Kind, Parameter, Value},
    phases::Phases,
};

/// A contact that gives back a wanted part of the speed: the law of
/// [`HuntCrossley`](super::HuntCrossley) with its `c` from the restitution `e` at a speed `v`.
///
/// | symbol | field         | unit | range |
/// |--------|---------------|------|-------|
/// | `F_r`  | `force`       | N    | > 0   |
/// | `y_r`  | `at`          | m    | > 0   |
/// | `e`    | `restitution` | 1    | 0 < e ≤ 1 |
/// | `v`    | `speed`       | m/s  | > 0   |
/// | `n`    | `exponent`    | 1    | ≥ 1, 3/2 (Hertz) where left out |
/// | `gap`  | `gap`         | m    | finite, 0 where left out |
///
/// # Derivation
///
/// A mass `m` that meets the force `S(z) (1 + c ẏ)` alone obeys `m u du = −S (1 + c u) dz` with its
/// speed `u`. Compression takes it from `v` to 0 over a depth with the work `W = ∫ S dz`, and
/// restitution from 0 to `−e v` over the same: `W/m = ∫₀^v u/(1 + c u) du = ∫₀^{e v} u/(1 − c u) du`.
/// With `d = c v` both integrals give `d − ln(1 + d) = −e d − ln(1 − e d)`, so
///
/// `d (1 + e) = ln((1 + d)/(1 − e d))`.
///
/// Neither mass nor stiffness nor exponent matter. The equation has one solution `0 < d < 1/e` for
/// every `e` between 0 and 1, and it is solved to the last digits; `c = d/v`. The closed formulas in
/// use are approximations: `c = 3 (1 − e)/(2 v)` (Hunt and Crossley) holds as `e → 1`, and
/// `c = 8 (1 − e)/(5 e v)` (Flores et al.) lies 7 % above the solution there and 60 % as `e → 0`.
///
/// # Limits
///
/// Slower impacts give back a greater part, faster ones a smaller. `e` is that of a mass on which no
/// other force acts meanwhile, or of the reduced mass of two. `e = 0` would need an infinite `c`: a
/// [`Contact`](super::Contact) has it. Otherwise as [`HuntCrossley`](super::HuntCrossley).
///
/// # Examples
///
/// ```
/// use dashpot_network::elements::{Bumper, BumperSettings};
///
/// let wanted = BumperSettings {
///     force: 1000.0,
///     at: 0.001,
///     restitution: 0.3,
///     speed: 2.0,
///     exponent: 1.5,
///     gap: 0.0,
/// };
/// let d = 2.0 * Bumper::new(wanted)?.dissipation();
/// assert!((d * 1.3 - ((1.0 + d) / (1.0 - 0.3 * d)).ln()).abs() < 1e-14);
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # References
///
/// `hunt1975` and `flores2011` in `docs/references.bib`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bumper {
    settings: BumperSettings,
    dissipation: f64,
}

parameters! {
    /// What a [`Bumper`] is made of.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct BumperSettings: "bumper", "contact that gives back the part e of the speed v" {
        /// force F_r at the deformation `at` [N], positive
        pub force: f64 = Quantity(Dimension::FORCE), range Positive;
        /// reference deformation y_r [m], positive
        pub at: f64 = Quantity(Dimension::LENGTH), range Positive;
        /// part e of the speed that is given back [1], above 0, 1 at most
        pub restitution: f64 = Quantity(Dimension::NUMBER), range PositivePart;
        /// speed of approach v for which that holds [m/s], positive
        pub speed: f64 = Quantity(Dimension::VELOCITY), range Positive;
        /// exponent n of the depth [1], 1 or more
        pub exponent: f64 = Quantity(Dimension::NUMBER), default "1.5", range AtLeastOne;
        /// deformation at which it engages [m]
        pub gap: f64 = Quantity(Dimension::LENGTH), default "0 m";
    }
    sample { force: 1000.0, at: 0.001, restitution: 0.5, speed: 2.0, exponent: 1.5, gap: 0.0 }
}

impl Bumper {
    /// The bumper of these settings.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for the first setting out of its range.
    pub fn new(settings: BumperSettings) -> Result<Self, InvalidParameter> {
        settings.validate()?;
        let BumperSettings { restitution, speed, .. } = settings;
        let bumper = Self { settings, dissipation: number_of_damping(restitution) / speed };
        bumper.impact().fits().map_err(|invalid| {
            // The dissipation is nobody's setting; it is out of range where the speed is.
            let parameter =
                if invalid.parameter == "dissipation" { "speed" } else { invalid.parameter };
            let found =
                if parameter == "speed" { format!("{speed:?}") } else { invalid.found.clone() };
            InvalidParameter { parameter, found, ..invalid }
        })?;
        Ok(bumper)
    }

    /// What it was made of.
    pub fn settings(&self) -> BumperSettings {
        self.settings
    }

    /// The `c` of its law \[s/m\], zero for a restitution of 1.
    pub fn dissipation(&self) -> f64 {
        self.dissipation
    }
}

/// The solution `d ≥ 0` of `d (1 + e) = ln((1 + d)/(1 − e d))` for `0 < e ≤ 1`.
fn number_of_damping(e: f64) -> f64 {
    if e >= 1.0 {
        return 0.0;
    }
    // x = −ln(1 − e d) tells d from its limit 1/e, of which d itself falls short by e^(−1/e).
    let of = |x: f64| -(-x).exp_m1() / e;
    let most = (1.0 + e) / e + 1.0;
    let (low, high) = bisect(0.0, most, TO_THE_LAST_BIT, |x| excess(e, x, of(x)) >= 0.0);
    of(f64::midpoint(low, high))
}

/// A number of the sign of `ln(1 + d) + x − d (1 + e)`, where `x = −ln(1 − e d)`.
fn excess(e: f64, x: f64, d: f64) -> f64 {
    if d > 0.2 {
        return d.ln_1p() + x - d * (1.0 + e);
    }
    // Over d² and as the series Σ (e^k − (−1)^k) d^(k−2)/k from k = 2 on: nothing cancels.
    let mut sum = -0.5 * (1.0 - e) * (1.0 + e);
    let (mut of_d, mut of_e, mut sign, mut order) = (1.0, e * e, 1.0, 2.0);
    while of_d > f64::EPSILON * 1e-3 {
        order += 1.0;
        of_d *= d;
        of_e *= e;
        sign = -sign;
        sum += (of_e - sign) * of_d / order;
    }
    sum
}

impl Impact for Bumper {
    fn impact(&self) -> ImpactLaw {
        let BumperSettings { force, at, exponent, gap, .. } = self.settings;
        let power = PowerLaw { force, at, exponent };
        ImpactLaw { power, dissipation: self.dissipation, gap }
    }
}

impl Element for Bumper {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.impact().force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.impact().tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.impact().stored(deformation)
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }
}

impl Kind for Bumper {
    const KIND: &'static str = BumperSettings::KIND;
    const SUMMARY: &'static str = BumperSettings::SUMMARY;
    const PARAMETERS: &'static [Parameter] = BumperSettings::PARAMETERS;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Self::new(BumperSettings::from_values(values)?)
    }

    fn fields(&self) -> Vec<Value> {
        self.settings.values()
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        Self::new(self.settings).map(|_| ())
    }

    fn sample() -> Self {
        let settings = BumperSettings::sample();
        Self { settings, dissipation: number_of_damping(settings.restitution) / settings.speed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_damping_number_solves_its_equation_for_every_restitution() {
        for at in 1..1000 {
            let e = f64::from(at) / 1000.0;
            let d = number_of_damping(e);
            assert!(d > 0.0 && d * e <= 1.0, "{e}");
            if d > 0.2 && 1.0 - e * d > 1e-3 {
                let rest = d * (1.0 + e) - ((1.0 + d) / (1.0 - e * d)).ln();
                // The slope of the equation over d, times the last digits of d.
                let slope = (1.0 + e) - 1.0 / (1.0 + d) - e / (1.0 - e * d);
                assert!(rest.abs() < 1e-14 * (d * (2.0 + e) + slope.abs() * d), "{e} {rest}");
            }
        }
    }

    #[test]
    fn the_damping_number_has_both_limits() {
        for small in [1e-3, 1e-6, 1e-12] {
            let near_one = 1.5 * small / (1.0 - small * (1.0 - small));
            let d = number_of_damping(1.0 - small);
            // The next term of the series in 1 − e.
            assert!((d / near_one - 1.0).abs() < small + 1e-4, "{small}");
        }
        assert!(number_of_damping(1.0).abs() <= 0.0);
        for e in [1e-2, 1e-6, 1e-200] {
            assert!((number_of_damping(e) * e - 1.0).abs() < 4.0 * f64::EPSILON, "{e}");
        }
    }

    /// A mass on the bumper, by the classical method of Runge and Kutta in the speed over time.
    #[test]
    fn a_mass_leaves_with_the_wanted_part_of_its_speed() {
        for e in [0.02, 0.1, 0.3, 0.6, 0.9, 0.99] {
            for (exponent, speed) in [(1.0, 3.0), (1.5, 3.0), (2.5, 0.2)] {
                let settings = BumperSettings {
                    force: 500.0,
                    at: 0.01,
                    restitution: e,
                    speed,
                    exponent,
                    gap: 0.003,
                };
                let bumper = Bumper::new(settings).unwrap();
                let found = rebound(&bumper, 2.0, speed) / speed;
                assert!((found - e).abs() < 1e-5, "{e} {exponent} {speed}: {found}");
            }
        }
    }

    fn rebound(bumper: &Bumper, mass: f64, speed: f64) -> f64 {
        let rates = |[y, v]: [f64; 2]| [v, -bumper.force(y, v) / mass];
        let moved = |[y, v]: [f64; 2], by: f64, [p, q]: [f64; 2]| [y + by * p, v + by * q];
        // The law engages above its gap, so the first step begins just there. The force is next to
        // nothing where it lets go, so the last step may end beyond.
        let mut state = [0.003 + 1e-12, speed];
        let mut steps = 0;
        while state[0] > 0.003 && steps < 4_000_000 {
            let slope = bumper.tangent(state[0], state[1]);
            let fastest = (slope.stiffness / mass).sqrt() + slope.damping / mass;
            let step = (0.01 / fastest).min(1e-4 * 0.01 / speed);
            let a = rates(state);
            let b = rates(moved(state, 0.5 * step, a));
            let c = rates(moved(state, 0.5 * step, b));
            let d = rates(moved(state, step, c));
            let sum = [0, 1].map(|at| (a[at] + 2.0 * b[at] + 2.0 * c[at] + d[at]) / 6.0);
            state = moved(state, step, sum);
            steps += 1;
        }
        -state[1]
    }

    #[test]
    fn it_never_pulls() {
        let bumper = Bumper::sample();
        for rate in [-100.0, -1.0 / bumper.dissipation(), -1.0, 0.0, 5.0] {
            for depth in [1e-12, 1e-6, 1e-3, 0.1] {
                assert!(bumper.force(depth, rate) >= 0.0, "{depth} {rate}");
            }
            assert!(bumper.force(-1e-6, rate).abs() <= 0.0);
        }
    }

    #[test]
    fn settings_out_of_range_are_told_by_their_names() {
        let of = |change: fn(&mut BumperSettings)| {
            let mut settings = Bumper::sample().settings();
            change(&mut settings);
            Bumper::new(settings).unwrap_err().parameter
        };
        assert_eq!(of(|own| own.restitution = 0.0), "restitution");
        assert_eq!(of(|own| own.restitution = 1.5), "restitution");
        assert_eq!(of(|own| own.speed = 0.0), "speed");
        assert_eq!(of(|own| own.speed = 1e-320), "speed");
        assert_eq!(of(|own| own.exponent = 0.5), "exponent");
        assert_eq!(of(|own| own.gap = f64::NAN), "gap");
    }
}
