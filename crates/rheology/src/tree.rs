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

    /// Whether the branches stand in a row.
    pub fn is_series(&self) -> bool {
        matches!(self, Self::Series(_))
    }

    /// Works the tree off from its parts upwards: `leaf` turns a part into a `T`, `compose` puts
    /// those of the branches of a composition together, in order. The depth of the tree has no
    /// limit.
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
        enum Task<'t, P> {
            Read(&'t Tree<P>),
            Compose(&'t Tree<P>),
        }
        let mut done: Vec<T> = Vec::new();
        let mut tasks = vec![Task::Read(self)];
        while let Some(task) = tasks.pop() {
            match task {
                Task::Read(Self::Part(part)) => done.push(leaf(part)),
                Task::Read(tree) => {
                    tasks.push(Task::Compose(tree));
                    tasks.extend(tree.branches().iter().rev().map(|own| Task::Read(&own.tree)));
                }
                Task::Compose(tree) => {
                    let parts = done.split_off(done.len() - tree.branches().len());
                    done.push(compose(tree, parts));
                }
            }
        }
        // One result is left, because every composition leaves one for all that it takes.
        done.pop().unwrap_or_else(|| compose(self, Vec::new()))
    }

    /// How many parts and compositions there are.
    pub fn size(&self) -> usize {
        let (mut open, mut count) = (vec![self], 0);
        while let Some(tree) = open.pop() {
            count += 1;
            open.extend(tree.branches().iter().map(|own| &own.tree));
        }
        count
    }

    /// All parts in the order in which [`fold`](Self::fold) meets them.
    pub fn leaves(&self) -> impl Iterator<Item = &P> {
        let mut open = vec![self];
        std::iter::from_fn(move || {
            loop {
                match open.pop()? {
                    Self::Part(part) => return Some(part),
                    tree => open.extend(tree.branches().iter().rev().map(|own| &own.tree)),
                }
            }
        })
    }

    /// All parts in the order of [`leaves`](Self::leaves), with their paths such as
    /// `kelvin.spring`; that of a tree of one part is empty.
    pub fn parts(&self) -> Vec<(String, &P)> {
        let mut parts = Vec::new();
        let mut tasks = vec![(String::new(), self)];
        while let Some((path, tree)) = tasks.pop() {
            match tree {
                Self::Part(part) => parts.push((path, part)),
                Self::Series(branches) | Self::Parallel(branches) => {
                    tasks.extend(branches.iter().rev().map(|own| {
                        let separator = if path.is_empty() { "" } else { "." };
                        (format!("{path}{separator}{}", own.name), &own.tree)
                    }));
                }
            }
        }
        parts
    }
}

fn numbered<P>(branches: impl IntoIterator<Item = Tree<P>>) -> Vec<Branch<P>> {
    branches
        .into_iter()
        .enumerate()
        .map(|(at, tree)| Branch::new((at + 1).to_string(), tree))
        .collect()
}
