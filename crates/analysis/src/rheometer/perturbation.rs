//! What rounding does to the equations of a network.
//!
//! A method that is exact solves the equations that it is given. Their coefficients are rounded as
//! they are put together, and where slow motion is what great coefficients leave over, that shows in
//! the solution while no bound of the method knows of it. So the network is put together and solved
//! again with its constants moved in their last digits, and each coefficient of an equation moved by
//! a rounding of the greatest one: what that changes is about as large as the error.

use std::sync::Arc;

use dashpot_dae::System;
use dashpot_network::{
    Model,
    elements::{Dashpot, Law, Spring},
};
use dashpot_numerics::Stream;

/// How far a constant is moved at most, in units of its last place.
const MOST: f64 = 64.0;
/// What the largest of the changes is taken times: a few tosses may all fall alike.
pub(super) const CAUTION: f64 = 2.0;
/// Seeds of the models that are solved again; the same test gives the same numbers every time.
pub(super) const SEEDS: [u64; 2] = [1, 2];

/// The same model with each constant moved in its last digits at random.
pub(super) fn perturbed(model: &Model, seed: u64) -> Model {
    let mut stream = Stream::new(seed);
    let mut copy = model.clone();
    let mut left = vec![&mut copy];
    while let Some(tree) = left.pop() {
        match tree {
            Model::Part(element) => match element.law() {
                Law::Spring(own) => {
                    *element = Arc::new(Spring { stiffness: own * factor(&mut stream) });
                }
                Law::Dashpot(own) => {
                    *element = Arc::new(Dashpot { damping: own * factor(&mut stream) });
                }
                Law::Rigid | Law::Nonlinear { .. } | Law::Phased => {}
            },
            Model::Series(branches) | Model::Parallel(branches) => {
                left.extend(branches.iter_mut().map(|branch| &mut branch.tree));
            }
        }
    }
    copy
}

/// Moves each coefficient of the equations by a rounding of the greatest one in its row, up or down at random.
pub(super) fn perturb(system: &mut System, seed: u64) {
    let mut stream = Stream::new(seed);
    for matrix in [&mut system.jacobian, &mut system.input_matrix] {
        for mut row in matrix.row_iter_mut() {
            let largest = row.values().iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            let rounding = f64::EPSILON * largest;
            row.values_mut().iter_mut().for_each(|own| *own += rounding * sign(&mut stream));
        }
    }
}

/// A factor near one.
fn factor(stream: &mut Stream) -> f64 {
    1.0 + ((2.0 * stream.share() - 1.0) * MOST).round() * f64::EPSILON
}

fn sign(stream: &mut Stream) -> f64 {
    if stream.share() < 0.5 { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use dashpot_network::{elements::Rigid, linear_model, part};

    use super::*;

    #[test]
    fn a_shaken_model_is_nearly_the_same() {
        let model = Model::series([
            part(Spring { stiffness: 3.0 }),
            part(Rigid),
            Model::parallel([part(Dashpot { damping: 2.0 }), part(Spring { stiffness: 0.0 })]),
        ]);
        let (one, other) = (linear_model(&model), linear_model(&perturbed(&model, SEEDS[0])));
        let change = other.creep(1.0) / one.creep(1.0) - 1.0;
        assert!(change != 0.0 && change.abs() <= (MOST + 2.0) * f64::EPSILON, "{change:e}");
    }
}
