//! The effects of a scene: on, off or dropped, what each adds, and how much it matters.

use std::sync::Arc;

use dashpot_analysis::{
    RunError,
    contribution::{Contribution, Contributor, EffectState, SystemSize, contributions},
};
use dashpot_dae::Silent;
use dashpot_network::Detail;
use dashpot_plot::Table;
use dashpot_scene::{Scene, write_effect};

use super::{MOST, more};
use crate::{numbers::estimate, output::Text};

/// What the columns mean.
const MEANING: &str = "What each adds, or would add with its defaults: unknowns, modes as a \
                       factor, and entries of the matrices and guards at the start, where it \
                       may change which phases hold; `2 fewer` says that it removes two. \
                       `number` measures how much it matters: little where it is far below 1.";

/// What each effect of a scene contributes.
pub(super) fn found(scene: &Scene) -> Result<Vec<Contribution>, RunError> {
    let settings = scene.settings(scene.run.methods.first().map_or("auto", String::as_str))?;
    let assembly = Arc::new(scene.assembly.clone());
    Ok(contributions(&scene.network, &assembly, &settings, MOST, &mut Silent))
}

/// The section with all effects.
pub(super) fn section(text: &mut Text, rows: &[Contribution]) {
    let shown = &rows[..rows.len().min(MOST)];
    text.table(&counts(shown));
    more(text, rows.len());
    text.blank();
    for row in shown {
        let number = row
            .influence
            .as_ref()
            .map(|influence| format!("; {}", estimate(&influence.formula, influence.value)));
        let words = format!("{}{}", words(row), number.unwrap_or_default());
        text.labelled(&row.name, LABELS, &words);
    }
    text.blank();
    text.paragraphs([MEANING]);
}

/// Columns of the effects' names.
const LABELS: usize = 20;

fn words(row: &Contribution) -> String {
    match &row.contributor {
        Contributor::Effect(effect) => write_effect(effect.as_ref()),
        Contributor::Kind(summary) => (*summary).to_owned(),
        Contributor::Other(Detail::Inertia(_)) => {
            "the layers have mass: waves travel in them".to_owned()
        }
        Contributor::Other(_) => "what is struck rests on a support that gives".to_owned(),
    }
}

fn counts(rows: &[Contribution]) -> Table {
    let header = ["effect", "state", "unknowns", "modes", "entries", "guards", "number"];
    let row = |contribution: &Contribution| {
        let adds = |of: fn(&SystemSize) -> usize| match &contribution.sizes {
            Some([with, without]) => change(of(with), of(without)),
            None => "–".to_owned(),
        };
        let modes = match &contribution.sizes {
            Some([with, without]) if with.modes > without.modes && without.modes > 0 => {
                format!("×{}", with.modes / without.modes)
            }
            _ => "–".to_owned(),
        };
        let state = match contribution.state {
            EffectState::On => "on",
            EffectState::Off => "off",
            EffectState::LeftOut => "dropped",
            EffectState::PutBack => "put back",
        };
        let number = contribution.influence.as_ref().map(|influence| number(influence.value));
        vec![
            contribution.name.clone(),
            state.to_owned(),
            adds(|size| size.unknowns),
            modes,
            adds(|size| size.entries),
            adds(|size| size.guards),
            number.unwrap_or_else(|| "–".to_owned()),
        ]
    };
    Table::new("Effects", &header, rows.iter().map(row))
}

fn number(value: f64) -> String {
    if value > 0.0 { crate::numbers::significant(value, 2) } else { "0".to_owned() }
}

fn change(with: usize, without: usize) -> String {
    if with >= without { (with - without).to_string() } else { format!("{} fewer", without - with) }
}
