//! What a scene says, in lines: section, name, and the words of the text with the units in which they stand there.

use std::sync::Arc;

use dashpot_network::{effects::EFFECTS, parameters::registered};

use crate::{
    diagnostics::Faults,
    text::{
        document::{Content, Entry, Item, parse},
        source::Source,
    },
};

/// Of longer lists only the ends are told.
const MOST: usize = 6;

/// What a table says where it is a value of a measure, and not a table of measures.
const OF_MEASURES: [&str; 6] = ["kind", "max", "min", "standard", "from", "mean"];

/// One line of an outline.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutlineRow {
    /// The section of the scene.
    pub section: String,
    /// What it is about: a node, an element, an effect with its element, a measure.
    pub name: String,
    /// What is said of it, for instance `mass 5 kg, drop 1.5 m`, with no-break spaces before units.
    pub words: String,
}

/// What the text of a scene says, in its order, with the values `set` in place of those under `[values]`.
///
/// # Examples
///
/// ```
/// use dashpot_scene::outline;
///
/// let text = "[elements]\npad = { between = [\"head\", \"ground\"], spring = \"60 kN/m\" }";
/// let rows = outline(text, &[]);
/// assert_eq!((&*rows[0].section, &*rows[0].name), ("elements", "pad"));
/// assert_eq!(rows[0].words, "head → ground, spring 60\u{a0}kN/m");
/// ```
pub fn outline(text: &str, set: &[(String, String)]) -> Vec<OutlineRow> {
    let root = parse(&Arc::new(Source::new("", text)), &Faults::default());
    let sections = root.as_ref().and_then(Item::table).unwrap_or(&[]);
    let mut rows = Vec::new();
    for section in sections {
        let outline = Outline { text, section: &section.key, set };
        for entry in section.item.table().unwrap_or(&[]) {
            outline.add(entry.key.to_string(), entry, &mut rows);
        }
    }
    rows
}

struct Outline<'t> {
    text: &'t str,
    section: &'t str,
    set: &'t [(String, String)],
}

impl Outline<'_> {
    fn add(&self, name: String, entry: &Entry, rows: &mut Vec<OutlineRow>) {
        if let Some(inner) = entry.item.table().filter(|inner| self.holds_rows(&name, inner)) {
            for own in inner {
                self.add(format!("{name}.{}", own.key), own, rows);
            }
            return;
        }
        // The last one counts.
        let set = self.set.iter().rev().find(|own| self.section == "values" && own.0 == name);
        let words = set.map_or_else(|| self.words(&entry.item), |own| own.1.clone());
        rows.push(OutlineRow { section: self.section.to_owned(), name, words });
    }

    /// Whether the entries of a table are what rows are about, and not the table itself.
    fn holds_rows(&self, name: &str, entries: &[Entry]) -> bool {
        match self.section {
            "effects" => registered(EFFECTS, name).is_some_and(|own| own.about.is_per_element),
            "measures" | "limits" | "accuracy" => {
                !entries.iter().any(|own| OF_MEASURES.contains(&own.key.as_str()))
            }
            _ => false,
        }
    }

    fn words(&self, item: &Item) -> String {
        match &item.value {
            Content::Text(_) | Content::Number(_) | Content::Date => self.leaf(item),
            Content::Switch(is_on) => if *is_on { "on" } else { "off" }.to_owned(),
            Content::Table(entries) => {
                entries.iter().map(|own| self.pair(own)).collect::<Vec<_>>().join(", ")
            }
            Content::List(items) if items.len() > MOST => {
                let [first, second, .., last] = &**items else { return String::new() };
                let [first, second, last] = [first, second, last].map(|own| self.part(own));
                format!("{first}, {second}, … {last}: {} in all", items.len())
            }
            Content::List(items) => {
                items.iter().map(|own| self.part(own)).collect::<Vec<_>>().join(", ")
            }
        }
    }

    /// A text or a number as it stands there: one with scatter is read as its mean.
    fn leaf(&self, item: &Item) -> String {
        let place = item.place.start as usize..item.place.end as usize;
        let raw = self.text.get(place).unwrap_or_default().trim_matches(['"', '\'']);
        let text = item.text().filter(|_| raw.contains('\\')).unwrap_or(raw);
        // A number stays together with its unit.
        let is_quantity = text.starts_with(|first: char| first.is_ascii_digit());
        if is_quantity { text.replace(' ', "\u{a0}") } else { text.to_owned() }
    }

    /// An entry of a table: its key and its value, but for the ends of an element, which need no key.
    fn pair(&self, entry: &Entry) -> String {
        match &entry.item.value {
            Content::List(ends) if entry.key == "between" => {
                ends.iter().map(|own| self.words(own)).collect::<Vec<_>>().join(" → ")
            }
            Content::List(_) | Content::Table(_) => {
                format!("{} ({})", entry.key.as_str(), self.words(&entry.item))
            }
            _ => format!("{} {}", entry.key.as_str(), self.words(&entry.item)),
        }
    }

    /// An item of a list, in brackets where it has several parts.
    fn part(&self, item: &Item) -> String {
        let is_many = match &item.value {
            Content::Table(entries) => entries.len() > 1,
            Content::List(_) => true,
            _ => false,
        };
        let words = self.words(item);
        if is_many { format!("({words})") } else { words }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"
title = "A pad"
[values]
K = "25 ± 2.5 kN/m"
T = "2 cm"
[models.foam]
series = [{ spring = "K" }, { parallel = [{ spring = 4e3 }, { dashpot = "20 N s/m" }], name = "b" }]
[nodes]
head = { mass = "5 kg", drop = "1.5 m" }
free = {}
[elements]
pad = { between = ["head", "ground"], model = "foam", thickness = "T" }
[effects]
gravity = { value = "1 g0" }
separation.pad = true
[loads.push]
on = "head"
force = { table = { points = [[0, 0], [1, 1], [2, 1], [3, 1], [4, 1], [5, 1], [6, "0 N"]] } }
[measures]
head = ["hic15", { kind = "clip", time = "3 ms" }]
[limits]
head.peak-acceleration = { max = "250 g", from = "mine" }
"pad.peak-force" = "3 kN"
[accuracy]
default = "1 %"
[run]
duration = "20 ms"
methods = ["exact", "bdf"]
"#;

    fn row(set: &[(String, String)], section: &str, name: &str) -> String {
        let rows = outline(SCENE, set);
        let found = rows.iter().find(|own| own.section == section && own.name == name);
        let found = found.unwrap_or_else(|| panic!("{section} {name}: {rows:#?}"));
        found.words.replace('\u{a0}', " ")
    }

    #[test]
    fn rows_have_the_words_and_units_of_the_text() {
        for (section, name, words) in [
            ("values", "K", "25 ± 2.5 kN/m"),
            ("values", "T", "2 cm"),
            (
                "models",
                "foam",
                "series (spring K, (parallel (spring 4e3, dashpot 20 N s/m), name b))",
            ),
            ("nodes", "head", "mass 5 kg, drop 1.5 m"),
            ("nodes", "free", ""),
            ("elements", "pad", "head → ground, model foam, thickness T"),
            ("effects", "gravity", "value 1 g0"),
            ("effects", "separation.pad", "on"),
            (
                "loads",
                "push",
                "on head, force (table (points ((0, 0), (1, 1), … (6, 0 N): 7 in all)))",
            ),
            ("measures", "head", "hic15, (kind clip, time 3 ms)"),
            ("limits", "head.peak-acceleration", "max 250 g, from mine"),
            ("limits", "pad.peak-force", "3 kN"),
            ("accuracy", "default", "1 %"),
            ("run", "methods", "exact, bdf"),
        ] {
            assert_eq!(row(&[], section, name), words, "{section} {name}");
        }
    }

    #[test]
    fn what_is_set_stands_in_place_of_the_text() {
        let set = |text: &str| ("K".to_owned(), text.to_owned());
        let set = [set("1 N/m"), set("30 kN/m")];
        assert_eq!(row(&set, "values", "K"), "30 kN/m");
        assert_eq!(row(&set, "values", "T"), "2 cm");
    }

    #[test]
    fn rows_stand_in_the_order_of_the_text() {
        let sections: Vec<String> =
            outline(SCENE, &[]).into_iter().map(|own| own.section).collect();
        let mut places = sections.iter().map(|own| SCENE.find(&format!("[{own}")).unwrap());
        let mut last = 0;
        assert!(places.all(|place| std::mem::replace(&mut last, place) <= place), "{sections:?}");
    }
}
