//! Which parameters of a model can be told apart from outside.
//!
//! A model of `n` modes has as many constants as its canonical forms have elements; a tree may have
//! more. Where they are lost is decided by structure: the parts of a series add up their
//! instantaneous compliances and their fluidities, and of a sum only the sum is seen. The same goes
//! for the equilibrium stiffnesses and the bare dashpots of parallel parts.

use std::ops::Range;

use crate::{Canonical, LinearModel, Primitive, Tree};

/// Parameters that cannot all be told apart from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Entangled {
    /// Paths of the parameters, such as `kelvin.spring`.
    pub parameters: Vec<String>,
    /// What can be told of them: the constants of the smallest network that does the same, with
    /// their paths in it. Fewer than the parameters; none where they do not matter at all.
    pub combinations: Vec<(String, Primitive)>,
}

/// Groups of parameters of a model that cannot all be told apart from outside, the largest ones only; none if all can
/// be. `leaf` says what the parts are; rigid links and zero constants are no parameters.
///
/// # Examples
///
/// Of two springs in series, only `1/(1/k₁ + 1/k₂)` can be told:
///
/// ```
/// use dashpot_rheology::{Primitive::Spring, Tree, identifiability::entangled};
///
/// let springs = Tree::series([Spring(2e6).into(), Spring(6e6).into()]);
/// let [pair] = &entangled(&springs, |&part| part)[..] else { panic!() };
/// assert_eq!(pair.parameters, ["1", "2"]);
/// assert_eq!(pair.combinations, [("spring".to_owned(), Spring(1.5e6))]);
/// ```
pub fn entangled<P>(tree: &Tree<P>, leaf: impl Fn(&P) -> Primitive) -> Vec<Entangled> {
    let mut next = 0;
    let whole = tree.fold(
        |part| {
            let part = leaf(part);
            let first = next;
            next += usize::from(is_parameter(part));
            Seen { constants: constants(part), parameters: first..next, groups: Vec::new() }
        },
        composed,
    );
    if whole.groups.is_empty() {
        return Vec::new();
    }
    let parts = tree.parts().into_iter().map(|(path, part)| (path, leaf(part)));
    let paths: Vec<String> =
        parts.filter(|part| is_parameter(part.1)).map(|(path, _)| path).collect();
    whole.groups.iter().map(|group| group.told(&paths, &leaf)).collect()
}

/// What is seen of a part of a model.
struct Seen<'t, P> {
    constants: Constants,
    /// Numbers of its parameters.
    parameters: Range<usize>,
    groups: Vec<Group<'t, P>>,
}

/// Which single constants a part has.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Constants {
    Some {
        /// Instantaneous compliance, a spring in the Kelvin form; else the Maxwell form has a dashpot.
        yields_at_once: bool,
        /// Long-time fluidity, a dashpot in the Kelvin form; else the Maxwell form has a spring.
        flows: bool,
    },
    /// Nothing moves it.
    Rigid,
    /// It bears no force.
    Nothing,
}

/// Branches of one composition that share what is seen of them.
struct Group<'t, P> {
    node: &'t Tree<P>,
    branches: Vec<usize>,
    parameters: Vec<Range<usize>>,
    /// Whether nothing of them is seen.
    is_hidden: bool,
}

impl<P> Group<'_, P> {
    fn told(&self, paths: &[String], leaf: &impl Fn(&P) -> Primitive) -> Entangled {
        let numbers = self.parameters.iter().cloned().flatten();
        let parameters = numbers.map(|at| paths[at].clone()).collect();
        if self.is_hidden {
            return Entangled { parameters, combinations: Vec::new() };
        }
        let branches = self.node.branches();
        let models: Vec<LinearModel> =
            self.branches.iter().map(|&at| LinearModel::of(&branches[at].tree, leaf)).collect();
        let tree = if self.node.is_series() {
            LinearModel::series(&models).tree(Canonical::Kelvin)
        } else {
            LinearModel::parallel(&models).tree(Canonical::Maxwell)
        };
        let named = |(path, part): (String, &Primitive)| match part {
            _ if !path.is_empty() => (path, *part),
            Primitive::Spring(_) => ("spring".to_owned(), *part),
            _ => ("dashpot".to_owned(), *part),
        };
        let combinations = tree.as_ref().map(Tree::parts).unwrap_or_default();
        Entangled { parameters, combinations: combinations.into_iter().map(named).collect() }
    }
}

/// Whether it is a parameter of its model.
fn is_parameter(part: Primitive) -> bool {
    match part {
        Primitive::Spring(constant) | Primitive::Dashpot(constant) => constant > 0.0,
        Primitive::Rigid => false,
    }
}

fn constants(part: Primitive) -> Constants {
    match part {
        Primitive::Rigid => Constants::Rigid,
        _ if !is_parameter(part) => Constants::Nothing,
        Primitive::Spring(_) => Constants::Some { yields_at_once: true, flows: false },
        Primitive::Dashpot(_) => Constants::Some { yields_at_once: false, flows: true },
    }
}

fn composed<'t, P>(node: &'t Tree<P>, mut parts: Vec<Seen<'t, P>>) -> Seen<'t, P> {
    let in_series = node.is_series();
    let start = parts.first().map_or(0, |part| part.parameters.start);
    let parameters = start..parts.last().map_or(start, |part| part.parameters.end);
    // In a series what bears nothing decides alone and what is rigid does not matter; in parallel
    // it is the other way round.
    let (alone, neutral) = if in_series {
        (Constants::Nothing, Constants::Rigid)
    } else {
        (Constants::Rigid, Constants::Nothing)
    };
    let group = |branches: Vec<usize>, parts: &[Seen<'t, P>], is_hidden| Group {
        node,
        parameters: branches.iter().map(|&at| parts[at].parameters.clone()).collect(),
        branches,
        is_hidden,
    };
    if parts.iter().any(|part| part.constants == alone) {
        let hidden =
            (!parameters.is_empty()).then(|| group((0..parts.len()).collect(), &parts, true));
        return Seen { constants: alone, parameters, groups: hidden.into_iter().collect() };
    }
    // The constants that add up: compliance and fluidity in a series, stiffness and damping side by side.
    let adds = |own: Constants, which: usize| match own {
        Constants::Some { yields_at_once, flows } => [yields_at_once, flows][which] == in_series,
        Constants::Rigid | Constants::Nothing => false,
    };
    let sharing = [0, 1].map(|which| -> Vec<usize> {
        (0..parts.len()).filter(|&at| adds(parts[at].constants, which)).collect()
    });
    let [yields_at_once, flows] = [0, 1].map(|which| sharing[which].is_empty() != in_series);
    let is_neutral = parts.iter().all(|part| part.constants == neutral);
    let constants = if is_neutral { neutral } else { Constants::Some { yields_at_once, flows } };
    let mut groups: Vec<Vec<usize>> = sharing.into_iter().filter(|own| own.len() > 1).collect();
    if let [first, second] = &groups[..]
        && first.iter().any(|at| second.contains(at))
    {
        let mut both = [first.as_slice(), second.as_slice()].concat();
        both.sort_unstable();
        both.dedup();
        groups = vec![both];
    }
    // What was entangled within a branch is so within the group as well.
    for &at in groups.iter().flatten() {
        parts[at].groups.clear();
    }
    let own: Vec<Group<'t, P>> =
        groups.into_iter().map(|branches| group(branches, &parts, false)).collect();
    let inner = parts.into_iter().flat_map(|part| part.groups);
    Seen { constants, parameters, groups: inner.chain(own).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::tests::trees;
    use Primitive::{Dashpot, Rigid, Spring};

    fn told(tree: &Tree<Primitive>) -> Vec<(Vec<String>, Vec<String>)> {
        let groups = entangled(tree, |&part| part).into_iter();
        groups
            .map(|group| {
                (group.parameters, group.combinations.into_iter().map(|it| it.0).collect())
            })
            .collect()
    }

    fn maxwell() -> Tree<Primitive> {
        Tree::series([Spring(2.0).into(), Dashpot(3.0).into()])
    }

    proptest::proptest! {
        /// What cannot be told is what a tree has more than the smallest network.
        #[test]
        fn parameters_less_what_is_lost_are_the_least_number_of_elements(tree in trees()) {
            let model = LinearModel::of(&tree, |&part| part);
            proptest::prop_assume!(model.merged().is_empty());
            let lost: usize = entangled(&tree, |&part| part)
                .iter()
                .map(|own| own.parameters.len() - own.combinations.len())
                .sum();
            proptest::prop_assert_eq!(tree.parts().len() - lost, model.least_elements());
        }
    }

    #[test]
    fn burgers_and_prony_can_be_told_entirely() {
        let kelvin = Tree::parallel([Spring(1.0).into(), Dashpot(2.0).into()]);
        assert!(told(&Tree::series([Spring(3.0).into(), Dashpot(4.0).into(), kelvin])).is_empty());
        assert!(told(&Tree::parallel([Spring(3.0).into(), maxwell(), maxwell()])).is_empty());
    }

    #[test]
    fn a_spring_before_a_zener_element_is_entangled_with_all_of_it() {
        // Four parameters, but one mode: an instantaneous and an equilibrium stiffness and a time.
        let zener = Tree::parallel([Spring(1.0).into(), maxwell()]);
        let [(parameters, combinations)] = &told(&Tree::series([Spring(5.0).into(), zener]))[..]
        else {
            panic!()
        };
        assert_eq!(parameters, &["1", "2.1", "2.2.1", "2.2.2"]);
        assert_eq!(combinations, &["spring", "kelvin.spring", "kelvin.dashpot"]);
    }

    #[test]
    fn springs_and_dashpots_are_entangled_among_themselves() {
        let row = [Spring(1.0), Dashpot(2.0), Spring(3.0), Dashpot(4.0)].map(Tree::from);
        let groups = told(&Tree::series(row));
        let of = |names: [&str; 2], whole: &str| {
            (names.map(str::to_owned).to_vec(), vec![whole.to_owned()])
        };
        assert_eq!(groups, [of(["1", "3"], "spring"), of(["2", "4"], "dashpot")]);
    }

    #[test]
    fn what_is_short_circuited_or_cut_off_is_not_seen() {
        let short = Tree::parallel([maxwell(), Rigid.into()]);
        assert_eq!(
            told(&Tree::series([short, Spring(1.0).into()])),
            [(vec!["1.1.1".to_owned(), "1.1.2".to_owned()], vec![])]
        );
        let cut = Tree::series([Spring(0.0).into(), Dashpot(1.0).into()]);
        assert_eq!(
            told(&Tree::parallel([cut, Spring(1.0).into()])),
            [(vec!["1.2".to_owned()], vec![])]
        );
    }
}
