mod faults;
mod preloads;
mod random;
mod rest;
mod signals;
mod single;

use dashpot_dae::{Direction, Piece, Waveform};
use dashpot_network::effects::{Gravity, GravityStart};
use dashpot_network::{
    Model, Network, Node, NodeId, dashpot, elements::PowerDashpot, parameters::WindowWish, part,
    spring,
};

use super::*;
use crate::{
    Contact, MeasureWish, Solve, differences,
    measures::{EndVelocity, Energy, Hic15, PeakForce},
};

/// The thesis' reference case with the given support damping \[N s/m\].
fn reference(damping: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let kelvin = Model::parallel([spring(20e6), dashpot(4e3)]);
    let padding = Model::series([spring(20e6), dashpot(6e3), kelvin]);
    network.connect("padding", head, panel, padding).thickness = Some(0.02);
    let mount = Model::parallel([spring(50e6), dashpot(damping)]);
    let ground = network.ground();
    network.connect("mount", panel, ground, mount);
    network
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).and_then(|measure| measure.value).expect(key)
}

/// Values that are known to this many digits after the point.
fn same(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn exact_gives_the_thesis_table() {
    let table = [
        (
            10e3,
            [
                38_359.411_601,
                0.978_689_266,
                17.538_566_287,
                6.852_164_736,
                7.425_568_132,
                -0.481_681_328,
                479.124_454,
                5_019.610_795,
            ],
        ),
        (
            10e6,
            [
                39_091.473_661,
                1.013_937_856,
                16.961_880_656,
                4.663_139_515,
                5.822_143_300,
                -0.113_413_391,
                499.715_175,
                5_362.343_040,
            ],
        ),
    ];
    for (damping, [force, at, deepest, deepest_at, release, speed, work, severity]) in table {
        let mut settings = SolveSettings::lasting(0.01).by_name("exact").unwrap();
        settings.measures.push(MeasureWish::new("head", EndVelocity::default()));
        let report = reference(damping).solve_with(&settings).unwrap();
        same(value(&report, "padding.peak-force"), force, 1e-6);
        same(1e3 * report.measure("padding.peak-force").unwrap().time.unwrap(), at, 1e-9);
        same(1e3 * value(&report, "padding.peak-deformation"), deepest, 1e-9);
        same(
            1e3 * report.measure("padding.peak-deformation").unwrap().time.unwrap(),
            deepest_at,
            1e-9,
        );
        same(1e3 * value(&report, "padding.contact-time"), release, 1e-9);
        same(value(&report, "head.end-velocity"), speed, 1e-9);
        same(value(&report, "padding.energy-at-end"), work, 1e-6);
        same(value(&report, "head.severity-index"), severity, 1e-6);
        same(value(&report, "head.peak-acceleration"), force / 10.0, 1e-7);
        assert!(report.energy.closure().abs() < 1e-11, "{}", report.energy.closure());
        assert_eq!(report.solver.solves_for_error, 0);
        assert!(
            report.warnings[0]
                .to_string()
                .ends_with("the padding is in tension: separation is off")
        );
        assert_eq!(report.events[0].what.to_string(), "padding force turns to tension");
        for measure in &report.measures {
            let error = measure.relative_error().expect(&measure.key);
            assert!(error < 1e-8, "{}: {error}", measure.key);
        }
    }
}

#[test]
fn bdf_is_inside_its_bars() {
    for damping in [10e3, 10e6] {
        let network = reference(damping);
        let mut settings = SolveSettings::lasting(0.02);
        settings.measures.push(MeasureWish::new("head", Hic15::default()));
        settings.measures.push(MeasureWish::new("head", EndVelocity::default()));
        let exact = network.solve_with(&settings.clone().by_name("exact").unwrap()).unwrap();
        for rtol in [None, Some(1e-5), Some(1e-7), Some(1e-9)] {
            let settings = SolveSettings { rtol, ..settings.clone().by_name("bdf").unwrap() };
            let bdf = network.solve_with(&settings).unwrap();
            for measure in &bdf.measures {
                let error = (measure.value.unwrap() - value(&exact, &measure.key)).abs();
                let bar = measure.error.unwrap();
                assert!(error <= bar, "{rtol:?} {}: {error} > {bar}", measure.key);
                if rtol.is_none() {
                    assert!(measure.excess <= 1.0, "{}: {}", measure.key, measure.excess);
                }
            }
            assert!(bdf.solver.solves_for_error >= 2);
            if rtol.is_none() {
                let worst = differences(&exact, &bdf).into_iter().map(|d| d.relative);
                assert!(worst.fold(0.0, f64::max) < 1e-3);
            }
        }
    }
}

fn oscillator(stiffness: f64, damping: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 2.0).moving(3.0));
    let pad = Model::parallel([spring(stiffness), dashpot(damping)]);
    let ground = network.ground();
    network.connect("pad", head, ground, pad);
    network
}

#[test]
fn ledger_of_a_damped_oscillator_closes() {
    for (stiffness, damping) in [(800.0, 8.0), (800.0, 80.0), (800.0, 200.0)] {
        for method in ["exact", "bdf", "tr-bdf2"] {
            let settings = SolveSettings::lasting(0.5).by_name(method).unwrap();
            let report = oscillator(stiffness, damping).solve_with(&settings).unwrap();
            let energy = &report.energy;
            same(energy.start, 9.0, 1e-12);
            let accuracy = if method == "exact" { 1e-12 } else { 1e-3 };
            assert!(energy.closure().abs() < accuracy, "{method}: {}", energy.closure());
            assert_eq!((energy.stored.len(), energy.dissipated.len()), (1, 1));
            assert!(energy.work_in.is_empty());
        }
    }
}

#[test]
fn undamped_rebound_gives_all_back() {
    let report = oscillator(800.0, 0.0).solve(0.3).unwrap();
    let half_period = std::f64::consts::PI / 20.0;
    same(value(&report, "pad.contact-time"), half_period, 1e-12);
    same(value(&report, "pad.impulse"), 12.0, 1e-10);
    same(value(&report, "pad.energy"), 0.0, 1e-10);
    same(value(&report, "pad.peak-deformation"), 3.0 / 20.0, 1e-12);
    let after = report.energy_after_impact.as_ref().unwrap();
    same(after.kinetic, 9.0, 1e-10);
}

#[test]
fn run_that_ends_early_is_still_in_contact() {
    let report = oscillator(800.0, 8.0).solve(0.05).unwrap();
    let contact = report.measure("pad.contact-time").unwrap();
    assert_eq!(contact.value, None);
    assert!(contact.note().unwrap().contains("still in contact"));
    assert!(report.warnings.iter().any(|warning| warning.to_string().contains("still in contact")));
    let nothing = oscillator(800.0, 8.0).solve(0.0);
    same(value(&nothing.unwrap(), "pad.peak-force"), 24.0, 1e-12);
}

#[test]
fn impactor_that_leaves_pulls_from_the_start() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 2.0).moving(-3.0));
    let ground: NodeId = network.ground();
    network.connect("pad", head, ground, spring(800.0));
    let report = network.solve(0.1).unwrap();
    same(value(&report, "pad.contact-time"), 0.0, 0.0);
    assert_eq!(report.measure("pad.peak-force").unwrap().value, None);
    assert_eq!(
        report.warnings[0].to_string(),
        "from the start the pad is in tension: separation is off"
    );
}

#[test]
fn jump_of_a_motion_does_the_work_that_the_spring_takes_up() {
    let mut network = Network::new();
    let step = Waveform::new(vec![
        Piece::default(),
        Piece { start: 0.1, value: 0.02, ..Piece::default() },
    ]);
    let base = network.add_node(Node::prescribed("base", step.unwrap()));
    let body = network.add_node(Node::mass("body", 2.0));
    let mount = Model::parallel([spring(800.0), Model::series([spring(500.0), dashpot(8.0)])]);
    network.connect("mount", base, body, mount);
    for method in ["exact", "bdf"] {
        let settings = SolveSettings::lasting(0.6).by_name(method).unwrap();
        let report = network.solve_with(&settings).unwrap();
        let closure = report.energy.closure().abs();
        assert!(closure < if method == "exact" { 1e-11 } else { 1e-3 }, "{method}: {closure}");
        let jump = &report.energy.work_in.last().unwrap().1;
        same(*jump, 0.5 * 1300.0 * 0.02 * 0.02, 1e-9);
        // Without an impactor the window is the run.
        same(report.measure("mount.peak-force").unwrap().window.unwrap().1, 0.6, 1e-15);
        // What needs an impact is left out, and the body's acceleration is reported.
        assert!(report.measure("mount.contact-time").is_none());
        assert!(report.measure("body.severity-index").is_none());
        assert!(value(&report, "body.peak-acceleration") > 0.0);
        // A mount may pull.
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }
}

#[test]
fn pad_without_impactor_is_seen_to_pull() {
    let mut network = Network::new();
    let shake = Piece { sine: 0.003, omega: 50.0, ..Piece::default() };
    let bed = network.add_node(Node::prescribed("bed", Waveform::new(vec![shake]).unwrap()));
    let goods = network.add_node(Node::mass("goods", 12.0));
    let cushion = Model::parallel([spring(30e3), dashpot(150.0)]);
    network.connect("cushion", goods, bed, cushion).thickness = Some(0.05);
    let report = network.solve(1.0).unwrap();
    // The bed sets out towards positive positions, away from the goods.
    assert_eq!(
        report.warnings[0].to_string(),
        "from the start the cushion is in tension: separation is off"
    );
    assert!(report.stopped_by().is_none());
}

#[test]
fn largest_force_is_looked_for_in_every_element() {
    let report = reference(10e3).solve(0.02).unwrap();
    let (element, peak) = report.largest_force().unwrap();
    assert_eq!(element, "mount");
    assert!(peak.value > value(&report, "padding.peak-force"));
}

#[test]
fn accuracy_that_is_wanted_is_paid_for() {
    let wish = |accuracy: f64| SolveSettings {
        accuracy: crate::Accuracy::of_all(accuracy),
        ..SolveSettings::lasting(0.02).by_name("bdf").unwrap()
    };
    let rough = reference(10e3).solve_with(&wish(1e-2)).unwrap();
    let fine = reference(10e3).solve_with(&wish(1e-6)).unwrap();
    assert!(fine.solver.solves_for_error > rough.solver.solves_for_error);
    assert!(fine.measures.iter().all(|measure| measure.excess <= 1.0));
    assert!(fine.warnings.iter().all(|warning| !warning.to_string().contains("accuracy")));
    let beyond = reference(10e3).solve_with(&wish(1e-13)).unwrap();
    assert!(
        beyond
            .warnings
            .iter()
            .any(|warning| warning.to_string().contains("accuracy wanted is not"))
    );
    let settings = SolveSettings { estimate: false, ..wish(1e-3) };
    let single = reference(10e3).solve_with(&settings).unwrap();
    assert!(single.measures.iter().all(|measure| measure.error.is_none()));
    assert_eq!(single.solver.solves_for_error, 0);
}

#[test]
fn energy_that_is_lost_fails_the_run() {
    // Undamped, 160 periods: at this tolerance the method itself damps.
    let settings = SolveSettings {
        rtol: Some(1e-3),
        estimate: false,
        ..SolveSettings::lasting(50.0).by_name("bdf").unwrap()
    };
    let failure = oscillator(800.0, 0.0).solve_with(&settings).unwrap_err();
    assert!(matches!(failure, RunError::EnergyLost { method: "bdf", .. }), "{failure}");
}

#[test]
fn dashpots_in_a_row_are_one_dashpot() {
    let constants = [280.0, 42.0, 3.8, 6300.0, 1900.0, 4900.0, 24.0];
    let scene = |pad: Model| {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 2.5).moving(23.0));
        let ground = network.ground();
        network.connect("pad", head, ground, pad);
        network
    };
    let apart = constants.map(dashpot).into_iter().chain([spring(1e3)]);
    let apart = scene(Model::series(apart));
    let one = dashpot(1.0 / constants.iter().map(|c| 1.0 / c).sum::<f64>());
    let one = scene(Model::series([one, spring(1e3)]));
    let settings = SolveSettings::lasting(0.135);
    let apart = apart.solve_with(&settings).unwrap();
    let one = one.solve_with(&settings).unwrap();
    for measure in &one.measures {
        let Some(expected) = measure.value else { continue };
        let other = apart.measure(&measure.key).unwrap();
        let bar = measure.error.unwrap() + other.error.unwrap();
        assert!((expected - other.value.unwrap()).abs() <= bar, "{measure:?} {other:?}");
        assert!(other.excess <= 1.0);
    }
}

#[test]
fn run_stops_where_it_is_told_to() {
    let mut settings = SolveSettings::lasting(0.02);
    settings.stops.push(Stop {
        output: "padding.force".to_owned(),
        level: 0.0,
        direction: Direction::Falling,
    });
    for method in ["exact", "bdf"] {
        let report =
            reference(10e3).solve_with(&settings.clone().by_name(method).unwrap()).unwrap();
        let end = report.trajectory.t_end;
        same(1e3 * end, 7.425_568_132, if method == "exact" { 1e-9 } else { 1e-2 });
        let stopped = report.stopped_by().unwrap();
        assert_eq!(stopped.what.to_string(), "padding.force fell below 0 N");
        assert!(report.stopped_by().is_some_and(|event| (event.time - end).abs() < 1e-12));
        same(value(&report, "padding.contact-time"), end, 1e-9);
        assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    }
}

#[test]
fn weight_does_work() {
    let mut network = reference(10e3);
    network.add_effect(Gravity { acceleration: 9.806_65, start: GravityStart::Equilibrium });
    for method in ["exact", "bdf"] {
        let settings = SolveSettings::lasting(0.02).by_name(method).unwrap();
        let report = network.solve_with(&settings).unwrap();
        assert_eq!(report.energy.work_in.len(), 2);
        assert!(report.energy.total_work_in() > 0.0);
        let closure = report.energy.closure().abs();
        assert!(closure < if method == "exact" { 1e-11 } else { 1e-4 }, "{closure}");
        assert_eq!(report.system.effects, ["gravity"]);
    }
}

#[test]
fn series_ends_with_the_ledger() {
    let report = reference(10e3).solve(0.02).unwrap();
    let solution = report.solution();
    let times = crate::regular_times(solution.end(), 41);
    let series = crate::energy::ledger::energy_series(&solution, &times);
    let (kinetic, stored, dissipated) =
        (series.kinetic[40], series.stored[40], series.dissipated[40]);
    same(kinetic, report.energy.kinetic, 1e-9);
    same(stored, report.energy.total_stored(), 1e-9);
    same(dissipated, report.energy.total_dissipated(), 1e-9);
    for at in 0..=40 {
        same(series.kinetic[at] + series.stored[at] + series.dissipated[at], 500.0, 1e-8);
    }
}

#[test]
fn table_holds_all_outputs() {
    let report = reference(10e3).solve(0.02).unwrap();
    let table = crate::table(&report.assembly, &report.trajectory, 501);
    let force = table.columns.iter().find(|column| column.name == "padding.force").unwrap();
    assert_eq!((force.values.len(), table.times.len(), force.unit), (501, 501, "N"));
    let signal = report.assembly.connection("padding").and_then(|padding| padding.force).unwrap();
    let solution = report.solution();
    for (time, value) in table.times.iter().zip(&force.values) {
        same(*value, solution.signal(signal).value(*time), 1e-6);
    }
}

#[test]
fn wishes_that_name_nothing_are_refused() {
    let solve = |settings: &SolveSettings| reference(1e4).solve_with(settings);
    let mut settings = SolveSettings::lasting(0.01);
    settings.measures.push(MeasureWish::new("hat", EndVelocity::default()));
    assert!(matches!(solve(&settings), Err(RunError::UnknownTarget { .. })));
    let mut settings = SolveSettings::lasting(0.01);
    settings.accuracy.by_measure.insert("padding.peak-forse".to_owned(), 0.1);
    assert!(matches!(solve(&settings), Err(RunError::UnknownMeasure { .. })));
    let settings = SolveSettings::lasting(0.01).by_name("magic");
    assert!(matches!(settings, Err(RunError::UnknownMethod { .. })));
    let settings = SolveSettings::lasting(f64::NAN);
    assert!(matches!(solve(&settings), Err(RunError::InvalidSetting { .. })));
}

#[test]
fn second_measure_of_a_kind_gets_a_number() {
    let mut settings = SolveSettings::lasting(0.01);
    for end in [2e-3, 4e-3] {
        let window = WindowWish::Times(0.0, end);
        settings.measures.push(MeasureWish::new("padding", Energy { window }));
        settings.measures.push(MeasureWish::new("mount", Energy { window }));
    }
    let report = reference(10e3).solve_with(&settings).unwrap();
    // 2 ζ: ω(2) and ω(4) of the thesis' groups are near 0.2 and 0.4.
    assert!(value(&report, "padding.energy-2") < value(&report, "padding.energy-3"));
    let plain = reference(10e3).solve(0.01).unwrap();
    let energy = value(&report, "padding.energy").to_bits();
    assert_eq!(energy, value(&plain, "padding.energy").to_bits(), "the default is still there");
    assert!(report.measure("mount.energy").is_some() && report.measure("mount.energy-2").is_some());
}

#[test]
fn measure_over_another_window_leaves_the_default_alone() {
    let network = oscillator(800.0, 8.0);
    let wished = |window| {
        let mut settings = SolveSettings::lasting(0.5);
        settings.measures.push(MeasureWish::new("pad", PeakForce { window }));
        network.solve_with(&settings).unwrap()
    };
    let early = wished(WindowWish::Times(0.0, 1e-3));
    assert!(value(&early, "pad.peak-force") > 2.0 * value(&early, "pad.peak-force-2"));
    assert!(wished(WindowWish::Impact).measure("pad.peak-force-2").is_none());
}

#[test]
fn force_that_decays_to_zero_is_never_released() {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 2.0).moving(3.0));
    let ground = network.ground();
    network.connect("pad", head, ground, dashpot(2e3));
    let mut loaded = network.clone();
    let push = Piece { start: 0.06, value: 400.0, ..Piece::default() };
    let pull = Piece { start: 0.2, value: -100.0, ..Piece::default() };
    let load = Waveform::new(vec![Piece::default(), push, pull]).unwrap();
    loaded.add_load("ram", head, load);
    for method in ["bdf", "tr-bdf2", "esdirk34", "tsit45"] {
        let report =
            network.solve_with(&SolveSettings::lasting(1.0).by_name(method).unwrap()).unwrap();
        assert_eq!(report.contacts[0].impact.contact, Contact::Lasting, "{method}");
        assert_eq!(report.measure("pad.contact-time").unwrap().value, None, "{method}");
        let settings = SolveSettings::lasting(0.3);
        let exact = loaded.solve_with(&settings.clone().by_name("exact").unwrap()).unwrap();
        let report = loaded.solve_with(&settings.by_name(method).unwrap()).unwrap();
        for measure in &report.measures {
            let gap = (measure.value.unwrap() - value(&exact, &measure.key)).abs();
            let bar = measure.error.unwrap();
            assert!(gap <= bar && bar.is_finite(), "{method} {}: {gap} > {bar}", measure.key);
        }
    }
}

#[test]
fn slow_and_shallow_pull_is_a_release_or_the_bars_say_that_it_may_be_one() {
    // The force turns to tension of 4e-4 and of 2e-7 of its peak, which lasts.
    for (stiffness, duration, is_clear) in [(4e4, 0.3, true), (800.0, 8.0, false)] {
        let network = oscillator(stiffness, 2e3);
        let settings = SolveSettings::lasting(duration);
        let exact = network.solve_with(&settings.clone().by_name("exact").unwrap()).unwrap();
        for method in ["bdf", "tr-bdf2", "esdirk34"] {
            let report = network.solve_with(&settings.clone().by_name(method).unwrap()).unwrap();
            for measure in &report.measures {
                let Some(found) = measure.value else {
                    assert!(!is_clear && measure.error == Some(f64::INFINITY), "{measure:?}");
                    continue;
                };
                let gap = (found - value(&exact, &measure.key)).abs();
                assert!(gap <= measure.error.unwrap(), "{method} {}: {gap}", measure.key);
            }
        }
    }
}

#[test]
fn quiet_corner_of_a_network_does_not_cost_the_exact_method() {
    let mut network = oscillator(800.0, 8.0);
    let ground = network.ground();
    let quiet = network.add_node(Node::mass("quiet", 1.0));
    let mount = Model::series([spring(3e4), Model::parallel([dashpot(5e3), spring(190.0)])]);
    network.connect("mount", quiet, ground, mount);
    let mut settings = SolveSettings::lasting(0.5);
    let window = WindowWish::Run;
    settings.measures.push(MeasureWish::new("mount", Energy { window }));
    settings.measures.push(MeasureWish::new("mount", PeakForce { window }));
    settings.measures.push(MeasureWish::new("quiet", EndVelocity { window }));
    let report = network.solve_with(&settings).unwrap();
    assert_eq!(report.solver.method, "exact");
    assert!(report.measures.iter().all(|measure| measure.excess <= 1.0));
    assert!(report.worst_relative_error().unwrap() < 1e-6);
}

#[test]
fn bound_of_the_energy_does_not_grow_with_what_happens_after_it() {
    let settings = SolveSettings::lasting(1e7).by_name("exact").unwrap();
    let report = oscillator(800.0, 8.0).solve_with(&settings).unwrap();
    let energy = report.measure("pad.energy-at-end").unwrap();
    assert!(energy.relative_error().unwrap() < 1e-8, "{energy:?}");
}

#[test]
fn condition_that_holds_at_the_start_is_pointed_out() {
    let stop =
        |level: f64, direction| Stop { output: "head.velocity".to_owned(), level, direction };
    let warned = |stop| {
        let settings = SolveSettings { stops: vec![stop], ..SolveSettings::lasting(0.1) };
        let report = oscillator(800.0, 8.0).solve_with(&settings).unwrap();
        report
            .warnings
            .iter()
            .any(|warning| warning.to_string().contains("holds already at the start"))
    };
    assert!(warned(stop(4.0, Direction::Falling)) && warned(stop(2.0, Direction::Rising)));
    assert!(!warned(stop(2.0, Direction::Falling)) && !warned(stop(2.0, Direction::Either)));
}

#[test]
fn one_step_methods_follow_what_drives_a_law_without_any_state() {
    // A dashpot of power 2 between a support that shakes and ground: `∮ F ẏ dt` of one period is
    // `F_r/v_r² (A ω)³ · 8/(3 ω)`, because `∮ |cos|³ = 8/3`.
    let (amplitude, omega) = (0.01, std::f64::consts::TAU * 10.0);
    let mut network = Network::new();
    let sine = Waveform::new(vec![Piece { sine: amplitude, omega, ..Piece::default() }]).unwrap();
    let support = network.add_node(Node::prescribed("support", sine));
    let dashpot = PowerDashpot { force: 100.0, at: 1.0, exponent: 2.0 };
    network.connect("damper", support, network.ground(), part(dashpot));
    let expected = 100.0 * (amplitude * omega).powi(3) * 8.0 / (3.0 * omega);
    for method in ["bdf", "esdirk34", "tr-bdf2"] {
        let settings = SolveSettings::lasting(0.1).by_name(method).unwrap();
        let report = network.solve_with(&settings).unwrap();
        let energy = report.measure("damper.energy").unwrap();
        let error = (energy.value.unwrap() - expected).abs();
        assert!(error <= energy.error.unwrap(), "{method}: {error} of {expected}");
        assert!(error <= 1e-3 * expected, "{method}: {error} of {expected}");
    }
}
