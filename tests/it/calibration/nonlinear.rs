//! Scenes with a law that is not linear.

use super::text::{Scales, Text, between, one_in, spread};
use crate::random_networks::Dice;

/// A law whose force at the depth of the scales is about theirs, as a key of a model.
type Law = fn(&mut Dice, &Scales) -> String;

/// A head that strikes a pad of this law, alone, with a dashpot beside it, or in a row with a spring
/// that is damped; it may part, and the pad may stand on a panel.
fn impact(dice: &mut Dice, law: Law, parts: bool) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 1.0, 3.0)).striking(&scales);
    let (mut text, below) = text.support(dice, &scales);
    let law = law(dice, &scales);
    let beside = scales.damping() * spread(dice, 0.02, 0.5);
    let parallel = format!("parallel = [{{ {law} }}, {{ dashpot = {beside:e} }}]");
    let pad = match dice.below(4) {
        0 => law,
        1 | 2 => parallel,
        _ => {
            let (k, c) = (scales.stiffness * dice.decades(1.5), scales.damping());
            let (c, name) = (c * spread(dice, 0.02, 0.5), "kelvin-voigt");
            format!(
                "series = [{{ {parallel} }}, {{ {name} = {{ spring = {k:e}, dashpot = {c:e} }} }}]"
            )
        }
    };
    text = text.element("pad", ["head", below], pad);
    if parts && one_in(dice, 2) {
        text = text.effect("separation.pad = { at = \"head\" }");
    }
    if one_in(dice, 4) {
        text = text.effect("gravity = { start = \"unloaded\" }");
    }
    text.finish()
}

fn power_law(dice: &mut Dice, scales: &Scales) -> (f64, f64, f64) {
    (scales.force() * spread(dice, 0.3, 3.0), scales.depth(), between(dice, 1.0, 3.5))
}

pub(super) fn power(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (force, at, n) = power_law(dice, scales);
        format!("power-spring = {{ force = {force:e}, at = {at:e}, exponent = {n:e} }}")
    };
    impact(dice, law, true)
}

pub(super) fn cubic(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let k = scales.stiffness;
        let cubic = k / scales.depth().powi(2) * spread(dice, 0.05, 20.0);
        format!("cubic-spring = {{ stiffness = {k:e}, cubic = {cubic:e} }}")
    };
    impact(dice, law, true)
}

pub(super) fn stiffening(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let limit = scales.depth() * spread(dice, 0.7, 3.0);
        format!("stiffening-spring = {{ stiffness = {:e}, limit = {limit:e} }}", scales.stiffness)
    };
    impact(dice, law, true)
}

pub(super) fn table(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (mut y, mut force) = (-1.5 * scales.depth(), -1.5 * scales.force());
        let mut points = vec![format!("[{y:e}, {force:e}]"), "[0, 0]".to_owned()];
        (y, force) = (0.0, 0.0);
        for _ in 0..4 {
            y += scales.depth() * between(dice, 0.2, 0.6);
            force += scales.force() * spread(dice, 0.05, 1.0);
            points.push(format!("[{y:e}, {force:e}]"));
        }
        format!("table-spring = [{}]", points.join(", "))
    };
    impact(dice, law, true)
}

fn foam_law(dice: &mut Dice, scales: &Scales) -> String {
    let (thickness, area) = (scales.depth() * between(dice, 1.5, 4.0), 0.01);
    let modulus = scales.stiffness * thickness / area * spread(dice, 1.0, 10.0);
    let plateau = scales.force() / area * spread(dice, 0.2, 2.0);
    let (densification, exponent) = (plateau * spread(dice, 0.05, 1.0), between(dice, 1.0, 4.0));
    format!(
        "modulus = {modulus:e}, plateau = {plateau:e}, densification = {densification:e}, \
         exponent = {exponent:e}, thickness = {thickness:e}, area = {area:e}"
    )
}

pub(super) fn foam(dice: &mut Dice) -> String {
    impact(dice, |dice, scales| format!("foam = {{ {} }}", foam_law(dice, scales)), true)
}

pub(super) fn hysteretic_foam(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (foam, set) = (foam_law(dice, scales), between(dice, 0.0, 0.5));
        let exponent = between(dice, 1.0, 4.0);
        format!("hysteretic-foam = {{ {foam}, set = {set:e}, unloading-exponent = {exponent:e} }}")
    };
    impact(dice, law, true)
}

pub(super) fn hunt_crossley(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (force, at, n) = power_law(dice, scales);
        let gap = if one_in(dice, 3) { scales.depth() * between(dice, 0.1, 1.0) } else { 0.0 };
        if one_in(dice, 2) {
            let loss = spread(dice, 0.02, 1.0) / scales.speed;
            return format!(
                "hunt-crossley = {{ force = {force:e}, at = {at:e}, exponent = {n:e}, \
                 dissipation = {loss:e}, gap = {gap:e} }}"
            );
        }
        format!(
            "bumper = {{ force = {force:e}, at = {at:e}, exponent = {n:e}, restitution = {:e}, \
             speed = {:e}, gap = {gap:e} }}",
            between(dice, 0.2, 1.0),
            scales.speed
        )
    };
    impact(dice, law, false)
}

pub(super) fn rate_spring(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (force, at, n) = power_law(dice, scales);
        let (gain, rate) = (spread(dice, 0.02, 0.5), scales.speed * spread(dice, 1e-3, 0.3));
        format!(
            "rate-spring = {{ force = {force:e}, at = {at:e}, exponent = {n:e}, gain = {gain:e}, \
             reference-rate = {rate:e} }}"
        )
    };
    impact(dice, law, true)
}

pub(super) fn power_dashpot(dice: &mut Dice) -> String {
    let law: Law = |dice, scales| {
        let (force, p) = (scales.force() * spread(dice, 0.05, 1.0), spread(dice, 0.4, 2.5));
        let (k, at) = (scales.stiffness, scales.speed);
        format!(
            "parallel = [{{ spring = {k:e} }}, {{ power-dashpot = {{ force = {force:e}, at = {at:e}, \
             exponent = {p:e} }} }}]"
        )
    };
    impact(dice, law, true)
}
