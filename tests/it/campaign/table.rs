//! Scenes with the values of the reference, as its script writes them.

use std::collections::BTreeMap;

/// A scene, and what is true of it.
pub(super) struct Entry {
    /// Its seed and kind.
    pub(super) name: String,
    pub(super) text: String,
    /// Measures: key, value, and the threshold about it.
    pub(super) values: Vec<(String, f64, f64)>,
}

impl Entry {
    /// The entries of a table: `### name`, the text, `---`, and lines of values. Each measure is asked for over the
    /// whole run, but for those of the impact, which every run has; `@` goes before `impact` and before a cap.
    pub(super) fn all(table: &str) -> impl Iterator<Item = Self> {
        table.split("### ").skip(1).map(|block| {
            let (name, rest) = block.split_once('\n').expect("a name");
            let (text, values) = rest.split_once("---\n").expect("values");
            let mut wishes: BTreeMap<&str, Vec<String>> = BTreeMap::new();
            let values = values.lines().map(|line| {
                let [key, value, threshold] = *line.split(' ').collect::<Vec<_>>() else {
                    panic!("{name}: {line}")
                };
                if key.ends_with("@impact") || key.ends_with("contact-time") {
                    return (key.to_owned(), value.parse().unwrap(), threshold.parse().unwrap());
                }
                let (key, cap) = key.split_once('@').unwrap_or((key, ""));
                let (of, kind) = key.rsplit_once('.').expect("a kind");
                let cap = if cap.is_empty() { String::new() } else { format!(", cap = {cap}") };
                let wish = format!("{{ kind = \"{kind}\", window = \"run\"{cap} }}");
                wishes.entry(of).or_default().push(wish);
                (key.to_owned(), value.parse().unwrap(), threshold.parse().unwrap())
            });
            let values = values.collect();
            let wishes = wishes.iter().map(|(of, own)| format!("{of} = [{}]\n", own.join(", ")));
            let text = format!("{text}[measures]\n{}", wishes.collect::<String>());
            Self { name: name.to_owned(), text, values }
        })
    }
}
