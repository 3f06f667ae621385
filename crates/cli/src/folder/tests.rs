use tempfile::TempDir;

use super::*;

/// What a folder holds besides the lock and the list: names and contents.
fn held(path: &Path) -> Vec<(String, String)> {
    let mut held: Vec<_> = fs::read_dir(path)
        .unwrap()
        .map(Result::unwrap)
        .map(|own| (own.file_name().into_string().unwrap(), own.path()))
        .filter(|own| ![LOCK, ".dashpot-files"].contains(&own.0.as_str()))
        .map(|(name, path)| (name, fs::read_to_string(path).unwrap()))
        .collect();
    held.sort();
    held
}

fn open(path: &Path) -> Result<Folder, CliError> {
    Folder::open(path, ["a.csv", "b.csv"].map(str::to_owned))
}

/// Results of which `a.csv` and the result say `text`.
fn write(path: &Path, text: &str, others: &[&str]) -> Result<(), CliError> {
    let mut folder = open(path)?;
    let mut files = Staged::new(&mut folder)?;
    for name in ["a.csv"].iter().chain(others) {
        files.add(*name, text)?;
    }
    files.finish(text).map(drop)
}

fn pair(name: &str, text: &str) -> (String, String) {
    (name.to_owned(), text.to_owned())
}

#[test]
fn new_results_take_the_place_of_earlier_ones_and_of_nothing_else() {
    let folder = TempDir::new().unwrap();
    write(folder.path(), "one", &["b.csv", "c.svg"]).unwrap();
    fs::write(folder.path().join("notes.csv"), "mine").unwrap();
    fs::write(folder.path().join("c.svg"), "edited").unwrap();
    write(folder.path(), "two", &[]).unwrap();
    let expected = [
        pair("a.csv", "two"),
        pair("c.svg", "edited"),
        pair("notes.csv", "mine"),
        pair(RESULT, "two"),
    ];
    assert_eq!(held(folder.path()), expected);
    // What was edited is no longer a result.
    assert!(matches!(write(folder.path(), "three", &["c.svg"]), Err(CliError::Foreign { .. })));
    assert_eq!(held(folder.path()), expected);
}

#[test]
fn a_writer_that_fails_leaves_the_earlier_results_as_they_are() {
    let folder = TempDir::new().unwrap();
    write(folder.path(), "one", &["b.csv"]).unwrap();
    let before = held(folder.path());
    let mut new = open(folder.path()).unwrap();
    let mut files = Staged::new(&mut new).unwrap();
    files.add("a.csv", "two").unwrap();
    let full = files.add_with("b.csv", |out| {
        out.write_all(b"half")?;
        Err(ErrorKind::StorageFull.into())
    });
    assert!(matches!(full, Err(CliError::Unwritable { .. })));
    drop(files);
    assert_eq!(held(folder.path()), before);
    drop(new);
    write(folder.path(), "two", &["b.csv"]).unwrap();
    assert_eq!(held(folder.path()).len(), 3);
}

#[test]
fn a_sudden_end_leaves_earlier_results_or_none_that_look_whole() {
    for placed in 0..4 {
        let folder = TempDir::new().unwrap();
        write(folder.path(), "one", &["b.csv"]).unwrap();
        let before = held(folder.path());
        let mut new = open(folder.path()).unwrap();
        let mut files = Staged::new(&mut new).unwrap();
        files.add("a.csv", "two").unwrap();
        files.add("b.csv", "two").unwrap();
        if placed > 0 {
            files.announce().unwrap();
            files.take_down().unwrap();
            for _ in 1..placed {
                files.place_next().unwrap();
            }
        }
        // Nothing is tidied up, but for the lock that the system releases.
        std::mem::forget(files);
        drop(new);
        let after = held(folder.path());
        let results = |all: &[(String, String)]| {
            let is_result = |own: &&(String, String)| !own.0.starts_with('.');
            all.iter().filter(is_result).cloned().collect::<Vec<_>>()
        };
        assert!(after.iter().any(|own| own.0.starts_with('.')) || placed == 3);
        if placed == 0 {
            assert_eq!(results(&after), before);
        } else {
            assert!(after.iter().all(|own| own.0 != RESULT), "{after:?}");
        }
        write(folder.path(), "three", &["b.csv"]).unwrap();
        let expected = ["a.csv", "b.csv", RESULT].map(|name| pair(name, "three"));
        assert_eq!(held(folder.path()), expected);
    }
}

#[test]
fn a_folder_has_one_writer() {
    let folder = TempDir::new().unwrap();
    let first = open(folder.path()).unwrap();
    assert!(matches!(open(folder.path()), Err(CliError::Busy { .. })));
    drop(first);
    write(folder.path(), "one", &[]).unwrap();
}

#[test]
fn a_folder_that_was_made_in_vain_is_removed() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("new");
    drop(open(&path).unwrap());
    assert!(!path.exists());
}

#[test]
fn names_lead_to_no_other_folder() {
    for name in ["../a.csv", "/a.csv", "b/a.csv", ".a.csv", "a.exe", "a", "", "..", "a\\b.csv"] {
        assert!(!list::is_name(name), "{name}");
    }
    assert!(list::is_name("pad.peak-force.svg"));
}
