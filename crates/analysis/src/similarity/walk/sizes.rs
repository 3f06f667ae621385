//! Sizes of pads, which act in products with what they are sizes of.

use dashpot_network::parameters::Dimension;

use super::{AREA, Visit};

/// Sees the model of a pad: a law as thick as the pad has its thickness from there.
pub(super) struct Pad<'v> {
    pub(super) visit: &'v mut dyn Visit,
    pub(super) before: f64,
    pub(super) after: f64,
}

impl Visit for Pad<'_> {
    #[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
    fn quantity(&mut self, name: &str, dimension: Dimension, value: f64) -> f64 {
        let is_same = dimension == Dimension::LENGTH && [value] == [self.before];
        if is_same && name.ends_with(".thickness") {
            return self.after;
        }
        self.visit.quantity(name, dimension, value)
    }

    fn word(&mut self, name: &str, word: &str) {
        self.visit.word(name, word);
    }

    fn size(&mut self, dimension: Dimension, value: f64) -> f64 {
        self.visit.size(dimension, value)
    }
}

/// Sees the values of a law of stresses: these act only times its area.
pub(super) struct Stresses<'v> {
    pub(super) visit: &'v mut dyn Visit,
    pub(super) before: f64,
    pub(super) after: f64,
}

impl Visit for Stresses<'_> {
    #[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
    fn quantity(&mut self, name: &str, dimension: Dimension, value: f64) -> f64 {
        if dimension == AREA {
            return self.after;
        }
        if dimension.mass == 0 {
            return self.visit.quantity(name, dimension, value);
        }
        let force = Dimension { length: dimension.length + 2, ..dimension };
        let before = value * self.before;
        let after = self.visit.quantity(&format!("{name}*area"), force, before);
        let is_same = [after, self.after] == [before, self.before];
        if is_same { value } else { after / self.after }
    }

    fn word(&mut self, name: &str, word: &str) {
        self.visit.word(name, word);
    }

    fn size(&mut self, dimension: Dimension, value: f64) -> f64 {
        self.visit.size(dimension, value)
    }
}
