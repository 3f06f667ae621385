//! Bouncing on rigid and springy ground, from a fall to rest.

use dashpot::{
    analysis::{RunReport, Solve, SolveSettings},
    scene::{ReadOptions, read},
};

use super::{
    reference::Case,
    trial::{ALL, Side, judge},
};

#[test]
fn a_ball_bounces_on_rigid_ground_until_it_rests_in_finite_time() {
    let case = Case::of("bounce-rigid");
    let text = "
        [nodes]
        ball = { mass = <m>, drop = <h> }
        [elements]
        floor = { between = [\"ball\", \"ground\"], contact = { restitution = <e> } }
        [effects]
        gravity = { value = <g> }
        [run]
        duration = 6
        ";
    judge(case, ALL, text, |trial| {
        for touch in 1..=trial.impacts("floor").len().min(20) {
            let label = format!("touch-{touch}");
            let time = trial.touch("floor", touch, &format!("{label}.time"));
            let speed = trial.case.get(&format!("{label}.velocity-before"));
            trial.value_is("ball.velocity", time, Side::Before, speed);
            if touch < trial.impacts("floor").len() {
                trial.value_is("ball.velocity", time, Side::After, -speed * case.param("e"));
            }
            if touch == 20 {
                trial.loss("floor", time, "touch-20.energy-lost-so-far");
            }
        }
        let rest = trial.switches("floor", Some("closed"));
        assert_eq!(rest.len(), 1, "it rests once");
        trial.rests(rest[0], "rest.time");
        let end = trial.end();
        trial.value_is("ball.position", end, Side::Before, 0.0);
        trial.value_is("ball.velocity", end, Side::Before, 0.0);
        let weight = case.param("m") * case.param("g");
        trial.value_is("floor.force", end, Side::Before, weight);
        trial.loss("floor", end, "rest.energy-lost");
    });
}

#[test]
fn a_ball_bounces_on_a_spring_for_ever() {
    let case = Case::of("bounce-spring");
    let text = "
        [nodes]
        ball = { mass = <m>, drop = <h> }
        [elements]
        pad = { between = [\"ball\", \"ground\"], spring = <K> }
        [effects]
        gravity = { value = <g> }
        separation.pad = { at = \"ball\" }
        [run]
        duration = 3.2
        ";
    judge(case, ALL, text, |trial| {
        let (deepest, force) = (case.get("peak-deformation"), case.get("peak-force"));
        trial.count("pad.contact", "closed", 5);
        for nth in 1..=5 {
            let touch = trial.switch(["pad.contact", "closed"], nth, &format!("touch-{nth}.time"));
            let release =
                trial.switch(["pad.contact", "open"], nth, &format!("release-{nth}.time"));
            let speed = case.get("touch.velocity");
            trial.value_is("ball.velocity", touch, Side::Before, speed);
            trial.value_is("ball.velocity", release, Side::Before, -speed);
            let peak = |output: &str| trial.signal(output).maximum((touch, release)).value;
            trial.number("deformation", peak("pad.deformation"), deepest, deepest);
            trial.number("force", peak("pad.force"), force, force);
        }
        trial.number("loss", trial.dissipated("pad", trial.end()), 0.0, case.get("energy"));
    });
}

#[test]
fn what_bounces_to_rest_under_friction_has_a_known_error_by_the_exact_method() {
    let text = "[nodes]
        striker = { mass = \"3.4 kg\", velocity = 2.3 }
        panel = { mass = \"1.2 kg\" }
        [elements]
        pad = { between = [\"striker\", \"panel\"], spring = \"87 kN/m\" }
        stop = { between = [\"panel\", \"ground\"], contact = { gap = \"3.9 mm\", restitution = 0.6 } }
        slide = { between = [\"panel\", \"ground\"], friction = \"66 N\" }
        mount = { between = [\"panel\", \"ground\"], kelvin-voigt = { spring = \"3.6 kN/m\", dashpot = \"151 N s/m\" } }
        [effects]
        separation.pad = { at = \"striker\" }
        [run]
        duration = \"89 ms\"
        ";
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    let run = |method: &str, rtol: Option<f64>| -> RunReport {
        let settings = SolveSettings { rtol, ..scene.settings(method).unwrap() };
        scene.network.solve_with(&settings).unwrap()
    };
    let (exact, stepping) = (run("exact", None), run("bdf", Some(1e-11)));
    let impacts = exact.trajectory.switches.iter().filter(|switch| switch.impulse > 0.0).count();
    assert!(impacts >= 10, "{impacts}");
    for measure in &exact.measures {
        let other = stepping.measure(&measure.key).unwrap();
        let errors = measure.error.unwrap() + other.error.unwrap();
        let gap = (measure.value.unwrap() - other.value.unwrap()).abs();
        assert!(gap <= errors, "{}: {gap:e} of {errors:e}", measure.key);
        assert!(measure.error.unwrap() <= 1e-4 * measure.size.max(1.0), "{}", measure.key);
    }
}

#[test]
fn a_bounce_loses_its_share_of_the_energy_whatever_the_mass() {
    let (velocity, restitution) = (2.0_f64, 0.7_f64);
    for mass in [1e-300, 1e-200, 1e-160, 1e-30, 1.0, 1e30, 1e160] {
        let text = format!(
            "[nodes]
            ball = {{ mass = \"{mass:e} kg\", velocity = {velocity} }}
            [elements]
            floor = {{ between = [\"ball\", \"ground\"], contact = {{ restitution = {restitution} }} }}
            [measures]
            floor = [\"energy\"]
            [run]
            duration = 0.2"
        );
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        let report = scene.network.solve_with(&scene.settings("exact").unwrap()).unwrap();
        let energy = report.measure("floor.energy").unwrap();
        let lost = 0.5 * mass * velocity * velocity * (1.0 - restitution * restitution);
        let gap = (energy.value.unwrap() - lost).abs();
        assert!(gap <= energy.error.unwrap() && gap <= 1e-12 * lost, "{mass:e}: {energy:?}");
    }
}
