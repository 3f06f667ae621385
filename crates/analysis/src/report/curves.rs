//! The solution behind a report, where measures did without it.

use std::{
    fmt::{self, Debug, Formatter},
    ops::Deref,
    sync::OnceLock,
};

use dashpot_dae::{Extremum, Trajectory};

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
    Later { maker: Maker, own: OnceLock<Box<Trajectory>>, struck: Option<Struck> },
}

/// What is known of a plain impact without its curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Struck {
    /// The element that is struck, by its number.
    pub(crate) element: usize,
    /// Its largest force \[N\], and when \[s\].
    pub(crate) strongest: Extremum,
    /// Its largest deformation \[m\], and when \[s\].
    pub(crate) deepest: Extremum,
    /// The speed \[m/s\] with which what has struck it leaves, positive towards it.
    pub(crate) leaves: f64,
}

impl Curves {
    /// Those that are made when they are looked at, and what is known until then.
    pub(crate) fn later(
        maker: impl Fn() -> Trajectory + Send + Sync + 'static,
        struck: Option<Struck>,
    ) -> Self {
        Self(Kind::Later { maker: Box::new(maker), own: OnceLock::new(), struck })
    }

    /// What is known without them, as long as nobody has looked at them, so that they are not made.
    pub(crate) fn to_come(&self) -> Option<&Struck> {
        match &self.0 {
            Kind::Later { own, struck, .. } if own.get().is_none() => struck.as_ref(),
            _ => None,
        }
    }

    /// The trajectory itself.
    pub fn into_trajectory(self) -> Trajectory {
        match self.0 {
            Kind::Made(own) => *own,
            Kind::Later { maker, own, .. } => own.into_inner().map_or_else(maker, |own| *own),
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
            Kind::Later { maker, own, .. } => own.get_or_init(|| Box::new(maker())),
        }
    }
}

impl Debug for Curves {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Made(own) => own.fmt(f),
            Kind::Later { own, .. } => own.fmt(f),
        }
    }
}
