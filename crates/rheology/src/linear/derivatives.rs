//! Derivatives of partial fractions with respect to the parameters of a tree.

use dashpot_numerics::DoubleDouble;

use super::{Fractions, Primitive};
use crate::Tree;

/// Derivatives with respect to the logarithms of parameters, as pairs of the number of a parameter
/// and a value, in rising order.
type Row = Vec<(usize, f64)>;

/// Partial fractions with the derivatives of their constants.
#[derive(Debug, Clone, Default)]
struct Derived {
    fractions: Fractions,
    constant: Row,
    at_zero: Row,
    /// For each line those of the rate and of the strength.
    lines: Vec<[Row; 2]>,
}

/// A part of a model as it was composed.
enum Half {
    Maxwell(Derived),
    Kelvin(Derived),
}

/// The Maxwell form of a model and its derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Derivatives(Derived);

impl Derivatives {
    /// Those of a tree; parameters are springs and dashpots with constants > 0, numbered in the
    /// order of the tree. `None` for rigid links and for what bears no force.
    pub(crate) fn of<P>(tree: &Tree<P>, leaf: impl Fn(&P) -> Primitive) -> Option<Self> {
        let mut count = 0;
        let whole = tree.fold(
            |part| {
                let half = Half::primitive(leaf(part), count);
                count +=
                    usize::from(matches!(&half, Half::Maxwell(own) if !own.fractions.is_zero()));
                half
            },
            |node, parts| Half::composed(node.is_series(), parts),
        );
        let form = whole.form(false)?;
        (!form.fractions.is_zero()).then_some(Self(form))
    }

    /// `∂ ln constant / ∂ ln parameter` for the constants that are not zero: spring, dashpot, and of
    /// each line the rate and the strength.
    pub(crate) fn relative(&self, parameters: usize) -> Vec<Vec<f64>> {
        let Derived { fractions, constant, at_zero, lines } = &self.0;
        let dense = |value: DoubleDouble, row: &Row| {
            let mut all = vec![0.0; parameters];
            row.iter().for_each(|&(at, slope)| all[at] = slope / value.high());
            all
        };
        let singles = [(fractions.at_zero, at_zero), (fractions.constant, constant)];
        let singles = singles.into_iter().filter(|single| single.0.high() > 0.0);
        let lines = fractions.lines.iter().zip(lines).flat_map(|(line, [rate, strength])| {
            [dense(line.rate, rate), dense(line.strength, strength)]
        });
        singles.map(|(value, row)| dense(value, row)).chain(lines).collect()
    }
}

impl Half {
    fn primitive(part: Primitive, number: usize) -> Self {
        let mut own = Derived::default();
        match part {
            Primitive::Rigid => return Self::Kelvin(own),
            Primitive::Spring(constant) => {
                own.fractions.at_zero = constant.into();
                own.at_zero = vec![(number, constant)];
            }
            Primitive::Dashpot(constant) => {
                own.fractions.constant = constant.into();
                own.constant = vec![(number, constant)];
            }
        }
        Self::Maxwell(own)
    }

    /// The Kelvin form or the Maxwell form, `None` where it is infinite.
    fn form(self, is_kelvin: bool) -> Option<Derived> {
        match (self, is_kelvin) {
            (Self::Kelvin(own), true) | (Self::Maxwell(own), false) => Some(own),
            (Self::Kelvin(own) | Self::Maxwell(own), _) => {
                (!own.fractions.is_zero()).then(|| own.reciprocal())
            }
        }
    }

    fn composed(in_series: bool, parts: Vec<Self>) -> Self {
        let parts: Option<Vec<Derived>> =
            parts.into_iter().map(|part| part.form(in_series)).collect();
        match (parts, in_series) {
            (Some(parts), true) => Self::Kelvin(Derived::sum(&parts)),
            (Some(parts), false) => Self::Maxwell(Derived::sum(&parts)),
            (None, true) => Self::Maxwell(Derived::default()),
            (None, false) => Self::Kelvin(Derived::default()),
        }
    }
}

impl Derived {
    /// The sum of `parts`, with the same modes merged as without derivatives.
    fn sum(parts: &[Self]) -> Self {
        let all: Vec<&Fractions> = parts.iter().map(|part| &part.fractions).collect();
        let fractions = Fractions::sum(&all, &mut Vec::new());
        let groups = Fractions::groups(&all);
        let lines = fractions.lines.iter().zip(&groups).map(|(whole, group)| {
            // The rate of merged modes is the mean by the weights strength over rate.
            let line = |&(part, at): &(usize, usize)| all[part].lines[at];
            let weight = |own: &(usize, usize)| (line(own).strength / line(own).rate).high();
            let viscosity: f64 = group.iter().map(weight).sum();
            let slopes = |own: &(usize, usize)| &parts[own.0].lines[own.1];
            let rates = group.iter().map(|own| {
                let share = weight(own) / viscosity;
                (share * (whole.rate / line(own).rate).high(), &slopes(own)[0])
            });
            [total(rates), total(group.iter().map(|own| (1.0, &slopes(own)[1])))]
        });
        let row = |pick: fn(&Self) -> &Row| total(parts.iter().map(|part| (1.0, pick(part))));
        let lines = lines.collect();
        Self {
            lines,
            constant: row(|own| &own.constant),
            at_zero: row(|own| &own.at_zero),
            fractions,
        }
    }

    /// The other form. A zero `x` of `F = c − Σ w/(x − p)` moves by `−dF/F'`, and its strength is `1/(x F')`.
    fn reciprocal(&self) -> Self {
        let fractions = self.fractions.reciprocal();
        let own = &self.fractions;
        let poles: Vec<(DoubleDouble, DoubleDouble, &Row, Option<&Row>)> =
            (own.at_zero.high() > 0.0)
                .then_some((DoubleDouble::ZERO, own.at_zero, &self.at_zero, None))
                .into_iter()
                .chain(own.lines.iter().zip(&self.lines).map(|(line, [rate, strength])| {
                    (line.rate, line.strength, strength, Some(rate))
                }))
                .collect();
        let lines = fractions.lines.iter().map(|line| {
            let apart: Vec<f64> = poles.iter().map(|pole| (line.rate - pole.0).high()).collect();
            let slope = (line.rate * line.strength).recip().high();
            // −dF/F' without the part from the zero itself.
            let mut moved: Vec<(f64, &Row)> = vec![(-1.0 / slope, &self.constant)];
            for (own, &apart) in poles.iter().zip(&apart) {
                moved.push((1.0 / apart / slope, own.2));
                if let Some(rate) = own.3 {
                    moved.push((own.1.high() / apart / apart / slope, rate));
                }
            }
            let moved = total(moved);
            // dF' = Σ dw/(x − p)² − 2 Σ w (dx − dp)/(x − p)³.
            let mut steeper: Vec<(f64, &Row)> = Vec::new();
            let mut bent = 0.0;
            for (own, &apart) in poles.iter().zip(&apart) {
                let curve = 2.0 * own.1.high() / apart / apart / apart;
                bent += curve;
                steeper.push((1.0 / apart / apart, own.2));
                steeper.extend(own.3.map(|rate| (curve, rate)));
            }
            steeper.push((-bent, &moved));
            let steeper = total(steeper);
            let strength = line.strength.high();
            let change =
                total([(-strength / line.rate.high(), &moved), (-strength / slope, &steeper)]);
            [moved, change]
        });
        let lines = lines.collect();
        let square = |value: DoubleDouble| -(value.high() * value.high());
        let constant = if fractions.constant.high() > 0.0 {
            let strengths = self.lines.iter().map(|line| (1.0, &line[1]));
            let sum = total([(1.0, &self.at_zero)].into_iter().chain(strengths));
            total([(square(fractions.constant), &sum)])
        } else {
            Row::new()
        };
        let at_zero = if fractions.at_zero.high() > 0.0 {
            let over = own.lines.iter().zip(&self.lines).flat_map(|(line, [rate, strength])| {
                let inverse = 1.0 / line.rate.high();
                [(inverse, strength), (-line.strength.high() * inverse * inverse, rate)]
            });
            let sum = total([(1.0, &self.constant)].into_iter().chain(over));
            total([(square(fractions.at_zero), &sum)])
        } else {
            Row::new()
        };
        Self { fractions, constant, at_zero, lines }
    }
}

/// `Σ factor · row`.
fn total<'r>(terms: impl IntoIterator<Item = (f64, &'r Row)>) -> Row {
    let mut all: Row = Vec::new();
    for (factor, row) in terms {
        all.extend(row.iter().map(|&(at, slope)| (at, factor * slope)));
    }
    all.sort_by_key(|own| own.0);
    all.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            kept.1 += next.1;
        }
        is_same
    });
    all
}
