//! Designs: closed forms from any start, every gallery scene that has a limit, and what the command says.

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
    ] {
        let output = run(&[&["design", path][..], &arguments].concat());
        println!("{arguments:?}\n{}", err(&output));
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(err(&output).contains(told), "{arguments:?}: {}", err(&output));
    }
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
