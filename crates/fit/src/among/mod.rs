//! Which of several forms of a model the tests speak for: by tests that were held out, else by a stated error.

mod choice;
mod forms;

pub use self::{
    choice::{Basis, Candidate, Choice, Verdict, choose, information},
    forms::{Constant, Form, KNOWN},
};
