//! A formula of time.

use dashpot_dae::{Given, Piece, Waveform};
use dashpot_formula::{Expression, Program};

use super::{WaveformKind, pieces};
use crate::{
    parameters,
    parameters::{InvalidParameter, ParameterKind},
};

parameters! {
    /// A formula of the time `t` \[s\] from 0 on: `"2 kN * (t / 1 ms)^2"`.
    ///
    /// Polynomials up to the third degree, with a sine or cosine of one frequency beside them, are followed as they
    /// are. All else is followed up to `until` by cubics that meet with one slope, within 10⁻¹¹ of the largest value;
    /// the last value holds from then on, and a run that is longer warns of it.
    ///
    /// | symbol | field   | unit         | range                       |
    /// |--------|---------|--------------|-----------------------------|
    /// | `u`    | `value` | N, m or m/s² | formula of `t`              |
    /// | `T`    | `until` | s            | > 0, ∞ where left out       |
    ///
    /// # Limits
    ///
    /// A formula of an acceleration is a line with a sine at most: its displacement has to be a cubic. Where `abs`,
    /// `min` or `max` make a kink, the cubics end within 10⁻⁸ of `until` beside it.
    ///
    /// # References
    ///
    /// None: the function is the user's.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Formula: "formula", "a formula of the time t, such as \"2 kN * (t / 1 ms)^2\"" {
        /// formula of t [s], with the dimension of what it drives
        pub value: dashpot_formula::Formula = TimeFormula;
        /// time up to which it is followed [s], positive; needed where it is no cubic and no sine
        pub until: Option<f64> = Quantity(Dimension::TIME), follows "without end", range Positive;
    }
    sample { value: sample(), until: None }
}

/// How well cubics follow the function, in parts of its largest value.
const AGREEMENT: f64 = 1e-11;
/// Parts into which the time is cut at first.
const AT_FIRST: u32 = 8;
/// A part is halved so often at most, which is where a kink is.
const MOST_HALVES: u32 = 24;
/// More cubics are refused.
const MOST: usize = 5000;

fn sample() -> dashpot_formula::Formula {
    match dashpot_formula::Formula::parse("40 N + 8000 N/s^2 * t^2", &|name| name == "t") {
        Ok(sample) => sample,
        Err(_) => unreachable!("the sample is a formula, as a test shows"),
    }
}

impl WaveformKind for Formula {
    fn of_valid(&self) -> Result<Waveform, InvalidParameter> {
        let formula = &self.value;
        let invalid = |range: &'static str, found: String| {
            InvalidParameter::new("value", range, format!("`{formula}`{found}"))
        };
        // What it drives has been looked at where the formula was read.
        let dimension = formula.dimension(ParameterKind::TimeFormula.variables());
        let function = dimension
            .and_then(|own| formula.law(ParameterKind::TimeFormula.variables(), own))
            .map_err(|error| invalid("a formula of `t`", format!(": {error}")))?;
        if let Some(piece) = in_one_piece(&function) {
            return pieces("value", piece.value, vec![piece]);
        }
        let Some(until) = self.until else {
            let range = "given where a formula is no cubic with a sine of one frequency: the time up to which \
                         it is followed, such as \"50 ms\"";
            return Err(InvalidParameter::new("until", range, "left out"));
        };
        let follower = Follower::of(&function, until);
        let mut parts = follower
            .ok_or_else(|| {
                invalid("a formula with a finite value from 0 to `until`", String::new())
            })?
            .parts(until)
            .ok_or_else(|| {
                invalid("a formula that 5000 cubics can follow up to `until`", String::new())
            })?;
        parts.push(Piece { start: until, value: value_at(&function, until), ..Piece::default() });
        let given =
            Given { from: 0.0, to: until, integrals: 0, is_strict: false, is_formula: true };
        pieces("until", until, parts).map(|own| own.given_at(given))
    }
}

fn value_at(function: &Expression, t: f64) -> f64 {
    Program::of([function]).value(&[t])
}

/// The function as a cubic and a sine, where it is that.
fn in_one_piece(function: &Expression) -> Option<Piece> {
    let own = function.polynomial_and_sine(0)?;
    let mut polynomial = own.polynomial;
    while polynomial.last() == Some(&0.0) {
        polynomial.pop();
    }
    if polynomial.len() > 4 {
        return None;
    }
    polynomial.resize(4, 0.0);
    let [value, slope, square, cube] = <[f64; 4]>::try_from(polynomial).ok()?;
    let (curvature, jerk) = (2.0 * square, 6.0 * cube);
    let (sine, cosine, omega) = (own.sine, own.cosine, own.omega);
    Some(Piece { value, slope, curvature, jerk, sine, cosine, omega, ..Piece::default() })
}

/// Follows a function by cubics.
struct Follower {
    /// Its value and slope.
    program: Program,
    /// Largest distance of a cubic.
    most: f64,
}

impl Follower {
    /// `None` where the function has no finite value at one of the places looked at.
    fn of(function: &Expression, until: f64) -> Option<Self> {
        const LOOKS: u32 = 1000;
        let program = Program::of([function, &function.derivative(0)]);
        let own = Self { program, most: 0.0 };
        let places = (0..=LOOKS).map(|at| until * f64::from(at) / f64::from(LOOKS));
        let sizes: Vec<f64> = places.map(|t| own.at(t)[0].abs()).collect();
        let size = sizes.iter().copied().fold(0.0, f64::max);
        let is_followed = size > 0.0 && sizes.iter().all(|own| own.is_finite());
        is_followed.then_some(Self { most: AGREEMENT * size, ..own })
    }

    fn at(&self, t: f64) -> [f64; 2] {
        let mut found = [f64::NAN; 2];
        self.program.evaluate(&[t], &mut found);
        found
    }

    fn parts(&self, until: f64) -> Option<Vec<Piece>> {
        let mut parts = Vec::new();
        for at in 0..AT_FIRST {
            let [from, to] = [at, at + 1].map(|at| until * f64::from(at) / f64::from(AT_FIRST));
            self.follow(from, to, MOST_HALVES, &mut parts)?;
        }
        Some(parts)
    }

    /// Adds the cubics that follow it between two times.
    fn follow(&self, from: f64, to: f64, halves: u32, parts: &mut Vec<Piece>) -> Option<()> {
        let ([start, rise], [end, fall]) = (self.at(from), self.at(to));
        let length = to - from;
        let chord = (end - start) / length;
        let curvature = (6.0 * chord - 4.0 * rise - 2.0 * fall) / length;
        let jerk = 6.0 * (rise + fall - 2.0 * chord) / (length * length);
        let piece =
            Piece { start: from, value: start, slope: rise, curvature, jerk, ..Piece::default() };
        let is_near = |part: f64| {
            let t = from + part * length;
            (piece.derivative(0, t) - self.at(t)[0]).abs() <= self.most
        };
        if halves == 0 || [0.25, 0.5, 0.75].into_iter().all(is_near) {
            parts.push(piece);
            return (parts.len() <= MOST).then_some(());
        }
        let middle = 0.5 * (from + to);
        self.follow(from, middle, halves - 1, parts)?;
        self.follow(middle, to, halves - 1, parts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waveform(text: &str, until: Option<f64>) -> Result<Waveform, String> {
        let value = dashpot_formula::Formula::parse(text, &|name| name == "t")
            .map_err(|error| error.to_string())?;
        Formula { value, until }.waveform().map_err(|error| error.to_string())
    }

    #[test]
    fn cubics_and_sines_are_one_piece() {
        let own =
            waveform("3 N - 2 N/s * t + 5 N * (t / 1 s)^3 - 4 N * sin(6 rad/s * t + 0.5)", None)
                .expect("a waveform");
        assert_eq!(own.pieces().len(), 1);
        for t in [0.0, 0.3, 2.7] {
            let exact = 3.0 - 2.0 * t + 5.0 * t * t * t - 4.0 * (6.0 * t + 0.5_f64).sin();
            assert!((own.value(t) - exact).abs() < 1e-13 * 100.0);
        }
    }

    #[test]
    fn all_else_is_followed_by_cubics() {
        type Function = fn(f64) -> f64;
        let cases: [(&str, Function); 4] = [
            ("2 kN * tanh((t - 10 ms) / 2 ms)", |t| 2e3 * ((t - 0.01) / 0.002).tanh()),
            ("2 kN * (t / 5 ms) * exp(-t / 5 ms)", |t| 2e3 * (t / 0.005) * (-t / 0.005).exp()),
            ("1 kN * max(0, sin(2 * pi * 100 Hz * t))", |t| {
                1e3 * (std::f64::consts::TAU * 100.0 * t).sin().max(0.0)
            }),
            ("1 kN * sin(300 Hz * t) * sin(700 Hz * t)", |t| {
                1e3 * (300.0 * t).sin() * (700.0 * t).sin()
            }),
        ];
        for (text, exact) in cases {
            let own = waveform(text, Some(0.03)).expect("a waveform");
            for at in 0..=3000 {
                let t = 1e-5 * f64::from(at);
                let gap = (own.value(t) - exact(t)).abs();
                // Beside a kink, the last part is 0.03/8/2²⁴ s long.
                assert!(gap < 3e-11 * 2e3 + 1e-3, "{text} at {t}: {gap:e}");
                if !text.contains("max") {
                    assert!(gap < 3e-11 * 2e3, "{text} at {t}: {gap:e}");
                }
            }
        }
        let reason = |text: &str, until| waveform(text, until).expect_err(text);
        assert!(reason("1 N * tanh(t / 1 s)", None).contains("`until` must be given"));
        assert!(reason("1 N / (t / 1 s - 0.5)", Some(1.0)).contains("finite value"));
        assert!(reason("1 N * sin((t / 1 us)^2)", Some(1.0)).contains("5000 cubics"));
    }
}
