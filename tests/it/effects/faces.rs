//! Pads whose face has mass: plastic touches and touches with restitution, parting at F1 = 0.

use super::{
    reference::Case,
    trial::{ALL, Side, judge},
};

fn scene(separation: &str, gravity: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = <m1>, velocity = <V> }}\n\
         [elements]\n\
         pad = {{ between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = <K>, dashpot = <C> }} }}\n\
         [effects]\nseparation.pad = {{ {separation} }}\nface.pad = {{ mass = <m2> }}\n{gravity}\n\
         [run]\nduration = <horizon>\n"
    )
}

#[test]
fn a_plastic_touch_joins_head_and_face_until_f1_is_zero() {
    for (variant, gravity) in
        [("", ""), ("-gravity", "gravity = { value = <g>, start = \"unloaded\" }")]
    {
        let case = Case::of(&format!("face-plastic{variant}"));
        judge(case, ALL, &scene("at = \"head\"", gravity), |trial| {
            let (touches, releases) = (case.count("touches"), case.count("releases"));
            trial.count("pad.contact", "open", releases);
            let end = trial.end();
            let mut start = 0.0;
            let mut lost = 0.0;
            for touch in 1..=touches {
                let label = format!("touch-{touch}");
                let own = trial.impacts("pad.contact")[touch - 1];
                lost += own.lost;
                if touch == 1 {
                    let impulse = case.get("touch-1.impulse");
                    trial.number("first impulse", own.impulse, impulse, impulse);
                } else {
                    start = trial.touch("pad.contact", touch, &format!("{label}.time"));
                    trial.value("head.position", start, Side::Before, &format!("{label}.position"));
                }
                trial.value(
                    "head.velocity",
                    start,
                    Side::After,
                    &format!("{label}.velocity-after"),
                );
                // Energies are quadratic in the speed: what is lost is known to the first loss.
                let of = case.get("touch-1.energy-lost");
                trial.number("loss", own.lost, case.get(&format!("{label}.energy-lost")), of);
                let mut last = end;
                if touch <= releases {
                    let label = format!("release-{touch}");
                    last = trial.switch(["pad.contact", "open"], touch, &format!("{label}.time"));
                    trial.value("head.velocity", last, Side::Before, &format!("{label}.velocity"));
                    trial.value("head.position", last, Side::Before, &format!("{label}.position"));
                }
                trial.peak("pad.contact.force", (start, last), &format!("peak-F1-{touch}"));
                trial.peak("pad.force", (start, last), &format!("peak-F2-{touch}"));
                let pull = format!("largest-pull-of-pad-{touch}");
                if case.find(&pull).is_some() {
                    let until =
                        trial.impacts("pad.contact").get(touch).map_or(end, |impact| impact.time);
                    trial.trough("pad.force", (last, until), &pull);
                }
                start = last;
            }
            trial.count("pad.contact", "open", releases);
            trial.value("head.position", end, Side::Before, "horizon.impactor-position");
            trial.value("head.velocity", end, Side::Before, "horizon.impactor-velocity");
            trial.value("pad.face.position", end, Side::Before, "horizon.face-position");
            trial.value("pad.face.velocity", end, Side::Before, "horizon.face-velocity");
            let all = case.get("lost-at-touches");
            trial.number("loss at touches", lost, all, all);
            trial.loss("pad.contact", end, "lost-at-touches");
            trial.loss("pad", end, "dissipated-in-pad");
        });
    }
}

#[test]
fn touches_with_restitution_end_in_going_on_together() {
    let case = Case::of("face-restitution");
    judge(case, ALL, &scene("at = \"head\", restitution = <e>", ""), |trial| {
        for touch in 1..=trial.impacts("pad.contact").len().min(8) {
            let label = format!("touch-{touch}");
            let time = trial.touch("pad.contact", touch, &format!("{label}.time"));
            for (output, body) in [("head.velocity", "impactor"), ("pad.face.velocity", "face")] {
                for (side, word) in [(Side::Before, "before"), (Side::After, "after")] {
                    // Nobody sees the speeds before a touch at the very start.
                    if time > 0.0 || side == Side::After {
                        let quantity = format!("{label}.{body}-velocity-{word}");
                        trial.value(output, time, side, &quantity);
                    }
                }
            }
        }
        trial.count("pad.contact", "closed", 1);
        let joined = case.get("joined.time");
        trial.rests(trial.switches("pad.contact", Some("closed"))[0], "joined.time");
        trial.value("head.velocity", joined, Side::After, "joined.velocity");
        trial.value("head.position", joined, Side::After, "joined.position");
        // They part first by the impact at the start.
        let release = trial.switch(["pad.contact", "open"], 2, "release.time");
        trial.value("head.velocity", release, Side::Before, "release.velocity");
        trial.value("head.position", release, Side::Before, "release.position");
        trial.peak("pad.contact.force", (joined, release), "joined.peak-F1");
        let end = trial.end();
        trial.peak("pad.force", (0.0, end), "peak-F2");
        trial.loss("pad.contact", end, "lost-at-touches");
        trial.loss("pad", end, "dissipated-in-pad");
        trial.value("pad.face.position", end, Side::Before, "horizon.face-position");
        trial.value("pad.face.velocity", end, Side::Before, "horizon.face-velocity");
    });
}
