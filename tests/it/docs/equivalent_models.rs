//! The chapter on equivalent models shows what the command prints.

use std::fs;

use super::{
    blocks,
    shown::{check, printed},
    text,
};

const CHAPTER: &str = "docs/equivalent-models.md";

#[test]
fn the_chapter_on_equivalent_models_shows_what_the_command_prints() {
    let (texts, _) = check(CHAPTER);
    assert!(texts >= 8, "{texts}");
}

#[test]
fn a_fibre_takes_as_many_elements_as_the_chapter_says() {
    let chapter = text(CHAPTER);
    let row = |start: &str| -> Vec<&str> {
        let line = chapter.lines().find(|line| line.starts_with(start)).unwrap();
        line.split('|').skip(2).map(str::trim).filter(|cell| !cell.is_empty()).collect()
    };
    let [scene] = &blocks(CHAPTER, "toml fibre-padding.toml")[..] else { panic!("no such scene") };
    let folder = tempfile::tempdir().unwrap();
    let (errors, counts) = (row("| `error` |"), row("| Kelvin elements |"));
    assert!(errors.len() == counts.len() && counts.len() >= 4);
    for (error, count) in errors.iter().zip(counts) {
        assert!(scene.contains("\"0.002 %\""));
        let other = scene.replace("0.002 %", error);
        fs::write(folder.path().join("fibre.toml"), other).unwrap();
        let said = printed("dashpot explain fibre.toml", folder.path());
        assert!(
            said.contains(&format!("`fibre`: {count} Kelvin elements keep")),
            "{error}: {said}"
        );
    }
}
