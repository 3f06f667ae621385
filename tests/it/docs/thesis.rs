//! The chapter on the thesis shows what the command prints and draws.

use super::shown;

#[test]
fn the_chapter_on_the_thesis_shows_what_the_command_prints() {
    let (texts, figures) = shown::check("docs/thesis.md");
    assert!(texts == 1 && figures >= 4, "{texts} texts, {figures} figures");
}
