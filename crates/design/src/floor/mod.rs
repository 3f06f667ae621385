//! The floor: the least that a body can feel where it is stopped within a travel, whatever the pad.
//!
//! A body of mass `m` comes with `v0` and pushes with any force `u(t)` that a pad could bear, while its support gives
//! way as the rest of the scene tells. The two have then approached each other by
//!
//! ```text
//! y(t) = v0 t + g t²/2 − ∫ G(t − s) u(s) ds
//! ```
//!
//! where `G` is the approach per unit impulse between them, `t/m` on a fixed support. That may never exceed the travel
//! `D`. At each single instant this asks for a least `u`, as large an integral of `G u` with as little of what is
//! judged as there can be; the floor is the most that any instant asks for:
//!
//! | measure | least value at `t` | on a fixed support, without `g` |
//! |---|---|---|
//! | largest `abs(u)` | `(v0 t + g t²/2 − D) / ∫ abs(G)` | `m v0²/(2 D)` at `2 D/v0` |
//! | `∫ abs(u/m g0)^n` | the same over the norm of `G` of the exponent `n/(n − 1)` (Hölder), to the `n`; on a support that gives way, of all instants together, with weights | `(5/8)^2.5 v0⁴/(g0^2.5 D^1.5)` for 2.5 at `T = 8 D/(3 v0)` |
//! | HIC | as no window of the length `τ` has more than `m g0 HIC^0.4 τ^0.6` of impulse | `(v0/g0)^2.5 (3 v0/(8 D))^1.5` at the same `T` |
//!
//! The gravity `g` adds `g` to the first. No pad, of whatever laws and parts without mass, is better. On a fixed
//! support a force reaches each of them, so they are the least; under gravity the weight that is borne after the stop is
//! not counted. Where windows are shorter than `T` the force is the one of a full window over and over: no window across
//! the end of one has more than `τ^0.6`, as `(a + b)^0.6 + (c − a)^0.6 ≥ c^0.6 + b^0.6` for `a + b ≤ c`.
//!
//! # References
//!
//! `balandin1998`, `sevin1971` and `hutchinson1998` in `docs/references.bib`.

mod kernel;
mod scene;
mod together;

#[cfg(test)]
mod tests;

use dashpot_numerics::extrema::maximum;
use dashpot_units::STANDARD_GRAVITY;

pub use self::scene::{Floors, NoFloor, Travel, TravelOf, floors};
use self::{kernel::Kernel, together::least_norm};

/// The exponent of the head injury criterion.
const HIC_EXPONENT: f64 = 2.5;
/// Instants are looked at up to so many times the one at which the body would have gone through the travel.
const FARTHEST: f64 = 50.0;
/// Instants in rising ratio among which the worst one is looked for, and steps of the search beside it.
const INSTANTS: usize = 60;
const STEPS: usize = 40;
/// On a support that springs back, instants ask together up to so many times the one that asks for most.
const LAST: f64 = 2.0;

/// A body that has to be stopped within a travel.
#[derive(Debug, Clone)]
pub struct Stroke {
    mass: f64,
    speed: f64,
    gravity: f64,
    travel: f64,
    kernel: Kernel,
}

/// What is judged of a body that is stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Judged {
    /// The largest acceleration that an accelerometer reads \[m/s²\].
    PeakAcceleration,
    /// The largest force on it \[N\].
    PeakForce,
    /// `∫ (|a|/g0)^n dt` \[s\] of an exponent `n > 1`.
    SeverityIndex {
        /// n.
        exponent: f64,
    },
    /// The head injury criterion \[s\] over windows of at most so many seconds.
    Hic {
        /// The longest window \[s\].
        cap: f64,
    },
}

/// What no pad can beat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// The least value, in SI units.
    pub value: f64,
    /// The last instant that asks for it \[s\] after touch: when the travel is used up.
    pub time: f64,
    /// Whether a force is known that reaches it; else it may lie above.
    pub is_reached: bool,
}

impl Stroke {
    /// A body of this mass \[kg\] and speed \[m/s\] on a fixed support, with a travel \[m\], all above zero, and the
    /// gravity \[m/s²\] that pulls it towards the support.
    ///
    /// # Examples
    ///
    /// 10 kg with 10 m/s within 20 mm: at least 254.9 g, and a HIC of 2696.
    ///
    /// ```
    /// use dashpot_design::floor::{Judged, Stroke};
    ///
    /// let stroke = Stroke::on_fixed(10.0, 10.0, 0.0, 0.02).unwrap();
    /// let least = |judged| stroke.floor(judged).unwrap().value;
    /// assert!((least(Judged::PeakAcceleration) / 9.80665 - 254.93).abs() < 0.01);
    /// assert!((least(Judged::Hic { cap: 0.015 }) - 2695.9).abs() < 0.1);
    /// ```
    pub fn on_fixed(mass: f64, speed: f64, gravity: f64, travel: f64) -> Option<Self> {
        let are_positive = [mass, speed, travel].iter().all(|own| own.is_normal() && *own > 0.0);
        let is_one = are_positive && gravity.is_finite() && gravity >= 0.0;
        is_one.then_some(Self { mass, speed, gravity, travel, kernel: Kernel::Fixed { mass } })
    }

    /// The travel \[m\].
    pub fn travel(&self) -> f64 {
        self.travel
    }

    /// The same with another travel \[m\] above zero.
    #[must_use]
    pub fn within(&self, travel: f64) -> Self {
        Self { travel, ..self.clone() }
    }

    /// The least value of what is judged; `None` where no instant asks for anything that is a number, or the exponent
    /// is not above 1.
    pub fn floor(&self, judged: Judged) -> Option<Floor> {
        let through = self.time_through();
        let ratio = (FARTHEST.ln() / INSTANTS as f64).exp();
        let value = |time: f64| self.asked(judged, time);
        let mut best = (through, 0.0, 0);
        for at in 1..=INSTANTS {
            let time = through * ratio.powi(i32::try_from(at).unwrap_or(i32::MAX));
            let own = value(time);
            if own > best.1 {
                best = (time, own, at);
            }
        }
        if best.1.is_nan() || best.1 <= 0.0 {
            return None;
        }
        let found = maximum(best.0 / ratio, best.0 * ratio, STEPS, value);
        let (time, value) = if found.1 > best.1 { found } else { (best.0, best.1) };
        let is_whole = match judged {
            Judged::PeakAcceleration | Judged::PeakForce => true,
            Judged::SeverityIndex { .. } | Judged::Hic { .. } => self.gravity == 0.0,
        };
        let (time, value) = match judged {
            Judged::SeverityIndex { exponent } if !self.kernel.is_fixed() => {
                let together = self.asked_together(exponent, LAST * time);
                if together.1 > value { together } else { (time, value) }
            }
            _ => (time, value),
        };
        let is_reached = is_whole && self.kernel.is_fixed();
        value.is_finite().then_some(Floor { value, time, is_reached })
    }

    /// When the body has gone through the travel where nothing holds it \[s\].
    fn time_through(&self) -> f64 {
        let &Self { speed, gravity, travel, .. } = self;
        // The root of g t²/2 + v0 t = D without cancellation.
        2.0 * travel / (speed + (speed * speed + 2.0 * gravity * travel).sqrt())
    }

    /// By how much the approach would exceed the travel at an instant, where nothing holds the body \[m\].
    fn missing(&self, time: f64) -> f64 {
        (self.speed + 0.5 * self.gravity * time) * time - self.travel
    }

    /// The last instant that tells, and the least severity index that all up to `end` ask for together.
    fn asked_together(&self, exponent: f64, end: f64) -> (f64, f64) {
        let (time, least) = least_norm(&self.kernel, exponent, end, |time| self.missing(time));
        (time, (least / (self.mass * STANDARD_GRAVITY)).powf(exponent))
    }

    /// The least value that the instant `time` asks for.
    fn asked(&self, judged: Judged, time: f64) -> f64 {
        let (mass, missing) = (self.mass, self.missing(time));
        if missing <= 0.0 {
            return 0.0;
        }
        match judged {
            Judged::PeakForce => missing / self.kernel.area(time),
            Judged::PeakAcceleration => missing / self.kernel.area(time) / mass,
            Judged::SeverityIndex { exponent } => {
                let other = exponent / (exponent - 1.0);
                let norm = self.kernel.power(time, other).powf(1.0 / other);
                (missing / (norm * mass * STANDARD_GRAVITY)).powf(exponent)
            }
            Judged::Hic { cap } => {
                let most = self.kernel.paced(time, cap);
                (missing / (most * mass * STANDARD_GRAVITY)).powf(HIC_EXPONENT)
            }
        }
    }
}
