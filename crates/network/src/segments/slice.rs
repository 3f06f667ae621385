//! A part of a layer, as a model.

use std::sync::Arc;

use dashpot_rheology::{Branch, Tree};

use crate::{
    Element, Model,
    elements::{Dashpot, Law, Spring, Tangent},
    parameters::{Described, InvalidParameter, Parameter, Value, described_as},
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// The model of one of `count` equal slices of a layer, of which `count` in series have the law of
/// the layer, `F(y) = layer(count · y)`.
pub(super) fn slice(layer: &Model, count: f64) -> Model {
    layer.fold(
        |element| Tree::Part(slice_of(element, count)),
        |tree, parts| {
            let named = tree.branches().iter().zip(parts);
            let branches = named.map(|(own, tree)| Branch::new(own.name.clone(), tree)).collect();
            if tree.is_series() { Tree::Series(branches) } else { Tree::Parallel(branches) }
        },
    )
}

fn slice_of(element: &Arc<dyn Element>, count: f64) -> Arc<dyn Element> {
    match element.law() {
        Law::Spring(stiffness) if element.push() == 0.0 => {
            Arc::new(Spring { stiffness: stiffness * count })
        }
        Law::Dashpot(damping) => Arc::new(Dashpot { damping: damping * count }),
        Law::Rigid => Arc::clone(element),
        Law::Spring(_) | Law::Nonlinear { .. } | Law::Phased => {
            Arc::new(Slice { of: Arc::clone(element), count })
        }
    }
}

/// The law with slopes that are `count` times those of `law`.
fn times(law: Law, count: f64) -> Law {
    match law {
        Law::Spring(stiffness) => Law::Spring(stiffness * count),
        Law::Dashpot(damping) => Law::Dashpot(damping * count),
        Law::Nonlinear { stiffness, damping } => {
            Law::Nonlinear { stiffness: stiffness * count, damping: damping * count }
        }
        Law::Rigid | Law::Phased => law,
    }
}

/// A slice of an element that is no spring and no dashpot: `F(y, ẏ) = f(n y, n ẏ)`.
#[derive(Debug, Clone)]
struct Slice {
    of: Arc<dyn Element>,
    /// The number `n` of slices in series that have the law of the element.
    count: f64,
}

impl Described for Slice {
    described_as!(of);
}

impl Element for Slice {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.of.force(self.count * deformation, self.count * rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let whole = self.of.tangent(self.count * deformation, self.count * rate);
        Tangent { stiffness: self.count * whole.stiffness, damping: self.count * whole.damping }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.of.stored(self.count * deformation) / self.count
    }

    fn law(&self) -> Law {
        times(self.of.law(), self.count)
    }

    fn grows_from(&self) -> Option<f64> {
        self.of.grows_from().map(|own| own / self.count)
    }

    fn reflected(&self, sum: f64, damping: f64) -> Option<[f64; 2]> {
        // The rate is divided by what the damping is multiplied by.
        self.of.reflected(sum, damping / self.count)
    }

    fn phases(&self) -> Option<&dyn Phases> {
        self.of.phases().map(|_| self as &dyn Phases)
    }

    fn push(&self) -> f64 {
        self.of.push()
    }

    fn range(&self) -> Option<(f64, f64)> {
        self.of.range().map(|(first, last)| (first / self.count, last / self.count))
    }
}

impl Slice {
    /// A phase of the slice as one of the element.
    fn whole(&self, phase: Phase) -> Phase {
        Phase { memory: phase.memory * self.count, ..phase }
    }
}

impl Phases for Slice {
    fn names(&self) -> &'static [&'static str] {
        self.of.phases().map_or(&[], Phases::names)
    }

    fn first(&self, deformation: f64) -> Phase {
        let whole = self.of.phases().map(|phase| phase.first(self.count * deformation));
        let whole = whole.unwrap_or(Phase { index: 0, memory: 0.0 });
        Phase { memory: whole.memory / self.count, ..whole }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        match self.of.phases().map(|own| own.law(self.whole(phase))) {
            Some(PhaseLaw::Held(deformation)) => PhaseLaw::Held(deformation / self.count),
            Some(PhaseLaw::Element(element)) => PhaseLaw::Element(slice_of(&element, self.count)),
            Some(law) => law,
            None => PhaseLaw::Open,
        }
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        let exits = self.of.phases().map(|own| own.exits(self.whole(phase))).unwrap_or_default();
        let scaled = exits.into_iter().map(|exit| match exit.watched {
            Watched::Force => exit,
            Watched::Deformation | Watched::Rate => Exit { level: exit.level / self.count, ..exit },
        });
        scaled.collect()
    }

    fn at_rest(&self) -> Option<Law> {
        let whole = self.of.phases().and_then(Phases::at_rest)?;
        Some(times(whole, self.count))
    }

    fn restitution(&self) -> f64 {
        self.of.phases().map_or(0.0, Phases::restitution)
    }
}
