//! What is looked at: quantities that can be read in more than one way.

use dashpot_dae::frequency::Harmonic;
use dashpot_network::{Assembly, NodeId, elements::Law};
use nalgebra::Complex;

use super::Swing;

/// A relative error up to which nothing is to be mended.
const CLEAR: f64 = 1e-9;

/// A complex amplitude, in SI units for one unit of the drive.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    pub(super) value: Complex<f64>,
    pub(super) error: f64,
    /// `d ln|value|² / d ln ω`.
    pub(super) rise: f64,
}

impl Found {
    /// Its relative error.
    pub(super) fn threshold(&self) -> f64 {
        self.error / self.value.norm()
    }

    /// Whether it is far from being lost in rounding.
    pub(super) fn is_clear(&self) -> bool {
        self.error <= CLEAR * self.value.norm()
    }
}

/// How a response follows from its parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// It is the only part.
    Value,
    /// It is one over the only part.
    Inverse,
    /// It is the root of a power, and the squares of the parts add up to that.
    Power,
}

impl Form {
    /// The response, from what its parts are.
    pub(super) fn of(self, parts: &[Found]) -> Option<Found> {
        let first = *parts.first()?;
        let found = match self {
            Self::Value => first,
            Self::Inverse => Found {
                value: first.value.inv(),
                error: first.error / first.value.norm_sqr(),
                rise: -first.rise,
            },
            Self::Power => {
                let squares = |own: fn(&Found) -> f64| parts.iter().map(own).sum::<f64>();
                let power = squares(|own| own.value.norm_sqr());
                Found {
                    value: power.sqrt().into(),
                    error: squares(|own| own.error * own.error).sqrt(),
                    rise: squares(|own| own.value.norm_sqr() * own.rise) / power,
                }
            }
        };
        found.value.norm().is_finite().then_some(found)
    }

    /// What is shown of it: a power has no phase.
    pub(super) fn swing(self, found: &Found) -> Swing {
        let Found { value, error, .. } = *found;
        match self {
            Self::Value | Self::Inverse => Swing::of(value, error),
            Self::Power => Swing::of(value * value, (2.0 * value.norm() + error) * error),
        }
    }
}

/// What is looked at over frequency.
#[derive(Debug, Clone)]
pub(super) struct Response {
    /// The node, element or support.
    pub(super) name: String,
    pub(super) form: Form,
    pub(super) parts: Vec<Observed>,
}

impl From<Observed> for Response {
    fn from(part: Observed) -> Self {
        Self { name: part.name.clone(), form: Form::Value, parts: vec![part] }
    }
}

/// A sum of outputs, each with its factor, over `(iω)^order`.
#[derive(Debug, Clone)]
struct Reading {
    sum: Vec<(usize, f64)>,
    order: i32,
}

/// A quantity with the ways to read it.
///
/// A displacement that is small against that of the base is a small difference as it stands, and the acceleration over
/// (iω)² is not; at low frequencies it is the other way round. The one with the smallest error counts.
#[derive(Debug, Clone)]
pub(super) struct Observed {
    /// The node or element.
    pub(super) name: String,
    readings: Vec<Reading>,
}

impl Observed {
    fn new(name: &str, readings: Vec<(Option<usize>, i32)>) -> Self {
        let reading = |(output, order): (Option<usize>, i32)| {
            output.map(|at| Reading { sum: vec![(at, 1.0)], order })
        };
        Self { name: name.to_owned(), readings: readings.into_iter().filter_map(reading).collect() }
    }

    /// The displacement of a node \[m\], or its derivative of this `order` over time.
    pub(super) fn motion(assembly: &Assembly, node: NodeId, order: i32) -> Self {
        let own = &assembly.nodes[node.index()];
        let readings = [Some(own.position), own.velocity, own.acceleration];
        Self::new(&own.name, readings.into_iter().zip(-order..).collect())
    }

    /// The deformation of a connection \[m\], by its number.
    pub(super) fn deformation(assembly: &Assembly, connection: usize) -> Self {
        let own = &assembly.connections[connection];
        Self::new(&own.name, vec![(Some(own.deformation), 0), (own.rate, 1)])
    }

    /// The force of a connection \[N\], by its number; `None` where it is undetermined.
    pub(super) fn force(assembly: &Assembly, connection: usize) -> Option<Self> {
        let own = &assembly.connections[connection];
        own.force.map(|force| Self::output(&own.name, force, 0))
    }

    /// The dashpots of a connection, by its number: each as a root of the mean power that it dissipates \[√W\], of its
    /// rate and of its force.
    pub(super) fn dashpots(assembly: &Assembly, connection: usize) -> Vec<Self> {
        let primitives = &assembly.primitives[assembly.connections[connection].primitives.clone()];
        let root = primitives.iter().filter_map(|own| {
            let Law::Dashpot(damping) = own.element.law() else { return None };
            let rate = own.rate.map(|rate| (rate, (0.5 * damping).sqrt()));
            let force = (own.force, (2.0 * damping).sqrt().recip());
            let reading = |own| Reading { sum: vec![own], order: 0 };
            let readings = rate.into_iter().chain([force]).map(reading).collect();
            Some(Self { name: own.name.to_string(), readings })
        });
        root.collect()
    }

    /// An output over `(iω)^order`.
    pub(super) fn output(name: &str, output: usize, order: i32) -> Self {
        Self::new(name, vec![(Some(output), order)])
    }

    /// The same, or read as a sum of outputs, each with its factor, over `(iω)^order`.
    pub(super) fn or_sum(mut self, sum: Vec<(usize, f64)>, order: i32) -> Self {
        self.readings.push(Reading { sum, order });
        self
    }

    /// The force of all elements on a body that is held \[N\], positive as all forces on nodes.
    pub(super) fn support(assembly: &Assembly, body: usize, name: &str) -> Self {
        let mut sum = Vec::new();
        for connection in &assembly.connections {
            let [a, b] = connection.between.map(|id| assembly.nodes[id.index()].body == body);
            // The masses of layers take their part of the force on the way to the second end.
            let (force, sign) =
                if b { (connection.transmitted, 1.0) } else { (connection.force, -1.0) };
            if let Some(force) = force.filter(|_| a != b) {
                sum.push((force, sign));
            }
        }
        Self { name: name.to_owned(), readings: vec![Reading { sum, order: 0 }] }
    }

    /// Its amplitude where the drive goes as `e^{st}` with the complex `rate` s \[1/s\]; `None` where it
    /// cannot be read. The rise is that on the imaginary axis.
    pub(super) fn at(&self, harmonic: &Harmonic<'_>, rate: Complex<f64>) -> Option<Found> {
        let read = |reading: &Reading| {
            if rate == Complex::default() && reading.order > 0 {
                return None;
            }
            let own = harmonic.amplitude(&reading.sum);
            let power = rate.powu(reading.order.unsigned_abs());
            let (value, error) = if reading.order < 0 {
                (own.value * power, own.error * power.norm())
            } else {
                (own.value / power, own.error / power.norm())
            };
            let rise = 2.0 * (rate.im * (own.slope / own.value).re - f64::from(reading.order));
            let is_finite = value.re.is_finite() && value.im.is_finite() && error.is_finite();
            is_finite.then_some(Found { value, error, rise })
        };
        self.readings.iter().filter_map(read).min_by(|a, b| a.error.total_cmp(&b.error))
    }
}

/// The first node of each of the held bodies, with the number of the body.
pub(super) fn supports(assembly: &Assembly) -> Vec<(usize, String)> {
    let mut found: Vec<(usize, String)> = Vec::new();
    for node in assembly.nodes.iter().filter(|own| !own.free) {
        let is_own = |id: &NodeId| assembly.nodes[id.index()].body == node.body;
        let mut connections = assembly.connections.iter();
        let is_used = connections.any(|own| !own.is_rigid && own.between.iter().any(is_own));
        if is_used && found.iter().all(|own| own.0 != node.body) {
            found.push((node.body, node.name.clone()));
        }
    }
    found
}
