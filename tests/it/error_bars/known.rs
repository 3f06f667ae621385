//! Scenes in which a number was outside of its bar, or had none, by a cause of its own.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    scene::{ReadOptions, read},
};

fn run(text: &str, method: &str, rtol: Option<f64>) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    let settings = SolveSettings { rtol, ..scene.settings(method).unwrap() };
    scene.network.solve_with(&settings).unwrap_or_else(|error| panic!("{method} {rtol:?}: {error}"))
}

/// A head on a spring beside a dashpot so strong that the force is next to nothing when it turns to a pull:
/// with the poles −a and −b of x'' + c x' + k x = 0 it is zero at t = 2 ln(b/a)/(b − a), and from there on
/// pulls with at most a²/b² of its peak.
#[test]
fn a_force_that_comes_to_nothing_is_not_said_to_push_until_the_end() {
    let (c, k): (f64, f64) = (1050.0, 1.0);
    let text = format!(
        "[nodes]\nhead = {{ mass = 1, velocity = 1 }}\n[elements.pad]\nbetween = [\"head\", \"ground\"]\n\
         kelvin-voigt = {{ spring = {k}, dashpot = {c} }}\n[run]\nduration = 3\n"
    );
    let fast = 0.5 * (c + (c * c - 4.0 * k).sqrt());
    let slow = k / fast;
    let end = 2.0 * (fast / slow).ln() / (fast - slow);
    let exact = run(&text, "exact", None);
    let time = exact.measure("pad.contact-time").unwrap();
    let error = time.error.unwrap();
    assert!((time.value.unwrap() - end).abs() <= error && error < 0.01 * end, "{end} {time:?}");
    for method in ["bdf", "tr-bdf2", "esdirk34"] {
        let report = run(&text, method, None);
        let time = report.measure("pad.contact-time").unwrap();
        let is_covered = match (time.value, time.error) {
            (Some(value), Some(error)) => (value - end).abs() <= error,
            (None, error) => error.is_some_and(f64::is_infinite),
            _ => false,
        };
        assert!(is_covered, "{method}: {time:?}");
        let told =
            |what: &str| report.warnings.iter().any(|warning| warning.to_string().contains(what));
        assert!(told("whether the impact ends there is open"), "{method}: {:?}", report.warnings);
        assert!(!told("still in contact at the end"), "{method}: {:?}", report.warnings);
        // All that does not hang on it is as good as it was.
        let missed = report
            .measures
            .iter()
            .filter(|measure| measure.value.is_some() && measure.excess > 1.0);
        assert_eq!(missed.count(), 0, "{method}");
    }
}

/// A pad without a rate of its own, so that its peak rate is read off its deformation, in a run with steps as
/// short as the time is told: they are where the rate passes the power dashpot's singular zero.
#[test]
fn steps_of_a_rounding_do_not_make_rates() {
    let text = r#"
[nodes]
head = { mass = "6.417 kg", velocity = "7.867 m/s" }
floor = { motion = { sine = { amplitude = "0.008554 m", frequency = "156.4 Hz" } } }
[elements]
pad = { between = ["head", "floor"], parallel = [{ series = [{ spring = "742955.6848701881 N/m" }, { power-dashpot = { force = 8890.0, at = "7.867 m/s", exponent = 1.5 } }] }, { series = [{ cubic-spring = { stiffness = 79580.0, cubic = 239200000.0 } }, { parallel = [{ table-spring = [["-0.03351 m", "-7112.0 N"], ["0.0 m", "0.0 N"], ["0.0071675 m", "1007.8 N"], ["0.022342 m", "5218.5 N"], ["0.025861 m", "12776.0 N"]] }, { dashpot = "338.672047794585 N s/m" }] }] }, { power-dashpot = { force = 3556.0, at = "7.867 m/s", exponent = 0.4 } }, { dashpot = "602.6 N s/m" }] }
[effects]
separation.pad = { at = "head" }

[measures]
pad = [{ kind = "peak-rate", window = "run" }]
[run]
duration = "0.03953 s"
"#;
    let peak = |half_decades: i32| {
        let report = run(text, "bdf", Some(10.0_f64.powf(-0.5 * f64::from(half_decades))));
        report
            .measure("pad.peak-rate-2")
            .or(report.measure("pad.peak-rate"))
            .unwrap()
            .value
            .unwrap()
    };
    let peaks = [9, 11, 13, 17, 19, 21].map(peak);
    for value in peaks {
        assert!((value / peaks[5] - 1.0).abs() < 1e-4, "{peaks:?}");
    }
    // No faster than the head, which is only ever slowed down, and the floor at its fastest.
    let most = 7.867 + 0.008_554 * 156.4 * std::f64::consts::TAU;
    assert!(peaks[5] < most, "{peaks:?}");
}
