//! The groups of the thesis.

use dashpot_analysis::similarity::{FourParameterGroups, FourParameterImpact, Ranges};
use dashpot_plot::Table;
use serde::Serialize;

use super::{DIGITS, Numbered};
use crate::numbers::{constant, quantity, significant};

/// The groups of the thesis.
#[derive(Serialize)]
pub(crate) struct Thesis {
    #[serde(skip)]
    impact: FourParameterImpact,
    #[serde(skip)]
    all: FourParameterGroups,
    groups: Vec<Numbered>,
    q: f64,
    /// Where there is a padding, each with the others as they are; null is no end, or no range.
    padding_for: [Range; 4],
    parameters: Vec<Parameter>,
}

#[derive(Serialize)]
struct Range {
    group: &'static str,
    from: Option<f64>,
    to: Option<f64>,
}

#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    value: f64,
    unit: &'static str,
}

impl Thesis {
    pub(super) fn of(impact: FourParameterImpact) -> Self {
        let all = impact.groups();
        let [p1, p2, p3, p4] = impact.ratios();
        let groups = [
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
        ];
        let groups = groups.map(|(name, formula, value)| Numbered {
            parameter: name.to_owned(),
            formula: formula.to_owned(),
            value,
        });
        let parameter = |name, value, unit| Parameter { name, value, unit };
        let parameters = vec![
            parameter("m1", impact.mass, "kg"),
            parameter("V0", impact.speed, "m/s"),
            parameter("δ", impact.thickness, "m"),
            parameter("m2", impact.face_mass, "kg"),
            parameter("g", impact.gravity, "m/s^2"),
            parameter("K1", impact.k1, "N/m"),
            parameter("C1", impact.c1, "N s/m"),
            parameter("K2", impact.k2, "N/m"),
            parameter("C2", impact.c2, "N s/m"),
            parameter("m3", impact.support_mass, "kg"),
            parameter("K3", impact.support_stiffness, "N/m"),
            parameter("C3", impact.support_damping, "N s/m"),
        ];
        let Ranges { a, b, c, d } = all.ranges();
        let range = |group, found: Option<(f64, f64)>| Range {
            group,
            from: found.map(|own| own.0),
            to: found.map(|own| own.1).filter(|own| own.is_finite()),
        };
        let padding_for = [range("a", Some(a)), range("b", b), range("c", c), range("d", d)];
        Self { all, q: all.q(), groups: groups.into(), padding_for, parameters, impact }
    }

    /// The groups.
    pub(crate) fn table(&self) -> Table {
        let symbol = |name: &str| match name {
            "alpha" => "α".to_owned(),
            "beta" => "β".to_owned(),
            "gamma" => "γ".to_owned(),
            name => name.to_owned(),
        };
        let rows = self.groups.iter().map(|own| {
            vec![symbol(&own.parameter), own.formula.clone(), significant(own.value, DIGITS)]
        });
        let time = quantity(self.impact.time(), "s", 4);
        Table {
            caption: format!("The groups of the thesis, J = δ/V0 = {time}"),
            header: ["", "formula", "value"].map(str::to_owned).into(),
            rows: rows.collect(),
        }
    }

    /// The parameters of the scene by the letters of the thesis.
    pub(crate) fn parameters(&self) -> String {
        let one = |own: &Parameter| format!("{} = {}", own.name, constant(own.value, own.unit));
        self.parameters.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    /// Which of the groups are independent.
    pub(crate) fn independent(&self) -> String {
        let parameters = self.parameters.len();
        format!(
            "{parameters} parameters of rank 3 make {} independent groups: A, B, a, b, c, d, α, β, \
             γ; e is c, and p1, p2, p3 and p4 stand for a, b, c and d.",
            parameters - 3
        )
    }

    /// Where there is a padding.
    pub(crate) fn region(&self) -> String {
        format!(
            "A padding exists where q = a − b c/d − d/c is positive; here q = {}. With the other \
             groups as they are: {}.",
            significant(self.all.q(), DIGITS),
            self.all.ranges()
        )
    }
}
