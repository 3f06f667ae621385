//! Head injury criterion over at most 15 and 36 ms.

use std::sync::Arc;

use dashpot_network::parameters::{InvalidParameter, Value, WindowWish};

use super::{Family, Hic, Measure, MeasureKind, Needs, Reading, window};
use crate::{Solution, similarity::Scale};

/// The head injury criterion over intervals of at most 15 or 36 ms \[s\]; otherwise as [`Hic`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HicWithin<const MILLISECONDS: u32> {
    /// The part of the run in which the interval lies.
    pub window: WindowWish,
}

/// The head injury criterion over intervals of at most 15 ms \[s\].
pub type Hic15 = HicWithin<15>;

/// The head injury criterion over intervals of at most 36 ms \[s\].
pub type Hic36 = HicWithin<36>;

impl<const MILLISECONDS: u32> Default for HicWithin<MILLISECONDS> {
    fn default() -> Self {
        Self { window: WindowWish::Impact }
    }
}

impl<const MILLISECONDS: u32> HicWithin<MILLISECONDS> {
    /// Its words, and what it is.
    const TEXTS: (&'static str, &'static str) = match MILLISECONDS {
        15 => ("hic15", "head injury criterion over intervals up to 15 ms [s]"),
        36 => ("hic36", "head injury criterion over intervals up to 36 ms [s]"),
        _ => panic!("of 15 and 36 ms only"),
    };

    fn hic(self) -> Hic {
        Hic { cap: f64::from(MILLISECONDS) / 1e3, window: self.window }
    }
}

impl<const MILLISECONDS: u32> MeasureKind for HicWithin<MILLISECONDS> {
    const KIND: &'static str = Self::TEXTS.0;
    const SUMMARY: &'static str = Self::TEXTS.1;
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
