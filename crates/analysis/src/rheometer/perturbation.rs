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

/// How far a constant is moved at most, in units of its last place.
const MOST: f64 = 64.0;
/// What the largest of the changes is taken times: a few tosses may all fall alike.
pub(super) const CAUTION: f64 = 2.0;
/// Seeds of the models that are solved again; the same test gives the same numbers every time.
pub(super) const SEEDS: [u64; 2] = [1, 2];

/// The same model with each constant moved in its last digits at random.
pub(super) fn perturbed(model: &Model, seed: u64) -> Model {
    let mut stream = Stream(seed);
    let mut copy = model.clone();
    let mut left = vec![&mut copy];
    while let Some(tree) = left.pop() {
        match tree {
            Model::Part(element) => match element.law() {
                Law::Spring(own) => {
                    *element = Arc::new(Spring { stiffness: own * stream.factor() });
                }
                Law::Dashpot(own) => {
                    *element = Arc::new(Dashpot { damping: own * stream.factor() });
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

/// Moves each coefficient of the equations by a rounding of the greatest one in its row, up or down
/// at random.
pub(super) fn perturb(system: &mut System, seed: u64) {
    let mut stream = Stream(seed);
    for matrix in [&mut system.jacobian, &mut system.input_matrix] {
        for mut row in matrix.row_iter_mut() {
            let largest = row.values().iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            let rounding = f64::EPSILON * largest;
            row.values_mut().iter_mut().for_each(|own| *own += rounding * stream.sign());
        }
    }
}

/// A reproducible stream of factors near one (splitmix64).
struct Stream(u64);

impl Stream {
    fn factor(&mut self) -> f64 {
        1.0 + ((2.0 * self.share() - 1.0) * MOST).round() * f64::EPSILON
    }

    fn sign(&mut self) -> f64 {
        if self.share() < 0.5 { -1.0 } else { 1.0 }
    }

    /// A number from 0 to 1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 2.0_f64.powi(53)
    }
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
