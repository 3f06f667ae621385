//! `auto`: what it costs beside the best single method, what it never does, and where it ends.
//!
//! Work is counted in units of the budget, which are the same everywhere.

use std::fs;

use dashpot::{
    analysis::{MeasureReport, RunError, RunReport, Solve, SolveSettings},
    dae::SolveError,
    scene::{ReadOptions, Scene, read},
};

use crate::{cli, scenes::scene_paths};

const METHODS: [&str; 4] = ["exact", "bdf", "esdirk34", "tr-bdf2"];

fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}")).value
}

fn run(scene: &Scene, settings: &SolveSettings) -> Result<RunReport, RunError> {
    scene.network.solve_with(settings)
}

fn by(scene: &Scene, method: &str) -> Result<RunReport, RunError> {
    run(scene, &scene.settings(method).unwrap())
}

fn measure<'r>(report: &'r RunReport, key: &str) -> &'r MeasureReport {
    report.measure(key).unwrap_or_else(|| panic!("no {key}"))
}

/// Whether a run is as good as is wanted.
fn reaches(report: &RunReport) -> bool {
    report.measures.iter().all(|measure| measure.excess <= 1.0 && !measure.is_undetermined)
}

/// A mass against a spring without damping.
fn spring(stiffness: f64) -> Scene {
    scene(&format!(
        "[nodes]\nm = {{ mass = 5, velocity = 3 }}\n[elements]\n\
         d = {{ between = [\"m\", \"ground\"], spring = {stiffness:e} }}\n\
         [run]\nduration = 0.06\n"
    ))
}

/// Two masses joined by a dashpot, with a spring beside it or without.
fn joined(damping: f64, spring: bool) -> Scene {
    let model = if spring {
        format!("kelvin-voigt = {{ spring = 100, dashpot = {damping:e} }}")
    } else {
        format!("dashpot = {damping:e}")
    };
    scene(&format!(
        "[nodes]\na = {{ mass = 1, velocity = 1 }}\nb = {{ mass = 3 }}\n[elements]\n\
         d = {{ between = [\"a\", \"b\"], {model} }}\n\
         [measures]\na = [\"end-velocity\"]\nb = [\"end-velocity\"]\n[run]\nduration = 1\n"
    ))
}

#[test]
fn costs_little_more_than_the_best_single_method() {
    let mut ratios = Vec::new();
    for path in scene_paths() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let file = path.to_string_lossy();
        let options = ReadOptions { file: Some(&file), ..ReadOptions::default() };
        let scene = read(&fs::read_to_string(&path).unwrap(), &options).unwrap().value;
        let auto = by(&scene, "auto").unwrap();
        let single = METHODS.map(|method| {
            by(&scene, method).ok().filter(reaches).map_or(u64::MAX, |own| own.solver.work)
        });
        let best = single.into_iter().min().unwrap();
        if best < u64::MAX {
            assert!(reaches(&auto), "{name}");
            println!(
                "{name}: auto ({}) {}, single {single:?}",
                auto.solver.method, auto.solver.work
            );
            ratios.push((auto.solver.work as f64 / best as f64, name));
        }
    }
    ratios.sort_by(|one, other| one.0.total_cmp(&other.0));
    assert!(ratios.len() >= 15, "{ratios:?}");
    assert!(ratios[ratios.len() / 2].0 <= 1.5, "{ratios:?}");
    assert!(ratios[ratios.len() - 1].0 <= 4.0, "{ratios:?}");
}

#[test]
fn what_is_nothing_beside_its_kind_asks_for_no_further_solution() {
    // The wave has not reached the far end, where forces are next to nothing and known to some per cent.
    let scene = scene(include_str!("auto/free-chain-90.toml"));
    let [auto, exact] = ["auto", "exact"].map(|method| by(&scene, method).unwrap());
    assert_eq!(auto.solver.method, "exact");
    assert_eq!(auto.solver.work, exact.solver.work);
    assert!(reaches(&auto));
    let far = measure(&auto, "e64.peak-force");
    let (value, error) = (far.value.unwrap(), far.error.unwrap());
    assert!(value < 1e-9 && error > 1e-3 * value, "the bar stays as it is: {far:?}");
    // Asked for by name, it counts by itself.
    let mut settings = scene.settings("exact").unwrap();
    settings.accuracy.by_measure.insert("e64.peak-force".to_owned(), 1e-3);
    let asked = run(&scene, &settings).unwrap();
    assert!(measure(&asked, "e64.peak-force").excess > 1.0);
}

#[test]
fn never_prefers_wider_bars() {
    // The elastic bounce; the force just after touch is nearly zero.
    let scene = scene(
        "[nodes]\nm = { mass = 1, velocity = 1 }\n[elements]\n\
         c = { between = [\"m\", \"ground\"], series = [{ contact = { gap = 2 } }, { spring = 100 }] }\n\
         [effects]\ngravity = { value = 10, start = \"unloaded\" }\n[measures]\n\
         c = [{ kind = \"peak-force\", window = [0, 0.5403124237533] }]\n[run]\nduration = 1.1\n",
    );
    let auto = by(&scene, "auto").unwrap();
    let peak = measure(&auto, "c.peak-force-2");
    // Touch at t = (√41 − 1)/10 with the speed √41, and the force √41 k τ there.
    let touch = (41.0_f64.sqrt() - 1.0) / 10.0;
    let force = 41.0_f64.sqrt() * 100.0 * (0.540_312_423_753_3 - touch);
    assert_eq!(auto.solver.method, "exact");
    assert!(peak.error.unwrap() < 1e-10, "{peak:?}");
    assert!((peak.value.unwrap() - force).abs() <= peak.error.unwrap() + 1e-11, "{force} {peak:?}");
}

#[test]
fn strong_dashpots_take_no_time() {
    for damping in [1e12, 1e16, 1e100, 1e300] {
        for spring in [false, true] {
            let auto = by(&joined(damping, spring), "auto").unwrap();
            assert!(auto.solver.work < 100_000_000, "{damping:e}: {}", auto.solver.work);
            let is = |key: &str, truth: f64| {
                let own = measure(&auto, key);
                let (value, error) = (own.value.unwrap(), own.error.unwrap());
                assert!((value - truth).abs() <= error, "{damping:e} {key}: {value:e}, {truth:e}");
                assert!(error <= 1e-6 * truth, "{damping:e} {key}: {error:e}");
            };
            is("d.peak-force", damping);
            // Of momentum and both masses: m1 m2/(m1 + m2) v.
            is("d.peak-deformation", 0.75 / damping);
            // Both go on together, with the speed of momentum.
            for key in ["a.end-velocity", "b.end-velocity"] {
                let own = measure(&auto, key);
                let (value, error) = (own.value.unwrap(), own.error.unwrap_or(1e-6));
                assert!((value - 0.25).abs() <= error.max(1e-12), "{damping:e}: {own:?}");
            }
            let lost = measure(&auto, "d.energy");
            assert!((lost.value.unwrap() - 0.375).abs() <= lost.error.unwrap_or(1e-6), "{lost:?}");
            // Known to be left: from 1e16 N s/m on the bar of the impulse says nothing.
            let known = |measure_report: &&MeasureReport| {
                damping < 1e16 || measure_report.key != "d.impulse"
            };
            for measure in auto.measures.iter().filter(known) {
                let is_told = measure.value.zip(measure.error).is_some_and(|(value, error)| {
                    error.is_finite() && error > value.abs() && error > 100.0
                });
                assert!(!is_told, "says nothing: {measure:?}");
            }
        }
    }
}

#[test]
fn what_physics_determines_is_told_however_stiff() {
    for stiffness in [1e15, 1e20, 1e100, 1e300] {
        let auto = by(&spring(stiffness), "auto").unwrap();
        // That of 1e15 N/m is followed to its end.
        let most = if stiffness > 1e15 { 20_000_000 } else { 400_000_000 };
        assert!(auto.solver.work < most, "{stiffness:e}: {}", auto.solver.work);
        let is = |key: &str, truth: f64| {
            let own = measure(&auto, key);
            let (value, error) = (own.value.unwrap(), own.error.unwrap());
            assert!((value - truth).abs() <= error, "{stiffness:e} {key}: {value:e}, {truth:e}");
            assert!(error <= 1e-6 * truth, "{stiffness:e} {key}: {error:e}");
        };
        is("d.peak-force", 3.0 * (5.0 * stiffness).sqrt());
        is("d.peak-deformation", 3.0 * (5.0 / stiffness).sqrt());
        is("d.contact-time", std::f64::consts::PI * (5.0 / stiffness).sqrt());
        is("d.impulse", 30.0);
    }
    // ω T ε = 3e7: what hangs on the phase at the end is not determined.
    let auto = by(&spring(1e50), "auto").unwrap();
    let end = measure(&auto, "d.energy-at-end");
    assert!(end.value.is_none() && end.is_undetermined, "{end:?}");
    assert!(end.note().unwrap().contains("not determined"), "{end:?}");
    assert!(auto.warnings[0].to_string().contains("followed to"), "{:?}", auto.warnings);
}

#[test]
fn energies_beyond_the_range_of_numbers_end_the_run() {
    let text = |extra: &str, velocity: &str| {
        format!(
            "[nodes]\nhead = {{ mass = 1, velocity = {velocity} }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], spring = 100 }}\n{extra}\n\
             [run]\nduration = 20\n"
        )
    };
    let force = "[loads]\nram = { on = \"head\", force = { sine = \
                 { amplitude = 1.7e293, frequency = 1.5915494309189535 } } }";
    for text in [text("", "1e300"), text(force, "0")] {
        assert_eq!(by(&scene(&text), "auto").unwrap_err(), RunError::BeyondRange);
    }
}

#[test]
fn budget_ends_a_run_with_the_best_answer_so_far() {
    let scene = scene(include_str!("../../crates/scene/templates/reference.toml"));
    let within = |budget: u64| {
        let mut settings = SolveSettings { budget, ..scene.settings("bdf").unwrap() };
        settings.accuracy.default = 1e-9;
        run(&scene, &settings)
    };
    let whole = within(SolveSettings::BUDGET).unwrap();
    let part = within(whole.solver.work / 2).unwrap();
    assert!(part.solver.rtol.unwrap() > whole.solver.rtol.unwrap());
    let told = part
        .warnings
        .iter()
        .find(|warning| warning.to_string().contains("the accuracy wanted is not reached"));
    assert!(told.unwrap().to_string().contains("the budget of work is spent"), "{told:?}");
    let again = within(whole.solver.work / 2).unwrap();
    assert_eq!((again.measures, again.solver.work), (part.measures, part.solver.work));
    // Not even one solution to the end of the run.
    let error = within(100).unwrap_err();
    let RunError::Solve(SolveError::BudgetSpent { method: "bdf", time, work }) = error else {
        panic!("{error}")
    };
    assert!(time < scene.run.duration && (100..1000).contains(&work), "{time} {work}");
}

/// A slide on a drive sticks and slips four times a second: no phase is a second long.
#[test]
fn the_time_that_a_budget_reaches_is_counted_from_the_start_of_the_run() {
    let text = "[nodes]\ndrive = { motion = { sine = { amplitude = \"0.5 mm\", frequency = \"2 Hz\" } } }\n\
                slide = { mass = 180 }\n[elements]\n\
                screw = { between = [\"drive\", \"slide\"], spring = \"4 MN/m\" }\n\
                guides = { between = [\"slide\", \"ground\"], friction = \"600 N\" }\n[run]\nduration = 5\n";
    let scene = scene(text);
    for method in ["bdf", "dop853", "exact"] {
        let mut reached = Vec::new();
        for budget in (10..34).map(|power| 1 << power) {
            let settings = SolveSettings { budget, ..scene.settings(method).unwrap() };
            match run(&scene, &settings) {
                Err(RunError::Solve(SolveError::BudgetSpent { time, .. })) => reached.push(time),
                other => {
                    other.unwrap();
                    break;
                }
            }
        }
        let last = reached.last().copied().unwrap_or(0.0);
        assert!(last > 1.0 && last <= 5.0, "{method}: {reached:?}");
        // To read all measures is more work than the steps were, and has a limit, too.
        assert!(method != "bdf" || last > 5.0 - 1e-9, "{reached:?}");
    }
}

#[test]
fn methods_of_one_run_share_what_it_may_take() {
    let text = "[nodes]\ndrive = { motion = { sine = { amplitude = \"0.5 mm\", frequency = \"2 Hz\" } } }\n\
                slide = { mass = \"180 kg\" }\n[elements]\n\
                screw = { between = [\"drive\", \"slide\"], spring = \"4 MN/m\" }\n\
                guides = { between = [\"slide\", \"ground\"], friction = \"600 N\" }\n[run]\nduration = \"500 s\"\n";
    let folder = tempfile::tempdir().unwrap();
    let path = cli::file(&folder, "scene.toml", text);
    let path = path.to_str().unwrap();
    let said = cli::run(&["run", path, "--budget", "2e6", "--method", "bdf,exact,esdirk34"]);
    let said = cli::err(&said);
    let words: Vec<&str> = said.split_whitespace().collect();
    let after = words.windows(3).filter(|own| own[0] == "after" && own[2] == "units");
    let work: Vec<f64> = after.map(|own| own[1].parse().unwrap()).collect();
    assert_eq!(work.len(), 3, "{said}");
    for (work, granted) in work.iter().zip([2e6, 1e6, 5e5]) {
        assert!((1.0..1.3).contains(&(work / granted)), "{work} of {granted}: {said}");
    }
}

#[test]
fn never_prefers_what_nothing_is_known_of() {
    // 1 kg on a spring of 1 N/m carries a speck whose 10⁹ rad `exact` does not follow, and which is not excited: of all
    // methods with steps one comes to the end within little work, with a loss of energy and without a bar.
    let text = "[nodes]\nbig = { mass = 1, velocity = 1 }\nspeck = { mass = 1e-12, velocity = 1 }\n[elements]\n\
                g = { between = [\"big\", \"ground\"], spring = 1 }\nk = { between = [\"speck\", \"big\"], spring = 1 }\n\
                [measures]\nbig = [{ kind = \"end-position\", window = \"run\" }]\n[accuracy]\ndefault = 0.05\n[run]\n\
                duration = 1000\n";
    let report = by(&scene(text), "auto").unwrap();
    let own = measure(&report, "big.end-position");
    let (value, error) = (own.value.unwrap(), own.error.expect("a bar"));
    assert!(error < 0.05 && (value - 1000.0_f64.sin()).abs() <= error, "{value} ± {error}");
    assert!(report.warnings.iter().all(|own| own.code() == "pulls"), "{:?}", report.warnings);
}
