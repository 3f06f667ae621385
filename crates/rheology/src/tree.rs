//! Series–parallel trees.

use std::{
    borrow::Cow,
    convert::Infallible,
    ops::{Add, BitOr},
};

/// Levels of composition that a tree may have in a network or a scene, which refuse more. Whatever
/// walks a tree calls itself once for each level.
pub const MOST_LEVELS: usize = 128;

/// A two-terminal model composed of parts of type `P`.
///
/// In a [`Series`](Self::Series) one force passes through all branches and their deformations add up, in order from the
/// impactor's side; in a [`Parallel`](Self::Parallel) all branches have one deformation and their forces add up.
///
/// `a + b` is a series, since compliances add up there, and `a | b` stands in parallel. `+` binds
/// closer than `|`. Branches of series in a series, or parallel ones in parallel, join with no level of
/// their own where they have no names but numbers; to keep them together, name a
/// [`Branch`].
///
/// # Examples
///
/// ```
/// use dashpot_rheology::Tree;
///
/// let pad = Tree::from("spring") + (Tree::from("spring") | "dashpot");
/// let names: Vec<&str> = pad.branches().iter().map(|branch| &*branch.name).collect();
/// assert_eq!(names, ["1", "2"]);
/// assert_eq!(pad.branches()[1].tree.branches()[1].tree, Tree::Part("dashpot"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Tree<P> {
    /// A part that is not composed of others.
    Part(P),
    /// Branches in series.
    Series(Vec<Branch<P>>),
    /// Branches in parallel.
    Parallel(Vec<Branch<P>>),
}

/// A named branch of a tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch<P> {
    /// Name of the branch; unique among its siblings. Paths such as `padding.kelvin.spring` are made of these.
    pub name: Cow<'static, str>,
    /// What the branch is.
    pub tree: Tree<P>,
}

impl<P> Branch<P> {
    /// A branch of the given name.
    pub fn new(name: impl Into<Cow<'static, str>>, tree: Tree<P>) -> Self {
        Self { name: name.into(), tree }
    }
}

impl<P> From<P> for Tree<P> {
    fn from(part: P) -> Self {
        Self::Part(part)
    }
}

impl<P> Tree<P> {
    /// Branches in series, named by their position: `1`, `2`, …
    pub fn series(branches: impl IntoIterator<Item = Self>) -> Self {
        Self::Series(numbered(branches))
    }

    /// Branches in parallel, named by their position: `1`, `2`, …
    pub fn parallel(branches: impl IntoIterator<Item = Self>) -> Self {
        Self::Parallel(numbered(branches))
    }

    /// The branches, none for a single part.
    pub fn branches(&self) -> &[Branch<P>] {
        match self {
            Self::Part(_) => &[],
            Self::Series(branches) | Self::Parallel(branches) => branches,
        }
    }

    /// Whether the branches stand in series.
    pub fn is_series(&self) -> bool {
        matches!(self, Self::Series(_))
    }

    /// Works the tree off from its parts upwards: `leaf` turns a part into a `T`, `compose` puts
    /// those of the branches of a composition together, in order.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_rheology::Tree;
    ///
    /// let tree = Tree::series([Tree::from(2.0), Tree::parallel([1.0.into(), 3.0.into()])]);
    /// let stiffness = tree.fold(|&own| own, |node, parts: Vec<f64>| match node.is_series() {
    ///     true => 1.0 / parts.iter().map(|own| 1.0 / own).sum::<f64>(),
    ///     false => parts.iter().sum(),
    /// });
    /// assert!((stiffness - 4.0 / 3.0_f64).abs() < 1e-15);
    /// ```
    pub fn fold<'t, T>(
        &'t self,
        mut leaf: impl FnMut(&'t P) -> T,
        mut compose: impl FnMut(&'t Self, Vec<T>) -> T,
    ) -> T {
        self.fold_with(&mut leaf, &mut compose)
    }

    fn fold_with<'t, T>(
        &'t self,
        leaf: &mut impl FnMut(&'t P) -> T,
        compose: &mut impl FnMut(&'t Self, Vec<T>) -> T,
    ) -> T {
        if let Self::Part(part) = self {
            return leaf(part);
        }
        let parts =
            self.branches().iter().map(|branch| branch.tree.fold_with(leaf, compose)).collect();
        compose(self, parts)
    }

    /// The same tree with another one in the place of each part.
    pub fn map<Q>(&self, mut part: impl FnMut(&P) -> Tree<Q>) -> Tree<Q> {
        let Ok(tree) = self.try_map(|own| Ok::<_, Infallible>(part(own)));
        tree
    }

    /// The same tree with another one in the place of each part, or the first error of `part`.
    ///
    /// # Errors
    ///
    /// Those of `part`.
    pub fn try_map<Q, E>(
        &self,
        mut part: impl FnMut(&P) -> Result<Tree<Q>, E>,
    ) -> Result<Tree<Q>, E> {
        self.try_map_with(&mut part)
    }

    fn try_map_with<Q, E>(
        &self,
        part: &mut impl FnMut(&P) -> Result<Tree<Q>, E>,
    ) -> Result<Tree<Q>, E> {
        if let Self::Part(own) = self {
            return part(own);
        }
        let branch =
            |own: &Branch<P>| Ok(Branch::new(own.name.clone(), own.tree.try_map_with(part)?));
        let branches = self.branches().iter().map(branch).collect::<Result<Vec<_>, E>>()?;
        Ok(if self.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) })
    }

    /// How many parts and compositions there are.
    pub fn size(&self) -> usize {
        1 + self.branches().iter().map(|branch| branch.tree.size()).sum::<usize>()
    }

    /// Whether compositions stand within each other on more than this many levels.
    pub fn is_deeper_than(&self, levels: usize) -> bool {
        !self.branches().is_empty()
            && (levels == 0
                || self.branches().iter().any(|branch| branch.tree.is_deeper_than(levels - 1)))
    }

    /// All parts in the order in which [`fold`](Self::fold) meets them.
    pub fn leaves(&self) -> impl Iterator<Item = &P> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            loop {
                match open.pop()? {
                    Self::Part(part) => return Some(part),
                    tree => open.extend(tree.branches().iter().rev().map(|branch| &branch.tree)),
                }
            }
        })
    }

    /// All parts in the order of [`leaves`](Self::leaves), with their paths such as
    /// `kelvin.spring`; that of a tree of one part is empty.
    pub fn parts(&self) -> Vec<(String, &P)> {
        let mut parts = Vec::new();
        self.collect_parts(String::new(), &mut parts);
        parts
    }

    fn collect_parts<'t>(&'t self, path: String, parts: &mut Vec<(String, &'t P)>) {
        if let Self::Part(part) = self {
            parts.push((path, part));
            return;
        }
        let separator = if path.is_empty() { "" } else { "." };
        for branch in self.branches() {
            branch.tree.collect_parts(format!("{path}{separator}{}", branch.name), parts);
        }
    }
}

impl<P, T: Into<Tree<P>>> Add<T> for Tree<P> {
    type Output = Self;

    /// Both in series.
    fn add(self, other: T) -> Self {
        let mut branches = Vec::new();
        for own in [self, other.into()] {
            match own {
                Self::Series(parts) if is_numbered(&parts) => branches.extend(trees(parts)),
                own => branches.push(own),
            }
        }
        Self::series(branches)
    }
}

impl<P, T: Into<Tree<P>>> BitOr<T> for Tree<P> {
    type Output = Self;

    /// Both in parallel.
    fn bitor(self, other: T) -> Self {
        let mut branches = Vec::new();
        for own in [self, other.into()] {
            match own {
                Self::Parallel(parts) if is_numbered(&parts) => branches.extend(trees(parts)),
                own => branches.push(own),
            }
        }
        Self::parallel(branches)
    }
}

fn trees<P>(branches: Vec<Branch<P>>) -> impl Iterator<Item = Tree<P>> {
    branches.into_iter().map(|branch| branch.tree)
}

/// Whether branches have no other names than their numbers; of none there is nothing to join.
fn is_numbered<P>(branches: &[Branch<P>]) -> bool {
    !branches.is_empty()
        && branches.iter().enumerate().all(|(at, own)| own.name == (at + 1).to_string())
}

fn numbered<P>(branches: impl IntoIterator<Item = Tree<P>>) -> Vec<Branch<P>> {
    branches
        .into_iter()
        .enumerate()
        .map(|(at, tree)| Branch::new((at + 1).to_string(), tree))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_flat_and_names_keep_branches_together() {
        let [a, b, c] = ["a", "b", "c"].map(Tree::from);
        let flat = Tree::series([a.clone(), b.clone(), c.clone()]);
        assert_eq!(a.clone() + b.clone() + "c", flat);
        assert_eq!(a.clone() + (b.clone() + c.clone()), flat);
        let parallel = Tree::parallel([a.clone(), b.clone()]);
        assert_eq!(a.clone() | "b", parallel);
        assert_eq!((a.clone() | "b") + "c", Tree::series([parallel.clone(), c.clone()]));
        assert_eq!((a.clone() + b.clone()) | c.clone(), Tree::parallel([a + b, c.clone()]));
        let named = Tree::Parallel(vec![Branch::new("fast", Tree::Part("a"))]);
        assert_eq!(named.clone() | "c", Tree::parallel([named, c.clone()]));
        let nothing: Tree<&str> = Tree::series([]);
        assert_eq!(nothing.clone() + "c", Tree::series([nothing, c]));
    }
}
