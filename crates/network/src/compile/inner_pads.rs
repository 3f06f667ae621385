//! Where in a model the pads with a size of their own stand.

use super::expand::{LONGEST_PATH, Shape};
use crate::{Connection, InnerPad, Model};

/// A branch of the model of a connection.
pub(super) struct Located {
    /// Its shape.
    pub(super) shape: usize,
    /// Its path, which begins with the name of the connection.
    pub(super) path: String,
}

/// A tree that has been begun, with the place of the one around it.
struct Begun<'c> {
    name: &'c str,
    around: Option<usize>,
}

/// The inner pads of a connection, each with its place among the shapes. Without recursion, because
/// nesting has no limit.
pub(super) fn located<'c>(
    connection: &'c Connection,
    shapes: &[Shape],
) -> Vec<(&'c InnerPad, Located)> {
    let mut wanted: Vec<&InnerPad> = connection.pads.iter().collect();
    wanted.sort_by_key(|pad| std::cmp::Reverse(pad.at));
    let mut found = Vec::with_capacity(wanted.len());
    let mut begun = vec![Begun { name: &connection.name, around: None }];
    // A tree, its shape, its place among those begun, and whether its branches are done.
    let mut tasks: Vec<(&Model, usize, usize, bool)> = vec![(&connection.model, 0, 0, false)];
    let mut done = 0;
    while let (Some(next), Some((model, shape, place, is_done))) = (wanted.last(), tasks.pop()) {
        let children: &[usize] = match &shapes[shape] {
            Shape::Series(children) | Shape::Row(children) | Shape::Parallel(children) => children,
            Shape::Leaf(_) => &[],
        };
        if is_done || children.is_empty() {
            if next.at == done {
                found.push((*next, Located { shape, path: path(&begun, place, connection) }));
                wanted.pop();
            }
            done += 1;
            continue;
        }
        tasks.push((model, shape, place, true));
        let first = begun.len();
        let branches = model.branches();
        begun.extend(branches.iter().map(|own| Begun { name: &own.name, around: Some(place) }));
        let below = branches.iter().zip(children).enumerate();
        tasks.extend(below.rev().map(|(at, (own, &shape))| (&own.tree, shape, first + at, false)));
    }
    found
}

/// The names around a tree and its own; of too many the first and the last one.
fn path(begun: &[Begun<'_>], place: usize, connection: &Connection) -> String {
    let mut names = Vec::new();
    let mut length = 0;
    let mut at = Some(place);
    while let Some(own) = at.map(|at| &begun[at]) {
        length += own.name.len();
        if length > LONGEST_PATH {
            return format!("{}.….{}", connection.name, begun[place].name);
        }
        names.push(own.name);
        at = own.around;
    }
    names.reverse();
    names.join(".")
}
