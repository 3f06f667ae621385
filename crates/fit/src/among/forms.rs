//! Forms of linear models, by their constants.

use dashpot_network::{Model, dashpot, spring};

use crate::network::Number;

/// Words of all forms, and what they are. Each has those with fewer constants as limits, where a constant is none or very
/// large. **A new form is registered here**, and in `Form::named`.
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

/// A form of a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Form {
    word: String,
    /// Whether its groups stand in series, each of them in parallel, or the other way round.
    is_series: bool,
    groups: Vec<Vec<String>>,
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
        let of = |groups: &[&[&str]]| -> Vec<Vec<String>> {
            groups.iter().map(|own| own.iter().map(ToString::to_string).collect()).collect()
        };
        let prony = |count: usize| {
            let branches = (1..=count).map(|at| vec![format!("k{at}"), format!("c{at}")]);
            of(&[&["k"]]).into_iter().chain(branches).collect()
        };
        let groups = match word {
            "spring" => of(&[&["k"]]),
            "kelvin-voigt" => of(&[&["k"], &["c"]]),
            "maxwell" => of(&[&["k", "c"]]),
            "zener" => of(&[&["k"], &["k1", "c1"]]),
            "burgers" => of(&[&["k1"], &["c1"], &["k2", "c2"]]),
            "prony" => prony(BRANCHES),
            _ => {
                let count = word.strip_prefix("prony-")?.parse().ok()?;
                (1..=MOST_BRANCHES).contains(&count).then(|| prony(count))?
            }
        };
        Some(Self { word: word.to_owned(), is_series: word == "burgers", groups })
    }

    /// Its word.
    pub fn word(&self) -> &str {
        &self.word
    }

    /// Its constants, in the order of their values.
    pub fn constants(&self) -> Vec<Constant> {
        let own = |name: &String| Constant { name: name.clone(), is_spring: name.starts_with('k') };
        self.groups.iter().flatten().map(own).collect()
    }

    /// The model with these values of its constants in SI units; those that are not there are zero.
    pub fn model(&self, values: &[f64]) -> Model {
        let mut values = values.iter().copied();
        let mut part = |name: &String| {
            let value = values.next().unwrap_or(0.0);
            if name.starts_with('k') { spring(value) } else { dashpot(value) }
        };
        let join = |is_series: bool, mut parts: Vec<Model>| match parts.len() {
            1 => parts.swap_remove(0),
            _ if is_series => Model::series(parts),
            _ => Model::parallel(parts),
        };
        let groups = self.groups.iter();
        let groups = groups.map(|own| join(!self.is_series, own.iter().map(&mut part).collect()));
        join(self.is_series, groups.collect())
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
