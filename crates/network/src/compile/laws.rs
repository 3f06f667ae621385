//! Laws of elements that are not linear, as they stand in the equations.
//!
//! They are the documented ones, with two exceptions for places where an equation would have no solution in
//! numbers. Both are told by the size of the motion, not by the references in which a law is written.
//!
//! * A massless node has no rate where all laws at it are flat over the rate. What may be flat and is needed to
//!   tell a rate gets a dashpot beside it, of [`LEAST`] of the slope that it has in the motion at hand. A law of
//!   the rate alone has that slope only where its own is smaller, and is untouched beyond.
//! * A law that is steep at rest, such as √ẏ, is a straight line up to [`LEAST`] of the rate of the motion at hand.

use std::{collections::BTreeMap, sync::Arc};

use dashpot_dae::Characteristic;

use super::{
    bodies::{Bodies, Groups},
    expand::{Expansion, Primitive},
    size::first,
};
use crate::elements::{Element, Law, Tangent};

/// The least slope over the rate, in parts of that in the motion at hand.
const LEAST: f64 = 1e-8;

/// The dashpots \[N s/m\] that primitives get so that massless nodes find their rates.
pub(super) fn least_dashpots(expansion: &Expansion, bodies: &Bodies) -> BTreeMap<usize, f64> {
    let all = || expansion.primitives.iter().enumerate();
    let ends = |primitive: &Primitive| primitive.ends.map(|joint| bodies.of_joint[joint]);
    let least = |primitive: &Primitive| LEAST * primitive.slopes()[1];
    let flat = || all().filter(|own| own.1.may_be_flat());
    let largest = flat().map(|own| least(own.1)).fold(0.0, f64::max);
    if largest == 0.0 {
        return BTreeMap::new();
    }
    // Bodies whose rates follow without those laws are one group, and so are those that move alike.
    let mut groups = Groups::new(bodies.all.len());
    let mut moved = (0..bodies.all.len()).filter(|&body| !bodies.all[body].is_massless());
    if let Some(first) = moved.next() {
        moved.for_each(|body| {
            groups.join(first, body);
        });
    }
    for (_, own) in all().filter(|own| !own.1.may_be_flat() && own.1.slopes()[1] >= largest) {
        let [a, b] = ends(own);
        groups.join(a, b);
    }
    let mut is_needed = |primitive: &Primitive| {
        let [a, b] = ends(primitive);
        groups.of(a) != groups.of(b)
    };
    flat().filter(|own| is_needed(own.1)).map(|(at, own)| (at, least(own))).collect()
}

/// The law of a primitive in the equation of its force; `least` is its part of [`least_dashpots`].
pub(super) fn law_of(primitive: &Primitive, least: f64) -> Arc<dyn Characteristic> {
    let element = Arc::clone(&primitive.element);
    match primitive.law {
        Law::Nonlinear { damping, .. } if primitive.is_reflected() => {
            let line = Line::of(element.as_ref(), damping, least);
            Arc::new(Reflected { element, damping, line })
        }
        _ => Arc::new(OfElement { element, least }),
    }
}

/// The force of an element over deformation and rate.
#[derive(Debug)]
struct OfElement {
    element: Arc<dyn Element>,
    least: f64,
}

impl Characteristic for OfElement {
    fn value(&self, [deformation, rate]: [f64; 2]) -> f64 {
        self.element.force(deformation, rate) + self.least * rate
    }

    fn slopes(&self, [deformation, rate]: [f64; 2]) -> [f64; 2] {
        let Tangent { stiffness, damping } = self.element.tangent(deformation, rate);
        [stiffness, damping + self.least]
    }
}

/// What is left of the force of an element, over the sum of the force and that of the dashpot that stands for it.
#[derive(Debug)]
struct Reflected {
    element: Arc<dyn Element>,
    damping: f64,
    line: Line,
}

/// The straight line that stands for a reflected law near rest.
#[derive(Debug, Clone, Copy, Default)]
struct Line {
    /// Up to this size of the sum \[N\].
    up_to: f64,
    slope: f64,
}

impl Line {
    fn of(element: &dyn Element, damping: f64, least: f64) -> Self {
        let secant = |rate: f64| element.force(0.0, rate) / rate;
        let is_steep = element.reflected(0.0, damping).is_some_and(|own| own[1] > 0.0);
        let end = if is_steep {
            LEAST * first(|rate| secant(rate) < damping)
        } else if least > 0.0 {
            first(|rate| secant(rate) > least)
        } else {
            0.0
        };
        if !end.is_normal() {
            return Self::default();
        }
        let own = secant(end) / damping;
        Self { up_to: (own + 1.0) * (damping * end), slope: (own - 1.0) / (own + 1.0) }
    }
}

impl Reflected {
    fn at(&self, sum: f64) -> [f64; 2] {
        if sum.abs() < self.line.up_to {
            return [self.line.slope * sum, self.line.slope];
        }
        self.element.reflected(sum, self.damping).unwrap_or_default()
    }
}

impl Characteristic for Reflected {
    fn value(&self, [sum, _]: [f64; 2]) -> f64 {
        self.at(sum)[0]
    }

    fn slopes(&self, [sum, _]: [f64; 2]) -> [f64; 2] {
        [self.at(sum)[1], 0.0]
    }
}
