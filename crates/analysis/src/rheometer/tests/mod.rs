//! Both ways of the rheometer against closed forms, and against each other.

mod cycles;
mod random;

use std::f64::consts::TAU;

use dashpot_network::{Model, dashpot, elements::Rigid, part, spring};

use super::*;

const BOTH: &[&str] = &["exact", "bdf"];
/// Rounding of some ten operations.
const ROUNDING: f64 = 1e-14;

fn kelvin_voigt(stiffness: f64, damping: f64) -> Model {
    Model::parallel([spring(stiffness), dashpot(damping)])
}

fn maxwell(stiffness: f64, damping: f64) -> Model {
    Model::series([spring(stiffness), dashpot(damping)])
}

/// The padding of the thesis' reference case.
const K1: f64 = 20e6;
const C1: f64 = 4e3;
const K2: f64 = 20e6;
const C2: f64 = 6e3;

fn burgers() -> Model {
    Model::series([kelvin_voigt(K1, C1), spring(K2), dashpot(C2)])
}

fn zener() -> Model {
    Model::parallel([spring(1e6), maxwell(9e6, 9e3)])
}

fn run(model: &Model, kind: &str, given: &[(&str, f64)], methods: &[&str]) -> RheometerReport {
    let methods: Vec<Choice> =
        methods.iter().map(|method| Choice::named(method).unwrap()).collect();
    let specimen = Specimen::new(model).unwrap();
    protocol(kind, given).unwrap().run(&specimen, &methods).unwrap()
}

fn refused(model: &Model, kind: &str, given: &[(&str, f64)]) -> RheometerError {
    let specimen = Specimen::new(model).unwrap();
    protocol(kind, given).unwrap().run(&specimen, &default_methods()).unwrap_err()
}

/// Checks the first series against `expected`, which says what holds at each time: just after, and
/// just before where that differs. The first rows are those of the time 0.
fn follows(report: &RheometerReport, expected: impl Fn(f64) -> f64) {
    let (times, series) = (&report.abscissa.values, &report.series[0]);
    let largest = times[1..].iter().map(|&t| expected(t).abs()).fold(0.0, f64::max);
    assert_eq!(series.model[0].to_bits(), 0, "before the test there is nothing");
    for (row, &time) in times.iter().enumerate().skip(1) {
        let error = (series.model[row] - expected(time)).abs() / largest;
        assert!(error <= ROUNDING, "{} at {time} s: {error:e}", report.protocol);
    }
    for (computed, computation) in series.computed.iter().zip(&report.computations) {
        let method = computation.method;
        assert_eq!(computation.obstacle, None, "{method}");
        let found = computed.difference.unwrap();
        let stated = found.stated.unwrap_or_else(|| panic!("{method} states no error"));
        assert!(found.relative <= stated + ROUNDING, "{} by {method}: {found:?}", report.protocol);
        let most = if method == "exact" { 1e-12 } else { 1e-5 };
        assert!(stated <= most, "{} by {method}: {found:?}", report.protocol);
    }
}

#[test]
fn creep_follows_the_closed_forms() {
    let force = 1e3;
    follows(&run(&spring(2e5), "creep", &[], BOTH), |_| force / 2e5);
    follows(&run(&dashpot(4e3), "creep", &[], BOTH), |t| force * t / 4e3);
    follows(&run(&kelvin_voigt(K1, C1), "creep", &[], BOTH), |t| {
        force / K1 * -(-t * K1 / C1).exp_m1()
    });
    follows(&run(&maxwell(K2, C2), "creep", &[], BOTH), |t| force * (1.0 / K2 + t / C2));
    // J(t) = 1/K_e − (1/K_e − 1/K_g) e^(−t/λ), λ = C (K_e + K)/(K_e K).
    follows(&run(&zener(), "creep", &[], BOTH), |t| {
        force * (1e-7 + 9e-7 * -(-t / 10e-3_f64).exp_m1())
    });
    follows(&run(&burgers(), "creep", &[], BOTH), |t| {
        force * (1.0 / K2 + t / C2 + -(-t * K1 / C1).exp_m1() / K1)
    });
}

#[test]
fn relaxation_follows_the_closed_forms() {
    let y = 1e-3;
    follows(&run(&spring(2e5), "relaxation", &[], BOTH), |_| 2e5 * y);
    follows(&run(&maxwell(K2, C2), "relaxation", &[], BOTH), |t| K2 * y * (-t * K2 / C2).exp());
    follows(&run(&zener(), "relaxation", &[], BOTH), |t| y * (1e6 + 9e6 * (-t / 1e-3_f64).exp()));
}

#[test]
fn constant_rate_follows_the_closed_forms() {
    let (end, rate) = (1e-2, 0.5);
    let given = [("rate", rate), ("end", end)];
    follows(&run(&spring(2e5), "constant-rate", &given, BOTH), |t| 2e5 * rate * t);
    follows(&run(&dashpot(4e3), "constant-rate", &given, BOTH), |_| 4e3 * rate);
    follows(&run(&kelvin_voigt(K1, C1), "constant-rate", &given, BOTH), |t| rate * (K1 * t + C1));
    follows(&run(&maxwell(K2, C2), "constant-rate", &given, BOTH), |t| {
        rate * C2 * -(-t * K2 / C2).exp_m1()
    });
    follows(&run(&zener(), "constant-rate", &given, BOTH), |t| {
        rate * (1e6 * t + 9e3 * -(-t / 1e-3_f64).exp_m1())
    });
}

#[test]
fn figure_2_of_the_thesis_has_its_three_parts() {
    let (force, hold) = (1e3, 1e-3);
    let report = run(&burgers(), "load-hold-unload", &[("force", force), ("hold", hold)], BOTH);
    let delayed = force / K1 * -(-hold * K1 / C1).exp_m1();
    for (name, value) in [
        ("ε2, instantaneous part at the end of the hold", force / K2),
        ("ε1, delayed part at the end of the hold", delayed),
        ("ε3, viscous part at the end of the hold", force * hold / C2),
        ("deformation at the end of the hold", force / K2 + delayed + force * hold / C2),
        ("comes back while unloading", force / K2),
        ("left at the end", force * hold / C2),
        ("stays for good", force * hold / C2),
    ] {
        let figure = report.figure(name).unwrap();
        // Of the delayed part something is always left.
        let remainder = if name == "left at the end" { 1e-6 } else { 1e-13 };
        let model = figure.model.unwrap();
        assert!((model / value - 1.0).abs() < remainder, "{name}: {model} is not {value}");
        if let Some(computed) = figure.computed {
            assert!((computed / model - 1.0).abs() < 1e-12, "{name}: {computed} is not {model}");
        }
    }
    for series in &report.series {
        for computed in &series.computed {
            let found = computed.difference.unwrap();
            assert!(
                found.relative <= found.stated.unwrap() + ROUNDING,
                "{}: {found:?}",
                series.name
            );
        }
    }
    let row = report.abscissa.values.len() - 20;
    let parts: f64 = report.series[1..].iter().map(|series| series.model[row]).sum();
    assert!((parts / report.series[0].model[row] - 1.0).abs() < ROUNDING);
}

#[test]
fn loading_may_take_its_time() {
    let (force, rise, hold) = (1e3, 2e-4, 1e-3);
    let given = [("force", force), ("rise", rise), ("hold", hold)];
    let report = run(&burgers(), "load-hold-unload", &given, BOTH);
    // Under a ramp of the slope F/t_r the Kelvin element lags behind by λ (1 − e^(−t/λ)).
    let late = C1 / K1;
    let ramp = |t: f64| t + late * (-t / late).exp_m1();
    let delayed = |t: f64| {
        let since = [0.0, rise, rise + hold, rise + hold + rise].map(|at| (t - at).max(0.0));
        force / (rise * K1) * (ramp(since[0]) - ramp(since[1]) - ramp(since[2]) + ramp(since[3]))
    };
    let series = report.series("delayed").unwrap();
    for (&time, &value) in report.abscissa.values.iter().zip(&series.model) {
        assert!((value - delayed(time)).abs() < 1e-12 * force / K1, "{time}");
    }
    let stays = report.figure("stays for good").unwrap().model.unwrap();
    assert!((stays / (force * (hold + rise) / C2) - 1.0).abs() < 1e-13);
    for computed in report.series.iter().flat_map(|series| &series.computed) {
        let found = computed.difference.unwrap();
        assert!(found.relative <= found.stated.unwrap() + ROUNDING, "{found:?}");
    }
}

#[test]
fn recovery_is_creep_less_delayed_creep() {
    let report = run(&zener(), "creep-recovery", &[("hold", 0.02)], BOTH);
    let specimen = Specimen::new(&zener()).unwrap();
    let creep = |t: f64| if t >= 0.0 { 1e3 * specimen.linear().unwrap().creep(t) } else { 0.0 };
    let rows = report.abscissa.values.iter().zip(&report.series[0].model).skip(1);
    for (&time, &value) in rows.filter(|(time, _)| (*time - 0.02).abs() > 0.0) {
        let expected = creep(time) - creep(time - 0.02);
        assert!((value - expected).abs() < 1e-14 * creep(0.02), "{time}: {value} {expected}");
    }
    for computed in &report.series[0].computed {
        let found = computed.difference.unwrap();
        assert!(found.relative <= found.stated.unwrap() + ROUNDING, "{found:?}");
    }
}

#[test]
fn sweep_follows_the_closed_forms() {
    // Zener: Q = K_e + K iωτ/(1 + iωτ); the peak of tan δ lies at √(K_e/K_g)/τ.
    let report = run(&zener(), "sweep", &[], &["exact"]);
    for (row, frequency) in report.abscissa.values.iter().enumerate() {
        let x = TAU * frequency * 1e-3;
        let storage = 1e6 + 9e6 * x * x / (1.0 + x * x);
        let loss = 9e6 * x / (1.0 + x * x);
        assert!((report.series[0].model[row] / storage - 1.0).abs() < ROUNDING);
        assert!((report.series[1].model[row] / loss - 1.0).abs() < ROUNDING);
        assert!((report.series[2].model[row] * storage / loss - 1.0).abs() < ROUNDING);
    }
    assert!(report.largest_difference().unwrap() < ROUNDING, "{:?}", report.largest_difference());
    let peak = report.figure("peak of the loss factor").unwrap().model.unwrap();
    assert!((peak / (9.0 / (2.0 * 10_f64.sqrt())) - 1.0).abs() < ROUNDING);
    let place = report.figure("frequency of the peak").unwrap().model.unwrap();
    assert!((place * TAU * 1e-3 * 10_f64.sqrt() - 1.0).abs() < 1e-7);
    for model in [spring(2e5), dashpot(4e3), kelvin_voigt(K1, C1), maxwell(K2, C2), burgers()] {
        let report = run(&model, "sweep", &[], &["exact"]);
        assert!(report.largest_difference().unwrap() < ROUNDING, "{report:?}");
    }
}

#[test]
fn what_cannot_be_done_is_refused_in_mechanical_words() {
    let rigid: Model = part(Rigid);
    let nothing = spring(0.0);
    for kind in ["creep", "creep-recovery", "load-hold-unload"] {
        assert!(refused(&nothing, kind, &[]).to_string().contains("bears no force"), "{kind}");
    }
    for kind in ["relaxation", "constant-rate", "sweep"] {
        assert!(refused(&rigid, kind, &[]).to_string().contains("does not deform"), "{kind}");
    }
    let sudden = refused(&kelvin_voigt(K1, C1), "relaxation", &[("rise", 0.0)]);
    assert!(sudden.to_string().contains("infinite force"), "{sudden}");
    let early = refused(&zener(), "creep-recovery", &[("hold", 1.0), ("end", 1.0)]);
    assert!(early.to_string().contains("`end` must be"), "{early}");
    let unknown = protocol("twist", &[]).unwrap_err();
    assert!(unknown.to_string().contains("load-hold-unload"), "{unknown}");
    let unknown = protocol("creep", &[("rate", 1.0)]).unwrap_err();
    assert!(unknown.to_string().contains("force, end, points"), "{unknown}");
    assert!(protocol("creep", &[("points", 2.5)]).is_err());
    assert!(protocol("creep", &[("force", 0.0)]).is_err());
    assert!(Specimen::new(&spring(-1.0)).is_err());
    assert!(Specimen::new(&Model::series([])).is_err());
    assert!(Choice::named("magic").is_err());
}

#[test]
fn models_at_the_limits_are_tested_all_the_same() {
    let rigid: Model = part(Rigid);
    let report = run(&rigid, "creep", &[], BOTH);
    assert!(report.series[0].model.iter().all(|&value| value == 0.0));
    assert_eq!(report.notes, [Note::NothingDeforms]);
    run(&rigid, "load-hold-unload", &[], BOTH);
    let report = run(&spring(0.0), "relaxation", &[], BOTH);
    assert!(report.series[0].model.iter().all(|&value| value == 0.0));
    run(&spring(0.0), "sweep", &[], &["exact"]);
    let report = run(&kelvin_voigt(K1, C1), "relaxation", &[], BOTH);
    assert!(report.notes[0].to_string().contains("infinite force"), "{:?}", report.notes);
    assert!(report.largest_difference().unwrap() < 1e-5, "{report:?}");
    let report = run(&dashpot(C1), "relaxation", &[], &["exact"]);
    assert!(report.largest_difference().unwrap() < 1e-13, "{report:?}");
}

#[test]
fn every_protocol_tests_every_form_with_its_defaults() {
    for model in
        [spring(2e5), dashpot(4e3), kelvin_voigt(K1, C1), maxwell(K2, C2), zener(), burgers()]
    {
        let specimen = Specimen::new(&model).unwrap();
        for kind in PROTOCOLS {
            let report = kind.example().unwrap().run(&specimen, &default_methods()).unwrap();
            let rows = report.abscissa.values.len();
            assert!((190..=220).contains(&rows), "{}: {rows}", kind.word);
            let settings: Vec<_> = report.settings.iter().map(|setting| setting.name).collect();
            // A motion turns at a deformation or at a force.
            let is_used = |name: &&str| kind.word != "load-unload" || *name != "force";
            let parameters: Vec<_> =
                kind.parameters.iter().map(|known| known.name).filter(is_used).collect();
            assert_eq!(settings, parameters, "{}", kind.word);
            for series in &report.series {
                assert_eq!(series.model.len(), rows);
                assert!(series.computed.iter().all(|computed| computed.values.len() == rows));
            }
        }
    }
}

#[test]
fn what_a_simulation_cannot_reach_is_said() {
    let elements = (0..12).map(|at| maxwell(1e6, 10_f64.powi(at)));
    let report = run(&Model::parallel(elements), "creep", &[], BOTH);
    let [exact, bdf] = &report.computations[..] else { panic!("two methods") };
    let end = report.settings[1].value;
    assert!(exact.reach.unwrap() < end && exact.obstacle.is_some(), "{exact:?}");
    assert!(bdf.reach.unwrap() >= end && bdf.obstacle.is_none(), "{bdf:?}");
    let series = &report.series[0];
    let reached = report.abscissa.values.iter().filter(|&&time| time <= exact.reach.unwrap());
    let found = series.computed[0].values.iter().flatten();
    assert_eq!(found.count(), reached.count());
    for computed in &series.computed {
        let found = computed.difference.unwrap();
        assert!(found.relative <= found.stated.unwrap() + ROUNDING, "{found:?}");
    }
}
