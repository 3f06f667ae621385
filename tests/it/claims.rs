//! What is claimed of scenes at other values: an optimum, a verdict or a band over what was evaluated, and over nothing else.

mod campaign;

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, said, text};

/// A foam that states its own thickness beside that of its element: two numbers that are one only where they agree.
const TWO_THICKNESSES: &str = r#"
[values]
T = "30 mm"
[models.eps]
foam = { modulus = "2 MPa", plateau = "0.1 MPa", densification = "0.02 MPa", exponent = 2.0, thickness = "30 mm", area = "40 cm^2" }
[nodes]
head = { mass = "5 kg", velocity = "3 m/s" }
[elements]
liner = { between = ["head", "ground"], parallel = [{ model = "eps" }, { dashpot = "20 N s/m" }], thickness = "T" }
[effects]
separation.liner = {}
[limits]
head.peak-acceleration = "150 g"
[run]
duration = "50 ms"
"#;

/// A round body in foam.
const ROUND: &str = r#"
[materials]
eps = { foam = { modulus = "20 MPa", plateau = "0.7 MPa", densification = "0.2 MPa", exponent = 2 } }
[nodes]
head = { mass = "5 kg", velocity = "5.4 m/s" }
[elements.liner]
between    = ["head", "ground"]
material   = "eps"
thickness  = "30 mm"
pressed-by = { shape = "sphere", radius = "85 mm", pad-radius = "-110 mm" }
[limits]
head.peak-acceleration = "250 g"
[run]
duration = "60 ms"
"#;

fn written(text: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", text);
    let path = crate::cli::text(&path).to_owned();
    (folder, path)
}

/// The object of a command that may leave a limit open.
fn object(arguments: &[&str]) -> (i32, Value) {
    let output = run(&[arguments, &["--json"]].concat());
    (
        code(&output),
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", err(&output))),
    )
}

/// The first label of a verdict.
fn labels(text: &str) -> Vec<&str> {
    let words = text.lines().filter_map(|line| line.split_whitespace().next());
    words.filter(|own| ["BEST", "NONE", "PASS", "FAIL", "UNDECIDED"].contains(own)).collect()
}

#[test]
fn an_optimum_is_claimed_only_over_what_was_evaluated() {
    let (_folder, path) = written(TWO_THICKNESSES);
    let (status, own) = object(&["design", &path, "--solve-for", "T", "--enforce"]);
    assert_eq!((status, own["claimed"].as_bool()), (4, Some(false)), "{own}");
    let missing = &own["unevaluated"];
    let cause = &missing["causes"][0];
    assert_eq!((&cause["cause"]["kind"], &cause["count"]), (&"scene".into(), &missing["count"]));
    assert!(missing["count"].as_u64().unwrap() >= 399, "{missing}");
    assert!((cause["values"][0].as_f64().unwrap() - 3e-3).abs() < 1e-12, "{cause}");
    let shown = out(&run(&["design", &path, "--solve-for", "T"]));
    assert!(
        shown.starts_with("! ") && shown.contains("no valid scene, the first at T = 3 mm"),
        "{shown}"
    );
    assert_eq!(labels(&shown), ["UNDECIDED", "PASS"], "{shown}");
    // Where that design does not keep its limit, none is beside it to begin a search from.
    let low = [
        "--vary",
        "T=8..80 mm",
        "--least",
        "T",
        "--limit",
        "head.peak-acceleration<=20 g",
        "--sample",
        "40",
    ];
    let (status, own) = object(&[&["design", &path][..], &low].concat());
    assert_eq!((status, &own["claimed"], &own["feasible"]), (0, &false.into(), &false.into()));
    // With both of them one number, the optimum is that of single runs.
    let one = TWO_THICKNESSES.replace("thickness = \"30 mm\"", "thickness = \"T\"");
    let (_folder, path) = written(&one);
    let (status, own) = object(&["design", &path, "--solve-for", "T", "--enforce"]);
    assert_eq!((status, own["claimed"].as_bool()), (0, Some(true)));
    let best = own["parameters"]["T"]["value"].as_f64().unwrap();
    let passes = |thickness: f64| {
        let set = format!("T={thickness:e} m");
        let own = json(&["run", &path, "--set", &set, "--json"])["runs"][0].clone();
        let left = thickness - own["measures"]["liner.peak-deformation"]["value"].as_f64().unwrap();
        own["limits"][0]["verdict"] == "pass" && left > 0.0
    };
    assert!(
        passes(best) && (1..8).all(|at| !passes(best * (1.0 - 0.002 * f64::from(at * at)))),
        "{best}"
    );
}

#[test]
fn what_lies_above_the_least_number_need_not_be_evaluated() {
    // The sphere does not fit into the hollow from 110 mm on.
    let (_folder, path) = written(ROUND);
    let radius = "liner.pressed-by.radius";
    let design = |range: &str, least: &str| {
        object(&[
            "design",
            &path,
            "--vary",
            &format!("{radius}={range}"),
            "--least",
            least,
            "--sample",
            "60",
        ])
        .1
    };
    let own = design("50..300 mm", "head.peak-acceleration");
    assert_eq!(own["claimed"], false, "{own}");
    assert!(own["open"].as_u64().unwrap() > 10);
    let own = design("50..105 mm", "head.peak-acceleration");
    assert_eq!((&own["claimed"], &own["unevaluated"]["count"]), (&true.into(), &0.into()));
    // The least radius is 50 mm, whatever those do that do not fit.
    let own = design("50..300 mm", radius);
    assert!(own["unevaluated"]["count"].as_u64().unwrap() > 10 && own["open"] == 0, "{own}");
    assert_eq!(own["claimed"], true);
}

#[test]
fn a_round_body_in_by_more_than_its_radius_is_not_evaluated() {
    let cylinder = ROUND.replace(
        r#"shape = "sphere", radius = "85 mm", pad-radius = "-110 mm""#,
        r#"shape = "cylinder", radius = "10 mm", length = "100 mm""#,
    );
    let (_folder, path) = written(&cylinder);
    let told = out(&run(&["run", &path, "--plot", "never"]));
    assert!(
        told.contains("more than the radius of its body") && !told.contains("end of its law"),
        "{told}"
    );
    let set = ["--limit", "head.peak-acceleration<=1000 g"];
    let told = said(&run(&[&["run", &path, "--json"], &set[..]].concat()));
    assert!(told.contains("radius"), "{told}");
    let (_, own) = object(&["design", &path, "--solve-for", "liner.thickness", "--sample", "30"]);
    let kinds: Vec<&Value> = own["unevaluated"]["causes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|own| &own["cause"]["kind"])
        .collect();
    assert_eq!((own["claimed"].as_bool(), kinds), (Some(false), vec![&"beyond".into()]));
    let told = out(&run(&["design", &path, "--solve-for", "liner.thickness", "--sample", "30"]));
    assert_eq!(labels(&told)[0], "UNDECIDED", "{told}");
    // It exceeds the limit by a law that does not hold there.
    let limit = ["--limit", "head.peak-acceleration<=1 g"];
    let own = json(&[&["run", &path, "--json"], &limit[..]].concat());
    let judged = &own["runs"][0]["limits"].as_array().unwrap().last().unwrap().clone();
    assert_eq!((&judged["verdict"], &judged["reason"]), (&"undecided".into(), &"no-law".into()));
    let vary = "head.velocity=0.05..5.4 m/s,4,log";
    let own = json(&[&["sweep", &path, "--vary", vary, "--json"], &limit[..]].concat());
    let judged = own["limits"].as_array().unwrap().last().unwrap();
    let verdicts: Vec<&str> =
        judged["verdicts"].as_array().unwrap().iter().map(|own| own.as_str().unwrap()).collect();
    assert_eq!(verdicts.last(), Some(&"undecided"), "{judged}");
    assert!(verdicts.contains(&"pass") || verdicts.contains(&"fail"), "{judged}");
}

#[test]
fn a_run_that_ends_while_it_falls_has_one_cause_in_every_study() {
    let fall = "[nodes]\nhead = { mass = \"5 kg\", drop = \"1 m\" }\n[elements]\n\
                pad = { between = [\"head\", \"ground\"], spring = \"80 kN/m\" }\n[effects]\nseparation.pad = {}\n\
                gravity = {}\n[run]\nduration = \"40 ms\"\n";
    let (_folder, path) = written(fall);
    let limit = ["--limit", "head.peak-acceleration<=50 g"];
    let vary = "pad.spring=40..100 kN/m";
    let least = ["--least", "pad.peak-deformation", "--sample", "10"];
    let told = err(&run(&[&["design", &path, "--vary", vary], &limit[..], &least[..]].concat()));
    assert!(told.contains("make `duration` longer") && !told.contains("never"), "{told}");
    let vary = format!("{vary},3");
    let own = json(&[&["sweep", &path, "--vary", &vary, "--json"], &limit[..]].concat());
    assert_eq!(own["unevaluated"]["causes"][0]["cause"]["kind"], "cut", "{own}");
}

#[test]
fn a_law_that_fine_tolerances_do_not_get_through_is_designed() {
    // Its force is as steep as it likes where the rate is zero.
    let pad = "[nodes]\nhead = { mass = \"5 kg\", velocity = \"4 m/s\" }\n[elements]\n\
               pad = { between = [\"head\", \"ground\"], series = [{ rate-spring = { force = \"2 kN\", at = \"10 mm\", \
               gain = 0.2, reference-rate = \"0.1 m/s\" } }, { spring = \"80 kN/m\" }] }\n[effects]\n\
               separation.pad = {}\n[run]\nduration = \"40 ms\"\n";
    let (_folder, path) = written(pad);
    let of = [
        "design",
        &path,
        "--vary",
        "head.mass=1..10 kg",
        "--limit",
        "head.peak-acceleration<=50 g",
    ];
    let of = [&of[..], &["--least", "pad.peak-deformation", "--sample", "20"]].concat();
    let output = run(&of);
    assert_eq!(code(&output), 0, "{}", err(&output));
}

#[test]
fn what_rounding_leaves_of_zero_is_zero_in_every_study() {
    // A spring gives back all that it takes up.
    let pad = |spring: &str| {
        format!(
            "[values]\nK = \"60 kN/m\"\n[nodes]\nhead = {{ mass = \"4 kg\", velocity = \"2 m/s\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], {spring} }}\n[effects]\nseparation.pad = {{ at = \"head\" }}\n\
             [run]\nduration = \"60 ms\"\nsamples = 301\n"
        )
    };
    let linear = "spring = \"K\"";
    let cubic = "cubic-spring = { stiffness = \"K\", cubic = \"3e8 N/m^3\" }";
    for (spring, method) in [(linear, "exact"), (linear, "bdf"), (cubic, "dop853"), (cubic, "bdf")]
    {
        let (folder, path) = written(&pad(spring));
        let own = json(&["run", &path, "--method", method, "--json"]);
        let energy = &own["runs"][0]["measures"]["pad.energy"];
        assert_eq!(energy["value"].as_f64(), Some(0.0), "{method}: {energy}");
        assert!(energy["error"].as_f64().unwrap() < 1e-3, "{method}: {energy}");
        let vary = "K=40..60 kN/m,3";
        let own = json(&["sweep", &path, "--vary", vary, "--measure", "pad.energy", "--json"]);
        assert!(
            own["measures"][0]["values"].as_array().unwrap().iter().all(|own| own == 0.0),
            "{own}"
        );
        let text = out(&run(&[
            "design",
            &path,
            "--vary",
            "K=40..60 kN/m",
            "--least",
            "pad.energy",
            "--sample",
            "8",
        ]));
        assert!(text.contains("pad.energy 0 J"), "{text}");
        let base = folder.path().join("base");
        let base = base.to_str().unwrap();
        assert_eq!(code(&run(&["run", &path, "--method", method, "--out", base])), 0);
        let record = format!("{base}/{method}.csv:pad.force=pad.force");
        let text = out(&run(&["fit", &path, "--vary", "K=10..1000 kN/m", "--to", &record]));
        let energy = text.lines().find(|own| own.contains("pad.energy ")).unwrap();
        assert!(energy.contains(" 0 J "), "{energy}");
    }
}

#[test]
fn a_peak_that_is_infinite_everywhere_fails_and_says_so() {
    let pad = |effect: &str| {
        format!(
            "[nodes]\nhead = {{ mass = \"5 kg\", velocity = \"4 m/s\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], spring = \"80 kN/m\" }}\n[effects]\n{effect}\n\
             [run]\nduration = \"40 ms\"\n"
        )
    };
    let limit = "head.peak-acceleration<=50 g";
    for effect in ["stop.pad = { at = 0 }", "face.pad = { mass = \"200 g\" }\nseparation.pad = {}"]
    {
        let (_folder, path) = written(&pad(effect));
        let of = ["design", &path, "--solve-for", "pad.spring", "--limit", limit, "--sample", "20"];
        let output = run(&of);
        let shown = out(&output);
        assert_eq!(code(&output), 0, "{}", err(&output));
        assert!(labels(&shown)[0] == "NONE" && shown.contains("infinite"), "{shown}");
        assert_eq!(code(&run(&[&of[..], &["--enforce"]].concat())), 4);
    }
}

#[test]
fn a_sweep_says_first_what_has_no_value() {
    let pad = "[nodes]\nhead = { mass = \"5 kg\", velocity = \"4 m/s\" }\n[elements]\n\
               pad = { between = [\"head\", \"ground\"], spring = \"80 kN/m\" }\n[effects]\nseparation.pad = {}\n\
               [run]\nduration = \"20 ms\"\n";
    let (_folder, path) = written(pad);
    let vary = "pad.spring=40..400 kN/m,10";
    let of = ["sweep", &path, "--vary", vary, "--limit", "pad.contact-time<=15 ms"];
    let own = json(&[&of[..], &["--json"]].concat());
    // π √(m/k) > 20 ms up to 123 kN/m: three of the points, 40, 80 and 120 kN/m.
    let cause = &own["unevaluated"]["causes"][0];
    assert_eq!(
        (&own["unevaluated"]["count"], &cause["cause"]["kind"]),
        (&3.into(), &"no-value".into())
    );
    assert_eq!(
        (&cause["cause"]["of"], &cause["first"]),
        (&"pad.contact-time".into(), &0.into()),
        "{own}"
    );
    let output = run(&[&of[..], &["--table", "always"]].concat());
    let shown = out(&output);
    assert!(shown.starts_with("! 3 of 10 points have no value of pad.contact-time"), "{shown}");
    assert!(shown.contains("10 points, 3 of them not evaluated"), "{shown}");
    assert_eq!(code(&run(&[&of[..], &["--enforce"]].concat())), 4);
}

#[test]
fn a_restitution_that_a_run_has_not_is_in_no_band() {
    // The body and the skin move as one at first: the pelvis is met without speed.
    let scene = r#"
[nodes]
body = { mass = "28 kg", velocity = "3.4 m/s" }
skin = {}
[elements]
pelvis = { between = ["body", "skin"], kelvin-voigt = { spring = "47 kN/m", dashpot = "600 ± 150 N s/m" } }
pad = { between = ["skin", "ground"], thickness = "16 mm", area = "150 cm^2", foam = { modulus = "0.6 MPa", plateau = "90 kPa", densification = "30 kPa", exponent = 2.0 } }
[effects]
gravity = {}
separation.pad = {}
[run]
duration = "0.2 s"
"#;
    let (_folder, path) = written(scene);
    let own = json(&["run", &path, "--json"]);
    let bands = own["runs"][0]["scatter"]["measures"].clone();
    let band = &bands["pelvis.coefficient-of-restitution"];
    assert_eq!(
        (&band["without"], &band["low"], &band["high"]),
        (&500.into(), &Value::Null, &Value::Null)
    );
    let whole = &bands["pelvis.peak-force"];
    assert_eq!((&whole["without"], &whole["designs"]), (&0.into(), &500.into()));
    let shown = out(&run(&["run", &path, "--plot", "never"]));
    assert!(!shown.contains("e14") && shown.contains("of the"), "{shown}");
}

#[test]
fn every_count_has_a_limit_that_is_checked_before_the_work() {
    let (folder, path) = written(ROUND);
    let record = file(&folder, "a.csv", "time (s),force (N)\n0,0\n1e-3,1\n2e-3,2\n3e-3,1\n");
    let to = format!("{}:force=liner.force", text(&record));
    let vary = ["--vary", "liner.thickness=20..40 mm"];
    let huge = ["1000000000000", "18446744073709551615", "18446744073709551616", "-1"];
    for count in huge {
        for command in [
            ["design", "--sample"],
            ["design", "--scatter"],
            ["design", "--points"],
            ["cushion", "--scatter"],
            ["fit", "--starts"],
            ["run", "--sample"],
            ["sweep", "--sample"],
        ] {
            let count = format!("{}={count}", command[1]);
            let more: &[&str] = match command[0] {
                "design" => &[vary[0], vary[1], "--least", "liner.thickness"],
                "fit" => &["--to", &to, vary[0], vary[1]],
                "sweep" => &vary,
                _ => &[],
            };
            let started = std::time::Instant::now();
            let output = run(&[&[command[0], &path, &count], more].concat());
            assert_eq!(code(&output), 2, "{command:?}: {}", err(&output));
            assert!(said(&output).contains("a whole number from"), "{command:?}: {}", err(&output));
            assert!(started.elapsed().as_secs() < 5, "{command:?}");
        }
    }
}

/// A headform on two layers, the first of which has a stop.
const LAYERS: &str = r#"
[nodes]
head = { mass = "5 kg", velocity = "6.75 m/s" }
face = {}
[elements]
front = { between = ["head", "face"], kelvin-voigt = { spring = "60 kN/m", dashpot = "40 N s/m" }, thickness = "20 mm" }
back = { between = ["face", "ground"], kelvin-voigt = { spring = "250 kN/m", dashpot = "150 N s/m" }, thickness = "40 mm" }
[effects]
separation.front = {}
stop.front = { at = "15 mm", stiffness = "20 MN/m" }
[run]
duration = "80 ms"
"#;

#[test]
fn the_verdict_tells_of_the_head_and_of_every_layer() {
    let (_folder, path) = written(LAYERS);
    let shown = said_out(&["run", &path, "--plot", "never"]);
    // A passive pad gives back no more than it takes up.
    let after = |word: &str| {
        let rest = shown.split(word).nth(1).unwrap_or_else(|| panic!("{word}: {shown}"));
        rest.split([' ', ';']).find_map(|own| own.parse::<f64>().ok()).unwrap()
    };
    let (speed, restitution) = (after("head rebounds at "), after("coefficient of restitution "));
    assert!((restitution - speed / 6.75).abs() < 1e-2 && restitution < 1.0, "{shown}");
    for (layer, rest) in [("front", "ON ITS STOP"), ("back", "left")] {
        let line = shown
            .split("max. deflection")
            .skip(1)
            .find(|own| own.contains(&format!("in {layer} at")));
        assert!(
            line.is_some_and(|own| own.contains("mm") && own.contains(rest)),
            "{layer}: {shown}"
        );
    }
}

#[test]
fn a_limit_that_too_few_designs_keep_does_not_pass() {
    // v √(K m) of 4 kg at 5 m/s is 1581 N.
    let scene = "[nodes]\nhead = { mass = \"4 kg\", velocity = \"5 m/s\" }\n[elements]\n\
                 pad = { between = [\"head\", \"ground\"], spring = \"25 ± 2.5 kN/m\" }\n[run]\nduration = \"60 ms\"\n";
    let (_folder, path) = written(scene);
    let judged = |limit: f64| {
        let limit = format!("pad.peak-force<={limit} N");
        let (status, own) = object(&["run", &path, "--limit", &limit, "--enforce"]);
        let own = own["runs"][0]["limits"][0].clone();
        (status, own["verdict"].as_str().unwrap().to_owned(), own["reason"].clone())
    };
    // Below 1585 N lie Φ(0.05) of the designs, below 1800 N Φ(2.97).
    assert_eq!(judged(1585.0), (4, "undecided".to_owned(), "scatter".into()));
    assert_eq!(judged(1800.0), (0, "pass".to_owned(), Value::Null));
    assert_eq!(judged(1570.0).1, "fail");
    let shown = said_out(&["run", &path, "--limit", "pad.peak-force<=1585 N", "--plot", "never"]);
    assert!(labels_of(&shown) == ["UNDECIDED"] && shown.contains("passes at the means"), "{shown}");
}

/// What is printed, without its line breaks.
fn said_out(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    out(&output).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn labels_of(text: &str) -> Vec<&str> {
    let all = ["BEST", "NONE", "PASS", "FAIL", "UNDECIDED"];
    text.split(' ').filter(|own| all.contains(own)).collect()
}

#[test]
fn the_page_of_cushions_has_its_labels_and_curves_end_where_the_law_does() {
    let scene = r#"
[materials]
foam = { table-spring = [["0", "0 kPa"], ["0.3", "60 kPa"], ["0.5", "160 kPa"]] }
[nodes]
parcel = { mass = "8 kg", drop = "60 cm" }
[elements]
pad = { between = ["parcel", "ground"], material = "foam", thickness = "50 mm", area = "400 cm^2" }
[run]
duration = "60 ms"
"#;
    let (folder, path) = written(scene);
    let results = folder.path().join("curves");
    let of = ["cushion", &path, "--stress", "0.5..40 kPa,30,log", "--limit", "20 g"];
    let shown = said_out(&[&of[..], &["--out", text(&results)]].concat());
    let page = std::fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("least peak: ") && page.contains("UNDECIDED: "), "{shown}");
    let mut figure = std::fs::read_dir(&results).unwrap().filter_map(Result::ok);
    let figure = figure.find(|own| own.path().extension().is_some_and(|own| own == "svg")).unwrap();
    let figure = std::fs::read_to_string(figure.path()).unwrap();
    assert!(!figure.contains("beyond the law"), "curves are drawn beyond the law");
}

#[test]
fn derivatives_take_no_more_than_some_runs() {
    // A law of the rate that is rounded off: a thousandth of the run's tolerance takes hundreds of times its work.
    let scene = r#"
[nodes]
head = { mass = "5 kg", velocity = "4 m/s" }
[elements]
pad = { between = ["head", "ground"], series = [{ rate-spring = { force = "2 kN", at = "10 mm", gain = 0.2, reference-rate = "0.1 m/s" } }, { spring = "80 kN/m" }] }
[effects]
separation.pad = {}
[run]
duration = "40 ms"
"#;
    let (_folder, path) = written(scene);
    let started = std::time::Instant::now();
    let own = json(&[
        "sweep",
        &path,
        "--gradient",
        "pad.spring",
        "--measure",
        "pad.peak-force",
        "--json",
    ]);
    assert!(started.elapsed().as_secs() < 15, "{:?}", started.elapsed());
    let own = &own["points"][0]["measures"][0]["derivatives"][0];
    let [slope, error] = ["value", "error"].map(|key| own[key].as_f64().unwrap());
    let peak = |part: f64| {
        let set = format!("pad.spring={:e} N/m", 8e4 * part);
        let own = json(&["run", &path, "--set", &set, "--accuracy", "1e-4%", "--json"]);
        own["runs"][0]["measures"]["pad.peak-force"]["value"].as_f64().unwrap()
    };
    let right = (peak(1.01) - peak(0.99)) / (0.02 * 8e4);
    assert!((slope - right).abs() <= error + 1e-3 * right.abs(), "{slope} ± {error}, {right}");
}

#[test]
fn points_that_are_no_scenes_are_left_out_of_a_sweep_and_told() {
    let (_folder, path) = written(TWO_THICKNESSES);
    let measure = ["--measure", "head.peak-acceleration"];
    let of = |vary: &'static str| [&["sweep", &path, "--vary", vary][..], &measure].concat();
    let (status, own) = object(&of("T=30,35,40 mm"));
    let values = own["measures"][0]["values"].as_array().unwrap();
    assert!(status == 0 && values[0].is_number() && values[1].is_null(), "{own}");
    assert_eq!(own["unevaluated"]["count"], 2, "{own}");
    assert!(err(&run(&of("T=30,35,40 mm"))).contains("no valid scene, the first at T = 35 mm"));
    // Where no end of a range is one, its fault is shown.
    let none = run(&of("T=35,40 mm"));
    assert!(code(&none) == 2 && err(&none).contains("`thickness` is 30 mm here, but 35 mm"));
}

#[test]
fn a_robust_optimum_is_not_claimed_of_a_scatter_that_the_scene_cuts_off() {
    let scene = TWO_THICKNESSES
        .replace("T = \"30 mm\"", "C = \"20 N s/m\"")
        .replace("dashpot = \"20 N s/m\"", "dashpot = \"C\"")
        .replace("thickness = \"T\"", "thickness = \"30 ± 1 mm\"");
    let (_folder, path) = written(&scene);
    let design = ["design", &path, "--vary", "C=10..40 N s/m", "--sample", "4"];
    let robust = ["--least", "head.peak-acceleration", "--robust", "95%", "--scatter", "100"];
    let (_, own) = object(&[&design[..], &robust].concat());
    assert_eq!((&own["robust"]["enough"], &own["claimed"]), (&true.into(), &false.into()), "{own}");
    let shown = said_out(&[&design[..], &robust].concat());
    assert_eq!(labels_of(&shown)[..2], ["UNDECIDED"; 2], "{shown}");
    assert!(shown.contains("only 0 % of what scatters is within"), "{shown}");
}

#[test]
fn the_peak_force_of_a_pad_that_meets_its_stop_twice_is_that_of_the_whole_impact() {
    let scene = r#"
[nodes]
head  = { mass = "5 kg", velocity = "6.8 m/s" }
shell = { mass = "300 g" }
[elements]
comfort = { between = ["head", "shell"], spring = "60 kN/m", thickness = "10 mm" }
liner   = { between = ["shell", "ground"], foam = { modulus = "2 MPa", plateau = "0.3 MPa", densification = "0.05 MPa", exponent = 2 }, thickness = "25 mm", area = "60 cm^2" }
[effects]
separation.comfort = {}
separation.liner = {}
stop.comfort = { at = "8 mm", stiffness = "20 MN/m" }
[run]
duration = "60 ms"
"#;
    let (_folder, path) = written(scene);
    let shown = said_out(&["run", &path, "--plot", "never"]);
    let rest = shown.split("peak force ").nth(1).unwrap();
    let value: f64 = rest.split(' ').next().unwrap().parse().unwrap();
    assert!(
        rest.starts_with(&format!("{} kN in comfort.contact", rest.split(' ').next().unwrap()))
    );
    // Of the head alone: its mass times its peak deceleration.
    let own = json(&["run", &path, "--json"])["runs"][0]["measures"].clone();
    let force = 5.0 * own["head.peak-acceleration"]["value"].as_f64().unwrap();
    // To half of the last of three digits.
    assert!((value - 1e-3 * force).abs() <= 0.051, "{value} kN, {force} N: {shown}");
}
