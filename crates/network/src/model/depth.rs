//! How deep an energy presses a law that is not linear.

use dashpot_numerics::{quadrature::integral, roots::bisect};

use super::Model;
use crate::elements::{Element, Law, phases::PhaseLaw};

/// Doublings and halvings of the search: from far below to the last digits that matter.
const DOUBLINGS: usize = 200;
const HALVINGS: usize = 60;
/// The search begins at this depth \[m\].
const FIRST: f64 = 1e-6;

/// The depth \[m\] at which a model has taken up `energy` \[J\] when it is pressed slowly. `None`
/// where it is linear, or is no spring-like parts side by side, so that its stiffness has to tell.
pub(crate) fn at_energy(model: &Model, energy: f64) -> Option<f64> {
    let parts = side_by_side(model)?;
    let force = |at: f64| parts.iter().map(|part| part.force(at, 0.0)).sum::<f64>();
    let taken = |depth: f64| integral(force, 0.0, depth);
    let mut high = FIRST;
    for _ in 0..DOUBLINGS {
        // A comparison with NaN is false.
        if taken(high) >= energy {
            break;
        }
        high *= 2.0;
    }
    let (_, high) = bisect(0.0, high, HALVINGS, |depth| taken(depth) >= energy);
    (high.is_normal() && taken(high) >= energy).then_some(high)
}

/// The springs of a model that are side by side, at least one of them not linear. Dashpots beside
/// them bear nothing when it is pressed slowly.
fn side_by_side(model: &Model) -> Option<Vec<&dyn Element>> {
    let parts = model.fold(
        |element| match element.law() {
            Law::Spring(_) | Law::Nonlinear { .. } => Some(vec![element.as_ref()]),
            Law::Dashpot(_) => Some(Vec::new()),
            Law::Rigid => None,
            Law::Phased => {
                let own = element.phases()?;
                matches!(own.law(own.first(0.0)), PhaseLaw::Element(_))
                    .then(|| vec![element.as_ref()])
            }
        },
        |node, parts: Vec<Option<Vec<&dyn Element>>>| {
            let all = parts.into_iter().collect::<Option<Vec<_>>>()?.concat();
            (!node.is_series()).then_some(all)
        },
    )?;
    parts.iter().any(|part| !matches!(part.law(), Law::Spring(_))).then_some(parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        elements::{CubicSpring, Dashpot, Foam, HystereticFoam, PowerSpring, Spring},
        parameters::Kind as _,
        part,
    };

    #[test]
    fn the_depth_is_that_of_the_closed_forms() {
        // F = F_r (y/y_r)^n: W = F_r y_r (y/y_r)^(n+1)/(n + 1).
        let (force, at, exponent) = (300.0, 0.01, 1.5);
        let power = || part(PowerSpring { force, at, exponent });
        for depth in [1e-5, 0.003, 0.4] {
            let energy: f64 = force * at * (depth / at).powf(exponent + 1.0) / (exponent + 1.0);
            let beside = Model::parallel([power(), part(Dashpot { damping: 100.0 })]);
            for model in [power(), beside] {
                assert!((at_energy(&model, energy).unwrap() / depth - 1.0).abs() < 1e-12);
            }
        }
        // k y²/2 + k₃ y⁴/4.
        let (stiffness, cubic, depth) = (1e4, 1e8, 0.02_f64);
        let energy = 0.5 * stiffness * depth.powi(2) + 0.25 * cubic * depth.powi(4);
        let model = part(CubicSpring { stiffness, cubic });
        assert!((at_energy(&model, energy).unwrap() / depth - 1.0).abs() < 1e-12);
        let split = [part(CubicSpring { stiffness: 4e3, cubic }), part(Spring { stiffness: 6e3 })];
        let depth_of_both = at_energy(&Model::parallel(split), energy).unwrap();
        assert!((depth_of_both / depth - 1.0).abs() < 1e-12);
    }

    #[test]
    fn foam_with_hysteresis_is_pressed_on_its_first_curve() {
        let foam = Foam::sample();
        let energy = foam.stored(0.013);
        let crushed = HystereticFoam { foam, set: 0.3, unloading_exponent: 2.0 };
        assert!((at_energy(&part(crushed), energy).unwrap() / 0.013 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_linear_or_in_series_is_left_to_its_stiffness() {
        let spring = || part(Spring { stiffness: 1e4 });
        assert_eq!(at_energy(&spring(), 1.0), None);
        let foam = || part(Foam::sample());
        assert_eq!(at_energy(&Model::series([spring(), foam()]), 1.0), None);
        assert_eq!(at_energy(&foam(), f64::NAN), None);
    }
}
