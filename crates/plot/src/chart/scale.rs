//! Scales of axes.

/// Decades by which a line may widen a logarithmic axis whatever the range of the data.
const LEAST_ROOM: f64 = 1.0;

/// How values are laid out along an axis.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Scale {
    /// Equal differences at equal distances.
    #[default]
    Linear,
    /// Equal ratios at equal distances, for positive values; others have no place and break a curve.
    ///
    /// The axis is labelled with the quantity alone, as in `time`, and its values are in `unit`: ticks carry the
    /// prefixes that the unit is used with, as in `10 ms`, and otherwise powers of ten, with the unit behind the
    /// quantity.
    Logarithmic {
        /// Unit of the values without prefix, as in `s`, `N/m` or `rad/s`; empty for none.
        unit: String,
    },
}

impl Scale {
    /// A logarithmic scale in this unit.
    pub fn logarithmic(unit: &str) -> Self {
        Self::Logarithmic { unit: unit.to_owned() }
    }

    /// Whether `value` has a place on the scale.
    pub(crate) fn takes(&self, value: f64) -> bool {
        value.is_finite() && (*self == Self::Linear || value > 0.0)
    }

    /// What is proportional to the distance along the axis.
    pub(super) fn coordinate(&self, value: f64) -> f64 {
        if *self == Self::Linear { value } else { value.log10() }
    }

    /// Distance from data between two coordinates within which a line is near.
    pub(super) fn room(&self, low: f64, high: f64) -> f64 {
        match self {
            Self::Linear => (high - low).max(low.abs()).max(high.abs()),
            Self::Logarithmic { .. } => (high - low).max(LEAST_ROOM),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positive_values_have_a_place_on_a_logarithmic_scale() {
        let scale = Scale::logarithmic("s");
        for (value, has_place) in
            [(1e-300, true), (0.0, false), (-1.0, false), (f64::NAN, false), (f64::INFINITY, false)]
        {
            assert_eq!(scale.takes(value), has_place, "{value}");
        }
        assert!(Scale::default().takes(-1.0));
    }
}
