//! Pads that push and never pull: parting at zero force, the free face, meeting again.

use super::{
    reference::Case,
    trial::{ALL, Side, Trial, judge, run},
};

const OPEN: [&str; 2] = ["pad.contact", "open"];
const CLOSED: [&str; 2] = ["pad.contact", "closed"];

/// A head of mass m at the speed V on a pad at which it can part.
fn scene(pad: &str, effects: &str, duration: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = <m>, velocity = <V> }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], {pad} }}\n\
         [effects]\nseparation.pad = {{ at = \"head\" }}\n{effects}\n\
         [run]\nduration = {duration}\n"
    )
}

const KELVIN_VOIGT: &str = "kelvin-voigt = { spring = <K>, dashpot = <C> }";
const ZENER: &str = "zener = { spring = <K0>, maxwell = { spring = <K1>, dashpot = <C1> } }";

#[test]
fn kelvin_voigt_pad_is_let_go_at_zero_force_and_its_face_recovers() {
    for zeta in ["0.05", "0.3", "0.9", "1", "1.5"] {
        let case = Case::of(&format!("kv-zeta-{zeta}"));
        judge(case, ALL, &scene(KELVIN_VOIGT, "", "<face-time>"), |trial| {
            trial.count("pad.contact", "open", 1);
            trial.count("pad.contact", "closed", 0);
            let time = trial.switch(OPEN, 1, "release.time");
            trial.value("head.velocity", time, Side::Before, "release.velocity");
            trial.value("pad.deformation", time, Side::Before, "release.deformation");
            trial.peak("pad.deformation", (0.0, time), "peak-deformation");
            trial.peak("pad.force", (0.0, time), "peak-force");
            trial.loss("pad", time, "dissipated");
            let speed = -trial.signal("head.velocity").left_value(time);
            let restitution = case.get("restitution");
            trial.number("restitution", speed / case.param("V"), restitution, 1.0);
            let impulse = trial.signal("pad.contact.force").integral((0.0, trial.end()));
            trial.number("impulse", impulse, case.get("impulse"), case.get("impulse"));
            let end = trial.end();
            trial.value("pad.deformation", end, Side::Before, "face-time.deformation");
        });
    }
}

#[test]
fn gravity_makes_a_kelvin_voigt_pad_let_go_later_or_never() {
    for zeta in ["0.05", "0.3", "0.9", "0.9-slow"] {
        let case = Case::of(&format!("kv-gravity-zeta-{zeta}"));
        let gravity = "gravity = { value = <g> }";
        judge(case, ALL, &scene(KELVIN_VOIGT, gravity, "0.3"), |trial| {
            let window = if case.count("releases") > 0 {
                let time = trial.switch(OPEN, 1, "release.time");
                trial.value("head.velocity", time, Side::Before, "release.velocity");
                trial.value("pad.deformation", time, Side::Before, "release.deformation");
                trial.loss("pad", time, "dissipated");
                (0.0, time)
            } else {
                trial.count("pad.contact", "open", 0);
                let end = trial.end();
                trial.value("pad.deformation", end, Side::Before, "rest.deformation");
                let smallest = trial.signal("pad.force").minimum((0.0, end));
                let [value, time] =
                    ["smallest-force", "smallest-force.time"].map(|own| case.get(own));
                trial.number("smallest force", smallest.value, value, case.get("peak-force"));
                // The bottom is flat: its place is known to the root of what its depth is, 1e-12.
                trial.if_exact(|| assert!((smallest.time - time).abs() < 1e-6 * time));
                (0.0, end)
            };
            trial.peak("pad.force", window, "peak-force");
            trial.peak("pad.deformation", window, "peak-deformation");
        });
    }
}

/// Holds every touch and every release against the case.
fn bounces(trial: &Trial<'_>) {
    let case = trial.case;
    let releases = case.count("releases");
    trial.count("pad.contact", "open", releases);
    let mut start = 0.0;
    for touch in 1.. {
        let force = format!("peak-force-{touch}");
        if case.find(&force).is_none() {
            break;
        }
        if touch > 1 {
            start = trial.switch(CLOSED, touch - 1, &format!("touch-{touch}.time"));
            let velocity = format!("touch-{touch}.velocity");
            trial.value("head.velocity", start, Side::Before, &velocity);
            let face = format!("touch-{touch}.face-position");
            trial.value("pad.deformation", start, Side::Before, &face);
        }
        let mut end = trial.end();
        if touch <= releases {
            end = trial.switch(OPEN, touch, &format!("release-{touch}.time"));
            let [velocity, deformation] =
                ["velocity", "deformation"].map(|own| format!("release-{touch}.{own}"));
            trial.value("head.velocity", end, Side::Before, &velocity);
            trial.value("pad.deformation", end, Side::Before, &deformation);
        }
        trial.peak("pad.force", (start, end), &force);
        trial.peak("pad.deformation", (start, end), &format!("peak-deformation-{touch}"));
        start = end;
    }
}

fn bounces_to_rest(trial: &Trial<'_>) {
    bounces(trial);
    let end = trial.end();
    trial.value("head.position", end, Side::Before, "end.position");
    trial.value("head.velocity", end, Side::Before, "end.velocity");
    trial.loss("pad", end, "dissipated");
}

#[test]
fn a_mass_bounces_on_a_kelvin_voigt_pad_until_it_rests() {
    let case = Case::of("kv-bouncing");
    let text = scene(KELVIN_VOIGT, "gravity = { value = <g> }", "<horizon>");
    judge(case, ALL, &text, bounces_to_rest);
}

#[test]
fn maxwell_pad_lets_go_only_if_its_dashpot_is_stiff_enough() {
    for variant in ["releases", "never-releases", "critical"] {
        let case = Case::of(&format!("maxwell-{variant}"));
        let pad = "maxwell = { spring = <K>, dashpot = <C> }";
        judge(case, ALL, &scene(pad, "", "<horizon>"), |trial| {
            trial.count("pad.contact", "open", case.count("releases"));
            let end = trial.end();
            if case.count("releases") == 0 {
                trial.value("pad.force", end, Side::Before, "horizon.force");
                trial.value("head.velocity", end, Side::Before, "horizon.velocity");
                trial.value("pad.deformation", end, Side::Before, "horizon.deformation");
            } else {
                let time = trial.switch(OPEN, 1, "release.time");
                trial.value("head.velocity", time, Side::Before, "release.velocity");
                trial.value("pad.deformation", time, Side::Before, "release.deformation");
                // A Maxwell face stays at zero force where it is.
                trial.value("pad.deformation", end, Side::Before, "release.deformation");
                trial.loss("pad", time, "dissipated");
            }
            trial.peak("pad.force", (0.0, end), "peak-force");
            trial.peak("pad.deformation", (0.0, end), "peak-deformation");
        });
    }
}

#[test]
fn zener_pad_lets_go_with_a_jump_of_the_speed_of_its_face() {
    let case = Case::of("zener");
    judge(case, ALL, &scene(ZENER, "", "<horizon>"), |trial| {
        bounces(trial);
        let (release, end) = (trial.switches("pad.contact", Some("open"))[0].time, trial.end());
        trial.loss("pad", release, "dissipated");
        trial.loss("pad", end, "horizon.dissipated");
        trial.value("pad.deformation", end, Side::Before, "horizon.face-position");
        trial.value("head.position", end, Side::Before, "horizon.mass-position");
        let face = trial.signal("pad.face.position");
        let panel = face.panel_at(release);
        let sides = [&face.panels[panel - 1], &face.panels[panel]];
        let expected =
            ["before", "after"].map(|side| case.get(&format!("release-1.face-velocity-{side}")));
        // A polynomial of degree n with an error has a slope with up to 2 n²/length of it (Markov).
        trial.if_exact(|| {
            for (panel, expected) in sides.into_iter().zip(expected) {
                let degree = (panel.coefficients.len() - 1) as f64;
                let steepening = 2.0 * degree * degree / panel.length();
                let allowed = steepening * trial.error(face.error, face.bound());
                trial.within("face speed", panel.slope(release), expected, allowed);
                assert!(allowed < 1e-6 * expected.abs(), "{allowed:e} says nothing");
            }
        });
    });
}

#[test]
fn a_mass_bounces_on_zener_pads_whose_faces_recover_fast_and_slowly() {
    for variant in ["", "-slow-face"] {
        let case = Case::of(&format!("zener-bouncing{variant}"));
        let text = scene(ZENER, "gravity = { value = <g> }", "<horizon>");
        judge(case, ALL, &text, bounces_to_rest);
    }
}

#[test]
fn the_reference_impact_with_separation() {
    for variant in ["", "-stiff", "-soft-mount"] {
        let case = Case::of(&format!("burgers-separation{variant}"));
        let text = "
            [nodes]
            head = { mass = <m1>, velocity = <V> }
            panel = { mass = <m3> }
            [models.valox]
            burgers = { maxwell = { spring = <K2>, dashpot = <C2> }, kelvin = { spring = <K1>, dashpot = <C1> } }
            [elements]
            pad = { between = [\"head\", \"panel\"], model = \"valox\" }
            mount = { between = [\"panel\", \"ground\"], kelvin-voigt = { spring = <K3>, dashpot = <C3> } }
            [effects]
            separation.pad = { at = \"head\" }
            [run]
            duration = <horizon>
            ";
        judge(case, ALL, text, |trial| {
            let (releases, touches) = (case.count("releases"), case.count("touches"));
            trial.count("pad.contact", "open", releases);
            trial.count("pad.contact", "closed", touches - 1);
            let state = |time: f64, label: &str| {
                for (output, what) in [
                    ("head.velocity", "head-velocity"),
                    ("pad.face.position", "face-position"),
                    ("panel.position", "panel-position"),
                    ("panel.velocity", "panel-velocity"),
                ] {
                    trial.value(output, time, Side::Before, &format!("{label}.{what}"));
                }
            };
            let mut start = 0.0;
            for touch in 1..=touches {
                if touch > 1 {
                    let label = format!("touch-{touch}");
                    start = trial.switch(CLOSED, touch - 1, &format!("{label}.time"));
                    state(start, &label);
                }
                let mut end = trial.end();
                if touch <= releases {
                    let label = format!("release-{touch}");
                    end = trial.switch(OPEN, touch, &format!("{label}.time"));
                    state(end, &label);
                }
                trial.peak("pad.force", (start, end), &format!("peak-force-{touch}"));
                start = end;
            }
            let end = trial.end();
            state(end, "horizon");
            trial.value("head.position", end, Side::Before, "horizon.head-position");
            trial.value("pad.deformation", end, Side::Before, "horizon.deformation");
            trial.peak("pad.deformation", (0.0, end), "peak-deformation");
            let first = trial.switches("pad.contact", Some("open"))[0].time;
            for (time, quantity) in [(first, "release-1.dissipated"), (end, "horizon.dissipated")] {
                let found = trial.dissipated("pad", time) + trial.dissipated("mount", time);
                trial.number("loss", found, case.get(quantity), 500.0);
            }
        });
    }
}

#[test]
fn two_interfaces_let_go_one_after_the_other() {
    for variant in ["", "-pad2-first"] {
        let case = Case::of(&format!("two-interfaces{variant}"));
        let text = "
            [nodes]
            head = { mass = <m1>, velocity = <V> }
            plate = { mass = <m2> }
            [elements]
            pad1 = { between = [\"head\", \"plate\"], kelvin-voigt = { spring = <K1>, dashpot = <C1> } }
            pad2 = { between = [\"plate\", \"ground\"], kelvin-voigt = { spring = <K2>, dashpot = <C2> } }
            [effects]
            separation.pad1 = { at = \"head\" }
            separation.pad2 = { at = \"plate\" }
            [run]
            duration = <horizon>
            ";
        judge(case, ALL, text, |trial| {
            let end = trial.end();
            for pad in ["pad1", "pad2"] {
                let contact = format!("{pad}.contact");
                for (event, what, already) in [("release", "open", 0), ("touch", "closed", 1)] {
                    let count = case.count(&format!("{pad}-{event}.count")) - already;
                    trial.count(&contact, what, count);
                    for nth in 1..=count {
                        let label = format!("{pad}-{event}-{}", nth + already);
                        let time = trial.switch([&contact, what], nth, &format!("{label}.time"));
                        for (output, of) in [
                            ("head.velocity", "head-velocity"),
                            ("plate.velocity", "plate-velocity"),
                            ("pad1.deformation", "pad1-deformation"),
                            ("pad2.deformation", "pad2-deformation"),
                        ] {
                            trial.value(output, time, Side::Before, &format!("{label}.{of}"));
                        }
                    }
                }
                trial.peak(&format!("{pad}.force"), (0.0, end), &format!("{pad}.peak-force"));
                trial.loss(pad, end, &format!("{pad}.dissipated"));
                let of = format!("{pad}.deformation");
                trial.value(&of, end, Side::Before, &format!("horizon.{pad}-deformation"));
            }
            for node in ["head", "plate"] {
                for of in ["velocity", "position"] {
                    let quantity = format!("horizon.{node}-{of}");
                    trial.value(&format!("{node}.{of}"), end, Side::Before, &quantity);
                }
            }
            let energy = &trial.report.energy;
            let kinetic = case.get("horizon.kinetic");
            trial.number("kinetic energy", energy.kinetic, kinetic, kinetic);
        });
    }
}

#[test]
fn a_pad_that_begins_stretched_is_met_where_it_lies() {
    // Its base begins that much away: half a period of contact begins that much later.
    let (mass, stiffness, speed): (f64, f64, f64) = (5.0, 1e5, 2.0);
    for away in [1e-9, 1e-7, 1e-6, 1e-5, 1e-4] {
        let text = format!(
            "[nodes]\nhead = {{ mass = {mass}, velocity = {speed} }}\n\
             base = {{ motion = {{ constant = {away} }} }}\n\
             [elements]\npad = {{ between = [\"head\", \"base\"], spring = {stiffness} }}\n\
             [effects]\nseparation.pad = {{ at = \"head\" }}\n[run]\nduration = 0.1\n"
        );
        for method in ALL {
            let report = run(&text, method);
            let contact = report.measure("pad.contact-time").unwrap().value.unwrap();
            let off = contact - std::f64::consts::PI * (mass / stiffness).sqrt();
            let near = report.solver.rtol.map_or(1e-13, |rtol| 1e3 * rtol * contact);
            assert!(off.abs() <= near, "{method}, {away} m away: {off} s off {contact}");
            let release = report.trajectory.switches.last().unwrap().time;
            let off = release - contact - away / speed;
            assert!(off.abs() <= near, "{method}, {away} m away: lets go {off} s off {release}");
        }
    }
}
