//! Short ways to write scenes.

use std::fmt::Write as _;

/// Place, speed and farthest place of a node over the whole run.
pub(super) const ENDS: &str = "[{ kind = \"end-position\", window = \"run\" }, \
     { kind = \"end-velocity\", window = \"run\" }, { kind = \"peak-displacement\", window = \"run\" }]";
/// Largest force and deformation of an element over the whole run, its last deformation, and its
/// impulse.
pub(super) const FORCES: &str = "[{ kind = \"peak-force\", window = \"run\" }, \
     { kind = \"peak-deformation\", window = \"run\" }, \
     { kind = \"end-deformation\", window = \"run\" }, { kind = \"impulse\", window = \"run\" }]";

/// A scene that grows.
#[derive(Debug, Clone, Default)]
pub(super) struct Text {
    nodes: String,
    elements: String,
    measures: String,
    rest: String,
}

impl Text {
    /// A mass \[kg\] that moves \[m/s\], by the name of `head`, of which all ends are reported.
    pub(super) fn head(mass: f64, velocity: f64) -> Self {
        Self::default()
            .node("head", &format!("mass = {mass:?}, velocity = {velocity:?}"))
            .measure("head", ENDS)
    }

    pub(super) fn node(mut self, name: &str, keys: &str) -> Self {
        writeln!(self.nodes, "{name} = {{ {keys} }}").unwrap();
        self
    }

    /// An element between two nodes.
    pub(super) fn element(mut self, name: &str, ends: [&str; 2], model: &str) -> Self {
        let [from, to] = ends;
        writeln!(self.elements, "{name} = {{ between = [\"{from}\", \"{to}\"], {model} }}")
            .unwrap();
        self
    }

    /// An element `pad` between the head and the ground.
    pub(super) fn pad(self, model: &str) -> Self {
        self.element("pad", ["head", "ground"], model)
    }

    pub(super) fn measure(mut self, of: &str, list: &str) -> Self {
        writeln!(self.measures, "{of} = {list}").unwrap();
        self
    }

    /// Further tables.
    pub(super) fn with(mut self, tables: &str) -> Self {
        writeln!(self.rest, "{tables}").unwrap();
        self
    }

    /// The whole text of a run of this length \[s\].
    pub(super) fn lasting(&self, duration: f64) -> String {
        let Self { nodes, elements, measures, rest } = self;
        format!(
            "[nodes]\n{nodes}\n[elements]\n{elements}\n[measures]\n{measures}\n{rest}\n[run]\nduration = {duration:?}\n"
        )
    }
}

/// `kelvin-voigt` with these constants.
pub(super) fn kelvin(spring: f64, dashpot: f64) -> String {
    format!("kelvin-voigt = {{ spring = {spring:?}, dashpot = {dashpot:?} }}")
}

/// `maxwell` with these constants.
pub(super) fn maxwell(spring: f64, dashpot: f64) -> String {
    format!("maxwell = {{ spring = {spring:?}, dashpot = {dashpot:?} }}")
}

/// `zener` with these constants, the lone spring first.
pub(super) fn zener(spring: f64, arm: f64, dashpot: f64) -> String {
    format!("zener = {{ spring = {spring:?}, {} }}", maxwell(arm, dashpot))
}

/// Maxwell branches side by side, beside a spring if it is not zero.
pub(super) fn branches(spring: f64, arms: &[(f64, f64)]) -> String {
    let mut parts: Vec<String> = arms
        .iter()
        .map(|&(spring, dashpot)| format!("{{ {} }}", maxwell(spring, dashpot)))
        .collect();
    if spring > 0.0 {
        parts.insert(0, format!("{{ spring = {spring:?} }}"));
    }
    format!("parallel = [{}]", parts.join(", "))
}
