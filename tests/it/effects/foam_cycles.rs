//! Elements that never pull: foam with a memory over many cycles, and separation where there is
//! nothing to separate.
//!
//! The foam is judged by its law, evaluated along the motion with its memory: `f(y)` while it is
//! pressed deeper than ever before, `f(y) s^q` below the greatest depth `y_m`, zero below `r y_m`.

use dashpot::analysis::{MeasureReport, RunReport};

use super::trial::{STEPPING, run};

/// Modulus [Pa].
const E: f64 = 2e7;
/// Stress of the plateau [Pa].
const PLATEAU: f64 = 7e5;
/// Stress that densification adds at half the thickness [Pa], and its exponent.
const B: f64 = 2e5;
const N: f64 = 2.0;
/// Thickness [m] and area [m²].
const H: f64 = 0.03;
const A: f64 = 4e-3;
/// Set, and exponent of unloading.
const SET: f64 = 0.4;
const Q: f64 = 2.0;

fn foam() -> String {
    format!(
        "hysteretic-foam = {{ modulus = {E:?}, plateau = {PLATEAU:?}, densification = {B:?}, \
         exponent = {N:?}, thickness = {H:?}, area = {A:?}, set = {SET:?}, \
         unloading-exponent = {Q:?} }}"
    )
}

/// The force of the first loading.
fn virgin(y: f64) -> f64 {
    let strain = y / H;
    A * (PLATEAU * (1.0 - (-E * strain / PLATEAU).exp()) + B * (strain / (1.0 - strain)).powf(N))
}

/// The force at `y`, where it has been pressed to `deepest`.
fn force(y: f64, deepest: f64) -> f64 {
    let kept = SET * deepest;
    if y >= deepest && y > 0.0 {
        virgin(y)
    } else if y > kept {
        virgin(y) * ((y - kept) / (deepest - kept)).powf(Q)
    } else {
        0.0
    }
}

/// `∫ own dy` by Simpson's rule on so many panels that only rounding is left.
fn integral(own: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let count = 20_000;
    let step = (to - from) / f64::from(count);
    let weight = |at: i32| if at == 0 || at == count { 1.0 } else { 2.0 + 2.0 * f64::from(at % 2) };
    (0..=count).map(|at| weight(at) * own(from + step * f64::from(at))).sum::<f64>() * step / 3.0
}

/// What a press to `deepest` puts in, less what it gives back.
fn lost(deepest: f64) -> f64 {
    integral(virgin, 0.0, deepest) - given_back(deepest)
}

fn given_back(deepest: f64) -> f64 {
    integral(|y| force(y, deepest), SET * deepest, deepest)
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).and_then(|own| own.value).unwrap_or_else(|| panic!("no {key}"))
}

/// Errors of a stepping method: 1000 of its tolerance, ten times that of a method of second order.
fn allowed(report: &RunReport) -> f64 {
    let errors = if report.solver.method == "tr-bdf2" { 1e4 } else { 1e3 };
    errors * report.solver.rtol.expect("a stepping method")
}

/// Presses foam along these points of time \[ms\] and deformation \[mm\], and holds the force of each
/// method against the law.
fn press(points: &[(f64, f64)], claim: impl Fn(&RunReport)) {
    let table: Vec<String> =
        points.iter().map(|(t, y)| format!("[\"{t} ms\", \"{y} mm\"]")).collect();
    let end = points[points.len() - 1].0;
    let text = format!(
        "[nodes]\nplate = {{ motion = {{ table = [{}] }} }}\n\
         [elements]\npad = {{ between = [\"plate\", \"ground\"], {} }}\n\
         [accuracy]\npad.energy-at-end = 1e-5\n[run]\nduration = \"{end} ms\"\n",
        table.join(", "),
        foam()
    );
    let top = points.iter().fold(0.0_f64, |most, own| most.max(1e-3 * own.1));
    for method in STEPPING {
        let report = run(&text, method);
        let near = allowed(&report);
        let solution = report.solution();
        let output = report.assembly.output("pad.force").expect("a force");
        let signal = solution.signal(output);
        let mut deepest = 0.0_f64;
        for pair in points.windows(2) {
            let [(from, start), (to, stop)] = [pair[0], pair[1]];
            for part in 1..200 {
                let part = f64::from(part) / 200.0;
                let time = 1e-3 * (from + part * (to - from));
                let y = 1e-3 * (start + part * (stop - start));
                let expected = force(y, deepest.max(y));
                let off = (signal.value(time) - expected).abs();
                assert!(off <= near * virgin(top), "{method} at {time}: {off} off {expected}");
                assert!(signal.value(time) >= -near * virgin(top), "{method} at {time} pulls");
            }
            deepest = deepest.max(1e-3 * stop);
        }
        // A slack foam has lost all that it took up.
        let taken = value(&report, "pad.energy-at-end");
        let all = lost(top);
        assert!((taken / all - 1.0).abs() <= near, "{method}: {taken} J, not {all}");
        let closure = report.energy.closure().abs();
        assert!(closure <= near, "{method}: {closure} of the energy is missing");
        claim(&report);
    }
}

fn times(report: &RunReport, what: &str) -> usize {
    report.trajectory.switches.iter().filter(|switch| switch.what == what).count()
}

#[test]
fn foam_that_is_pressed_deeper_goes_on_where_it_left_its_first_curve() {
    let points = [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (35.0, 15.0), (50.0, 0.0), (62.0, 12.0)];
    let points = [&points[..], &[(74.0, 0.0)]].concat();
    press(&points, |report| {
        assert_eq!((times(report, "loading"), times(report, "slack")), (1, 3));
    });
}

#[test]
fn foam_remembers_through_partial_cycles_and_equal_depths() {
    // Turned before it is slack, pressed to just the depth of before, and to next to it.
    let partial = [
        (0.0, -2.0),
        (10.0, 8.0),
        (15.0, 6.0),
        (20.0, 7.5),
        (25.0, 5.0),
        (35.0, 12.0),
        (45.0, 0.0),
    ];
    press(&partial, |_| {});
    let equal = [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (30.0, 10.0), (40.0, 5.0), (50.0, 10.0)];
    press(&[&equal[..], &[(60.0, 0.0), (70.0, 10.000_000_01), (80.0, -1.0)]].concat(), |_| {});
    let rests = [(0.0, 0.0), (10.0, 10.0), (15.0, 10.0), (25.0, 4.0), (30.0, 4.0), (40.0, 11.0)];
    press(&[&rests[..], &[(45.0, 11.0), (60.0, 0.0)]].concat(), |_| {});
}

#[test]
fn a_mass_bounces_on_foam_that_keeps_a_set() {
    const G: f64 = 9.81;
    let (mass, speed) = (2.0, 5.0);
    let text = format!(
        "[nodes]\nbox = {{ mass = {mass:?}, velocity = {speed:?} }}\n\
         [elements]\npad = {{ between = [\"box\", \"ground\"], {} }}\n\
         [effects]\ngravity = {{ value = {G:?} }}\n\
         [accuracy]\npad.energy-at-end = 1e-5\n[run]\nduration = \"1.5 s\"\n",
        foam()
    );
    // The first press ends where the foam has taken all energy; each one after it gives back what
    // it took, and ends there again.
    let energy = 0.5 * mass * speed * speed;
    let (mut low, mut high) = (0.0, 0.9 * H);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        let is_left = integral(virgin, 0.0, middle) < energy + mass * G * middle;
        if is_left { low = middle } else { high = middle }
    }
    let deepest = low;
    let left = given_back(deepest) - mass * G * deepest * (1.0 - SET);
    let rebound = (2.0 * left / mass).sqrt();
    for method in STEPPING {
        let report = run(&text, method);
        let near = allowed(&report);
        let solution = report.solution();
        let signal = |output| solution.signal(report.assembly.output(output).expect(output));
        let slack = report.trajectory.switches.iter().filter(|switch| switch.what == "slack");
        let slack: Vec<f64> = slack.map(|slack| slack.time).collect();
        assert!(slack.len() >= 3, "{method}: {slack:?}");
        let mut from = 0.0;
        for &time in &slack {
            let peak = signal("pad.deformation").maximum((from, time)).value;
            assert!((peak / deepest - 1.0).abs() <= near, "{method}: {peak} m, not {deepest}");
            let leaves = -signal("box.velocity").left_value(time);
            assert!((leaves / rebound - 1.0).abs() <= near, "{method}: {leaves}, not {rebound}");
            from = time + 1e-3;
        }
        let taken = value(&report, "pad.energy-at-end");
        let all = lost(deepest);
        assert!((taken / all - 1.0).abs() <= near, "{method}: {taken} J, not {all}");
        assert!(
            report.warnings.iter().all(|warning| !warning.code().contains("pulls")
                && !warning.to_string().contains("pulls")),
            "{:?}",
            report.warnings
        );
    }
}

/// A head on a pad, with effects.
fn impact(pad: &str, effects: &str, duration: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 5, velocity = 2 }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], {pad} }}\n\
         [effects]\n{effects}\n[run]\nduration = \"{duration}\"\n"
    )
}

const HUNT_CROSSLEY: &str = "hunt-crossley = { force = 1000, at = \"1 mm\", dissipation = 0.2 }";
const KELVIN_VOIGT: &str = "kelvin-voigt = { spring = 1e5, dashpot = 200 }";

#[test]
fn separation_adds_nothing_to_what_never_pulls() {
    let bumper =
        "bumper = { force = 1000, at = \"1 mm\", restitution = 0.5, speed = \"2 m/s\" }".to_owned();
    let pads = [
        foam(),
        HUNT_CROSSLEY.to_owned(),
        bumper,
        format!("series = [{{ {} }}, {{ {KELVIN_VOIGT} }}]", foam()),
        format!("series = [{{ spring = 1e5 }}, {{ {HUNT_CROSSLEY} }}]"),
        format!("parallel = [{{ {} }}, {{ {HUNT_CROSSLEY} }}]", foam()),
    ];
    for pad in &pads {
        for method in ["bdf", "esdirk34"] {
            let off = run(&impact(pad, "", "60 ms"), method);
            let on = run(&impact(pad, "separation.pad = {}", "60 ms"), method);
            assert!(on.warnings.is_empty(), "{pad}: {:?}", on.warnings);
            assert!(off.warnings.is_empty(), "{pad}: {:?}", off.warnings);
            let [own, other] = [&on, &off].map(|report| &report.assembly.system.outputs);
            assert_eq!(own.len(), other.len(), "{pad}");
            let (own, other) = (on.solution(), off.solution());
            for at in 0..on.assembly.system.outputs.len() {
                assert_eq!(own.signal(at), other.signal(at), "{pad}");
            }
            assert!(on.contacts.iter().all(|contact| contact.impact.has_ended()), "{pad}");
        }
    }
}

#[test]
fn a_face_with_mass_parts_from_its_node_before_what_never_pulls() {
    for pad in [foam(), HUNT_CROSSLEY.to_owned()] {
        let effects = "separation.pad = {}\nface.pad = { mass = 0.5 }";
        let report = run(&impact(&pad, effects, "60 ms"), "bdf");
        let contact = report.assembly.output("pad.contact.force").expect("a contact");
        let least = report.solution().signal(contact).minimum((0.0, report.trajectory.t_end));
        assert!(least.value >= -1e-3, "{least:?}");
        assert!(
            report.warnings.iter().all(|warning| !warning.code().contains("pulls")
                && !warning.to_string().contains("pulls")),
            "{:?}",
            report.warnings
        );
    }
}

/// A mass on a series of two foams without dissipation: `½ m v² = W₁(y₁) + W₂(y₂)` at rest, where
/// both carry one force.
#[test]
fn two_foams_over_a_massless_node_share_the_deformation() {
    let plain = |thickness: f64| {
        format!(
            "foam = {{ modulus = {E:?}, plateau = {PLATEAU:?}, densification = {B:?}, \
             exponent = {N:?}, thickness = {thickness:?}, area = {A:?} }}"
        )
    };
    // Half the thickness takes half the deformation: the series is a foam of one and a half of it.
    let pads = [format!("series = [{{ {} }}, {{ {} }}]", plain(H), plain(0.5 * H)), plain(1.5 * H)];
    for method in STEPPING {
        let [series, whole] =
            pads.each_ref().map(|pad| run(&impact(pad, "separation.pad = {}", "30 ms"), method));
        let near = allowed(&series) + allowed(&whole);
        for key in ["pad.peak-force", "pad.peak-deformation", "pad.impulse"] {
            let (found, expected) = (value(&series, key), value(&whole, key));
            assert!((found / expected - 1.0).abs() <= near, "{method}: {key} {found} {expected}");
        }
        let peak = value(&series, "pad.peak-deformation");
        let stored = integral(|y| virgin(y / 1.5), 0.0, peak);
        assert!((stored / 10.0 - 1.0).abs() <= 10.0 * near, "{method}: {stored} J");
    }
}

#[test]
fn a_rate_spring_is_let_go_of_without_small_steps() {
    let pad = "rate-spring = { force = 1000, at = \"1 mm\", gain = 0.1, \
               reference-rate = \"0.01 m/s\" }";
    for method in STEPPING {
        let report = run(&impact(pad, "separation.pad = {}", "60 ms"), method);
        let steps = report.trajectory.statistics.accepted;
        assert!(steps < 600, "{method}: {steps} steps");
        assert!(report.measures.iter().all(|measure| measure.error.is_some()), "{method}");
        assert!(report.warnings.is_empty(), "{method}: {:?}", report.warnings);
    }
}

#[test]
fn a_stop_that_is_met_at_the_peak_within_rounding_does_not_pull() {
    let peak = 2.0 * (5.0_f64 / 1e6).sqrt();
    for part in [1.0 - 1e-9, 1.0 - 1e-12, 1.0 - 1e-15, 1.0, 1.0 + 1e-12] {
        for own in ["", "stiffness = 1e8, ", "stiffness = 1e8, damping = 1e3, "] {
            let stop =
                format!("separation.pad = {{}}\nstop.pad = {{ {own}at = {:?} }}", peak * part);
            for method in ["exact", "bdf", "esdirk34"] {
                let report = run(&impact("spring = 1e6", &stop, "20 ms"), method);
                let warnings = &report.warnings;
                assert!(
                    warnings.iter().all(|warning| !warning.code().contains("pulls")
                        && !warning.to_string().contains("pulls")),
                    "{warnings:?}"
                );
                let notes = report.measures.iter().filter_map(MeasureReport::note);
                let notes: Vec<String> = notes.filter(|note| note.contains("pulls")).collect();
                assert!(notes.is_empty(), "{method} {own} {part:e}: {notes:?}");
            }
        }
    }
}
