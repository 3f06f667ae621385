//! Chapters whose every text and picture comes from the command.

use super::shown;

/// Chapters with how many texts and figures they show.
const CHAPTERS: [(&str, usize, usize); 21] = [
    ("quick-start", 4, 1),
    ("vibration", 4, 1),
    ("thesis", 1, 4),
    ("sweeps", 8, 3),
    ("gradients", 1, 0),
    ("fit", 6, 0),
    ("design", 8, 0),
    ("cushion", 6, 4),
    ("similarity", 6, 0),
    ("injury-measures", 1, 0),
    ("scatter", 1, 0),
    ("signal", 5, 2),
    ("tutorial-drop-test", 3, 1),
    ("tutorial-master-curve", 3, 1),
    ("cannot-tell", 6, 1),
    ("jobs/protector", 4, 0),
    ("jobs/parcel", 6, 2),
    ("jobs/liners", 4, 2),
    ("jobs/dma", 2, 0),
    ("jobs/designs", 1, 0),
    ("jobs/thesis-figure", 0, 2),
];

#[test]
fn chapters_show_what_the_command_prints_and_draws() {
    for (chapter, texts, figures) in CHAPTERS {
        let found = shown::check(&format!("docs/{chapter}.md"));
        assert_eq!(found, (texts, figures), "{chapter}");
    }
}
