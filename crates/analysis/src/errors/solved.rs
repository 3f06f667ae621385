//! One solution of a run, with its measures; and what must be kept of it.

use std::{cell::OnceCell, collections::BTreeSet, sync::Arc};

use dashpot_dae::{Keep, Method, Observer, Part, Progress, Run, SolveError, Trajectory, switching};
use dashpot_network::{Assembly, ConnectionOutputs};

use crate::{
    Ledger, Reading, RunError, Solution, SolveSettings,
    energy::{
        ledger::{does_work, leak, ledger},
        roles::EnergyRole,
    },
    impact::{contacts, sliders::slider_fault},
    measures::{Family, selection::Selected},
    memory::is_large,
    solution::{Known, threshold_at},
};

/// Work that a further solution is always granted.
pub(crate) const ALWAYS: u64 = 10_000_000;

/// Work of reading a panel of a signal.
const READING: u64 = 48;

#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) assembly: &'a Assembly,
    pub(crate) settings: &'a SolveSettings,
    pub(crate) selected: &'a [Selected],
    pub(crate) method: &'a dyn Method,
    /// Whether solutions are judged by their energy and sliders before they are taken.
    pub(crate) is_judged: bool,
}

/// A solution with the measures read off it.
pub(crate) struct Solved {
    pub(crate) rtol: f64,
    /// Part of the largest contact force below which a pull counts as an error of the method.
    pub(crate) threshold: f64,
    /// How deep each contact force first pulls.
    pub(crate) pulls: Vec<Option<f64>>,
    pub(crate) trajectory: Trajectory,
    pub(crate) readings: Vec<Reading>,
    /// What it is judged by, once it is to be judged: the coarser ones of several seldom are.
    pub(crate) balance: OnceCell<Balance>,
    /// What the measures have found, where there are no further solutions: signals take much memory.
    pub(crate) known: Option<Known>,
    /// The measures with smaller errors at events, once they are asked for.
    pub(crate) sharper: OnceCell<Vec<Reading>>,
}

/// Whether a solution can be trusted.
#[derive(Debug)]
pub(crate) struct Balance {
    pub(crate) energy: Ledger,
    /// The most that a contact pulls with, in parts of what it pushes with.
    pub(crate) tension: f64,
}

impl Balance {
    fn of(solution: &Solution<'_>) -> Self {
        let tension = if solution.doubt() > 0.0 { solution.tension() } else { None };
        Self {
            energy: ledger(solution, solution.end()),
            tension: tension.map_or(0.0, |tension| tension.part),
        }
    }
}

impl Solved {
    /// What it is judged by; of one that has not been when it was made, as that of a method with steps.
    pub(crate) fn balance(&self, assembly: &Assembly) -> &Balance {
        self.balance.get_or_init(|| {
            let threshold = threshold_at(Some(self.rtol));
            Balance::of(&Solution::new(assembly, &self.trajectory).doubting(threshold))
        })
    }

    /// The solution as the measures have been read off it.
    pub(crate) fn as_read<'a>(&'a self, assembly: &'a Assembly) -> Solution<'a> {
        Solution::new(assembly, &self.trajectory).doubting(self.threshold)
    }

    /// What it tells of errors.
    pub(crate) fn told(&self) -> (f64, &[Reading]) {
        (self.rtol, &self.readings)
    }
}

impl Task<'_> {
    /// What is to be said of a solution in which so much energy is missing, or too much, that nothing of it
    /// can be trusted, or in which sliders do what they cannot.
    pub(crate) fn fault(&self, solved: &Solved) -> Option<RunError> {
        if !self.is_judged {
            return None;
        }
        let energy = &solved.balance(self.assembly).energy;
        let closure = energy.closure();
        let method = solved.trajectory.method;
        let solution = Solution::new(self.assembly, &solved.trajectory);
        if !closure.is_finite() {
            return Some(RunError::BeyondRange);
        }
        if closure.abs() > Ledger::MOST_LOST {
            return Some(RunError::EnergyLost { method, closure, leak: leak(&solution) });
        }
        slider_fault(&solution, energy).map(|fault| RunError::Slider { method, fault })
    }

    /// Whether there is one solution only.
    pub(crate) fn is_single(&self) -> bool {
        self.method.is_exact() || !self.settings.estimate
    }

    /// A solution with its measures. Where only a part of it is kept, and that turns out not to be all
    /// that is asked for, it is made again. It is quicker to say at once that it `is_judged`.
    pub(crate) fn solve(
        &self,
        run: &Run,
        is_judged: bool,
        observer: &mut dyn Observer,
    ) -> Result<Solved, SolveError> {
        let mut run = run.clone();
        loop {
            let (solved, missing) = self.attempt(&run, is_judged, observer)?;
            if missing.is_empty() {
                return Ok(solved);
            }
            run.keep = keep_also(&run.keep, &missing);
        }
    }

    /// A solution, and the outputs that were asked for but not kept.
    fn attempt(
        &self,
        run: &Run,
        is_judged: bool,
        observer: &mut dyn Observer,
    ) -> Result<(Solved, BTreeSet<usize>), SolveError> {
        let trajectory = match &self.assembly.switching {
            None => self.method.integrate(&self.assembly.system, run, observer)?,
            Some(phased) => switching::integrate(self.method, phased.as_ref(), run, observer)?,
        };
        let threshold = threshold_at((!self.method.is_exact()).then_some(run.rtol));
        let mut solution = Solution::new(self.assembly, &trajectory).doubting(threshold);
        let readings = self.read_under(&mut solution, observer);
        let read = solution.panels();
        run.budget.charge(read * READING);
        let readings = readings?;
        // They are compared with those of other solutions.
        let is_doubted = threshold > 0.0 && !self.is_single();
        let pulls = if is_doubted { solution.first_pulls() } else { Vec::new() };
        let balance =
            if is_judged { OnceCell::from(Balance::of(&solution)) } else { OnceCell::new() };
        run.budget.charge((solution.panels() - read) * READING);
        if self.method.is_exact() && run.budget.is_spent() {
            // Its signals are not followed any more.
            return Err(self.spent(&trajectory, run.budget.done()));
        }
        let missing = solution.missing();
        let known = Some(solution.known()).filter(|_| self.is_single());
        let rtol = run.rtol;
        let sharper = OnceCell::new();
        let solved =
            Solved { rtol, threshold, pulls, trajectory, readings, balance, known, sharper };
        Ok((solved, missing))
    }

    fn spent(&self, trajectory: &Trajectory, work: u64) -> SolveError {
        SolveError::BudgetSpent { method: self.method.name(), time: trajectory.t_end, work }
    }

    /// The measures of a solution, whose signals may not be made before. The observer is told of each. To read them may
    /// be as much work as to solve.
    fn read_under(
        &self,
        solution: &mut Solution<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Vec<Reading>, SolveError> {
        let trajectory = solution.trajectory();
        let (time, steps) = (trajectory.t_end, trajectory.statistics.accepted);
        let mut read = |entry: &Selected| {
            let reading = entry.measure.read(solution, entry.target);
            solution.make_room();
            let work = solution.panels().saturating_mul(READING);
            if work > self.settings.budget {
                return Err(self.spent(trajectory, work));
            }
            let is_over = observer.progress(Progress { time, steps }).is_break();
            if is_over { Err(SolveError::Cancelled { time }) } else { Ok(reading) }
        };
        self.selected.iter().map(&mut read).collect()
    }

    pub(crate) fn read(&self, solution: &mut Solution<'_>) -> Vec<Reading> {
        let mut read = |entry: &Selected| {
            let reading = entry.measure.read(solution, entry.target);
            solution.make_room();
            reading
        };
        self.selected.iter().map(&mut read).collect()
    }
}

/// Pads beyond which nobody looks whether one of them is pressed in too far.
const MOST_PADS: usize = 100;

/// What a run keeps whose measures are `selected`: all outputs of their targets and of all impactors,
/// and of what these touch.
pub(crate) fn keep(assembly: &Assembly, selected: &[Selected]) -> Keep {
    match products(assembly) {
        Some(products) if is_large(assembly) => Keep::Part(Arc::new(Part {
            outputs: outputs(assembly, selected).into_iter().collect(),
            products,
            jumps: jumps(assembly),
        })),
        _ => Keep::Everything,
    }
}

/// The same with more outputs.
pub(crate) fn keep_also(keep: &Keep, outputs: &BTreeSet<usize>) -> Keep {
    match keep {
        Keep::Everything => Keep::Everything,
        Keep::Part(part) => {
            let all = part.outputs.iter().chain(outputs).copied().collect();
            Keep::Part(Arc::new(Part { outputs: all, ..part.as_ref().clone() }))
        }
    }
}

/// Force and rate of all parts that dissipate, then force and velocity of all drives; `None` where a
/// rate is not among the outputs.
fn products(assembly: &Assembly) -> Option<Vec<[usize; 2]>> {
    let parts = assembly.primitives.iter();
    let parts = parts
        .filter(|part| EnergyRole::of(part.element.as_ref()).dissipates && does_work(part))
        .map(|part| Some([part.force, part.rate?]));
    let drives = assembly.drives.iter().map(|drive| Some([drive.force, drive.velocity?]));
    parts.chain(drives).collect()
}

/// The deformations of all springs, where anything jumps.
fn jumps(assembly: &Assembly) -> Vec<usize> {
    if assembly.system.breakpoints(f64::INFINITY).is_empty() {
        return Vec::new();
    }
    let springs = assembly.primitives.iter();
    let springs = springs.filter(|spring| EnergyRole::of(spring.element.as_ref()).stores);
    springs.map(|spring| spring.deformation).collect()
}

fn outputs(assembly: &Assembly, selected: &[Selected]) -> BTreeSet<usize> {
    let mut wanted = contacts::with_impactor(assembly);
    let mut elements = BTreeSet::new();
    for own in selected {
        match own.measure.applies_to() {
            Family::Node => wanted[assembly.nodes[own.target].body] = true,
            Family::Element => {
                elements.insert(own.target);
            }
        }
    }
    let pads = || assembly.connections.iter().filter(|connection| !connection.segments.is_empty());
    let all_pads = pads().count() <= MOST_PADS;
    for (at, own) in assembly.connections.iter().enumerate() {
        let is_pad = all_pads && !own.segments.is_empty();
        if is_pad || contacts::between(assembly, own).iter().any(|&body| wanted[body]) {
            elements.insert(at);
        }
    }
    let mut found = BTreeSet::new();
    for own in elements.into_iter().filter_map(|at| assembly.connections.get(at)) {
        found.extend(of_element(assembly, own));
        contacts::between(assembly, own).into_iter().for_each(|body| wanted[body] = true);
    }
    for node in assembly.nodes.iter().filter(|node| wanted[node.body]) {
        found.extend([Some(node.position), node.velocity, node.acceleration].into_iter().flatten());
    }
    found
}

fn of_element(assembly: &Assembly, connection_outputs: &ConnectionOutputs) -> Vec<usize> {
    let mut found = vec![connection_outputs.deformation];
    found.extend(
        [connection_outputs.force, connection_outputs.transmitted, connection_outputs.rate]
            .into_iter()
            .flatten(),
    );
    for segment in &connection_outputs.segments {
        found.push(segment.deformation);
        found.extend(segment.force);
    }
    for part in assembly.primitives.get(connection_outputs.primitives.clone()).unwrap_or_default() {
        found.extend([part.force, part.deformation]);
        found.extend(part.rate);
    }
    found
}
