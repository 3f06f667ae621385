//! Reads `effects_reference.csv`, which an independent script has written to 20 digits.

use std::{collections::HashMap, sync::LazyLock};

const TABLE: &str = include_str!("../effects_reference.csv");

static CASES: LazyLock<HashMap<&str, Case>> = LazyLock::new(|| {
    let mut cases: HashMap<&str, Case> = HashMap::new();
    for line in TABLE.lines().skip_while(|line| line.starts_with('#')).skip(1) {
        let [name, quantity, value] = *line.split(',').collect::<Vec<_>>() else {
            panic!("{line} has not three parts")
        };
        let case = cases.entry(name).or_insert_with(|| Case { name, values: HashMap::new() });
        case.values.insert(quantity, value.parse().unwrap());
    }
    cases
});

/// One case of the table.
#[derive(Debug)]
pub(super) struct Case {
    pub(super) name: &'static str,
    values: HashMap<&'static str, f64>,
}

impl Case {
    pub(super) fn of(name: &str) -> &'static Self {
        CASES.get(name).unwrap_or_else(|| panic!("no case {name}"))
    }

    /// A result.
    pub(super) fn get(&self, quantity: &str) -> f64 {
        self.find(quantity).unwrap_or_else(|| panic!("{} has no {quantity}", self.name))
    }

    pub(super) fn find(&self, quantity: &str) -> Option<f64> {
        self.values.get(quantity).copied()
    }

    /// An input.
    pub(super) fn param(&self, name: &str) -> f64 {
        self.get(&format!("param.{name}"))
    }

    /// A number of events.
    pub(super) fn count(&self, quantity: &str) -> usize {
        self.get(quantity) as usize
    }

    /// `text` with each `<name>` replaced by that input, to the last digit.
    pub(super) fn fill(&self, text: &str) -> String {
        let mut parts = text.split('<');
        let mut filled = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (name, rest) = part.split_once('>').expect("a closing bracket");
            filled.extend([&*format!("{:?}", self.param(name)), rest]);
        }
        filled
    }
}
