//! Models with shifted times.

use std::sync::Arc;

use dashpot_rheology::Tree;

use crate::{
    Element, Model,
    elements::{Dashpot, Law},
    model::part,
    parameters::{InvalidParameter, Range},
    phases::{Phase, PhaseLaw},
};

/// The model with all its times multiplied by `factor` \[1\], which is positive: every dashpot constant is multiplied
/// by it, and all else is kept. Springs of any law have no time, and neither do dry friction, rigid contact and foam.
///
/// # Examples
///
/// ```
/// use dashpot_network::{elements::Dashpot, part, shifts::{ShiftKind, Wlf, shifted}};
///
/// let warm = Wlf { temperature: 303.15, reference: 293.15, c1: 17.44, c2: 51.6 };
/// let factor = warm.factor()?;
/// assert!((factor.log10() + 17.44 * 10.0 / 61.6).abs() < 1e-12);
/// let softer = shifted(&part(Dashpot { damping: 6e3 }), factor)?;
/// # assert!(matches!(softer, dashpot_rheology::Tree::Part(_)));
/// # Ok::<(), dashpot_network::parameters::InvalidParameter>(())
/// ```
///
/// # Errors
///
/// [`InvalidParameter`] when the factor is not positive and finite, when a dashpot constant
/// does not fit into double precision, or for an element whose force depends on the rate, but not in proportion to it.
pub fn shifted(model: &Model, factor: f64) -> Result<Model, InvalidParameter> {
    Range::Positive.check("factor", factor)?;
    model.try_map(|element| shifted_element(element, factor))
}

/// Whether the force of an element depends on the size of its rate, in any of its phases. Laws whose
/// force only switches where the rate changes its sign have no time of their own.
fn depends_on_rate(element: &dyn Element) -> bool {
    let is_damped = |law: Law| match law {
        Law::Dashpot(damping) | Law::Nonlinear { damping, .. } => damping > 0.0,
        Law::Spring(_) | Law::Rigid | Law::Phased => false,
    };
    let Some(phases) = element.phases() else { return is_damped(element.law()) };
    // Any memory will do: what a phase remembers is a deformation.
    (0..phases.names().len()).any(|index| match phases.law(Phase { index, memory: 1.0 }) {
        PhaseLaw::Element(own) => is_damped(own.law()),
        PhaseLaw::Open | PhaseLaw::Held(_) | PhaseLaw::Force(_) => false,
    })
}

fn shifted_element(element: &Arc<dyn Element>, factor: f64) -> Result<Model, InvalidParameter> {
    match element.law() {
        Law::Nonlinear { .. } | Law::Phased if depends_on_rate(element.as_ref()) => {
            let range = "independent of the rate where its times are multiplied";
            Err(InvalidParameter::new(
                element.kind(),
                range,
                "a law of the rate that is not linear",
            ))
        }
        Law::Spring(_) | Law::Rigid | Law::Nonlinear { .. } | Law::Phased => {
            Ok(Tree::Part(Arc::clone(element)))
        }
        Law::Dashpot(damping) => {
            let shifted = damping * factor;
            if shifted.is_normal() || damping == 0.0 {
                Ok(part(Dashpot { damping: shifted }))
            } else {
                let range = "such that it fits into double precision when all times are multiplied";
                let found = format!("{damping:?} N s/m, and the factor is {factor:?}");
                Err(InvalidParameter::new("dashpot", range, found))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::ELEMENTS;

    #[test]
    fn laws_without_a_time_are_kept_and_nonlinear_laws_of_the_rate_refused() {
        let mut refused = Vec::new();
        for kind in ELEMENTS {
            let sample = kind.example().unwrap();
            // At a deformation and a rate at which every sample bears a force.
            let is_rated = [0.003, 0.3].map(|rate| sample.force(0.02, rate));
            let is_rated = is_rated[0].to_bits() != is_rated[1].to_bits();
            let is_linear = matches!(sample.law(), Law::Dashpot(_));
            match shifted(&Tree::Part(sample), 3.0) {
                Ok(Tree::Part(own)) => {
                    assert!(is_linear || !is_rated, "{}", kind.word);
                    assert_eq!(own.kind(), kind.word);
                }
                Ok(tree) => panic!("{tree:?}"),
                Err(invalid) => {
                    assert!(is_rated && !is_linear, "{}", kind.word);
                    assert_eq!(invalid.parameter, kind.word);
                    refused.push(kind.word);
                }
            }
        }
        assert!(refused.contains(&"power-dashpot") && refused.contains(&"bumper"));
        assert!(!refused.contains(&"foam") && !refused.contains(&"hysteretic-foam"));
    }
}
