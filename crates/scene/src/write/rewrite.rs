//! Texts with another model in the place of one of theirs.

use dashpot_network::Model;
use toml_edit::{Decor, DocumentMut, Item, Key, RawString, Table, TableLike};

use super::{write_material_table, write_model_table};
use crate::NamedModel;

/// What an element keeps when its model is replaced.
const KEPT: [&str; 2] = ["between", "thickness"];

/// `text` with `model` in the place of `named`, which was read from it. All else stays as it is, and comments within
/// the old model stand, together with `comment`, before the new one. An older comment that begins with the same two
/// words, and goes on with the same two after its semicolon, is what an earlier rewriting said, and is replaced.
///
/// `None` where the text does not have this model.
///
/// # Examples
///
/// ```
/// use dashpot_network::{elements::Spring, part};
/// use dashpot_scene::{ReadOptions, read_named_model, with_model};
///
/// let text = "[models]\n# of the lining\npad = { spring = \"2 kN/m\" }\nother = { spring = 1 }\n";
/// let pad = read_named_model(text, "pad", &ReadOptions::default())?.value;
/// let other = with_model(text, &pad, &part(Spring { stiffness: 3e3 }), "stiffer");
/// assert_eq!(
///     other.unwrap(),
///     "[models]\n# of the lining\n# stiffer\npad = { spring = \"3 kN/m\" }\nother = { spring = 1 }\n"
/// );
/// # Ok::<(), dashpot_scene::Diagnostics>(())
/// ```
pub fn with_model(text: &str, named: &NamedModel, model: &Model, comment: &str) -> Option<String> {
    let mut document: DocumentMut = text.parse().ok()?;
    let (law, value) = law(named, model)?;
    let kept = if named.section == "elements" { &KEPT[..] } else { &[] };
    let owner = document.get_mut(named.section)?.as_table_like_mut()?;
    let (mut key, item) = owner.get_key_value_mut(&named.name)?;
    let is_section = item.is_table();
    let table = item.as_table_like_mut()?;
    let words = |text: &str| text.split(' ').take(2).collect::<Vec<_>>().join(" ");
    let (start, after) = (words(comment), comment.split_once("; ").map_or("", |own| own.1));
    let (start, after) = (format!("# {start} "), format!("; {} ", words(after)));
    let is_old = |line: &str| line.starts_with(&start) && line.contains(&after);
    let mut lines = String::new();
    for line in replaced(table, kept).iter().map(String::as_str).chain([comment]) {
        let line = format!("# {line}\n");
        if line == format!("# {comment}\n") || !is_old(&line) {
            lines += &line;
        }
    }
    table.insert(&law, value);
    if is_section {
        // Within the table, which has its own lines.
        table.key_mut(&law)?.leaf_decor_mut().set_prefix(lines);
    } else {
        if let Some(inline) = item.as_inline_table_mut() {
            inline.fmt();
        }
        let decor = key.leaf_decor_mut();
        let before = decor.prefix().and_then(|own| own.as_str()).unwrap_or_default();
        let is_kept = |line: &&str| !is_old(line.trim_start());
        let before: String = before.split_inclusive('\n').filter(is_kept).collect();
        decor.set_prefix(before + &lines);
    }
    Some(document.to_string())
}

/// The key and value of the law of `model`.
fn law(named: &NamedModel, model: &Model) -> Option<(String, Item)> {
    let write = if named.is_material { write_material_table } else { write_model_table };
    let text = write("model", model, &[]);
    let (_, law) = text.split_once('\n')?;
    let table: Table = law.parse::<DocumentMut>().ok()?.as_table().clone();
    let (key, item) = table.iter().next()?;
    Some((key.to_owned(), item.clone()))
}

/// Takes everything but `kept` out of `table`, and returns its comments.
fn replaced(table: &mut dyn TableLike, kept: &[&str]) -> Vec<String> {
    let keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    let mut comments = Vec::new();
    for key in keys.iter().filter(|key| !kept.contains(&key.as_str())) {
        let prefix = table.key(key).map(|own| own.leaf_decor().clone());
        comments.extend(comments_beside(prefix.as_ref()));
        if let Some(item) = table.remove(key) {
            collect(&item, &mut comments);
        }
    }
    comments
}

/// Collects the comments within and around an item; sections within it hold their own.
fn collect(item: &Item, comments: &mut Vec<String>) {
    let mut within = |table: &Table| {
        comments.extend(comments_beside(Some(table.decor())));
        for (key, item) in table {
            comments.extend(comments_beside(table.key(key).map(Key::leaf_decor)));
            collect(item, comments);
        }
    };
    match item {
        Item::Table(table) => within(table),
        Item::ArrayOfTables(tables) => tables.iter().for_each(within),
        Item::Value(value) => comments.extend(comments_in(&value.to_string())),
        Item::None => {}
    }
}

fn comments_beside(decor: Option<&Decor>) -> Vec<String> {
    let text = |part: Option<&RawString>| part.and_then(|part| part.as_str().map(comments_in));
    let parts = decor.map(|decor| [text(decor.prefix()), text(decor.suffix())]);
    parts.into_iter().flatten().flatten().flatten().collect()
}

/// The comments in a piece of TOML, without their marks.
fn comments_in(text: &str) -> Vec<String> {
    let mut comments = Vec::new();
    for line in text.lines() {
        let mut quote = None;
        for (at, mark) in line.char_indices() {
            match (mark, quote) {
                ('#', None) => {
                    comments.push(line[at + 1..].trim().to_owned());
                    break;
                }
                ('"' | '\'', None) => quote = Some(mark),
                (_, Some(open)) if open == mark => quote = None,
                _ => {}
            }
        }
    }
    comments
}

#[cfg(test)]
mod tests {
    use dashpot_network::{elements::Spring, part};

    use super::*;
    use crate::{ReadOptions, read_named_model};

    const TEXT: &str = r##"title = "a # is no comment here"   # but this is one

[models.pad]        # from the sample of May
# two layers
series = [
  { spring = "2 kN/m", name = "#1" },  # the skin
  { spring = "2 kN/m" },
]

[materials]
foam = { spring = "2 MPa" }

[nodes]
head = { mass = "5 kg", velocity = "2 m/s" }

[elements]
padding = { between = ["head", "ground"], model = "pad", thickness = "2 cm" }
"##;

    fn with(name: &str) -> String {
        let named = read_named_model(TEXT, name, &ReadOptions::default()).unwrap().value;
        let text = with_model(TEXT, &named, &part(Spring { stiffness: 1e3 }), "half as stiff");
        let text = text.unwrap();
        let again = read_named_model(&text, name, &ReadOptions::default()).unwrap().value;
        assert_eq!(again.is_material, named.is_material);
        text
    }

    #[test]
    fn a_model_keeps_its_place_and_its_comments() {
        let expected = TEXT.replace(
            r##"# two layers
series = [
  { spring = "2 kN/m", name = "#1" },  # the skin
  { spring = "2 kN/m" },
]
"##,
            "# two layers\n# the skin\n# half as stiff\nspring = \"1 kN/m\"\n",
        );
        assert_eq!(with("pad"), expected);
    }

    #[test]
    fn a_material_stays_one() {
        let expected = TEXT.replace(
            "foam = { spring = \"2 MPa\" }",
            "# half as stiff\nfoam = { spring = \"1 kPa\" }",
        );
        assert_eq!(with("foam"), expected);
    }

    #[test]
    fn an_element_keeps_its_ends() {
        let expected = TEXT.replace(
            "padding = { between = [\"head\", \"ground\"], model = \"pad\", thickness = \"2 cm\" }",
            "# half as stiff\npadding = { between = [\"head\", \"ground\"], thickness = \"2 cm\", spring = \"1 kN/m\" }",
        );
        assert_eq!(with("padding"), expected);
    }
}
