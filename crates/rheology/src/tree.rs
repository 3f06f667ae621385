//! Series–parallel trees.

/// A two-terminal model composed of parts of type `P`.
///
/// In a [`Series`](Self::Series) one force passes through all branches and their deformations add
/// up, in order from the impactor's side; in a [`Parallel`](Self::Parallel) all branches have one
/// deformation and their forces add up. Nesting has no limit but memory.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::Tree;
///
/// let pad = Tree::series([Tree::from("spring"), Tree::parallel(["spring".into(), "dashpot".into()])]);
/// let names: Vec<&str> = pad.branches().iter().map(|branch| branch.name.as_str()).collect();
/// assert_eq!(names, ["1", "2"]);
/// assert_eq!(pad.branches()[1].tree.branches()[1].tree, Tree::Part("dashpot"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Tree<P> {
    /// A part that is not composed of others.
    Part(P),
    /// Branches in a row.
    Series(Vec<Branch<P>>),
    /// Branches side by side.
    Parallel(Vec<Branch<P>>),
}

/// A named branch of a tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch<P> {
    /// Name of the branch; unique among its siblings. Paths such as `padding.kelvin.spring` are
    /// made of these.
    pub name: String,
    /// What the branch is.
    pub tree: Tree<P>,
}

impl<P> Branch<P> {
    /// A branch of the given name.
    pub fn new(name: impl Into<String>, tree: Tree<P>) -> Self {
        Self { name: name.into(), tree }
    }
}

impl<P> From<P> for Tree<P> {
    fn from(part: P) -> Self {
        Self::Part(part)
    }
}

impl<P> Tree<P> {
    /// Branches in a row, named by their position: `1`, `2`, …
    pub fn series(branches: impl IntoIterator<Item = Self>) -> Self {
        Self::Series(numbered(branches))
    }

    /// Branches side by side, named by their position: `1`, `2`, …
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
}

fn numbered<P>(branches: impl IntoIterator<Item = Tree<P>>) -> Vec<Branch<P>> {
    branches
        .into_iter()
        .enumerate()
        .map(|(at, tree)| Branch::new((at + 1).to_string(), tree))
        .collect()
}
