//! Element whose force is a formula.

use dashpot_formula::{Expression, Program};

use super::{
    Element, Law, Tangent,
    by_numbers::{TYPICAL, central_differences, rises, secants, work_at_rest},
};
use crate::parameters::{
    Dimension, Given, InvalidParameter, Kind, Parameter, ParameterKind, Range, Value,
};

/// An element whose force is a formula `F(y, v)` \[N\] of the deformation `y` \[m\] and its rate `v` \[m/s\]:
/// `"2 kN * sinh(y / 8 mm) + 50 N s/m * v"`.
///
/// | symbol | field    | unit | range |
/// |--------|----------|------|-------|
/// | `F`    | `force`  | N    | formula of `y`, `v`, rising in both, zero at rest |
/// | `L`    | `up-to`  | m    | > 0   |
/// | `v_m`  | `rate`   | m/s  | > 0   |
///
/// The slopes over deformation and rate are the derivatives of the formula; the energy that it stores,
/// `∫ F(s, 0) ds`, is in closed form where that is known, else by quadrature. It dissipates
/// `(F(y, v) − F(y, 0)) v`. A formula that is linear in one of the two alone is the spring or dashpot that it is.
///
/// # Limits
///
/// Up to ±`L`, 30 mm where it is left out, and ±`v_m` the force is to have a value, to fall neither with the
/// deformation nor with the rate, and to be zero at rest; that is checked, and told by place where it is not so.
/// Where `up-to` is given, the law goes on as a straight line beyond it, and a run warns of it.
///
/// # References
///
/// None: the law is the user's.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::Formula, parameters};
///
/// let force = parameters::Formula::parse("2 kN * tanh(y / 5 mm)", &|name| name == "y")?;
/// let spring = Formula::new(force, None, None)?;
/// assert!((spring.force(0.005, 0.0) - 2e3 * 1_f64.tanh()).abs() < 1e-9);
/// assert!((spring.stored(0.005) - 10.0 * 1_f64.cosh().ln()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Formula {
    text: dashpot_formula::Formula,
    up_to: Option<f64>,
    rate: Option<f64>,
    force: Program,
    /// Its slopes over deformation and rate.
    tangent: Program,
    /// The integral of the force at rest over the deformation, where it is known.
    work: Option<Program>,
    linear: Option<Law>,
}

const FORCE: &str = "force";
/// What is looked at goes to three times of what is typical.
const PARTS: f64 = 3.0;
/// So many places at rest are looked at besides on each side.
const AT_REST: i32 = 200;

impl Formula {
    /// The element of this law; `up_to` is the deformation \[m\] up to which it holds, and `rate` the largest rate
    /// \[m/s\] at which it is looked at.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] where the formula is no force of `y` and `v`, or breaks one of the limits.
    pub fn new(
        formula: dashpot_formula::Formula,
        up_to: Option<f64>,
        rate: Option<f64>,
    ) -> Result<Self, InvalidParameter> {
        let invalid =
            |range: &'static str, found: String| InvalidParameter::new(FORCE, range, found);
        for (parameter, value) in [("up-to", up_to), ("rate", rate)] {
            value.map_or(Ok(()), |value| Range::Positive.check(parameter, value))?;
        }
        let variables = ParameterKind::LawFormula.variables();
        let force = formula.law(variables, Dimension::FORCE);
        let force = force
            .map_err(|error| invalid("a force of `y` and `v`", format!("`{formula}`: {error}")))?;
        let slopes = [0, 1].map(|variable| force.derivative(variable));
        let at_rest = force.with(1, 0.0);
        let own = Self {
            text: formula,
            up_to,
            rate,
            tangent: Program::of(&slopes),
            work: at_rest.integral(0).map(|work| Program::of([&work])),
            linear: linear(&force, &slopes),
            force: Program::of([&force]),
        };
        rises(&own, FORCE)?;
        own.rises_at_rest()?;
        if secants(&own).iter().all(|own| *own <= 0.0) {
            return Err(invalid("a law with a force", "none".to_owned()));
        }
        Ok(own)
    }

    /// Whether the slopes are finite and not negative at many places.
    fn rises_at_rest(&self) -> Result<(), InvalidParameter> {
        let deepest = PARTS * self.typical()[0];
        for part in -AT_REST..=AT_REST {
            let y = deepest * f64::from(part) / f64::from(AT_REST);
            let Tangent { stiffness, damping } = self.tangent(y, 0.0);
            let size = self.force(y, 0.0).abs().max(f64::MIN_POSITIVE) / deepest;
            if !(stiffness.is_finite() && damping.is_finite()) || stiffness < -1e-9 * size {
                let found =
                    format!("a slope of {stiffness:.6} N/m and {damping:.6} N s/m at {y:.6} m");
                return Err(InvalidParameter::new(FORCE, "a law that falls nowhere", found));
            }
        }
        Ok(())
    }

    /// The deformation at which the formula is taken, and how far this one is beyond \[m\].
    fn place(&self, deformation: f64) -> (f64, f64) {
        match self.up_to {
            Some(most) if deformation.abs() > most => {
                let at = most.copysign(deformation);
                (at, deformation - at)
            }
            _ => (deformation, 0.0),
        }
    }

    fn slopes(&self, deformation: f64, rate: f64) -> [f64; 2] {
        let mut slopes = [0.0; 2];
        self.tangent.evaluate(&[deformation, rate], &mut slopes);
        slopes
    }
}

/// The law as that of a spring or dashpot, where it is linear in one variable alone.
fn linear(force: &Expression, slopes: &[Expression; 2]) -> Option<Law> {
    let constant = |at: usize| {
        let line = force.polynomial(at)?;
        if let [0.0, _] = line[..] { slopes[at].constant().filter(|own| *own > 0.0) } else { None }
    };
    constant(0).map(Law::Spring).or_else(|| constant(1).map(Law::Dashpot))
}

impl Element for Formula {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        let (at, beyond) = self.place(deformation);
        let force = self.force.value(&[at, rate]);
        if beyond == 0.0 { force } else { force + self.slopes(at, 0.0)[0] * beyond }
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let (at, beyond) = self.place(deformation);
        let [stiffness, damping] = self.slopes(at, rate);
        // A root of what is zero has no slope, though what it is multiplied by may give the product one.
        if !(stiffness.is_finite() && damping.is_finite()) {
            return central_differences(self, deformation, rate);
        }
        let stiffness = if beyond == 0.0 { stiffness } else { self.slopes(at, 0.0)[0] };
        Tangent { stiffness, damping }
    }

    fn stored(&self, deformation: f64) -> f64 {
        let (at, beyond) = self.place(deformation);
        let inner = match &self.work {
            Some(work) => work.value(&[at, 0.0]) - work.value(&[0.0, 0.0]),
            None => return work_at_rest(self, deformation),
        };
        if beyond == 0.0 {
            return inner;
        }
        let slope = self.slopes(at, 0.0)[0];
        inner + (self.force.value(&[at, 0.0]) + 0.5 * slope * beyond) * beyond
    }

    fn law(&self) -> Law {
        self.linear.unwrap_or_else(|| {
            let [stiffness, damping] = secants(self);
            Law::Nonlinear { stiffness, damping }
        })
    }

    fn typical(&self) -> [f64; 2] {
        let [deformation, rate] = TYPICAL;
        [
            self.up_to.map_or(deformation, |own| own / PARTS),
            self.rate.map_or(rate, |own| own / PARTS),
        ]
    }

    fn range(&self) -> Option<(f64, f64)> {
        self.up_to.map(|own| (-own, own))
    }
}

impl Kind for Formula {
    const KIND: &'static str = "formula";
    const SUMMARY: &'static str = "force as a formula of deformation and rate, F(y, v)";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::new(
            FORCE,
            ParameterKind::LawFormula,
            "force F [N] of the deformation y [m] and its rate v [m/s], zero at rest, rising in both",
        ),
        Parameter::new(
            "up-to",
            ParameterKind::Quantity(Dimension::LENGTH),
            "deformation up to which the law holds [m], positive; a straight line follows",
        )
        .follows("it holds everywhere, and is checked up to 30 mm")
        .range(Range::Positive),
        Parameter::new(
            "rate",
            ParameterKind::Quantity(Dimension::VELOCITY),
            "rate up to which the law is checked [m/s], positive",
        )
        .follows("3 m/s")
        .range(Range::Positive),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let mut given = Given::new(Self::PARAMETERS, values);
        Self::new(given.take()?, given.take()?, given.take()?)
    }

    fn fields(&self) -> Vec<Value> {
        let or_left_out = |own: Option<f64>| own.map_or(Value::LeftOut, Value::Number);
        vec![Value::Formula(self.text.clone()), or_left_out(self.up_to), or_left_out(self.rate)]
    }

    fn sample() -> Self {
        let text = "2 kN * sinh(y / 8 mm) + 50 N s/m * v";
        let formula = dashpot_formula::Formula::parse(text, &|name| ["y", "v"].contains(&name));
        let made = formula.map(|own| Self::new(own, Some(0.025), None));
        match made {
            Ok(Ok(sample)) => sample,
            _ => unreachable!("the sample is valid, as a test shows"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(text: &str, up_to: Option<f64>) -> Result<Formula, String> {
        let formula = dashpot_formula::Formula::parse(text, &|name| ["y", "v"].contains(&name));
        let formula = formula.map_err(|error| error.to_string())?;
        Formula::new(formula, up_to, None).map_err(|error| error.to_string())
    }

    #[test]
    fn what_is_linear_is_a_spring_or_a_dashpot() {
        assert_eq!(made("3 * 20 kN/m * y / 2", None).map(|own| own.law()), Ok(Law::Spring(3e4)));
        assert_eq!(made("50 N s/m * v", None).map(|own| own.law()), Ok(Law::Dashpot(50.0)));
        let both = made("20 kN/m * y + 50 N s/m * v", None).map(|own| own.law());
        assert!(matches!(both, Ok(Law::Nonlinear { .. })));
    }

    #[test]
    fn it_goes_on_straight_beyond_its_range() {
        let own = made("2 kN * tan(y / 20 mm)", Some(0.03)).expect("a law");
        let slope = 1e5 / 1.5_f64.cos().powi(2);
        let force = 2e3 * 1.5_f64.tan();
        assert!((own.force(0.04, 0.0) / (force + slope * 0.01) - 1.0).abs() < 1e-12);
        assert!((own.tangent(-0.04, 0.0).stiffness / slope - 1.0).abs() < 1e-12);
        let beyond = own.stored(-0.04) - own.stored(-0.03);
        assert!((beyond / ((force + 0.005 * slope) * 0.01) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn laws_that_fall_have_poles_or_push_at_rest_are_refused() {
        let cases = [
            ("2 kN * sin(y / 5 mm)", "falls nowhere"),
            ("2 kN * y / (20 mm - y)", "falls nowhere"),
            ("2 kN * tan(y / 15 mm)", "falls nowhere"),
            ("2 kN + 1 kN/m * y", "without a force at rest"),
            ("2 kN * sqrt(y / 1 mm)", "with a force everywhere"),
            ("-2 kN/m * y", "falls nowhere"),
            ("2 kN/m * v", "a force of `y` and `v`"),
            ("0 * y * 1 N/m", "a law with a force"),
            // Damped as Tsuji has it, a contact pulls on its way out.
            ("2 MN * (max(0, y) / 1 m)^1.5 + 3 kN s/m * (max(0, y) / 1 m)^0.25 * v", "`max(0, …)`"),
        ];
        for (text, reason) in cases {
            let error = made(text, None).expect_err(text);
            assert!(error.contains(reason), "{text}: {error}");
        }
        assert!(made("2 kN * y / (20 mm - y)", Some(0.015)).is_ok());
        let pushes = "max(0, 2 MN * (max(0, y) / 1 m)^1.5 + 3 kN s/m * (max(0, y) / 1 m)^0.25 * v)";
        assert!(made(pushes, Some(0.04)).is_ok());
    }
}
