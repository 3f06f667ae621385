//! What can be asked of a scene or a model, and what is answered: each [`Study`] is a folder with its request (plain values
//! that [`request!`] declares once for all faces), its result (numbers in SI units, which serialise to the object of
//! `--json`) and the report of it. The command turns words into requests, Python builds the same ones.
//!
//! Nothing here knows command lines, terminals or folders: files come through a [`Context`], which is also told of
//! progress and of what is odd about a text.
//!
//! # Examples
//!
//! ```
//! use dashpot_studies::{Context as _, vibrate::{VibrateRequest, vibrate}};
//!
//! let scene = ().input("reference")?.scene(&[], &mut ())?;
//! let mut request = VibrateRequest::default();
//! request.drive = Some("ground".to_owned());
//! let vibrated = vibrate(&scene, &request, &mut ())?;
//! assert_eq!(vibrated.sweep.transmissions.len(), 2);
//! # Ok::<(), dashpot_studies::StudyError>(())
//! ```

mod amount;
mod answer;
pub mod compare;
mod context;
pub mod cost;
mod error;
pub mod measure_units;
pub mod measured;
mod method;
pub mod non_identifiable;
mod object;
pub mod operand;
pub mod origin;
mod register;
mod request;
pub mod rheometer;
pub mod signal;
pub mod sketch;
mod study;
pub mod vibrate;

pub use amount::{Amount, Assignment, Frequency, Mass, Speed, Time, argument, assignment, setting};
pub use answer::{Answer, Cell, DataTable, Outcome, csv};
pub use context::{Context, Input, Progress, Remark, title};
pub use error::{NO_LIMITS_HELP, StudyError, is_unit, unquoted_help};
pub use method::{Budget, MethodName, Repeats};
pub use object::{Pairs, alike, each_once, list};
pub use register::STUDIES;
pub use request::{Given, Kind, OptionInfo, OptionValue, Request, Single, Whole};
pub use study::{BUILT_IN, Operands, Study};

/// Version of the program; also the mark of files that it wrote.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
