//! Head injury criterion over at most 15 ms.

use std::sync::Arc;

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, Hic, Measure, MeasureKind, Needs, Reading, window};
use crate::{Solution, similarity::Scale};

/// The head injury criterion over intervals of at most 15 ms \[s\]; otherwise as [`Hic`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hic15 {
    /// The part of the run in which the interval lies.
    pub window: WindowWish,
}

impl Default for Hic15 {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl Hic15 {
    fn hic(self) -> Hic {
        Hic { cap: 0.015, window: self.window }
    }
}

impl MeasureKind for Hic15 {
    const KIND: &'static str = "hic15";
    const SUMMARY: &'static str = "head injury criterion over intervals up to 15 ms [s]";
    const UNIT: &'static str = "s";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        window(values, 0).map(|window| Self { window })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Window(self.window)]
    }

    fn gravities(&self) -> f64 {
        2.5
    }

    fn of_similar(&self, scale: &Scale) -> Option<Arc<dyn Measure>> {
        MeasureKind::of_similar(&self.hic(), scale)
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(&self.hic(), solution, target)
    }
}
