//! Stiffness of a model in steady vibration.

use super::Model;
use crate::elements::{Element, Law, phases::PhaseLaw};

/// Complex stiffness `K* = K′ + i K″` \[N/m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stiffness {
    /// In phase with the deformation, `K′`.
    storage: f64,
    /// In phase with its rate, `K″`.
    loss: f64,
}

impl Stiffness {
    const NONE: Self = Self { storage: 0.0, loss: 0.0 };
    const RIGID: Self = Self { storage: f64::INFINITY, loss: 0.0 };

    /// That of a model at the angular frequency `omega` \[rad/s\]. Elements that are not linear
    /// count with their typical slopes, those that switch with their first phase.
    pub(crate) fn of(model: &Model, omega: f64) -> Self {
        model.fold(
            |element| Self::of_element(element.as_ref(), omega),
            |tree, parts| {
                if tree.is_series() {
                    Self::in_series(&parts)
                } else {
                    parts.into_iter().fold(Self::NONE, Self::plus)
                }
            },
        )
    }

    fn of_element(element: &dyn Element, omega: f64) -> Self {
        let loss = |damping: f64| damping * omega;
        match element.law() {
            Law::Spring(storage) => Self { storage, loss: 0.0 },
            Law::Dashpot(damping) => Self { storage: 0.0, loss: loss(damping) },
            Law::Rigid => Self::RIGID,
            Law::Nonlinear { stiffness, damping } => {
                Self { storage: stiffness, loss: loss(damping) }
            }
            Law::Phased => match element.phases().map(|phase| phase.law(phase.first(0.0))) {
                // What switches has phases that do not switch.
                Some(PhaseLaw::Element(own)) if own.law() != Law::Phased => {
                    Self::of_element(own.as_ref(), omega)
                }
                Some(PhaseLaw::Held(_)) => Self::RIGID,
                _ => Self::NONE,
            },
        }
    }

    /// `|K*|` \[N/m\].
    pub(crate) fn size(self) -> f64 {
        self.storage.hypot(self.loss)
    }

    /// Loss angle `δ` \[rad\], from 0 to π/2.
    pub(crate) fn angle(self) -> f64 {
        if self.loss == 0.0 { 0.0 } else { self.loss.atan2(self.storage) }
    }

    fn plus(self, other: Self) -> Self {
        Self { storage: self.storage + other.storage, loss: self.loss + other.loss }
    }

    /// `1/K*`, as the real part and the negative of the imaginary part.
    fn inverse(self) -> Self {
        let size = self.size();
        if size == 0.0 {
            return Self::RIGID;
        }
        if size.is_infinite() {
            return Self::NONE;
        }
        Self { storage: self.storage / size / size, loss: self.loss / size / size }
    }

    /// That of several in series.
    pub(crate) fn in_series(parts: &[Self]) -> Self {
        parts.iter().map(|part| part.inverse()).fold(Self::NONE, Self::plus).inverse()
    }
}
