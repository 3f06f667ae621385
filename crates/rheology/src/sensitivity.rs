//! How the constants of a model's canonical form follow from its parameters.
//!
//! Derivatives are carried along with the composition, so they cost no further conversions and are right to rounding.

use nalgebra::DMatrix;

use crate::{Primitive, Tree, linear::Derivatives};

/// A parameter of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Its path, such as `kelvin.spring`; `spring` or `dashpot` for a model of one part.
    pub path: String,
    /// What it is, with its value.
    pub value: Primitive,
}

/// Relative derivatives of one set of constants with respect to another.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterMap {
    /// Where the map comes from.
    pub from: Vec<Parameter>,
    /// Where it leads to.
    pub to: Vec<Parameter>,
    /// `∂ ln to / ∂ ln from`, a row for each of `to`: by how many percent a parameter changes with
    /// one percent of another.
    pub relative: Vec<Vec<f64>>,
}

impl ParameterMap {
    /// Largest relative change of a parameter for relative changes of at most 1 in those that the
    /// map comes from: the largest sum of absolute values in series; infinite where it is not known.
    pub fn condition(&self) -> f64 {
        let row = |own: &Vec<f64>| own.iter().map(|entry| entry.abs()).sum::<f64>();
        let rows = self.relative.iter().map(row);
        rows.fold(0.0, |most, own| if own.is_nan() { f64::INFINITY } else { most.max(own) })
    }
}

/// The parameters of a model and their influence on what is seen from outside.
#[derive(Debug, Clone)]
pub struct Sensitivity {
    /// The parameters: springs and dashpots with constants > 0, in the order of the tree.
    pub parameters: Vec<Parameter>,
    /// `∂ ln (constant of the Maxwell form) / ∂ ln parameter`.
    jacobian: DMatrix<f64>,
}

/// The derivatives of the Maxwell form of a tree; `leaf` says what its parts are. `None` for rigid
/// links and for what bears no force.
///
/// Work grows with the square of the number of parts and, in alternating nests, with its fourth power.
pub fn sensitivity<P>(tree: &Tree<P>, leaf: impl Fn(&P) -> Primitive) -> Option<Sensitivity> {
    let parts = tree.parts().into_iter().map(|(path, part)| (path, leaf(part)));
    let parameters: Vec<Parameter> = parts
        .filter_map(|(path, value)| {
            let word = match value {
                Primitive::Spring(stiffness) if stiffness > 0.0 => "spring",
                Primitive::Dashpot(damping) if damping > 0.0 => "dashpot",
                _ => return None,
            };
            let path = if path.is_empty() { word.to_owned() } else { path };
            Some(Parameter { path, value })
        })
        .collect();
    let rows = Derivatives::of(tree, leaf)?.relative(parameters.len());
    let jacobian = DMatrix::from_fn(rows.len(), parameters.len(), |row, column| rows[row][column]);
    Some(Sensitivity { parameters, jacobian })
}

impl Sensitivity {
    /// How the parameters of `other`, a model that is the same from outside, follow from the parameters of this one.
    /// `None` where they do not, because those of `other` cannot all be told apart.
    pub fn map_to(&self, other: &Self) -> Option<ParameterMap> {
        let square = other.jacobian.is_square() && other.jacobian.nrows() == self.jacobian.nrows();
        let inverse = square.then(|| other.jacobian.clone().lu())?;
        let relative = inverse.solve(&self.jacobian)?;
        let row = |at: usize| relative.row(at).iter().copied().collect();
        Some(ParameterMap {
            from: self.parameters.clone(),
            to: other.parameters.clone(),
            relative: (0..relative.nrows()).map(row).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Canonical, LinearModel};
    use Primitive::{Dashpot, Spring};

    fn burgers(constants: [f64; 4]) -> Tree<Primitive> {
        let [k2, c2, k1, c1] = constants;
        let kelvin = Tree::parallel([Spring(k1).into(), Dashpot(c1).into()]);
        Tree::series([Spring(k2).into(), Dashpot(c2).into(), kelvin])
    }

    /// The constants of the two Maxwell elements.
    fn converted(constants: [f64; 4]) -> Vec<f64> {
        let tree = LinearModel::of(&burgers(constants), |&part| part).tree(Canonical::Maxwell);
        let value = |part: &Primitive| match part {
            Spring(own) | Dashpot(own) => *own,
            Primitive::Rigid => f64::INFINITY,
        };
        tree.unwrap().parts().into_iter().map(|(_, part)| value(part)).collect()
    }

    #[test]
    fn the_map_is_the_derivative_of_the_conversion() {
        let constants = [2e7, 6e3, 2.5e7, 4e3];
        let leaf = |part: &Primitive| *part;
        let tree = burgers(constants);
        let canonical = LinearModel::of(&tree, leaf).tree(Canonical::Maxwell).unwrap();
        let [own, other] = [&tree, &canonical].map(|tree| sensitivity(tree, leaf).unwrap());
        let map = own.map_to(&other).unwrap();
        let step = 1e-5;
        for column in 0..4 {
            let at = |factor: f64| {
                let mut own = constants;
                own[column] *= factor;
                converted(own)
            };
            let (up, down) = (at(1.0 + step), at(1.0 - step));
            for row in 0..4 {
                let slope = (up[row] / down[row]).ln() / (2.0 * step);
                // Central differences: the second order of the step and rounding over the step.
                let found = map.relative[row][column];
                assert!((found - slope).abs() < 1e-9, "{row} {column}: {found} for {slope}");
            }
        }
    }

    #[test]
    fn there_and_back_is_the_identity() {
        let tree = burgers([2e7, 6e3, 2.5e7, 4e3]);
        let other = LinearModel::of(&tree, |&part| part).tree(Canonical::Maxwell).unwrap();
        let [ours, theirs] = [&tree, &other].map(|own| sensitivity(own, |&part| part).unwrap());
        let [there, back] = [ours.map_to(&theirs).unwrap(), theirs.map_to(&ours).unwrap()];
        for row in 0..4 {
            for column in 0..4 {
                let product: f64 =
                    (0..4).map(|at| back.relative[row][at] * there.relative[at][column]).sum();
                let expected = f64::from(u8::from(row == column));
                assert!((product - expected).abs() < 1e-13, "{row} {column}: {product}");
            }
        }
        // Scaling all constants scales those of the other form: rows sum to 1.
        for row in &there.relative {
            assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn parameters_that_cannot_be_told_have_no_map() {
        let springs = Tree::series([Spring(1.0).into(), Spring(2.0).into()]);
        let single = Tree::from(Spring(2.0 / 3.0));
        let [ours, theirs] = [&springs, &single].map(|own| sensitivity(own, |&part| part).unwrap());
        assert!(theirs.map_to(&ours).is_none());
        let map = ours.map_to(&theirs).unwrap();
        // d ln k = (k/k1) d ln k1 + (k/k2) d ln k2.
        assert!((map.relative[0][0] - 2.0 / 3.0).abs() < 1e-15);
        assert!((map.condition() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn merged_modes_carry_their_derivatives() {
        let maxwell = |k: f64, c: f64| Tree::series([Spring(k).into(), Dashpot(c).into()]);
        let twins = Tree::parallel([maxwell(1.0, 2.0), maxwell(3.0, 6.0)]);
        let single = maxwell(4.0, 8.0);
        let [ours, theirs] = [&twins, &single].map(|own| sensitivity(own, |&part| part).unwrap());
        let map = ours.map_to(&theirs).unwrap();
        // K = Σ K_i and C = Σ C_i.
        let expected = [[0.25, 0.0, 0.75, 0.0], [0.0, 0.25, 0.0, 0.75]];
        for (found, expected) in map.relative.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-14, "{:?}", map.relative);
        }
    }
}
