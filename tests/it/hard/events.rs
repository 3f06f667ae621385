//! Events: touch, release, impact, rest.

use std::f64::consts::PI;

use super::{
    case::Case,
    reference::reference,
    scene::{FORCES, Text, kelvin, maxwell},
    table::judge,
};

const G: f64 = 9.806_65;
const GRAVITY: &str = "[effects]\ngravity = { value = 9.80665 }\n";
const PARTS: &str = "[effects]\nseparation.pad = { at = \"head\" }\n";
const FALLS_AND_PARTS: &str =
    "[effects]\ngravity = { value = 9.80665 }\nseparation.pad = { at = \"head\" }\n";

#[test]
fn events() {
    judge("events", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![chatter_on_rigid_ground(), chatter_on_a_pad(), two_contacts_at_once()];
    cases.extend([1e-12, -1e-12].map(grazing));
    cases.extend(at_rest_on_the_surface());
    cases.extend([starts_penetrated(), kelvin_voigt_face(), second_hit(), moving_support()]);
    cases.extend([starts_at_a_tiny_pull(), never_releases(), plastic_impact()]);
    cases.extend([1e-6, 1e-9, 1e-13].map(nearly_at_once));
    cases.extend([1e-3, 1e-9].map(impacts_close_together));
    cases.extend([1e-3, 1e-9].map(struck_from_both_sides));
    cases.extend([thousand_bounces(), very_unequal_contact(), long_flight()]);
    cases.extend([slides_to_rest(), held_by_a_hair(1e-9), held_by_a_hair(-1e-9)]);
    cases.extend([
        stiff_stop(),
        stack(),
        gaps_in_series(),
        contacts_at_both_ends(),
        sliders_in_series(),
    ]);
    cases
}

fn chatter_on_rigid_ground() -> Case {
    let text = Text::head(0.5, 2.0)
        .pad("contact = { restitution = 0.7 }")
        .measure("pad", "[{ kind = \"impulse\", window = \"run\" }]")
        .with(GRAVITY)
        .lasting(2.0);
    Case::new("bounces on rigid ground to rest", "closed form", text, |trial| {
        let rest = 2.0 * 0.7 * 2.0 / (G * 0.3);
        trial.ends("head", 0.0, 0.0);
        trial.last("pad.force", 0.5 * G);
        trial.measure("pad.impulse", 0.5 * 2.0 + 0.5 * G * 2.0);
        let impacts = trial.impacts("pad");
        trial.holds(format!("{impacts} impacts"), (10..=200).contains(&impacts));
        let closed = trial.times("pad", "closed");
        let stays = closed.last().copied().unwrap_or(f64::NAN);
        trial.number("time of rest", stays, rest, rest, Some(1e-6 * rest));
    })
}

fn chatter_on_a_pad() -> Case {
    let text = Text::head(1.0, 1.4)
        .pad(&kelvin(1e4, 20.0))
        .measure("pad", FORCES)
        .with(FALLS_AND_PARTS)
        .lasting(5.0);
    Case::new("bounces on a Kelvin–Voigt pad to rest", "rests at m g/k", text, |trial| {
        trial.ends("head", G / 1e4, 0.0);
        trial.measure("pad.end-deformation", G / 1e4);
        trial.measure("pad.impulse", 1.4 + G * 5.0);
        trial.last("pad.force", G);
        let touches = trial.switched("pad.contact", "closed");
        trial.holds(format!("{touches} touches"), (3..=100).contains(&touches));
    })
}

/// Two buffers that are met at 0.1 m, or the second one a little later.
fn buffers(late: f64) -> String {
    let buffer =
        |gap: f64| format!("series = [{{ contact = {{ gap = {gap:?} }} }}, {{ spring = 50 }}]");
    Text::head(1.0, 1.0)
        .element("left", ["head", "ground"], &buffer(0.1))
        .element("right", ["head", "ground"], &buffer(0.1 + late))
        .lasting(0.6)
}

fn two_contacts_at_once() -> Case {
    Case::new("two contacts at one instant", "closed form", buffers(0.0), |trial| {
        trial.output("head.position", 0.2, 0.1 + 0.1 * 1.0_f64.sin());
        trial.output("head.velocity", 0.2, 1.0_f64.cos());
        trial.ends("head", 0.1 - (0.5 - 0.1 * PI), -1.0);
        trial.holds("left opens", trial.switched("left.contact", "open") == 1);
        trial.holds("right opens", trial.switched("right.contact", "open") == 1);
    })
}

fn nearly_at_once(late: f64) -> Case {
    let name = format!("two contacts {late:e} m apart");
    Case::new(name, "energy and limit", buffers(late), move |trial| {
        // All comes back; the second spring acts later by `late` s, twice.
        trial.measure_known("head.end-velocity", -1.0, 1e-14);
        trial.measure_known("head.end-position", 0.1 - (0.5 - 0.1 * PI), 4.0 * late);
        trial.energy_closes();
    })
}

fn grazing(beyond: f64) -> Case {
    let gap = 1.0 + beyond;
    let text = Text::head(1.0, 1.0)
        .pad("spring = 1")
        .element(
            "stop",
            ["head", "ground"],
            &format!("series = [{{ contact = {{ gap = {gap:?} }} }}, {{ spring = 1e3 }}]"),
        )
        .lasting(3.0);
    Case::new(
        format!("swing that ends {beyond:e} m before a contact"),
        "closed form",
        text,
        move |trial| {
            trial.ends("head", 3.0_f64.sin(), 3.0_f64.cos());
            if trial.is_exact() {
                let touches = trial.switched("stop.contact", "closed");
                trial.holds(format!("{touches} touches"), touches == usize::from(beyond < 0.0));
            }
        },
    )
}

fn at_rest_on_the_surface() -> Vec<Case> {
    let still = |model: &str, more: &str| {
        Text::default()
            .node("head", "mass = 2")
            .pad(model)
            .measure("head", super::scene::ENDS)
            .measure("pad", FORCES)
            .with(more)
            .lasting(1.0)
    };
    let contact = "series = [{ contact = { gap = 0.0 } }, { spring = 1e3 }]";
    vec![
        Case::new("at rest on a surface, no weight", "closed form", still(contact, ""), |trial| {
            trial.ends("head", 0.0, 0.0);
            trial.measure("pad.peak-force", 0.0);
        }),
        Case::new(
            "at rest on a spring, in balance",
            "closed form",
            still(contact, GRAVITY),
            |trial| {
                trial.ends("head", 2.0 * G / 1e3, 0.0);
                trial.measure("pad.peak-force", 2.0 * G);
                trial.output("pad.force", 0.0, 2.0 * G);
            },
        ),
        Case::new(
            "at rest on rigid ground",
            "closed form",
            still("contact = { restitution = 0.9 }", GRAVITY),
            |trial| {
                trial.ends("head", 0.0, 0.0);
                trial.output("pad.force", 0.0, 2.0 * G);
                trial.last("pad.force", 2.0 * G);
                trial.holds("no impacts", trial.impacts("pad") == 0);
            },
        ),
    ]
}

fn starts_penetrated() -> Case {
    let text = Text::head(1.0, 0.0)
        .node("base", "motion = { constant = -0.1 }")
        .element("pad", ["head", "base"], "spring = 100")
        .with(PARTS)
        .lasting(0.5);
    Case::new("starts penetrated by 0.1 m", "closed form", text, |trial| {
        trial.ends("head", -0.1 - (0.5 - PI / 20.0), -1.0);
        trial.holds("opens once", trial.switched("pad.contact", "open") == 1);
    })
}

fn kelvin_voigt_face() -> Case {
    let text = Text::head(1.0, 1.0).pad(&kelvin(100.0, 4.0)).with(PARTS).lasting(1.0);
    Case::new("Kelvin–Voigt face parts with no gap and no speed", "closed form", text, |trial| {
        let (decay, omega) = (2.0_f64, 96.0_f64.sqrt());
        let release = (PI - (4.0 * omega / (100.0 - 8.0)).atan()) / omega;
        let (sine, cosine) = (omega * release).sin_cos();
        let way = (-decay * release).exp() * sine / omega;
        let speed = (-decay * release).exp() * cosine - decay * way;
        trial.measure("pad.contact-time", release);
        trial.ends("head", way + speed * (1.0 - release), speed);
        trial.holds("opens once", trial.switched("pad.contact", "open") == 1);
        trial.holds("stays open", trial.switched("pad.contact", "closed") == 0);
        trial.last("pad.force", 0.0);
    })
}

fn second_hit() -> Case {
    let text = Text::head(1.0, 2.0).pad(&maxwell(1e4, 1e3)).with(FALLS_AND_PARTS).lasting(0.6);
    Case::new("second hit on a face that remembers the first", "script", text, |trial| {
        let get = |quantity| reference("second-hit", quantity);
        trial.ends("head", get("position"), get("velocity"));
        trial.measure("pad.contact-time", get("release-1"));
        let releases = trial.switched("pad.contact", "open");
        trial.holds(format!("{releases} releases"), releases == 2);
    })
}

fn moving_support() -> Case {
    let text = Text::head(0.3, 2.0)
        .node("floor", "motion = { sine = { amplitude = 1e-3, frequency = 10.0 } }")
        .element("pad", ["head", "floor"], "contact = { restitution = 0.8 }")
        .with(GRAVITY)
        .lasting(0.97);
    Case::new("bounces on ground that shakes", "script", text, |trial| {
        let get = |quantity| reference("moving-support", quantity);
        trial.ends("head", get("position"), get("velocity"));
        let impacts = trial.impacts("pad");
        trial.holds(format!("{impacts} impacts"), impacts == get("count") as usize);
    })
}

fn starts_at_a_tiny_pull() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("base", "motion = { constant = 1e-19 }")
        .element("pad", ["head", "base"], "spring = 100")
        .with(PARTS)
        .lasting(0.6);
    Case::new("starts at a force of −10⁻¹⁷ N", "closed form", text, |trial| {
        trial.ends("head", -(0.6 - 0.1 * PI), -1.0);
        trial.measure("pad.peak-force", 10.0);
    })
}

fn never_releases() -> Case {
    let text = Text::head(1.0, 1.0).pad("dashpot = 100").with(PARTS).lasting(1.0);
    Case::new("force that decays to zero never releases", "closed form", text, |trial| {
        trial.ends("head", 0.01, (-100.0_f64).exp());
        trial.holds("stays closed", trial.switched("pad.contact", "open") == 0);
    })
}

fn plastic_impact() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("body", "mass = 2")
        .element("gap", ["head", "body"], "contact = { gap = 0.1 }")
        .lasting(1.0);
    Case::new("plastic impact of two masses", "momentum", text, |trial| {
        trial.ends("head", 0.1 + 0.9 / 3.0, 1.0 / 3.0);
        trial.last("body.velocity", 1.0 / 3.0);
        trial.energy_closes();
    })
}

/// Three equal masses in a row, the last two of which are hardly apart.
fn impacts_close_together(gap: f64) -> Case {
    let text = Text::head(1.0, 1.0)
        .node("second", "mass = 1")
        .node("third", "mass = 1")
        .element("first-gap", ["head", "second"], "contact = { gap = 0.1, restitution = 1.0 }")
        .element(
            "second-gap",
            ["second", "third"],
            &format!("contact = {{ gap = {gap:?}, restitution = 1.0 }}"),
        )
        .measure("third", super::scene::ENDS)
        .lasting(1.0);
    Case::new(
        format!("two elastic impacts {gap:e} s apart"),
        "momentum and energy",
        text,
        move |trial| {
            trial.ends("head", 0.1, 0.0);
            trial.last("second.velocity", 0.0);
            trial.ends("third", 0.9 - gap, 1.0);
            trial.energy_closes();
        },
    )
}

/// A body at rest that another strikes from the left, and a third from the right a little later: three
/// impacts, for what comes back from the right meets the first one.
fn struck_from_both_sides(later: f64) -> Case {
    let text = Text::head(1.0, 1.0)
        .node("second", "mass = 2")
        .node("third", "mass = 1, velocity = -1")
        .element("first-gap", ["head", "second"], "contact = { gap = 0.1, restitution = 1.0 }")
        .element(
            "second-gap",
            ["second", "third"],
            &format!("contact = {{ gap = {:?}, restitution = 1.0 }}", 0.1 + later),
        )
        .lasting(1.0);
    Case::new(
        format!("struck from the left, and {later:e} s later from the right"),
        "momentum and energy",
        text,
        move |trial| {
            let elastic = |masses: [f64; 2], [u, v]: [f64; 2]| {
                let [m, n] = masses;
                let all = m + n;
                [((m - n) * u + 2.0 * n * v) / all, (2.0 * m * u + (n - m) * v) / all]
            };
            let [head, second] = elastic([1.0, 2.0], [1.0, 0.0]);
            // The second meets the third after a wait, and is thrown back onto the first.
            let wait = later / (1.0 + second);
            let [thrown, third] = elastic([2.0, 1.0], [second, -1.0]);
            let again = wait * (second - head) / (head - thrown);
            let [head_after, second_after] = elastic([1.0, 2.0], [head, thrown]);
            let left = 0.9 - wait - again;
            trial.ends("head", 0.1 + head * (wait + again) + head_after * left, head_after);
            trial.output(
                "second.position",
                1.0,
                second * wait + thrown * again + second_after * left,
            );
            trial.output("third.velocity", 1.0, third);
            trial.energy_closes();
        },
    )
}

fn thousand_bounces() -> Case {
    // A thousand flights of 2 V/g, the first one from the ground at t = 0, and half of the next.
    let end = 1000.5 * 2.0 * 1e-2 / G;
    let text =
        Text::head(1.0, 1e-2).pad("contact = { restitution = 1.0 }").with(GRAVITY).lasting(end);
    Case::new("1000 bounces without loss", "closed form", text, |trial| {
        let impacts = trial.impacts("pad");
        trial.holds(format!("{impacts} impacts"), impacts == 1001);
        trial.measure("head.end-position", -1e-4 / (2.0 * G));
        trial.measure("head.peak-displacement", 1e-4 / (2.0 * G));
        trial.energy_closes();
    })
}

fn very_unequal_contact() -> Case {
    let text = Text::head(1e-6, 1.0)
        .node("wall", "mass = 1e6")
        .element("gap", ["head", "wall"], "contact = { gap = 0.1, restitution = 1.0 }")
        .measure("wall", "[{ kind = \"end-velocity\", window = \"run\" }]")
        .lasting(1.0);
    Case::new("elastic impact of 10⁻⁶ kg on 10⁶ kg", "momentum and energy", text, |trial| {
        let all = 1e6 + 1e-6;
        trial.ends("head", 0.1 + 0.9 * (1e-6 - 1e6) / all, (1e-6 - 1e6) / all);
        trial.measure("wall.end-velocity", 2e-6 / all);
        trial.energy_closes();
    })
}

fn long_flight() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("series = [{ contact = { gap = 1e6 } }, { spring = 1e4 }]")
        .measure("pad", "[{ kind = \"peak-force\", window = \"run\" }]")
        .lasting(1.1e6);
    Case::new("flight of 10⁶ s before an impact of 30 ms", "closed form", text, |trial| {
        trial.measure("pad.peak-force", 100.0);
        trial.ends("head", 1e6 - (1e5 - 0.01 * PI), -1.0);
    })
}

fn slides_to_rest() -> Case {
    let text = Text::head(2.0, 3.0).pad("friction = 5.0").lasting(2.0);
    Case::new("friction stops a mass for good", "closed form", text, |trial| {
        // v² m/2F, after v m/F = 1.2 s.
        trial.ends("head", 1.8, 0.0);
        trial.holds("sticks", trial.switched("pad", "stuck") == 1);
        trial.energy_closes();
    })
}

/// A mass that is pulled by a little less, or more, than the friction that holds it.
fn held_by_a_hair(more: f64) -> Case {
    let force = 5.0 * (1.0 + more);
    let text = Text::head(2.0, 0.0)
        .pad("friction = 5.0")
        .with(&format!("[loads]\nram = {{ on = \"head\", force = {{ constant = {force:?} }} }}"))
        .lasting(100.0);
    Case::new(
        format!("friction against 1 + {more:e} of its force"),
        "closed form",
        text,
        move |trial| {
            let net = (force - 5.0).max(0.0);
            trial.ends("head", 0.5 * net / 2.0 * 1e4, net / 2.0 * 100.0);
        },
    )
}

fn stiff_stop() -> Case {
    let text = Text::head(1.0, 1.0)
        .element("pad", ["head", "ground"], "spring = 1")
        .with("[effects]\nstop.pad = { at = 0.5, stiffness = 1e13 }\n")
        .measure("pad", "[{ kind = \"peak-deformation\", window = \"run\" }]")
        .lasting(0.9);
    Case::new("stop of 10¹³ N/m", "closed form", text, |trial| {
        // ½ = ½ x² + ½ K (x − ½)² at the deepest point; the stop turns the speed within 10⁻⁶ s.
        let meets = 0.5_f64.asin();
        let left = 0.9 - meets;
        let speed = 0.75_f64.sqrt();
        let swing = |t: f64| (0.5 * t.cos() - speed * t.sin(), -0.5 * t.sin() - speed * t.cos());
        let (way, velocity) = swing(left);
        trial.measure_known("head.end-position", way, 2e-6);
        trial.measure_known("head.end-velocity", velocity, 2e-6);
        trial.measure_known("pad.peak-deformation", 0.5 + speed / 1e13_f64.sqrt(), 1e-13);
        trial.energy_closes();
    })
}

/// Ten masses that lie on each other without anything between.
fn stack() -> Case {
    let mut text = Text::default();
    let mut below = "ground".to_owned();
    for at in 0..10 {
        let own = format!("slab-{at}");
        text = text.node(&own, "mass = 1").element(
            &format!("joint-{at}"),
            [&own, &below],
            "contact = { restitution = 0.5 }",
        );
        below = own;
    }
    let text = text.with(GRAVITY).measure("slab-9", super::scene::ENDS).lasting(1.0);
    Case::new("stack of ten masses at rest", "closed form", text, |trial| {
        trial.ends("slab-9", 0.0, 0.0);
        for at in 0..10 {
            trial.last(&format!("joint-{at}.force"), G * f64::from(10 - at));
        }
    })
}

/// What lies loose between two gaps of one pad has no place; the gaps add up all the same.
fn gaps_in_series() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("series = [{ contact = { gap = 1e-3 } }, { spring = 100 }, { contact = { gap = 2e-3 } }]")
        .lasting(1.0);
    Case::new("two slack gaps in series: they add up", "closed form", text, |trial| {
        trial.measure("pad.peak-force", 10.0);
        trial.measure("pad.contact-time", 0.1 * PI);
        trial.ends("head", 3e-3 - (1.0 - 3e-3 - 0.1 * PI), -1.0);
    })
}

fn contacts_at_both_ends() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("panel", "mass = 3")
        .element(
            "pad",
            ["head", "panel"],
            "series = [{ contact = { gap = 0.0 } }, { spring = 75 }, { contact = { gap = 0.0 } }]",
        )
        .measure("panel", super::scene::ENDS)
        .lasting(1.0);
    Case::new("spring with a contact at both ends", "closed form", text, |trial| {
        // The contact lasts π √(μ/k), with μ = ¾ kg; then the speeds are −½ and ½.
        let lasts = 0.1 * PI;
        trial.measure("pad.contact-time", lasts);
        trial.ends("head", 0.25 * lasts - 0.5 * (1.0 - lasts), -0.5);
        trial.ends("panel", 0.25 * lasts + 0.5 * (1.0 - lasts), 0.5);
    })
}

fn sliders_in_series() -> Case {
    let text =
        Text::head(1.0, 1.0).pad("series = [{ friction = 1 }, { friction = 2 }]").lasting(2.0);
    Case::new("two sliders in series: the weaker one slides", "closed form", text, |trial| {
        trial.measure("pad.peak-force", 1.0);
        trial.ends("head", 0.5, 0.0);
    })
}
