//! Models and responses that a request names: `FILE`, `FILE:NAME`, `FILE:NODE,NODE`.

use dashpot_network::{
    Model, Network, NodeId, driving_point::Response, first_nonlinear, linear_model, model_of,
};
use dashpot_rheology::{Canonical, LinearModel};
use dashpot_scene::{
    NamedModel, ReadOptions, Remark as SceneRemark, Scene, read_named_model, read_network,
    references,
};

use crate::{Context, Input, Remark, StudyError};

/// What may stand for a model.
pub const MODEL: &str = "FILE:NAME, a model, material or element of a file or of a built-in scene; FILE alone if it \
     has one model; FILE:NODE,NODE for the response of a network without moving masses";

/// What a word stands for.
#[derive(Debug)]
pub struct Operand {
    /// The word.
    pub word: String,
    /// The text in which it was found.
    pub input: Input,
    /// What it is.
    pub subject: Subject,
}

/// A model, or the response of a network.
#[derive(Debug)]
pub enum Subject {
    /// A series-parallel model.
    Model(NamedModel),
    /// The response of a network at two of its nodes.
    Response(Response),
}

impl Operand {
    /// Reads what `word` stands for, with the values `set`.
    ///
    /// Whatever is done with an operand takes its linear response, so one with an element that is not linear is an error.
    ///
    /// # Errors
    ///
    /// What is wrong with the word or the text.
    pub fn read(
        word: &str,
        set: &[(String, String)],
        context: &mut dyn Context,
    ) -> Result<Self, StudyError> {
        let operand = Self::read_any(word, set, context)?;
        match operand.model().and_then(first_nonlinear) {
            Some(element) => {
                Err(StudyError::NotLinear { word: word.to_owned(), kind: element.kind() })
            }
            None => Ok(operand),
        }
    }

    /// The same, with elements that are not linear as well.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn read_any(
        word: &str,
        set: &[(String, String)],
        context: &mut dyn Context,
    ) -> Result<Self, StudyError> {
        let (path, name) = parted(word, context);
        let input = context.input(path)?;
        let subject = if let Some((from, to)) = name.split_once(',') {
            let checked = input.with(set, context, read_network)?;
            context.remark(Remark::Odd(&checked.warnings));
            let network = checked.value;
            let [a, b] = [node(&network, from)?, node(&network, to)?];
            if a == b {
                return Err(StudyError::OneNode { name: from.trim().to_owned() });
            }
            Subject::Response(network.driving_point(a, b)?)
        } else {
            let read = |text: &str, options: &ReadOptions<'_>| {
                let named = read_named_model(text, name, options)?;
                let without = effects_on(&named.value, text, options);
                Ok((named, without))
            };
            let (checked, without) = input.with(set, context, read)?;
            context.remark(Remark::Odd(&checked.warnings));
            checked.value.notes.iter().for_each(|note| context.remark(Remark::Model(note)));
            if !without.is_empty() {
                let text = format!("its model is taken without {}", without.join(", "));
                context.remark(Remark::Note(format!("{}: {text}", checked.value.name)));
            }
            Subject::Model(checked.value)
        };
        Ok(Self { word: word.to_owned(), input, subject })
    }

    /// The linear model, where it is one.
    ///
    /// # Errors
    ///
    /// [`StudyError::OutOfRange`].
    pub fn linear(&self) -> Result<Option<LinearModel>, StudyError> {
        let linear = match &self.subject {
            Subject::Model(named) => linear_model(&named.model),
            Subject::Response(Response::Massless(own)) => own.model.clone(),
            Subject::Response(Response::Massive(_)) => return Ok(None),
        };
        if linear.is_in_range() {
            Ok(Some(linear))
        } else {
            Err(StudyError::OutOfRange { word: self.word.clone() })
        }
    }

    /// How well its poles and residues are known, relatively.
    pub fn error(&self) -> f64 {
        match &self.subject {
            Subject::Response(Response::Massless(own)) => own.error,
            _ => 0.0,
        }
    }

    /// The tree of elements, where it is one.
    pub fn model(&self) -> Option<&Model> {
        match &self.subject {
            Subject::Model(named) => Some(&named.model),
            Subject::Response(_) => None,
        }
    }

    /// Whether its values are those of a material: moduli in Pa.
    pub fn is_material(&self) -> bool {
        matches!(&self.subject, Subject::Model(named) if named.is_material)
    }
}

/// The model of an operand; the response of a network becomes one of its canonical forms.
///
/// # Errors
///
/// [`StudyError::MovingMasses`].
pub fn canonical_model(operand: &Operand) -> Result<Model, StudyError> {
    if let Some(model) = operand.model() {
        return Ok(model.clone());
    }
    let masses = || StudyError::MovingMasses { word: operand.word.clone() };
    let linear = operand.linear()?.ok_or_else(masses)?;
    let forms = [Canonical::Maxwell, Canonical::Kelvin];
    let tree = forms.into_iter().find_map(|form| linear.tree(form));
    tree.map(|tree| model_of(&tree)).ok_or_else(masses)
}

/// Remarks which numbers of a scene have scatter, where that is not looked at.
pub fn remark_means(scene: &Scene, context: &mut dyn Context) {
    for scattered in &scene.scatter {
        let mean = SceneRemark::Mean(scattered.text.clone());
        context.remark(Remark::Note(format!("{}: {mean}", scattered.name)));
    }
}

/// Which effects of the scene act on the element that a model was taken from: the model is that without them.
fn effects_on(named: &NamedModel, text: &str, options: &ReadOptions<'_>) -> Vec<&'static str> {
    if named.section != "elements" {
        return Vec::new();
    }
    // A text that is no scene as a whole has no effects either.
    let Ok(scene) = read_network(text, options) else { return Vec::new() };
    let effects = scene.value.effects().iter();
    effects.filter(|effect| effect.target() == Some(&named.name)).map(|own| own.kind()).collect()
}

/// File and name; a word that is a file, or a built-in scene, has no name.
pub fn parted<'w>(word: &'w str, context: &dyn Context) -> (&'w str, &'w str) {
    let is_whole =
        word == "-" || context.has(word) || references().iter().any(|shipped| shipped.name == word);
    if is_whole { (word, "") } else { word.rsplit_once(':').unwrap_or((word, "")) }
}

fn node(network: &Network, name: &str) -> Result<NodeId, StudyError> {
    let name = name.trim();
    network.node_named(name).ok_or_else(|| StudyError::UnknownNode {
        name: name.to_owned(),
        known: network.nodes().map(|(_, node)| node.name.clone()).collect(),
    })
}
