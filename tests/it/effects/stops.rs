//! Bottoming out: rigid stops with restitution, chatter to rest on them, and stops that give.

use super::{
    reference::Case,
    trial::{ALL, Side, judge, run},
};

fn scene(stop: &str, others: &str, duration: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = <m>, velocity = <V> }}\n\
         [elements]\n\
         pad = {{ between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = <K>, dashpot = <C> }} }}\n\
         [effects]\nseparation.pad = {{ at = \"head\" }}\nstop.pad = {stop}\n\
         {others}\n[run]\nduration = {duration}\n"
    )
}

#[test]
fn a_rigid_stop_throws_the_head_back() {
    for variant in ["", "-release-at-once"] {
        let case = Case::of(&format!("stop-rigid{variant}"));
        let text = scene("{ at = <d>, restitution = <e> }", "", "0.04");
        judge(case, ALL, &text, |trial| {
            let hit = trial.touch("pad.stop", 1, "stop-1.time");
            assert_eq!(trial.switches("pad.stop", None).len(), 1);
            trial.value("head.velocity", hit, Side::Before, "stop-1.velocity-before");
            trial.value("head.velocity", hit, Side::After, "stop-1.velocity-after");
            let own = trial.switches("pad.stop", None)[0];
            for (what, found, quantity) in [
                ("impulse", own.impulse, "stop-1.impulse"),
                ("loss", own.lost, "stop-1.energy-lost"),
            ] {
                let expected = case.get(quantity);
                // They are quadratic in the speed at the most.
                trial.number(what, found, expected, 2.0 * expected);
            }
            trial.value("pad.force", hit, Side::Before, "stop-1.pad-force-before");
            // The force before the hit is that of a pad that is let go then.
            let after = case.get("stop-1.pad-force-after");
            if after > 0.0 {
                trial.value("pad.force", hit, Side::After, "stop-1.pad-force-after");
            } else {
                trial.value_is("pad.force", hit, Side::After, 0.0);
            }
            let release = trial.switch(["pad.contact", "open"], 1, "release.time");
            trial.value("head.velocity", release, Side::After, "release.velocity");
            trial.value("pad.deformation", release, Side::Before, "release.deformation");
            trial.loss("pad", release, "dissipated-in-pad");
            trial.peak("pad.force", (0.0, hit), "peak-force");
        });
    }
}

#[test]
fn a_pressed_head_chatters_on_the_stop_to_rest() {
    let case = Case::of("stop-chatter");
    let load = "[loads]\npush = { on = \"head\", force = { constant = <load> } }";
    let text = scene("{ at = <d>, restitution = <e> }", load, "0.04");
    judge(case, ALL, &text, |trial| {
        for touch in 1..=trial.impacts("pad.stop").len().min(8) {
            let time = trial.touch("pad.stop", touch, &format!("stop-{touch}.time"));
            let quantity = format!("stop-{touch}.velocity-before");
            trial.value("head.velocity", time, Side::Before, &quantity);
        }
        trial.count("pad.contact", "open", 0);
        trial.count("pad.stop", "closed", 1);
        trial.rests(trial.switches("pad.stop", Some("closed"))[0], "rest.time");
        let end = trial.end();
        trial.value("pad.force", end, Side::Before, "rest.pad-force");
        trial.value("pad.stop.force", end, Side::Before, "rest.stop-force");
        trial.value_is("head.velocity", end, Side::Before, 0.0);
        trial.loss("pad.stop", end, "lost-at-stop");
        trial.loss("pad", end, "dissipated-in-pad");
    });
}

#[test]
fn a_stop_that_gives_lets_go_before_the_pad() {
    let case = Case::of("stop-stiff");
    let text = scene("{ at = <d>, stiffness = <Ks>, damping = <Cs> }", "", "<horizon>");
    judge(case, ALL, &text, |trial| {
        let end = trial.end();
        trial.count("pad.contact", "open", 1);
        let touch = trial.switch(["pad.stop", "closed"], 1, "stop-touch.time");
        let left = trial.switch(["pad.stop", "open"], 1, "stop-release.time");
        let release = trial.switch(["pad.contact", "open"], 1, "pad-release.time");
        for (time, label) in
            [(touch, "stop-touch"), (left, "stop-release"), (release, "pad-release")]
        {
            trial.value("head.velocity", time, Side::Before, &format!("{label}.velocity"));
            trial.value("head.position", time, Side::Before, &format!("{label}.deformation"));
        }
        trial.value("pad.stop.force", touch, Side::After, "stop-touch.stop-force-after");
        trial.peak("pad.stop.force", (0.0, end), "stop.peak-force");
        trial.peak("pad.force", (0.0, end), "pad.peak-force");
        let total = trial.signal("pad.force").plus(trial.signal("pad.stop.force"), 1.0);
        trial.extremum(&total, "total force", (0.0, end), "total.peak-force");
        trial.peak("pad.deformation", (0.0, end), "peak-deformation");
        trial.loss("pad.stop", end, "stop.dissipated");
        trial.loss("pad", end, "pad.dissipated");
        trial.value("pad.deformation", end, Side::Before, "horizon.pad-deformation");
    });
}

/// `½ m (V² − K d²/m)` is lost on the stop, which the head meets through the contact of the pad: with a spring alone, and
/// whatever little is thrown back.
#[test]
fn what_a_rigid_stop_takes_is_lost_on_the_stop() {
    let (mass, speed, stiffness, depth) = (5.0_f64, 4.0_f64, 2e4, 0.02);
    for restitution in [0.0, 1e-9, 0.3] {
        let text = format!(
            "[nodes]\nhead = {{ mass = {mass}, velocity = {speed} }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], spring = {stiffness} }}\n\
             [effects]\nseparation.pad = {{ at = \"head\" }}\n\
             stop.pad = {{ at = {depth}, restitution = {restitution} }}\n[run]\nduration = 0.05\n"
        );
        let square = speed * speed - stiffness * depth * depth / mass;
        let right = 0.5 * mass * square * (1.0 - restitution * restitution);
        for method in ALL {
            let report = run(&text, method);
            let lost = |place: &str| -> f64 {
                let own = report.trajectory.switches.iter();
                own.filter(|own| own.name.starts_with(place)).map(|own| own.lost).sum()
            };
            let near = report.solver.rtol.map_or(1e-11, |rtol| 1e4 * rtol) * right;
            assert!((lost("pad.stop") - right).abs() <= near, "{method} {restitution}");
            assert!(lost("pad.contact").abs() <= near, "{method} {restitution}");
        }
    }
}

/// What is held does not say when it is let go: its deformation moves by roundings only.
#[test]
fn an_exact_time_of_a_stop_is_known_to_some_digits_of_roundings() {
    let case = Case::of("stop-stiff");
    let text = scene("{ at = <d>, stiffness = <Ks>, damping = <Cs> }", "", "<horizon>");
    let report = run(&case.fill(&text), "exact");
    let labels = ["stop-touch.time", "stop-release.time", "pad-release.time"];
    assert_eq!(report.events.len(), labels.len());
    for (event, label) in report.events.iter().zip(labels) {
        let (off, error) = ((event.time - case.get(label)).abs(), event.error.unwrap());
        assert!(off <= error && error <= 1e-9 * event.time, "{label}: {off:e} {error:e}");
    }
}

#[test]
fn a_head_that_comes_back_to_a_pad_still_at_its_stop_is_thrown_back_by_the_stop() {
    // A dashpot does not come back: m ẍ = m g − c ẋ until the stop, and then flights between hits at
    // the same place.
    let (g, speed, depth, end): (f64, f64, f64, f64) = (9.806_65, 2.0, 0.005, 0.3);
    for (damping, restitution) in [(50.0_f64, 0.5), (50.0, 0.3), (20.0, 0.7)] {
        let text = format!(
            "[nodes]\nhead = {{ mass = 1, velocity = {speed} }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], dashpot = {damping} }}\n\
             [effects]\ngravity = {{ start = \"unloaded\" }}\nseparation.pad = {{ at = \"head\" }}\n\
             stop.pad = {{ at = {depth}, restitution = {restitution} }}\n\
             [run]\nduration = {end}\n"
        );
        let terminal = g / damping;
        let left = |time: f64| (-damping * time).exp();
        let place =
            |time: f64| terminal * time + (speed - terminal) * (1.0 - left(time)) / damping - depth;
        // It is pressed without a turn: bisection.
        let (mut low, mut time) = (0.0, 0.1);
        for _ in 0..200 {
            let middle = 0.5 * (low + time);
            if place(middle) < 0.0 { low = middle } else { time = middle }
        }
        let mut approach = terminal + (speed - terminal) * left(time);
        let mut hits: Vec<(f64, f64)> = Vec::new();
        while time < end && hits.len() < 4 {
            hits.push((time, (1.0 + restitution) * approach));
            approach *= restitution;
            time += 2.0 * approach / g;
        }
        for method in ALL {
            let report = run(&text, method);
            let on_stop = report
                .trajectory
                .switches
                .iter()
                .filter(|switch| switch.name.starts_with("pad.stop"));
            let found: Vec<_> = on_stop.filter(|on_stop| on_stop.impulse > 0.0).collect();
            let near = report.solver.rtol.map_or(1e-11, |rtol| 1e4 * rtol);
            for (&(time, impulse), own) in hits.iter().zip(&found) {
                assert!(
                    (own.time - time).abs() <= near * end,
                    "{method}: hit at {} {time}",
                    own.time
                );
                let off = (own.impulse - impulse).abs();
                assert!(off <= near * speed, "{method}: {} N s, not {impulse}", own.impulse);
            }
            assert!(found.len() >= hits.len(), "{method}: {} of {}", found.len(), hits.len());
            assert!(report.energy.closure().abs() <= near, "{method}: energy");
        }
    }
}
