//! Power laws in series, and laws with a kink, by the methods that take steps.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    scene::{ReadOptions, read},
};

const STEPPING: [&str; 3] = ["bdf", "esdirk34", "tr-bdf2"];
const END: f64 = 0.3;

fn run(text: &str, method: &str, rtol: Option<f64>) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    let settings = SolveSettings { rtol, ..scene.settings(method).unwrap() };
    scene
        .network
        .solve_with(&settings)
        .unwrap_or_else(|error| panic!("{method} {rtol:?}: {error}\n{text}"))
}

fn value(report: &RunReport, key: &str) -> (f64, f64) {
    let found = report.measure(key).unwrap();
    (found.value.unwrap(), found.error.unwrap_or_else(|| panic!("{key}: {:?}", report.warnings)))
}

/// A mass of 1 kg at 3 m/s on a spring and a dashpot of power laws in series.
fn in_series(spring: f64, dashpot: f64) -> String {
    format!(
        "[nodes]\n\
         head = {{ mass = \"1 kg\", velocity = \"3 m/s\" }}\n\
         [elements.pad]\n\
         between = [\"head\", \"ground\"]\n\
         series = [{{ power-spring = {{ force = \"100 N\", at = \"5 mm\", exponent = {spring} }} }}, \
         {{ power-dashpot = {{ force = \"40 N\", at = \"1.4 m/s\", exponent = {dashpot} }} }}]\n\
         [measures]\n\
         head = [{{ kind = \"end-velocity\", window = \"run\" }}, {{ kind = \"end-position\", window = \"run\" }}]\n\
         [run]\n\
         duration = \"{END} s\"\n"
    )
}

/// Place and velocity of this mass at the end: ẋ = v, v̇ = −F/m, and the spring, whose force the
/// dashpot has, too, is compressed at the velocity less the dashpot's rate. Runge's and Kutta's method.
fn judged(spring: f64, dashpot: f64, steps: u32) -> [f64; 2] {
    let power = |of: f64, exponent: f64| of.abs().powf(exponent).copysign(of);
    let rates = |[_, v, y]: [f64; 3]| {
        let force = 100.0 * power(y / 0.005, spring);
        [v, -force, v - 1.4 * power(force / 40.0, dashpot.recip())]
    };
    let h = END / f64::from(steps);
    let mut state = [0.0, 3.0, 0.0];
    for _ in 0..steps {
        let moved = |by: f64, rates: [f64; 3]| [0, 1, 2].map(|k| state[k] + by * h * rates[k]);
        let k1 = rates(state);
        let k2 = rates(moved(0.5, k1));
        let k3 = rates(moved(0.5, k2));
        let k4 = rates(moved(1.0, k3));
        state = [0, 1, 2].map(|k| state[k] + h / 6.0 * (k1[k] + 2.0 * (k2[k] + k3[k]) + k4[k]));
    }
    [state[0], state[1]]
}

#[test]
fn a_dashpot_that_is_steep_at_rest_behind_a_spring_is_within_its_bars_at_all_tolerances() {
    for (spring, dashpot) in [(1.0, 0.5), (1.5, 0.2), (2.0, 0.5), (2.0, 0.35), (3.0, 0.8)] {
        let text = in_series(spring, dashpot);
        let [coarse, truth] = [200_000, 400_000].map(|steps| judged(spring, dashpot, steps));
        for method in STEPPING {
            for rtol in [None, Some(1e-4), Some(1e-6), Some(1e-8), Some(1e-10)] {
                let report = run(&text, method, rtol);
                for (at, key) in ["head.end-position", "head.end-velocity"].into_iter().enumerate()
                {
                    let (found, bar) = value(&report, key);
                    let off = (found - truth[at]).abs();
                    let threshold = 2.0 * (truth[at] - coarse[at]).abs() + 1e-12;
                    let what = format!("{method} {rtol:?}, {spring} and {dashpot}: {key}");
                    assert!(
                        off <= bar + threshold,
                        "{what}: {off:e} beside a bar of {bar:e} ± {threshold:e}"
                    );
                }
            }
        }
    }
}

/// A spring that is stiffer in loading than in unloading, before a dashpot, under weight.
const KINK: &str = "[nodes]\n\
    head = { mass = \"15.47 kg\", velocity = \"0.3452 m/s\" }\n\
    [elements.pad]\n\
    between = [\"head\", \"ground\"]\n\
    series = [{ rate-spring = { force = \"382.4 N\", at = \"0.06967 m\", gain = 0.107, \
    reference-rate = \"0.0211 m/s\", exponent = 1.5 } }, \
    { power-dashpot = { force = \"377.1 N\", at = \"1.312 m/s\", exponent = 0.8 } }]\n\
    [effects]\n\
    gravity = { start = \"unloaded\" }\n\
    separation.pad = { at = \"head\" }\n\
    [measures]\n\
    head = [{ kind = \"end-velocity\", window = \"run\" }, { kind = \"end-position\", window = \"run\" }]\n\
    [run]\n\
    duration = \"1.606 s\"\n";

#[test]
fn steps_that_a_kink_has_stopped_go_on_from_consistent_values() {
    for key in ["head.end-position", "head.end-velocity", "pad.peak-force"] {
        let found: Vec<(f64, f64)> = STEPPING
            .iter()
            .flat_map(|method| [None, Some(1e-4), Some(1e-8)].map(|rtol| run(KINK, method, rtol)))
            .map(|report| {
                assert!(report.energy.closure().abs() < 1e-3, "{}", report.energy.closure());
                value(&report, key)
            })
            .collect();
        for (one, bar) in &found {
            for (other, its) in &found {
                assert!((one - other).abs() <= bar + its, "{key}: {found:?}");
            }
        }
    }
}

/// A padding that loses energy behind a spring whose force hardly depends on its rate when it is let go.
const LOSSY: &str = "[nodes]\n\
    head = { mass = \"68.05 kg\", velocity = \"0.2104 m/s\" }\n\
    [elements.pad]\n\
    between = [\"head\", \"ground\"]\n\
    series = [{ rate-spring = { force = \"73.99 kN\", at = \"1.115 mm\", gain = 0.666, \
    reference-rate = \"43.81 um/s\", exponent = 2 } }, \
    { hysteretic-table = { loading = [[0, 0], [0.0014807, 261.69], [0.0029398, 552.43]], \
    unloading = [[6.4555e-05, 0], [0.0029398, 552.43]] } }]\n\
    [measures]\n\
    head = [{ kind = \"end-velocity\", window = \"run\" }, { kind = \"end-position\", window = \"run\" }]\n\
    [run]\n\
    duration = \"83.25 ms\"\n";

#[test]
fn a_curve_of_unloading_is_taken_at_all_tolerances_where_balances_barely_tell_the_rate() {
    let finest = run(LOSSY, "bdf", Some(3e-11));
    for method in STEPPING {
        for rtol in [None, Some(1e-5), Some(1e-6), Some(1e-7), Some(1e-8)] {
            let own = run(LOSSY, method, rtol);
            for key in ["head.end-position", "head.end-velocity", "pad.energy-at-end"] {
                let ((truth, threshold), (found, bar)) = (value(&finest, key), value(&own, key));
                let off = (found - truth).abs();
                assert!(
                    off <= bar + threshold,
                    "{method} {rtol:?}: {key} {found} ± {bar} for {truth}"
                );
            }
        }
    }
}
