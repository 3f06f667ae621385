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

#[test]
fn what_is_undecided_is_dotted_in_maps_and_lines_and_maps_of_a_wide_range_go_by_ratios() {
    let folder = TempDir::new().unwrap();
    // On a spring known up to 10.2 mm: beyond V √(m/K) = 10.2 mm, 2.04 m/s, its force is extrapolated, and up to
    // V √(K m) = 482 N, 2.41 m/s, it would keep the limit.
    let scene = "[nodes]\nhead = { mass = \"1 kg\", velocity = \"5 m/s\" }\n[elements]\n\
        pad = { between = [\"head\", \"ground\"], table-spring = [[\"0 mm\", 0], [\"10.2 mm\", \"408 N\"]] }\n\
        [limits]\npad.peak-force = \"482 N\"\n[run]\nduration = \"100 ms\"\n";
    let path = file(&folder, "scene.toml", scene).to_str().unwrap().to_owned();
    let results = folder.path().join("results");
    let swept = |speeds: &str, more: &[&str]| {
        let own = ["sweep", &path, "--vary", speeds, "--measure", "pad.peak-force"];
        let out = ["--out", results.to_str().unwrap()];
        let output = run(&[&own[..], more, &out].concat());
        assert_eq!(code(&output), 0, "{}", err(&output));
        let map = fs::read_to_string(results.join("pad.peak-force-map.svg")).unwrap_or_default();
        (fs::read_to_string(results.join("pad.peak-force.svg")).unwrap(), map)
    };
    let speeds = "head.velocity=1.6..2.8 m/s,13";
    let (lines, _) = swept(speeds, &[]);
    assert!(lines.contains("dotted: undecided"), "{lines}");
    // 2.1 to 2.4 m/s are open: plain up to 2.0, dotted to 2.5, plain again.
    let dotted: Vec<&str> =
        lines.split("<g ").filter(|own| own.contains("stroke-dasharray=\"20 40\"")).collect();
    let curves = points(&lines, "series", "polyline");
    let ends = |own: &[(f64, f64)]| (own[0].0, own[own.len() - 1].0);
    let step = (ends(&curves[1]).1 - ends(&curves[0]).0) / 12.0;
    assert!((ends(&curves[0]).1 - ends(&curves[0]).0 - 4.0 * step).abs() < 2.0, "{curves:?}");
    assert!((ends(&curves[1]).0 - ends(&curves[0]).1 - 5.0 * step).abs() < 2.0, "{curves:?}");
    assert_eq!((dotted.len(), curves.len()), (1, 2 + 5));
    let (_, map) = swept(speeds, &["--vary", "head.mass=0.7..1.3 kg,5"]);
    assert!(map.contains("class=\"undecided\"") && map.contains("dotted: undecided"), "{map}");
    // Forces from V √(K m) = 0.23 kN to 6.4 kN have colours by their ratios.
    let (lines, map) = swept("head.velocity=1.6,2,4,16 m/s", &["--vary", "head.mass=0.5,1,2,4 kg"]);
    assert!(lines.contains("undecided") && map.contains("undecided"));
    let bar = map.split("<g class=\"bar\">").nth(1).unwrap().split("</g>").nth(1).unwrap();
    let place = |number: &str| -> f64 {
        let tag = bar.split("<text ").find(|own| own.contains(&format!(">{number}<"))).unwrap();
        value(tag, " y").parse().unwrap()
    };
    let octave = place("0.5") - place("1");
    assert!((place("1") - place("2") - octave).abs() < 0.2, "{bar}");
}
