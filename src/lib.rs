//! Impacts on viscoelastic padding: spring–dashpot–mass networks composed, turned into
//! differential–algebraic systems, and solved by interchangeable methods.
//!
//! The path of the data is scene → [`network`] → [`dae`] system → trajectory → [`analysis`]
//! (measures) → [`plot`]. Every crate below is re-exported here under its own name.
//!
//! # Conventions
//!
//! SI units and `f64` throughout. One axis: displacements, velocities and forces on nodes are
//! positive from the impactor towards the support. An element between `a` and `b` has the
//! deformation `y = x_a − x_b`, positive in compression, and a force that is positive when it
//! pushes its ends apart.
//!
//! # A first impact
//!
//! A head of 10 kg at 10 m/s on a pad over a panel that is mounted on the ground; the pad is the
//! four-parameter model of the thesis, composed by `+` in series and `|` in parallel:
//!
//! ```
//! use dashpot::analysis::Solve;
//! use dashpot::network::{Network, Node, dashpot, spring};
//!
//! let mut network = Network::new();
//! let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
//! let panel = network.add_node(Node::mass("panel", 100.0));
//! let pad = spring(20e6) + dashpot(6e3) + (spring(20e6) | dashpot(4e3));
//! network.connect("padding", head, panel, pad).thickness = Some(0.02);
//! network.connect("mount", panel, network.ground(), spring(50e6) | dashpot(10e3));
//!
//! let report = network.solve(0.02)?;
//! assert!((report.value("padding.peak-force")? - 38_359.411_601).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use dashpot_analysis as analysis;
pub use dashpot_dae as dae;
pub use dashpot_design as design;
pub use dashpot_fit as fit;
pub use dashpot_network as network;
pub use dashpot_numerics as numerics;
pub use dashpot_plot as plot;
pub use dashpot_report as report;
pub use dashpot_rheology as rheology;
pub use dashpot_scene as scene;
pub use dashpot_signal as signal;
pub use dashpot_studies as studies;
pub use dashpot_thesis as thesis;
pub use dashpot_units as units;

/// The examples of the README, which are tested with the others.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The example of the chapter on the thesis.
#[cfg(doctest)]
#[doc = include_str!("../docs/thesis.md")]
struct ThesisChapter;
