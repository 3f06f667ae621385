//! The register of studies.

use crate::{Study, compare, cost, rheometer, signal, vibrate};

/// All studies, in the order in which help texts name them. **A new one is registered here.**
pub const STUDIES: &[&dyn Study] = &[
    &compare::Compare,
    &rheometer::Rheometer,
    &vibrate::Vibrate,
    &cost::Cost,
    &signal::ReadSignals,
];
