//! Units in which people read an impact or a test.

/// A unit on an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unit {
    /// SI value of one unit.
    pub(super) factor: f64,
    symbol: &'static str,
    /// Smallest magnitude \[SI\] that is read in this unit.
    from: f64,
}

const fn unit(symbol: &'static str, factor: f64, from: f64) -> Unit {
    Unit { factor, symbol, from }
}

// Descending; the second one is the usual one in an impact.
pub(super) const TIME: [Unit; 3] =
    [unit("s", 1.0, 2.0), unit("ms", 1e-3, 5e-4), unit("µs", 1e-6, 0.0)];
pub(super) const LENGTH: [Unit; 3] =
    [unit("m", 1.0, 2.0), unit("mm", 1e-3, 1e-4), unit("µm", 1e-6, 0.0)];
pub(super) const FORCE: [Unit; 4] =
    [unit("MN", 1e6, 5e6), unit("kN", 1e3, 5e2), unit("N", 1.0, 0.5), unit("mN", 1e-3, 0.0)];
// Standard gravity is a unit of what acts on bodies.
pub(super) const ACCELERATION: [Unit; 2] = [unit("g", 9.806_65, 0.2), unit("m/s²", 1.0, 0.0)];
pub(super) const VELOCITY: [Unit; 2] = [unit("m/s", 1.0, 0.02), unit("mm/s", 1e-3, 0.0)];
pub(super) const ENERGY: [Unit; 3] =
    [unit("kJ", 1e3, 1e4), unit("J", 1.0, 0.5), unit("mJ", 1e-3, 0.0)];
pub(super) const STRESS: [Unit; 4] =
    [unit("GPa", 1e9, 5e9), unit("MPa", 1e6, 5e5), unit("kPa", 1e3, 5e2), unit("Pa", 1.0, 0.0)];
pub(super) const STRAIN: [Unit; 2] = [unit("1", 1.0, 2.0), unit("%", 1e-2, 0.0)];

impl Unit {
    /// The unit for such values \[SI\].
    pub(super) fn of(units: &[Self], values: impl Iterator<Item = f64>) -> Self {
        let largest = values.map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
        let usual = units[1];
        if largest > 0.0 {
            *units.iter().find(|u| largest >= u.from).unwrap_or(&usual)
        } else {
            usual
        }
    }

    /// `quantity (unit)`.
    pub(super) fn label(self, quantity: &str) -> String {
        format!("{quantity} ({})", self.symbol)
    }

    /// As on an axis.
    pub(super) fn symbol(self) -> &'static str {
        self.symbol
    }

    /// The number for a value \[SI\], with as many decimals as show three figures of `span` \[SI\].
    pub(super) fn number_within(self, value: f64, span: f64) -> String {
        let size = (span / self.factor).log10().floor();
        let decimals = (0..9_i32).find(|own| f64::from(*own) >= 2.0 - size).unwrap_or(9);
        let round = 10_f64.powi(decimals);
        // A zero has no sign.
        format!("{}", (value / self.factor * round).round() / round + 0.0)
    }

    /// A value \[SI\] with three figures or more and this unit, as in `20 mm`.
    pub(super) fn print(self, value: f64) -> String {
        let rounded = (value / self.factor * 1e3).round() / 1e3;
        format!("{rounded} {}", self.symbol)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impacts_are_read_in_milliseconds_millimetres_and_kilonewtons() {
        assert_eq!(Unit::of(&TIME, [0.0, 0.02].into_iter()).label("time"), "time (ms)");
        assert_eq!(
            Unit::of(&LENGTH, [-0.0175].into_iter()).label("deformation"),
            "deformation (mm)"
        );
        assert_eq!(Unit::of(&FORCE, [38_400.0, f64::NAN].into_iter()).label("force"), "force (kN)");
        assert_eq!(Unit::of(&ENERGY, [500.0].into_iter()).label("energy"), "energy (J)");
    }

    #[test]
    fn other_magnitudes_get_units_of_their_own_and_zero_the_usual_one() {
        assert_eq!(Unit::of(&FORCE, [12.0].into_iter()).label("force"), "force (N)");
        assert_eq!(Unit::of(&TIME, [100.0].into_iter()).label("time"), "time (s)");
        assert_eq!(Unit::of(&LENGTH, std::iter::empty()).label("y"), "y (mm)");
        assert_eq!(Unit::of(&LENGTH, [0.02].into_iter()).print(0.02), "20 mm");
    }

    #[test]
    fn ends_of_a_span_have_the_decimals_that_tell_them_apart() {
        let ms = Unit::of(&TIME, [0.6].into_iter());
        assert_eq!(ms.number_within(0.552_132, 0.0124), "552.1");
        assert_eq!(ms.number_within(0.496_4, 0.68), "496");
        assert_eq!(ms.number_within(0.0, 0.68), "0");
        assert_eq!(ms.number_within(1.0, 0.0), "1000");
    }
}
