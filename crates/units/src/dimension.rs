//! Physical dimensions and their SI units.

use crate::Exponent;

/// Physical dimension as exponents of kilogram, metre, second and kelvin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Dimension {
    /// Exponent of mass.
    pub mass: Exponent,
    /// Exponent of length.
    pub length: Exponent,
    /// Exponent of time.
    pub time: Exponent,
    /// Exponent of temperature.
    pub temperature: Exponent,
}

impl Dimension {
    /// A pure number.
    pub const NUMBER: Self = Self::new(0, 0, 0);
    /// Mass \[kg\].
    pub const MASS: Self = Self::new(1, 0, 0);
    /// Length \[m\].
    pub const LENGTH: Self = Self::new(0, 1, 0);
    /// Time \[s\].
    pub const TIME: Self = Self::new(0, 0, 1);
    /// Frequency \[Hz\].
    pub const FREQUENCY: Self = Self::new(0, 0, -1);
    /// Velocity \[m/s\].
    pub const VELOCITY: Self = Self::new(0, 1, -1);
    /// Acceleration \[m/s²\].
    pub const ACCELERATION: Self = Self::new(0, 1, -2);
    /// Force \[N\].
    pub const FORCE: Self = Self::new(1, 1, -2);
    /// Stiffness \[N/m\].
    pub const STIFFNESS: Self = Self::new(1, 0, -2);
    /// Damping \[N s/m\].
    pub const DAMPING: Self = Self::new(1, 0, -1);
    /// Impulse \[N s\].
    pub const IMPULSE: Self = Self::new(1, 1, -1);
    /// Energy \[J\].
    pub const ENERGY: Self = Self::new(1, 2, -2);
    /// Pressure, stress or elastic modulus \[Pa\].
    pub const PRESSURE: Self = Self::new(1, -1, -2);
    /// Viscosity \[Pa s\].
    pub const VISCOSITY: Self = Self::new(1, -1, -1);
    /// Compliance of a pad, the inverse of a stiffness \[m/N\].
    pub const COMPLIANCE: Self = Self::new(-1, 0, 2);
    /// Temperature \[K\], above absolute zero or as a difference.
    pub const TEMPERATURE: Self = Self { temperature: Exponent::whole(1), ..Self::NUMBER };

    const NAMED: [(Self, &'static str, &'static str); 16] = [
        (Self::NUMBER, "number", "1"),
        (Self::MASS, "mass", "kg"),
        (Self::LENGTH, "length", "m"),
        (Self::TIME, "time", "s"),
        (Self::FREQUENCY, "frequency", "Hz"),
        (Self::VELOCITY, "velocity", "m/s"),
        (Self::ACCELERATION, "acceleration", "m/s^2"),
        (Self::FORCE, "force", "N"),
        (Self::STIFFNESS, "stiffness", "N/m"),
        (Self::DAMPING, "damping", "N s/m"),
        (Self::IMPULSE, "impulse", "N s"),
        (Self::ENERGY, "energy", "J"),
        (Self::PRESSURE, "pressure", "Pa"),
        (Self::VISCOSITY, "viscosity", "Pa s"),
        (Self::COMPLIANCE, "compliance", "m/N"),
        (Self::TEMPERATURE, "temperature", "K"),
    ];

    /// The dimension kg^mass m^length s^time, without temperature.
    pub const fn new(mass: i8, length: i8, time: i8) -> Self {
        let [mass, length, time] =
            [Exponent::whole(mass), Exponent::whole(length), Exponent::whole(time)];
        Self { mass, length, time, temperature: Exponent::ZERO }
    }

    /// That of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        Self {
            mass: self.mass - other.mass,
            length: self.length - other.length,
            time: self.time - other.time,
            temperature: self.temperature - other.temperature,
        }
    }

    /// That of a product with a `power` of another one; `None` where an [`Exponent`] cannot be had.
    pub fn times(self, other: Self, power: f64) -> Option<Self> {
        Some(Self {
            mass: self.mass.plus(other.mass, power)?,
            length: self.length.plus(other.length, power)?,
            time: self.time.plus(other.time, power)?,
            temperature: self.temperature.plus(other.temperature, power)?,
        })
    }

    /// All dimensions that have a name.
    pub fn all_named() -> impl Iterator<Item = Self> {
        Self::NAMED.iter().map(|entry| entry.0)
    }

    /// The quantity's name and SI unit, for the dimensions that have one.
    pub fn named(self) -> Option<(&'static str, &'static str)> {
        Self::NAMED.iter().find(|entry| entry.0 == self).map(|entry| (entry.1, entry.2))
    }
}

/// What is a force, or one times a time, by powers of a length, such as the constant of a cubic spring: `N/m^3`.
fn of_forces(dimension: Dimension) -> Option<String> {
    let Dimension { mass, length, time, temperature } = dimension;
    if mass != 1 || temperature != 0 || (time != -2 && time != -1) {
        return None;
    }
    let force = if time == -2 { "N" } else { "N s" };
    let per = |power: Exponent| if power == 1 { "m".to_owned() } else { format!("m^{power}") };
    let power = length - 1;
    Some(match power.value() {
        0.0 => force.to_owned(),
        0.0.. => format!("{force} {}", per(power)),
        _ => format!("{force}/{}", per(-power)),
    })
}

/// The SI unit of a dimension, with a name of its own or as a product of powers.
pub fn si_unit(dimension: Dimension) -> String {
    if let Some((_, unit)) = dimension.named() {
        return unit.to_owned();
    }
    if let Some(unit) = of_forces(dimension) {
        return unit;
    }
    let powers = [
        ("kg", dimension.mass),
        ("m", dimension.length),
        ("s", dimension.time),
        ("K", dimension.temperature),
    ];
    let factor = |(unit, power): (&str, Exponent)| match power {
        Exponent::ZERO => None,
        power if power == 1 => Some(unit.to_owned()),
        power => Some(format!("{unit}^{power}")),
    };
    powers.into_iter().filter_map(factor).collect::<Vec<_>>().join(" ")
}
