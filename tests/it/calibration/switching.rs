//! Scenes that are linear between switchings.

use super::{
    linear,
    text::{Scales, Text, between, one_in, spread},
};
use crate::random_networks::Dice;

fn kelvin(dice: &mut Dice, scales: &Scales) -> String {
    let (k, c) = (scales.stiffness, scales.damping() * spread(dice, 0.01, 0.7));
    format!("kelvin-voigt = {{ spring = {k:e}, dashpot = {c:e} }}")
}

/// A pad from which the head parts.
pub(super) fn separation(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 1.2, 4.0)).striking(&scales);
    let (text, below) = text.support(dice, &scales);
    let mut text = text
        .element("pad", ["head", below], linear::pad(dice, &scales))
        .effect("separation.pad = { at = \"head\" }");
    if one_in(dice, 2) {
        text = text.effect("gravity = { start = \"unloaded\" }");
    }
    text.finish()
}

/// A pad that bottoms out, on what is rigid or stiff.
pub(super) fn stop(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 1.0, 2.5)).striking(&scales);
    let (text, below) = text.support(dice, &scales);
    let at = scales.depth() * between(dice, 0.2, 0.8);
    let own = if one_in(dice, 2) {
        format!("restitution = {:e}", between(dice, 0.0, 0.9))
    } else {
        let stiffness = scales.stiffness * spread(dice, 3.0, 300.0);
        let critical = 2.0 * (scales.mass * stiffness).sqrt();
        let damping = if one_in(dice, 3) { 0.0 } else { critical * spread(dice, 0.01, 0.5) };
        format!("stiffness = {stiffness:e}, damping = {damping:e}")
    };
    let mut text = text
        .element("pad", ["head", below], kelvin(dice, &scales))
        .effect(format!("stop.pad = {{ at = {at:e}, {own} }}"));
    if one_in(dice, 2) {
        text = text.effect("separation.pad = { at = \"head\" }");
    }
    text.finish()
}

/// A mass that meets another one across a gap.
pub(super) fn gap(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let gap = scales.depth() * between(dice, 0.0, 1.0);
    let panel = scales.mass * dice.decades(2.0);
    let text = Text::lasting(scales.time() * between(dice, 1.0, 3.0)).striking(&scales);
    text.node("panel", format!("mass = {panel:e}"))
        .element("mount", ["panel", "ground"], kelvin(dice, &scales))
        .element("guide", ["head", "ground"], format!("spring = {:e}", 0.1 * scales.stiffness))
        .element(
            "bump",
            ["head", "panel"],
            format!("contact = {{ gap = {gap:e}, restitution = {:e} }}", between(dice, 0.0, 0.95)),
        )
        .finish()
}

/// A slider on a spring that is struck, or driven to and fro.
pub(super) fn friction(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let slip = scales.force() * spread(dice, 0.03, 0.7);
    let (text, behind) = if one_in(dice, 2) {
        (Text::lasting(scales.time() * between(dice, 1.0, 6.0)).striking(&scales), "ground")
    } else {
        let frequency = between(dice, 0.1, 0.8) / scales.time();
        let amplitude = scales.depth() * between(dice, 0.5, 1.5);
        let motion = format!(
            "motion = {{ sine = {{ amplitude = {amplitude:e}, frequency = {frequency:e} }} }}"
        );
        let text = Text::lasting(between(dice, 1.0, 3.0) / frequency).node("drive", motion);
        let text = text.node("head", format!("mass = {:e}", scales.mass));
        (text.measures("head", "\"end-velocity\", \"peak-displacement\""), "drive")
    };
    text.element("pad", ["head", behind], kelvin(dice, &scales))
        .element("slide", ["head", "ground"], format!("friction = {slip:e}"))
        .finish()
}

/// A pad whose face has mass.
pub(super) fn face(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let text = Text::lasting(scales.time() * between(dice, 1.0, 3.0)).striking(&scales);
    let (text, below) = text.support(dice, &scales);
    let mass = scales.mass * spread(dice, 0.01, 0.5);
    let restitution = if one_in(dice, 2) { between(dice, 0.0, 0.8) } else { 0.0 };
    text.element("pad", ["head", below], kelvin(dice, &scales))
        .effect(format!("separation.pad = {{ at = \"head\", restitution = {restitution:e} }}"))
        .effect(format!("face.pad = {{ mass = {mass:e} }}"))
        .finish()
}

/// A head that falls and bounces, on a spring or on rigid ground.
pub(super) fn bouncing(dice: &mut Dice) -> String {
    let scales = Scales::draw(dice);
    let height = scales.speed.powi(2) / (2.0 * 9.806_65);
    let fall = scales.speed / 9.806_65;
    let text = Text::lasting(fall * between(dice, 1.5, 6.0))
        .head(format!("mass = {:e}, drop = {height:e}", scales.mass))
        .effect("gravity = true");
    if one_in(dice, 3) {
        let law = format!("contact = {{ restitution = {:e} }}", between(dice, 0.2, 0.9));
        return text.element("pad", ["head", "ground"], law).finish();
    }
    text.element("pad", ["head", "ground"], kelvin(dice, &scales))
        .effect("separation.pad = { at = \"head\" }")
        .finish()
}

/// A parcel on a bed that is shaken hard enough to throw it off.
pub(super) fn perturbed(dice: &mut Dice) -> String {
    let g = 9.806_65;
    let (mass, stiffness) = (3.0 * dice.decades(2.0), 1e5 * dice.decades(2.0));
    let scales = Scales { mass, stiffness, speed: 1.0 };
    let frequency = between(dice, 3.0, 20.0);
    let amplitude = g * between(dice, 0.8, 2.0) / (std::f64::consts::TAU * frequency).powi(2);
    let motion =
        format!("motion = {{ sine = {{ amplitude = {amplitude:e}, frequency = {frequency:e} }} }}");
    Text::lasting(between(dice, 1.0, 4.0) / frequency)
        .node("head", format!("mass = {mass:e}"))
        .node("bed", motion)
        .element("pad", ["head", "bed"], kelvin(dice, &scales))
        .effect("gravity = { start = \"equilibrium\" }")
        .effect("separation.pad = { at = \"head\" }")
        .measures("head", "\"end-velocity\", \"peak-displacement\"")
        .finish()
}
