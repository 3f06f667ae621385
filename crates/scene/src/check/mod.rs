//! What is odd or wrong about a scene as a whole.

pub(crate) mod constant_area;
pub(crate) mod elastic;
pub(crate) mod network_faults;
pub(crate) mod review;
