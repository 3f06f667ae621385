//! What a run of a scene needs, and no more: for the many runs of a study.

use dashpot_analysis::{Accuracy, Limit, MeasureWish, RunError, SolveSettings};
use dashpot_network::Network;

use crate::{
    Scene,
    diagnostics::{Diagnostics, Faults},
    quantities::bare::BareNumbers,
    scene::{Parts, ReadOptions, asked, checked, load, read},
    sections::{RunSettings, read_run},
    text::library::Library,
};

/// What a run of a scene needs.
#[derive(Debug, Clone)]
pub struct Posed {
    /// Nodes, elements, loads and effects.
    pub network: Network,
    /// How it is to be run.
    pub run: RunSettings,
    accuracy: Accuracy,
    measures: Vec<MeasureWish>,
    limits: Vec<Limit>,
}

impl Posed {
    /// As [`Scene::settings`].
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownMethod`].
    pub fn settings(&self, method: &str) -> Result<SolveSettings, RunError> {
        asked(&self.run, &self.accuracy, (&self.measures, &self.limits), method)
    }

    /// Whether it is the same to a solver as another scene: in its network, its run, and what is asked of that. Named
    /// values, models and materials that nothing uses make no difference.
    pub fn is_solved_as(&self, other: &Self) -> bool {
        // What is printed of numbers tells them apart to the bit.
        format!("{self:?}") == format!("{other:?}")
    }
}

impl From<Scene> for Posed {
    fn from(scene: Scene) -> Self {
        let Scene { network, run, accuracy, measures, limits, .. } = scene;
        Self { network, run, accuracy, measures, limits }
    }
}

/// Reads what a run of a scene needs, and no more: the network need not compile, and nothing that is odd is looked
/// for. For the many runs of a sweep, of whose scene one was [read](read()).
///
/// # Errors
///
/// All faults of the text, each with its place.
pub fn pose(text: &str, options: &ReadOptions<'_>) -> Result<Posed, Diagnostics> {
    let posed = checked(BareNumbers::Silent, |faults| {
        let (library, _) = load(text, options, faults)?;
        Some(posed_in(&library, faults))
    })?;
    match posed.value {
        Some(posed) => Ok(posed),
        None => read(text, options).map(|scene| scene.value.into()),
    }
}

/// The same of documents; `None` where more of the scene has to be known.
pub(crate) fn posed_in(library: &Library, faults: &Faults) -> Option<Posed> {
    let Parts { reading, network, measures, limits, accuracy, .. } = Parts::read(library, faults);
    let (run, stops) = read_run(&reading);
    // Both are found in the compiled network.
    let needs_more = run.at_most.is_some() || !stops.is_empty();
    (!needs_more).then_some(Posed { network, run, accuracy, measures, limits })
}
