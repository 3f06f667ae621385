//! What scatter of the scene's numbers makes of cushion curves, in words.

use dashpot_analysis::{Band, ScatterSource};
use dashpot_design::cushion::{Sure, Thinnest};
use dashpot_scene::Scene;
use dashpot_units::percent;

use super::{
    CushionArguments,
    asked::Wanted,
    words::{in_g, no_less},
};
use crate::{
    error::CliError,
    input::Input,
    output::list,
    verbs::run::{Line, scatter},
};

/// Digits of a share, and of the ends of a band.
const FEW: usize = 3;
const DIGITS: usize = 4;

/// What was drawn of a scene.
pub(super) struct Batches {
    pub(super) sources: Vec<ScatterSource>,
    /// How many designs, and what they were drawn with.
    pub(super) designs: usize,
    pub(super) seed: u64,
}

impl Batches {
    /// `None` where no number of the scene has scatter that does anything.
    pub(super) fn of(
        (arguments, wanted): (&CushionArguments, &Wanted),
        scene: &Scene,
        input: &Input,
    ) -> Result<Option<Self>, CliError> {
        if scene.scatter.is_empty() {
            return Ok(None);
        }
        let drawn = wanted.drawn(wanted.platen.thickness, (scene, input), arguments)?;
        Ok(drawn.map(|own| Self {
            sources: list(own.sample.drawn().iter().map(scatter::source)),
            designs: own.sample.len(),
            seed: arguments.seed,
        }))
    }

    /// What was drawn, and where it is cut off.
    pub(super) fn lines(&self) -> Vec<Line> {
        let first = format!(
            "{}; {} for each drop, without error bars of their own; bands hold 95 % of them",
            scatter::sources(&self.sources),
            scatter::designs(self.designs, self.seed)
        );
        let cut = self.sources.iter().filter_map(scatter::cut_text);
        list([first].into_iter().chain(cut).map(|text| Line { label: "scatter", text }))
    }
}

/// How sure it is that a thinnest cushion keeps its limit.
pub(super) fn sure(own: &Thinnest, limit: &str) -> Option<(&'static str, String)> {
    let Sure { odds, share, thickness } = own.sure?;
    let wanted = percent(share, FEW);
    let enough = match thickness {
        Some(thickness) => format!("{} keep it with {wanted}", no_less(thickness)),
        None => format!("no thickness that was asked for keeps it with {wanted}"),
    };
    let text = format!(
        "they keep {limit} with a probability of {}; {enough}",
        scatter::probability(&odds)
    );
    Some(("sure", text))
}

/// Between which peaks 95 % of the designs lie, in g; blank where any of them is not known.
pub(super) fn range(own: Option<&Band>) -> Option<String> {
    let (low, high) = ends(own?)?;
    Some(format!("{}–{}", in_g().number(low, DIGITS), in_g().number(high, DIGITS)))
}

/// The ends of a band, where all designs are known.
pub(super) fn ends(own: &Band) -> Option<(f64, f64)> {
    own.low.zip(own.high).filter(|_| own.without == 0)
}
