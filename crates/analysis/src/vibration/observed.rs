//! What is looked at: quantities that can be read in more than one way.

use dashpot_dae::frequency::Harmonic;
use dashpot_network::{Assembly, NodeId};
use nalgebra::Complex;

use super::VibrationError;

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

/// A sum of outputs, each with its factor, over `(iω)^order`.
#[derive(Debug, Clone)]
struct Reading {
    sum: Vec<(usize, f64)>,
    order: u32,
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
    fn new(name: &str, readings: Vec<(Option<usize>, u32)>) -> Self {
        let reading = |(output, order): (Option<usize>, u32)| {
            output.map(|at| Reading { sum: vec![(at, 1.0)], order })
        };
        Self { name: name.to_owned(), readings: readings.into_iter().filter_map(reading).collect() }
    }

    /// The displacement of a node \[m\].
    pub(super) fn displacement(assembly: &Assembly, node: NodeId) -> Self {
        let own = &assembly.nodes[node.index()];
        let readings = vec![(Some(own.position), 0), (own.velocity, 1), (own.acceleration, 2)];
        Self::new(&own.name, readings)
    }

    /// The deformation of a connection \[m\], by its number.
    pub(super) fn deformation(assembly: &Assembly, connection: usize) -> Self {
        let own = &assembly.connections[connection];
        Self::new(&own.name, vec![(Some(own.deformation), 0), (own.rate, 1)])
    }

    /// The force of a connection \[N\], by its number; `None` where it is undetermined.
    pub(super) fn force(assembly: &Assembly, connection: usize) -> Option<Self> {
        let own = &assembly.connections[connection];
        own.force.map(|force| Self::new(&own.name, vec![(Some(force), 0)]))
    }

    /// An output over `(iω)^order`.
    pub(super) fn output(name: &str, output: usize, order: u32) -> Self {
        Self::new(name, vec![(Some(output), order)])
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
            let divisor = rate.powu(reading.order);
            let (value, error) = (own.value / divisor, own.error / divisor.norm());
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
    for (at, node) in assembly.nodes.iter().enumerate().filter(|own| !own.1.free) {
        let is_used = assembly.connections.iter().any(|connection| {
            connection
                .between
                .iter()
                .any(|id| id.index() == at || assembly.nodes[id.index()].body == node.body)
                && !connection.is_rigid
        });
        if is_used && found.iter().all(|own| own.0 != node.body) {
            found.push((node.body, node.name.clone()));
        }
    }
    found
}

/// Those of `all` that are named in `of`, in that order; all of them where nothing is named.
pub(super) fn selected(
    all: Vec<Observed>,
    of: &[String],
    sought: &'static str,
) -> Result<Vec<Observed>, VibrationError> {
    if of.is_empty() {
        return Ok(all);
    }
    let named = |name: &String| {
        let unknown = || VibrationError::UnknownNode {
            name: name.clone(),
            sought,
            known: all.iter().map(|own| own.name.clone()).collect(),
        };
        all.iter().find(|own| own.name == *name).cloned().ok_or_else(unknown)
    };
    of.iter().map(named).collect()
}
