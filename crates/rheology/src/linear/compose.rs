//! Models composed of models.

use dashpot_numerics::DoubleDouble;

use super::{Canonical, Fractions, LinearModel, Merged, Merger, Primitive};
use crate::Tree;

/// A model in the form in which it was composed; the other form costs more and is made on demand.
#[derive(Debug, Clone)]
enum Half {
    /// A sum of relaxances; zero for a model that bears no force.
    Maxwell(Fractions),
    /// A sum of retardances; zero for a rigid link.
    Kelvin(Fractions),
}

use Half::{Kelvin, Maxwell};

impl Half {
    fn primitive(primitive: Primitive) -> Self {
        let only = |at_zero: f64, constant: f64| Fractions {
            at_zero: DoubleDouble::from(at_zero),
            constant: DoubleDouble::from(constant),
            lines: Vec::new(),
        };
        match primitive {
            Primitive::Spring(stiffness) => Maxwell(only(stiffness, 0.0)),
            Primitive::Dashpot(damping) => Maxwell(only(0.0, damping)),
            Primitive::Rigid => Kelvin(Fractions::default()),
        }
    }

    /// The relaxance, `None` where it is infinite.
    fn relaxance(self) -> Option<Fractions> {
        match self {
            Maxwell(form) => Some(form),
            Kelvin(form) => (!form.is_zero()).then(|| form.reciprocal()),
        }
    }

    /// The retardance, `None` where it is infinite.
    fn retardance(self) -> Option<Fractions> {
        match self {
            Kelvin(form) => Some(form),
            Maxwell(form) => (!form.is_zero()).then(|| form.reciprocal()),
        }
    }

    fn composed(parts: Vec<Self>, in_series: bool, merged: &mut Vec<Merged>) -> Self {
        let form = if in_series { Canonical::Kelvin } else { Canonical::Maxwell };
        let half = if in_series { Self::retardance } else { Self::relaxance };
        // One part that bears no force, or that is rigid among parallel ones, decides alone.
        let Some(parts) = parts.into_iter().map(half).collect::<Option<Vec<_>>>() else {
            let nothing = Fractions::default();
            return if in_series { Maxwell(nothing) } else { Kelvin(nothing) };
        };
        let mut mergers = Vec::new();
        let sum = Fractions::sum(&parts.iter().collect::<Vec<_>>(), &mut mergers);
        merged.extend(mergers.into_iter().map(|Merger { rate, gap, count }| Merged {
            form,
            time: rate.recip(),
            gap,
            count,
        }));
        if in_series { Kelvin(sum) } else { Maxwell(sum) }
    }
}

impl From<Primitive> for LinearModel {
    fn from(primitive: Primitive) -> Self {
        Self::primitive(primitive)
    }
}

impl LinearModel {
    /// A single spring, dashpot or rigid link. A spring or dashpot with the constant zero bears no force.
    pub fn primitive(primitive: Primitive) -> Self {
        Self::finished(Half::primitive(primitive), Vec::new())
    }

    /// Models in series: one force, deformations add up. No model at all is rigid.
    pub fn series(parts: &[Self]) -> Self {
        Self::composed(parts, true)
    }

    /// Models in parallel: one deformation, forces add up. No model at all bears no force.
    pub fn parallel(parts: &[Self]) -> Self {
        Self::composed(parts, false)
    }

    /// The model of a tree; `leaf` says what its parts are. The depth of the tree has no limit.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_rheology::{LinearModel, Primitive::{Dashpot, Spring}, Tree};
    ///
    /// let maxwell = Tree::series([Spring(2e6).into(), Dashpot(4e3).into()]);
    /// let model = LinearModel::of(&maxwell, |&part| part);
    /// assert!((model.maxwell().unwrap().elements()[0].relaxation_time - 2e-3).abs() < 1e-18);
    /// ```
    pub fn of<P>(tree: &Tree<P>, mut leaf: impl FnMut(&P) -> Primitive) -> Self {
        let mut merged = Vec::new();
        let whole = tree.fold(
            |part| Half::primitive(leaf(part)),
            |node, parts| Half::composed(parts, node.is_series(), &mut merged),
        );
        Self::finished(whole, merged)
    }

    fn composed(parts: &[Self], in_series: bool) -> Self {
        let half = |own: &Self| match (&own.maxwell, &own.kelvin) {
            (Some(form), _) if !in_series => Maxwell(form.0.clone()),
            (_, Some(form)) => Kelvin(form.0.clone()),
            (Some(form), None) => Maxwell(form.0.clone()),
            (None, None) => Maxwell(Fractions::default()),
        };
        let mut merged: Vec<Merged> = parts.iter().flat_map(|part| part.merged.clone()).collect();
        let whole = Half::composed(parts.iter().map(half).collect(), in_series, &mut merged);
        Self::finished(whole, merged)
    }

    fn finished(half: Half, merged: Vec<Merged>) -> Self {
        match half {
            Maxwell(form) => Self::of_maxwell(form, merged),
            Kelvin(form) => Self::of_kelvin(form, merged),
        }
    }
}
