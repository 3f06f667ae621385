//! The scenes of the gallery: each is solved as its file says, its methods agree within the errors
//! that they report, its energy is all there, and something that is not a stored result judges it.
//!
//! The judges are closed forms, balances of momentum and energy, and equations of motion written
//! out by hand here and solved by the classical Runge–Kutta method with fixed steps.

mod by_hand;
mod crash;
mod drops;
mod machines;
mod pads;
mod thesis;
mod waves;

use std::fs;

use dashpot::{
    analysis::{RunReport, Solve},
    dae::Signal,
    scene::{ReadOptions, Scene, read},
};

use crate::scenes::scene_path;

/// Standard gravity \[m/s²\].
const G0: f64 = 9.806_65;

/// A scene of the gallery, solved by the methods that it names.
struct Solved {
    runs: Vec<RunReport>,
}

/// Reads a scene of the folder `scenes`; `change` makes another text of it.
fn scene(name: &str, change: impl Fn(String) -> String) -> Scene {
    let path = scene_path(name);
    let text = change(fs::read_to_string(&path).unwrap());
    let file = path.to_string_lossy();
    let options = ReadOptions { file: Some(&file), ..ReadOptions::default() };
    let checked = read(&text, &options).unwrap_or_else(|faults| panic!("{name}: {faults}"));
    assert!(checked.warnings.is_empty(), "{name}: {}", checked.warnings);
    checked.value
}

/// Solves a scene of the gallery by all its methods, and holds these against each other.
fn solved(name: &str) -> Solved {
    changed(name, |text| text)
}

/// The runs of a scene by all its methods.
pub(crate) fn runs(name: &str, change: impl Fn(String) -> String) -> Vec<RunReport> {
    let scene = scene(name, change);
    let by = |method: &String| {
        let settings = scene.settings(method).unwrap();
        scene
            .network
            .solve_with(&settings)
            .unwrap_or_else(|error| panic!("{name} by {method}: {error}"))
    };
    scene.run.methods.iter().map(by).collect()
}

/// The same with another text.
fn changed(name: &str, change: impl Fn(String) -> String) -> Solved {
    let runs = runs(name, change);
    assert!(runs.len() >= 2, "{name}: a second method is missing");
    let first = &runs[0];
    for run in &runs {
        let method = run.solver.method;
        // Segments that are too few, by which the errors are widened, are told of.
        let told = |own: &dashpot::analysis::Warning| {
            !own.to_string().contains("segments of layers instead of")
        };
        assert!(!run.warnings.iter().any(told), "{name} by {method}: {:?}", run.warnings);
        // As good as the numbers are said to be, among them energies; and rounding.
        let allowed = run.worst_relative_error().unwrap().max(1e-12);
        let closure = run.energy.closure().abs();
        assert!(closure <= allowed, "{name} by {method}: {closure:e} of the energy is missing");
        for measure in &run.measures {
            let other = first.measure(&measure.key).unwrap();
            let (Some(one), Some(two)) = (measure.value, other.value) else {
                assert_eq!(measure.value, other.value, "{name}: {}", measure.key);
                continue;
            };
            let errors = [measure.error, other.error]
                .map(|error| error.unwrap_or_else(|| panic!("{name}: {} has none", measure.key)));
            let (apart, allowed) = ((one - two).abs(), errors[0] + errors[1]);
            assert!(
                apart <= allowed,
                "{name} by {method}: {} {one} and {two} are {apart:e} apart, allowed {allowed:e}",
                measure.key
            );
        }
    }
    Solved { runs }
}

impl Solved {
    /// The run by the first method.
    fn first(&self) -> &RunReport {
        &self.runs[0]
    }

    /// An output of the first run over time.
    fn signal(&self, output: &str) -> Signal {
        let run = self.first();
        let number = run.assembly.output(output).unwrap_or_else(|| panic!("no output {output}"));
        run.trajectory.signal(&run.assembly.system, number)
    }

    /// Value and reported error of a measure of the first run.
    fn measure(&self, key: &str) -> (f64, f64) {
        let measure = self.first().measure(key).unwrap_or_else(|| panic!("no measure {key}"));
        (measure.value.unwrap(), measure.error.unwrap())
    }

    /// When the switching part `name` went into `phase` \[s\], in order.
    fn times(&self, name: &str, phase: &str) -> Vec<f64> {
        let switches = self.first().trajectory.switches.iter();
        let own = switches.filter(|switch| switch.name == name && switch.what == phase);
        own.map(|own| own.time).collect()
    }

    /// Holds a measure against what a judge says, who is right to `tolerance`.
    fn is(&self, key: &str, expected: f64, tolerance: f64) {
        let (value, error) = self.measure(key);
        close(key, value, expected, tolerance + error);
    }
}

/// Holds a value against what a judge says.
fn close(what: &str, value: f64, expected: f64, tolerance: f64) {
    let apart = (value - expected).abs();
    assert!(apart <= tolerance, "{what}: {value} is not {expected}, {apart:e} > {tolerance:e}");
}
