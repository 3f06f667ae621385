//! Clip of 3 ms.

use std::sync::Arc;

use dashpot_network::parameters::{InvalidParameter, Parameter, Value, WindowWish};

use super::{
    Clip, Family, Measure, MeasureKind, Needs, Reading, WINDOW,
    clip::{COUNTED, counted},
    window,
};
use crate::{Solution, exceedance::Counted, similarity::Scale};

/// The largest acceleration that is reached or exceeded for 3 ms \[m/s²\]; otherwise as [`Clip`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clip3ms {
    /// Which times count.
    pub counted: Counted,
    /// The part of the run that it looks at.
    pub window: WindowWish,
}

impl Default for Clip3ms {
    fn default() -> Self {
        Self { counted: Counted::Together, window: WindowWish::Impact }
    }
}

impl Clip3ms {
    fn clip(self) -> Clip {
        Clip { duration: 0.003, counted: self.counted, window: self.window }
    }
}

impl MeasureKind for Clip3ms {
    const KIND: &'static str = "clip-3ms";
    const SUMMARY: &'static str = "largest acceleration that is exceeded for 3 ms [m/s^2]";
    const UNIT: &'static str = "m/s^2";
    const PARAMETERS: &'static [Parameter] = &[COUNTED, WINDOW];
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Ok(Self { counted: counted(values, 0)?, window: window(values, 1)? })
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Word(self.counted.word().to_owned()), Value::Window(self.window)]
    }

    fn of_similar(&self, scale: &Scale) -> Option<Arc<dyn Measure>> {
        MeasureKind::of_similar(&self.clip(), scale)
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(&self.clip(), solution, target)
    }
}
