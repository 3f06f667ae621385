//! Laws with corners against closed forms: static friction, piecewise linear springs, preload.

use dashpot::{
    analysis::RunReport,
    scene::{ReadOptions, read},
};

use super::trial::{ALL, run};

/// When a part enters a phase, in order.
fn entered(report: &RunReport, part: &str, phase: &str) -> Vec<f64> {
    let of = |own: &&dashpot::dae::Switch| own.name == part && own.what == phase;
    report.trajectory.switches.iter().filter(of).map(|own| own.time).collect()
}

fn near(method: &str, what: &str, found: f64, exact: f64) {
    let allowed = if method == "exact" { 1e-11 } else { 1e-4 };
    assert!((found / exact - 1.0).abs() < allowed, "{method}, {what}: {found} for {exact}");
}

/// A block of mass m on a spring whose end is drawn at the speed V. Once it slips, the spring's force is
/// `F_c + k A cos ωt + (k V/ω) sin ωt` with `k A = F_s − F_c`, and it sticks again as `ωt = 2π − 2 atan(Aω/V)`,
/// with `2 F_c − F_s`.
#[test]
fn a_block_drawn_by_a_spring_sticks_and_slips() {
    let (mass, stiffness, speed, kinetic, held) = (2.0_f64, 800.0_f64, 0.1, 20.0, 30.0);
    let text = format!(
        "[nodes]\nblock = {{ mass = {mass} }}\n\
         hand = {{ motion = {{ table = [[0, 0], [2, {}]] }} }}\n[elements]\n\
         spring = {{ between = [\"hand\", \"block\"], spring = {stiffness} }}\n\
         grip = {{ between = [\"block\", \"ground\"], friction = {{ friction = {kinetic}, static-to-kinetic = 1.5 }} }}\n\
         [run]\nduration = 2\n",
        2.0 * speed
    );
    let omega = (stiffness / mass).sqrt();
    let first = held / (stiffness * speed);
    let amplitude = (held - kinetic) / stiffness;
    let slips = (std::f64::consts::TAU - 2.0 * (amplitude * omega / speed).atan()) / omega;
    let period = slips + 2.0 * (held - kinetic) / (stiffness * speed);
    for method in ALL {
        let report = run(&text, method);
        let slip = entered(&report, "grip.friction", "sliding forward");
        let stick = entered(&report, "grip.friction", "stuck");
        assert_eq!([slip.len(), stick.len()], [4, 4], "{method}");
        for (at, (slip, stick)) in slip.iter().zip(&stick).enumerate() {
            let exact = first + f64::from(u32::try_from(at).unwrap()) * period;
            near(method, "slip", *slip, exact);
            near(method, "stick", *stick, exact + slips);
        }
        assert!(report.energy.closure().abs() < 1e-3, "{method}");
    }
}

/// Two halves of sines: `y = (v/ω₁) sin ω₁t` up to the corner, and from there about the place at which the
/// second line would have no force.
#[test]
fn a_mass_is_stopped_by_two_straight_lines() {
    let (mass, speed, corner, force, stiffness) = (5.0_f64, 3.0_f64, 0.01, 2e3, 1e6);
    let text = format!(
        "[nodes]\nhead = {{ mass = {mass}, velocity = {speed} }}\n[elements]\n\
         pad = {{ between = [\"head\", \"ground\"], piecewise-spring = \
         [[0, 0], [{corner}, {force}], [{}, {}]] }}\n[run]\nduration = 0.03\n",
        corner + 0.01,
        force + 0.01 * stiffness
    );
    let first = (force / corner / mass).sqrt();
    let at_corner = (corner * first / speed).asin() / first;
    let left = (speed * speed - (corner * first).powi(2)).sqrt();
    let second = (stiffness / mass).sqrt();
    let free = force / stiffness;
    let turned = at_corner + (left / second).atan2(free) / second;
    let deepest = corner - free + free.hypot(left / second);
    for method in ALL {
        let report = run(&text, method);
        let part = "pad.piecewise-spring";
        near(method, "corner", entered(&report, part, "line 2")[0], at_corner);
        near(method, "back", entered(&report, part, "line 1")[0], 2.0 * turned - at_corner);
        let solution = report.solution();
        let way = solution.signal(report.assembly.output("pad.deformation").unwrap());
        near(method, "deepest", way.maximum((0.0, 0.03)).value, deepest);
        let push = solution.signal(report.assembly.output("pad.force").unwrap());
        near(
            method,
            "force",
            push.maximum((0.0, 0.03)).value,
            force + stiffness * (deepest - corner),
        );
        assert!(report.energy.closure().abs() < 1e-3, "{method}");
        assert!(report.energy.dissipated.iter().all(|own| own.1.abs() < 1e-3), "{method}");
    }
}

/// A valve: the spring holds the disc on its seat until the load exceeds the preload; from then on
/// `x = (r/k) (t − sin(ωt)/ω)`.
#[test]
fn a_preloaded_spring_gives_way_beyond_its_preload() {
    let (mass, stiffness, preload, rate) = (0.5_f64, 2e4_f64, 200.0, 1e4);
    let text = format!(
        "[nodes]\ndisc = {{ mass = {mass} }}\n[elements]\n\
         spring = {{ between = [\"disc\", \"ground\"], preloaded-spring = \
         {{ stiffness = {stiffness}, preload = {preload} }} }}\n\
         seat = {{ between = [\"ground\", \"disc\"], contact = {{}} }}\n\
         [loads]\nflow = {{ on = \"disc\", force = {{ table = [[0, 0], [0.1, {}]] }} }}\n\
         [run]\nduration = 0.05\n",
        0.1 * rate
    );
    let (opens, omega) = (preload / rate, (stiffness / mass).sqrt());
    for method in ALL {
        let report = run(&text, method);
        near(method, "opens", entered(&report, "seat.contact", "open")[0], opens);
        let solution = report.solution();
        let place = solution.signal(report.assembly.output("disc.position").unwrap());
        assert!(place.absolute_maximum((0.0, opens)).value < 1e-12, "{method}");
        let after = 0.05 - opens;
        near(
            method,
            "place",
            place.value(0.05),
            rate / stiffness * (after - (omega * after).sin() / omega),
        );
        let push = solution.signal(report.assembly.output("spring.force").unwrap());
        near(method, "preload", push.value(0.5 * opens), preload);
        assert!(report.energy.closure().abs() < 1e-3, "{method}");
    }
}

#[test]
fn weights_at_rest_find_their_line_and_their_preload() {
    let text = |law: &str| {
        format!(
            "[nodes]\nbox = {{ mass = 10 }}\n[elements]\n\
             pad = {{ between = [\"box\", \"ground\"], {law} }}\n\
             [effects]\ngravity = true\n[run]\nduration = 0.1\n"
        )
    };
    let weight = 98.0665;
    for (law, place) in [
        ("piecewise-spring = [[0, 0], [0.01, 50], [0.02, 150]]", 0.01 + (weight - 50.0) / 1e4),
        ("preloaded-spring = { stiffness = 1e3, preload = 40 }", (weight - 40.0) / 1e3),
        // In a row with another one.
        (
            "series = [{ piecewise-spring = [[0, 10], [0.01, 50], [0.02, 150]] }, { spring = 1e3 }]",
            0.01 + (weight - 50.0) / 1e4 + weight / 1e3,
        ),
    ] {
        for method in ["exact", "bdf"] {
            let report = run(&text(law), method);
            let solution = report.solution();
            let found = solution.signal(report.assembly.output("box.position").unwrap());
            for time in [0.0, 0.1] {
                assert!((found.value(time) / place - 1.0).abs() < 1e-9, "{law} {method} {time}");
            }
        }
    }
}

#[test]
fn static_friction_is_refused_where_a_force_would_drop_at_once() {
    let refused = |elements: &str| {
        let text = format!(
            "[nodes]\nhead = {{ mass = 2, velocity = 3 }}\n[elements]\n{elements}\n[run]\nduration = 0.1\n"
        );
        match read(&text, &ReadOptions::default()) {
            Ok(_) => None,
            Err(faults) => Some(faults.to_string()),
        }
    };
    let slider = "friction = { friction = 20, static-to-kinetic = 1.2 }";
    let on = |model: &str| format!("pad = {{ between = [\"head\", \"ground\"], {model} }}");
    let light = refused(&on(&format!("series = [{{ spring = 1e4 }}, {{ {slider} }}]"))).unwrap();
    assert!(light.contains("neither a mass nor a dashpot"), "{light}");
    let damped = format!(
        "series = [{{ spring = 1e4 }}, {{ parallel = [{{ {slider} }}, {{ dashpot = 5 }}] }}]"
    );
    assert_eq!(refused(&on(&damped)), None);
    let beside = refused(&on(&format!("parallel = [{{ {slider} }}, {{ friction = 5 }}]"))).unwrap();
    assert!(beside.contains("that of the sliders beside it"), "{beside}");
}
