//! Figures and pages of the command, by what is drawn and by closed forms.

use std::fs;

use tempfile::TempDir;

use crate::cli::{code, err, file, run};

/// 4 kg at 5 m/s on a spring of stiffness K: the peak force is V √(K m), 1 kN at 10 kN/m.
const STRUCK: &str = "[nodes]\nhead = { mass = \"4 kg\", velocity = \"5 m/s\" }\n[elements]\n\
    pad = { between = [\"head\", \"ground\"], spring = \"25 kN/m\" }\n\
    [limits]\npad.peak-force = \"2 kN\"\n[run]\nduration = \"100 ms\"\n";

/// 4 kg fall 1 m, in √(2/9.81) s, onto a spring and a dashpot that they leave again.
const DROPPED: &str = "[nodes]\nhead = { mass = \"4 kg\", drop = \"1 m\" }\n[elements]\n\
    pad = { between = [\"head\", \"ground\"], kelvin-voigt = { spring = \"1 MN/m\", dashpot = \"400 N s/m\" } }\n\
    [effects]\nseparation.pad = {}\ngravity = { value = \"9.81 m/s^2\" }\n\
    [run]\nduration = \"600 ms\"\nmethods = [\"exact\"]\n";

fn value<'t>(tag: &'t str, key: &str) -> &'t str {
    tag.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap()
}

/// The places of the points of every tag of this name in the groups of this class.
fn points(svg: &str, class: &str, name: &str) -> Vec<Vec<(f64, f64)>> {
    let own = format!("class=\"{class}\"");
    let groups = svg.split("<g ").filter(|group| group.contains(&own));
    let tags: Vec<&str> =
        groups.flat_map(|group| group.split('<').filter(|tag| tag.starts_with(name))).collect();
    let place = |pair: &str| {
        let (x, y) = pair.split_once(',').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    tags.iter().map(|tag| value(tag, "points").split_whitespace().map(place).collect()).collect()
}

#[test]
fn the_page_of_a_sweep_counts_what_passes_and_finds_the_best_design() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", STRUCK).to_str().unwrap().to_owned();
    let results = folder.path().join("results");
    let stiffness = "pad.spring=10..60 kN/m,6";
    let output = run(&["sweep", &path, "--vary", stiffness, "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    // The softest spring leaves the largest margin, 1 − V √(K m) / 2 kN.
    assert!(page.contains("best: pad.spring = 10 kN/m, smallest margin 50 %"), "{page}");
    for words in [
        "<h2>What varies</h2>",
        "<h2>Limits</h2>",
        "<h2>Best designs, by the margin of peak force of pad</h2>",
        "<h2>Lowest and highest</h2>",
        "<h2>All points</h2>",
        "<h2>Settings</h2>",
        "Peak force of pad over spring of pad",
        "of 6 points pass",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let figures = page.matches("<div class=\"drawing wide\">").count();
    assert_eq!(page.matches("<div class=\"drawing narrow\">").count(), figures);
    assert!(figures > 0);
}

#[test]
fn where_no_design_keeps_its_limit_the_page_shows_the_nearest() {
    let folder = TempDir::new().unwrap();
    let scene = STRUCK.replace("\"2 kN\"", "\"500 N\"");
    let path = file(&folder, "scene.toml", &scene).to_str().unwrap().to_owned();
    let results = folder.path().join("results");
    let stiffness = "pad.spring=10..60 kN/m,6";
    let output = run(&["sweep", &path, "--vary", stiffness, "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("No design keeps all limits: the nearest ones"), "{page}");
    assert!(page.contains("nearest to passing: pad.spring = 10 kN/m, smallest margin −100 %"));
}

#[test]
fn figures_of_a_drop_count_from_first_touch_and_show_the_direction_of_loading() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", DROPPED).to_str().unwrap().to_owned();
    let results = folder.path().join("results");
    let output = run(&["run", &path, "--out", results.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    for name in ["force-time", "acceleration-time", "velocity-time", "energy-time"] {
        let svg = read(&format!("{name}.svg"));
        assert!(svg.contains("time from first touch (ms)"), "{name}");
        assert!(svg.contains("first touch at 451.5") && svg.contains("ms of 600 ms"), "{name}");
    }
    // The CSV keeps the time of the run.
    let table = read("exact.csv");
    let times: Vec<f64> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').next().unwrap().parse().unwrap())
        .collect();
    assert!(table.starts_with("time [s]"));
    assert_eq!((times[0], times[times.len() - 1]), (0.0, 0.6));
    // A loop that is loaded to the right and unloaded to the left.
    let svg = read("force-deformation.svg");
    let heads = points(&svg, "arrows", "polygon");
    let ahead = |head: &Vec<(f64, f64)>| head[0].0 - 0.5 * (head[1].0 + head[2].0);
    assert!(heads.len() >= 2, "{svg}");
    assert!(ahead(&heads[0]) > 0.0 && ahead(&heads[heads.len() - 1]) < 0.0, "{heads:?}");
    // Along the curve, whose points follow each other in time: the tip comes behind the base.
    let curve = points(&svg, "series", "polyline").concat();
    let nearest = |place: (f64, f64), from: usize| {
        let away = |at: &usize| (curve[*at].0 - place.0).hypot(curve[*at].1 - place.1);
        (from..curve.len()).min_by(|one, other| away(one).total_cmp(&away(other))).unwrap()
    };
    let mut last = 0;
    for head in &heads {
        let base = (0.5 * (head[1].0 + head[2].0), 0.5 * (head[1].1 + head[2].1));
        let (from, to) = (nearest(base, last), nearest(head[0], last));
        assert!(to > from, "{head:?}: {from} {to}");
        last = from;
    }
}
