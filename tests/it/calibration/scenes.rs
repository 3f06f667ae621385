//! Which scenes are drawn.

use dashpot::scene::{ReadOptions, Scene, read};

use super::{linear, nonlinear, switching};
use crate::random_networks::Dice;

/// A kind of scenes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) is_linear: bool,
    draw: fn(&mut Dice) -> String,
}

const fn linear(name: &'static str, draw: fn(&mut Dice) -> String) -> Kind {
    Kind { name, is_linear: true, draw }
}

const fn other(name: &'static str, draw: fn(&mut Dice) -> String) -> Kind {
    Kind { name, is_linear: false, draw }
}

/// What is linear.
const LINEAR: &[Kind] = &[
    linear("network", linear::network),
    linear("impact", linear::impact),
    linear("driven", linear::driven),
    linear("ringing", linear::ringing),
];
/// What is not, or switches.
const OTHER: &[Kind] = &[
    other("power", nonlinear::power),
    other("separation", switching::separation),
    other("cubic", nonlinear::cubic),
    other("stop", switching::stop),
    other("stiffening", nonlinear::stiffening),
    other("gap", switching::gap),
    other("table", nonlinear::table),
    other("friction", switching::friction),
    other("foam", nonlinear::foam),
    other("face", switching::face),
    other("hysteretic foam", nonlinear::hysteretic_foam),
    other("bouncing", switching::bouncing),
    other("hunt-crossley", nonlinear::hunt_crossley),
    other("shaken", switching::perturbed),
    other("rate spring", nonlinear::rate_spring),
    other("power dashpot", nonlinear::power_dashpot),
];

/// All kinds, the linear ones first.
pub(super) fn kinds() -> impl Iterator<Item = &'static Kind> {
    LINEAR.iter().chain(OTHER)
}

/// A scene that was drawn.
pub(super) struct Drawn {
    pub(super) kind: &'static str,
    pub(super) text: String,
    pub(super) scene: Scene,
}

impl Drawn {
    /// The same with a change of its text.
    pub(super) fn changed(self, change: impl Fn(&str) -> String) -> Self {
        let text = change(&self.text);
        let scene = read(&text, &ReadOptions::default()).unwrap().value;
        Self { text, scene, ..self }
    }
}

/// Scene number `at` of a seed: linear ones and others by turns, each kind as often as the others of
/// its half. Texts that the program refuses are drawn again.
pub(super) fn draw(seed: u64, at: usize) -> Drawn {
    let half = if at.is_multiple_of(2) { LINEAR } else { OTHER };
    let own = &half[at / 2 % half.len()];
    let mut dice = Dice(seed.wrapping_mul(0x1_0000_0001) ^ at as u64);
    dice.next();
    loop {
        let text = (own.draw)(&mut dice);
        if let Ok(checked) = read(&text, &ReadOptions::default()) {
            return Drawn { kind: own.name, text, scene: checked.value };
        }
    }
}
