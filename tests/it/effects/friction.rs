//! Dry friction with true stick: sliders alone, on springs, driven, in series, and on a belt.

use std::f64::consts::TAU;

use dashpot::scene::{ReadOptions, read};

use super::{
    reference::Case,
    trial::{ALL, Side, Trial, judge, run},
};

const STUCK: [&str; 2] = ["slider", "stuck"];
const FORWARD: [&str; 2] = ["slider", "sliding forward"];

/// A body on a spring and a slider, with what else there is.
fn scene(body: &str, slider: &str, others: &str) -> String {
    format!(
        "[nodes]\nbody = {{ mass = <m>{body} }}\n{slider}\n\
         spring = {{ between = [\"body\", \"ground\"], spring = <k> }}\n{others}\n"
    )
}

const GROUND: &str = "[elements]\nslider = { between = [\"body\", \"ground\"], friction = <Fc> }";

/// The belt runs at vb for 1 s.
const BELT: &str = "belt = { motion = { table = [[0, 0], [1, <vb>]] } }\n\
     [elements]\nslider = { between = [\"belt\", \"body\"], friction = <Fc> }";

#[test]
fn a_body_that_sticks_on_a_belt_slips_and_grazes_its_speed_once_a_period() {
    let case = Case::of("belt-stuck");
    let text = scene(", velocity = <vb>", BELT, "[run]\nduration = 0.75");
    judge(case, ALL, &text, |trial| {
        let slip = trial.switch(FORWARD, 1, "slip.time");
        trial.value("body.position", slip, Side::Before, "slip.position");
        for fraction in [0.2, 0.4, 0.7, 1.3] {
            let time = case.get("slip.time") + fraction * case.get("period");
            for of in ["position", "velocity"] {
                let quantity = format!("after-{fraction}-periods.{of}");
                trial.value(&format!("body.{of}"), time, Side::Before, &quantity);
            }
        }
        let rate = trial.signal("slider.friction.rate");
        for graze in ["graze-1.time", "graze-2.time"] {
            // The rate touches zero there.
            let least = rate.minimum((case.get(graze) - 0.01, case.get(graze) + 0.01));
            trial.number("rate at the graze", least.value, 0.0, 2.0 * case.param("vb"));
        }
    });
}

#[test]
fn a_body_at_rest_is_taken_along_by_a_belt() {
    let case = Case::of("belt-from-rest");
    judge(case, ALL, &scene("", BELT, "[run]\nduration = 0.3"), |trial| {
        let stick = trial.switch(STUCK, 1, "stick.time");
        trial.value("body.position", stick, Side::Before, "stick.position");
        trial.value("slider.force", stick, Side::After, "stick.friction-force-after");
        let slip = trial.switch(FORWARD, 1, "slip.time");
        trial.value("body.position", slip, Side::Before, "slip.position");
    });
}

#[test]
fn friction_stops_a_body_and_holds_it() {
    let case = Case::of("slider-free");
    let text =
        format!("[nodes]\nbody = {{ mass = <m>, velocity = <V> }}\n{GROUND}\n[run]\nduration = 1");
    judge(case, ALL, &text, |trial| {
        let time = trial.switch(STUCK, 1, "stop.time");
        let end = trial.end();
        trial.value("body.position", time, Side::Before, "stop.position");
        trial.value("body.position", end, Side::Before, "stop.position");
        // It sticks truly: it does not creep.
        let velocity = trial.signal("body.velocity");
        let creep = velocity.absolute_maximum((0.5 * (time + end), end));
        trial.number("creep", creep.value, 0.0, 0.0);
        trial.loss("slider", end, "dissipated");
    });
}

#[test]
fn a_body_on_a_spring_turns_at_ever_smaller_ways_and_sticks() {
    let displaced = "[nodes]\nbody = { mass = <m> }\nanchor = { motion = { constant = -<x0> } }\n\
         [elements]\nslider = { between = [\"body\", \"ground\"], friction = <Fc> }\n\
         spring = { between = [\"body\", \"anchor\"], spring = <k> }\n[run]\nduration = 1.5\n";
    let struck = scene(", velocity = <V>", GROUND, "[run]\nduration = 1.5");
    for (variant, text) in [("displaced", displaced), ("struck", &struck)] {
        let case = Case::of(&format!("slider-spring-{variant}"));
        judge(case, ALL, text, |trial| {
            let turns = case.count("turns");
            let own = trial.switches("slider", None);
            let expected = turns - usize::from(variant == "displaced");
            assert_eq!(own.len(), turns, "{expected}: {own:#?}");
            let from = case.param("x0");
            for (turn, own) in own.iter().enumerate() {
                let label = format!("turn-{}", turn + 1);
                let time = trial.instant(own, &format!("{label}.time"));
                let place = case.get(&format!("{label}.position")) - from;
                trial.value_is("body.position", time, Side::Before, place);
            }
            let end = trial.end();
            let rest = case.get("rest.position");
            trial.value_is("body.position", end, Side::Before, rest - from);
            // The force of the slider on the body is the negative of that in it.
            let force = -case.get("rest.friction-force");
            trial.value_is("slider.force", end, Side::Before, -force.abs() * rest.signum());
            trial.loss("slider", end, "dissipated");
        });
    }
}

#[test]
fn a_driven_slider_sticks_and_slips() {
    let case = Case::of("slider-driven");
    let frequency = case.param("Omega") / TAU;
    let load = format!(
        "[loads]\npush = {{ on = \"body\", force = {{ sine = {{ amplitude = <P>, frequency = {frequency:?} }} }} }}\n\
         [run]\nduration = <horizon>"
    );
    judge(case, ALL, &scene("", GROUND, &load), |trial| {
        let events = case.count("events");
        let own = trial.switches("slider", None);
        assert_eq!(own.len(), events, "{own:#?}");
        for (nth, own) in own.iter().enumerate() {
            let label = format!("event-{}", nth + 1);
            let time = trial.instant(own, &format!("{label}.time"));
            trial.value("body.position", time, Side::Before, &format!("{label}.position"));
            let expected = match case.get(&format!("{label}.code")) as i64 {
                0 => "stuck",
                1 => "sliding forward",
                _ => "sliding backward",
            };
            assert_eq!(own.what, expected);
        }
        let end = trial.end();
        trial.value("body.position", end, Side::Before, "horizon.position");
        trial.value("body.velocity", end, Side::Before, "horizon.velocity");
        trial.loss("slider", end, "horizon.dissipated");
        let work: f64 = trial.report.energy.work_in.iter().map(|entry| entry.1).sum();
        trial.number("work", work, case.get("horizon.work"), case.get("horizon.work"));
    });
}

fn yields(trial: &Trial<'_>) {
    let part = "pad.friction";
    let time = trial.switch([part, "sliding forward"], 1, "yield.time");
    trial.value("head.velocity", time, Side::Before, "yield.velocity");
    trial.value("pad.deformation", time, Side::Before, "yield.deformation");
    trial.switch([part, "stuck"], 1, "stick.time");
    let release = trial.switch(["pad.contact", "open"], 1, "release.time");
    trial.value("head.velocity", release, Side::Before, "release.velocity");
    let end = trial.end();
    trial.value("pad.deformation", end, Side::Before, "permanent-set");
    trial.peak("pad.deformation", (0.0, end), "peak-deformation");
    trial.peak("pad.force", (0.0, end), "peak-force");
    trial.loss("pad", end, "dissipated");
}

#[test]
fn a_spring_and_a_slider_in_series_are_elastic_and_perfectly_plastic() {
    let text = "
        [nodes]
        head = { mass = <m>, velocity = <V> }
        [elements]
        pad = { between = [\"head\", \"ground\"], series = [{ spring = <K> }, { friction = <Fc> }] }
        [effects]
        separation.pad = { at = \"head\" }
        [run]
        duration = 0.03
        ";
    judge(Case::of("slider-in-series"), ALL, text, yields);
}

/// Judge: one slider with the sum of the forces, of which each bears its part.
#[test]
fn sliders_side_by_side_are_one_with_the_sum_of_their_forces() {
    let text = |sliders: &str| {
        format!(
            "[nodes]\nbody = {{ mass = 2, velocity = 3 }}\n[elements]\n{sliders}\n\
             spring = {{ between = [\"body\", \"ground\"], spring = 900 }}\n\
             [run]\nduration = 1.5\n"
        )
    };
    let one = text("a = { between = [\"body\", \"ground\"], friction = 50 }");
    let apart = "a = { between = [\"body\", \"ground\"], friction = 20 }\n\
                 b = { between = [\"ground\", \"body\"], friction = 30 }";
    let inside = "a = { between = [\"body\", \"ground\"], parallel = [{ friction = 20 }, { friction = 30 }] }";
    for method in ALL {
        let whole = run(&one, method);
        for (sliders, names) in
            [(apart, ["a.friction", "b.friction"]), (inside, ["a.friction", "a.friction-2"])]
        {
            let report = run(&text(sliders), method);
            let (own, other) = (report.solution(), whole.solution());
            let signal = |name: &str| own.signal(report.assembly.output(name).expect(name));
            let single = |name: &str| other.signal(whole.assembly.output(name).expect(name));
            let turned = if sliders == apart { -1.0 } else { 1.0 };
            for part in 1..60 {
                let time = 1.5 * f64::from(part) / 60.0;
                let near = |found: f64, exact: f64, scale: f64| {
                    assert!(
                        (found - exact).abs() <= 1e-11 * scale,
                        "{method} {time}: {found} {exact}"
                    );
                };
                near(signal("body.position").value(time), single("body.position").value(time), 0.2);
                let force = single("a.friction.force").value(time);
                near(signal(&format!("{}.force", names[0])).value(time), 0.4 * force, 50.0);
                near(
                    signal(&format!("{}.force", names[1])).value(time),
                    turned * 0.6 * force,
                    50.0,
                );
            }
            let lost = |name: &str, report: &dashpot::analysis::RunReport| {
                let found = report.energy.dissipated.iter().find(|own| own.0 == name);
                found.unwrap_or_else(|| panic!("no {name}")).1
            };
            let all = lost("a.friction", &whole);
            for (name, part) in names.into_iter().zip([0.4, 0.6]) {
                assert!((lost(name, &report) / (part * all) - 1.0).abs() < 1e-10, "{name}");
            }
            let near = if *method == "exact" { 1e-10 } else { 1e-3 };
            assert!(report.energy.closure().abs() < near, "{method}");
        }
    }
}

/// A body with mass stays where it is while a motion jumps, so the contact beyond it does not notice.
#[test]
fn a_motion_may_jump_where_no_contact_jumps_with_it() {
    let text = |between: &str, rise: f64| {
        let table = format!("[[0, 0], [0.01, 0], [{:?}, 1e-3], [1, 1e-3]]", 0.01 + rise);
        format!(
            "[nodes]\nbelt = {{ motion = {{ table = {table} }} }}\n\
             other = {{ mass = 2 }}\nball = {{ mass = 1, velocity = 2 }}\n[elements]\n\
             spring = {{ between = [\"belt\", \"other\"], spring = 3e4 }}\n\
             pad = {{ between = {between}, kelvin-voigt = {{ spring = 4e4, dashpot = 20 }} }}\n\
             [effects]\nseparation.pad = {{}}\n[run]\nduration = 0.06\n"
        )
    };
    let ends = "[\"ball\", \"other\"]";
    for method in ALL {
        let jumped = run(&text(ends, 0.0), method);
        let opened = |report: &dashpot::analysis::RunReport| {
            let parted = report.trajectory.switches.iter().find(|switch| switch.what == "open");
            parted.map(|parted| parted.time)
        };
        // The limit of shorter and shorter rises, whose difference halves with them.
        let near = |rise: f64| {
            let slow = run(&text(ends, rise), method);
            let [a, b] = [&jumped, &slow].map(|own| {
                let ball = own.assembly.output("ball.velocity").expect("a velocity");
                own.solution().signal(ball).value(0.06)
            });
            let [parted, later] = [&jumped, &slow].map(opened);
            assert!(
                (parted.unwrap() - later.unwrap()).abs() <= rise,
                "{method} {parted:?} {later:?}"
            );
            (a - b).abs()
        };
        // A stepping method is good to 0.1 % of the largest value.
        let own = if *method == "exact" { 0.0 } else { 2e-3 };
        assert!(near(1e-5) < 1e-2 + own && near(1e-7) < 2e-4 + own, "{method}");
        let near = if *method == "exact" { 1e-10 } else { 1e-3 };
        assert!(jumped.energy.closure().abs() < near, "{method}");
    }
    let refused = read(&text("[\"ball\", \"belt\"]", 0.0), &ReadOptions::default());
    assert!(refused.unwrap_err().to_string().contains("it may jump through a contact"));
}

/// Judge: the limit of ever weaker dashpots.
#[test]
fn a_slider_behind_a_law_that_is_not_linear_needs_no_dashpot() {
    let text = |beside: &str| {
        format!(
            "[nodes]\nhead = {{ mass = \"1.464 kg\", velocity = \"1.127 m/s\" }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], series = [{{ friction = \"32.48 N\" }}, \
             {{ parallel = [{{ cubic-spring = {{ stiffness = \"1 kN/m\", cubic = \"1 MN/m^3\" }} }}{beside}] }}] }}\n\
             [run]\nduration = \"0.2 s\"\n"
        )
    };
    let places = |beside: &str, method: &str| {
        let report = run(&text(beside), method);
        let output = report.assembly.output("head.position").expect("a place");
        [0.03, 0.06, 0.1, 0.2].map(|time| report.solution().signal(output).value(time))
    };
    for method in ["auto", "bdf", "esdirk34", "tr-bdf2"] {
        let alone = places("", method);
        let limit = places(", { dashpot = \"1 mN s/m\" }", method);
        for (alone, limit) in alone.into_iter().zip(limit) {
            assert!((alone / limit - 1.0).abs() < 2e-3, "{method}: {alone} {limit}");
        }
    }
}
