//! The chapter on vibration shows what the command prints and draws.

use super::shown;

#[test]
fn the_chapter_on_vibration_shows_what_the_command_prints() {
    let (texts, figures) = shown::check("docs/vibration.md");
    assert!(texts >= 2 && figures == 1, "{texts} texts, {figures} figures");
}
