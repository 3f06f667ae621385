//! An element whose law is given as a function.

use std::{
    borrow::Cow,
    fmt,
    ops::{Add, BitOr},
    sync::Arc,
};

use dashpot_rheology::Tree;

use super::{
    ELEMENTS, Element, Tangent,
    by_numbers::{TYPICAL, central_differences, rises, secants, work_at_rest},
};
use crate::parameters::{Described, InvalidParameter, registered};

type Parts = Tree<Arc<dyn Element>>;

/// How well given slopes and energies must fit the force, in parts of its secant.
const FIT: f64 = 1e-3;

/// An element whose law is given as a function, `F(y, ẏ)` \[N\] over the deformation `y` \[m\] and its rate \[m/s\].
///
/// `y > 0` is compression, and `F > 0` pushes the ends apart. The function is asked for both signs of both, for trial
/// values beyond those of the motion, and from several threads: it is to have a number everywhere, is to be continuous,
/// and must fall neither with the one nor with the other; `F(0, 0) = 0`. That is checked up to three times what is
/// [typical](Self::typically), and told by place where it is not so. What it has at rest is elastic: it stores `∫ F(s,
/// 0) ds`, and dissipates `(F(y, ẏ) − F(y, 0)) ẏ`, which is never negative for such a law. That integral and the slopes
/// are found by numbers, as [`Element::stored`] and [`Element::tangent`] say, unless they are given, too.
///
/// # Limits
///
/// A law that is steeper than any line at rest over the rate, such as `√ẏ`, is a
/// [`PowerDashpot`](super::PowerDashpot); one with a memory is an [`Element`] with
/// [`phases`](Element::phases). It has no parameters, so it can be neither written to a scene nor
/// scaled: both are refused. Two count as the same model only where one is a clone of the other.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::Custom};
///
/// let foam = Custom::new("my-foam", |y, v| 3e4 * y + 2e7 * y.powi(3) + 60.0 * v + 20.0 * v.powi(3));
/// assert!((foam.force(0.01, 2.0) - (320.0 + 280.0)).abs() < 1e-9);
/// assert!((foam.tangent(0.01, 0.0).stiffness - 36e3).abs() < 1e-4);
/// assert!((foam.stored(0.01) - (1.5 + 0.05)).abs() < 1e-12);
/// ```
#[derive(Clone)]
pub struct Custom {
    kind: &'static str,
    force: Arc<dyn Fn(f64, f64) -> f64 + Send + Sync>,
    tangent: Option<Arc<dyn Fn(f64, f64) -> Tangent + Send + Sync>>,
    stored: Option<Arc<dyn Fn(f64) -> f64 + Send + Sync>>,
    typical: [f64; 2],
}

impl Custom {
    /// The element of this law; `kind` is its word in reports, and none of the register.
    pub fn new(
        kind: &'static str,
        force: impl Fn(f64, f64) -> f64 + Send + Sync + 'static,
    ) -> Self {
        Self { kind, force: Arc::new(force), tangent: None, stored: None, typical: TYPICAL }
    }

    /// The same element with the slopes of its law over deformation \[m\] and rate \[m/s\], which saves the
    /// differences.
    #[must_use]
    pub fn with_tangent(
        self,
        tangent: impl Fn(f64, f64) -> Tangent + Send + Sync + 'static,
    ) -> Self {
        Self { tangent: Some(Arc::new(tangent)), ..self }
    }

    /// The same element with the energy `∫ F(s, 0) ds` \[J\] that it stores at a deformation \[m\], which saves
    /// the quadrature.
    #[must_use]
    pub fn with_stored(self, stored: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self { stored: Some(Arc::new(stored)), ..self }
    }

    /// The same element with a typical deformation \[m\] and rate \[m/s\], both positive, in place of 10 mm
    /// and 1 m/s; see [`Element::typical`].
    #[must_use]
    pub fn typically(self, deformation: f64, rate: f64) -> Self {
        Self { typical: [deformation, rate], ..self }
    }
}

impl fmt::Debug for Custom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Custom").field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl Described for Custom {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        if registered(ELEMENTS, self.kind).is_some() {
            let found = "that of a built-in element";
            return Err(InvalidParameter::new(self.kind, "a word of its own", found));
        }
        let is_word = |own: char| own.is_ascii_alphanumeric() || own == '-';
        if self.kind.is_empty() || !self.kind.chars().all(is_word) {
            return Err(
                self.invalid("a word of letters, digits and `-`", format!("`{}`", self.kind))
            );
        }
        if !self.typical.iter().all(|own| *own > 0.0 && own.is_finite()) {
            let [deformation, rate] = self.typical;
            let found = format!("{deformation} m and {rate} m/s");
            return Err(self.invalid("typical of positive deformations and rates", found));
        }
        rises(self, self.kind)?;
        let [stiffness, damping] = secants(self);
        if stiffness + damping <= 0.0 {
            let [deformation, rate] = self.typical.map(|own| 3.0 * own);
            let found = format!("none up to {deformation} m and {rate} m/s; see `typically`");
            return Err(self.invalid("a law with a force", found));
        }
        self.fits(stiffness.max(damping * self.typical[1] / self.typical[0]))
    }
}

impl Custom {
    fn invalid(&self, range: impl Into<Cow<'static, str>>, found: String) -> InvalidParameter {
        InvalidParameter::new(self.kind, range, found)
    }

    /// Whether slopes and energy, where they are given, are those of the force, whose secant is as large as
    /// `size` \[N/m\].
    fn fits(&self, size: f64) -> Result<(), InvalidParameter> {
        let [deformation, rate] = self.typical;
        for y in [-deformation, deformation] {
            let (given, work) = (self.stored(y), work_at_rest(self, y));
            if (given - self.stored(0.0) - work).abs() > FIT * size * y * y
                || self.stored(0.0) != 0.0
            {
                let found = format!("{given} J at {y} m, where it is {work} J, and 0 J at rest");
                return Err(self.invalid("an energy that is the work of the force", found));
            }
            for v in [-rate, rate] {
                let (given, own) = (self.tangent(y, v), central_differences(self, y, v));
                let gap = (given.stiffness - own.stiffness).abs() * deformation
                    + (given.damping - own.damping).abs() * rate;
                if gap > FIT * size * deformation {
                    let found = format!("{given:?} at {y} m and {v} m/s, where it is {own:?}");
                    return Err(self.invalid("slopes that are those of the force", found));
                }
            }
        }
        Ok(())
    }
}

/// What composes models takes an element of one's own on the left, too.
impl<T: Into<Parts>> Add<T> for Custom {
    type Output = Parts;

    fn add(self, other: T) -> Parts {
        Parts::from(self) + other
    }
}

impl<T: Into<Parts>> BitOr<T> for Custom {
    type Output = Parts;

    fn bitor(self, other: T) -> Parts {
        Parts::from(self) | other
    }
}

impl Element for Custom {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        (self.force)(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        match &self.tangent {
            Some(tangent) => tangent(deformation, rate),
            None => central_differences(self, deformation, rate),
        }
    }

    fn stored(&self, deformation: f64) -> f64 {
        match &self.stored {
            Some(stored) => stored(deformation),
            None => work_at_rest(self, deformation),
        }
    }

    fn typical(&self) -> [f64; 2] {
        self.typical
    }
}

impl From<Custom> for Parts {
    fn from(element: Custom) -> Self {
        Self::Part(Arc::new(element))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_that_fall_or_push_at_rest_are_refused_by_name() {
        let says = |kind, force: fn(f64, f64) -> f64| {
            Custom::new(kind, force).validate().map_err(|own| own.to_string())
        };
        assert_eq!(says("mine", |y, v| y + v), Ok(()));
        assert_eq!(says("mine", |y, _| 1e6 * (y - 0.012).max(0.0)), Ok(()));
        assert_eq!(says("mine", |y, v| 6e4 * y + 300.0 * v.min(0.0)), Ok(()));
        let refused = [
            says("mine", |y, v| v - y),
            says("mine", |_, _| 1.0),
            says("mine", |_, _| 0.0),
            says("mine", |y, _| y / (0.02 - y)),
            says("mine", |y, _| 1e4 * y.powf(1.5)),
            says("mine", |y, v| 1e4 * y + 20.0 * v * v),
            says("mine", |y, _| (1e3 * y).sin()),
            says("my pad", |y, _| y),
        ];
        for own in refused {
            assert!(own.as_ref().is_err_and(|text| text.contains("must be")), "{own:?}");
        }
        assert!(says("spring", |y, _| y).is_err_and(|text| text.contains("a word of its own")));
    }

    #[test]
    fn laws_that_begin_late_or_damp_one_way_keep_their_stiffness_and_damping() {
        let gap = Custom::new("gap", |y, v| 1e6 * (y - 0.012).max(0.0) + 50.0 * v);
        assert!(secants(&gap)[0] > 0.0 && secants(&gap)[1] > 0.0);
        let rebound = Custom::new("rebound", |y, v| 6e4 * y + 300.0 * v.min(0.0));
        assert!((secants(&rebound)[1] - 300.0).abs() < 1e-6);
        let deep = |y: f64, v: f64| 6e4 * y + 3e4 * (y - 0.015).max(0.0) * v;
        assert!(secants(&Custom::new("deep", deep))[1] > 0.0);
    }

    #[test]
    fn given_slopes_and_energies_must_be_those_of_the_force() {
        let law = || Custom::new("mine", |y, _| 2.0 * y);
        assert!(law().with_stored(|y| y * y).validate().is_ok());
        assert!(law().with_stored(|y| 2.0 * y * y).validate().is_err());
        let slopes = |stiffness| move |_: f64, _: f64| Tangent { stiffness, damping: 0.0 };
        assert!(law().with_tangent(slopes(2.0)).validate().is_ok());
        assert!(law().with_tangent(slopes(3.0)).validate().is_err());
    }
}
