//! The chapter on sweeps shows what the command prints and draws.

use super::shown;

#[test]
fn the_chapter_on_sweeps_shows_what_the_command_prints_and_draws() {
    let (texts, figures) = shown::check("docs/sweeps.md");
    assert!(texts >= 6 && figures == 3, "{texts} texts, {figures} figures");
}
