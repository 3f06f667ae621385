//! The page that the outcomes are kept on.

use std::{env, fs, path::PathBuf, sync::Mutex};

/// Only one section is written at a time.
static WRITING: Mutex<()> = Mutex::new(());

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/hard-cases.md")
}

/// Writes a section of the page if it is to be brought up to date, else says what differs.
pub(super) fn hold(section: &str, text: &str) -> Vec<String> {
    let _guard = WRITING.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let page = fs::read_to_string(path()).unwrap();
    let mark = format!("<!-- generated: {section} -->\n");
    let (before, rest) =
        page.split_once(&mark).unwrap_or_else(|| panic!("{section} is not on the page"));
    let (old, after) = rest.split_once("<!-- end -->").unwrap();
    if env::var_os("UPDATE_DOCS").is_some() {
        fs::write(path(), format!("{before}{mark}{text}<!-- end -->{after}")).unwrap();
        return Vec::new();
    }
    let (mut old, mut new) = (old.lines(), text.lines());
    let mut differences = Vec::new();
    loop {
        match (old.next(), new.next()) {
            (None, None) => return differences,
            (Some(old), Some(new)) if is_kept(old, new) => {}
            (old, new) => differences.push(format!(
                "docs/hard-cases.md has\n  {}\nbut the run gives\n  {}",
                old.unwrap_or("nothing"),
                new.unwrap_or("nothing")
            )),
        }
    }
}

/// Whether a line says the same as before, with errors that are no larger.
fn is_kept(old: &str, new: &str) -> bool {
    if !old.starts_with('|') {
        return shape(old) == shape(new);
    }
    let (old, new): (Vec<&str>, Vec<&str>) = (old.split('|').collect(), new.split('|').collect());
    old.len() == new.len()
        && old.iter().zip(&new).enumerate().all(|(at, (old, new))| {
            // The first two cells are names.
            if at < 3 { old == new } else { is_kept_cell(old, new) }
        })
}

fn is_kept_cell(old: &str, new: &str) -> bool {
    let (old, new): (Vec<&str>, Vec<&str>) =
        (old.split_whitespace().collect(), new.split_whitespace().collect());
    let number = |word: &str| word.trim_matches(['(', ')', '≤']).parse::<f64>().ok();
    old.len() == new.len()
        && old.iter().zip(&new).all(|(old, new)| match (number(old), number(new)) {
            (Some(old), Some(new)) => new <= old,
            _ => old == new,
        })
}

/// The words of a text, without what differs from machine to machine.
pub(super) fn shape(text: &str) -> String {
    text.split_whitespace().filter(|word| !word.contains(|c: char| c.is_ascii_digit())).collect()
}

#[test]
fn a_larger_error_or_another_word_is_not_kept() {
    let old = "| name 1 | judge | right 1e-9 (1e-7) | declines |";
    assert!(is_kept(old, "| name 1 | judge | right 1e-10 (1e-7) | declines |"));
    assert!(!is_kept(old, "| name 1 | judge | right 1e-8 (1e-7) | declines |"));
    assert!(!is_kept(old, "| name 1 | judge | right 1e-9 (1e-7) | fails |"));
    assert!(!is_kept(old, "| name 2 | judge | right 1e-9 (1e-7) | declines |"));
}
