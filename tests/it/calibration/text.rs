//! Scenes as texts, and the scales by which their numbers are drawn.

use std::f64::consts::PI;

use crate::random_networks::Dice;

/// What an impact of `mass` \[kg\] at `speed` \[m/s\] on `stiffness` \[N/m\] makes, by order of
/// magnitude.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales {
    pub(super) mass: f64,
    pub(super) speed: f64,
    pub(super) stiffness: f64,
}

impl Scales {
    /// A mass around 3 kg and a stiffness around 100 kN/m, over four decades each, at 0.5 to 15 m/s.
    pub(super) fn draw(dice: &mut Dice) -> Self {
        Self {
            mass: 3.0 * dice.decades(4.0),
            speed: 0.5 + 14.5 * dice.unit(),
            stiffness: 1e5 * dice.decades(4.0),
        }
    }

    /// Half a period \[s\].
    pub(super) fn time(&self) -> f64 {
        PI * (self.mass / self.stiffness).sqrt()
    }

    /// How deep a spring is pressed in \[m\].
    pub(super) fn depth(&self) -> f64 {
        self.speed * (self.mass / self.stiffness).sqrt()
    }

    /// The largest force of a spring \[N\].
    pub(super) fn force(&self) -> f64 {
        self.speed * (self.mass * self.stiffness).sqrt()
    }

    /// The dashpot constant of critical damping \[N s/m\].
    pub(super) fn damping(&self) -> f64 {
        2.0 * (self.mass * self.stiffness).sqrt()
    }
}

/// Between two numbers.
pub(super) fn between(dice: &mut Dice, least: f64, most: f64) -> f64 {
    least + (most - least) * dice.unit()
}

/// Log-uniform between two positive numbers.
pub(super) fn spread(dice: &mut Dice, least: f64, most: f64) -> f64 {
    least * (most / least).powf(dice.unit())
}

/// One in so many times.
pub(super) fn one_in(dice: &mut Dice, times: usize) -> bool {
    dice.below(times) == 0
}

/// The tables of a scene.
#[derive(Debug, Default)]
pub(super) struct Text {
    tables: [(&'static str, Vec<String>); 5],
    duration: f64,
}

/// What is read of a head.
pub(super) const HEAD_MEASURES: &str =
    "\"end-velocity\", \"hic15\", { kind = \"peak-displacement\", window = \"run\" }";

impl Text {
    /// A scene of this duration \[s\].
    pub(super) fn lasting(duration: f64) -> Self {
        let tables = ["nodes", "elements", "effects", "loads", "measures"];
        Self { tables: tables.map(|table| (table, Vec::new())), duration }
    }

    fn add(mut self, table: usize, line: String) -> Self {
        self.tables[table].1.push(line);
        self
    }

    pub(super) fn node(self, name: &str, keys: impl AsRef<str>) -> Self {
        self.add(0, format!("{name} = {{ {} }}", keys.as_ref()))
    }

    pub(super) fn element(self, name: &str, ends: [&str; 2], law: impl AsRef<str>) -> Self {
        let [a, b] = ends;
        self.add(1, format!("{name} = {{ between = [\"{a}\", \"{b}\"], {} }}", law.as_ref()))
    }

    pub(super) fn effect(self, line: impl Into<String>) -> Self {
        self.add(2, line.into())
    }

    pub(super) fn load(self, name: &str, on: &str, force: impl AsRef<str>) -> Self {
        self.add(3, format!("{name} = {{ on = \"{on}\", force = {{ {} }} }}", force.as_ref()))
    }

    pub(super) fn measures(self, target: &str, wishes: &str) -> Self {
        self.add(4, format!("{target} = [{wishes}]"))
    }

    /// What is read of a head besides what every run reports.
    pub(super) fn head(self, keys: impl AsRef<str>) -> Self {
        self.node("head", keys).measures("head", HEAD_MEASURES)
    }

    /// A head that strikes.
    pub(super) fn striking(self, scales: &Scales) -> Self {
        self.head(format!("mass = {:e}, velocity = {:e}", scales.mass, scales.speed))
    }

    /// What the pad stands on: a panel on a mount, or in one of two cases the ground.
    pub(super) fn support(self, dice: &mut Dice, scales: &Scales) -> (Self, &'static str) {
        if one_in(dice, 2) {
            return (self, "ground");
        }
        let (mass, stiffness) =
            (scales.mass * dice.decades(2.0), scales.stiffness * dice.decades(2.0));
        let damping = spread(dice, 0.01, 1.0) * 2.0 * (mass * stiffness).sqrt();
        let mount = format!("kelvin-voigt = {{ spring = {stiffness:e}, dashpot = {damping:e} }}");
        let text = self.node("panel", format!("mass = {mass:e}"));
        (text.element("mount", ["panel", "ground"], mount), "panel")
    }

    pub(super) fn finish(self) -> String {
        let tables = self.tables.iter().filter(|(_, lines)| !lines.is_empty());
        let tables = tables.map(|(table, lines)| format!("[{table}]\n{}\n", lines.join("\n")));
        let tables: Vec<String> = tables.collect();
        format!("{}[run]\nduration = {:e}\n", tables.concat(), self.duration)
    }
}
