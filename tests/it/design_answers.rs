//! What `dashpot design` answers besides the best numbers: fronts, scatter, sums and orders, sections and folders.

use std::fs;

use dashpot::analysis::Odds;
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// 5 kg at 4 m/s on an elastic block whose strain is at most 1: peak² · thickness = v² E A/m, and peak · depth = v².
const BLOCK: &str = r#"title = "An elastic block"

[materials.rubber]
parallel = [{ spring = "1 MPa" }]

[nodes]
head = { mass = "5 kg", velocity = "4 m/s" }

[elements]
pad = { between = ["head", "ground"], material = "rubber", thickness = "30 mm", area = "40 cm^2" }

[run]
duration = "80 ms"
"#;

const BOTH: [&str; 4] = ["--vary", "pad.thickness=10..40 mm", "--vary", "pad.area=5..200 cm^2"];

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

pub(crate) fn squeezed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn the_front_of_thickness_and_peak_is_a_hyperbola() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "block.toml", BLOCK);
    let results = folder.path().join("results");
    let both = ["--least", "pad.thickness", "--and", "head.peak-acceleration", "--points", "5"];
    let arguments = [&["design", text(&path)][..], &BOTH, &both].concat();
    let own = json(&[&arguments[..], &["--json"]].concat());
    let front = own["front"].as_array().unwrap();
    assert_eq!(front.len(), 5, "{front:?}");
    for point in front {
        // Pressed to its thickness: peak · thickness = v².
        let [thickness, peak] = ["least", "and"].map(|own| number(&point[own]["value"]));
        assert!((thickness * peak / 16.0 - 1.0).abs() < 1e-5, "{point}");
        assert!(number(&point["and"]["error"]) < 1e-6 * peak, "{point}");
        assert_eq!(point["active"][0], "thickness of pad");
    }
    let ends = [0, 4].map(|at: usize| number(&front[at]["least"]["value"]));
    assert!((ends[0] - 0.01).abs() < 1e-7 && (ends[1] - 0.04).abs() < 1e-6, "{ends:?}");

    let output = run(&[&arguments[..], &["--out", text(&results)]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    let said = squeezed(&out(&output));
    assert!(said.contains("front 5 designs, each with the least pad.thickness"), "{said}");
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    assert!(read("front.svg").contains("The least pad.thickness for its head.peak-acceleration"));
    assert!(read("map.svg").contains("thickness of pad") && read("map.svg").contains("best"));
    assert!(read("limits-1.svg").contains("used of what is allowed"));
    assert!(read("report.html").contains("What was found"));
    assert_eq!(read("front.csv").lines().count(), 6);
    let found: Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(found["front"].as_array().unwrap().len(), 5);
    // No design of the grid that keeps everything has less of both.
    let table = read("designs.csv");
    let mut rows = table.lines();
    let header: Vec<&str> = rows.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|own| own.contains(name)).unwrap();
    let (thickness, area, depth) =
        (column("pad.thickness"), column("pad.area"), column("thickness of pad"));
    for row in rows {
        let cells: Vec<f64> = row.split(',').map(|own| own.parse().unwrap_or(f64::NAN)).collect();
        if cells[depth] <= 1.0 {
            // Its peak is v √(E A/(m T)).
            let peak = 4.0 * (1e6 * cells[area] / (5.0 * cells[thickness])).sqrt();
            assert!(cells[thickness] * peak > 16.0 * (1.0 - 1e-9), "{row}");
        }
    }
}

/// The law ends at half the strain, where an elastic block of v = 4 m/s, m = 5 kg, E = 10⁶ Pa and A = 40 cm² is
/// v² m/(E A ε²) = 80 mm thick.
#[test]
fn a_law_that_ends_before_the_thickness_holds_the_design() {
    let folder = TempDir::new().unwrap();
    let ends = "{ table-spring = [[0, 0], [\"50 %\", \"500 kPa\"]] }";
    let path = file(&folder, "block.toml", &BLOCK.replace("{ spring = \"1 MPa\" }", ends));
    let vary = ["--vary", "pad.thickness=20..200 mm", "--least", "pad.thickness"];
    let limit = ["--limit", "head.peak-acceleration<=900 g"];
    let arguments = [&["design", text(&path)][..], &vary, &limit].concat();
    let own = squeezed(&out(&run(&arguments)));
    assert!(
        own.contains("pad.table-spring is pressed to 100.00 % of the range of its law"),
        "{own}"
    );
    let own = json(&[&arguments[..], &["--json"]].concat());
    let aim = number(&own["aim"]);
    assert!((aim / 0.08 - 1.0).abs() < 1e-5, "{aim}");
}

#[test]
fn areas_and_other_numbers_are_told_in_the_units_of_the_scene() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "block.toml", BLOCK);
    let least = ["--least", "head.peak-acceleration"];
    let own = squeezed(&out(&run(&[&["design", text(&path)][..], &BOTH, &least].concat())));
    assert!(own.contains("between 5 cm^2 and 200 cm^2"), "{own}");
    assert!(
        own.contains("pad.thickness = 40.000 mm, between 10 mm and 40 mm, AT ITS UPPER"),
        "{own}"
    );
    // Steps alone: no search, no derivatives, and no digits of a division.
    let steps = ["--vary", "pad.thickness=10..40 mm,20", "--least", "head.peak-acceleration"];
    let own = run(&[&["design", text(&path)][..], &steps].concat());
    let own = squeezed(&out(&own));
    assert!(own.contains("search all 20 choices are solved"), "{own}");
    assert!(own.contains("38.42105 mm") && !own.contains("1 % more of"), "{own}");
    let own = json(&[&["design", text(&path), "--json"][..], &steps].concat());
    assert_eq!(own["tests"][0]["name"], Value::Null);
    assert!(own["measures"]["head.peak-acceleration"]["value"].is_f64(), "{}", own["measures"]);
    assert_eq!(own["floor"]["head.peak-acceleration"]["unit"], "m/s^2");
}

#[test]
fn a_section_sets_options_and_the_command_stands_above_it() {
    let folder = TempDir::new().unwrap();
    let section = "\n[design]\nvary = [\"pad.thickness=10..40 mm\", \"pad.area=5..200 cm^2\"]\n\
                   least = \"pad.thickness\"\nlimit = \"head.peak-acceleration<=60 g\"\nsample = 100\n";
    let path = file(&folder, "block.toml", &(BLOCK.to_owned() + section));
    let best = folder.path().join("best.toml");
    assert_eq!(code(&run(&["check", text(&path)])), 0);
    let own = json(&["design", text(&path), "--json"]);
    // T = v²/peak.
    let right = 16.0 / (60.0 * 9.80665);
    assert!((number(&own["aim"]) / right - 1.0).abs() < 1e-5, "{}", own["aim"]);
    assert_eq!(own["search"]["designs"], 100);
    let own = json(&["design", text(&path), "--limit", "head.peak-acceleration<=80 g", "--json"]);
    assert!((number(&own["aim"]) / (0.75 * right) - 1.0).abs() < 1e-5, "{}", own["aim"]);
    // It stays in the scene that is written, which passes.
    assert_eq!(code(&run(&["design", text(&path), "--out", text(&best)])), 0);
    let written = fs::read_to_string(&best).unwrap();
    assert!(written.contains("[design]") && written.contains(" cm^2\""), "{written}");
    let limit = ["--limit", "head.peak-acceleration<=60 g", "--enforce"];
    assert_eq!(code(&run(&[&["run", text(&best)][..], &limit].concat())), 0);
    let solved = json(&["design", text(&path), "--solve-for", "pad.area", "--json"]);
    assert!(
        solved["parameters"]["pad.thickness"].is_null()
            && solved["parameters"]["pad.area"].is_object()
    );
    let wrong =
        file(&folder, "wrong.toml", &(BLOCK.to_owned() + "\n[design]\nvari = \"K=1..2\"\n"));
    let output = run(&["design", text(&wrong)]);
    assert!(code(&output) == 2 && err(&output).contains("vari"), "{}", err(&output));
}

#[test]
fn a_robust_design_passes_with_the_probability_that_is_asked_for() {
    let folder = TempDir::new().unwrap();
    // v √(K m) ≤ F with 90 % where K is at its 90 % value.
    let scene = "[nodes]\nhead = { mass = \"4 kg\", velocity = \"5 m/s\" }\n[elements]\n\
                 pad = { between = [\"head\", \"ground\"], spring = \"40 ± 4 kN/m\" }\n\
                 [limits]\npad.peak-force = \"2.5 kN\"\n[run]\nduration = \"100 ms\"\n\
                 [design]\nvary = \"head.mass=1..20 kg\"\nleast = \"head.peak-acceleration\"\n";
    let path = file(&folder, "spring.toml", scene);
    let plain = json(&["design", text(&path), "--json"]);
    let mass = |own: &Value| number(&own["parameters"]["head.mass"]["value"]);
    assert!((mass(&plain) / 6.25 - 1.0).abs() < 1e-4, "{}", mass(&plain));
    // On its limit, half of them fail.
    let chance = |own: &Value| number(&own["tests"][0]["scatter"]["limits"][0]["probability"]);
    assert!((chance(&plain) - 0.5).abs() < 0.02, "{}", chance(&plain));
    let said = squeezed(&out(&run(&["design", text(&path)])));
    assert!(
        said.contains("keeps everything at the means of what has scatter: `--robust 95%`"),
        "{said}"
    );
    let robust = json(&["design", text(&path), "--robust", "90%", "--json"]);
    // 464 of 500 show 90 %, and lie below 1.461 standard deviations.
    assert_eq!(Odds::least_kept(0.9, 500), Some(464));
    let right = (2500.0_f64 / 5.0).powi(2) / (40e3 + 1.461_056 * 4e3);
    assert!((mass(&robust) / right - 1.0).abs() < 5e-3, "{} {right}", mass(&robust));
    assert!(robust["robust"]["enough"] == true && (chance(&robust) - 0.928).abs() < 0.005);
    let said = squeezed(&out(&run(&["design", text(&path), "--robust", "90%"])));
    assert!(
        said.contains("with a probability of 90.0 %") && said.contains("probability to pass 9"),
        "{said}"
    );
    // Fewer than n = w z²/(1 − w) show no probability w, even if all of them keep everything.
    let output = run(&["design", text(&path), "--robust", "99%", "--scatter", "300"]);
    assert!(code(&output) == 2 && err(&output).contains("--scatter 381"), "{}", err(&output));
    // Without scatter there is nothing to bear, and without two aims no front.
    let bare = file(&folder, "bare.toml", &scene.replace(" ± 4", ""));
    for (options, reason) in [
        (&["--robust", "90%"][..], "no number of the scene has scatter"),
        (&["--seed", "3"], "no number of the scene has scatter"),
        (&["--scatter", "30"], "no number of the scene has scatter"),
        (&["--points", "3"], "a front of two aims"),
    ] {
        let output = run(&[&["design", text(&bare)], options].concat());
        assert!(code(&output) == 2 && err(&output).contains(reason), "{}", err(&output));
    }
}

/// 5 kg at 4 m/s on a spring that holds a limit: v √(K m) ≤ F.
const HELD: &str = "[nodes]\nhead = { mass = \"5 kg\", velocity = \"4 m/s\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], spring = \"40 kN/m\", thickness = \"90 mm\" }\n\
     [run]\nduration = \"100 ms\"\n";

#[test]
fn a_design_that_is_written_again_keeps_its_limits() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "held.toml", HELD);
    let best = folder.path().join("best.toml");
    // The nearest decimals, 4.9451 of 4.945064 kg and 4.9395 of 4.939506 kg, are on the wrong side.
    for (limit, least, force) in [
        ("pad.peak-force<=1.779 kN", "head.peak-acceleration", 1779.0_f64),
        ("pad.peak-force>=1.778 kN", "head.mass", 1778.0),
    ] {
        let exact = (force / 4.0).powi(2) / 40e3;
        let vary = ["design", text(&path), "--vary", "head.mass=1..20 kg", "--least", least];
        let limits = ["--limit", limit];
        let to = ["--out", text(&best), "--force"];
        let output = run(&[&vary[..], &limits, &to].concat());
        let said = squeezed(&out(&output));
        let shown = said.split("head.mass = ").nth(1).and_then(|own| own.split(" kg").next());
        let shown = shown.unwrap();
        let written: f64 = shown.parse().unwrap();
        assert!((written / exact - 1.0).abs() < 1e-4, "{written} {exact}");
        let set = format!("head.mass={shown} kg");
        let again = ["run", text(&path), "--set", &set, "--enforce"];
        let output = run(&[&again[..], &limits].concat());
        assert_eq!(code(&output), 0, "{shown}: {}", out(&output));
        // The limits of the command are in the scene that is written.
        let kept = json(&["run", text(&best), "--json"]);
        let all = kept["runs"][0]["limits"].as_array().unwrap();
        assert!(all.len() == 1 && all[0]["key"] == "pad.peak-force", "{all:?}");
    }
}

#[test]
fn a_number_that_moves_nothing_is_named() {
    let folder = TempDir::new().unwrap();
    // A law in N/m is the same whatever the thickness.
    let path = file(&folder, "held.toml", HELD);
    let vary = ["--vary", "head.mass=1..20 kg", "--vary", "pad.thickness=80..120 mm"];
    let least = ["--least", "head.peak-acceleration", "--limit", "pad.peak-force<=1.5 kN"];
    let arguments = [&["design", text(&path)][..], &vary, &least].concat();
    let said = squeezed(&out(&run(&arguments)));
    assert!(!said.contains("head.mass moves nothing"), "{said}");
    // It changes the depth in parts of the thickness, which has to stay below 1.
    assert!(!said.contains("pad.thickness moves nothing"), "{said}");
    let damped = HELD.replace(
        "[run]",
        "stay = { between = [\"post\", \"ground\"], spring = \"1 kN/m\" }\n[run]",
    );
    let damped = damped.replace("[elements]", "post = { mass = \"1 kg\" }\n[elements]");
    let damped = file(&folder, "damped.toml", &damped);
    let vary = ["--vary", "head.mass=1..20 kg", "--vary", "stay.spring=1..9 kN/m"];
    let arguments = [&["design", text(&damped)][..], &vary, &least].concat();
    let answer = json(&[&arguments[..], &["--json"]].concat());
    assert_eq!(answer["unmoved"], serde_json::json!(["stay.spring"]));
    let said = squeezed(&out(&run(&arguments)));
    assert!(said.contains("stay.spring moves nothing that is limited or made least"), "{said}");
}

/// Two layers with a free joint between them.
const STACK: &str = r#"[materials.soft]
parallel = [{ spring = "0.1 MPa" }, { dashpot = "20 Pa s" }]

[materials.hard]
parallel = [{ spring = "0.5 MPa" }, { dashpot = "4 kPa s" }]

[nodes]
head = { mass = "5 kg", velocity = "3 m/s" }
between = {}

[elements]
front = { between = ["head", "between"], material = "soft", thickness = "30 mm", area = "150 cm^2" }
back  = { between = ["between", "ground"], material = "hard", thickness = "30 mm", area = "150 cm^2" }

[run]
duration = "80 ms"
"#;

#[test]
fn layers_without_mass_answer_the_same_in_any_order() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "stack.toml", STACK);
    let arguments = [
        "design",
        text(&path),
        "--vary",
        "front.thickness=2..58 mm",
        "--vary",
        "back.thickness=2..58 mm",
        "--total",
        "front.thickness+back.thickness=60 mm",
        "--vary",
        "front.material,back.material=soft,hard",
        "--least",
        "head.peak-acceleration",
    ];
    // A limit at which rounding both to the safe side would be a thousandth too much.
    let limited = [&arguments[..], &["--limit", "head.peak-displacement<=30 mm"]].concat();
    let said = out(&run(&limited));
    let printed = ["front", "back"].map(|layer| {
        let line = said.split_once(&format!("{layer}.thickness = ")).map_or("", |own| own.1);
        line.split(' ').next().unwrap().parse::<f64>().unwrap()
    });
    assert!((printed[0] + printed[1] - 60.0).abs() < 1e-9, "{said}");
    let own = json(&[&arguments[..], &["--json"]].concat());
    let choices = own["choices"].as_array().unwrap();
    assert_eq!(choices.len(), 2);
    let aims = [0, 1].map(|at: usize| number(&choices[at]["aim"]));
    assert!((aims[0] / aims[1] - 1.0).abs() < 1e-6, "{aims:?}");
    let thickness = |at: usize, name: &str| number(&choices[at]["parameters"][name]["value"]);
    for at in [0, 1] {
        let sum = thickness(at, "front.thickness") + thickness(at, "back.thickness");
        assert!((sum - 0.06).abs() < 1e-12, "{sum}");
    }
    let crossed = thickness(0, "front.thickness") - thickness(1, "back.thickness");
    assert!(crossed.abs() < 2e-4, "{choices:?}");
}

#[test]
fn what_contradicts_itself_says_what_to_write() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "block.toml", BLOCK);
    let least = ["--least", "head.peak-acceleration"];
    let vary = &BOTH[..];
    let cases: [(&[&str], &str); 7] = [
        (&["--total", "pad.thickness+pad.area=3 mm"], "do not measure the same"),
        (&["--total", "pad.thickness=30 mm"], "two numbers or more"),
        (&["--total", "pad.thickness+pad.width=30 mm"], "`pad.width` does not vary"),
        (&["--and", "head.peak-acceleration"], "made least already"),
        (&["--set", "pad.thickness=20 mm"], "set and varied"),
        (&["--test", "thin: pad.thickness=20 mm"], "set and varied"),
        (&["--robust", "20%"], "at least 50%"),
    ];
    for (arguments, told) in cases {
        let output = run(&[&["design", text(&path)][..], vary, &least, arguments].concat());
        let said = squeezed(&err(&output));
        assert!(code(&output) == 2 && said.contains(told), "{arguments:?}: {said}");
    }
    let output = run(&["design", text(&path), "--least", "head.peak-acceleration"]);
    assert!(code(&output) == 2 && err(&output).contains("what may vary"), "{}", err(&output));
    let one = ["--vary", "pad.material,head.mass=rubber"];
    let output = run(&[&["design", text(&path)][..], &one, &least].concat());
    let said = squeezed(&err(&output));
    assert!(code(&output) == 2 && said.contains("as many words as names"), "{said}");
}

#[test]
fn what_scatters_together_in_the_scene_of_a_test_is_borne() {
    let folder = TempDir::new().unwrap();
    // The peak force is v √(K m): that of the faster test decides, where K scatters.
    let scene = |velocity: &str, more: &str| {
        format!(
            "[nodes]\nhead = {{ mass = \"4 kg\", velocity = \"{velocity}\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], spring = \"40 kN/m\" }}\n\
             [limits]\npad.peak-force = \"2.5 kN\"\n[run]\nduration = \"200 ms\"\n{more}"
        )
    };
    let scatter = "[scatter]\ntogether = [{ \"pad.spring\" = \"10 %\" }]\n";
    let slow = file(&folder, "slow.toml", &scene("2 m/s", ""));
    let fast = file(&folder, "fast.toml", &scene("5 m/s", scatter));
    let asked = ["--vary", "head.mass=1..20 kg", "--least", "head.peak-acceleration"];
    let tests = ["--test", text(&slow), "--test", text(&fast), "--robust", "90%", "--json"];
    let own = json(&[&["design", text(&slow)][..], &asked, &tests].concat());
    let mass = number(&own["parameters"]["head.mass"]["value"]);
    let right = 500.0_f64.powi(2) / (40e3 * (0.1_f64 * 1.461_056).exp());
    assert!((mass / right - 1.0).abs() < 5e-3, "{mass} {right}");
    assert!(own["robust"]["enough"] == true, "{}", own["robust"]);
}

#[test]
fn a_number_that_is_given_no_values_says_what_to_write() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "block.toml", BLOCK);
    for vary in ["pad.thickness", "pad.thickness="] {
        let output = run(&["design", text(&path), "--vary", vary, "--least", "pad.thickness"]);
        let said = squeezed(&err(&output));
        assert_eq!(code(&output), 2, "{said}");
        assert!(said.contains("`pad.thickness` is given no values"), "{said}");
        let example = said.split('"').nth(1).unwrap().replace(' ', "");
        assert!(example.starts_with("pad.thickness=") && example.contains(".."), "{said}");
    }
    let output = run(&["design", text(&path), "--vary", "pad", "--least", "pad.thickness"]);
    let said = squeezed(&err(&output));
    assert!(code(&output) == 2 && said.contains("\"pad=10..60 mm\""), "{said}");
}
