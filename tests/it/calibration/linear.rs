//! Scenes that are linear.

use super::text::{Scales, Text, between, one_in, spread};
use crate::random_networks::{Dice, Recipe};

/// A pad of springs and dashpots.
pub(super) fn pad(dice: &mut Dice, scales: &Scales) -> String {
    let k = scales.stiffness;
    let spring = |dice: &mut Dice| format!("{:e}", k * dice.decades(1.5));
    let dashpot = |dice: &mut Dice| format!("{:e}", scales.damping() * spread(dice, 0.02, 5.0));
    match dice.below(7) {
        0 => format!("spring = {k:e}"),
        1 => format!("kelvin-voigt = {{ spring = {k:e}, dashpot = {} }}", dashpot(dice)),
        2 => format!("maxwell = {{ spring = {k:e}, dashpot = {} }}", dashpot(dice)),
        3 => format!(
            "zener = {{ spring = {}, maxwell = {{ spring = {}, dashpot = {} }} }}",
            spring(dice),
            spring(dice),
            dashpot(dice)
        ),
        4 => format!(
            "burgers = {{ maxwell = {{ spring = {}, dashpot = {} }}, kelvin = {{ spring = {}, \
             dashpot = {} }} }}",
            spring(dice),
            dashpot(dice),
            spring(dice),
            dashpot(dice)
        ),
        5 => {
            let t = scales.time();
            let term = |dice: &mut Dice| {
                format!("[{:e}, {:e}]", t * dice.decades(3.0), k * dice.decades(1.5))
            };
            let terms = [term(dice), term(dice), term(dice)].join(", ");
            format!("prony = {{ equilibrium = {}, terms = [{terms}] }}", spring(dice))
        }
        _ => format!("dashpot = {}", dashpot(dice)),
    }
}

/// A random network of eight decades.
pub(super) fn network(dice: &mut Dice) -> String {
    let recipe = loop {
        let recipe = Recipe::draw(dice, 8.0);
        if (0.5..300.0).contains(&recipe.radians()) {
            break recipe;
        }
    };
    let mut text = Text::lasting(recipe.duration());
    for (at, (mass, velocity)) in recipe.nodes.iter().enumerate() {
        let keys = match (*mass, *velocity) {
            (0.0, _) => String::new(),
            (mass, 0.0) => format!("mass = {mass:e}"),
            (mass, velocity) => format!("mass = {mass:e}, velocity = {velocity:e}"),
        };
        text = text.node(&format!("n{at}"), keys);
    }
    let name = |at: usize| {
        if at == recipe.nodes.len() { "ground".to_owned() } else { format!("n{at}") }
    };
    for (at, &(a, b, is_spring, constant)) in recipe.elements.iter().enumerate() {
        let word = if is_spring { "spring" } else { "dashpot" };
        let law = format!("{word} = {constant:e}");
        text = text.element(&format!("e{at}"), [&name(a), &name(b)], law);
    }
    text.finish()
}

/// A head that strikes a pad, which is joined to it for good.
pub(super) fn impact(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 1.0, 4.0)).striking(&scales);
    let (mut text, below) = text.support(dice, &scales);
    text = text.element("pad", ["head", below], pad(dice, &scales));
    if one_in(dice, 3) {
        text = text.load("push", "head", pulse(dice, scales.force(), scales.time()));
    }
    if one_in(dice, 4) {
        text = text.effect("gravity = { start = \"unloaded\" }");
    }
    text.finish()
}

/// A mass on a mount that is shaken, or pushed.
pub(super) fn driven(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let mut text = Text::lasting(scales.time() * between(dice, 2.0, 10.0))
        .node("head", format!("mass = {:e}", scales.mass))
        .measures("head", "\"end-velocity\", \"peak-displacement\"");
    let mut below = "ground";
    if one_in(dice, 2) {
        let drive = drive(dice, scales.depth(), scales.time());
        (text, below) = (text.node("bed", format!("motion = {{ {drive} }}")), "bed");
    } else {
        text = text.load("push", "head", pulse(dice, scales.force(), scales.time()));
    }
    let (k, c) = (scales.stiffness, scales.damping() * spread(dice, 0.01, 2.0));
    let mount = format!("kelvin-voigt = {{ spring = {k:e}, dashpot = {c:e} }}");
    text.element("mount", ["head", below], mount).finish()
}

/// A lightly damped mass over many periods.
pub(super) fn ringing(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 10.0, 60.0)).striking(&scales);
    let (text, below) = text.support(dice, &scales);
    let (k, c) = (scales.stiffness, scales.damping() * spread(dice, 1e-4, 0.03));
    text.element(
        "pad",
        ["head", below],
        format!("parallel = [{{ spring = {k:e} }}, {{ dashpot = {c:e} }}]"),
    )
    .finish()
}

/// A force of about this size and time.
pub(super) fn pulse(dice: &mut Dice, force: f64, time: f64) -> String {
    let (peak, length) = (force * spread(dice, 0.1, 2.0), time * between(dice, 0.3, 1.5));
    let start = time * between(dice, 0.0, 0.5);
    match dice.below(5) {
        0 => format!("constant = {peak:e}"),
        1 => format!("half-sine = {{ peak = {peak:e}, duration = {length:e}, start = {start:e} }}"),
        2 => format!("haversine = {{ peak = {peak:e}, duration = {length:e}, start = {start:e} }}"),
        3 => format!(
            "trapezoid = {{ peak = {peak:e}, rise = {:e}, hold = {:e}, fall = {:e}, start = {start:e} }}",
            0.2 * length,
            0.5 * length,
            0.3 * length
        ),
        _ => format!("sine = {{ amplitude = {peak:e}, frequency = {:e} }}", 1.0 / length),
    }
}

/// A displacement of about this size and time.
pub(super) fn drive(dice: &mut Dice, way: f64, time: f64) -> String {
    let (height, length) = (way * spread(dice, 0.1, 2.0), time * between(dice, 0.3, 3.0));
    match dice.below(3) {
        0 => format!("sine = {{ amplitude = {height:e}, frequency = {:e} }}", 1.0 / length),
        1 => format!("haversine = {{ peak = {height:e}, duration = {length:e} }}"),
        _ => format!("ramp = {{ height = {height:e}, rise = {length:e} }}"),
    }
}
