//! The measured part of the chapter on what accuracy costs.
//!
//! `UPDATE_DOCS=1 cargo test --test it -- docs::cost --ignored` measures it again and writes it, figures
//! included. Times belong to the machine, so nothing else compares them.

use std::{fmt::Write as _, fs, process::Command};

use super::{is_update, root, text};
use crate::scenes::scene_path;

const CHAPTER: &str = "docs/accuracy-and-cost.md";
const PLACE: (&str, &str) = ("<!-- measured: cost -->", "<!-- end -->");
/// Scenes with what they stand for.
const SCENES: [(&str, &str); 4] = [
    ("reference", "The reference impact: linear"),
    ("reference-stiff", "The same with a stiff mount"),
    ("helmet-drop", "A helmet that bottoms out: it switches"),
    ("knee-crash", "A knee under a measured pulse: driven by 61 rows"),
];
/// Figures that `cost` draws, with the name under which they are kept.
const FIGURES: [(&str, &str); 2] =
    [("error-time.svg", "measures"), ("state-error-time.svg", "state")];

#[test]
#[ignore = "measures times"]
fn what_accuracy_costs_is_measured() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = String::new();
    for (scene, title) in SCENES {
        let path = scene_path(scene);
        let out = folder.path().join(scene);
        let mut dashpot = Command::new(env!("CARGO_BIN_EXE_dashpot"));
        let done = dashpot.arg("cost").arg(&path).arg("--out").arg(&out).output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let shown = String::from_utf8(done.stdout).unwrap();
        let (_, sentence) = shown.split_once("\n\nFor all measures").unwrap();
        let (sentence, _) = sentence.split_once("\n\n").unwrap();
        let _ = writeln!(all, "\n**{title}** (`dashpot cost {scene} --out cost`).\n");
        let _ = writeln!(all, "```text\nFor all measures{sentence}\n```");
        for (figure, name) in FIGURES {
            let kept = format!("figures/cost-{scene}-{name}.svg");
            if is_update() {
                fs::copy(out.join(figure), root().join("docs").join(&kept)).unwrap();
            }
            let _ = writeln!(all, "\n![{title}: error of the {name} over time]({kept})");
        }
    }
    if is_update() {
        let own = text(CHAPTER);
        let (head, rest) = own.split_once(PLACE.0).unwrap();
        let (_, tail) = rest.split_once(PLACE.1).unwrap();
        fs::write(root().join(CHAPTER), format!("{head}{}\n{all}\n{}{tail}", PLACE.0, PLACE.1))
            .unwrap();
    }
}
