//! Guards: conditions on outputs that are watched during a run.
//!
//! One layer serves every method: it looks for crossings on the polynomials of the outputs, so that
//! none is missed for lying between steps, and two in one step are two events. A [`Watch`] follows a
//! run that comes step by step; [`scan`] looks at one that is there as a whole.
//!
//! A value that cannot be told from the level is neither above nor below it. With the exact method
//! that is a matter of rounding; a method with a tolerance `rtol` does not tell apart what is closer
//! than `rtol` times the largest terms of the output so far, so that its error makes no events of an
//! output that decays to its level, or of two bodies that move together.
//!
//! What counts as a crossing is told by [`Signal::crossings`](crate::Signal::crossings): a guard
//! that starts on its level, up to rounding, is armed by the way in which its output leaves the
//! level, and does not fire there; an output that touches the level, or ends on it, does not cross
//! it; a jump across it does.

mod watch;

pub use watch::{Stop, Watch, scan};

/// Which crossings of the level count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// From below to above.
    Rising,
    /// From above to below.
    Falling,
    /// Both.
    Either,
}

/// A condition: an output crosses a level in a direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Guard {
    /// What it stands for, for the report.
    pub name: String,
    /// Index into [`System::outputs`](crate::System::outputs).
    pub output: usize,
    /// The level, in the output's SI unit.
    pub level: f64,
    /// Which crossings count.
    pub direction: Direction,
    /// Whether the run ends at the first crossing.
    pub stops: bool,
    /// The side of the level on which the output begins, `true` above, where that is known although
    /// the value may be on the level. `None` lets the guard be armed by the way in which its output
    /// leaves the level.
    pub begins: Option<bool>,
    /// The output that it is the rate of, if it is one. A method with a tolerance knows such an output
    /// better than the balances tell that it follows from: what it amounts to in a step is a change of the
    /// other output, which is kept within the tolerance.
    pub rate_of: Option<usize>,
}

/// A crossing that was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// When \[s\].
    pub time: f64,
    /// Index into [`Run::guards`](crate::Run::guards).
    pub guard: usize,
    /// Whether the output rose through the level.
    pub rising: bool,
}
