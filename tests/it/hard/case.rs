//! A case: what is solved, and what must come out.

use std::fmt;

use dashpot::{
    analysis::SolveSettings,
    network::Network,
    scene::{ReadOptions, read},
};

use super::trial::Trial;

/// Steps of all solutions of a run together after which it is given up.
const MOST_STEPS: usize = 60_000;

/// Builds a network and what is asked of it.
type Build = Box<dyn Fn() -> (Network, SolveSettings) + Send + Sync>;
/// What must hold of a solution.
type Claims = Box<dyn Fn(&Trial<'_>) + Send + Sync>;

/// A hard case.
pub(super) struct Case {
    /// What it is, unique.
    pub(super) name: String,
    /// How it is judged.
    pub(super) judge: &'static str,
    /// Steps after which a run is given up.
    pub(super) most_steps: usize,
    pub(super) claims: Claims,
    setup: Setup,
}

/// What is solved.
enum Setup {
    Text(String),
    Built(Build),
}

impl fmt::Debug for Case {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Case").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Case {
    /// A case that is a scene.
    pub(super) fn new(
        name: impl Into<String>,
        judge: &'static str,
        text: impl Into<String>,
        claims: impl Fn(&Trial<'_>) + Send + Sync + 'static,
    ) -> Self {
        Self::of(name.into(), judge, Setup::Text(text.into()), Box::new(claims))
    }

    /// A case that is built, not read.
    pub(super) fn built(
        name: impl Into<String>,
        judge: &'static str,
        build: impl Fn() -> (Network, SolveSettings) + Send + Sync + 'static,
        claims: impl Fn(&Trial<'_>) + Send + Sync + 'static,
    ) -> Self {
        Self::of(name.into(), judge, Setup::Built(Box::new(build)), Box::new(claims))
    }

    fn of(name: String, judge: &'static str, setup: Setup, claims: Claims) -> Self {
        Self { name, judge, most_steps: MOST_STEPS, claims, setup }
    }

    /// The same case with another number of steps after which a run is given up.
    pub(super) fn steps(self, most_steps: usize) -> Self {
        Self { most_steps, ..self }
    }

    /// Its text, if it is a scene.
    pub(super) fn text(&self) -> Option<&str> {
        match &self.setup {
            Setup::Text(text) => Some(text),
            Setup::Built(_) => None,
        }
    }

    /// The network and what is asked of it, or why the scene is refused.
    pub(super) fn network(&self, method: &str) -> Result<(Network, SolveSettings), String> {
        match &self.setup {
            Setup::Text(text) => match read(text, &ReadOptions::default()) {
                Ok(scene) => {
                    let settings = scene.value.settings(method).unwrap();
                    Ok((scene.value.network, settings))
                }
                Err(faults) => Err(faults.to_string()),
            },
            Setup::Built(build) => {
                let (network, settings) = build();
                Ok((network, settings.by_name(method).unwrap()))
            }
        }
    }
}
