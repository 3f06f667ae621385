//! Linear two-terminal models: any network of springs and dashpots as a sum of modes.
//!
//! With the deformation `y` \[m\] and the force `F` \[N\], positive in compression, a network of
//! springs and dashpots obeys `F(s) = Q(s) y(s)`, and its relaxance is
//!
//! ```text
//! Q(s) = K_e + C s + Σ K_j s/(s + r_j)            Maxwell form
//! 1/Q(s) = J_g + φ₀/s + Σ φ_i/(s + z_i)           Kelvin form
//! ```
//!
//! with all constants ≥ 0 and the rates of the two forms interlaced. Everything else follows:
//! relaxation stiffness `G(t)`, creep compliance `J(t)`, storage and loss, spectra, and the two
//! canonical networks. Constants are kept with twice the digits of a double, so that going to the
//! other form and back, as often as nesting asks for, loses nothing that a double can show.

mod compose;
mod derivatives;
mod forms;
mod fractions;
mod functions;
mod secular;

pub use dashpot_numerics::DoubleDouble;
pub use forms::{Canonical, KelvinElement, KelvinForm, MaxwellElement, MaxwellForm};
pub use fractions::MERGED_BELOW;

pub(crate) use derivatives::Derivatives;
pub(crate) use fractions::Fractions;
use fractions::Merger;
pub(crate) use secular::Line;

/// Where numbers have twice the digits of a double, and their quotients, too.
const RANGE: std::ops::Range<f64> = 1e-150..1e150;

/// A spring, a dashpot or a rigid link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// `F = k y`, `k` in N/m, finite and ≥ 0.
    Spring(f64),
    /// `F = c ẏ`, `c` in N s/m, finite and ≥ 0.
    Dashpot(f64),
    /// `y = 0`, whatever the force.
    Rigid,
}

/// Modes that coincided when models were composed, and are one mode since.
///
/// One of them can't be seen from outside: it is a pole that a zero cancels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Merged {
    /// Which times: [`Canonical::Maxwell`] for relaxation times, [`Canonical::Kelvin`] for retardation times.
    pub form: Canonical,
    /// The time of the one mode \[s\].
    pub time: f64,
    /// Largest relative distance of their rates, at most [`MERGED_BELOW`].
    pub gap: f64,
    /// How many there were.
    pub count: usize,
}

/// A linear two-terminal model, seen from outside.
///
/// # Examples
///
/// A Burgers element relaxes like two Maxwell elements in parallel:
///
/// ```
/// use dashpot_rheology::{LinearModel, Primitive::{Dashpot, Spring}};
///
/// let [k2, c2, k1, c1] = [Spring(2e7), Dashpot(6e3), Spring(2e7), Dashpot(4e3)];
/// let kelvin = LinearModel::parallel(&[k1, c1].map(LinearModel::primitive));
/// let burgers = LinearModel::series(&[k2.into(), c2.into(), kelvin]);
/// let elements = burgers.maxwell().unwrap().elements();
/// assert_eq!(elements.len(), 2);
/// assert!((elements[0].stiffness + elements[1].stiffness - 2e7).abs() < 1e-8);
/// assert!((burgers.relaxation(0.0) - 2e7).abs() < 1e-8);
/// ```
#[derive(Debug, Clone)]
pub struct LinearModel {
    /// `None` for a rigid link, whose relaxance is infinite.
    maxwell: Option<MaxwellForm>,
    /// `None` for a model that bears no force, whose retardance is infinite.
    kelvin: Option<KelvinForm>,
    merged: Vec<Merged>,
}

impl LinearModel {
    /// The Maxwell form; `None` for a rigid link.
    pub fn maxwell(&self) -> Option<&MaxwellForm> {
        self.maxwell.as_ref()
    }

    /// The Kelvin form; `None` for a model that bears no force.
    pub fn kelvin(&self) -> Option<&KelvinForm> {
        self.kelvin.as_ref()
    }

    /// Whether all its constants, and all that follow from them, are within the range in which
    /// numbers have all their digits. Where they are not, nothing else here has a meaning.
    pub fn is_in_range(&self) -> bool {
        let forms = [
            self.maxwell.as_ref().map(|maxwell| &maxwell.0),
            self.kelvin.as_ref().map(|kelvin| &kelvin.0),
        ];
        forms.into_iter().flatten().all(|form| {
            let is_normal = |value: DoubleDouble| RANGE.contains(&value.high());
            let is_single = |value: DoubleDouble| {
                value.high() == 0.0 || (is_normal(value) && is_normal(value.recip()))
            };
            [form.constant, form.at_zero].into_iter().all(is_single)
                && form.lines.iter().all(|line| {
                    let elements = [line.strength / line.rate, line.strength.recip()];
                    is_normal(line.rate)
                        && is_normal(line.strength)
                        && elements.into_iter().all(is_normal)
                })
        })
    }

    /// Modes that became one when the model was composed.
    pub fn merged(&self) -> &[Merged] {
        &self.merged
    }

    /// The model whose retardance is `J_g + φ₀/s + Σ φ_i/(s + z_i)`; `modes` are the pairs `(z_i, φ_i)` in any order
    /// \[1/s, m/(N s)\]. All constants are finite, `J_g, φ₀ ≥ 0` and `z_i, φ_i > 0`; no two rates are equal.
    pub fn from_kelvin(
        spring_compliance: DoubleDouble,
        fluidity: DoubleDouble,
        modes: impl IntoIterator<Item = (DoubleDouble, DoubleDouble)>,
    ) -> Self {
        let line = |(rate, strength): (DoubleDouble, DoubleDouble)| Line { rate, strength };
        let mut lines: Vec<Line> = modes.into_iter().map(line).collect();
        lines.sort_by(|a, b| a.rate.total_cmp(&b.rate));
        let kelvin = Fractions { constant: spring_compliance, at_zero: fluidity, lines };
        Self::of_kelvin(kelvin, Vec::new())
    }

    /// Number of springs and dashpots of the smallest network with this response: that of either
    /// canonical form. A rigid link needs none.
    pub fn least_elements(&self) -> usize {
        let Some(MaxwellForm(form)) = &self.maxwell else { return 0 };
        let single = [form.constant, form.at_zero].iter().filter(|own| own.high() > 0.0).count();
        single + 2 * form.lines.len()
    }

    fn of_maxwell(form: Fractions, merged: Vec<Merged>) -> Self {
        let kelvin = (!form.is_zero()).then(|| KelvinForm(form.reciprocal()));
        Self { maxwell: Some(MaxwellForm(form)), kelvin, merged }
    }

    fn of_kelvin(form: Fractions, merged: Vec<Merged>) -> Self {
        let maxwell = (!form.is_zero()).then(|| MaxwellForm(form.reciprocal()));
        Self { maxwell, kelvin: Some(KelvinForm(form)), merged }
    }
}

#[cfg(test)]
pub(crate) mod tests;
