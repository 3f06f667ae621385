//! Forms of linear models, by their constants.

use dashpot_network::{Model, dashpot, spring};

use crate::network::Number;

/// Words of all forms, and what they are. **A new form is registered here**, in `Shape` and in its model.
pub const KNOWN: &[(&str, &str)] = &[
    ("spring", "a spring"),
    ("kelvin-voigt", "a spring and a dashpot in parallel"),
    ("maxwell", "a spring and a dashpot in series"),
    ("zener", "a spring, and a Maxwell element in parallel"),
    ("burgers", "a Maxwell element and a Kelvin–Voigt element in series"),
    ("prony", "a spring and two Maxwell elements in parallel; `prony-3` has three of them"),
];

/// Branches of `prony` without a number, and the most.
const BRANCHES: usize = 2;
const MOST_BRANCHES: usize = 8;
/// A constant may be so many times larger or smaller than what is guessed.
const WIDE: f64 = 100.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Spring,
    KelvinVoigt,
    Maxwell,
    Zener,
    Burgers,
    Prony(usize),
}

/// A form of a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Form {
    word: String,
    shape: Shape,
}

/// A constant of a form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Constant {
    /// Its name: `k1`, `c1`.
    pub name: String,
    /// Whether it is that of a spring \[N/m\], else of a dashpot \[N s/m\].
    pub is_spring: bool,
}

impl Form {
    /// That of a word; `None` where there is none.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_fit::among::Form;
    ///
    /// assert_eq!(Form::named("zener").unwrap().constants().len(), 3);
    /// assert_eq!(Form::named("prony-4").unwrap().constants().len(), 9);
    /// assert!(Form::named("prony-0").is_none() && Form::named("foam").is_none());
    /// ```
    pub fn named(word: &str) -> Option<Self> {
        let shape = match word {
            "spring" => Shape::Spring,
            "kelvin-voigt" => Shape::KelvinVoigt,
            "maxwell" => Shape::Maxwell,
            "zener" => Shape::Zener,
            "burgers" => Shape::Burgers,
            "prony" => Shape::Prony(BRANCHES),
            _ => {
                let count = word.strip_prefix("prony-")?.parse().ok()?;
                (1..=MOST_BRANCHES).contains(&count).then_some(Shape::Prony(count))?
            }
        };
        Some(Self { word: word.to_owned(), shape })
    }

    /// Its word.
    pub fn word(&self) -> &str {
        &self.word
    }

    /// Its constants, in the order of their values.
    pub fn constants(&self) -> Vec<Constant> {
        let own = |name: &str| Constant { name: name.to_owned(), is_spring: name.starts_with('k') };
        match self.shape {
            Shape::Spring => vec![own("k")],
            Shape::KelvinVoigt | Shape::Maxwell => vec![own("k"), own("c")],
            Shape::Zener => vec![own("k"), own("k1"), own("c1")],
            Shape::Burgers => ["k1", "c1", "k2", "c2"].map(own).to_vec(),
            Shape::Prony(count) => {
                let branch = |at: usize| [format!("k{at}"), format!("c{at}")];
                let branches = (1..=count).flat_map(branch).map(|name| own(&name));
                std::iter::once(own("k")).chain(branches).collect()
            }
        }
    }

    /// The model with these values of its constants in SI units; those that are not there are zero.
    pub fn model(&self, values: &[f64]) -> Model {
        let of = |at: usize| values.get(at).copied().unwrap_or(0.0);
        let (k, c) = (|at: usize| spring(of(at)), |at: usize| dashpot(of(at)));
        let branch = |at: usize| Model::series([k(at), c(at + 1)]);
        match self.shape {
            Shape::Spring => k(0),
            Shape::KelvinVoigt => Model::parallel([k(0), c(1)]),
            Shape::Maxwell => branch(0),
            Shape::Zener => Model::parallel([k(0), branch(1)]),
            Shape::Burgers => Model::series([k(0), c(1), Model::parallel([k(2), c(3)])]),
            Shape::Prony(count) => {
                let branches = (0..count).map(|at| branch(2 * at + 1));
                Model::parallel(std::iter::once(k(0)).chain(branches))
            }
        }
    }

    /// Its constants as numbers that are searched, about a stiffness \[N/m\] and with times between two \[s\].
    pub fn numbers(&self, stiffness: f64, [fast, slow]: [f64; 2]) -> Vec<Number> {
        let constants = self.constants();
        let dashpots = constants.iter().filter(|own| !own.is_spring).count();
        let mut passed = 0;
        let number = |own: &Constant| {
            if own.is_spring {
                return Number { low: stiffness / WIDE, high: stiffness * WIDE, start: stiffness };
            }
            // Spread evenly over the decades.
            passed += 1;
            let part = f64::from(u32::try_from(passed).unwrap_or(u32::MAX)) / (dashpots + 1) as f64;
            let start = stiffness * fast * (slow / fast).powf(part);
            Number { low: stiffness * fast / WIDE, high: stiffness * slow * WIDE, start }
        };
        constants.iter().map(number).collect()
    }
}

#[cfg(test)]
mod tests {
    use dashpot_network::linear_model;

    use super::*;

    /// Relaxation of each form by its closed form.
    #[test]
    fn models_are_those_of_their_words() {
        let at = 0.01_f64;
        let decayed = |k: f64, c: f64| k * (-at * k / c).exp();
        let relaxed = |word: &str, values: &[f64]| {
            let form = Form::named(word).unwrap();
            assert_eq!(form.constants().len(), values.len(), "{word}");
            linear_model(&form.model(values)).relaxation(at)
        };
        let alike =
            |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
        alike(relaxed("spring", &[3e3]), 3e3);
        alike(relaxed("kelvin-voigt", &[3e3, 20.0]), 3e3);
        alike(relaxed("maxwell", &[3e3, 20.0]), decayed(3e3, 20.0));
        alike(relaxed("zener", &[1e3, 3e3, 20.0]), 1e3 + decayed(3e3, 20.0));
        let prony = [1e3, 3e3, 20.0, 5e3, 90.0];
        alike(relaxed("prony", &prony), 1e3 + decayed(3e3, 20.0) + decayed(5e3, 90.0));
        let burgers = Form::named("burgers").unwrap().model(&[2e3, 50.0, 4e3, 10.0]);
        let creep = 1.0 / 2e3 + at / 50.0 - (-at * 4e3 / 10.0).exp_m1() / 4e3;
        alike(linear_model(&burgers).creep(at), creep);
    }

    #[test]
    fn every_word_of_the_register_has_a_form_whose_start_lies_between_its_bounds() {
        for (word, _) in KNOWN {
            let form = Form::named(word).unwrap();
            for own in form.numbers(1e4, [1e-3, 0.1]) {
                assert!(own.low < own.start && own.start < own.high, "{word}: {own:?}");
            }
        }
    }
}
