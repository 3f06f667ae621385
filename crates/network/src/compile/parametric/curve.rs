//! Laws that are not linear in a form.

use std::{ops::Range, sync::Arc};

use dashpot_numerics::small::dot;

use super::{Instance, tape::Pattern};
use crate::{
    compile::expand::Primitive,
    elements::{ELEMENTS, Element, Law},
    parameters::{Registered, Value, registered},
};

/// A law of the deformation, and of the rate, whose kind is in the register.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    entry: &'static Registered<Arc<dyn Element>>,
    /// Its values at the first network; the numbers among them differ from network to network.
    values: Vec<Value>,
    /// Where its numbers stand among those of a network.
    pub(super) numbers: Range<usize>,
    /// Whether it depends on the rate.
    pub(super) has_rate: bool,
    /// Its deformation \[m\].
    pub(super) deformation: Pattern,
    /// Its rate \[m/s\].
    pub(super) rate: Pattern,
}

/// A law in the system of one network: its force \[N\] stands in a slot behind the unknowns.
#[derive(Debug, Clone)]
pub struct CurveRow<const N: usize> {
    /// The law.
    pub law: Arc<dyn Element>,
    /// The slot of its force.
    pub slot: usize,
    /// Its deformation \[m\] over the unknowns.
    pub deformation: [f64; N],
    /// Its rate \[m/s\] over the unknowns; zero where it does not depend on that.
    pub rate: [f64; N],
    /// The numbers that the law was made of.
    pub(super) numbers: Vec<f64>,
}

impl<const N: usize> Instance<N> {
    /// The unknowns, with the forces of the laws that are not linear in their slots, and the velocity of a face that was
    /// let go.
    #[inline]
    pub fn completed(&self, z: &[f64; N]) -> [f64; N] {
        let mut all = *z;
        for curve in &self.curves {
            let force = curve.law.force(dot(&curve.deformation, &all), dot(&curve.rate, &all));
            all[curve.slot] = force;
        }
        if let Some(own) = &self.parted {
            all[own.unknown] = own.velocity(&self.curves, &all);
        }
        all
    }
}

impl Curve {
    /// The law of a primitive over these rows; `None` where it is not of the register, or its slope is infinite at rest.
    pub(super) fn of(
        primitive: &Primitive,
        number: usize,
        [deformation, rate]: [Pattern; 2],
    ) -> Option<Self> {
        let entry = registered(ELEMENTS, primitive.element.kind())?;
        let Law::Nonlinear { damping, .. } = primitive.law else { return None };
        let mut values = primitive.element.values();
        let mut numbers = 0;
        each_number(&mut values, |_| numbers += 1);
        let numbers = number..number + numbers;
        let own = Self { entry, values, numbers, has_rate: damping > 0.0, deformation, rate };
        (!primitive.is_reflected()).then_some(own)
    }

    /// The law with these numbers; `None` where they are out of its range.
    pub(super) fn law(&self, numbers: &[f64]) -> Option<Arc<dyn Element>> {
        let (mut numbers, mut values) = (numbers.iter(), self.values.clone());
        each_number(&mut values, |own| *own = numbers.next().copied().unwrap_or(f64::NAN));
        (self.entry.make)(&values).ok().filter(|law| law.validate().is_ok())
    }
}

/// Does something with each number among the values of a law: the points of a curve are two each.
pub(super) fn each_number(values: &mut [Value], mut with: impl FnMut(&mut f64)) {
    for value in values {
        match value {
            Value::Number(number) => with(number),
            Value::Table(points) => points.iter_mut().for_each(|point| {
                with(&mut point.0);
                with(&mut point.1);
            }),
            _ => {}
        }
    }
}
