//! Designs: closed forms from any start, every gallery scene that has a limit, and what the command says.

use std::fmt::Write as _;

use dashpot::{
    analysis::{
        Bound, Limit, SolveSettings,
        sweep::{PoseAt, ScenePoint},
    },
    design::optimum::{Aim, Design, Effort, Problem, Variable, design},
    network::{Model, Network, Node, dashpot, spring},
};
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, text},
    random_networks::Dice,
};

const SPEED: f64 = 5.0;
const TRAVEL: f64 = 0.03;

/// 1 kg on a pad that may come in by so much; what is made least is limited by nothing.
fn scene(model: Model, key: &str) -> ScenePoint {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(SPEED));
    network.connect("pad", head, network.ground(), model);
    let mut settings = SolveSettings::lasting(0.2);
    settings.limits = vec![
        Limit::new("pad.peak-deformation", Bound::Max(TRAVEL)),
        Limit::new(key, Bound::Max(1e12)),
    ];
    ScenePoint { network, settings }
}

/// A pad of these numbers.
type Pad = dyn Fn(&[f64]) -> Model + Sync;

fn kelvin(values: &[f64]) -> Model {
    spring(values[0] * values[0]) | dashpot(2.0 * values[1] * values[0])
}

fn maxwell(values: &[f64]) -> Model {
    spring(values[0] * values[0]) + dashpot(values[1] * values[0])
}

/// A frequency \[1/s\] and a damping ratio, each somewhere between its bounds.
fn variables(dice: &mut Dice) -> [Variable; 2] {
    let mut within = |low: f64, high: f64| {
        let start = low * (high / low).powf(dice.unit());
        Variable { low, high, start }
    };
    [within(20.0, 2000.0), within(0.05, 3.0)]
}

fn from_one_start(model: &(dyn Fn(&[f64]) -> Model + Sync), key: &str, dice: &mut Dice) -> Design {
    let pose = |values: &[f64]| Ok(scene(model(values), key));
    let (aim, pose): (_, &PoseAt<'_>) = (Aim::Measure(key.to_owned()), &pose);
    let effort = Effort { designs: 0, starts: 1, threads: 1 };
    searched(&variables(dice), &aim, pose, effort)
}

fn searched(variables: &[Variable], aim: &Aim, pose: &PoseAt<'_>, effort: Effort) -> Design {
    design(&Problem { variables, totals: &[], aim, tests: &[pose] }, effort).unwrap()
}

#[test]
fn the_best_pads_of_two_parts_are_found_from_every_start() {
    from_all_starts(12);
}

#[test]
#[ignore = "a campaign: a minute"]
fn the_best_pads_of_two_parts_are_found_from_100_of_100_starts() {
    from_all_starts(100);
}

fn from_all_starts(count: usize) {
    let unit = SPEED * SPEED / TRAVEL;
    let hic = (SPEED / 9.80665).powf(2.5) * (3.0 * SPEED / (8.0 * TRAVEL)).powf(1.5);
    let cases: [(&Pad, _, _, _, _); 3] = [
        // Best value in parts of a unit, and the ratio that has it.
        (&kelvin, "head.peak-acceleration", unit, 0.5206, 0.404),
        (&kelvin, "head.hic", hic, 1.125, 0.997),
        (&maxwell, "head.peak-acceleration", unit, 0.688, 0.714),
    ];
    for (model, key, unit, least, ratio) in cases {
        let mut dice = Dice(7);
        let all: Vec<Design> = (0..count).map(|_| from_one_start(model, key, &mut dice)).collect();
        let best = all.iter().map(|own| own.aim).fold(f64::INFINITY, f64::min);
        assert!((best / unit / least - 1.0).abs() < 1e-3, "{key}: {}", best / unit);
        // To 1e-6, beside that by which bounds are drawn in where an error bar reaches across.
        let is_there = |own: &&Design| own.is_feasible && own.aim < best * (1.0 + 2e-6);
        assert_eq!(all.iter().filter(is_there).count(), count, "{key}");
        assert!((all[0].values[1] / ratio - 1.0).abs() < 5e-3, "{key}: {:?}", all[0].values);
    }
}

#[test]
fn a_maxwell_branch_beside_it_does_not_beat_a_kelvin_pad() {
    let key = "head.peak-acceleration";
    let zener = |values: &[f64]| -> Model {
        let &[omega, ratio, stiffer] = values else { unreachable!() };
        let stiffness = omega * omega;
        spring(stiffness) | (spring(stiffer * stiffness) + dashpot(2.0 * ratio * omega))
    };
    let pose = |values: &[f64]| Ok(scene(zener(values), key));
    let pose: &PoseAt<'_> = &pose;
    let mut dice = Dice(3);
    let [omega, ratio] = variables(&mut dice);
    let stiffer = Variable { low: 0.1, high: 1e4, start: 1.0 };
    let aim = Aim::Measure(key.to_owned());
    let own = searched(&[omega, ratio, stiffer], &aim, pose, Effort::default());
    let part = own.aim * TRAVEL / (SPEED * SPEED);
    assert!(own.is_feasible && part > 0.5206 - 5e-5 && part < 0.5215, "{part} {:?}", own.values);
}

const HELMET: &str = r#"title = "Headform of 5 kg on a liner"

[materials.soft]
parallel = [{ spring = "0.9 MPa" }, { dashpot = "1.5 kPa s" }]

[materials.hard]
parallel = [{ spring = "2.4 MPa" }, { dashpot = "2 kPa s" }]

[nodes]
head = { mass = "5 kg", velocity = "5.42 m/s" }

[elements]
liner = { between = ["head", "ground"], material = "soft", thickness = "30 mm", area = "60 cm^2" }

[effects]
separation.liner = {}

[limits]
head.peak-acceleration = "150 g"

[run]
duration = "50 ms"
"#;

#[test]
fn the_command_finds_what_a_sweep_shows_and_writes_it() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "helmet.toml", HELMET);
    let fitted = folder.path().join("best.toml");
    let arguments = [
        "design",
        text(&path),
        "--vary",
        "liner.thickness=10..60 mm",
        "--least",
        "liner.thickness",
        "--vary",
        "liner.material=soft,hard",
    ];
    let output = run(&[&arguments[..], &["--out", text(&fitted)]].concat());
    println!("{}{}", out(&output), err(&output));
    assert_eq!(code(&output), 0);
    let object = json(&[&arguments[..], &["--json"]].concat());
    assert_eq!(object["feasible"], true);
    let thickness = object["parameters"]["liner.thickness"]["value"].as_f64().unwrap();
    // The scene that was written passes, and one that is 0.1 % thinner does not.
    assert_eq!(code(&run(&["run", text(&fitted), "--enforce"])), 0);
    let material = object["parameters"]["liner.material"]["word"].as_str().unwrap().to_owned();
    let thinner = format!("liner.thickness={} m", 0.999 * thickness);
    let material = format!("liner.material={material}");
    let enforced = ["run", text(&path), "--set", &thinner, "--set", &material, "--enforce"];
    let thin = json(&[&enforced[..6], &["--json"]].concat());
    let run_of = &thin["runs"][0];
    let peak = run_of["measures"]["head.peak-acceleration"]["value"].as_f64().unwrap();
    let depth = run_of["measures"]["liner.peak-deformation"]["value"].as_f64().unwrap();
    assert!(peak > 150.0 * 9.80665 || depth > 0.999 * thickness, "{peak} {depth} {thickness}");
    let solved = json(&["design", text(&path), "--solve-for", "liner.thickness", "--json"]);
    assert_eq!(solved["feasible"], true);
    assert!(solved["aim"].as_f64().unwrap() >= thickness * (1.0 - 1e-6));
}

#[test]
fn what_cannot_be_asked_for_says_what_to_write() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "helmet.toml", HELMET);
    let path = text(&path);
    for (arguments, told) in [
        (vec!["--vary", "liner.thickness=10..60 mm", "--least", "liner.area"], "does not vary"),
        (vec!["--vary", "liner.thicknes=10..60 mm", "--least", "head.hic15"], "liner.thickness"),
        (vec!["--vary", "liner.thickness=10..60 mm", "--least", "head.hic1"], "hic1"),
        (vec!["--solve-for", "liner.thicknes"], "liner.thickness"),
        (vec!["--vary", "liner.thickness=10..60 mm"], "--least"),
        (
            vec!["--vary", "liner.thickness=10..10 mm", "--least", "head.hic15"],
            "lower and an upper",
        ),
        (vec!["--vary", "liner.thickness=10..60 mm", "--least", "peak-force"], "liner.peak-force"),
        (
            vec!["--vary", "liner.area=1..9 cm^2", "--least", "liner.area", "--test", "a.tom"],
            "a scene",
        ),
    ] {
        let output = run(&[&["design", path][..], &arguments].concat());
        println!("{arguments:?}\n{}", err(&output));
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(err(&output).contains(told), "{arguments:?}: {}", err(&output));
    }
    // A word that is no material is told, whatever the others come to.
    let words = ["--vary", "liner.material=soft,hrad", "--least", "head.peak-acceleration"];
    let said = out(&run(&[&["design", path][..], &words].concat()));
    assert!(said.contains("! liner.material = hrad has no design"), "{said}");
    // Both at once cannot be: which limits, and by how much.
    let output = run(&[
        "design",
        path,
        "--solve-for",
        "liner.thickness",
        "--limit",
        "liner.peak-deformation<=5 mm",
        "--enforce",
    ]);
    let said = out(&output);
    println!("{said}");
    assert!(code(&output) == 4 && said.contains("NONE") && said.contains("peak-deformation by"));
}

/// What may vary in the one of which no design keeps its limit.
const HIP: &str = "pad.stiffening-spring.stiffness=20..300 kN/m,12,log";
/// The scenes of the gallery that have limits, and how many designs of each are looked at.
const LIMITED: [(&str, &str); 4] = [
    ("eps-helmet", "24"),
    ("helmet-drop", "24"),
    ("hip-protector", "16"),
    ("instrument-drop", "24"),
];

#[test]
fn search_and_grid_agree_in_every_gallery_scene_that_has_limits() {
    let limited = std::fs::read_dir("scenes").unwrap().filter_map(|own| {
        let path = own.unwrap().path();
        let text = std::fs::read_to_string(&path).ok()?;
        let name = path.file_stem()?.to_str()?.to_owned();
        text.contains("\n[limits]").then_some((name, text.contains("\n[design]")))
    });
    let mut limited: Vec<(String, bool)> = limited.collect();
    limited.sort();
    let known = LIMITED.map(|own| (own.0.to_owned(), true));
    assert_eq!(limited, known, "each has a section [design], and is looked at here");
    for (name, count) in LIMITED {
        let scene = format!("scenes/{name}.toml");
        let own = json(&["design", &scene, "--sample", count, "--json"]);
        let search = &own["search"];
        println!("{name}: {} {search} active {}", own["aim"], own["active"]);
        assert_eq!(
            (&search["is_grid"], &own["floor"].is_object()),
            (&true.into(), &true),
            "{name}"
        );
        // Nothing of the grid is better than what was found, from wherever the search began.
        if own["feasible"] == true {
            assert!(search["agree"].as_u64().unwrap() > 0, "{name}: {search}");
            continue;
        }
        // Or the command says what is exceeded, and no stiffness of the grid exceeds it by less.
        let most = own["limits"][0]["max"].as_f64().unwrap();
        let least = own["limits"][0]["value"].as_f64().unwrap();
        assert!(least > most && search["feasible"] == 0, "{name}: {}", own["limits"]);
        let swept =
            json(&["sweep", &scene, "--vary", HIP, "--measure", "tissue.peak-force", "--json"]);
        let swept = swept["measures"][0]["values"].as_array().unwrap();
        let swept = swept.iter().map(|own| own.as_f64().unwrap());
        assert!(swept.fold(f64::INFINITY, f64::min) > least * (1.0 - 1e-4), "{name}: {least}");
        let said = out(&run(&["design", &scene, "--sample", count]));
        assert!(said.contains("NONE") && said.contains("tissue.peak-force by"), "{said}");
    }
}

/// 4 kg at 2 m/s on a spring that is a part of `K`, with limits on both sides.
fn spring_scene(part: &str, limits: &str) -> String {
    format!(
        "[values]\nK = \"50 kN/m\"\n[nodes]\nbox = {{ mass = \"4 kg\", velocity = \"2 m/s\" }}\n\
         [elements]\npad = {{ between = [\"box\", \"ground\"], spring = \"K * {part}\" }}\n\
         [limits]\n{limits}\n[run]\nduration = \"100 ms\"\n"
    )
}

const BOTH: &str = "pad.peak-deformation = \"20 mm\"\npad.peak-force = \"2 kN\"";

#[test]
fn scenes_of_their_own_are_tests_and_each_limit_names_the_one_that_decides_it() {
    let folder = TempDir::new().unwrap();
    file(&folder, "hot.toml", &spring_scene("0.5", BOTH));
    file(&folder, "cold.toml", &spring_scene("2", BOTH));
    let section = "[design]\nvary = \"K=10..500 kN/m\"\nleast = \"K\"\n\
                   test = [\"hot.toml\", \"winter: cold.toml\"]\n";
    let path =
        file(&folder, "pad.toml", &(spring_scene("1", "pad.peak-force = \"1 N\"") + section));
    // m v² / x² of half of it; the force v √(2 K m) of the other is below its limit.
    let own = json(&["design", text(&path), "--json"]);
    let (speed, mass, depth) = (2.0_f64, 4.0, 0.02);
    let stiffness = 2.0 * mass * speed * speed / (depth * depth);
    let found = own["parameters"]["K"]["value"].as_f64().unwrap();
    assert!((found / stiffness - 1.0).abs() < 1e-5 && own["feasible"] == true, "{found}");
    let decided: Vec<_> =
        own["limits"].as_array().unwrap().iter().filter(|own| own["decides"] == true).collect();
    let told =
        |at: usize| (decided[at]["test"].as_str().unwrap(), decided[at]["key"].as_str().unwrap());
    assert_eq!(decided.len(), 2, "{}", own["limits"]);
    assert_eq!([told(0), told(1)], [("hot", "pad.peak-deformation"), ("winter", "pad.peak-force")]);
    let force = decided[1]["value"].as_f64().unwrap();
    assert!((force / (speed * (2.0 * found * mass).sqrt()) - 1.0).abs() < 1e-9);
    // The least force is that of the stiffer test, and the other one holds it.
    let answer = folder.path().join("answer");
    let least = ["--least", "pad.peak-force", "--out", text(&answer)];
    let output = run(&[&["design", text(&path)][..], &least].concat());
    let said = out(&output);
    println!("{said}{}", err(&output));
    assert!(
        said.contains("in winter") && said.contains("hot: pad.peak-deformation is at its limit")
    );
    for name in ["best-2.toml", "best-3.toml"] {
        let path = answer.join(name);
        assert_eq!(code(&run(&["run", text(&path), "--enforce"])), 0, "{name}");
    }
    // Both at once cannot be: which tests contradict each other.
    let limit = ["--limit", "pad.peak-force<=1 kN"];
    let said = out(&run(&[&["design", text(&path)][..], &limit].concat()));
    assert!(
        said.contains("hot: pad.peak-deformation by") && said.contains("winter: pad.peak-force by"),
        "{said}"
    );
    // A scene without the number, and one in which it is something else.
    let other = spring_scene("1", BOTH);
    for (name, text_of, told) in [
        ("none.toml", other.replace("K =", "L =").replace("K *", "L *"), "`K` is sought"),
        ("mass.toml", other.replace("50 kN/m", "50 kg").replace("K * 1", "5 kN/m"), "in kg"),
        ("broken.toml", "[nodes".to_owned(), "broken.toml"),
    ] {
        let scene = file(&folder, name, &text_of);
        let output = run(&["design", text(&path), "--test", text(&scene)]);
        println!("{}", err(&output));
        assert!(code(&output) == 2 && err(&output).contains(told), "{name}: {}", err(&output));
    }
}

/// 5 kg on three layers with masses between them, so that their order matters.
const LAYERS: &str = r#"[materials]
soft = { parallel = [{ spring = "0.15 MPa" }, { dashpot = "100 Pa s" }] }
medium = { parallel = [{ spring = "0.3 MPa" }, { dashpot = "1 kPa s" }] }
hard = { parallel = [{ spring = "0.7 MPa" }, { dashpot = "4 kPa s" }] }

[nodes]
head = { mass = "5 kg", velocity = "3 m/s" }
upper = { mass = "0.4 kg" }
lower = { mass = "0.8 kg" }

[elements]
front = { between = ["head", "upper"], material = "soft", thickness = "20 mm", area = "150 cm^2" }
middle = { between = ["upper", "lower"], material = "medium", thickness = "20 mm", area = "150 cm^2" }
back = { between = ["lower", "ground"], material = "hard", thickness = "20 mm", area = "150 cm^2" }

[effects]
separation.front = { at = "head" }

[run]
duration = "80 ms"
"#;
const OF_LAYERS: [&str; 3] = ["front", "middle", "back"];
/// Their thickness in all, and the steps of a grid over it \[mm\].
const WHOLE: i32 = 60;
const STEP: usize = 4;

#[test]
fn the_best_of_three_layers_is_that_of_all_orders_and_thicknesses() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "layers.toml", LAYERS);
    let mut rows = OF_LAYERS.map(|own| format!("{own}.thickness [mm]")).join(",") + "\n";
    for front in (4..WHOLE).step_by(STEP) {
        for middle in (4..WHOLE - front - 3).step_by(STEP) {
            writeln!(rows, "{front},{middle},{}", WHOLE - front - middle).unwrap();
        }
    }
    let grid = file(&folder, "grid.csv", &rows);
    // Every order and every point of the grid; a layer that is pressed by more than its thickness is none.
    let measures = "head.peak-acceleration,front.peak-strain,middle.peak-strain,back.peak-strain";
    let mut best = (f64::INFINITY, [""; 3], 0);
    let (soft, medium, hard) = ("soft", "medium", "hard");
    let orders = [
        [soft, medium, hard],
        [soft, hard, medium],
        [medium, soft, hard],
        [medium, hard, soft],
        [hard, soft, medium],
        [hard, medium, soft],
    ];
    for order in orders {
        let set = [0, 1, 2].map(|at| format!("{}.material={}", OF_LAYERS[at], order[at]));
        let asked =
            ["sweep", text(&path), "--points", text(&grid), "--measure", measures, "--json"];
        let set = ["--set", &set[0], "--set", &set[1], "--set", &set[2]];
        let own = json(&[&asked[..], &set].concat());
        let value = |measure: usize, at: usize| own["measures"][measure]["values"][at].as_f64();
        for at in 0..rows.lines().count() - 1 {
            let is_within = (1..4).all(|own| value(own, at).is_some_and(|own| own <= 1.0));
            let peak = value(0, at).filter(|_| is_within).unwrap_or(f64::INFINITY);
            if peak < best.0 {
                best = (peak, order, at);
            }
        }
    }
    let vary = OF_LAYERS.map(|own| format!("{own}.thickness=4..52 mm"));
    let total = OF_LAYERS.map(|own| format!("{own}.thickness")).join("+") + "=60 mm";
    let words = OF_LAYERS.map(|own| format!("{own}.material")).join(",") + "=soft,medium,hard";
    let asked =
        ["design", text(&path), "--least", "head.peak-acceleration", "--sample", "49", "--json"];
    let vary = ["--vary", &vary[0], "--vary", &vary[1], "--vary", &vary[2]];
    let own = json(&[&asked[..], &vary, &["--vary", &words, "--total", &total]].concat());
    let found = own["aim"].as_f64().unwrap();
    let order = OF_LAYERS.map(|of| own["parameters"][format!("{of}.material")]["word"].clone());
    println!(
        "{best:?} {:?}; {found} {order:?} {}",
        rows.lines().nth(best.2 + 1),
        own["parameters"]
    );
    assert_eq!(own["choices"].as_array().unwrap().len(), 6);
    // Not above the best of the grid, and below it by what its steps leave alone.
    assert!(order.iter().zip(best.1).all(|(own, known)| own == known), "{order:?} {:?}", best.1);
    assert!(found <= best.0 * (1.0 + 1e-6) && found > 0.97 * best.0, "{found} {}", best.0);
    let sum: f64 = OF_LAYERS
        .iter()
        .map(|of| own["parameters"][format!("{of}.thickness")]["value"].as_f64().unwrap())
        .sum();
    assert!((sum - 0.06).abs() < 1e-12);
}
