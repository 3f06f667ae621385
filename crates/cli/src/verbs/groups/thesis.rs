//! The groups of the thesis.

use dashpot_analysis::similarity::{FourParameterGroups, FourParameterImpact};
use dashpot_report::Table;
use serde::Serialize;

use super::DIGITS;
use crate::output::{list, object};
use dashpot_report::numbers::{constant, quantity, significant};

/// The groups of the thesis.
pub(super) struct Thesis {
    impact: FourParameterImpact,
    groups: FourParameterGroups,
}

impl Thesis {
    pub(super) fn of(impact: FourParameterImpact) -> Self {
        Self { groups: impact.groups(), impact }
    }

    /// Letter, formula and value of each.
    fn groups(&self) -> [(&'static str, &'static str, f64); 13] {
        let all = &self.groups;
        let [p1, p2, p3, p4] = self.impact.ratios();
        [
            ("A", "g δ/V0²", all.gravity),
            ("B", "m1/(m1 + m2)", all.share),
            ("a", "(1 + p1 + p2) p3/p1", all.a),
            ("b", "p2 p3²/p1", all.b),
            ("c", "p3/p4 = K2 J²/m1", all.c),
            ("d", "b/p4", all.d),
            ("alpha", "C3 J/m3", all.alpha),
            ("beta", "K3 J²/m3", all.beta),
            ("gamma", "m1/m3", all.gamma),
            ("p1", "C1/C2", p1),
            ("p2", "K1/K2", p2),
            ("p3", "K2 J/C2", p3),
            ("p4", "m1/(J C2)", p4),
        ]
    }

    /// The parameters of the scene by the letters of the thesis, with their units.
    fn constants(&self) -> [(&'static str, f64, &'static str); 12] {
        let FourParameterImpact { scales, padding, support, face_mass, gravity, .. } = &self.impact;
        [
            ("m1", scales.mass, "kg"),
            ("V0", scales.speed, "m/s"),
            ("δ", scales.thickness, "m"),
            ("m2", *face_mass, "kg"),
            ("g", *gravity, "m/s^2"),
            ("K1", padding.k1, "N/m"),
            ("C1", padding.c1, "N s/m"),
            ("K2", padding.k2, "N/m"),
            ("C2", padding.c2, "N s/m"),
            ("m3", support.mass, "kg"),
            ("K3", support.stiffness, "N/m"),
            ("C3", support.damping, "N s/m"),
        ]
    }

    /// The groups, with the ranges in which there is a padding, each with the others as they are; null
    /// is no end, or no range.
    pub(super) fn object(&self) -> impl Serialize {
        let ranges = ["a", "b", "c", "d"].into_iter().zip(self.groups.ranges().0);
        object! {
            groups: list(self.groups().map(|(parameter, formula, value)| object! {
                parameter, formula, value,
            })),
            q: self.groups.q(),
            padding_for: list(ranges.map(|(group, found)| object! {
                group,
                from: found.map(|own| own.0),
                to: found.map(|own| own.1).filter(|own| own.is_finite()),
            })),
            parameters: list(self.constants().map(|(name, value, unit)| object! {
                name, value, unit,
            })),
        }
    }

    pub(super) fn table(&self) -> Table {
        let row = |(name, formula, value): (&str, &str, f64)| {
            let symbol = match name {
                "alpha" => "α",
                "beta" => "β",
                "gamma" => "γ",
                name => name,
            };
            vec![symbol.to_owned(), formula.to_owned(), significant(value, DIGITS)]
        };
        let caption = format!(
            "The groups of the thesis, J = δ/V0 = {}",
            quantity(self.impact.scales.time(), "s", 4)
        );
        Table::new(caption, &["", "formula", "value"], self.groups().map(row))
    }

    /// The parameters of the scene by the letters of the thesis.
    pub(super) fn parameters(&self) -> String {
        let one = |(name, value, unit)| format!("{name} = {}", constant(value, unit));
        self.constants().map(one).join(", ")
    }

    /// Which of the groups are independent.
    pub(super) fn independent(&self) -> String {
        let parameters = self.constants().len();
        format!(
            "{parameters} parameters of rank 3 make {} independent groups: A, B, a, b, c, d, α, β, \
             γ; e is c, and p1, p2, p3 and p4 stand for a, b, c and d.",
            parameters - 3
        )
    }

    /// Where there is a padding.
    pub(super) fn region(&self) -> String {
        format!(
            "A padding exists where q = a − b c/d − d/c is positive; here q = {}. With the other \
             groups as they are: {}.",
            significant(self.groups.q(), DIGITS),
            self.groups.ranges()
        )
    }
}
