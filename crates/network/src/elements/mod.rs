//! The register of elements.

mod bumper;
mod by_numbers;
mod contact;
mod cubic_spring;
mod custom;
mod dashpot;
mod foam;
mod formula;
mod foundation;
mod friction;
mod hunt_crossley;
mod hysteresis;
mod hysteretic_foam;
mod hysteretic_table;
mod impact_law;
mod indenter;
mod line;
mod monotone;
pub mod phases;
mod piecewise_spring;
mod power;
mod power_dashpot;
mod power_spring;
mod preloaded_spring;
mod rate_spring;
mod rigid;
mod spring;
mod stiffening_spring;
mod table_spring;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use dashpot_rheology::Tree;

pub use bumper::{Bumper, BumperSettings};
pub use contact::Contact;
pub use cubic_spring::CubicSpring;
pub use custom::Custom;
pub use dashpot::Dashpot;
pub use foam::Foam;
pub use formula::Formula;
pub use foundation::Foundation;
pub use friction::Friction;
pub use hunt_crossley::HuntCrossley;
pub use hysteresis::TwoCurves;
pub use hysteretic_foam::HystereticFoam;
pub use hysteretic_table::HystereticTable;
pub use indenter::{Indenter, Shape};
pub use piecewise_spring::PiecewiseSpring;
pub use power_dashpot::PowerDashpot;
pub use power_spring::PowerSpring;
pub use preloaded_spring::PreloadedSpring;
pub use rate_spring::RateSpring;
pub use rigid::Rigid;
pub use spring::Spring;
pub use stiffening_spring::StiffeningSpring;
pub use table_spring::TableSpring;

use crate::{
    parameters::{Described, Kind, Registered},
    phases::Phases,
};

/// A massless two-terminal element: a law giving the force in the element from its deformation
/// and deformation rate.
///
/// # Sign convention
///
/// With terminals *a* → *b*, the deformation is `y = x_a − x_b` \[m\], positive in compression,
/// and the force `F` \[N\] is positive when it pushes the terminals apart: node *a* feels `−F`,
/// node *b* feels `+F`.
pub trait Element: Described {
    /// Force `F(y, ẏ)` \[N\] at deformation `y` \[m\] and deformation rate `rate` \[m/s\].
    fn force(&self, deformation: f64, rate: f64) -> f64;

    /// Partial derivatives of [`force`](Self::force). Where not given, by central differences over steps
    /// `h` of 6·10⁻⁶ of the place, and of what is [typical](Self::typical) at least: wrong by `h² F‴/6` and
    /// about 10⁻¹¹ of the secant.
    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        by_numbers::central_differences(self, deformation, rate)
    }

    /// Energy stored \[J\] at deformation `y` \[m\]. Where not given, `∫ F(s, 0) ds` from 0 to `y` by
    /// adaptive quadrature, to about 10⁻¹³ of `F y`.
    fn stored(&self, deformation: f64) -> f64 {
        by_numbers::work_at_rest(self, deformation)
    }

    /// The law as the compiler of networks sees it; where not given, [`Law::Phased`] of what has phases, else
    /// one that is not linear, with the secants at what is [typical](Self::typical).
    fn law(&self) -> Law {
        if self.phases().is_some() {
            return Law::Phased;
        }
        let [stiffness, damping] = by_numbers::secants(self);
        Law::Nonlinear { stiffness, damping }
    }

    /// A deformation \[m\] and a rate \[m/s\], both positive, that are typical of the use of a law whose
    /// slopes are found by numbers; a few powers of ten do not matter. 10 mm and 1 m/s.
    fn typical(&self) -> [f64; 2] {
        by_numbers::TYPICAL
    }

    /// The deformation \[m\] from which on the force is a power of the deformation or rate beyond, or a sum
    /// of such powers: then no slope is typical of the law. What stands for it is to have the slopes that
    /// it has in the motion at hand, not those of its [`Law::Nonlinear`], which belong to an arbitrary
    /// reference. `None` for all other laws.
    fn grows_from(&self) -> Option<f64> {
        None
    }

    /// What is left of the force without a dashpot of the `damping` `c` \[N s/m\], `F − c ẏ` \[N\], where
    /// the force with it, `F + c ẏ` \[N\], is `sum`; and its slope over `sum`.
    ///
    /// For a law of the rate alone whose slope is zero or infinite at rest. Between the two there is a
    /// law whose slope lies from −1 to 1 whatever that of the force, so that the equations are solved
    /// for it. `None` for all other laws.
    fn reflected(&self, _sum: f64, _damping: f64) -> Option<[f64; 2]> {
        None
    }

    /// The phases of an element whose law changes at switchings, that is of [`Law::Phased`]; its
    /// [`force`](Self::force), [`tangent`](Self::tangent) and [`stored`](Self::stored) are then
    /// those of its first phase.
    fn phases(&self) -> Option<&dyn Phases> {
        None
    }

    /// Whether its law has no tension: `F ≥ 0` in every phase.
    fn never_pulls(&self) -> bool {
        false
    }

    /// What a law of [`Law::Spring`] adds to its force \[N\], `F = F₀ + k y`. Only that of a phase may.
    fn push(&self) -> f64 {
        0.0
    }

    /// The deformations \[m\] between which the force is that of the law: of one of measured points those
    /// of its points, of one that grows without bound as far as it is followed. The force beyond is
    /// extrapolated. `None` where the law holds for all deformations.
    fn range(&self) -> Option<(f64, f64)> {
        None
    }

    /// Whether that range ends where the round body that presses the element is in by its radius, before the law does.
    fn ends_at_equator(&self) -> bool {
        false
    }

    /// The deformations \[m\] between which the force at rest is a cubic of the deformation, in rising order;
    /// none where it is one cubic, and before the first and beyond the last it goes on as one. `None` for
    /// all other laws.
    fn cubics(&self) -> Option<Vec<f64>> {
        None
    }

    /// Both curves of a law that is unloaded on another one than it is loaded on. `None` for all other laws.
    fn two_curves(&self) -> Option<&dyn TwoCurves> {
        None
    }
}

/// Slopes of a law.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tangent {
    /// `∂F/∂y` \[N/m\].
    pub stiffness: f64,
    /// `∂F/∂ẏ` \[N s/m\].
    pub damping: f64,
}

/// A law by its structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// `F = k y`, `k` in N/m.
    Spring(f64),
    /// `F = c ẏ`, `c` in N s/m.
    Dashpot(f64),
    /// `y = 0`, whatever the force.
    Rigid,
    /// [`Element::force`], which is not linear. A spring and a dashpot in parallel of these
    /// constants, at least one of them positive, stand for it where the structure of a network is
    /// found; what the force differs from theirs by is a term of the equations.
    Nonlinear {
        /// A typical slope `∂F/∂y` \[N/m\]; 0 for a law of the rate alone.
        stiffness: f64,
        /// A typical slope `∂F/∂ẏ` \[N s/m\]; 0 for a law of the deformation alone.
        damping: f64,
    },
    /// The law of one of its [`phases`](Element::phases) at a time.
    Phased,
}

const fn element<E: Element + Kind>() -> Registered<Arc<dyn Element>> {
    Registered::new::<E>(|values| Ok(Arc::new(E::from_values(values)?)), ())
}

macro_rules! elements {
    ($($kind:ident,)*) => {
        /// Every element kind.
        pub static ELEMENTS: &[Registered<Arc<dyn Element>>] = &[$(element::<$kind>(),)*];

        $(impl From<$kind> for Tree<Arc<dyn Element>> {
            fn from(element: $kind) -> Self {
                Self::Part(Arc::new(element))
            }
        })*
    };
}

// **A new kind is registered here.**
elements! {
    Spring,
    Dashpot,
    Rigid,
    Contact,
    Friction,
    PowerSpring,
    CubicSpring,
    StiffeningSpring,
    PiecewiseSpring,
    PreloadedSpring,
    TableSpring,
    Formula,
    Foam,
    HystereticFoam,
    HystereticTable,
    RateSpring,
    PowerDashpot,
    HuntCrossley,
    Bumper,
    Foundation,
}
