//! Colours, drawings and warnings on the two streams.

use std::{fs, process::Stdio};

use tempfile::TempDir;

use super::{code, command, err, out, run};

#[test]
#[cfg(unix)]
fn where_both_streams_are_one_a_warning_is_read_once() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("both");
    let both = fs::File::create(&path).unwrap();
    let mut run = command(&["run"]);
    run.stdout(both.try_clone().unwrap()).stderr(both);
    assert!(run.status().unwrap().success());
    let read = fs::read_to_string(&path).unwrap();
    assert_eq!(read.matches("the padding is in tension: separation is off").count(), 1, "{read}");
}

#[test]
fn colours_come_when_they_are_asked_for() {
    assert!(out(&run(&["run", "--color", "always"])).contains('\u{1b}'));
    assert!(!out(&run(&["run", "--color", "never"])).contains('\u{1b}'));
}

#[test]
fn plot_is_drawn_when_it_is_asked_for() {
    let plotted = out(&run(&["run", "--plot", "always"]));
    assert!(plotted.contains("force (kN)"));
    assert!(plotted.lines().all(|line| line.chars().count() <= 80), "{plotted}");
    assert!(!out(&run(&["run"])).contains("force (kN)"));
}

#[test]
fn reader_that_goes_away_is_no_error() {
    let mut child =
        command(&["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), err(&output).as_str()), (0, ""));
}
