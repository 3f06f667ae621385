//! `dashpot thesis` as its users meet it.

use std::{fs, time::Instant};

use serde_json::Value;

use crate::cli::{code, err, json, out, run, text};

#[test]
fn the_text_fits_a_terminal_and_says_what_is_misprinted_and_what_holds() {
    let output = run(&["thesis"]);
    assert_eq!((code(&output), err(&output)), (0, String::new()));
    let shown = out(&output);
    for line in shown.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for words in ["misprints, with the correct forms", "2.29", "truncated", "does not hold"] {
        assert!(shown.contains(words), "{words}");
    }
}

#[test]
fn the_folder_holds_every_figure_its_numbers_and_the_report() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("thesis");
    let begin = Instant::now();
    let output = run(&["thesis", "--out", text(&target)]);
    let took = begin.elapsed().as_secs_f64();
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(took < 3.0, "{took} s");
    let page = fs::read_to_string(target.join("report.html")).unwrap();
    let markdown = fs::read_to_string(target.join("report.md")).unwrap();
    for number in [1, 2].into_iter().chain(4..=21) {
        let stem = format!("figure-{number:02}");
        assert!(target.join(format!("{stem}.svg")).is_file(), "{stem}");
        assert_eq!(target.join(format!("{stem}.csv")).is_file(), ![1, 21].contains(&number));
        assert!(markdown.contains(&format!("({stem}.svg)")), "{stem}");
    }
    // Two networks, and each chart for pages and for phones.
    assert_eq!(page.matches("<svg").count(), 2 + 2 * 18);
    // Beside each curve stand its padding and what it does; beyond the thickness it is marked.
    let curves = fs::read_to_string(target.join("figure-06.svg")).unwrap();
    for words in ["b = 80: K1 ", "C2 ", "q ", "ξmax 1.03, exceeds", "b = 80: ξ = 1", "thickness"]
    {
        assert!(curves.contains(words), "{words}");
    }
    let table = fs::read_to_string(target.join("figure-14.csv")).unwrap();
    assert!(table.starts_with("tau* [1],xi at b = 50 [1],phi at b = 50 [1],"), "{table:.100}");
    assert_eq!(table.lines().count(), 502);
    // Once more over its own files, and never over others'.
    assert_eq!(code(&run(&["thesis", "--out", text(&target)])), 0);
    let foreign = tempfile::tempdir().unwrap();
    fs::write(foreign.path().join("report.md"), "mine").unwrap();
    let refused = run(&["thesis", "--out", text(foreign.path())]);
    assert_eq!(code(&refused), 2);
    assert_eq!(fs::read_to_string(foreign.path().join("report.md")).unwrap(), "mine");
}

#[test]
fn the_object_holds_numbers_misprints_claims_and_families() {
    let all = json(&["thesis", "--json"]);
    let list = |name: &str| all[name].as_array().unwrap().clone();
    let of = |place: &str| {
        let found = list("numbers").into_iter().find(|own| own["place"] == place);
        found.unwrap_or_else(|| panic!("{place}"))
    };
    assert!((of("2.30")["value"].as_f64().unwrap() - 200.0 / 3.0).abs() < 1e-12);
    assert_eq!(of("1.1")["value"], Value::Null);
    assert!(list("misprints").len() >= 25 && list("claims").len() >= 15);
    assert_eq!(list("families").len(), 8);
    for claim in list("claims") {
        let partly = claim["verdict"] == "holds in part";
        assert_eq!(partly, !claim["cases"].as_array().unwrap().is_empty(), "{claim}");
    }
    let verdicts = ["holds", "does not hold", "holds in part"];
    assert!(list("claims").iter().all(|own| verdicts.iter().any(|word| own["verdict"] == *word)));
}
