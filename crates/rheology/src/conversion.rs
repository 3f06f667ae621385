//! Models in another form: the canonical ones, and the named ones of the register.

use std::fmt;

use thiserror::Error;

use crate::{Canonical, FORMS, LinearModel, Part, Primitive, Role, Tree, forms};

/// A form that models can be brought into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Target {
    /// Its word, such as `generalized-maxwell` or `burgers`.
    pub word: &'static str,
    /// Other words for it.
    pub aliases: &'static [&'static str],
    /// One line on what it is.
    pub summary: &'static str,
    arrangement: Arrangement,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Arrangement {
    Canonical(Canonical),
    Named { parts: &'static [Part], in_series: bool },
}

/// What a canonical form consists of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shape {
    /// Which form.
    pub form: Canonical,
    /// Whether it has a single spring.
    pub has_spring: bool,
    /// Whether it has a single dashpot.
    pub has_dashpot: bool,
    /// Number of its Maxwell or Kelvin–Voigt elements.
    pub elements: usize,
}

/// Why a model cannot be brought into a form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Unfit {
    /// A rigid link in the Maxwell form, or what bears no force in the Kelvin form.
    #[error("{}", match .0 {
        Canonical::Maxwell => "a rigid link has no Maxwell form",
        Canonical::Kelvin => "a model that bears no force has no Kelvin form",
    })]
    NoSuchForm(Canonical),
    /// The model has other constants than the form.
    #[error("the form is {wanted}; the model is {found}")]
    OtherShape {
        /// What the form consists of.
        wanted: Shape,
        /// What the model consists of in the canonical form of that kind.
        found: Shape,
    },
}

impl fmt::Display for Shape {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = match self.form {
            Canonical::Maxwell => "Maxwell",
            Canonical::Kelvin => "Kelvin-Voigt",
        };
        let elements = match self.elements {
            0 => None,
            1 => Some(format!("a {word} element")),
            count => Some(format!("{count} {word} elements")),
        };
        let parts = [
            self.has_spring.then(|| "a spring".to_owned()),
            self.has_dashpot.then(|| "a dashpot".to_owned()),
            elements,
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        let place = match self.form {
            Canonical::Maxwell => "in parallel",
            Canonical::Kelvin => "in series",
        };
        match &parts[..] {
            [] => formatter.write_str("nothing"),
            [only] => formatter.write_str(only),
            [firsts @ .., last] => write!(formatter, "{} and {last} {place}", firsts.join(", ")),
        }
    }
}

impl Target {
    /// All forms: the canonical ones first.
    pub fn all() -> Vec<Self> {
        let canonical = [
            Self {
                word: "generalized-maxwell",
                aliases: &["prony"],
                summary: "a spring, a dashpot and Maxwell elements in parallel",
                arrangement: Arrangement::Canonical(Canonical::Maxwell),
            },
            Self {
                word: "generalized-kelvin",
                aliases: &["generalized-kelvin-voigt", "kelvin-chain"],
                summary: "a spring, a dashpot and Kelvin-Voigt elements in series",
                arrangement: Arrangement::Canonical(Canonical::Kelvin),
            },
        ];
        let named = FORMS.iter().map(|own| Self {
            word: own.word,
            aliases: own.aliases,
            summary: own.summary,
            arrangement: Arrangement::Named { parts: own.parts, in_series: own.in_series },
        });
        canonical.into_iter().chain(named).collect()
    }

    /// The form of this word or alias.
    pub fn named(word: &str) -> Option<Self> {
        Self::all().into_iter().find(|own| own.word == word || own.aliases.contains(&word))
    }
}

/// The smallest network in the form `target` that does what `model` does, with parts and branches
/// named as in that form.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::{LinearModel, Primitive::{Dashpot, Spring}, Tree, conversion::{Target, converted}};
///
/// let kelvin = Tree::parallel([Spring(3.0).into(), Dashpot(6.0).into()]);
/// let solid = LinearModel::of(&Tree::series([Spring(6.0).into(), kelvin]), |&part| part);
/// let zener = converted(&solid, &Target::named("zener").unwrap())?;
/// // K₀ = k₁k₂/(k₁ + k₂) = 2, K₁ = k₁ − K₀ = 4, C₁ = c (k₁/(k₁ + k₂))² = 8/3.
/// assert_eq!(zener.parts()[0], ("spring".to_owned(), &Spring(2.0)));
/// assert_eq!(zener.parts()[1].0, "maxwell.spring");
/// # Ok::<(), dashpot_rheology::conversion::Unfit>(())
/// ```
///
/// # Errors
///
/// [`Unfit`] when the model has other constants than the form.
pub fn converted(model: &LinearModel, target: &Target) -> Result<Tree<Primitive>, Unfit> {
    let (parts, in_series) = match target.arrangement {
        Arrangement::Canonical(form) => {
            return model.tree(form).ok_or(Unfit::NoSuchForm(form));
        }
        Arrangement::Named { parts, in_series } => (parts, in_series),
    };
    let form = if in_series { Canonical::Kelvin } else { Canonical::Maxwell };
    let constants = Constants::of(model, form).ok_or(Unfit::NoSuchForm(form))?;
    let mut slots = Slots { form, spring: 0, dashpot: 0, elements: 0, paths: Vec::new() };
    slots.read(&mut Vec::new(), parts, in_series);
    let (wanted, found) = (slots.shape(), constants.shape(form));
    if wanted != found {
        return Err(Unfit::OtherShape { wanted, found });
    }
    let value = |path: &[&'static str], role| {
        let slot = slots.paths.iter().find(|own| own.0 == path).map_or(Slot::Single, |path| path.1);
        let (spring, dashpot) = match slot {
            Slot::Single => (constants.spring, constants.dashpot),
            Slot::Element(at) => constants.elements[at],
        };
        Ok(if role == Role::Spring {
            Primitive::Spring(spring)
        } else {
            Primitive::Dashpot(dashpot)
        })
    };
    forms::build(parts, in_series, &mut { value })
}

/// Values of a canonical form.
struct Constants {
    spring: f64,
    dashpot: f64,
    elements: Vec<(f64, f64)>,
}

impl Constants {
    fn of(model: &LinearModel, form: Canonical) -> Option<Self> {
        let tree = model.tree(form)?;
        let mut own = Self { spring: 0.0, dashpot: 0.0, elements: Vec::new() };
        let is_whole = |node: &Tree<Primitive>| match form {
            Canonical::Maxwell => matches!(node, Tree::Parallel(_)),
            Canonical::Kelvin => matches!(node, Tree::Series(_)),
        };
        let nodes: Vec<&Tree<Primitive>> = if is_whole(&tree) {
            tree.branches().iter().map(|branch| &branch.tree).collect()
        } else {
            vec![&tree]
        };
        for node in nodes {
            match (node, node.branches()) {
                (Tree::Part(Primitive::Spring(stiffness)), _) => own.spring = *stiffness,
                (Tree::Part(Primitive::Dashpot(damping)), _) => own.dashpot = *damping,
                (_, [spring, dashpot]) => {
                    if let (Tree::Part(Primitive::Spring(k)), Tree::Part(Primitive::Dashpot(c))) =
                        (&spring.tree, &dashpot.tree)
                    {
                        own.elements.push((*k, *c));
                    }
                }
                _ => {}
            }
        }
        Some(own)
    }

    fn shape(&self, form: Canonical) -> Shape {
        Shape {
            form,
            has_spring: self.spring > 0.0,
            has_dashpot: self.dashpot > 0.0,
            elements: self.elements.len(),
        }
    }
}

/// Which constant a part of a named form takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Slot {
    Single,
    Element(usize),
}

/// The parts of a named form by the constants that they take.
struct Slots {
    form: Canonical,
    spring: usize,
    dashpot: usize,
    elements: usize,
    paths: Vec<(Vec<&'static str>, Slot)>,
}

impl Slots {
    /// Parts within a form of the same direction stand in its row; a form of the other direction is an element.
    fn read(&mut self, path: &mut Vec<&'static str>, parts: &[Part], in_series: bool) {
        for part in parts {
            path.push(part.name);
            match part.role {
                Role::Spring => {
                    self.spring += 1;
                    self.paths.push((path.clone(), Slot::Single));
                }
                Role::Dashpot => {
                    self.dashpot += 1;
                    self.paths.push((path.clone(), Slot::Single));
                }
                Role::Form { parts: inner, in_series: inner_in_series } => {
                    if inner_in_series == in_series {
                        self.read(path, inner, in_series);
                    } else {
                        for own in inner {
                            let inner_path = [path.as_slice(), &[own.name]].concat();
                            self.paths.push((inner_path, Slot::Element(self.elements)));
                        }
                        self.elements += 1;
                    }
                }
            }
            path.pop();
        }
    }

    fn shape(&self) -> Shape {
        Shape {
            form: self.form,
            has_spring: self.spring > 0,
            has_dashpot: self.dashpot > 0,
            elements: self.elements,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{equivalence::compare, sensitivity::sensitivity};

    /// A tree of a named form with constants that nothing else explains.
    fn sample(target: &Target) -> Option<Tree<Primitive>> {
        let Arrangement::Named { parts, in_series } = target.arrangement else { return None };
        let mut at = 0.0;
        let mut value = |_: &[&'static str], role| {
            at += 1.0;
            let constant = 1e3 * f64::sqrt(at + 1.7);
            Ok::<_, ()>(match role {
                Role::Spring => Primitive::Spring(constant),
                _ => Primitive::Dashpot(constant),
            })
        };
        forms::build(parts, in_series, &mut value).ok()
    }

    #[test]
    fn every_form_comes_back_as_itself() {
        for target in Target::all() {
            let Some(tree) = sample(&target) else { continue };
            let back = converted(&LinearModel::of(&tree, |&part| part), &target).unwrap();
            for ((path, part), (back_path, back)) in tree.parts().iter().zip(back.parts()) {
                assert_eq!(path, &back_path, "{}", target.word);
                let [found, expected] = [back, *part].map(|own| match own {
                    Primitive::Spring(own) | Primitive::Dashpot(own) => *own,
                    Primitive::Rigid => f64::NAN,
                });
                assert!((found / expected - 1.0).abs() < 1e-15, "{} {path}", target.word);
            }
            // A form with more parameters than can be told apart would have no map to itself.
            let own = sensitivity(&tree, |&part| part).unwrap();
            assert!(own.map_to(&own).is_some(), "{}", target.word);
        }
    }

    #[test]
    fn what_can_be_converted_is_the_same() {
        let mut counts = (0, 0);
        for from in Target::all() {
            let Some(tree) = sample(&from) else { continue };
            let model = LinearModel::of(&tree, |&part| part);
            for to in Target::all() {
                match converted(&model, &to) {
                    Ok(other) => {
                        let other = LinearModel::of(&other, |&part| part);
                        assert!(compare(&model, &other).is_same, "{} to {}", from.word, to.word);
                        counts.0 += 1;
                    }
                    Err(unfit) => {
                        assert!(unfit.to_string().contains("the form is"), "{unfit}");
                        counts.1 += 1;
                    }
                }
            }
        }
        assert!(counts.0 >= 15 && counts.1 >= 15, "{counts:?}");
    }

    #[test]
    fn a_misfit_says_what_there_is_and_what_is_wanted() {
        let zener = sample(&Target::named("zener").unwrap()).unwrap();
        let model = LinearModel::of(&zener, |&part| part);
        let unfit = converted(&model, &Target::named("burgers").unwrap()).unwrap_err();
        assert_eq!(
            unfit.to_string(),
            "the form is a spring, a dashpot and a Kelvin-Voigt element in series; \
             the model is a spring and a Kelvin-Voigt element in series"
        );
    }
}
