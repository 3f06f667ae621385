//! The step-by-step methods: each is an integrator of `diffsol` and what is to be known of it.

use diffsol::Tableau;

use super::stepping::{Integrator, MOST_EXPLICIT, MOST_LINEAR, Scheme};
use crate::System;

/// Backward differentiation of order 1 to 5 with variable steps, on the system as it stands:
/// algebraic unknowns need no elimination, stiffness no small steps.
///
/// Its dense output in a step is the polynomial of the step's order through the ends of the last
/// steps, so that nothing but these ends is kept.
///
/// On lightly damped oscillations it loses energy: of ζ = 10⁻⁴ over 1000 periods 5 % at a tolerance
/// of 10⁻⁶, and nearly all at 10⁻⁴.
///
/// Shampine and Reichelt, The MATLAB ODE suite, SIAM J. Sci. Comput. 18 (1997) 1–22.
#[derive(Debug, Clone, Copy, Default)]
pub struct Bdf;

impl Scheme for Bdf {
    const KIND: &'static str = "bdf";
    const SUMMARY: &'static str =
        "backward differentiation of variable order: for every system, large and stiff ones too";
    const INTEGRATOR: Integrator = Integrator::Bdf;
    const HIGHEST: u8 = 5;
    const ORDER: usize = 1;
    // Where its steps are few it works at order 4 or 5, which give 4/5 and 5/6.
    const FALL: f64 = 0.85;
}

/// TR-BDF2, a one-step method of order 2 with error control: it restarts without loss, damps stiff
/// parts at once and keeps the energy of light oscillations well: 99.9 % over 1000 periods at
/// ζ = 10⁻⁴ and a tolerance of 10⁻⁶, where [`Bdf`] keeps 95 %.
///
/// Its dense output in a step is a parabola, of the method's own order.
///
/// Hosea and Shampine, Analysis and implementation of TR-BDF2, Appl. Numer. Math. 20 (1996) 21–37.
#[derive(Debug, Clone, Copy, Default)]
pub struct TrBdf2;

impl Scheme for TrBdf2 {
    const KIND: &'static str = "tr-bdf2";
    const SUMMARY: &'static str =
        "order 2, one step at a time: for lightly damped oscillation and frequent switching";
    const INTEGRATOR: Integrator = Integrator::Implicit(Tableau::tr_bdf2, 2);
    const HIGHEST: u8 = 2;
    const ORDER: usize = 2;
}

/// ESDIRK34, a one-step method of order 3 with four stages: it restarts without loss and damps stiff parts at once, but
/// light oscillations as well: at ζ = 10⁻⁴ a tolerance of 10⁻⁴ loses all of their energy within 1000 periods.
///
/// Its dense output in a step is the cubic through the values and slopes at both ends. That of an
/// algebraic unknown needs the unknown's slope at the start of a span, which the adapter provides.
///
/// Jørgensen, Kristensen and Thomsen, A family of ESDIRK integration methods, arXiv 1803.01613.
#[derive(Debug, Clone, Copy, Default)]
pub struct Esdirk34;

impl Scheme for Esdirk34 {
    const KIND: &'static str = "esdirk34";
    const SUMMARY: &'static str =
        "order 3, one step at a time: for frequent switching with strong damping";
    const INTEGRATOR: Integrator = Integrator::Implicit(Tableau::esdirk34, 3);
    const HIGHEST: u8 = 3;
    const ORDER: usize = 3;
}

/// Tsitouras' explicit method of order 5 with an embedded one of order 4. Stiffness forces it to small steps, and it
/// cannot solve algebraic unknowns; it is a check on the implicit methods that shares nothing with them.
///
/// Its dense output in a step is a polynomial of degree 4.
///
/// Tsitouras, Runge–Kutta pairs of order 5(4), Comput. Math. Appl. 62 (2011) 770–775.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tsit45;

impl Scheme for Tsit45 {
    const KIND: &'static str = "tsit45";
    const SUMMARY: &'static str = "explicit, order 5: an independent check where nothing is stiff";
    const INTEGRATOR: Integrator = Integrator::Explicit(Tableau::tsit45, 4);
    const HIGHEST: u8 = 5;
    const ORDER: usize = 4;
    // The step is controlled by the error of order 4, while the solution is of order 5.
    const FALL: f64 = 1.0;

    fn suits(system: &System) -> Result<&'static str, String> {
        match system.algebraic() {
            0 => Ok("every unknown has a rate of its own"),
            algebraic => Err(format!(
                "it is explicit, and {algebraic} of the unknowns follow from balances; `bdf` can"
            )),
        }
    }
}

/// Dormand's and Prince's explicit method of order 8 with error estimates of order 5 and 3, for small systems
/// that are not stiff. Each stage solves the balances, so that laws that are not linear are no obstacle. Where
/// stability would ask for many steps, by the fastest rate at the start of a mode interval or after some of these
/// steps, [`Bdf`] goes on to the end of the interval.
///
/// Its dense output in a step is a polynomial of degree 7, so that few steps tell all of an impact.
///
/// Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer 1993, II.5 and II.10.
#[derive(Debug, Clone, Copy, Default)]
pub struct Dop853;

impl Scheme for Dop853 {
    const KIND: &'static str = "dop853";
    const SUMMARY: &'static str =
        "explicit, order 8: few steps for small systems that are not stiff";
    const INTEGRATOR: Integrator = Integrator::Dop853;
    const HIGHEST: u8 = 8;
    const ORDER: usize = 7;
    const FALL: f64 = 0.9;

    fn suits(system: &System) -> Result<&'static str, String> {
        let is_plain = system.terms.is_empty() && system.algebraic() == 0;
        match system.len() {
            0..=MOST_EXPLICIT => Ok("the system is small"),
            ..=MOST_LINEAR if is_plain => Ok("the system is linear and has no balances"),
            more => Err(format!(
                "it is for at most {MOST_EXPLICIT} unknowns, or {MOST_LINEAR} of linear systems without balances, and \
                 there are {more}"
            )),
        }
    }
}
