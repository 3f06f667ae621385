//! Dry sliders side by side: one that slides at the sum of their forces, and what each of them
//! bears of it.

use std::collections::HashMap;

use super::expand::Primitive;
use crate::{elements::Law, phases::Phases};

/// The part of another primitive's force that is one's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Share {
    /// Number of the primitive that stands for all of them.
    pub(crate) of: usize,
    /// The part of its whole force; the sign is that of the direction.
    pub(crate) part: f64,
}

impl Share {
    /// The sign of the direction.
    pub(crate) fn sign(self) -> f64 {
        1.0_f64.copysign(self.part)
    }
}

/// Lets the first of all sliders between the same joints stand for them. While they stick, how they
/// share the force is not determined by Coulomb's law; it is shared as when they slide, in
/// proportion to the forces at which they do, so that they let go together.
pub(super) fn share(primitives: &mut [Primitive]) {
    let mut groups: HashMap<[usize; 2], Vec<(usize, f64)>> = HashMap::new();
    for (at, primitive) in primitives.iter().enumerate() {
        let [a, b] = primitive.ends;
        if let Some(capacity) = primitive.origin.phases().and_then(Phases::capacity)
            && a != b
        {
            groups.entry([a.min(b), a.max(b)]).or_default().push((at, capacity));
        }
    }
    for group in groups.into_values().filter(|own| own.len() > 1) {
        let whole: f64 = group.iter().map(|own| own.1).sum();
        let of = group[0].0;
        let ends = primitives[of].ends;
        for (at, capacity) in group {
            let sign = if primitives[at].ends == ends { 1.0 } else { -1.0 };
            primitives[at].share = Some(Share { of, part: sign * capacity / whole });
            if at != of {
                primitives[at].law = Law::Spring(0.0);
            }
        }
    }
}
