mod injury;
mod jumps;
mod transmitted;

use std::f64::consts::PI;

use dashpot_dae::{Dense, Outcome, Panel, Signal, Statistics, System, Trajectory};
use dashpot_network::{
    Assembly, Model, Network, Node,
    elements::{Dashpot, Spring},
    parameters::{Value, WindowWish},
    part,
};
use dashpot_numerics::chebyshev::{Coefficients, Interpolation};

use super::*;
use crate::{Counted, Note};

/// A function in so many panels of degree 15.
pub(super) fn panels(end: f64, count: u32, function: impl Fn(f64) -> f64) -> Vec<Panel> {
    let interpolation = Interpolation::of_degree(15);
    let border = |at: u32| end * f64::from(at) / f64::from(count);
    let panels = (0..count).map(|at| {
        let (start, end) = (border(at), border(at + 1));
        let time = |x: &f64| 0.5 * (start + end) + 0.5 * (end - start) * x;
        let values: Vec<f64> = interpolation.nodes().iter().map(|x| function(time(x))).collect();
        let mut coefficients = Coefficients::zeros(16);
        interpolation.coefficients(&values, &mut coefficients);
        Panel { start, end, coefficients }
    });
    panels.collect()
}

/// A solution written down as functions of time.
struct Written {
    end: f64,
    signal: fn(&str, f64) -> f64,
}

impl std::fmt::Debug for Written {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Written until {}", self.end)
    }
}

impl Dense for Written {
    fn signal(&self, system: &System, output: usize) -> Signal {
        let output = system.outputs.at(output);
        let name = output.name.to_string();
        let value = |time: f64| (self.signal)(&name, time);
        Signal::new(panels(self.end, 8, value), Some(1e-9), 1e-13)
    }

    fn sample(&self, _system: &System, _times: &[f64]) -> Vec<f64> {
        Vec::new()
    }
}

fn scene() -> Assembly {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 2.0).moving(1.0));
    let ground = network.ground();
    let parts = [part(Spring { stiffness: 1.0 }), part(Dashpot { damping: 1.0 })];
    network.connect("pad", head, ground, Model::parallel(parts));
    network.compile(1.0).unwrap()
}

#[expect(clippy::needless_pass_by_value, reason = "measures are written down in the call")]
fn read(measure: impl Measure, end: f64, signal: fn(&str, f64) -> f64) -> Reading {
    read_of(&measure, end, signal)
}

fn read_of(measure: &dyn Measure, end: f64, signal: fn(&str, f64) -> f64) -> Reading {
    let assembly = scene();
    let trajectory = Trajectory {
        method: "written",
        outcome: Outcome::Finished,
        t_end: end,
        events: Vec::new(),
        first_phases: Vec::new(),
        switches: Vec::new(),
        statistics: Statistics::default(),
        dense: Box::new(Written { end, signal }),
    };
    let solution = Solution::new(&assembly, &trajectory);
    // The pad is element 0, the head node 1.
    let target = usize::from(measure.applies_to() == Family::Node);
    measure.read(&solution, target)
}

fn close(found: Option<f64>, expected: f64, relative: f64) {
    let found = found.expect("a value");
    let tolerance = relative * expected.abs().max(1e-3);
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

/// A half-sine push of the pad for 1 s, then a pull; the head feels it.
fn half_sine(name: &str, t: f64) -> f64 {
    match name {
        "pad.force" => 40.0 * STANDARD_GRAVITY * (PI * t).sin(),
        "head.acceleration" => -20.0 * STANDARD_GRAVITY * (PI * t).sin(),
        "pad.deformation" | "head.position" => 0.1 * (PI * t).sin(),
        _ => 0.1 * PI * (PI * t).cos(),
    }
}

#[test]
fn half_sine_impact_has_its_closed_forms() {
    let g = STANDARD_GRAVITY;
    let at = |measure: &dyn Fn() -> Reading| measure().value;
    close(at(&|| read(PeakForce::default(), 1.6, half_sine)), 40.0 * g, 1e-12);
    close(read(PeakForce::default(), 1.6, half_sine).time, 0.5, 1e-6);
    close(at(&|| read(PeakDeformation::default(), 1.6, half_sine)), 0.1, 1e-12);
    close(at(&|| read(PeakRate::default(), 1.6, half_sine)), 0.1 * PI, 1e-12);
    close(at(&|| read(ContactTime {}, 1.6, half_sine)), 1.0, 1e-13);
    close(at(&|| read(Impulse::default(), 1.6, half_sine)), 80.0 * g / PI, 1e-12);
    close(at(&|| read(Energy::default(), 1.6, half_sine)), 0.0, 1e-9);
    let until = 40.0 * g * 0.1 * 0.5 * (1.6 * PI).sin().powi(2);
    close(at(&|| read(EnergyAtEnd {}, 1.6, half_sine)), until, 1e-11);
    close(at(&|| read(EndDeformation::default(), 1.6, half_sine)), 0.0, 1e-9);
    close(at(&|| read(CoefficientOfRestitution {}, 1.6, half_sine)), 1.0, 1e-12);
    close(at(&|| read(PeakAcceleration::default(), 1.6, half_sine)), 20.0 * g, 1e-12);
    close(at(&|| read(AverageDeceleration::default(), 1.6, half_sine)), 40.0 * g / PI, 1e-12);
    close(at(&|| read(EndVelocity::default(), 1.6, half_sine)), -0.1 * PI, 1e-12);
    close(at(&|| read(EndPosition::default(), 1.6, half_sine)), 0.0, 1e-9);
    close(at(&|| read(PeakDisplacement::default(), 1.6, half_sine)), 0.1, 1e-12);
    close(at(&|| read(PeakVelocity::default(), 1.6, half_sine)), 0.1 * PI, 1e-12);
    let run = WindowWish::Run;
    let last = 40.0 * g * (1.6 * PI).sin();
    close(at(&|| read(EndForce { window: run }, 1.6, half_sine)), last, 1e-12);
    let unit = 20.0_f64.powf(2.5);
    close(at(&|| read(SeverityIndex::default(), 1.6, half_sine)), 0.457_655_86 * unit, 1e-8);
    close(at(&|| read(Hic::default(), 1.6, half_sine)), 0.414_645_65 * unit, 1e-8);
    let window = WindowWish::Run;
    let linear = read(SeverityIndex { exponent: 1.0, window }, 2.0, half_sine);
    close(linear.value, 20.0 * 4.0 / PI, 1e-12);
}

#[test]
fn severity_indices_of_pulses_have_their_closed_forms() {
    let index =
        |signal| read(SeverityIndex { exponent: 2.5, window: WindowWish::Run }, 1.0, signal).value;
    let haversine = |_: &str, t: f64| STANDARD_GRAVITY * (PI * t).sin().powi(2);
    close(index(haversine), 0.339_531, 2e-6);
    let triangle = |_: &str, t: f64| STANDARD_GRAVITY * (1.0 - (2.0 * t - 1.0).abs());
    close(index(triangle), 2.0 / 7.0, 1e-12);
    let rectangle = |_: &str, _: f64| -STANDARD_GRAVITY;
    close(index(rectangle), 1.0, 1e-12);
    let zero = |_: &str, _: f64| 0.0;
    close(index(zero), 0.0, 0.0);
}

#[test]
fn hic15_is_no_longer_than_15_ms() {
    let reading = read(Hic15::default(), 1.6, half_sine);
    let (from, to) = reading.window.unwrap();
    assert!((to - from - 0.015).abs() < 1e-12);
    assert!((from + to - 1.0).abs() < 1e-5, "{from} {to}");
    let mean = 20.0 * 2.0 / PI * (0.015 * PI / 2.0).sin() / 0.015;
    close(reading.value, mean.powf(2.5) * 0.015, 1e-10);
    assert!(reading.error.unwrap() < 1e-6);
}

#[test]
fn errors_follow_from_the_bound_of_the_signals() {
    let peak = read(PeakForce::default(), 1.6, half_sine);
    close(peak.error, 1e-9, 1e-12);
    let contact = read(ContactTime {}, 1.6, half_sine);
    close(contact.error, 1e-9 / (40.0 * STANDARD_GRAVITY * PI), 1e-3);
    let impulse = read(Impulse::default(), 1.6, half_sine);
    assert!(impulse.error.unwrap() >= 1e-9);
}

#[test]
fn dashpot_dissipates_pi_c_omega_a_squared_per_cycle() {
    // y = A sin ωt through c = 3, ω = 4π, A = 0.5, two cycles.
    let signal = |name: &str, t: f64| match name {
        "pad.force" => 3.0 * 0.5 * 4.0 * PI * (4.0 * PI * t).cos(),
        "pad.rate" => 0.5 * 4.0 * PI * (4.0 * PI * t).cos(),
        _ => 0.5 * (4.0 * PI * t).sin(),
    };
    let energy = read(Energy { window: WindowWish::Times(0.0, 0.5) }, 1.0, signal).value;
    close(energy, PI * 3.0 * 4.0 * PI * 0.25, 1e-9);
}

#[test]
fn overflow_is_no_value() {
    let huge = |_: &str, _: f64| 1e200;
    for reading in [read(SeverityIndex::default(), 1.0, huge), read(Hic::default(), 1.0, huge)] {
        assert_eq!(reading.value, None);
        assert!(reading.notes.contains(&Note::BeyondRange));
    }
}

#[test]
fn peak_in_tension_is_noted() {
    let signal = |_: &str, t: f64| 1.0 - 3.0 * t;
    let peak = read(PeakForce { window: WindowWish::Run }, 1.0, signal);
    close(peak.value, 2.0, 1e-12);
    assert_eq!(peak.notes, [Note::InTension]);
    let impact = read(PeakForce::default(), 1.0, signal);
    close(impact.value, 1.0, 1e-12);
    assert_eq!(impact.notes, []);
}

#[test]
fn every_kind_rebuilds_from_its_values_and_reads() {
    assert!(MEASURES.len() >= 26);
    for kind in MEASURES {
        let values = (kind.sample)();
        assert_eq!(values.len(), kind.parameters.len(), "{}", kind.word);
        assert_eq!((kind.again)(&values).unwrap(), values, "{}", kind.word);
        let unit = format!("[{}]", kind.about.unit);
        assert!(kind.summary.ends_with(&unit), "{}", kind.word);
        let reading = read_of(kind.example().unwrap().as_ref(), 1.6, half_sine);
        // The pad of these tests has no thickness and no area.
        let asks_for_sizes = [PeakStrain::KIND, PeakStress::KIND].contains(&kind.word);
        assert!(reading.value.is_some() || asks_for_sizes, "{}", kind.word);
    }
}

#[test]
fn windows_and_parameters_out_of_range_are_refused() {
    let window = |from, to| PeakForce::from_values(&[Value::Window(WindowWish::Times(from, to))]);
    assert!(window(0.0, 1.0).is_ok());
    assert!(window(1.0, 1.0).is_err() && window(0.0, f64::NAN).is_err());
    let run = Value::Window(WindowWish::Run);
    assert!(SeverityIndex::from_values(&[Value::Number(0.0), run.clone()]).is_err());
    assert!(Hic::from_values(&[Value::Number(-1.0), run]).is_err());
}
