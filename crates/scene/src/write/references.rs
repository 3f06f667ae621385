//! References to other files, as they stand in the text of a scene.

use toml_edit::{
    DocumentMut, Item, KeyMut, Value,
    visit_mut::{VisitMut, visit_item_mut},
};

use crate::text::library::{
    models::MODEL_SECTIONS,
    tables::{FILE, WORDS_OF_POINTS},
};

/// The text where each path in `table-spring = "path"`, `file = "path"`, `model = "path:name"` and `material =
/// "path:name"` stands as `renamed` says; where that is `None` it stays. All else, comments included, is as it was.
///
/// # Examples
///
/// ```
/// use dashpot_scene::with_paths;
///
/// let text = "[models]\nfelt = { table-spring = \"felt.csv\" } # as measured\n";
/// let moved = with_paths(text, &|path| Some(format!("../{path}")));
/// assert_eq!(moved, "[models]\nfelt = { table-spring = \"../felt.csv\" } # as measured\n");
/// ```
pub fn with_paths(text: &str, renamed: &dyn Fn(&str) -> Option<String>) -> String {
    let Ok(mut document) = text.parse::<DocumentMut>() else { return text.to_owned() };
    let mut paths =
        Paths { renamed, words: WORDS_OF_POINTS.iter().copied().chain([FILE]).collect() };
    paths.visit_document_mut(&mut document);
    document.to_string()
}

struct Paths<'p> {
    renamed: &'p dyn Fn(&str) -> Option<String>,
    /// The keys of files of numbers.
    words: Vec<&'static str>,
}

impl Paths<'_> {
    fn moved(&self, key: &str, text: &str) -> Option<String> {
        if MODEL_SECTIONS.iter().any(|section| section.word() == key) {
            let (path, name) = text.rsplit_once(':')?;
            return Some(format!("{}:{name}", (self.renamed)(path)?));
        }
        if self.words.contains(&key) { (self.renamed)(text) } else { None }
    }
}

impl VisitMut for Paths<'_> {
    fn visit_table_like_kv_mut(&mut self, key: KeyMut<'_>, node: &mut Item) {
        let moved = node.as_str().and_then(|text| self.moved(key.get(), text));
        match (moved, node.as_value_mut()) {
            (Some(moved), Some(value)) => {
                let decor = value.decor().clone();
                *value = Value::from(moved);
                *value.decor_mut() = decor;
            }
            _ => visit_item_mut(self, node),
        }
    }
}
