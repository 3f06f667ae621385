//! Laws that are not linear in a form.

use std::sync::Arc;

use dashpot_numerics::small::dot;

use super::Instance;
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
    /// Its place among the parts.
    pub(super) part: usize,
    /// Whether it depends on the rate.
    pub(super) has_rate: bool,
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

/// A face without mass that springs alone hold, in the system of one network: its speed \[m/s\] stands in a slot.
///
/// Their forces are in balance, so that its speed is the mean of those of their other ends, each weighed by the
/// stiffness of its spring.
#[derive(Debug, Clone)]
pub(super) struct Sprung<const N: usize> {
    pub(super) slot: usize,
    /// The sum of the constant stiffnesses \[N/m\].
    pub(super) stiffness: f64,
    /// Those speeds times these, over the unknowns and slots.
    pub(super) pull: [f64; N],
    /// The slot of each other law at the face, and the speed of its other end.
    pub(super) curves: Vec<(usize, [f64; N])>,
}

impl<const N: usize> Instance<N> {
    /// The unknowns, with what follows from them in the slots: the forces of the laws that are not linear, and the
    /// speed of a face that springs alone hold.
    #[inline]
    pub fn completed(&self, z: &[f64; N]) -> [f64; N] {
        let mut all = *z;
        for curve in &self.curves {
            let force = curve.law.force(dot(&curve.deformation, z), dot(&curve.rate, z));
            all[curve.slot] = force;
        }
        if let Some(own) = &self.sprung {
            all[own.slot] = own.speed(&self.curves, &all);
        }
        all
    }
}

impl<const N: usize> Sprung<N> {
    /// The speed of the face, where the forces of the laws stand in their slots.
    fn speed(&self, curves: &[CurveRow<N>], z: &[f64; N]) -> f64 {
        let (mut stiffness, mut pull) = (self.stiffness, dot(&self.pull, z));
        for (slot, speed) in &self.curves {
            let Some(curve) = curves.iter().find(|own| own.slot == *slot) else { continue };
            let own = curve.law.tangent(dot(&curve.deformation, z), 0.0).stiffness;
            stiffness += own;
            pull += own * dot(speed, z);
        }
        pull / stiffness
    }
}

impl Curve {
    /// The law of a primitive; `None` where it is not of the register, or its slope is infinite at rest.
    pub(super) fn of(primitive: &Primitive, part: usize) -> Option<Self> {
        let element = &primitive.element;
        let entry = registered(ELEMENTS, element.kind())?;
        let Law::Nonlinear { damping, .. } = primitive.law else { return None };
        if primitive.is_reflected() {
            return None;
        }
        Some(Self { entry, values: element.values(), part, has_rate: damping > 0.0 })
    }

    /// How many numbers it has.
    pub(super) fn numbers(&self) -> usize {
        self.values.iter().map(numbers_of).sum()
    }

    /// Reads the numbers of the same law in another network; `None` where it differs in more.
    pub(super) fn read(&self, primitive: &Primitive, numbers: &mut Vec<f64>) -> Option<()> {
        let values = primitive.element.values();
        if primitive.element.kind() != self.entry.word || values.len() != self.values.len() {
            return None;
        }
        for (own, value) in self.values.iter().zip(&values) {
            match (own, value) {
                (Value::Number(_), Value::Number(number)) => numbers.push(*number),
                (Value::Table(own), Value::Table(points)) if own.len() == points.len() => {
                    numbers.extend(points.iter().flat_map(|point| [point.0, point.1]));
                }
                (own, value) if own == value => {}
                _ => return None,
            }
        }
        Some(())
    }

    /// The law with these numbers; `None` where they are out of its range.
    pub(super) fn law(&self, numbers: &[f64]) -> Option<Arc<dyn Element>> {
        let mut numbers = numbers.iter();
        let mut values = self.values.clone();
        for value in &mut values {
            match value {
                Value::Number(number) => *number = *numbers.next()?,
                Value::Table(points) => {
                    for point in points {
                        *point = (*numbers.next()?, *numbers.next()?);
                    }
                }
                _ => {}
            }
        }
        (self.entry.make)(&values).ok().filter(|law| law.validate().is_ok())
    }
}

/// How many numbers a value has: the points of a curve are two each.
fn numbers_of(value: &Value) -> usize {
    match value {
        Value::Number(_) => 1,
        Value::Table(points) => 2 * points.len(),
        _ => 0,
    }
}
