//! Masses that begin displaced: what they then do is known in closed form, by every method.

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

const METHODS: [&str; 5] = ["exact", "bdf", "esdirk34", "tr-bdf2", "auto"];

fn scene(mass: &str, element: &str, more: &str, duration: f64) -> String {
    format!(
        "[nodes]\nm = {{ mass = 4, {mass} }}\n[elements]\n\
         pad = {{ between = [\"m\", \"ground\"], {element} }}\n{more}\n\
         [measures]\nm = [{{ kind = \"end-position\", window = \"run\" }}]\n\
         pad = [{{ kind = \"peak-force\", window = \"run\" }}]\n[run]\nduration = {duration:?}\n"
    )
}

fn report(text: &str, method: &str) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let scene = scene.value;
    scene.network.solve_with(&scene.settings(method).unwrap()).unwrap()
}

fn value(report: &RunReport, key: &str) -> (f64, f64) {
    let found = report.measure(key).unwrap();
    (found.value.unwrap(), found.error.unwrap())
}

/// Checks where the mass ends \[m\] and the largest force of the pad \[N\], within the errors that are stated.
fn ends_at(text: &str, position: f64, force: f64) {
    for method in METHODS {
        let report = report(text, method);
        for (key, right) in [("m.end-position", position), ("pad.peak-force", force)] {
            let (found, error) = value(&report, key);
            let room = error + 1e-12 * right.abs().max(0.01);
            assert!((found - right).abs() <= room, "{method}: {key} {found} {right} {error:e}");
            // An accuracy is one of the swing, also where that passes zero.
            assert!(error <= 2e-3 * right.abs().max(0.02), "{method}: {key} {error:e}");
        }
        let ledger = &report.energy;
        assert!(ledger.closure().abs() < 1e-3, "{method}: {}", ledger.closure());
    }
}

fn refusal(text: &str) -> String {
    read(text, &ReadOptions::default()).unwrap_err().render(false)
}

/// rad/s of 4 kg on 2500 N/m.
const OMEGA: f64 = 25.0;

#[test]
fn a_mass_on_a_spring_swings_about_zero() {
    for place in [0.02, -0.02] {
        let text = scene(&format!("position = {place:?}"), "spring = 2500", "", 0.3);
        ends_at(&text, place * (OMEGA * 0.3).cos(), 2500.0 * 0.02);
        let report = report(&text, "exact");
        // ½ k x0² is all that there is.
        assert!((report.energy.start - 0.5).abs() < 1e-14, "{}", report.energy.start);
    }
}

#[test]
fn position_and_speed_add_up_to_one_amplitude() {
    let text = scene("position = \"2 cm\", velocity = 0.5", "spring = 2500", "", 0.3);
    let amplitude = 0.02_f64.hypot(0.5 / OMEGA);
    let end = 0.02 * (OMEGA * 0.3).cos() + 0.5 / OMEGA * (OMEGA * 0.3).sin();
    ends_at(&text, end, 2500.0 * amplitude);
    let with_energy = text.replace("velocity = 0.5", "energy = \"0.5 J\"");
    ends_at(&with_energy, end, 2500.0 * amplitude);
}

#[test]
fn a_damped_mass_creeps_home_and_what_is_lost_is_in_the_ledger() {
    // Beside the spring: x = x0 e^(−δt)(cos ωt + δ/ω sin ωt), the force k x + c v is largest at the start.
    let element = "kelvin-voigt = { spring = 2500, dashpot = 40 }";
    let text = scene("position = 0.02", element, "", 0.2);
    let delta = 40.0 / 8.0;
    let omega = (OMEGA * OMEGA - delta * delta).sqrt();
    let (sin, cos) = (omega * 0.2).sin_cos();
    let end = 0.02 * (-delta * 0.2_f64).exp() * (cos + delta / omega * sin);
    ends_at(&text, end, 50.0);
    let ledger = report(&text, "exact").energy;
    assert!((ledger.start - 0.5).abs() < 1e-14);
    let kept: f64 = ledger.kinetic + ledger.total_stored() + ledger.total_dissipated();
    assert!((kept - 0.5).abs() < 1e-12, "{kept}");
}

#[test]
fn a_dashpot_in_a_row_has_not_given_way_yet() {
    // F' = k v − (k/c) F, F(0) = k x0, and m v' = −F: the force is damped about zero, x = x0 less what flows.
    let (k, c, m, x0, t) = (2500.0_f64, 400.0_f64, 4.0_f64, 0.02_f64, 0.2_f64);
    let text = scene("position = 0.02", "maxwell = { spring = 2500, dashpot = 400 }", "", t);
    let delta = 0.5 * k / c;
    let omega = (k / m - delta * delta).sqrt();
    // F = k x0 e^(−δt)(cos ωt − δ/ω sin ωt), from F(0) = k x0 and F'(0) = −(k/c) F(0).
    // v = −∫F/m; x = x0 + ∫v, by F = −(F'' + (k/c) F')/ω0².
    let force = |t: f64| {
        k * x0 * (-delta * t).exp() * ((omega * t).cos() - delta / omega * (omega * t).sin())
    };
    let count = 20_000;
    let h = t / f64::from(count);
    let (mut v, mut x) = (0.0, x0);
    for step in 0..count {
        // Simpson twice: what is left is far below the tolerance.
        let at = f64::from(step) * h;
        let [a, b, d] = [force(at), force(at + 0.5 * h), force(at + h)];
        x += h * v - h * h / m * (a / 6.0 + b / 3.0);
        v -= h / (6.0 * m) * (a + 4.0 * b + d);
    }
    for method in METHODS {
        let report = report(&text, method);
        let (found, error) = value(&report, "m.end-position");
        assert!((found - x).abs() <= error + 1e-10, "{method}: {found} {x} {error:e}");
        let (found, error) = value(&report, "pad.peak-force");
        assert!((found - 50.0).abs() <= error + 1e-9, "{method}: {found} {error:e}");
    }
}

#[test]
fn what_can_part_flies_off_or_begins_across_a_gap() {
    let parted = "[effects]\nseparation.pad = {}";
    // Pressed by 2 cm it is thrown off at x0 ω after a quarter of a period.
    let quarter = std::f64::consts::FRAC_PI_2 / OMEGA;
    let end = -0.02 * OMEGA * (0.2 - quarter);
    ends_at(&scene("position = 0.02", "spring = 2500", parted, 0.2), end, 50.0);
    // A gap of 2 cm, crossed at 1 m/s: it meets the spring after 20 ms.
    let text = scene("position = -0.02, velocity = 1", "spring = 2500", parted, 0.05);
    let end = 1.0 / OMEGA * (OMEGA * 0.03).sin();
    for method in METHODS {
        let (found, error) = value(&report(&text, method), "m.end-position");
        assert!((found - end).abs() <= error + 1e-12, "{method}: {found} {end} {error:e}");
    }
}

#[test]
fn a_law_that_is_not_linear_is_deformed_too() {
    // F = a y³: all of a x0⁴/4 is kinetic where it passes zero.
    let text = scene("position = 0.1", "formula = \"40 kN * (y / 0.1 m)^3\"", "", 0.2);
    for method in ["bdf", "esdirk34", "auto"] {
        let report = report(&text, method);
        let (found, error) = value(&report, "pad.peak-force");
        assert!((found - 40e3).abs() <= error + 1e-6 * 40e3, "{method}: {found}");
        assert!((report.energy.start / 1000.0 - 1.0).abs() < 1e-6, "{}", report.energy.start);
        assert!(report.energy.closure().abs() < 1e-3);
    }
}

#[test]
fn two_masses_of_one_spring_swing_about_their_centre() {
    let text = "[nodes]\na = { mass = 1, position = 0.03 }\nb = { mass = 3 }\n[elements]\n\
        s = { between = [\"a\", \"b\"], spring = 300 }\n[measures]\n\
        a = [{ kind = \"end-position\", window = \"run\" }]\n\
        b = [{ kind = \"end-position\", window = \"run\" }]\n[run]\nduration = 0.3\n";
    // The reduced mass is ¾ kg: 20 rad/s; the centre stays at 0.03/4.
    let stretch = 0.03 * (20.0_f64 * 0.3).cos();
    let centre = 0.03 / 4.0;
    for method in METHODS {
        let report = report(text, method);
        for (key, right) in [
            ("a.end-position", centre + 0.75 * stretch),
            ("b.end-position", centre - 0.25 * stretch),
        ] {
            let (found, error) = value(&report, key);
            assert!((found - right).abs() <= error + 1e-12, "{method}: {key} {found} {right}");
        }
    }
}

#[test]
fn what_does_not_follow_is_refused() {
    let row = "series = [{ kelvin-voigt = { spring = 1, dashpot = 1 } }, { dashpot = 1 }]";
    let gravity = "[effects]\ngravity = { start = \"equilibrium\" }";
    for (text, told) in [
        (scene("position = 0.1", row, "", 1.0), "dashpots in a row lead from it elsewhere"),
        (scene("position = 0.1", "spring = 1", gravity, 1.0), "gravity has it begin in balance"),
        (scene("position = 0.1, drop = 1", "spring = 1", "", 1.0), "it is dropped"),
        (scene("position = \"3 kg\"", "spring = 1", "", 1.0), "a length (m) is expected here"),
        (
            scene("position = 0.1", "spring = 1", "", 1.0).replace("mass = 4, ", ""),
            "it has no mass: its place follows from the forces on it",
        ),
        (
            scene("position = 0.1, fixed = true", "spring = 1", "", 1.0),
            "nothing moves it: it is fixed",
        ),
        (scene("position = 0.1", "contact = {}", "", 1.0), "it is beyond a contact there"),
    ] {
        let rendered = refusal(&text);
        assert!(rendered.contains(told), "{told}: {rendered}");
    }
}
