//! Where in a model the pads with a size of their own stand.

use super::expand::{LONGEST_PATH, Shape};
use crate::{Connection, InnerPad, Model};

/// A branch of the model of a connection.
pub(super) struct Located {
    pub(super) shape: usize,
    /// Its path, which begins with the name of the connection.
    pub(super) path: String,
}

/// The inner pads of a connection, each with its place among the shapes.
pub(super) fn located<'c>(
    connection: &'c Connection,
    shapes: &[Shape],
) -> Vec<(&'c InnerPad, Located)> {
    let mut wanted: Vec<&InnerPad> = connection.pads.iter().collect();
    wanted.sort_by_key(|pad| std::cmp::Reverse(pad.at));
    let names = vec![connection.name.as_str()];
    let mut search = Search { shapes, wanted, names, done: 0, found: Vec::new() };
    search.walk(&connection.model, 0);
    search.found
}

/// A walk through a model, each tree behind its branches.
struct Search<'c, 's> {
    shapes: &'s [Shape],
    /// The pads that are not found yet, the next one last.
    wanted: Vec<&'c InnerPad>,
    /// The names around a tree and its own.
    names: Vec<&'c str>,
    /// Trees that are done.
    done: usize,
    found: Vec<(&'c InnerPad, Located)>,
}

impl<'c> Search<'c, '_> {
    fn walk(&mut self, model: &'c Model, shape: usize) {
        if let Shape::Series(children) | Shape::Row(children) | Shape::Parallel(children) =
            &self.shapes[shape]
        {
            for (own, shape) in model.branches().iter().zip(children.clone()) {
                self.names.push(&own.name);
                self.walk(&own.tree, shape);
                self.names.pop();
            }
        }
        if let Some(pad) = self.wanted.pop_if(|pad| pad.at == self.done) {
            self.found.push((pad, Located { shape, path: self.path() }));
        }
        self.done += 1;
    }

    /// The names that lead to a tree; of too many the first and the last one.
    fn path(&self) -> String {
        match self.names[..] {
            [first, .., last]
                if self.names.iter().map(|name| name.len()).sum::<usize>() > LONGEST_PATH =>
            {
                format!("{first}.….{last}")
            }
            _ => self.names.join("."),
        }
    }
}
