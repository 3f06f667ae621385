//! The effects of a scene: on, off or dropped, what each adds, and how much it matters.

use std::sync::Arc;

use dashpot_analysis::{Partial, solve_partial};
use dashpot_dae::{Silent, switching::Switching};
use dashpot_network::{
    Assembly, Detail, Effect, Influence, Network, Situation,
    effects::{EffectKind, EffectVisitor, visit_effects},
};
use dashpot_plot::Table;
use dashpot_scene::{Scene, write_effect};

use super::{MOST, more};
use crate::{numbers::estimate, output::Text};

/// What the columns mean.
const MEANING: &str = "What each adds, or would add with its defaults: unknowns, modes as a \
                       factor, and entries of the matrices and guards at the start, where it \
                       may change which phases hold; `2 fewer` says that it removes two. \
                       `number` measures how much it matters: little where it is far below 1.";

/// What compiling a network gives, in numbers.
#[derive(Debug, Clone, Copy)]
struct Size {
    unknowns: usize,
    modes: usize,
    entries: usize,
    guards: usize,
}

/// One effect, or another detail.
struct Row {
    name: String,
    state: &'static str,
    /// With it and without it, where both can be compiled.
    sizes: Option<[Size; 2]>,
    influence: Option<Influence>,
    words: String,
}

/// The section with all effects.
pub(super) fn section(text: &mut Text, scene: &Scene) {
    let rows = rows(scene);
    let shown = &rows[..rows.len().min(MOST)];
    text.table(&counts(shown));
    more(text, rows.len());
    text.blank();
    for row in shown {
        let number =
            row.influence.as_ref().map(|own| format!("; {}", estimate(&own.formula, own.value)));
        let words = format!("{}{}", row.words, number.unwrap_or_default());
        text.labelled(&row.name, LABELS, &words);
    }
    text.blank();
    text.paragraphs([MEANING]);
}

/// Columns of the effects' names.
const LABELS: usize = 20;

fn counts(rows: &[Row]) -> Table {
    let header = ["effect", "state", "unknowns", "modes", "entries", "guards", "number"];
    let row = |own: &Row| {
        let adds = |of: fn(&Size) -> usize| match &own.sizes {
            Some([with, without]) => change(of(with), of(without)),
            None => "–".to_owned(),
        };
        let modes = match &own.sizes {
            Some([with, without]) if with.modes > without.modes && without.modes > 0 => {
                format!("×{}", with.modes / without.modes)
            }
            _ => "–".to_owned(),
        };
        let number = own.influence.as_ref().map(|own| number(own.value));
        vec![
            own.name.clone(),
            own.state.to_owned(),
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

fn size(assembly: &Assembly) -> Size {
    let own = |system: &dashpot_dae::System| system.jacobian.nnz() + system.input_matrix.nnz();
    let (modes, guards, entries) = match &assembly.switching {
        None => (1, 0, own(&assembly.system)),
        Some(phased) => {
            let parts = phased.parts().into_iter().map(|part| part.phases.len());
            let modes = parts.fold(1, usize::saturating_mul);
            let first = phased.first(0.0).ok();
            let guards = first.as_ref().map_or(0, |leg| leg.guards.len());
            let system = first.as_ref().map_or(&assembly.system, |leg| leg.system.as_ref());
            (modes, guards, own(system))
        }
    };
    Size { unknowns: assembly.system.len(), modes, entries, guards }
}

fn compiled(network: &Network, duration: f64) -> Option<Size> {
    network.compile(duration).ok().map(|assembly| size(&assembly))
}

/// All that is on, and all effects that are off, in the order of the register.
fn rows(scene: &Scene) -> Vec<Row> {
    let (network, duration) = (&scene.network, scene.run.duration);
    let situation = Situation::of(network, duration);
    let full = size(&scene.assembly);
    let partial = verified(scene);
    let details: Vec<(Detail, Option<Influence>)> = Detail::all(network)
        .into_iter()
        .map(|detail| (detail, Influence::largest(detail.influences(&situation))))
        .collect();
    let on = |(detail, influence): &(Detail, Option<Influence>), words: String| {
        let name = detail.name(network);
        let without = compiled(&network.without(&[*detail]), duration);
        Row {
            state: state(&name, partial.as_ref()),
            sizes: without.map(|without| [full, without]),
            influence: influence.clone(),
            name,
            words,
        }
    };
    let mut rows = Vec::new();
    for kind in kinds(&situation) {
        let is_own = |detail: &Detail| matches!(detail, Detail::Effect(at) if network.effects()[*at].kind() == kind.word);
        let own = details.iter().filter(|(detail, _)| is_own(detail)).take(MOST);
        for entry in own {
            if let Detail::Effect(at) = entry.0 {
                rows.push(on(entry, write_effect(network.effects()[at].as_ref())));
            }
        }
        if !details.iter().any(|(detail, _)| is_own(detail)) {
            rows.extend(off(&kind, network, &situation, full));
        }
    }
    let others = details
        .iter()
        .filter(|(detail, influence)| influence.is_some() && !matches!(detail, Detail::Effect(_)));
    rows.extend(others.take(MOST).map(|entry| {
        let words = match entry.0 {
            Detail::Inertia(_) => "the layers have mass: waves travel in them",
            _ => "what is struck rests on a support that gives",
        };
        on(entry, words.to_owned())
    }));
    rows
}

/// An effect that is off, with what it would add, or alone where it has no defaults.
fn off(kind: &Kind, network: &Network, situation: &Situation<'_>, full: Size) -> Vec<Row> {
    let would_be = kind.would_be.iter().take(MOST).map(|effect| {
        let mut with = network.clone();
        with.add_shared_effect(Arc::clone(effect));
        let target = effect.target().map(|own| format!(".{own}")).unwrap_or_default();
        Row {
            name: format!("{}{target}", kind.word),
            state: "off",
            sizes: compiled(&with, situation.duration).map(|with| [with, full]),
            influence: Influence::largest(effect.influences(situation)),
            words: kind.summary.to_owned(),
        }
    });
    let mut rows: Vec<Row> = would_be.collect();
    if rows.is_empty() {
        let (name, words) = (kind.word.to_owned(), kind.summary.to_owned());
        rows.push(Row { name, state: "off", sizes: None, influence: None, words });
    }
    rows
}

/// What is left out of a run of the scene, where that is allowed: it takes the run to tell.
fn verified(scene: &Scene) -> Option<Partial> {
    scene.accuracy.neglect_below?;
    let method = scene.run.methods.first().map_or("auto", String::as_str);
    let assembly = Arc::new(scene.assembly.clone());
    let report =
        solve_partial(&scene.network, &assembly, &scene.settings(method), &mut Silent).ok()?;
    report.partial
}

fn state(name: &str, partial: Option<&Partial>) -> &'static str {
    let Some(partial) = partial else { return "on" };
    if partial.left_out.iter().any(|own| own.effect == name) {
        "dropped"
    } else if partial.put_back.iter().any(|own| own.effect == name) {
        "put back"
    } else {
        "on"
    }
}

/// A kind of effects.
struct Kind {
    word: &'static str,
    summary: &'static str,
    would_be: Vec<Arc<dyn Effect>>,
}

fn kinds(situation: &Situation<'_>) -> Vec<Kind> {
    struct Collect<'s, 'n>(&'s Situation<'n>, Vec<Kind>);
    impl EffectVisitor for Collect<'_, '_> {
        fn visit<E: EffectKind>(&mut self) {
            let all = E::would_be(self.0).into_iter();
            let would_be = all.map(|own| Arc::new(own) as Arc<dyn Effect>).collect();
            self.1.push(Kind { word: E::KIND, summary: E::SUMMARY, would_be });
        }
    }
    let mut collect = Collect(situation, Vec::new());
    visit_effects(&mut collect);
    collect.1
}
