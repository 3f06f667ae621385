//! The word that was probably meant.

use dashpot_units as units;

/// How many known words a message shows.
const SHOWN: usize = 20;

/// What other programs and books call a word.
const SYNONYMS: &[(&str, &str)] = &[
    ("damper", "dashpot"),
    ("damping", "dashpot"),
    ("viscosity", "dashpot"),
    ("c", "dashpot"),
    ("stiffness", "spring"),
    ("k", "spring"),
    ("speed", "velocity"),
    ("height", "drop"),
    ("peak-g", "peak-acceleration"),
    ("max-g", "peak-acceleration"),
];

/// The word that is known for what other programs and books call `word`.
pub(crate) fn synonym(word: &str) -> Option<&'static str> {
    SYNONYMS.iter().find(|entry| entry.0.eq_ignore_ascii_case(word)).map(|entry| entry.1)
}

/// The word of `known` that is nearest to `word`, if one is near, or means the same.
pub fn nearest<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let known = known.into_iter().collect::<Vec<_>>();
    let same = synonym(word).filter(|same| known.contains(same));
    same.or_else(|| units::nearest(word, known))
}

/// "did you mean …?" and the known words, as far as they fit into a line; `None` where none is known.
pub fn suggestion<S: AsRef<str>>(word: &str, family: &str, known: &[S]) -> Option<String> {
    if known.is_empty() {
        return None;
    }
    let listed = list(known);
    Some(match nearest(word, known.iter().map(AsRef::as_ref)) {
        Some(near) if known.len() == 1 => format!("did you mean `{near}`?"),
        Some(near) => format!("did you mean `{near}`? known {family}: {listed}"),
        None => format!("known {family}: {listed}"),
    })
}

/// The words in a row, cut after twenty.
pub(crate) fn list<S: AsRef<str>>(words: &[S]) -> String {
    let shown = words.iter().take(SHOWN).map(AsRef::as_ref).collect::<Vec<_>>().join(", ");
    match words.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_finds_its_word_and_a_stranger_finds_none() {
        let known = ["spring", "dashpot", "series", "parallel", "model"];
        assert_eq!(nearest("sprnig", known), Some("spring"));
        assert_eq!(nearest("Dashpot", known), Some("dashpot"));
        assert_eq!(nearest("serie", known), Some("series"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest("x", ["K", "C"]), None);
    }
}
