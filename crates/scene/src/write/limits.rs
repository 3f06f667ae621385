//! Limits as they stand in the text of a scene.

use std::collections::BTreeMap;

use dashpot_analysis::Limit;
use dashpot_network::parameters::{Dimension, Value};
use toml_edit::{Array, DocumentMut, Item, TableLike};

use super::{quoted, write_value};
use crate::sections::unit_wanted;

const LIMITS: &str = "limits";

/// The text of a scene with these limits besides its own; all else is as it was.
///
/// # Examples
///
/// ```
/// use dashpot_scene::{parse_limits, with_limits};
///
/// let limits = parse_limits("head.hic15<=700").unwrap();
/// let text = with_limits("[limits] # of the head\n\"head.clip-3ms\" = \"60 g\"\n", &limits);
/// assert!(text.starts_with("[limits] # of the head\n\"head.clip-3ms\" = \"60 g\"\n\"head.hic15\" = [{ max = 700"));
/// ```
pub fn with_limits(text: &str, all: &[Limit]) -> String {
    let documents = [text, &section(all)].map(str::parse::<DocumentMut>);
    let [Ok(mut document), Ok(further)] = documents else { return text.to_owned() };
    let further = further.get(LIMITS).and_then(Item::as_table_like);
    for (key, item) in further.into_iter().flat_map(TableLike::iter) {
        let table = document.entry(LIMITS).or_insert_with(toml_edit::table);
        let Some(table) = table.as_table_like_mut() else { continue };
        let known = table.get(key).and_then(Item::as_value).cloned();
        let mut list = match known {
            Some(toml_edit::Value::Array(own)) => own,
            Some(own) => Array::from_iter([own]),
            None => Array::new(),
        };
        list.extend(item.as_array().into_iter().flatten().cloned());
        table.insert(key, toml_edit::value(list));
    }
    document.to_string()
}

/// Limits with their units, those on one measure in one list.
pub(super) fn section(limits: &[Limit]) -> String {
    let mut by_key: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for limit in limits {
        let level = limit.bound.level();
        let dimension = limit.measure().and_then(|kind| unit_wanted(kind, level));
        let dimension = dimension.unwrap_or(Dimension::NUMBER);
        let level = write_value(&Value::Number(level), dimension, Dimension::TIME);
        let mut pairs = vec![format!("{} = {level}", limit.bound.word())];
        pairs.extend(limit.from.iter().map(|from| format!("from = {}", quoted(from))));
        pairs.extend(limit.of_mean.then(|| "mean = true".to_owned()));
        by_key.entry(&limit.key).or_default().push(format!("{{ {} }}", pairs.join(", ")));
    }
    if by_key.is_empty() {
        return String::new();
    }
    let lines = by_key.iter().map(|(key, all)| format!("{} = [{}]\n", quoted(key), all.join(", ")));
    format!("\n[{LIMITS}]\n") + &lines.collect::<String>()
}
