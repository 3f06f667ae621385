//! Error bars beside the truth, on generated scenes.
//!
//! A part of the calibration runs with all other tests. All of it, on 1000 scenes for each method,
//! takes minutes and brings the tables of `docs/error-bars.md` up to date:
//! `UPDATE_DOCS=1 cargo test --test it calibration::full -- --ignored --nocapture`. `DASHPOT_SCENES`
//! and `DASHPOT_SEED` ask for other scenes, `DASHPOT_METHODS` for some methods only, `DASHPOT_SCENE` prints one.

mod accuracy;
mod chosen;
mod linear;
mod nonlinear;
mod scenes;
mod switching;
mod tally;
mod text;
mod trial;
mod truth;

use std::{fs, path::Path, sync::LazyLock};

use dashpot::dae::methods;

use tally::Tallies;
use trial::{Case, Outcome};
pub(crate) use truth::Patience;

/// The seed of the scenes that the bars are tested on, fixed before they were looked at. Those that
/// they were made on have seeds 1 to 3; those of seeds 5 and 11 were looked at before.
const SEED: u64 = 12;
/// Scenes of all of the calibration.
const ALL: usize = 1000;
/// Scenes of the part that runs with all other tests.
const PART: usize = 40;
/// The methods that take their error bars from further solutions.
static METHODS: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let steppers = methods::METHODS.iter().filter(|own| own.order.is_some()).map(|own| own.name);
    match std::env::var("DASHPOT_METHODS") {
        Ok(chosen) => steppers.filter(|name| chosen.split(',').any(|own| own == *name)).collect(),
        Err(_) => steppers.collect(),
    }
});
/// Part of the scenes in which the truth must lie inside of all bars.
const COVERAGE: f64 = 0.99;
/// How many times the error a bar may be in the median.
const WIDEST: f64 = 25.0;

fn wanted(name: &str) -> Option<usize> {
    std::env::var(name).ok().map(|text| text.parse().expect(name))
}

/// Judges scenes until there are so many for every method, half of them linear and half of them not.
fn calibrate(seed: u64, scenes: usize) -> Tallies {
    let mut tallies = Tallies::default();
    let missing = METHODS.iter().map(|method| (*method, [scenes.div_ceil(2), scenes / 2]));
    let mut missing: Vec<_> = missing.collect();
    for at in 0..20 * scenes {
        let half = at % 2;
        if missing.iter().all(|(_, missing)| missing[half] == 0) {
            continue;
        }
        let case = Case::new(seed, at);
        let kind = case.drawn.kind;
        for (method, missing) in missing.iter_mut().filter(|(_, missing)| missing[half] > 0) {
            let outcome = case.judge(method, |settings| settings);
            missing[half] -= usize::from(matches!(outcome, Outcome::Judged(_)));
            tallies.add((method, kind), &format!("{kind} {at} by {method}"), outcome);
        }
    }
    tallies
}

/// How many scenes may be outside by chance where the bars hold in 99 of 100: more are found once in a
/// thousand times.
fn most_outside(scenes: usize) -> usize {
    let mean = (1.0 - COVERAGE) * scenes as f64;
    let (mut term, mut sum, mut count) = ((-mean).exp(), 0.0, 0);
    loop {
        sum += term;
        if sum > 0.999 {
            return count;
        }
        count += 1;
        term *= mean / count as f64;
    }
}

#[test]
fn the_truth_lies_inside_the_bars_in_99_of_100_scenes() {
    let tallies = calibrate(SEED, PART);
    let whole: Vec<_> = METHODS.iter().map(|method| tallies.of(method, |_| true)).collect();
    for (method, own) in METHODS.iter().zip(&whole) {
        assert_eq!(own.scenes, PART, "{method}");
        let outside = own.scenes - own.inside;
        assert!(outside <= most_outside(own.scenes), "{method}: {:?}", own.remarks);
        // The median of few scenes is not that of many.
        assert!(own.ratio(0.5) <= 1.5 * WIDEST, "{method}: {} errors", own.ratio(0.5));
    }
    let all = whole.iter().fold(tally::Tally::default(), tally::Tally::with);
    // A run that ends in an error is no better than one whose bars are too small.
    let bad = all.scenes - all.inside + all.failed;
    assert!(bad <= most_outside(all.scenes + all.failed), "{:?}", all.remarks);
    assert!(all.ratio(0.5) <= WIDEST, "{} errors", all.ratio(0.5));
}

const PAGE: &str = "docs/error-bars.md";
const MARK: &str = "<!-- generated: calibration -->\n";

#[test]
#[ignore = "takes minutes; see the top of the file"]
fn full() {
    let seed = wanted("DASHPOT_SEED").map_or(SEED, |seed| seed as u64);
    if let Some(at) = wanted("DASHPOT_SCENE") {
        println!("{}", Case::new(seed, at).drawn.text);
        return;
    }
    let scenes = wanted("DASHPOT_SCENES").unwrap_or(ALL);
    let tallies = calibrate(seed, scenes);
    let chosen = chosen::judged(seed, scenes);
    let tables = tallies.tables(&METHODS, &chosen);
    println!("{tables}\n{}\n{}", tallies.remarks().join("\n"), chosen.remarks.join("\n"));
    if std::env::var_os("UPDATE_DOCS").is_some() && (seed, scenes) == (SEED, ALL) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE);
        let page = fs::read_to_string(&path).unwrap();
        let (before, rest) = page.split_once(MARK).unwrap();
        let (_, after) = rest.split_once("<!-- end -->").unwrap();
        fs::write(path, format!("{before}{MARK}{tables}<!-- end -->{after}")).unwrap();
    }
    for method in &*METHODS {
        let own = tallies.of(method, |_| true);
        assert!(own.coverage() >= COVERAGE, "{method}: {}", own.coverage());
        assert!(own.ratio(0.5) <= WIDEST, "{method}: {} errors", own.ratio(0.5));
    }
    assert!(chosen.coverage() >= COVERAGE, "auto: {}", chosen.coverage());
}

#[test]
fn the_page_has_a_row_for_every_method_that_shows_what_is_promised() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PAGE);
    let page = fs::read_to_string(path).unwrap();
    for method in &*METHODS {
        let head = format!("| `{method}` | all | ");
        let row = page.lines().find_map(|line| line.strip_prefix(&head)).expect(method);
        let cells: Vec<&str> = row.split(" | ").collect();
        let number = |at: usize| cells[at].trim_end_matches(" %").parse::<f64>().unwrap();
        assert!(number(0) >= ALL as f64, "{method}: {row}");
        assert!(number(1) >= 100.0 * COVERAGE, "{method}: {row}");
        assert!(number(3) <= WIDEST, "{method}: {row}");
    }
}
