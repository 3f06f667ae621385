//! Stiffness, guards and refusals.
