//! Time and data.

use std::{f64::consts::PI, thread};

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

use super::{
    case::Case,
    scene::{FORCES, Text, kelvin},
    table::judge,
};

#[test]
fn time_and_data() {
    judge("time", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![no_time_at_all(), a_nanosecond(), thirty_years(), late_origin()];
    cases.extend([many_periods(1e4), many_periods(1e5), light_damping()]);
    cases.extend([1e-310, 1e-322, 1e150].map(amplitude));
    cases.extend(units());
    cases.extend([steps_and_pulses(), needle()]);
    cases.extend(inconsistent_starts());
    cases.extend([samples(), again()]);
    cases
}

fn no_time_at_all() -> Case {
    let text = Text::head(1.0, 1.0).pad("spring = 100").measure("pad", FORCES).lasting(0.0);
    Case::new("a run of 0 s", "closed form", text, |trial| {
        trial.ends("head", 0.0, 1.0);
        trial.measure("pad.peak-force", 0.0);
        trial.measure("pad.impulse", 0.0);
    })
}

fn a_nanosecond() -> Case {
    let text = Text::head(1.0, 1.0).pad(&kelvin(100.0, 2.0)).measure("pad", FORCES).lasting(1e-9);
    Case::new("a run of 10⁻⁹ s", "closed form", text, |trial| {
        trial.ends("head", 1e-9 - 1e-18, 1.0 - 2e-9);
        trial.measure_known("pad.impulse", 2e-9, 1e-15);
    })
}

fn thirty_years() -> Case {
    let text = Text::head(1.0, 1.0).pad(&kelvin(100.0, 2.0)).measure("pad", FORCES).lasting(1e9);
    Case::new("a run of 10⁹ s after an impact of 10 s", "closed form", text, |trial| {
        let omega = 99.0_f64.sqrt();
        trial.measure("head.peak-displacement", 0.1 * (-omega.atan() / omega).exp());
        trial.measure("pad.impulse", 1.0);
        trial.measure("head.end-position", 0.0);
    })
}

fn late_origin() -> Case {
    let text = Text::head(1.0, 0.0)
        .pad("spring = 100")
        .with("[loads]\nram = { on = \"head\", force = { constant = { value = 100.0, start = 1e9 } } }")
        .lasting(1e9 + 1.0);
    Case::new("a force that begins at 10⁹ s", "closed form", text, |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        // A second after 10⁹ s is known to 10⁻⁷ s.
        trial.measure_known("head.end-position", 1.0 - cosine, 10.0 * 2.4e-7);
        trial.measure_known("head.end-velocity", 10.0 * sine, 100.0 * 2.4e-7);
        trial.measure_known("head.peak-displacement", 2.0, 1e-6);
    })
}

fn many_periods(periods: f64) -> Case {
    let end = periods + 0.1;
    let text = Text::head(1.0, 1.0).pad("spring = 39.47841760435743").lasting(end);
    Case::new(format!("{periods:e} undamped periods"), "closed form", text, move |trial| {
        let omega = 39.478_417_604_357_43_f64.sqrt();
        let (sine, cosine) = (omega * end).sin_cos();
        // So many radians are known to their rounding; 10⁻⁸ is promised.
        trial.measure_known("head.end-position", sine / omega, 1e-9);
        trial.measure_known("head.end-velocity", cosine, 1e-9);
        // What a spring has taken up depends on its ends alone, however long the run is.
        trial.measure_known("pad.energy-at-end", 0.5 * sine * sine, 1e-9);
        let error = trial.report.measure("pad.energy-at-end").and_then(|own| own.error);
        trial.holds("its bound does not add up", error.is_some_and(|error| error < 1e-8));
    })
}

fn light_damping() -> Case {
    let (zeta, omega) = (1e-4, 2.0 * PI);
    let text = Text::head(1.0, 1.0).pad(&kelvin(omega * omega, 2.0 * zeta * omega)).lasting(1000.1);
    let case = Case::new("ζ = 10⁻⁴ over 1000 periods", "closed form", text, move |trial| {
        let damped = omega * f64::sqrt(1.0 - zeta * zeta);
        let (sine, cosine) = (damped * 1000.1).sin_cos();
        let decay = (-zeta * omega * 1000.1).exp();
        let way = decay * sine / damped;
        trial.measure_known("head.end-position", way, 1e-11);
        trial.measure_known("head.end-velocity", decay * cosine - zeta * omega * way, 1e-10);
    });
    case.steps(200_000)
}

fn amplitude(speed: f64) -> Case {
    let text = Text::head(1.0, speed).pad("spring = 100").measure("pad", FORCES).lasting(1.0);
    Case::new(format!("start speed of {speed:e} m/s"), "closed form", text, move |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        // The smallest numbers have few digits.
        let threshold = 2e-322;
        trial.measure_known("head.end-position", speed * 0.1 * sine, threshold);
        trial.measure_known("head.end-velocity", speed * cosine, threshold);
        trial.measure_known("pad.peak-force", speed * 10.0, threshold);
    })
}

/// The reference impact of the thesis in other units.
fn units() -> [Case; 3] {
    let text = |mass: &str, speed: &str, k: [&str; 2], c: [&str; 3], heavy: &str, end: &str| {
        let [stiff, mount] = k;
        let [maxwell, retarded, support] = c;
        format!(
            "[nodes]\nhead = {{ mass = {mass}, velocity = {speed} }}\npanel = {{ mass = {heavy} }}\n\
             [elements]\npadding = {{ between = [\"head\", \"panel\"], burgers = {{ \
             maxwell = {{ spring = {stiff}, dashpot = {maxwell} }}, \
             kelvin = {{ spring = {stiff}, dashpot = {retarded} }} }} }}\n\
             mount = {{ between = [\"panel\", \"ground\"], kelvin-voigt = {{ spring = {mount}, dashpot = {support} }} }}\n\
             [run]\nduration = {end}\n"
        )
    };
    let nano = text(
        "\"1e13 ng\"",
        "\"10 nm/ns\"",
        ["\"20 ng/ns^2\"", "\"50 ng/ns^2\""],
        ["\"6e6 ng/ns\"", "\"4e6 ng/ns\"", "\"1e7 ng/ns\""],
        "\"1e14 ng\"",
        "\"2e7 ns\"",
    );
    let mega = text(
        "\"1e-5 Gg\"",
        "\"1e4 km/Ms\"",
        ["\"2e13 Gg/Ms^2\"", "\"5e13 Gg/Ms^2\""],
        ["\"6e3 Gg/Ms\"", "\"4e3 Gg/Ms\"", "\"1e4 Gg/Ms\""],
        "\"1e-4 Gg\"",
        "\"2e-8 Ms\"",
    );
    let plain = text("1e13", "10", ["20", "50"], ["6e6", "4e6", "1e7"], "1e14", "2e7");
    let case = |name: &str, text: String, force: f64, length: f64, time: f64| {
        Case::new(format!("the thesis' reference {name}"), "printed digits", text, move |trial| {
            trial.measure_known("padding.peak-force", 38_359.411_601 * force, 5e-7 * force);
            trial.measure_known(
                "padding.peak-deformation",
                17.538_566_287e-3 * length,
                5e-13 * length,
            );
            trial.measure_known("padding.contact-time", 7.425_568_132e-3 * time, 5e-13 * time);
        })
    };
    [
        case("in nm, ng and ns", nano, 1.0, 1.0, 1.0),
        case("in km, Gg and Ms", mega, 1.0, 1.0, 1.0),
        case("with the numbers of nm, ng and ns", plain, 1e3, 1e9, 1e9),
    ]
}

fn steps_and_pulses() -> Case {
    let loads = "[loads]\n\
        step = { on = \"head\", force = { constant = { value = 50.0, start = 0.314159 } } }\n\
        pulse = { on = \"head\", force = { half-sine = { peak = 300.0, duration = 0.0123, start = 0.777 } } }";
    let text = Text::head(1.0, 0.0).pad("spring = 100").with(loads).lasting(1.5);
    Case::new("a step and a pulse at odd times", "closed form", text, |trial| {
        let step: f64 = 10.0 * (1.5 - 0.314_159);
        // Convolution of the half-sine with sin(ωt)/ω, after its end.
        let (omega, pulse, end) = (10.0, PI / 0.0123, 1.5 - 0.777);
        let gain = 300.0 * pulse / (pulse * pulse - omega * omega) / omega;
        let sines = (omega * end).sin() + (omega * (end - 0.0123)).sin();
        let cosines = (omega * end).cos() + (omega * (end - 0.0123)).cos();
        let way = 0.5 * (1.0 - step.cos()) + gain * sines;
        trial.ends("head", way, 5.0 * step.sin() + gain * omega * cosines);
    })
}

fn needle() -> Case {
    let peak = 1e9 * PI / 2.0;
    let loads = format!(
        "[loads]\npulse = {{ on = \"head\", force = {{ half-sine = {{ peak = {peak:?}, duration = 1e-9, start = 0.5 }} }} }}"
    );
    let text = Text::head(1.0, 0.0).pad(&kelvin(100.0, 0.0)).with(&loads).lasting(1.0);
    Case::new("a pulse of 10⁻⁹ s within a second", "limit", text, |trial| {
        let (sine, cosine) = 5.0_f64.sin_cos();
        trial.measure_known("head.end-position", 0.1 * sine, 2e-9);
        trial.measure_known("head.end-velocity", cosine, 2e-8);
        trial.measure_known("head.peak-displacement", 0.1, 2e-9);
    })
}

fn inconsistent_starts() -> [Case; 2] {
    let text = |model: &str| {
        Text::default()
            .node("plate", "motion = { constant = 1e-3 }")
            .element("pad", ["plate", "ground"], model)
            .measure("pad", FORCES)
            .lasting(1.0)
    };
    let springs = text("series = [{ spring = 1 }, { spring = 3 }]");
    let slow = text("series = [{ spring = 1 }, { kelvin-voigt = { spring = 1, dashpot = 1 } }]");
    [
        Case::new("massless node that jumps with a step", "closed form", springs, |trial| {
            trial.measure("pad.peak-force", 7.5e-4);
            trial.output("pad.force", 0.0, 7.5e-4);
            trial.measure("pad.impulse", 7.5e-4);
        }),
        Case::new("massless node that creeps after a step", "closed form", slow, |trial| {
            trial.measure("pad.peak-force", 1e-3);
            let force = |t: f64| 1e-3 + 5e-4 * (-2.0 * t).exp_m1();
            trial.output("pad.force", 0.5, force(0.5));
            trial.last("pad.force", force(1.0));
        }),
    ]
}

/// Two pads that part, under weight, so that switching is in it.
fn busy(samples: &str) -> String {
    Text::head(1.0, 2.0)
        .pad(&kelvin(1e4, 10.0))
        .with("[effects]\ngravity = { value = 9.80665 }\nseparation.pad = { at = \"head\" }\n")
        .lasting(0.5)
        + samples
}

/// All that a report says in numbers, bit by bit.
fn bits(report: &RunReport) -> Vec<u64> {
    let mut all = Vec::new();
    for measure in &report.measures {
        all.extend(
            [measure.value, measure.time, measure.error].map(|own| own.map_or(1, f64::to_bits)),
        );
    }
    let outputs = 0..report.assembly.system.outputs.len();
    for output in outputs {
        let signal = report.trajectory.signal(&report.assembly.system, output);
        for panel in &signal.panels {
            all.extend(panel.coefficients.iter().map(|coefficient| coefficient.to_bits()));
        }
    }
    all
}

fn solved(text: &str, method: &str) -> Vec<u64> {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    bits(&scene.network.solve_with(&scene.settings(method).unwrap()).unwrap())
}

fn samples() -> Case {
    Case::new("1 output sample, and 10⁶", "the same to the bit", busy("samples = 1\n"), |trial| {
        let many = solved(&busy("samples = 1000000\n"), trial.report.solver.method);
        trial.holds("the same to the bit", many == bits(trial.report));
    })
}

fn again() -> Case {
    Case::new("again, alone and by four threads", "the same to the bit", busy(""), |trial| {
        let method = trial.report.solver.method;
        let first = bits(trial.report);
        trial.holds("the same again", solved(&busy(""), method) == first);
        let threads: Vec<_> =
            (0..4).map(|_| thread::spawn(move || solved(&busy(""), method))).collect();
        for thread in threads {
            trial.holds("the same in a thread", thread.join().unwrap() == first);
        }
    })
}
