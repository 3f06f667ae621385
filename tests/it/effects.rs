//! Effects on demand: right where they are on, and nothing where they are off.
//!
//! Each case of `effects_reference.csv` is written as a scene, solved through the public interface by
//! the exact method, where it is linear between switchings, and by stepping methods, and held against
//! the 20 digits of the table.

mod balance;
mod bouncing;
mod claims;
mod corners;
mod faces;
mod foam_cycles;
mod friction;
mod layers;
mod materials;
mod near;
mod neutral;
mod nonlinear;
mod off;
mod off_counts;
mod reference;
mod run_end;
mod separation;
mod short_drops;
mod sliders;
mod stops;
mod sweeps;
mod trial;
mod two_curves;
mod waves;
