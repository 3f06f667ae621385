//! Unknowns that are eliminated before the rest of a matrix is factorised.
//!
//! Where a position has a speed of its own, `q′ = v`, its row of `M − c J` has two entries. Without such rows
//! the matrix of a network is that of its masses alone, `M + c C + c² K`: half as large, and of a band half as
//! wide or less.

use dashpot_numerics::packed;

use super::ordering::Graph;

/// What becomes of an unknown, by its number among those of its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Role {
    Kept(u32),
    Eliminated(u32),
}

/// The roles of the unknowns of a matrix with these entries `(row, column)`.
///
/// An unknown with `r` other entries in its row and `c` in its column takes these along and leaves up to `r c`
/// behind. It is eliminated where these are no more, its entry on the diagonal is there, and none of its
/// neighbours is eliminated, those with short rows first.
pub(super) fn roles(
    size: usize,
    entries: impl Iterator<Item = (usize, usize)> + Clone,
) -> Vec<Role> {
    let mut counts = vec![[0_u32; 3]; size];
    for (row, column) in entries.clone() {
        if row == column {
            counts[row][2] += 1;
        } else {
            counts[row][0] += 1;
            counts[column][1] += 1;
        }
    }
    let is_fit = |&unknown: &usize| {
        let [row, column, own] = counts[unknown];
        own == 1 && u64::from(row) * u64::from(column) <= u64::from(row) + u64::from(column)
    };
    let mut fit: Vec<usize> = (0..size).filter(is_fit).collect();
    fit.sort_by_key(|&unknown| (counts[unknown], unknown));
    let graph = Graph::of(size, entries);
    let mut is_eliminated = vec![false; size];
    for unknown in fit {
        is_eliminated[unknown] =
            !graph.neighbours(unknown).iter().any(|&other| is_eliminated[other as usize]);
    }
    numbered(&is_eliminated)
}

/// The roles where all are kept.
pub(super) fn none(size: usize) -> Vec<Role> {
    numbered(&vec![false; size])
}

fn numbered(is_eliminated: &[bool]) -> Vec<Role> {
    let mut numbers = [0, 0];
    let role = |&is_eliminated: &bool| {
        let number = &mut numbers[usize::from(is_eliminated)];
        *number += 1;
        let own = packed(*number - 1);
        if is_eliminated { Role::Eliminated(own) } else { Role::Kept(own) }
    };
    is_eliminated.iter().map(role).collect()
}
