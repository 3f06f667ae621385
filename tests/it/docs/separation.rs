//! The chapter on separation and thickness shows what the command prints, and its tables what the
//! scenes yield.

use std::fs;

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

use super::{OUTDATED, blocks, is_update, root, shown::check, text};
use crate::scenes::scene_path;

const CHAPTER: &str = "docs/separation-and-thickness.md";

/// A scene solved by the first of its methods.
fn solved(text: &str) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let scene = scene.value;
    let settings = scene.settings(&scene.run.methods[0]).unwrap();
    scene.network.solve_with(&settings).unwrap()
}

fn measure(run: &RunReport, key: &str) -> f64 {
    run.measure(key).unwrap_or_else(|| panic!("no {key}")).value.unwrap()
}

/// The value of an output at a time, and its least value in the run.
fn signal(run: &RunReport, output: &str, time: f64) -> (f64, f64) {
    let number = run.assembly.output(output).unwrap();
    let signal = run.trajectory.signal(&run.assembly.system, number);
    (signal.value(time), signal.minimum((0.0, run.trajectory.t_end)).value)
}

/// A table with one column for each run.
fn table(names: &[&str], rows: &[(&str, Vec<String>)]) -> String {
    let mut all = format!("| | {} |\n|---{}|\n", names.join(" | "), "|---".repeat(names.len()));
    for (what, cells) in rows {
        all.extend(["| ", what, " | ", &cells.join(" | "), " |\n"]);
    }
    all
}

fn separation() -> String {
    let runs = ["reference", "thesis-separation"]
        .map(|name| solved(&fs::read_to_string(scene_path(name)).unwrap()));
    let row = |of: &dyn Fn(&RunReport) -> String| runs.iter().map(of).collect::<Vec<_>>();
    let peak = |run: &RunReport| format!("{:.6} kN", 1e-3 * measure(run, "padding.peak-force"));
    let deepest =
        |run: &RunReport| format!("{:.6} mm", 1e3 * measure(run, "padding.peak-deformation"));
    let release = |run: &RunReport| format!("{:.9} ms", 1e3 * measure(run, "padding.contact-time"));
    let severity = |run: &RunReport| format!("{:.4} s", measure(run, "head.severity-index"));
    let pull = |run: &RunReport| match -signal(run, "padding.force", 0.0).1 {
        pull if pull > 1e-9 => format!("{:.3} kN", 1e-3 * pull),
        _ => "0 kN".to_owned(),
    };
    let speed = |run: &RunReport| format!("{:.6} m/s", -signal(run, "head.velocity", 0.02).0);
    let left =
        |run: &RunReport| format!("{:.4} mm", 1e3 * signal(run, "padding.deformation", 0.02).0);
    let energy = |run: &RunReport| format!("{:.4} J", measure(run, "padding.energy-at-end"));
    table(
        &["glued", "with separation"],
        &[
            ("peak force in the padding", row(&peak)),
            ("deepest point", row(&deepest)),
            ("force is zero at", row(&release)),
            ("severity index", row(&severity)),
            ("largest pull of the padding", row(&pull)),
            ("speed of the head at 20 ms, away", row(&speed)),
            ("padding pressed in at 20 ms", row(&left)),
            ("energy in the padding at 20 ms", row(&energy)),
        ],
    )
}

fn thickness() -> String {
    let [soft] = &blocks(CHAPTER, "toml soft.toml")[..] else { panic!("no soft padding") };
    let runs =
        [soft.clone(), text("scenes/thesis-stop.toml"), text("scenes/thesis-stiffening.toml")]
            .map(|text| solved(&text));
    let row = |of: &dyn Fn(&RunReport) -> String| runs.iter().map(of).collect::<Vec<_>>();
    let deepest = |run: &RunReport| {
        let deepest = measure(run, "padding.peak-deformation");
        format!("{:.2} mm, {:.0} %", 1e3 * deepest, 1e2 * deepest / 0.02)
    };
    let peak = |run: &RunReport| {
        let number = run.assembly.output("padding.contact.force").unwrap();
        let force = run.trajectory.signal(&run.assembly.system, number);
        format!("{:.1} kN", 1e-3 * force.maximum((0.0, 0.02)).value)
    };
    let peak_g =
        |run: &RunReport| format!("{:.0} g", measure(run, "head.peak-acceleration") / 9.806_65);
    let severity = |run: &RunReport| format!("{:.0} s", measure(run, "head.severity-index"));
    assert!(measure(&runs[0], "padding.peak-deformation") > 0.02, "nothing to be kept within");
    for run in &runs[1..] {
        assert!(measure(run, "padding.peak-deformation") < 0.02, "beyond the thickness");
    }
    table(
        &["d = 60 as it is", "with a stop at 18 mm", "with a stiffening spring"],
        &[
            ("deepest point, in parts of the thickness", row(&deepest)),
            ("peak force on the head", row(&peak)),
            ("peak acceleration", row(&peak_g)),
            ("severity index", row(&severity)),
        ],
    )
}

/// Holds a generated table against the runs, or brings it up to date.
fn check_table(name: &str, new: &str) {
    let chapter = text(CHAPTER);
    let mark = format!("<!-- generated: {name} -->\n");
    let (before, rest) = chapter.split_once(&mark).unwrap();
    let (old, after) = rest.split_once("<!-- end -->").unwrap();
    if is_update() {
        let all = format!("{before}{mark}{new}<!-- end -->{after}");
        fs::write(root().join(CHAPTER), all).unwrap();
    } else {
        assert_eq!(old, new, "{OUTDATED}");
    }
}

#[test]
fn the_chapter_on_separation_shows_what_the_command_prints_and_draws_and_what_the_runs_yield() {
    let (texts, figures) = check(CHAPTER);
    assert!(texts >= 5 && figures >= 5, "{texts} texts, {figures} figures");
    // After the texts, as both may write to the chapter.
    check_table("separation", &separation());
    check_table("thickness", &thickness());
}
