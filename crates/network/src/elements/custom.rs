//! An element whose law is given as a function.

use std::{fmt, sync::Arc};

use dashpot_rheology::Tree;

use super::{
    ELEMENTS, Element, Tangent,
    by_numbers::{TYPICAL, central_differences, secants, work_at_rest},
};
use crate::parameters::{Described, InvalidParameter, registered};

/// An element whose law is given as a function, `F(y, ẏ)` \[N\] over the deformation `y` \[m\] and
/// its rate \[m/s\].
///
/// The function is to have a number for all deformations and rates, is to be continuous, and must
/// fall neither with the one nor with the other; `F(0, 0) = 0`. What it has at rest is elastic: it
/// stores `∫ F(s, 0) ds`, and dissipates `(F(y, ẏ) − F(y, 0)) ẏ`. That integral and the slopes are
/// found by numbers, as [`Element::stored`] and [`Element::tangent`] say, unless they are given, too.
///
/// # Limits
///
/// A law that is steeper than any line at rest over the rate, such as `√ẏ`, is a
/// [`PowerDashpot`](super::PowerDashpot); one with a memory is an [`Element`] with
/// [`phases`](Element::phases). It has no parameters, so it can be neither written to a scene nor
/// scaled, and two of one name count as the same model.
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

    /// The same element with the slopes of its law over deformation \[m\] and rate \[m/s\].
    #[must_use]
    pub fn with_tangent(
        self,
        tangent: impl Fn(f64, f64) -> Tangent + Send + Sync + 'static,
    ) -> Self {
        Self { tangent: Some(Arc::new(tangent)), ..self }
    }

    /// The same element with the energy \[J\] that it stores at a deformation \[m\]; the run loses what
    /// this differs by from the work at rest.
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
        let at_rest = self.force(0.0, 0.0);
        if at_rest != 0.0 {
            let found = format!("{at_rest} N");
            return Err(InvalidParameter::new(self.kind, "a law without a force at rest", found));
        }
        let [stiffness, damping] = secants(self);
        let is_slope = |own: f64| own >= 0.0 && own.is_finite();
        if is_slope(stiffness) && is_slope(damping) && stiffness + damping > 0.0 {
            return Ok(());
        }
        let [deformation, rate] = self.typical;
        let range = format!("a law that rises up to {deformation} m and {rate} m/s");
        let found = format!("one of {stiffness} N/m and {damping} N s/m");
        Err(InvalidParameter::new(self.kind, range, found))
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

impl From<Custom> for Tree<Arc<dyn Element>> {
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
        let refused = [
            says("mine", |y, v| v - y),
            says("mine", |_, _| 1.0),
            says("mine", |_, _| 0.0),
            says("mine", |y, _| y / (0.01 - y)),
        ];
        for own in refused {
            assert!(
                own.as_ref().is_err_and(|text| text.starts_with("`mine` must be a law")),
                "{own:?}"
            );
        }
        assert!(says("spring", |y, _| y).is_err_and(|text| text.contains("a word of its own")));
    }
}
