//! The solution behind a report, where measures did without it.

use std::{
    fmt::{self, Debug, Formatter},
    ops::Deref,
    sync::OnceLock,
};

use dashpot_dae::Trajectory;

/// The solution of a run over all of its time. It is there, or is made when it is first looked at: measures and
/// balances of plain impacts are known from fewer steps than curves take.
///
/// It behaves as the [`Trajectory`] that it is. Where it cannot be made, it keeps no output, as
/// [`Trajectory::keeps`] says.
pub struct Curves(Kind);

/// What makes a trajectory.
type Maker = Box<dyn Fn() -> Trajectory + Send + Sync>;

enum Kind {
    Made(Box<Trajectory>),
    Later(Maker, OnceLock<Box<Trajectory>>),
}

impl Curves {
    /// Those that are made when they are looked at.
    pub(crate) fn later(maker: impl Fn() -> Trajectory + Send + Sync + 'static) -> Self {
        Self(Kind::Later(Box::new(maker), OnceLock::new()))
    }

    /// Whether nobody has looked at them yet, so that they are not made.
    pub(crate) fn are_to_come(&self) -> bool {
        matches!(&self.0, Kind::Later(_, own) if own.get().is_none())
    }

    /// The trajectory itself.
    pub fn into_trajectory(self) -> Trajectory {
        match self.0 {
            Kind::Made(own) => *own,
            Kind::Later(maker, own) => own.into_inner().map_or_else(maker, |own| *own),
        }
    }
}

impl From<Trajectory> for Curves {
    fn from(own: Trajectory) -> Self {
        Self(Kind::Made(Box::new(own)))
    }
}

impl Deref for Curves {
    type Target = Trajectory;

    fn deref(&self) -> &Trajectory {
        match &self.0 {
            Kind::Made(own) => own,
            Kind::Later(maker, own) => own.get_or_init(|| Box::new(maker())),
        }
    }
}

impl Debug for Curves {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Made(own) => own.fmt(f),
            Kind::Later(_, own) => own.fmt(f),
        }
    }
}
