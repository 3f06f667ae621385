//! Waves in a bar with mass, and steady answers to a sine: in time and over frequency.

use std::f64::consts::TAU;

use dashpot::analysis::vibration::{Steady, Vibration};

use super::{
    reference::Case,
    trial::{STEPPING, Side, judge, scene},
};

/// A bar of layers, struck by a constant force on its left face.
const BAR: &str = "
    [materials.rod]
    spring = <E>
    [nodes]
    left = {}
    right = {}
    [elements]
    bar = { between = [\"left\", \"right\"], layers = [{ material = \"rod\", thickness = <L>, area = <A>, density = <rho> }], segments = 50 }
    [loads]
    push = { on = \"left\", force = { constant = <force> } }
    [run]
    duration = 0.0048
    ";

#[test]
fn a_wave_runs_through_a_bar_of_fifty_segments() {
    let case = Case::of("bar");
    judge(case, &["exact", "bdf", "esdirk34"], BAR, |trial| {
        let masses: Vec<String> = trial
            .report
            .assembly
            .nodes
            .iter()
            .filter(|node| node.mass > 0.0)
            .map(|node| node.name.clone())
            .collect();
        assert_eq!(masses.len(), case.count("param.segments"));
        for number in 1..=6 {
            let time = case.param(&format!("time-{number}"));
            for (label, at) in [("struck", 0), ("middle", 25), ("free", 49)] {
                let quantity = format!("cells.time-{number}.velocity-{label}");
                trial.value(&format!("{}.velocity", masses[at]), time, Side::Before, &quantity);
            }
        }
    });
}

#[test]
fn the_front_arrives_at_the_time_of_the_continuum_and_doubles_at_the_free_end() {
    let case = Case::of("bar");
    let text = case.fill(BAR);
    let report = super::trial::run(&text, "exact");
    let solution = report.solution();
    let signal = |name: &str| solution.signal(report.assembly.output(name).unwrap());
    let ends: Vec<&str> = report
        .assembly
        .nodes
        .iter()
        .filter(|node| node.mass > 0.0)
        .map(|node| node.name.as_str())
        .collect();
    // The front of a chain is as wide as the cube root of the segments that it has passed, and is at
    // half its height where that of the continuum is: Airy's integral is 1/3 there.
    let free = signal(&format!("{}.velocity", ends[49]));
    let expected = case.get("continuum.free-end-velocity-after-arrival");
    let arrival = free.first_crossing(0.5 * expected, (0.0, report.trajectory.t_end), Some(true));
    let passage = case.get("arrival.time") / 50.0;
    let late = arrival.unwrap().time - case.get("arrival.time");
    assert!(late.abs() < 50_f64.cbrt() * passage, "{late:e} s late");
    // Its mean over what it takes to come back is that of the continuum.
    let (from, to) = (1.1 * case.get("arrival.time"), 1.9 * case.get("arrival.time"));
    let mean = free.integral((from, to)) / (to - from);
    assert!((mean / expected - 1.0).abs() < 0.03, "{mean} instead of {expected}");
}

/// The steady oscillation of a scene under its drive, of an amplitude.
fn steady(text: &str, drive: &str, omega: f64, amplitude: f64) -> Steady {
    let network = scene(text).network;
    let vibration = Vibration::new(&network, 1.0, Some(drive)).unwrap();
    vibration.steady(omega / TAU, amplitude).unwrap()
}

/// Two relative numbers agree to rounding: nothing but a few complex operations on each frequency,
/// whose conversion to hertz and back costs roundings multiplied by the height of the resonance.
fn close(what: &str, found: f64, expected: f64) {
    let gap = (found - expected).abs();
    assert!(gap <= 1e-12 * expected.abs().max(1.0), "{what}: {found:.17} and {expected:.17}");
}

#[test]
fn transmissibility_over_frequency() {
    let pads = [
        ("kv-zeta-0.1", "kelvin-voigt = { spring = <K>, dashpot = <C> }"),
        ("kv-zeta-0.5", "kelvin-voigt = { spring = <K>, dashpot = <C> }"),
        ("maxwell", "maxwell = { spring = <K>, dashpot = <C> }"),
        ("zener", "zener = { spring = <K0>, maxwell = { spring = <K1>, dashpot = <C1> } }"),
    ];
    for (variant, pad) in pads {
        let case = Case::of(&format!("transmissibility-{variant}"));
        let text = case.fill(&format!(
            "[nodes]\nhead = {{ mass = <m> }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], {pad} }}\n\
             [run]\nduration = 1\n"
        ));
        for ratio in ["0.1", "0.5", "1", "sqrt2", "3", "10"] {
            let omega = case.param(&format!("r-{ratio}.omega"));
            let found = steady(&text, "ground", omega, 1.0);
            let swing = found.nodes.iter().find(|node| node.name == "head").unwrap().displacement;
            let label = format!("{variant} at {ratio}");
            close(&label, swing.amplitude, case.get(&format!("r-{ratio}.transmissibility")));
            close(&label, swing.phase, case.get(&format!("r-{ratio}.phase")));
            let deformation = found.elements[0].deformation.amplitude;
            close(&label, deformation, case.get(&format!("r-{ratio}.deformation-ratio")));
        }
        if case.find("largest.omega").is_some() {
            let found = steady(&text, "ground", case.get("largest.omega"), 1.0);
            let swing = found.nodes.iter().find(|node| node.name == "head").unwrap().displacement;
            close("largest", swing.amplitude, case.get("largest.transmissibility"));
        }
    }
}

#[test]
fn transmissibility_of_two_masses_in_a_row() {
    let case = Case::of("transmissibility-two-masses");
    let text = case.fill(
        "[nodes]\nfirst = { mass = <m1> }\nsecond = { mass = <m2> }\n\
         [elements]\n\
         upper = { between = [\"first\", \"second\"], kelvin-voigt = { spring = <K1>, dashpot = <C1> } }\n\
         lower = { between = [\"second\", \"ground\"], kelvin-voigt = { spring = <K2>, dashpot = <C2> } }\n\
         [run]\nduration = 1\n",
    );
    for ratio in ["0.1", "0.5", "1", "sqrt2", "3", "10"] {
        let omega = case.param(&format!("r-{ratio}.omega"));
        let found = steady(&text, "ground", omega, 1.0);
        for (name, number) in [("first", 1), ("second", 2)] {
            let swing = found.nodes.iter().find(|node| node.name == name).unwrap().displacement;
            let quantity = |of: &str| case.get(&format!("r-{ratio}.{of}-{number}"));
            close(ratio, swing.amplitude, quantity("transmissibility"));
            close(ratio, swing.phase, quantity("phase"));
        }
        let lower = found.elements.iter().find(|element| element.name == "lower").unwrap();
        close(
            ratio,
            lower.deformation.amplitude,
            case.get(&format!("r-{ratio}.deformation-ratio")),
        );
    }
}

#[test]
fn a_sine_force_on_a_kelvin_voigt_pad_over_frequency_and_in_time() {
    let case = Case::of("steady-kv");
    for ratio in ["0.1", "0.5", "1", "2", "10"] {
        let omega = case.param(&format!("r-{ratio}.omega"));
        let frequency = omega / TAU;
        let text = format!(
            "[nodes]\nhead = {{ mass = <m> }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = <K>, dashpot = <C> }} }}\n\
             [loads]\npush = {{ on = \"head\", force = {{ sine = {{ amplitude = <P>, frequency = {frequency:?} }} }} }}\n\
             [run]\nduration = 1\n"
        );
        let get = |of: &str| case.get(&format!("r-{ratio}.{of}"));
        let found = steady(&case.fill(&text), "push", omega, case.param("P"));
        let relative = |what: &str, value: f64, expected: f64| close(what, value / expected, 1.0);
        relative("amplitude", found.nodes[0].displacement.amplitude, get("amplitude"));
        close("lag", -found.nodes[0].displacement.phase, get("lag"));
        let force = found.elements[0].force.unwrap().amplitude;
        relative("force", force, get("pad-force-amplitude"));
        relative("power", found.power.unwrap(), get("power"));
        // Within 1 s the start has died away to exp(-60).
        let report = super::trial::run(&case.fill(&text), "exact");
        let solution = report.solution();
        let place = solution.signal(report.assembly.output("head.position").unwrap());
        let last = (1.0 - TAU / omega, 1.0);
        let top = place.maximum(last).value;
        let error = place.error.unwrap();
        assert!((top - get("amplitude")).abs() <= error + 1e-12 * top, "{top} {error:e}");
        assert!(error <= 1e-12 * place.bound(), "{error:e} of {:e}", place.bound());
    }
}

#[test]
fn a_hardening_spring_swings_with_harmonics() {
    let case = Case::of("steady-duffing");
    let omega = case.param("omega");
    let (frequency, period) = (omega / TAU, TAU / omega);
    // The start has died away to exp(-60 s/s t), 1e-10 within 10 periods.
    let duration = 12.0 * period;
    let text = format!(
        "[nodes]\nhead = {{ mass = <m> }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], parallel = [{{ cubic-spring = {{ stiffness = <k1>, cubic = <k3> }} }}, {{ dashpot = <C> }}] }}\n\
         [loads]\npush = {{ on = \"head\", force = {{ sine = {{ amplitude = <P>, frequency = {frequency:?} }} }} }}\n\
         [accuracy]\ndefault = 1e-5\n\
         [run]\nduration = {duration:?}\n"
    );
    judge(case, STEPPING, &text, |trial| {
        let start = 11.0 * period;
        let place = trial.signal("head.position");
        let top = place.absolute_maximum((start, trial.end()));
        trial.number("amplitude", top.value, case.get("amplitude"), case.get("amplitude"));
        trial.value("head.position", start, Side::Before, "period-start.position");
        trial.value("head.velocity", start, Side::Before, "period-start.velocity");
    });
}
