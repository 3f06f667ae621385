//! Scenes that come with the crate.

/// A scene that comes with the crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shipped {
    /// Its word, for instance `impact`.
    pub name: &'static str,
    /// One line on what it shows.
    pub summary: &'static str,
    /// The text.
    pub text: &'static str,
}

macro_rules! shipped {
    ($name:literal, $summary:literal) => {
        Shipped {
            name: $name,
            summary: $summary,
            text: include_str!(concat!("../templates/", $name, ".toml")),
        }
    };
}

const TEMPLATES: &[Shipped] = &[
    shipped!("impact", "a moving mass, a pad and its support"),
    shipped!("drop", "a fall onto a foam liner that separates and bottoms out"),
    shipped!("chain", "a chain of masses with one model between them"),
    shipped!("force-table", "a force given by a table, and a base with a given motion"),
];

const REFERENCES: &[Shipped] = &[
    shipped!("reference", "the thesis' head against a padded car panel"),
    shipped!("reference-stiff", "the same with the support damping that the thesis prints"),
    shipped!("reference-gravity", "the same with gravity, starting in balance"),
];

/// Commented scenes to start from.
pub fn templates() -> &'static [Shipped] {
    TEMPLATES
}

/// The text of the template of this name.
pub fn template(name: &str) -> Option<&'static str> {
    TEMPLATES.iter().find(|shipped| shipped.name == name).map(|shipped| shipped.text)
}

/// The reference scenes, the built-in one first.
pub fn references() -> &'static [Shipped] {
    REFERENCES
}

/// The text of the built-in reference scene.
pub fn reference() -> &'static str {
    REFERENCES[0].text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, read};

    #[test]
    fn every_shipped_scene_is_valid_and_without_warning() {
        for shipped in TEMPLATES.iter().chain(REFERENCES) {
            let options = ReadOptions { file: Some(shipped.name), ..ReadOptions::default() };
            let checked = read(shipped.text, &options).unwrap_or_else(|errors| panic!("{errors}"));
            assert!(checked.warnings.is_empty(), "{}", checked.warnings);
            assert!(checked.value.title.is_some() && checked.value.run.duration > 0.0);
        }
        assert!(template("impact").is_some() && template("none").is_none());
    }
}
