//! The thesis' groups (2.27 to 2.36, appendices C and D with their misprints mended).

use super::{FourParameterPadding, FourParameterSupport, ImpactScales, Ranges};
use crate::similarity::SimilarityError;

/// The nine groups of the thesis.
///
/// With `J = δ/V₀` they are the numbers of its equations without dimensions:
/// `ζ″ = A − B φ`, `η″ = −α η′ − β η + γ φ`, `φ″ = −a φ′ − b φ + c ξ″ + d ξ′`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourParameterGroups {
    /// Gravity, `A = g δ/V₀²`.
    ///
    /// The thesis has `A = B g δ/V₀²`, because it leaves the weight of m₂ out; here each mass has its
    /// weight. Without m₂ both are the same.
    pub gravity: f64,
    /// Share of the impactor in the moving mass, `B = m₁/(m₁ + m₂)`, above 0 and up to 1.
    pub share: f64,
    /// `a = (K₂ J/C₁)(1 + K₁/K₂ + C₁/C₂)`.
    pub a: f64,
    /// `b = K₁ K₂ J²/(C₁ C₂)`.
    pub b: f64,
    /// `c = K₂ J²/m₁`, and e, the start slope of the force.
    pub c: f64,
    /// `d = K₁ K₂ J³/(C₁ m₁)`.
    pub d: f64,
    /// `α = C₃ J/m₃`.
    pub alpha: f64,
    /// `β = K₃ J²/m₃`.
    pub beta: f64,
    /// `γ = m₁/m₃`.
    pub gamma: f64,
}

impl FourParameterGroups {
    /// The groups that chapter IV prints; α = 0.2 stands for C₃ = 10 kN s/m.
    pub const PRINTED: Self = Self {
        gravity: 0.0,
        share: 1.0,
        a: 26.6,
        b: 66.66,
        c: 8.0,
        d: 80.0,
        alpha: 0.2,
        beta: 2.0,
        gamma: 0.1,
    };

    /// The groups of an impact without gravity and without a mass m₂ on the padding.
    pub fn of(
        scales: &ImpactScales,
        padding: &FourParameterPadding,
        support: &FourParameterSupport,
    ) -> Self {
        let FourParameterPadding { k1, c1, k2, c2 } = *padding;
        let (j, m1) = (scales.time(), scales.mass);
        Self {
            gravity: 0.0,
            share: 1.0,
            a: k2 * j / c1 * (1.0 + k1 / k2 + c1 / c2),
            b: k1 / c1 * (k2 / c2) * j * j,
            c: k2 * j * j / m1,
            d: k1 / c1 * k2 * j * j * j / m1,
            alpha: support.damping * j / support.mass,
            beta: support.stiffness * j * j / support.mass,
            gamma: m1 / support.mass,
        }
    }

    /// `q = a − b c/d − d/c`: only where it is positive there is a padding with these groups.
    pub fn q(&self) -> f64 {
        self.a - self.b * self.c / self.d - self.d / self.c
    }

    /// Where there is a padding.
    pub fn ranges(&self) -> Ranges {
        let Self { a, b, c, d, .. } = *self;
        // q > 0 is a quadratic in c and in d; the smaller root is a quotient, so that nothing cancels.
        let root = (a * a - 4.0 * b).sqrt();
        let between = |from: f64, to: f64| (from < to).then_some((from, to));
        let of_c = between(2.0 * d / (a + root), d * (a + root) / (2.0 * b));
        let of_d = between(2.0 * b * c / (a + root), c * (a + root) / 2.0);
        let most = (a - d / c) * d / c;
        Ranges([Some((b * c / d + d / c, f64::INFINITY)), between(0.0, most), of_c, of_d])
    }

    /// The padding with these groups (appendix D): `K₂ = c m₁/J²`, `C₂ = d m₁/(b J)`,
    /// `C₁ = c m₁/(q J)`, `K₁ = d m₁/(q J²)`.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::NoPadding`] where q ≤ 0.
    pub fn padding(&self, scales: &ImpactScales) -> Result<FourParameterPadding, SimilarityError> {
        let q = self.q();
        if !(q > 0.0 && q.is_finite()) {
            return Err(SimilarityError::NoPadding { q, ranges: Box::new(self.ranges()) });
        }
        let (j, m1) = (scales.time(), scales.mass);
        Ok(FourParameterPadding {
            k1: self.d * m1 / (q * j * j),
            c1: self.c * m1 / (q * j),
            k2: self.c * m1 / (j * j),
            c2: self.d * m1 / (self.b * j),
        })
    }

    /// The support with these groups.
    pub fn support(&self, scales: &ImpactScales) -> FourParameterSupport {
        let (j, mass) = (scales.time(), scales.mass / self.gamma);
        FourParameterSupport {
            mass,
            stiffness: self.beta * mass / (j * j),
            damping: self.alpha * mass / j,
        }
    }

    /// Letters of the groups, in the order of the thesis.
    pub const LETTERS: [&str; 9] = ["A", "B", "a", "b", "c", "d", "alpha", "beta", "gamma"];

    /// The groups in the order of their [letters](Self::LETTERS).
    fn values_mut(&mut self) -> [&mut f64; 9] {
        let Self { gravity, share, a, b, c, d, alpha, beta, gamma } = self;
        [gravity, share, a, b, c, d, alpha, beta, gamma]
    }

    /// The groups with another in place of that of this letter; `α`, `β`, `γ` stand for their names, and `e` for `c`.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::UnknownQuantity`] for any other name.
    pub fn with(mut self, name: &str, value: f64) -> Result<Self, SimilarityError> {
        let letter = match name {
            "e" => "c",
            "α" => "alpha",
            "β" => "beta",
            "γ" => "gamma",
            own => own,
        };
        let at = Self::LETTERS.iter().position(|own| *own == letter).ok_or_else(|| {
            let known = Self::LETTERS.map(str::to_owned).to_vec();
            SimilarityError::UnknownQuantity { name: name.to_owned(), known }
        })?;
        *self.values_mut()[at] = value;
        Ok(self)
    }

    /// Whether there is an impact with these groups: each has its range, and together they leave a padding.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::GroupOutOfRange`] and [`SimilarityError::NoPadding`].
    pub fn validate(&self) -> Result<(), SimilarityError> {
        let mut own = *self;
        for (name, value) in Self::LETTERS.into_iter().zip(own.values_mut().map(|own| *own)) {
            let (range, is_within) = match name {
                "A" => ("finite", true),
                "B" => ("above 0 and up to 1", value > 0.0 && value <= 1.0),
                "alpha" | "beta" => ("finite, zero or positive", value >= 0.0),
                _ => ("finite and positive", value > 0.0),
            };
            if !(is_within && value.is_finite()) {
                return Err(SimilarityError::GroupOutOfRange { name, value, range });
            }
        }
        self.padding(&ImpactScales::UNIT).map(|_| ())
    }
}
