//! What cannot be told apart from outside, in words.

use dashpot_network::{Model, primitive};
use dashpot_rheology::{
    Primitive,
    identifiability::{Entangled, entangled},
};
use dashpot_scene::Scene;

use crate::numbers::quantity;

/// Models of more parts than this are not looked at: it would take longer than to solve them.
const MOST_PARTS: usize = 2000;
/// Digits of constants.
const DIGITS: usize = 6;

/// Groups of parameters of a model that cannot all be told apart from outside.
pub(crate) fn groups(model: &Model) -> Vec<Entangled> {
    if model.parts().len() > MOST_PARTS {
        return Vec::new();
    }
    entangled(model, |element| primitive(element.as_ref()))
}

/// What can be told of a group instead.
pub(crate) fn combinations(group: &Entangled) -> Vec<String> {
    let constant = |(path, part): &(String, Primitive)| match part {
        Primitive::Spring(stiffness) => format!("{path} {}", quantity(*stiffness, "N/m", DIGITS)),
        Primitive::Dashpot(damping) => format!("{path} {}", quantity(*damping, "N s/m", DIGITS)),
        Primitive::Rigid => path.clone(),
    };
    group.combinations.iter().map(constant).collect()
}

/// A group as a sentence.
pub(crate) fn sentence(parameters: &[String], combinations: &[String]) -> String {
    let parameters = parameters.join(", ");
    if combinations.is_empty() {
        format!("{parameters} cannot be seen from outside")
    } else {
        let combinations = combinations.join(", ");
        format!("{parameters} cannot all be told apart from outside, only {combinations}")
    }
}

/// All that there is to say about the models of a scene: how they were made, and what cannot be
/// told apart.
pub(crate) fn notes(scene: &Scene) -> Vec<String> {
    let made = scene.notes.iter().map(|note| format!("{}: {}", note.subject, note.text));
    let connections = scene.network.connections().iter();
    let entangled = connections.flat_map(|own| {
        groups(&own.model).into_iter().map(|group| {
            let text = sentence(&group.parameters, &combinations(&group));
            format!("element `{}`: {text}", own.name)
        })
    });
    made.chain(entangled).collect()
}
