//! Measures and parameters in words, as titles and axes have them.

use dashpot_analysis::sweep::Column;

pub(super) use dashpot_report::layout::capital;

/// Tables of a scene, whose names lead to what stands in them and say nothing of it.
const TABLES: [&str; 10] = [
    "nodes",
    "elements",
    "models",
    "materials",
    "effects",
    "loads",
    "motions",
    "supports",
    "values",
    "run",
];
/// Words that are nothing but the value of what stands before.
const BARE: [&str; 1] = ["value"];

/// A measure in words: `peak force of padding`.
pub(super) fn quantity(column: &Column) -> String {
    let Some((target, kind)) = column.key.rsplit_once('.') else { return spaced(&column.key) };
    let kind = match kind {
        index if index.starts_with("hic") => index.to_uppercase(),
        kind => spaced(kind),
    };
    let of = format!("{kind} of {target}");
    if column.is_share { format!("{of} over its thickness") } else { of }
}

/// A parameter in words: `maxwell spring of padding` for `padding.maxwell.spring`, a name of `[values]` as it is.
pub(super) fn parameter(path: &str) -> String {
    let mut parts: Vec<&str> = path.split('.').collect();
    if parts.len() > 1 && TABLES.contains(&parts[0]) {
        parts.remove(0);
    }
    if parts.len() > 1 && parts.last().is_some_and(|last| BARE.contains(last)) {
        parts.pop();
    }
    match &parts[..] {
        [own] => (*own).to_owned(),
        [owner, rest @ ..] => {
            let rest: Vec<String> = rest.iter().map(|own| spaced(own)).collect();
            format!("{} of {owner}", rest.join(" "))
        }
        [] => path.to_owned(),
    }
}

/// Parameters in words, with what they have in common told once: `maxwell spring and kelvin dashpot of padding`.
pub(super) fn parameters(paths: &[&str]) -> String {
    let words: Vec<String> = paths.iter().map(|path| parameter(path)).collect();
    let owner = |own: &String| own.rsplit_once(" of ").map(|own| own.1.to_owned());
    let last = words.last().and_then(owner);
    let shared = last.filter(|last| words.iter().all(|own| owner(own).as_ref() == Some(last)));
    let Some(shared) = shared else { return words.join(" and ") };
    let end = format!(" of {shared}");
    let bare: Vec<&str> = words.iter().map(|own| own.strip_suffix(&end).unwrap_or(own)).collect();
    bare.join(" and ") + &end
}

fn spaced(word: &str) -> String {
    word.replace('-', " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_told_in_words() {
        let told =
            |key: &str, is_share: bool| quantity(&Column { key: key.into(), unit: "N", is_share });
        assert_eq!(told("padding.peak-force", false), "peak force of padding");
        assert_eq!(
            told("padding.peak-deformation", true),
            "peak deformation of padding over its thickness"
        );
        assert_eq!(told("head.hic15", false), "HIC15 of head");
        assert_eq!(capital("élan of pad"), "Élan of pad");
    }

    #[test]
    fn paths_are_told_in_words() {
        for (path, right) in [
            ("K", "K"),
            ("head.velocity", "velocity of head"),
            ("nodes.head.velocity", "velocity of head"),
            ("padding.maxwell.spring", "maxwell spring of padding"),
            ("effects.gravity.value", "gravity"),
            ("run.duration", "duration"),
            ("rail.static-to-kinetic", "static to kinetic of rail"),
        ] {
            assert_eq!(parameter(path), right);
        }
        let both = parameters(&["padding.maxwell.spring", "padding.kelvin.dashpot"]);
        assert_eq!(both, "maxwell spring and kelvin dashpot of padding");
        assert_eq!(parameters(&["head.velocity", "K"]), "velocity of head and K");
    }
}
