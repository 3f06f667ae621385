//! The effects of a scene, on and off: how much each matters, and what it costs.

use dashpot_analysis::{
    RunError,
    contribution::{Contribution, Contributor, EffectState, SystemSize, contributions},
};
use dashpot_dae::Silent;
use dashpot_network::Detail;
use dashpot_report::Table;
use dashpot_scene::{Scene, write_effect};

use super::MOST;
use crate::output::Text;
use dashpot_report::numbers::{estimate, estimated};

const MATTERS: &str =
    "The number measures how much it matters, on or off: little where it is far below 1.";
const MEANING: &str = "What each adds, or would add with its defaults: unknowns, modes as a \
                       factor, and entries of the matrices and guards at the start, where it \
                       may change which phases hold; `2 fewer` says that it removes two.";
/// Columns of the effects' names.
const LABELS: usize = 20;

/// What each effect of a scene contributes.
pub(super) fn contributed(scene: &Scene) -> Result<Vec<Contribution>, RunError> {
    let settings = scene.settings(scene.run.methods.first().map_or("auto", String::as_str))?;
    Ok(contributions(&scene.network, &scene.assembly, &settings, MOST, &mut Silent))
}

/// The effects as a table; with what each adds and how it is written where it `is_verbose`.
pub(super) fn section(text: &mut Text, rows: &[Contribution], is_verbose: bool) {
    let shown = &rows[..rows.len().min(MOST)];
    text.table(&if is_verbose { counts(shown) } else { numbers(shown) });
    if rows.len() > MOST {
        text.line(&format!("  and {} more", rows.len() - MOST));
    }
    text.blank();
    if is_verbose {
        for row in shown {
            let number = number(row).map(|number| format!("; {number}"));
            let words = format!("{}{}", description(row), number.unwrap_or_default());
            text.labelled(&row.name, LABELS, &words);
        }
        text.blank();
        text.paragraphs([MEANING]);
    }
    text.paragraphs([MATTERS]);
}

fn number(row: &Contribution) -> Option<String> {
    row.influence.as_ref().map(|influence| estimate(&influence.formula, influence.value))
}

fn description(row: &Contribution) -> String {
    match &row.contributor {
        Contributor::Effect(effect) => write_effect(effect.as_ref()),
        Contributor::Kind(summary) => (*summary).to_owned(),
        Contributor::Other(Detail::Inertia(_)) => {
            "the layers have mass: waves travel in them".to_owned()
        }
        Contributor::Other(_) => "what is struck rests on a support that gives".to_owned(),
    }
}

fn state(row: &Contribution) -> String {
    match row.state {
        EffectState::On => "on",
        EffectState::Off => "off",
        EffectState::LeftOut => "dropped",
        EffectState::PutBack => "put back",
    }
    .to_owned()
}

fn numbers(rows: &[Contribution]) -> Table {
    let row = |own: &Contribution| {
        vec![own.name.clone(), state(own), number(own).unwrap_or_else(|| "–".to_owned())]
    };
    Table::new("Effects", &["effect", "state", "number"], rows.iter().map(row))
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
        let number = contribution.influence.as_ref().map(|influence| estimated(influence.value));
        vec![
            contribution.name.clone(),
            state(contribution),
            adds(|size| size.unknowns),
            modes,
            adds(|size| size.entries),
            adds(|size| size.guards),
            number.unwrap_or_else(|| "–".to_owned()),
        ]
    };
    Table::new("Effects", &header, rows.iter().map(row))
}

fn change(with: usize, without: usize) -> String {
    if with >= without { (with - without).to_string() } else { format!("{} fewer", without - with) }
}
