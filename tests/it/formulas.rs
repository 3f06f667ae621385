//! Laws and driving functions that are given by formulas, against built-in ones and against independent integration.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    network::{
        Element,
        elements::{CubicSpring, Formula, PowerDashpot, PowerSpring, StiffeningSpring},
        parameters,
        waveforms::{self, HalfSine, Ramp, Sine, WaveformKind},
    },
    scene::{ReadOptions, read},
};

fn parsed(text: &str) -> parameters::Formula {
    parameters::Formula::parse(text, &|name| ["y", "v", "t"].contains(&name))
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn formulas_of_built_in_laws_are_those_laws() {
    let cases: [(&str, Box<dyn Element>); 4] = [
        ("20 kN/m * y + 3 MN/m^3 * y^3", Box::new(CubicSpring { stiffness: 2e4, cubic: 3e6 })),
        (
            "100 N * (abs(y) / 1 cm)^0.5 * y / 1 cm",
            Box::new(PowerSpring { force: 100.0, at: 0.01, exponent: 1.5 }),
        ),
        (
            "2 * 20 kN/m * 6 cm / pi * tan(pi * y / (2 * 6 cm))",
            Box::new(StiffeningSpring { stiffness: 2e4, limit: 0.06 }),
        ),
        (
            "80 N * abs(v) * v / (1 m/s)^2",
            Box::new(PowerDashpot { force: 80.0, at: 1.0, exponent: 2.0 }),
        ),
    ];
    for (text, law) in cases {
        let own = Formula::new(parsed(text), None, None).unwrap_or_else(|error| panic!("{error}"));
        for at in -60..=60 {
            for v in [-2.3, -0.4, 0.7, 1.9] {
                let y = 5e-4 * f64::from(at) + 1e-5;
                let (found, exact) = (own.force(y, v), law.force(y, v));
                assert!((found - exact).abs() <= 1e-12 * exact.abs(), "{text} at {y}, {v}");
                let (found, exact) = (own.tangent(y, v), law.tangent(y, v));
                let gap = (found.stiffness - exact.stiffness).abs() / exact.stiffness.max(1.0);
                assert!(gap <= 1e-12, "{text} at {y}, {v}: {gap:e}");
                let gap = (found.damping - exact.damping).abs() / exact.damping.max(1.0);
                assert!(gap <= 1e-12, "{text} at {y}, {v}: {gap:e}");
                let (found, exact) = (own.stored(y), law.stored(y));
                assert!((found - exact).abs() <= 1e-12 * exact.abs(), "{text}: {found} {exact}");
            }
        }
    }
}

/// A function of any kind.
trait Waveforming {
    fn made(&self) -> dashpot::dae::Waveform;
}

impl<K: WaveformKind> Waveforming for K {
    fn made(&self) -> dashpot::dae::Waveform {
        self.waveform().unwrap()
    }
}

#[test]
fn formulas_of_built_in_functions_are_those_functions() {
    let cases: [(&str, Box<dyn Waveforming>, f64); 3] = [
        ("1 kN * t / 10 ms", Box::new(Ramp { height: 1e3, rise: 0.01, start: 0.0 }), 0.01),
        (
            "300 N * sin(2 * pi * 60 Hz * t)",
            Box::new(Sine { amplitude: 300.0, frequency: 60.0, phase: 0.0 }),
            0.5,
        ),
        (
            "2 kN * sin(pi * t / 8 ms)",
            Box::new(HalfSine { peak: 2e3, duration: 8e-3, start: 0.0 }),
            8e-3,
        ),
    ];
    for (text, built_in, end) in cases {
        let own = waveforms::Formula { value: parsed(text), until: None }.waveform().unwrap();
        let built_in = built_in.made();
        for at in 0..100 {
            let t = end * (f64::from(at) + 0.5) / 100.0;
            for order in 0..3 {
                let [found, exact] =
                    [&own, &built_in].map(|own| own.piece_at(t).derivative(order, t));
                let size = 2e3 * (std::f64::consts::PI / 8e-3).powi(order.try_into().unwrap());
                assert!((found - exact).abs() <= 1e-12 * size, "{text} at {t}: {found} {exact}");
            }
        }
    }
}

fn run(text: &str, method: &str, rtol: f64) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let settings = scene.value.settings(method).unwrap();
    let settings = SolveSettings { rtol: Some(rtol), ..settings };
    scene.value.network.solve_with(&settings).unwrap_or_else(|error| panic!("{error}"))
}

fn reference(case: &str, quantity: &str) -> f64 {
    let table = include_str!("formulas_reference.csv");
    let row = table.lines().find_map(|line| line.strip_prefix(&format!("{case},{quantity},")));
    row.expect("a row of the table").parse().expect("a number")
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).and_then(|own| own.value).unwrap_or_else(|| panic!("{key}"))
}

#[test]
fn impacts_on_formulas_reach_what_is_integrated_independently() {
    for (case, law) in [("tanh", "F * tanh(y / a)"), ("sinh", "F * sinh(y / a)")] {
        let text = format!(
            "[values]\nF = \"2 kN\"\na = \"5 mm\"\n\
             [nodes]\nhead = {{ mass = 5, velocity = 4 }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], formula = \"{law}\" }}\n\
             [measures]\npad = [\"peak-deformation\", \"peak-force\", \"contact-time\"]\n\
             [run]\nduration = \"30 ms\"\n"
        );
        for method in ["bdf", "dop853"] {
            let report = run(&text, method, 1e-12);
            for (measure, quantity) in [
                ("peak-deformation", "depth"),
                ("peak-force", "force"),
                ("contact-time", "contact"),
            ] {
                let (found, exact) =
                    (value(&report, &format!("pad.{measure}")), reference(case, quantity));
                let off = (found / exact - 1.0).abs();
                assert!(off <= 1e-9, "{case} by {method}: {measure} {found} {exact} {off:e}");
            }
        }
    }
}

#[test]
fn loads_by_formulas_reach_what_is_integrated_independently() {
    for (case, load) in [
        ("square", "\"2 kN * (t / 5 ms)^2\""),
        ("step", "{ value = \"1 kN * (1 + tanh((t - 10 ms) / 1 ms))\", until = \"20 ms\" }"),
        ("decay", "{ value = \"2 kN * t / tau * exp(-t / tau)\", until = \"20 ms\" }"),
    ] {
        let text = format!(
            "[values]\ntau = \"3 ms\"\n[nodes]\nbody = {{ mass = 5 }}\n\
             [elements]\nspring = {{ between = [\"body\", \"ground\"], spring = 2e5 }}\n\
             [loads]\npush = {{ on = \"body\", force = {{ formula = {load} }} }}\n\
             [measures]\nbody = [{{ kind = \"end-position\", window = \"run\" }}]\n\
             [run]\nduration = \"20 ms\"\n"
        );
        let text =
            if case == "decay" { text } else { text.replace("[values]\ntau = \"3 ms\"\n", "") };
        for method in ["exact", "dop853"] {
            let found = value(&run(&text, method, 1e-12), "body.end-position");
            let off = (found / reference(case, "x") - 1.0).abs();
            assert!(off <= 1e-9, "{case} by {method}: {found} {off:e}");
        }
    }
}
