//! Which curve is which where one hides another, and on a terminal without colours: a letter on each curve that
//! runs by itself.

use std::collections::BTreeSet;

/// A character of the plot as (row, column).
pub(super) type Place = (usize, usize);

/// How a curve is told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tag {
    /// It runs by itself, with a letter at this place if there is a free one.
    Letter(char, Option<Place>),
    /// It runs as the curve of this index does.
    Same(usize),
    /// It lies on a part of the curve of this index.
    Within(usize),
}

/// Legend text of a curve that runs as another one does. On logarithmic axes one cell or pixel may be many percent.
pub(super) fn same_name(name: &str, host: &str, is_linear: bool) -> String {
    format!("{name} {} {host}", if is_linear { '=' } else { '≈' })
}

/// Per curve the first one before it that runs through the same places and is drawn `alike`.
pub(super) fn same_curves(
    curves: &[Vec<Place>],
    alike: impl Fn(usize, usize) -> bool,
) -> Vec<Option<usize>> {
    let sets = sets(curves);
    let same = |a: usize, b: usize| lies_on(&sets[a], &sets[b]) && lies_on(&sets[b], &sets[a]);
    (0..curves.len())
        .map(|index| (0..index).find(|host| alike(*host, index) && same(*host, index)))
        .collect()
}

fn sets(curves: &[Vec<Place>]) -> Vec<BTreeSet<Place>> {
    curves.iter().map(|curve| curve.iter().copied().collect()).collect()
}

/// Tags for curves that run through these places, in the order of the curves; after `z` the letters begin again.
pub(super) fn tags(curves: &[Vec<Place>]) -> Vec<Tag> {
    let sets = sets(curves);
    let mut hosts: Vec<Option<usize>> = Vec::with_capacity(curves.len());
    for (index, set) in sets.iter().enumerate() {
        let host = (0..index).find(|i| hosts[*i].is_none() && lies_on(set, &sets[*i]));
        hosts.push(host);
    }
    let apart = hosts.iter().filter(|host| host.is_none()).count();
    let mut letters = ('a'..='z').cycle();
    let mut turn = 0;
    let mut tag = |index: usize| {
        if let Some(host) = hosts[index] {
            let is_whole = lies_on(&sets[host], &sets[index]);
            return if is_whole { Tag::Same(host) } else { Tag::Within(host) };
        }
        let letter = letters.next().unwrap_or('a');
        turn += 1;
        let free = |place: &Place| {
            let others = (0..curves.len()).filter(|i| *i != index && hosts[*i] != Some(index));
            others.into_iter().all(|i| !sets[i].contains(place))
        };
        let wish = turn * curves[index].len() / (apart + 1);
        let spot = curves[index].iter().enumerate().filter(|(_, place)| free(place));
        let spot = spot.min_by_key(|(at, _)| at.abs_diff(wish)).map(|(_, place)| *place);
        Tag::Letter(letter, spot)
    };
    (0..curves.len()).map(&mut tag).collect()
}

/// Whether all but a few places of a curve are places of the other one or next to one.
fn lies_on(curve: &BTreeSet<Place>, other: &BTreeSet<Place>) -> bool {
    let near = |(row, column): &Place| {
        (row.saturating_sub(1)..=row + 1)
            .any(|r| (column.saturating_sub(1)..=column + 1).any(|c| other.contains(&(r, c))))
    };
    let off = curve.iter().filter(|place| !near(place)).count();
    !curve.is_empty() && off * 50 <= curve.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_on_another_one_is_said_to_be_there() {
        let line: Vec<Place> = (0..40).map(|c| (c / 4, c)).collect();
        let beside: Vec<Place> = line.iter().map(|(r, c)| (r + 1, *c)).collect();
        let far: Vec<Place> = line.iter().map(|(r, c)| (r + 5, *c)).collect();
        let tags = tags(&[line.clone(), beside, far.clone()]);
        assert_eq!(tags[1], Tag::Same(0));
        let (Tag::Letter('a', Some(a)), Tag::Letter('b', Some(b))) = (tags[0], tags[2]) else {
            panic!("{tags:?}");
        };
        assert!(line.contains(&a) && !far.contains(&a));
        assert!(far.contains(&b) && !line.contains(&b));
    }

    #[test]
    fn a_part_of_a_curve_is_not_said_to_be_the_same() {
        let line: Vec<Place> = (0..40).map(|c| (c / 4, c)).collect();
        let curves = [line.clone(), line[..20].to_vec(), line];
        assert_eq!(tags(&curves)[1..], [Tag::Within(0), Tag::Same(0)]);
        assert_eq!(same_curves(&curves, |_, _| true), [None, None, Some(0)]);
        assert_eq!(same_curves(&curves, |_, _| false), [None; 3]);
    }

    #[test]
    fn empty_curves_have_a_letter_without_a_place() {
        assert_eq!(tags(&[vec![], vec![]])[1], Tag::Letter('b', None));
    }
}
