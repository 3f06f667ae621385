//! Frequency sweep.

use std::f64::consts::TAU;

use dashpot_dae::{
    Piece, Waveform,
    frequency::{Amplitude, FrequencyResponse},
};
use dashpot_network::{
    Model, Network, Node, parameters,
    parameters::{InvalidParameter, Kind as _},
};
use nalgebra::Complex;

use super::{POINTS, USUAL_POINTS, deforms, points_used, setting};
use crate::{
    Choice, Column,
    rheometer::{
        FROM_THE_MODEL, Figure, Note, Obstacle, ProtocolKind, RheometerError, RheometerReport,
        Specimen, Tested,
        history::logarithmic,
        report::{Computation, Computed, Disagreement, Series},
        specimen::highest_loss_factor,
    },
};

/// Name of the independent computation.
const METHOD: &str = "network at s = iω";
/// How far beyond the frequencies of its slowest and fastest time a model is looked at.
const BEYOND: f64 = 100.0;

parameters! {
    /// Steady oscillation over frequency: storage `k′`, loss `k″` and `tan δ = k″/k′` with
    /// `Q(iω) = k′ + i k″` and `ω = 2π f`.
    ///
    /// The independent computation solves the equations of the network at `s = iω`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Sweep: "sweep", "steady oscillation; storage, loss and tan δ over frequency" {
        /// lowest frequency [Hz], positive; else 1/100 of 1/(2π × the slowest time)
        pub from: Option<f64> = Quantity(Dimension::FREQUENCY),
            default FROM_THE_MODEL, range Positive;
        /// highest frequency [Hz], above the lowest; else 100 times 1/(2π × the fastest time)
        pub to: Option<f64> = Quantity(Dimension::FREQUENCY),
            default FROM_THE_MODEL, range Positive;
        /// How many frequencies are looked at, 2 or more.
        pub points: usize => POINTS;
    }
    default { from: None, to: None, points: USUAL_POINTS }
}

impl ProtocolKind for Sweep {
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested {
        let Some(linear) = specimen.linear() else {
            let kind = specimen.nonlinear().unwrap_or("model");
            return Err(RheometerError::NeedsLinear { protocol: Self::KIND, kind });
        };
        deforms(Self::KIND, specimen)?;
        let (fastest, slowest) = specimen.range_of_times();
        let from = setting("from", "Hz", self.from, 1.0 / (BEYOND * TAU * slowest));
        let to = setting("to", "Hz", self.to, BEYOND / (TAU * fastest));
        if !(to.value.is_finite() && to.value > from.value) {
            let range = format!("finite and above the lowest, {} Hz", from.value);
            return Err(InvalidParameter::new("to", range, to.value).into());
        }
        let frequencies = logarithmic(from.value, to.value, self.points);
        let own = |frequency: &f64| {
            let omega = TAU * frequency;
            Complex::new(linear.storage(omega), linear.loss(omega))
        };
        let model: Vec<Complex<f64>> = frequencies.iter().map(own).collect();
        let factors =
            frequencies.iter().map(|frequency| linear.loss_factor(TAU * frequency)).collect();
        let mut report = RheometerReport {
            protocol: Self::KIND,
            settings: vec![from, to, points_used(self.points)],
            series: vec![
                series("storage stiffness", "N/m", model.iter().map(|own| own.re).collect()),
                series("loss stiffness", "N/m", model.iter().map(|own| own.im).collect()),
                series("loss factor", "1", factors),
            ],
            abscissa: Column { name: "frequency".to_owned(), unit: "Hz", values: frequencies },
            drive: None,
            figures: specimen.figures(),
            computations: Vec::new(),
            notes: Vec::new(),
        };
        if !methods.is_empty() {
            compute(&mut report, specimen, &model);
        }
        add_peak(&mut report, specimen);
        Ok(report)
    }
}

fn series(name: &'static str, unit: &'static str, model: Vec<f64>) -> Series {
    Series { name, unit, model, computed: Vec::new() }
}

/// Adds the independent computation.
fn compute(report: &mut RheometerReport, specimen: &Specimen, model: &[Complex<f64>]) {
    let (fastest, slowest) = specimen.range_of_times();
    let frequencies = &report.abscissa.values;
    let time = fastest.sqrt() * slowest.sqrt();
    let (found, obstacle) = match shaken(specimen.model(), time, frequencies) {
        Ok(found) => (found, None),
        Err(reason) => (vec![None; frequencies.len()], Some(reason)),
    };
    let relative =
        |own: &Amplitude| if own.error == 0.0 { 0.0 } else { own.error / own.value.norm() };
    let stated = found.iter().flatten().map(relative).reduce(f64::max);
    let found: Vec<_> = found.into_iter().map(|own| own.map(|own| own.value)).collect();
    for (series, quantity) in report.series.iter_mut().zip(&QUANTITIES) {
        let difference = quantity.largest(model, &found, frequencies);
        let difference = difference.map(|difference| Disagreement { stated, ..difference });
        let values = found.iter().map(|value| value.map(quantity.read)).collect();
        series.computed.push(Computed { values, difference, error: None });
    }
    let reach = frequencies.iter().zip(&found).filter(|(_, value)| value.is_some());
    let reach = reach.map(|(&frequency, _)| frequency).reduce(f64::max);
    report.computations.push(Computation { method: METHOD, reach, obstacle });
}

/// The force over the deformation \[N/m\] of the network of `model` whose head moves to and fro at each of the
/// `frequencies` \[Hz\], `None` where its equations have no finite solution; or why there is no network. `time` \[s\]
/// is what its times are like.
fn shaken(
    model: &Model,
    time: f64,
    frequencies: &[f64],
) -> Result<Vec<Option<Amplitude>>, Obstacle> {
    let wave = Piece { sine: 1.0, omega: 1.0 / time, ..Piece::default() };
    let motion = Waveform::new(vec![wave]).ok_or(Obstacle::OutOfRange)?;
    let mut network = Network::new();
    let head = network.add_node(Node::prescribed("head", motion));
    network.connect("model", head, network.ground(), model.clone());
    let assembly = network.compile(time)?;
    let force = assembly.connections.first().and_then(|connection| connection.force);
    let force = force.ok_or(Obstacle::Undetermined)?;
    let unit = assembly.system.waveforms.first().map_or(0.0, |own| own.pieces()[0].sine);
    let units = [unit];
    let response = FrequencyResponse::new(&assembly.system, &units);
    let at =
        |frequency: &f64| Some(response.as_ref()?.at(TAU * frequency)?.amplitude(&[(force, 1.0)]));
    Ok(frequencies.iter().map(at).collect())
}

/// What a series of a sweep shows, and how far two values are apart.
struct Quantity {
    read: fn(Complex<f64>) -> f64,
    distance: fn(Complex<f64>, Complex<f64>) -> f64,
    /// What the distance is taken relative to.
    scale: fn(Complex<f64>) -> f64,
}

/// In the order of the series.
const QUANTITIES: [Quantity; 3] = [
    Quantity {
        read: |own| own.re,
        distance: |own, other| (own.re - other.re).abs(),
        scale: |own| own.norm(),
    },
    Quantity {
        read: |own| own.im,
        distance: |own, other| (own.im - other.im).abs(),
        scale: |own| own.norm(),
    },
    Quantity {
        read: loss_factor,
        // The loss angle is finite where the loss factor is not.
        distance: |own, other| (other * own.conj()).arg().abs(),
        scale: |_| 1.0,
    },
];

impl Quantity {
    /// The largest relative difference.
    fn largest(
        &self,
        own: &[Complex<f64>],
        other: &[Option<Complex<f64>>],
        frequencies: &[f64],
    ) -> Option<Disagreement> {
        let pairs = own.iter().zip(other).zip(frequencies);
        let differences = pairs.filter_map(|((&own, &other), &at)| {
            let size = (self.distance)(own, other?);
            let relative = if size == 0.0 { 0.0 } else { size / (self.scale)(own) };
            Some(Disagreement { largest: size, at, relative, stated: None })
        });
        differences.max_by(|one, other| one.relative.total_cmp(&other.relative))
    }
}

fn loss_factor(stiffness: Complex<f64>) -> f64 {
    if stiffness.im == 0.0 { 0.0 } else { stiffness.im / stiffness.re }
}

/// Adds the highest loss factor and its frequency.
fn add_peak(report: &mut RheometerReport, specimen: &Specimen) {
    let peak = highest_loss_factor(specimen);
    let figure = |name, unit, value: Option<f64>| {
        Figure::of(name, unit, value.unwrap_or(f64::NAN)).noting(Note::NoLossPeak)
    };
    report.figures.push(figure("peak of the loss factor", "1", peak.map(|peak| peak.1)));
    report.figures.push(figure("frequency of the peak", "Hz", peak.map(|peak| peak.0 / TAU)));
    let Some(linear) = specimen.linear() else { return };
    if linear.kelvin().is_none() {
        report.notes.push(Note::NoForce);
        return;
    }
    if linear.equilibrium_stiffness() == 0.0 {
        report.notes.push(Note::LiquidLoss);
    }
    if linear.maxwell().is_some_and(|form| form.dashpot() > 0.0) {
        report.notes.push(Note::DashpotLoss);
    }
}
