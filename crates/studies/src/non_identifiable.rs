//! What cannot be told apart from outside, in words.

use std::sync::Arc;

use dashpot_network::{Element, Model, elements::Law, primitive};
use dashpot_rheology::{
    Primitive,
    identifiability::{Entangled, entangled},
};
use dashpot_scene::Scene;

use dashpot_report::numbers::quantity;

/// Models of more parts than this are not looked at: it would take longer than to solve them.
const MOST_PARTS: usize = 300;
/// More parameters of one group are only counted.
const MOST_LISTED: usize = 8;
const DIGITS: usize = 6;

/// Groups of parameters of a model that cannot all be told apart from outside; none of one with a part that is not linear,
/// which may show at one force what it hides at another.
pub fn groups(model: &Model) -> Vec<Entangled> {
    let is_linear =
        |part: &Arc<dyn Element>| !matches!(part.law(), Law::Nonlinear { .. } | Law::Phased);
    if model.leaves().nth(MOST_PARTS).is_some() || !model.leaves().all(is_linear) {
        return Vec::new();
    }
    entangled(model, |element| primitive(element.as_ref()))
}

/// What can be told of a group instead.
pub fn combinations(group: &Entangled) -> Vec<String> {
    let constant = |(path, part): &(String, Primitive)| match part {
        Primitive::Spring(stiffness) => format!("{path} {}", quantity(*stiffness, "N/m", DIGITS)),
        Primitive::Dashpot(damping) => format!("{path} {}", quantity(*damping, "N s/m", DIGITS)),
        Primitive::Rigid => path.clone(),
    };
    group.combinations.iter().map(constant).collect()
}

/// A group as a sentence.
pub fn sentence(parameters: &[String], combinations: &[String]) -> String {
    let parameters = listed(parameters);
    if combinations.is_empty() {
        format!("{parameters} cannot be seen from outside")
    } else {
        let combinations = listed(combinations);
        format!("{parameters} cannot all be told apart from outside, only {combinations}")
    }
}

/// The first of them, and how many there are besides.
fn listed(all: &[String]) -> String {
    match all {
        [first @ .., _, _] if first.len() >= MOST_LISTED - 1 => {
            let shown = &all[..MOST_LISTED];
            format!("{} and {} more", shown.join(", "), all.len() - MOST_LISTED)
        }
        _ => all.join(", "),
    }
}

/// All that there is to say about the models of a scene: how they were made, and what cannot be told apart.
pub fn notes(scene: &Scene) -> Vec<String> {
    let made = scene.notes.iter().map(|note| format!("{}: {}", note.subject, note.what));
    let connections = scene.network.connections().iter();
    let entangled = connections.flat_map(|connection| {
        groups(&connection.model).into_iter().map(|group| {
            let text = sentence(&group.parameters, &combinations(&group));
            format!("element `{}`: {text}", connection.name)
        })
    });
    made.chain(entangled).collect()
}
