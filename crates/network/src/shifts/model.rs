//! Models with shifted times.

use std::sync::Arc;

use dashpot_rheology::{Branch, Tree};

use crate::{
    Element, Model,
    elements::{Dashpot, Law},
    network::part,
    parameters::{InvalidParameter, positive},
};

/// The model with all its times multiplied by `factor` \[1\], which is positive: every dashpot
/// constant is multiplied by it, and all else is kept.
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
/// [`InvalidParameter`] when the factor is not positive and finite, or when a dashpot constant
/// does not fit into double precision.
pub fn shifted(model: &Model, factor: f64) -> Result<Model, InvalidParameter> {
    enum Step<'m> {
        Enter(&'m Model),
        Leave(&'m Model),
    }
    positive("factor", factor)?;
    let mut done: Vec<Model> = Vec::new();
    // Models nest without limit, so the way back is kept here and not on the stack.
    let mut steps = vec![Step::Enter(model)];
    while let Some(step) = steps.pop() {
        match step {
            Step::Enter(Tree::Part(element)) => done.push(shifted_element(element, factor)?),
            Step::Enter(tree) => {
                steps.push(Step::Leave(tree));
                steps.extend(tree.branches().iter().rev().map(|own| Step::Enter(&own.tree)));
            }
            Step::Leave(tree) => {
                let own = tree.branches();
                let trees = done.split_off(done.len() - own.len());
                let named = own.iter().zip(trees).map(|(old, tree)| Branch::new(&old.name, tree));
                let branches = named.collect();
                done.push(match tree {
                    Tree::Parallel(_) => Tree::Parallel(branches),
                    _ => Tree::Series(branches),
                });
            }
        }
    }
    Ok(done.pop().unwrap_or_else(|| Tree::Series(Vec::new())))
}

fn shifted_element(element: &Arc<dyn Element>, factor: f64) -> Result<Model, InvalidParameter> {
    match element.law() {
        Law::Spring(_) | Law::Rigid => Ok(Tree::Part(Arc::clone(element))),
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
