//! What `run` says of an impact.

use tempfile::TempDir;

use super::{SOFT, code, err, file, json, out, run, text};

#[test]
fn run_without_a_scene_gives_the_verdict_on_the_reference_impact() {
    let output = run(&["run"]);
    let verdict = out(&output);
    assert_eq!(code(&output), 0);
    assert!(verdict.starts_with("! from 7.43 ms the padding is in tension: separation is off\n"));
    for fact in
        ["38.36 kN", "391.2 g (3836 m/s²)", "88 % of 20 mm, 2.46 mm left", "477.2 J of 500 J"]
    {
        assert!(verdict.contains(fact), "{fact}:\n{verdict}");
    }
    assert_eq!(
        err(&output),
        "warning: from 7.43 ms the padding is in tension: separation is off\n"
    );
    assert!(verdict.lines().all(|line| line.chars().count() <= 80), "{verdict}");
    assert!(!verdict.contains('\u{1b}'));
}

#[test]
fn the_verdict_names_the_longest_interval_of_a_head_injury_criterion() {
    let folder = TempDir::new().unwrap();
    let asked = "[measures]\nhead = [\"hic15\", \"hic36\", { kind = \"hic\", cap = \"5 ms\" }]\n";
    let path = file(&folder, "scene.toml", &(SOFT.to_owned() + asked));
    let verdict = out(&run(&["run", text(&path)]));
    let words = verdict.split_whitespace().collect::<Vec<_>>().join(" ");
    let indices = &words[words.find("indices").unwrap()..];
    for name in ["HIC15 of head ", "HIC36 of head ", " (from "] {
        assert!(indices.contains(name), "{name}: {verdict}");
    }
    let only = "[measures]\nhead = [{ kind = \"hic\", cap = \"5 ms\" }]\n";
    let path = file(&folder, "other.toml", &(SOFT.to_owned() + only));
    let verdict = out(&run(&["run", text(&path)]));
    assert!(verdict.contains("HIC up to 5 ms of head "), "{verdict}");
    let path = file(&folder, "third.toml", &(SOFT.to_owned() + "[measures]\nhead = [\"hic\"]\n"));
    let verdict = out(&run(&["run", text(&path)]));
    assert!(verdict.contains("HIC without a cap of head "), "{verdict}");
}

#[test]
fn the_verdict_leaves_out_of_its_bound_what_is_not_as_good() {
    let path = "tests/corpus/networks/stop-that-pulls.toml";
    let output = run(&["run", path, "--method", "esdirk34"]);
    let words = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    let wrong = &words[words.find("num. error").unwrap()..];
    assert!(wrong.contains("` is zero within"), "{wrong}");
    assert!(wrong.contains("every other figure within"), "{wrong}");
}

#[test]
fn pad_that_never_meets_an_impactor_is_warned_of_when_it_pulls() {
    let folder = TempDir::new().unwrap();
    let scene = "[nodes]\ngoods = { mass = \"12 kg\" }\nbed = { motion = { sine = { amplitude = \"3 mm\", \
        frequency = \"8 Hz\" } } }\n[elements]\ncushion = { between = [\"goods\", \"bed\"], kelvin-voigt = \
        { spring = \"30 kN/m\", dashpot = \"150 N s/m\" }, thickness = \"50 mm\" }\n[effects]\n\
        gravity = true\n[run]\nduration = \"2 s\"\n";
    let scene = file(&folder, "truck.toml", scene);
    let output = run(&["run", text(&scene)]);
    let verdict = out(&output);
    assert!(
        verdict.starts_with("! from 105 ms the cushion is in tension: separation is off\n"),
        "{verdict}"
    );
    assert!(verdict.contains("goods.peak-acceleration") && !verdict.contains("contact-time"));
    assert!(
        verdict
            .lines()
            .any(|line| line.starts_with("  peak g ") && line.ends_with("on goods at 1.93 s"))
    );
    let shown = out(&run(&["explain", text(&scene)]));
    assert!(shown.contains("sine of 3 mm at 8 Hz"), "{shown}");
}

#[test]
fn run_that_stops_says_so() {
    let folder = TempDir::new().unwrap();
    let scene = SOFT.to_owned() + "stop = [{ when = \"pad.force\", falls-below = \"0 N\" }]\n";
    let scene = file(&folder, "stop.toml", &scene);
    let answer = json(&["run", text(&scene), "--json"]);
    let events = answer["runs"][0]["events"].as_array().unwrap();
    assert!(events.iter().any(|event| event["what"] == "pad.force fell below 0 N"), "{events:?}");
    let verdict = out(&run(&["run", text(&scene)]));
    assert!(verdict.contains("  stopped          at "), "{verdict}");
    assert!(!verdict.contains("tension"), "{verdict}");
}

#[test]
fn pad_that_is_never_pressed_says_why_there_is_nothing_to_report() {
    let folder = TempDir::new().unwrap();
    let scene = SOFT.replace("[\"head\", \"ground\"]", "[\"ground\", \"head\"]");
    let verdict = out(&run(&["run", text(&file(&folder, "away.toml", &scene))]));
    assert!(verdict.contains("the pad is never pressed: it pulls from the start"), "{verdict}");
}

#[test]
fn many_methods_stand_below_each_other_with_their_errors() {
    let methods = "exact,bdf,tr-bdf2,esdirk34,tsit45";
    let shown = out(&run(&["run", "--method", methods]));
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    let of_peak = shown.lines().filter(|line| line.starts_with("  padding.peak-force "));
    assert_eq!(of_peak.map(|line| line.matches('±').count()).sum::<usize>(), 5);
    let measures =
        "[measures]\npad = [{ kind = \"peak-force\", window = \"run\" }, \"peak-force\"]\n";
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "two.toml", &(SOFT.to_owned() + measures));
    let shown = out(&run(&["run", text(&scene)]));
    assert!(shown.contains("pad.peak-force (impact)"), "{shown}");
    assert!(shown.contains("pad.peak-force-2 (run)"), "{shown}");
}

#[test]
fn what_vanishes_is_a_plain_zero() {
    let folder = TempDir::new().unwrap();
    let law = "kelvin-voigt = { spring = \"K\", dashpot = \"80 N s/m\" }";
    let scene = SOFT.replace(law, "spring = \"K\"");
    let shown = out(&run(&["run", text(&file(&folder, "spring.toml", &scene))]));
    assert!(shown.contains("pad takes up 0 J of 90 J\n"), "{shown}");
    let row = shown.lines().find(|line| line.starts_with("  pad.energy ")).unwrap();
    let words: Vec<&str> = row.split_whitespace().collect();
    assert!(words[1] == "0" && words[2].starts_with('±') && words[3] == "J", "{row}");
}

#[test]
fn larger_force_elsewhere_is_told() {
    let verdict = out(&run(&["run"]));
    assert!(verdict.contains("  elsewhere        47.9 kN in mount at 3.51 ms\n"), "{verdict}");
}

#[test]
fn work_put_in_is_told_beside_the_energy_of_the_impact() {
    let verdict = out(&run(&["run", "reference-gravity"]));
    let line = verdict.lines().find(|line| line.starts_with("  energy ")).unwrap();
    assert!(line.contains("of 500 J and ") && line.contains(" put in ("), "{line}");
}

#[test]
fn pad_that_bottoms_out_says_so_first() {
    let folder = TempDir::new().unwrap();
    let output = run(&["run", text(&file(&folder, "soft.toml", SOFT))]);
    assert_eq!(code(&output), 0);
    let verdict = out(&output);
    assert!(verdict.lines().take(3).any(|line| line.contains("23.2 mm more than its")));
    assert!(verdict.contains(": 177 % of 30 mm, 23.2 mm MORE than"), "{verdict}");
}

#[test]
fn what_is_large_is_not_zero_because_its_error_is_larger() {
    // The error that 16 segments of a rod leave in the peak force is as large as the force.
    let folder = TempDir::new().unwrap();
    let scene = file(
        &folder,
        "rod.toml",
        "[materials]\nsteel = { spring = \"200 GPa\" }\n[nodes]\nhammer = { mass = \"7.8 kg\", velocity = \"1 m/s\" }\n\
         [elements.rod]\nbetween = [\"hammer\", \"ground\"]\nsegments = 16\nlayers = [{ material = \"steel\", thickness \
         = \"1 m\", area = \"10 cm^2\", density = \"7800 kg/m^3\" }]\n[effects]\nseparation.rod = {}\n[run]\nduration \
         = \"1 ms\"\n",
    );
    let page = out(&run(&["run", text(&scene)]));
    assert!(page.contains("kN in rod at") && !page.contains(" 0 kN"), "{page}");
    assert!(page.contains("of it in rod"), "the kinetic energy in the rod: {page}");
}
