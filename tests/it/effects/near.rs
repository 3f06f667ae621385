//! Switchings that nearly coincide, and many contacts at once.

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

const METHODS: [&str; 4] = ["exact", "bdf", "tr-bdf2", "esdirk34"];

fn run(text: &str, method: &str) -> RunReport {
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    scene
        .network
        .solve_with(&scene.settings(method).unwrap())
        .unwrap_or_else(|error| panic!("{method}: {error}"))
}

/// Holds every measure of the stepping methods against those of `exact`, within the errors of both.
fn all_agree(text: &str) -> RunReport {
    let exact = run(text, "exact");
    for method in &METHODS[1..] {
        let found = run(text, method);
        for truth in &exact.measures {
            let measure = found.measure(&truth.key).unwrap();
            let (Some(value), Some(expected)) = (measure.value, truth.value) else {
                assert_eq!(measure.value, truth.value, "{method}: {}", truth.key);
                continue;
            };
            let errors = measure.error.unwrap() + truth.error.unwrap();
            let off = (value - expected).abs();
            assert!(off <= errors, "{method}: {} off by {off:e} of {errors:e}", truth.key);
        }
    }
    exact
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).unwrap().value.unwrap()
}

#[test]
fn impacts_less_than_a_microsecond_apart_are_two() {
    let exact = all_agree(
        r#"
        [nodes]
        head = { mass = "5 kg", velocity = "4 m/s" }
        plate = { mass = "1 kg" }
        [elements]
        p1 = { between = ["head", "plate"], kelvin-voigt = { spring = "100 kN/m", dashpot = "100 N s/m" } }
        p2 = { between = ["plate", "ground"], zener = { spring = "50 kN/m", maxwell = { spring = "50 kN/m", dashpot = "200 N s/m" } } }
        [effects]
        face.p1 = { mass = "0 kg", at = "head" }
        separation.p1 = { at = "head" }
        face.p2 = { mass = "0.3 kg", at = "ground" }
        separation.p2 = { at = "ground" }
        stop.p1 = { at = "5 mm" }
        stop.p2 = { at = "15 mm" }
        [run]
        duration = "0.2 s"
        "#,
    );
    let mut times: Vec<f64> = exact.events.iter().map(|event| event.time).collect();
    times.dedup();
    let nearest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    assert!(nearest < 1e-6, "{nearest:e}");
}

#[test]
fn a_stop_lets_go_however_stiff_it_is() {
    for stiffness in [1e9, 1e11, 1e13] {
        let exact = all_agree(&format!(
            r#"
            [nodes]
            head = {{ mass = "5 kg", velocity = "5 m/s" }}
            [elements]
            pad = {{ between = ["head", "ground"], kelvin-voigt = {{ spring = "20 kN/m", dashpot = "50 N s/m" }} }}
            [effects]
            separation.pad = {{ at = "head" }}
            stop.pad = {{ at = "20 mm", stiffness = {stiffness}, damping = 0 }}
            [run]
            duration = "40 ms"
            "#
        ));
        // Half a period of the mass on the stop, of which the pad and its share of the way are a part.
        let half = std::f64::consts::PI * f64::sqrt(5.0 / stiffness);
        let off = value(&exact, "pad.stop.contact-time") / half - 1.0;
        assert!(off.abs() < 10.0 * f64::sqrt(20e3 / stiffness), "{stiffness:e}: {off:e}");
    }
}

#[test]
fn a_slider_keeps_its_force_while_what_moves_it_pauses() {
    let exact = all_agree(
        r#"
        [nodes]
        p = { motion = { trapezoid = { peak = "5 mm", rise = "50 ms", hold = "100 ms", fall = "50 ms" } } }
        [elements]
        f = { between = ["p", "ground"], friction = "50 N" }
        [measures]
        f = [{ kind = "energy", window = "run" }]
        [run]
        duration = "0.4 s"
        "#,
    );
    let energy = value(&exact, "f.energy");
    assert!((energy - 2.0 * 50.0 * 5e-3).abs() < 1e-12, "{energy}");
}

#[test]
fn ten_balls_in_a_row_pass_the_blow_on() {
    let balls: Vec<String> = (1..10).map(|ball| format!("b{ball} = {{ mass = 1 }}\n")).collect();
    let contacts: Vec<String> = (0..9)
        .map(|ball| {
            let ends = format!("[\"b{ball}\", \"b{}\"]", ball + 1);
            format!(
                "c{ball} = {{ between = {ends}, contact = {{ gap = 0.01, restitution = 0.9 }} }}\n"
            )
        })
        .collect();
    let text = format!(
        "[nodes]\nb0 = {{ mass = 1, velocity = 1 }}\n{}[elements]\n{}[measures]\nb9 = [{{ kind = \
         \"end-velocity\", window = \"run\" }}]\n[run]\nduration = 0.3\n",
        balls.concat(),
        contacts.concat()
    );
    let expected = f64::powi(1.9 / 2.0, 9);
    for method in METHODS {
        let found = run(&text, method);
        let velocity = found.measure("b9.end-velocity").unwrap();
        let off = (velocity.value.unwrap() - expected).abs();
        assert!(off <= velocity.error.unwrap().max(1e-14), "{method}: off by {off:e}");
    }
}

#[test]
fn auto_turns_to_a_method_that_gets_through() {
    let text = r#"
        [nodes]
        head = { mass = "5 kg", velocity = "6 m/s" }
        [elements]
        pad = { between = ["head", "ground"], series = [
          { rate-spring = { force = "1 kN", at = "10 mm", gain = 0.2, reference-rate = "10 mm/s", exponent = 1.5 } },
          { spring = "300 kN/m" },
        ] }
        [effects]
        separation.pad = { at = "head" }
        [run]
        duration = "80 ms"
        "#;
    let (found, other) = (run(text, "auto"), run(text, "tr-bdf2"));
    for key in ["pad.peak-force", "pad.impulse"] {
        let (one, another) = (found.measure(key).unwrap(), other.measure(key).unwrap());
        let errors = one.error.unwrap() + another.error.unwrap();
        assert!((one.value.unwrap() - another.value.unwrap()).abs() <= errors, "{key}");
    }
}

#[test]
fn separation_without_which_a_padding_would_pull_is_not_left_out() {
    let text = r#"
        [nodes]
        head = { mass = "5 kg", velocity = "5 m/s" }
        panel = { mass = "0.3 kg" }
        [elements]
        pad = { between = ["head", "panel"], kelvin-voigt = { spring = "200 kN/m", dashpot = "50 N s/m" } }
        mount = { between = ["panel", "ground"], kelvin-voigt = { spring = "20 kN/m", dashpot = "20 N s/m" } }
        [effects]
        separation.pad = { at = "head" }
        [accuracy]
        neglect-below = "5 %"
        [run]
        duration = "12 ms"
        "#;
    let found = run(text, "exact");
    let partial = found.partial.as_ref().unwrap();
    assert!(partial.left_out.iter().all(|own| own.effect != "separation.pad"), "{partial:?}");
    assert!(
        found.warnings.iter().all(|warning| !warning.to_string().contains("separation is off")),
        "{found:?}"
    );
}

#[test]
fn stops_that_share_a_blow_are_warned_of() {
    let text = r#"
        [nodes]
        head = { mass = "5 kg", velocity = "5 m/s" }
        panel = { mass = "4 kg" }
        [elements]
        p1 = { between = ["head", "panel"], spring = "20 kN/m" }
        p2 = { between = ["head", "panel"], spring = "30 kN/m" }
        mount = { between = ["panel", "ground"], spring = "100 kN/m" }
        [effects]
        stop.p1 = { at = "10 mm" }
        stop.p2 = { at = "10 mm" }
        [run]
        duration = "20 ms"
        "#;
    let found = run(text, "exact");
    let is_told = |own: &dashpot::analysis::Warning| {
        own.to_string().contains("`p1.stop`") && own.to_string().contains("`p2.stop`")
    };
    assert!(found.warnings.iter().any(is_told), "{:?}", found.warnings);
}
