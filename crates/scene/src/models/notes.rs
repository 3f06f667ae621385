//! What is to be said about models, besides errors and warnings.

use std::cell::RefCell;

/// A remark on a model: how near it comes to its description, by what its times were multiplied.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelNote {
    /// What it is about: "model `felt`", "element `padding`".
    pub subject: String,
    /// The remark, for instance "9 Kelvin elements keep the creep within 0.08 %".
    pub text: String,
    /// Time up to which the model stands for its description \[s\]; `None` for any time.
    pub until: Option<f64>,
}

/// Takes up notes while models are read; a model that is used again says the same only once.
#[derive(Debug, Default)]
pub(crate) struct Notes(RefCell<Vec<ModelNote>>);

impl Notes {
    /// Adds a remark.
    pub(crate) fn add(
        &self,
        subject: impl Into<String>,
        text: impl Into<String>,
        until: Option<f64>,
    ) {
        let note = ModelNote { subject: subject.into(), text: text.into(), until };
        let mut all = self.0.borrow_mut();
        if !all.contains(&note) {
            all.push(note);
        }
    }

    /// All remarks so far, in the order in which the models were read.
    pub(crate) fn all(&self) -> Vec<ModelNote> {
        self.0.borrow().clone()
    }
}
