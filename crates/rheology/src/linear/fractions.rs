//! Partial fractions with positive strengths, and their reciprocal.

use dashpot_numerics::DoubleDouble;

use super::secular::{Line, Secular};

/// Modes whose rates differ by less, relatively, become one when models are composed.
///
/// Apart by this much or less, two modes differ from one by 10⁻²⁵ in every response, because the
/// one keeps the sum of the strengths and that of the strengths over the rates.
pub const MERGED_BELOW: f64 = 1e-12;

/// Several modes that became one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Merger {
    pub(crate) rate: f64,
    /// Largest relative distance of their rates.
    pub(crate) gap: f64,
    pub(crate) count: usize,
}

/// `F(x) = c − w₀/x − Σ w_j/(x − p_j)` with all constants ≥ 0, `0 < p₁ < p₂ < …`.
///
/// Both forms of a linear model are of this kind: its relaxance is `Q(−x) = −x F(x)` with a dashpot
/// `c`, a spring `w₀` and Maxwell elements of stiffness `w_j` and rate `p_j` in parallel; its
/// retardance is `1/Q(−x) = F(x)` with the compliance `c` of a spring, the fluidity `w₀` of a dashpot
/// and Kelvin–Voigt elements of damping `1/w_j` and rate `p_j` in series.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Fractions {
    pub(crate) constant: DoubleDouble,
    pub(crate) at_zero: DoubleDouble,
    /// In rising order of the rate.
    pub(crate) lines: Vec<Line>,
}

impl Fractions {
    /// The sum of `parts`; modes of different parts that coincide become one and are noted.
    pub(crate) fn sum(parts: &[&Self], mergers: &mut Vec<Merger>) -> Self {
        let line = |&(part, at): &(usize, usize)| parts[part].lines[at];
        let lines = Self::groups(parts).into_iter().map(|group| match &group[..] {
            [only] => line(only),
            several => merged(&several.iter().map(line).collect::<Vec<_>>(), mergers),
        });
        Self {
            lines: lines.collect(),
            constant: parts.iter().map(|part| part.constant).sum(),
            at_zero: parts.iter().map(|part| part.at_zero).sum(),
        }
    }

    /// The lines of all parts as pairs of part and number, in rising order of the rate; those that
    /// coincide stand together.
    pub(crate) fn groups(parts: &[&Self]) -> Vec<Vec<(usize, usize)>> {
        let numbers = |(part, own): (usize, &&Self)| (0..own.lines.len()).map(move |at| (part, at));
        let mut all: Vec<(usize, usize)> = parts.iter().enumerate().flat_map(numbers).collect();
        let rate = |&(part, at): &(usize, usize)| parts[part].lines[at].rate;
        all.sort_by(|a, b| rate(a).total_cmp(&rate(b)));
        let mut groups: Vec<Vec<(usize, usize)>> = Vec::with_capacity(all.len());
        for next in all {
            match groups.last_mut() {
                // Modes of one part were told apart before, and are so still.
                Some(group)
                    if gap(rate(&group[0]), rate(&next)) <= MERGED_BELOW
                        && group.iter().all(|own| own.0 != next.0) =>
                {
                    group.push(next);
                }
                _ => groups.push(vec![next]),
            }
        }
        groups
    }

    /// The same with modes whose rates differ by `within` or less, relatively, as one.
    pub(crate) fn together(&self, within: f64) -> Self {
        let mut lines: Vec<Line> = Vec::with_capacity(self.lines.len());
        let mut rest = self.lines.as_slice();
        while let [first, ..] = rest {
            let is_near = |line: &&Line| gap(first.rate, line.rate) <= within;
            let count = 1 + rest[1..].iter().take_while(is_near).count();
            let group = &rest[..count];
            lines.push(if count == 1 { *first } else { merged(group, &mut Vec::new()) });
            rest = &rest[count..];
        }
        Self { lines, ..self.clone() }
    }

    /// Whether the function is zero everywhere.
    pub(crate) fn is_zero(&self) -> bool {
        self.constant.high() == 0.0 && self.at_zero.high() == 0.0 && self.lines.is_empty()
    }

    /// The other form of the same model: from relaxance to retardance and back.
    ///
    /// The new rates are the zeros of `F`, one between any two poles, and one beyond the last where
    /// `c > 0`; with `Q = −x F`, the strength at the zero `x` is `1/(x F'(x))`. What stands at zero
    /// and at infinity follows from sums of positive terms.
    pub(crate) fn reciprocal(&self) -> Self {
        let (rate, strength) = self.middle();
        let [to_rate, to_strength] = [rate, strength].map(|own| (-own).exp2());
        let scaled =
            |line: &Line| Line { rate: line.rate * to_rate, strength: line.strength * to_strength };
        let own = Self {
            constant: self.constant * to_strength * rate.exp2(),
            at_zero: self.at_zero * to_strength,
            lines: self.lines.iter().map(scaled).collect(),
        };
        let other = own.reciprocal_near_one();
        let back = |line: &Line| Line {
            rate: line.rate * rate.exp2(),
            strength: line.strength * to_strength * rate.exp2(),
        };
        Self {
            constant: other.constant * to_strength,
            at_zero: other.at_zero * to_strength * rate.exp2(),
            lines: other.lines.iter().map(back).collect(),
        }
    }

    /// Exponents of two in the middle of the rates and of the strengths, so that neither squares nor
    /// the second halves of numbers leave the range of doubles.
    fn middle(&self) -> (f64, f64) {
        let exponent = |value: DoubleDouble| value.high().log2();
        let middle = |all: &mut dyn Iterator<Item = f64>| {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for own in all.filter(|own| own.is_finite()) {
                (low, high) = (low.min(own), high.max(own));
            }
            if low <= high { f64::midpoint(low, high).round() } else { 0.0 }
        };
        let lines = || self.lines.iter();
        let strengths = || lines().map(|line| line.strength).chain([self.at_zero]).map(exponent);
        // Beyond the last pole, the zero is about where the constant is as large as a term.
        let constant = exponent(self.constant);
        let last = strengths().map(|strength| strength - constant);
        let rate = middle(&mut lines().map(|line| exponent(line.rate)).chain(last));
        (rate, middle(&mut strengths().chain([constant + rate])))
    }

    fn reciprocal_near_one(&self) -> Self {
        let mut poles = Vec::with_capacity(self.lines.len() + 1);
        if self.at_zero.high() > 0.0 {
            poles.push(Line { rate: DoubleDouble::ZERO, strength: self.at_zero });
        }
        poles.extend(&self.lines);
        let equation = Secular { constant: self.constant, poles: &poles };
        let lines = equation
            .zeros()
            .map(|zero| Line { rate: zero.place, strength: (zero.place * zero.slope).recip() });
        let total: DoubleDouble = self.lines.iter().map(|line| line.strength).sum();
        let over_rates: DoubleDouble =
            self.lines.iter().map(|line| line.strength / line.rate).sum();
        let only_if = |is_zero: bool, sum: DoubleDouble| {
            if is_zero { sum.recip() } else { DoubleDouble::ZERO }
        };
        Self {
            lines: lines.collect(),
            constant: only_if(self.constant.high() == 0.0, self.at_zero + total),
            at_zero: only_if(self.at_zero.high() == 0.0, self.constant + over_rates),
        }
    }
}

/// Relative distance of two rates, the larger one last.
fn gap(low: DoubleDouble, high: DoubleDouble) -> f64 {
    ((high - low) / high).high()
}

/// One mode with the sum of the strengths and the sum of the strengths over the rates.
fn merged(lines: &[Line], mergers: &mut Vec<Merger>) -> Line {
    let strength = lines.iter().map(|line| line.strength).sum::<DoubleDouble>();
    let (first, last) = (lines[0].rate, lines[lines.len() - 1].rate);
    let rate = if first == last {
        first
    } else {
        strength / lines.iter().map(|line| line.strength / line.rate).sum::<DoubleDouble>()
    };
    mergers.push(Merger { rate: rate.high(), gap: gap(first, last), count: lines.len() });
    Line { rate, strength }
}
