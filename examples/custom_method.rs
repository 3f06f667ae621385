//! A method of one's own: the classical Runge–Kutta method of fourth order with steps of one length.
//!
//! `cargo run --example custom_method`
#![allow(
    clippy::print_stdout,
    missing_docs,
    unreachable_pub,
    reason = "an example shows its result"
)]

use std::{error::Error, f64::consts::PI};

use dashpot::{
    analysis::{Solve, SolveSettings},
    dae::{
        Dense, Method, Observer, Outcome, Panel, Run, Signal, SolveError, Statistics, System,
        Trajectory, methods::Exact,
    },
    network::{Network, Node, dashpot, spring},
    numerics::chebyshev::{Coefficients, Interpolation},
};

/// `y₊ = y + h (k₁ + 2 k₂ + 2 k₃ + k₄)/6` on a linear system that nothing drives, with the step
/// `h = T/n` of error `h⁴ ∼ rtol`.
#[derive(Debug)]
struct Rk4;

impl Method for Rk4 {
    fn name(&self) -> &'static str {
        "rk4"
    }

    fn summary(&self) -> &'static str {
        "four stages of fourth order, with steps of one length"
    }

    fn applies(&self, system: &System, _: &Run) -> Result<String, SolveError> {
        match system.linear() {
            Some(_) if system.inputs.is_empty() => Ok("nothing drives it".to_owned()),
            _ => {
                let reason = "it takes linear systems without loads only".to_owned();
                Err(SolveError::NotApplicable { method: "rk4", reason })
            }
        }
    }

    /// The error is as the tolerance itself.
    fn fall(&self) -> f64 {
        1.0
    }

    fn integrate(
        &self,
        system: &System,
        run: &Run,
        _: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        self.applies(system, run)?;
        let end = run.t_end / system.time_scale;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small count"
        )]
        let steps = (0.5 * end.max(1.0) * run.rtol.powf(-0.25)).ceil() as usize;
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let step = end / steps as f64;
        let mut states = vec![system.initial.clone()];
        for at in 0..steps {
            states.push(advanced(system, &states[at], step));
        }
        Ok(Trajectory {
            method: "rk4",
            outcome: Outcome::Finished,
            t_end: run.t_end,
            events: Vec::new(),
            first_phases: Vec::new(),
            switches: Vec::new(),
            statistics: Statistics {
                accepted: steps,
                rhs_calls: 4 * steps,
                ..Statistics::default()
            },
            dense: Box::new(Steps { states, step, rtol: run.rtol }),
        })
    }
}

fn rate(system: &System, y: &[f64]) -> Vec<f64> {
    let rows = system.jacobian.row_iter();
    rows.map(|row| row.col_indices().iter().zip(row.values()).map(|(&at, own)| own * y[at]).sum())
        .collect()
}

fn plus(y: &[f64], step: f64, rate: &[f64]) -> Vec<f64> {
    y.iter().zip(rate).map(|(y, rate)| y + step * rate).collect()
}

fn advanced(system: &System, y: &[f64], step: f64) -> Vec<f64> {
    let first = rate(system, y);
    let second = rate(system, &plus(y, 0.5 * step, &first));
    let third = rate(system, &plus(y, 0.5 * step, &second));
    let fourth = rate(system, &plus(y, step, &third));
    let stages = [(first, 1.0), (second, 2.0), (third, 2.0), (fourth, 1.0)];
    stages.iter().fold(y.to_vec(), |sum, (rate, weight)| plus(&sum, step * weight / 6.0, rate))
}

/// The states after all steps; between them each is advanced by a part of the step.
#[derive(Debug)]
struct Steps {
    states: Vec<Vec<f64>>,
    step: f64,
    rtol: f64,
}

impl Steps {
    fn state(&self, system: &System, time: f64) -> Vec<f64> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small count"
        )]
        let at = ((time / self.step) as usize).min(self.states.len() - 2);
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let since = time - self.step * at as f64;
        advanced(system, &self.states[at], since)
    }
}

impl Dense for Steps {
    fn signal(&self, system: &System, output: usize) -> Signal {
        let output = system.outputs.at(output);
        let interpolation = Interpolation::of_degree(4);
        let mut largest = 0.0_f64;
        let mut panels = Vec::new();
        for at in 0..self.states.len() - 1 {
            #[expect(clippy::cast_precision_loss, reason = "a small count")]
            let (start, end) = (self.step * at as f64, self.step * (at + 1) as f64);
            let value = |x: &f64| {
                let y = self.state(system, start + 0.5 * (1.0 + x) * (end - start));
                output.scale * output.unknowns.at(&y)
            };
            let values: Vec<f64> = interpolation.nodes().iter().map(value).collect();
            largest = values.iter().fold(largest, |most, own| most.max(own.abs()));
            let mut coefficients = Coefficients::zeros(values.len());
            interpolation.coefficients(&values, &mut coefficients);
            let [start, end] = [start, end].map(|time| time * system.time_scale);
            panels.push(Panel { start, end, coefficients });
        }
        Signal::new(panels, None, self.rtol * largest)
    }

    fn sample(&self, system: &System, times: &[f64]) -> Vec<f64> {
        times.iter().flat_map(|&time| self.state(system, time)).collect()
    }
}

pub fn main() -> Result<(), Box<dyn Error>> {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).moving(4.0));
    network.connect("pad", head, network.ground(), spring(60e3) | dashpot(50.0));
    let settings = SolveSettings::lasting(PI * (5.0_f64 / 60e3).sqrt());

    let own = network.solve_with(&settings.clone().by(Rk4))?;
    let exact = network.solve_with(&settings.by(Exact))?;
    for found in &own.measures {
        let Some((value, error)) = found.value.zip(found.error) else { continue };
        let truth = exact.value(&found.key)?;
        println!(
            "{:<26} {value:10.4} ± {error:.1e} {}, off by {:.1e}",
            found.key,
            found.unit,
            value - truth
        );
        assert!((value - truth).abs() <= error, "{}: {value} is not {truth}", found.key);
    }
    println!("{} steps by `{}`", own.solver.statistics.accepted, own.solver.method);
    Ok(())
}
