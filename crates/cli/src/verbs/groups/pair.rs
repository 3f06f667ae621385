//! Two scenes side by side.

use dashpot_analysis::similarity::{
    Alone, GroupPair, Measured, Similarity, SimilarityError, alone, measured, similar_settings,
};
use dashpot_network::Network;
use dashpot_report::Table;
use dashpot_scene::Scene;
use serde::Serialize;

use super::{
    DIGITS, GroupsArguments, left_out,
    opposed::{self, factor_table, factors, is_one},
};
use crate::{
    error::CliError,
    output::{Text, list, object},
    terminal::Tone,
};
use dashpot_report::numbers::{apart, bound, significant};

/// So many groups are moved one at a time; more would take long and say little.
const MOST_ALONE: usize = 12;

pub(super) struct Pair {
    compared: [String; 2],
    pub(super) found: Similarity,
    /// The measures of the first, and those of the second at its scale.
    measures: Vec<Measured>,
    /// By how much each group that differs moves the measures of the first by itself.
    alone: Vec<Alone>,
    left_out: Vec<String>,
    /// Elements whose parts have thicknesses of their own in one of both only.
    other_pads: Vec<String>,
}

impl Pair {
    /// Two scenes, solved where they are built alike.
    pub(super) fn of(
        first: &Scene,
        second: &Scene,
        arguments: &GroupsArguments,
    ) -> Result<Self, CliError> {
        let found = Similarity::between(&first.network, &second.network, arguments.within);
        let found = found.map_err(SimilarityError::from)?;
        let settings = first.settings("auto")?;
        let (mut measures, mut movers) = (Vec::new(), Vec::new());
        if found.structure.is_empty() || found.differs_in_effects() {
            let [one, other] = &found.networks;
            measures = opposed::cleared(measured(one, other, &found.scale, &settings)?);
            if found.different().count() <= MOST_ALONE {
                movers = alone(one, &found, &settings)?;
                for mover in &mut movers {
                    mover.measures = opposed::cleared(std::mem::take(&mut mover.measures));
                }
            }
        }
        let compared = [&arguments.first, &arguments.second]
            .map(|own| own.as_ref().map_or(String::new(), |own| own.display().to_string()));
        let left_out = similar_settings(&settings, &found.scale).1;
        let other_pads = other_pads(&found.networks);
        Ok(Self { compared, measures, alone: movers, left_out, other_pads, found })
    }

    pub(super) fn object(&self) -> impl Serialize {
        let found = &self.found;
        object! {
            compared: &self.compared,
            similar: found.is_similar(),
            within: found.within,
            structure: &found.structure,
            groups: &found.groups,
            scale: factors(&found.scale),
            measures: opposed::objects(&self.measures),
            alone: list(self.alone.iter().map(|own| object! {
                parameter: &own.name, measures: opposed::objects(&own.measures),
            })),
            left_out: &self.left_out,
            other_pads: &self.other_pads,
        }
    }

    pub(super) fn text(&self, text: &mut Text) {
        let (found, [first, second]) = (&self.found, &self.compared);
        let is_similar = found.is_similar();
        let (verdict, tone) =
            if is_similar { ("Similar", Tone::Heading) } else { ("Not similar", Tone::Warning) };
        text.toned(tone, &format!("{verdict}: {first} and {second}"));
        if is_similar {
            let (all, within) = (found.groups.len(), bound(found.within));
            text.paragraphs([format!("All {all} groups are equal within {within}.")]);
        }
        text.paragraphs(&found.structure);
        if !is_similar {
            text.table(&self.different());
        }
        if found.structure.is_empty() && !is_one(&found.scale) {
            text.table(&factor_table("From the first to the second", &found.scale));
        }
        let caption = "Measures, those of the second at the scale of the first";
        text.table(&opposed::table(caption, ["first", "second"], &self.measures));
        text.table(&self.movers());
        left_out(text, &self.left_out);
        if !self.other_pads.is_empty() {
            let names = self.other_pads.join(", ");
            text.blank();
            text.paragraphs([format!(
                "Parts of {names} have thicknesses of their own in one of both only: there strains are \
                 those of the parts, here those of the whole."
            )]);
        }
    }

    fn different(&self) -> Table {
        let row = |group_pair: &GroupPair| {
            let [one, other] = group_pair.values.map(|value| significant(value, DIGITS));
            vec![group_pair.formula.clone(), one, other, apart(group_pair.apart)]
        };
        let header = ["group", "first", "second", "difference"];
        Table::new("Groups that differ", &header, self.found.different().map(row))
    }

    /// The measure that each group by itself moves the most.
    fn movers(&self) -> Table {
        let row = |own: &Alone| {
            let moved = own.measures.iter().filter(|measure| !measure.is_within_errors());
            let moved = moved.filter_map(|moved| Some((moved.apart?, moved)));
            let most = moved.max_by(|one, other| one.0.total_cmp(&other.0));
            let most = most.filter(|most| most.0 > 0.0);
            let text = most
                .map_or("nothing".to_owned(), |(by, own)| format!("{} by {}", own.key, apart(by)));
            vec![own.name.clone(), text]
        };
        let caption = "What each of them alone moves the most";
        Table::new(caption, &["group of", "measure"], self.alone.iter().map(row))
    }
}

/// The elements whose parts have thicknesses of their own in one of two scenes only.
fn other_pads([first, second]: &[Network; 2]) -> Vec<String> {
    let pairs = first.connections().iter().zip(second.connections());
    let differ = pairs.filter(|(one, other)| one.pads.len() != other.pads.len());
    differ.map(|differ| differ.0.name.clone()).collect()
}
