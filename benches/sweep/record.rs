//! A knee on two layers of foam before a panel that a measured pulse drives, after a gap: by hand and by ours.
//!
//! By hand it is the method of `explicit`, which follows the pulse's twice integrated lines through its corners. The border
//! between the layers has no mass: it is where both forces are the same.

use std::{cell::Cell, fmt::Write as _};

use dashpot::{
    analysis::sweep::ScenePoint,
    scene::{ReadOptions, read},
};

use super::{
    explicit::{Impact, Seen, follow},
    foam::GRAVITY,
};

/// Rows of the record, and the time between two \[s\].
const ROWS: usize = 2500;
const EVERY: f64 = 5e-5;
const MASS: f64 = 12.0;
const SPEED: f64 = 15.6;
const GAP: f64 = 0.05;
const AREA: f64 = 0.008;
/// The exponent of both layers' densification.
const EXPONENT: f64 = 2.5;

/// A layer of foam: thickness \[m\], modulus, plateau and densification \[Pa\].
type Layer = [f64; 4];
const SKIN: Layer = [0.015, 8e5, 1.5e5, 4e4];
const CORE: Layer = [0.025, 2e6, 4e5, 6e4];

/// The measures that both find, in this order.
pub(crate) const KEYS: [&str; 5] = [
    "skin.peak-force",
    "skin.peak-deformation",
    "skin.contact-time",
    "knee.severity-index",
    "knee.peak-acceleration",
];

/// The accelerations of the record \[g\]: a pulse of some 30 g, and noise of half a g.
fn rows() -> Vec<f64> {
    let mut seed = 1_u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let part = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        3_f64.sqrt() * 0.5 * (2.0 * part - 1.0)
    };
    let pulse = |at: usize| {
        let time = at as f64 * EVERY;
        let bump = |height: f64, middle: f64, width: f64| {
            height * (-((time - middle) / width).powi(2)).exp()
        };
        -bump(18.0, 0.025, 0.012) - bump(26.0, 0.055, 0.018)
    };
    (0..ROWS).map(|at| if at == 0 { 0.0 } else { pulse(at) + noise() }).collect()
}

/// The scene of ours.
pub(crate) fn scene() -> ScenePoint {
    let layer = |[thickness, modulus, plateau, densification]: Layer| {
        format!(
            "thickness = \"{thickness} m\", area = \"{AREA} m^2\", foam = {{ modulus = \"{modulus} Pa\", plateau = \
             \"{plateau} Pa\", densification = \"{densification} Pa\", exponent = {EXPONENT} }}"
        )
    };
    let mut points = String::new();
    for (at, row) in rows().iter().enumerate() {
        write!(points, "[\"{} s\", \"{row} g\"],", at as f64 * EVERY).expect("a text");
    }
    let text = format!(
        "[nodes]\npanel = {{ velocity = \"{SPEED} m/s\", acceleration = {{ table = {{ points = [{points}], outside = \
         \"zero\" }} }} }}\nmiddle = {{}}\nknee = {{ mass = \"{MASS} kg\", velocity = \"{SPEED} m/s\", position = \"-{GAP} \
         m\" }}\n[elements]\nskin = {{ between = [\"knee\", \"middle\"], {} }}\ncore = {{ between = [\"middle\", \
         \"panel\"], {} }}\n[effects]\nseparation.skin = {{ at = \"knee\" }}\n[run]\nduration = \"120 ms\"\n",
        layer(SKIN),
        layer(CORE)
    );
    let scene = read(&text, &ReadOptions::default()).expect("a scene").value;
    let settings = scene.settings("auto").expect("settings");
    ScenePoint { network: scene.network, settings }
}

/// The same by hand.
pub(crate) struct Knee {
    /// Acceleration, speed and place of the panel at each row.
    rows: Vec<[f64; 3]>,
    touches: bool,
    /// The last deformation of the skin.
    skin: Cell<f64>,
}

/// Place and speed of the knee, the time, that in contact, and `∫ a^2.5 dt`.
type State = [f64; 5];

/// The force of a layer, and its slope.
fn force([thickness, modulus, plateau, densification]: Layer, deformation: f64) -> [f64; 2] {
    let strain = deformation / thickness;
    let (stress, slope) = if strain < 0.0 {
        (modulus * strain, modulus)
    } else {
        let (void, low) = (1.0 - strain, (-modulus * strain / plateau).exp());
        let ratio = strain / void;
        let steep = densification * ratio * ratio.sqrt();
        (plateau * (1.0 - low) + steep * ratio, modulus * low + EXPONENT * steep / (void * void))
    };
    [AREA * stress, AREA / thickness * slope]
}

impl Knee {
    pub(crate) fn new() -> Self {
        let mut now = [0.0, SPEED, 0.0];
        let mut all = Vec::with_capacity(ROWS);
        for (at, row) in rows().iter().enumerate() {
            let next = row * GRAVITY;
            if at > 0 {
                let [a, v, x] = now;
                let place = x + EVERY * (v + EVERY * (2.0 * a + next) / 6.0);
                now = [next, v + 0.5 * EVERY * (a + next), place];
            }
            now[0] = next;
            all.push(now);
        }
        Self { rows: all, touches: false, skin: Cell::new(0.0) }
    }

    /// The five measures.
    pub(crate) fn by_hand(&mut self, rtol: f64) -> [f64; 5] {
        self.touches = false;
        self.skin.set(0.0);
        let sizes = [0.02, SPEED, f64::INFINITY, f64::INFINITY, f64::INFINITY];
        let Seen { peak, depth, end, .. } = follow(self, [-GAP, SPEED, 0.0, 0.0, 0.0], sizes, rtol);
        [peak, depth, end[3], end[4] / GRAVITY.powf(2.5), peak / MASS]
    }

    /// Place and speed of the panel.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a time in the run is that of a row"
    )]
    fn panel(&self, time: f64) -> [f64; 2] {
        let at = ((time / EVERY) as usize).min(ROWS - 2);
        let ([a, v, x], s) = (self.rows[at], time - at as f64 * EVERY);
        let jerk = (self.rows[at + 1][0] - a) / EVERY;
        [x + s * (v + s * (0.5 * a + s * jerk / 6.0)), v + s * (a + 0.5 * s * jerk)]
    }

    /// How far knee and panel have come together, and how fast they do.
    fn approach(&self, [x, v, time, ..]: &State) -> [f64; 2] {
        let [place, speed] = self.panel(*time);
        [x - place, v - speed]
    }

    /// The deformation of the skin, the force, and the slope of both layers in series.
    fn pad(&self, state: &State) -> [f64; 3] {
        let whole = self.approach(state)[0];
        let mut skin = self.skin.get().min(whole).max(whole - 0.99 * CORE[0]);
        for _ in 0..100 {
            let [[one, steep], [other, flat]] = [force(SKIN, skin), force(CORE, whole - skin)];
            let step = (one - other) / (steep + flat);
            skin = (skin - step)
                .min(0.5 * (skin + SKIN[0]))
                .max(whole - 0.5 * (whole - skin + CORE[0]));
            if step.abs() < 1e-12 {
                self.skin.set(skin);
                return [skin, one, steep * flat / (steep + flat)];
            }
        }
        [f64::NAN; 3]
    }
}

impl Impact<5> for Knee {
    fn rates(&self, state: &State) -> State {
        if !self.touches {
            return [state[1], 0.0, 1.0, 0.0, 0.0];
        }
        let acceleration = self.force(state) / MASS;
        let square = acceleration * acceleration;
        [state[1], -acceleration, 1.0, 1.0, square * acceleration.max(0.0).sqrt()]
    }

    fn force(&self, state: &State) -> f64 {
        if self.touches { self.pad(state)[1] } else { f64::MIN_POSITIVE }
    }

    fn force_rate(&self, state: &State) -> f64 {
        if self.touches { self.pad(state)[2] * self.approach(state)[1] } else { 0.0 }
    }

    fn depth(&self, state: &State) -> [f64; 2] {
        if !self.touches {
            return [0.0; 2];
        }
        let [skin, _, slope] = self.pad(state);
        [skin, slope / force(SKIN, skin)[1] * self.approach(state)[1]]
    }

    fn lasts(&self, state: &State) -> f64 {
        if self.touches { 1.0 } else { -self.approach(state)[0] }
    }

    fn switch(&mut self) {
        self.touches = true;
    }
}
