//! Scenes, models and responses that the command line names: `FILE`, `FILE:NAME`, `FILE:NODE,NODE`.

use std::path::Path;

use dashpot_network::{
    Model, Network, NodeId, driving_point::Response, first_nonlinear, linear_model, model_of,
};
use dashpot_rheology::{Canonical, LinearModel};
use dashpot_scene::{
    ModelNote, NamedModel, ReadOptions, Remark, Scene, read, read_models, read_named_model,
    read_network, references,
};

use crate::{
    args::SceneArguments,
    error::CliError,
    input::Input,
    terminal::{Terminal, note},
};

/// What a word on the command line stands for.
pub(crate) struct Operand {
    pub(crate) word: String,
    /// The text in which it was found.
    pub(crate) input: Input,
    /// What it is.
    pub(crate) subject: Subject,
}

/// A model, or the response of a network.
pub(crate) enum Subject {
    /// A series-parallel model.
    Model(NamedModel),
    /// The response of a network at two of its nodes.
    Response(Response),
}

impl Operand {
    /// Reads what `word` stands for, with the values `set`; warnings and notes are told.
    ///
    /// Whatever is done with an operand takes its linear response, so one with an element that is
    /// not linear is an error.
    pub(crate) fn read(
        word: &str,
        set: &[(String, String)],
        terminal: Terminal,
    ) -> Result<Self, CliError> {
        let own = Self::read_any(word, set, terminal)?;
        match own.model().and_then(first_nonlinear) {
            Some(element) => {
                Err(CliError::NotLinear { word: word.to_owned(), kind: element.kind() })
            }
            None => Ok(own),
        }
    }

    /// The same, with elements that are not linear as well.
    pub(crate) fn read_any(
        word: &str,
        set: &[(String, String)],
        terminal: Terminal,
    ) -> Result<Self, CliError> {
        let (path, name) = parted(word);
        let input = Input::read(Path::new(path))?;
        let options = input.options(set);
        let subject = if let Some((from, to)) = name.split_once(',') {
            let checked = read_network(input.text()?, &options).map_err(CliError::Scene)?;
            terminal.diagnose(&checked.warnings);
            let network = checked.value;
            let [a, b] = [node(&network, from)?, node(&network, to)?];
            if a == b {
                return Err(CliError::OneNode { name: from.trim().to_owned() });
            }
            Subject::Response(network.driving_point(a, b)?)
        } else {
            let checked =
                read_named_model(input.text()?, name, &options).map_err(CliError::Scene)?;
            terminal.diagnose(&checked.warnings);
            print_notes(&checked.value.notes);
            note_effects(&checked.value, input.text()?, &options);
            Subject::Model(checked.value)
        };
        Ok(Self { word: word.to_owned(), input, subject })
    }

    /// The linear model, where it is one.
    pub(crate) fn linear(&self) -> Result<Option<LinearModel>, CliError> {
        let linear = match &self.subject {
            Subject::Model(named) => linear_model(&named.model),
            Subject::Response(Response::Massless(own)) => own.model.clone(),
            Subject::Response(Response::Massive(_)) => return Ok(None),
        };
        if linear.is_in_range() {
            Ok(Some(linear))
        } else {
            Err(CliError::OutOfRange { word: self.word.clone() })
        }
    }

    /// How well its poles and strengths are known, relatively.
    pub(crate) fn error(&self) -> f64 {
        match &self.subject {
            Subject::Response(Response::Massless(own)) => own.error,
            _ => 0.0,
        }
    }

    /// The tree of elements, where it is one.
    pub(crate) fn model(&self) -> Option<&Model> {
        match &self.subject {
            Subject::Model(named) => Some(&named.model),
            Subject::Response(_) => None,
        }
    }

    /// Whether its values are those of a material: moduli in Pa.
    pub(crate) fn is_material(&self) -> bool {
        matches!(&self.subject, Subject::Model(named) if named.is_material)
    }
}

/// The model of an operand; the response of a network becomes one of its canonical forms.
pub(crate) fn canonical_model(operand: &Operand) -> Result<Model, CliError> {
    if let Some(model) = operand.model() {
        return Ok(model.clone());
    }
    let masses = || CliError::MovingMasses { word: operand.word.clone() };
    let linear = operand.linear()?.ok_or_else(masses)?;
    let forms = [Canonical::Maxwell, Canonical::Kelvin];
    let tree = forms.into_iter().find_map(|form| linear.tree(form));
    tree.map(|tree| model_of(&tree)).ok_or_else(masses)
}

/// Reads a scene with the values `set` in place of its own: the built-in one, a file, or standard
/// input for `-`; shows what is odd about it.
pub(crate) fn read_scene(
    path: Option<&Path>,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Scene, CliError> {
    read_scene_of(&Input::of(path)?, set, terminal)
}

/// The same of what was read already.
pub(crate) fn read_scene_of(
    input: &Input,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Scene, CliError> {
    let checked = read(input.text()?, &input.options(set)).map_err(CliError::Scene)?;
    terminal.diagnose(&checked.warnings);
    Ok(checked.value)
}

/// The models of a file that has them and no scene, by what they are; `None` for a scene.
pub(crate) fn read_models_of(
    input: &Input,
    set: &[(String, String)],
    terminal: Terminal,
) -> Result<Option<String>, CliError> {
    let Some(found) = read_models(input.text()?, &input.options(set)) else { return Ok(None) };
    let found = found.map_err(CliError::Scene)?;
    terminal.diagnose(&found.warnings);
    let name = |own: &NamedModel| {
        format!("{} `{}`", if own.is_material { "material" } else { "model" }, own.name)
    };
    let names = found.value.iter().map(name).collect::<Vec<_>>().join(", ");
    let first = found.value.into_iter().next().map(|own| own.name).unwrap_or_default();
    Ok(Some(format!("{names}, and no scene: others name them as `{}:{first}`", input.file)))
}

impl SceneArguments {
    /// Reads the scene that the command line names.
    pub(crate) fn read(&self, terminal: Terminal) -> Result<Scene, CliError> {
        read_scene(self.scene.as_deref(), &self.values.set, terminal)
    }
}

/// Says which numbers of a scene have scatter, where that is not looked at.
pub(crate) fn note_means(scene: &Scene) {
    for own in &scene.scatter {
        note(&format!("{}: {}", own.name, Remark::Mean(own.text.clone())));
    }
}

/// Says what there is to say about models.
pub(crate) fn print_notes<'n>(notes: impl IntoIterator<Item = &'n ModelNote>) {
    for ModelNote { subject, what, .. } in notes {
        note(&format!("{subject}: {what}"));
    }
}

/// Says which effects of the scene act on the element that a model was taken from: the model is that without them.
fn note_effects(named: &NamedModel, text: &str, options: &ReadOptions<'_>) {
    if named.section != "elements" {
        return;
    }
    // A text that is no scene as a whole has no effects either.
    let Ok(scene) = read_network(text, options) else { return };
    let effects =
        scene.value.effects().iter().filter(|effect| effect.target() == Some(&named.name));
    let kinds: Vec<&str> = effects.map(|effect| effect.kind()).collect();
    if !kinds.is_empty() {
        let name = &named.name;
        note(&format!("{name}: its model is taken without {}", kinds.join(", ")));
    }
}

/// File and name; a word that is a file, or a built-in scene, has no name.
pub(crate) fn parted(word: &str) -> (&str, &str) {
    let is_whole = word == "-"
        || Path::new(word).is_file()
        || references().iter().any(|shipped| shipped.name == word);
    if is_whole { (word, "") } else { word.rsplit_once(':').unwrap_or((word, "")) }
}

fn node(network: &Network, name: &str) -> Result<NodeId, CliError> {
    let name = name.trim();
    network.node_named(name).ok_or_else(|| CliError::UnknownNode {
        name: name.to_owned(),
        known: network.nodes().map(|(_, node)| node.name.clone()).collect(),
    })
}
