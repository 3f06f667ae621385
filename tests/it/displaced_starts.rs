//! Motions that begin displaced across contacts: begun as springs and masses begin them, by every method
//! alike, or refused as a later jump is.

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

const METHODS: [&str; 5] = ["exact", "bdf", "esdirk34", "tr-bdf2", "auto"];

/// A mass of 1 kg beside a wall.
struct Beside<'t> {
    wall: &'t str,
    /// Further keys of the mass.
    mass: &'t str,
    element: &'t str,
    effects: &'t str,
    duration: f64,
}

const SPRING: &str = "series = [{ contact = { gap = 0.5 } }, { spring = 100 }]";

impl Beside<'_> {
    fn text(&self) -> String {
        let Self { wall, mass, element, effects, duration } = self;
        format!(
            "[nodes]\nm = {{ mass = 1{mass} }}\nwall = {{ motion = {{ {wall} }} }}\n\
             [elements]\npush = {{ between = [\"wall\", \"m\"], {element} }}\n{effects}\n\
             [measures]\nm = [{{ kind = \"end-position\", window = \"run\" }}]\n\
             push = [{{ kind = \"peak-force\", window = \"run\" }}]\n\
             [run]\nduration = {duration:?}\n"
        )
    }

    fn report(&self, method: &str) -> RunReport {
        let scene = read(&self.text(), &ReadOptions::default()).unwrap().value;
        scene.network.solve_with(&scene.settings(method).unwrap()).unwrap()
    }

    /// Checks where the mass ends \[m\] and, where given, the largest force of the element \[N\].
    fn ends_at(&self, position: f64, force: Option<f64>) {
        for method in METHODS {
            let report = self.report(method);
            let wanted = [("m.end-position", Some(position)), ("push.peak-force", force)];
            for (key, exact) in wanted {
                let Some(exact) = exact else { continue };
                let found = report.measure(key).unwrap();
                let (value, error) = (found.value.unwrap(), found.error.unwrap());
                let off = (value - exact).abs();
                let rounding = 1e-13 * exact.abs();
                assert!(off <= error + rounding, "{method}: {key} {value} {exact} {error:e}");
                assert!(error <= 2e-3 * exact.abs(), "{method}: {key} {error:e}");
            }
        }
    }

    fn refusal(&self) -> String {
        read(&self.text(), &ReadOptions::default()).unwrap_err().render(false)
    }
}

const PUSHED: Beside<'static> =
    Beside { wall: "constant = 1", mass: "", element: SPRING, effects: "", duration: 0.5 };

/// Where the mass is at 0.5 s that a spring of 100 N/m begins to push, pressed in by 0.5 m.
fn pushed_off() -> f64 {
    0.5 + 5.0 * (0.5 - std::f64::consts::PI / 20.0)
}

#[test]
fn a_wall_that_begins_within_reach_presses_the_spring() {
    PUSHED.ends_at(pushed_off(), Some(50.0));
    for wall in [
        "table = [[0, 1], [1, 1]]",
        "table = { points = [[-1, 0], [0, 0], [0, 1], [1, 1]] }",
        "ramp = { height = 1, rise = 1, start = -2 }",
    ] {
        Beside { wall, ..PUSHED }.ends_at(pushed_off(), Some(50.0));
    }
    // With separation the same gap of zero is half as far away.
    let effects = "[effects]\nseparation.push = { at = \"wall\" }";
    Beside { wall: "constant = 0.5", element: "spring = 100", effects, ..PUSHED }
        .ends_at(pushed_off(), Some(50.0));
}

#[test]
fn several_contacts_in_a_row_or_side_by_side_share_the_way() {
    let row = "series = [{ contact = { gap = 0.2 } }, { spring = 200 }, { contact = { gap = 0.3 } }, \
               { spring = 200 }]";
    let beside = "parallel = [{ series = [{ contact = { gap = 0.5 } }, { spring = 60 }] }, \
                  { series = [{ contact = { gap = 0.5 } }, { spring = 40 }] }]";
    for element in [row, beside] {
        Beside { element, ..PUSHED }.ends_at(pushed_off(), Some(50.0));
    }
}

#[test]
fn a_wall_that_swings_begins_where_its_phase_says() {
    // x'' = ω² (cos Ωt − g − x) as long as the spring is pressed.
    let (omega, swing, gap, time) = (10.0_f64, 2.0_f64, 0.5, 0.1);
    let share = omega * omega / (omega * omega - swing * swing);
    let place =
        share * ((swing * time).cos() - (omega * time).cos()) - gap * (1.0 - (omega * time).cos());
    let hertz = swing / std::f64::consts::TAU;
    let wall = format!("sine = {{ amplitude = 1, frequency = {hertz:?}, phase = \"90 deg\" }}");
    Beside { wall: &wall, duration: time, ..PUSHED }.ends_at(place, Some(50.0));
}

#[test]
fn a_wall_that_begins_away_is_met_there() {
    let (omega, speed, met) = (10.0, 3.0, 0.5);
    let left = met + std::f64::consts::PI / omega;
    Beside { wall: "constant = -1", mass: ", velocity = -3", duration: 1.2, ..PUSHED }
        .ends_at(-1.5 + speed * (1.2 - left), Some(30.0));
}

#[test]
fn a_jump_that_leaves_the_gap_open_strains_no_dashpot() {
    let element = "series = [{ contact = { gap = 0.5 } }, \
                   { parallel = [{ spring = 100 }, { dashpot = 2 }] }]";
    let beside = Beside { element, wall: "constant = 0.3", ..PUSHED };
    // Met at −0.2 m after 0.2 s, then y'' + 2 y' + 100 y = 0.
    let (time, decay) = (0.1_f64, 1.0_f64);
    let omega = (100.0 - decay * decay).sqrt();
    let pressed = (-decay * time).exp() * (omega * time).sin() / omega;
    Beside { mass: ", velocity = -1", duration: 0.3, ..beside }.ends_at(-0.2 - pressed, None);
    let told = Beside { wall: "constant = 1", ..beside }.refusal();
    assert!(told.contains("the motion of `wall` jumps at 0 s"), "{told}");
    assert!(told.contains("only dashpots lead from it to `m`"), "{told}");
}

#[test]
fn a_jump_is_taken_by_the_springs_beside_dashpots_in_series() {
    let element = "series = [{ contact = { gap = 0.5 } }, { spring = 100 }, { dashpot = 40 }]";
    // F'' + (k/c) F' + k F = 0 from 50 N on, and the mass has the speed ∫F.
    let (time, decay) = (0.1_f64, 1.25_f64);
    let omega = (100.0 - decay * decay).sqrt();
    let (sin, cos) = (omega * time).sin_cos();
    let damped = (-decay * time).exp();
    let force = 50.0 * damped * (cos - decay / omega * sin);
    let rate = -(decay * force) - 50.0 * damped * (decay * cos + omega * sin);
    // x'' = F, so that k x' = −F' − (k/c) F, and the place follows from that of x' by parts.
    let speed = (-rate - 2.5 * force) / 100.0;
    let place = (50.0 - force - 2.5 * speed) / 100.0;
    Beside { element, duration: time, ..PUSHED }.ends_at(place, Some(50.0));
}

#[test]
fn a_stop_that_the_jump_reaches_pushes_from_the_start() {
    let effects = "[effects]\nstop.push = { at = 0.5, stiffness = 80 }";
    let place = 0.6 * (1.0 - 1.0_f64.cos());
    Beside { element: "spring = 20", effects, duration: 0.1, ..PUSHED }.ends_at(place, Some(20.0));
}

#[test]
fn what_cannot_begin_is_refused_as_the_same_jump_later_is() {
    let later = Beside { wall: "table = [[0, 0], [0.1, 0], [0.1, 1], [1, 1]]", ..PUSHED };
    let told = later.refusal();
    assert!(told.contains("jumps at 0.1 s, and it may jump through a contact"), "{told}");
    let wall_on_mass = Beside { element: "contact = { gap = 0.5 }", ..PUSHED };
    let slides = "series = [{ contact = { gap = 0.5 } }, { friction = 10 }, { spring = 100 }]";
    for own in [wall_on_mass, Beside { element: slides, ..PUSHED }] {
        let told = own.refusal();
        assert!(told.contains("jumps at 0 s, and it may jump through a contact"), "{told}");
    }
}
