//! Tests of the exact solution against closed forms, the thesis and many digits.

#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    clippy::float_cmp,
    clippy::excessive_precision,
    reason = "small counts, exact values and reference values with all their digits"
)]

mod agreement;
mod closed_forms;
mod drives;
mod hard;
mod repeated;
mod thesis;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::{
    Input, LinearForm, Method, Outputs, Run, Signal, Silent, System, Trajectory, Unknown,
    UnknownKind, Waveform, methods::Exact,
};

/// A system from dense rows whose outputs are its unknowns, with time in seconds.
pub(super) struct Scene {
    rows: Vec<Vec<f64>>,
    initial: Vec<f64>,
    drives: Vec<(usize, f64, Input)>,
    waveforms: Vec<Waveform>,
    outputs: Vec<(Vec<f64>, Option<Input>)>,
}

impl Scene {
    pub(super) fn new(rows: &[&[f64]], initial: &[f64]) -> Self {
        Self {
            rows: rows.iter().map(|row| row.to_vec()).collect(),
            initial: initial.to_vec(),
            drives: Vec::new(),
            waveforms: Vec::new(),
            outputs: Vec::new(),
        }
    }

    /// Adds `factor · u^(derivative)` to the rate of state `row`.
    pub(super) fn driven(mut self, row: usize, factor: f64, derivative: u32, u: Waveform) -> Self {
        self.drives.push((row, factor, Input { waveform: self.waveforms.len(), derivative }));
        self.waveforms.push(u);
        self
    }

    /// Adds an output after those of the unknowns.
    pub(super) fn reporting(mut self, form: &[f64], input: Option<Input>) -> Self {
        self.outputs.push((form.to_vec(), input));
        self
    }

    pub(super) fn system(&self) -> System {
        let size = self.rows.len();
        let mut inputs: Vec<Input> = self.drives.iter().map(|drive| drive.2).collect();
        inputs.extend(self.outputs.iter().filter_map(|output| output.1));
        let mut jacobian = CooMatrix::new(size, size);
        for (i, row) in self.rows.iter().enumerate() {
            for (j, &value) in row.iter().enumerate().filter(|entry| *entry.1 != 0.0) {
                jacobian.push(i, j, value);
            }
        }
        let mut matrix = CooMatrix::new(size, inputs.len());
        for (k, &(row, factor, _)) in self.drives.iter().enumerate() {
            matrix.push(row, k, factor);
        }
        let unit = |i: usize| (0..size).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
        let plain = (0..size).map(|i| (unit(i), None));
        let mut next = self.drives.len();
        let mut outputs = Outputs::new();
        for (form, input) in plain.chain(self.outputs.iter().cloned()) {
            let form: Vec<f64> = form;
            let mut inputs = LinearForm::zero();
            if input.is_some() {
                inputs = LinearForm::term(next, 1.0);
                next += 1;
            }
            let unknowns = LinearForm::sum(form.into_iter().enumerate());
            outputs.push("output", "", 1.0, &unknowns, &inputs);
        }
        System {
            unknowns: (0..size)
                .map(|i| Unknown {
                    name: format!("state {i}"),
                    kind: UnknownKind::Differential,
                    scale: 1.0,
                    unit: "",
                })
                .collect(),
            jacobian: CsrMatrix::from(&jacobian),
            input_matrix: CsrMatrix::from(&matrix),
            outputs,
            inputs,
            waveforms: self.waveforms.clone(),
            terms: Vec::new(),
            initial: self.initial.clone(),
            time_scale: 1.0,
        }
    }

    pub(super) fn solve(&self, t_end: f64) -> Solved {
        let system = self.system();
        let trajectory = Exact.integrate(&system, &Run::to(t_end), &mut Silent).unwrap();
        Solved { system, trajectory }
    }
}

/// Numbers that repeat: a linear congruential sequence (Knuth's constants).
pub(super) struct Sequence(pub(super) u64);

impl Sequence {
    pub(super) fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number between 1 and `10^decades`, evenly in its logarithm.
    pub(super) fn decades(&mut self, decades: f64) -> f64 {
        10_f64.powf(decades * self.next())
    }

    pub(super) fn index(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// A solved scene.
pub(super) struct Solved {
    pub(super) system: System,
    pub(super) trajectory: Trajectory,
}

impl Solved {
    pub(super) fn signal(&self, output: usize) -> Signal {
        self.trajectory.signal(&self.system, output)
    }

    pub(super) fn samples(&self, times: &[f64]) -> Vec<f64> {
        self.trajectory.dense.sample(&self.system, times)
    }

    /// Checks an output and, for unknowns, the samples against a closed form at many times, the
    /// signal within its own stated error and that within `allowed`.
    pub(super) fn judge(&self, output: usize, allowed: f64, exact: impl Fn(f64) -> f64) {
        let signal = self.signal(output);
        let error = signal.error.unwrap();
        assert!(error <= allowed, "stated error {error:e}, allowed {allowed:e}");
        let end = self.trajectory.t_end;
        let uniform: Vec<f64> = (0..=50).map(|k| end * f64::from(k) / 50.0).collect();
        let mut spread: Vec<f64> = (0..=50).map(|k| end * 0.7_f64.powi(k)).collect();
        spread.reverse();
        for times in [uniform, spread] {
            let samples = self.samples(&times);
            let size = self.system.len();
            for (k, &t) in times.iter().enumerate() {
                let expected = exact(t);
                let got = signal.value(t);
                assert!(
                    (got - expected).abs() <= error,
                    "signal at {t:e}: {got:e} for {expected:e}, off by {:e}, stated {error:e}",
                    got - expected
                );
                if output < size {
                    let got = samples[k * size + output];
                    assert!(
                        (got - expected).abs() <= allowed + 4.0 * f64::EPSILON * expected.abs(),
                        "sample at {t:e}: {got:e} for {expected:e}, off by {:e}",
                        got - expected
                    );
                }
            }
        }
    }
}
