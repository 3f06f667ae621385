//! The span of an impact: who strikes what, the impulses, and when it ends.

pub(crate) mod contacts;
pub(crate) mod face;
pub(crate) mod impulses;
pub(crate) mod interval;
pub(crate) mod sliders;
