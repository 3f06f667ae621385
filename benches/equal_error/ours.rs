//! The methods of this library on a problem.

use std::{
    ops::ControlFlow,
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot::dae::{Keep, Method, Observer, Part, Progress, Run, methods, switching};

use super::{by_hand::Job, problems::Problem};

/// Unknowns beyond which only what is compared is kept of a solution.
const KEEP_ALL: usize = 100;

/// Ends a run that lasts too long.
struct Deadline(Instant);

impl Observer for Deadline {
    fn progress(&mut self, _progress: Progress) -> ControlFlow<()> {
        if Instant::now() > self.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The method that `auto` chooses.
pub(crate) fn choice(problem: &Problem) -> &'static str {
    methods::Auto::choose(&problem.assembly.system, &Run::to(problem.end)).0.name()
}

/// A method at `times`, given up after `patience` \[s\]. As in the code by hand all unknowns are
/// evaluated there, where all are kept and one system holds throughout; else the output's signal is.
pub(crate) fn job<'a>(
    method: Box<dyn Method>,
    problem: &'a Problem,
    times: &'a [f64],
    patience: f64,
) -> Job<'a> {
    let system = &problem.assembly.system;
    let keep = if system.len() > KEEP_ALL {
        Keep::Part(Arc::new(Part { outputs: vec![problem.output], ..Part::default() }))
    } else {
        Keep::Everything
    };
    let own: Vec<f64> = times.iter().map(|time| time / system.time_scale).collect();
    Box::new(move |rtol| {
        let run = Run { keep: keep.clone(), ..Run::to(problem.end).with_rtol(rtol) };
        let mut watch = Deadline(Instant::now() + Duration::from_secs_f64(patience));
        let found = match &problem.assembly.switching {
            Some(phases) => switching::integrate(&*method, &**phases, &run, &mut watch),
            None => method.integrate(system, &run, &mut watch),
        };
        let trajectory = found.map_err(|error| error.to_string())?;
        if problem.assembly.switching.is_some() || run.keep != Keep::Everything {
            return Ok(trajectory.signal(system, problem.output).sample(times));
        }
        let output = system.outputs.at(problem.output);
        let states = trajectory.dense.sample(system, &own);
        let states = states.chunks_exact(system.len());
        Ok(states.map(|state| output.scale * output.unknowns.at(state)).collect())
    })
}
