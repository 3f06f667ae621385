//! What designs come to: their measures, and how far pads and laws are pressed in parts of their thickness or range.

use dashpot_analysis::{
    Bound, Cause, Judgement, Limit, MeasureReport, RunReport, Solve, SolveSettings,
    sweep::{PoseAt, ScenePoint, columns},
};

use super::{Aim, DesignError};

/// Tolerances of stepping methods, whose results are differenced: the first at which the first design, and then another,
/// takes no more work than [`MOST_WORK`] …
const FINE: [f64; 2] = [1e-9, 1e-8];
/// … else this one, where a law makes finer ones follow roundings.
const COARSE: f64 = 1e-7;
/// Work of a design in parts of that of the first one at the coarse tolerance, and what is always granted.
const MOST_WORK: u64 = 4;
const LEAST_WORK: u64 = 200_000;

/// What has to be kept by a design.
#[derive(Debug, Clone, PartialEq)]
pub enum Requirement {
    /// A limit of the scene or the command.
    Limit(Limit),
    /// A pad is not pressed by more than its thickness, or a law not beyond its last point; its name or path.
    Depth(String, DepthOf),
    /// Another aim is at most this, in SI units; without a bound where it is infinite.
    Ceiling(Aim, f64),
}

/// What a deformation is a part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthOf {
    /// The thickness of a pad.
    Thickness,
    /// The range of a law, up to its last point.
    Law,
    /// The radius of the round body that presses it, where its law ends.
    Radius,
}

/// A requirement, and the test in which it has to be kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Required {
    /// Which of the tests.
    pub test: usize,
    /// What it is.
    pub what: Requirement,
}

/// The tests of a design.
pub(super) struct Evaluator<'p> {
    tests: &'p [&'p PoseAt<'p>],
    aim: &'p Aim,
    /// Another aim, which may have a ceiling.
    other: Option<&'p Aim>,
    pub(super) required: Vec<Required>,
    /// Fine tolerances, and the work of a solution at them.
    fine: &'static [f64],
    budget: u64,
}

/// What one design comes to.
#[derive(Debug, Clone)]
pub(super) struct Evaluated {
    /// The aim in each test, where it is a measure; of a number that number.
    pub(super) aims: Vec<f64>,
    /// The values of what is required: a measure in its unit, or a part of a thickness or a range.
    pub(super) values: Vec<f64>,
}

impl Requirement {
    /// Whether both ask for the same, each in its test: the same side of a measure, whatever the bounds are.
    pub fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Limit(one), Self::Limit(other)) => {
                one.key == other.key && one.bound.sign() == other.bound.sign()
            }
            (Self::Depth(one, a), Self::Depth(other, b)) => one == other && a == b,
            (Self::Ceiling(one, _), Self::Ceiling(other, _)) => one == other,
            _ => false,
        }
    }

    /// How far a value exceeds it, in parts of the bound; negative where it is kept.
    pub(super) fn excess(&self, value: f64, slack: f64) -> f64 {
        match self {
            Self::Depth(..) => value - 1.0 + slack,
            Self::Ceiling(_, most) if most.is_infinite() => -1.0,
            Self::Ceiling(_, most) => {
                let size = if *most == 0.0 { 1.0 } else { most.abs() };
                (value - most) / size + slack
            }
            Self::Limit(limit) => {
                let level = limit.bound.level();
                let size = if level == 0.0 { 1.0 } else { level.abs() };
                let over = match limit.bound {
                    Bound::Max(most) => value - most,
                    Bound::Min(least) => least - value,
                };
                over / size + slack
            }
        }
    }
}

impl<'p> Evaluator<'p> {
    /// Finds out at one design what is required.
    pub(super) fn new(
        tests: &'p [&'p PoseAt<'p>],
        aim: &'p Aim,
        other: Option<&'p Aim>,
        at: &[f64],
    ) -> Result<Self, DesignError> {
        let mut own =
            Self { tests, aim, other, required: Vec::new(), fine: &FINE, budget: LEAST_WORK };
        for test in 0..tests.len() {
            let point = own.asked(test, at)?;
            let limits = point.settings.limits.clone();
            let run = point.network.solve_with(&differenced(&point.settings, COARSE))?;
            own.budget = own.budget.max(MOST_WORK.saturating_mul(run.solver.work));
            let of_limits = limits.into_iter().map(Requirement::Limit);
            let depths = reaches(&run).into_iter().map(|own| Requirement::Depth(own.0, own.1));
            let ceiling = other.filter(|other| test == 0 || matches!(other, Aim::Measure(_)));
            let ceiling = ceiling.map(|own| Requirement::Ceiling(own.clone(), f64::INFINITY));
            let all = of_limits.chain(depths).chain(ceiling);
            own.required.extend(all.map(|what| Required { test, what }));
        }
        while let Some((rtol, others)) = own.fine.split_first() {
            let gets_through = |test: usize| -> Result<bool, DesignError> {
                Ok(own.limited(&own.asked(test, at)?, *rtol).is_some())
            };
            let all: Vec<bool> = (0..tests.len()).map(gets_through).collect::<Result<_, _>>()?;
            if all.contains(&false) {
                own.fine = others;
            } else {
                break;
            }
        }
        Ok(own)
    }

    /// Bounds the other aim.
    pub(super) fn set_ceiling(&mut self, most: f64) {
        for own in &mut self.required {
            if let Requirement::Ceiling(_, own) = &mut own.what {
                *own = most;
            }
        }
    }

    fn asked(&self, test: usize, values: &[f64]) -> Result<ScenePoint, DesignError> {
        let mut point = (self.tests[test])(values).map_err(DesignError::NotPosed)?;
        let keys: Vec<String> = [Some(self.aim), self.other]
            .into_iter()
            .flatten()
            .filter_map(|own| if let Aim::Measure(key) = own { Some(key.clone()) } else { None })
            .collect();
        if !keys.is_empty() {
            point.settings.measures = columns(&point, &keys)?.1;
        }
        Ok(point)
    }

    /// The run of a design as it is differenced.
    fn solved(&self, point: &ScenePoint) -> Result<RunReport, Cause> {
        let fine = if point.settings.rtol.is_some() { &[][..] } else { self.fine };
        if let Some(run) = fine.iter().find_map(|rtol| self.limited(point, *rtol)) {
            return Ok(run);
        }
        Ok(point.network.solve_with(&differenced(&point.settings, COARSE))?)
    }

    /// The run at a fine tolerance, where it takes no more than its work.
    fn limited(&self, point: &ScenePoint, rtol: f64) -> Option<RunReport> {
        let own = differenced(&point.settings, rtol);
        let own = SolveSettings { budget: self.budget.min(own.budget), ..own };
        point.network.solve_with(&own).ok()
    }

    /// The run of a test with the errors that are asked for.
    pub(super) fn run(&self, test: usize, values: &[f64]) -> Result<RunReport, DesignError> {
        let point = self.asked(test, values)?;
        let settings = SolveSettings { estimate: true, ..point.settings };
        Ok(point.network.solve_with(&settings)?)
    }

    /// What a design comes to; why it has no answer where a test cannot be solved, or a measure has no value.
    pub(super) fn at(&self, values: &[f64]) -> Result<Evaluated, Cause> {
        let mut own = Evaluated { aims: Vec::new(), values: Vec::new() };
        for test in 0..self.tests.len() {
            let run = self.solved(&self.asked(test, values).map_err(cause)?)?;
            own.values.extend(self.required_of(test, &run, values)?);
            if let Aim::Measure(key) = self.aim {
                own.aims.push(whole(&run, key)?);
            }
        }
        match self.aim {
            Aim::Number(at) => own.aims.push(values[*at]),
            Aim::Given(value) => own.aims.push(*value),
            Aim::Measure(_) => {}
        }
        Ok(own)
    }

    /// What is required of a test in a scene that was posed otherwise, such as with scatter.
    pub(super) fn of_scattered(
        &self,
        test: usize,
        point: &ScenePoint,
        values: &[f64],
    ) -> Result<Vec<f64>, Cause> {
        self.required_of(test, &self.solved(point)?, values)
    }

    /// What each requirement of a test comes to in its run.
    fn required_of(&self, test: usize, run: &RunReport, values: &[f64]) -> Result<Vec<f64>, Cause> {
        let reached = reaches(run);
        let of_test = self.required.iter().filter(|own| own.test == test);
        let each = of_test.map(|own| match &own.what {
            Requirement::Limit(limit) => judged(run, limit),
            Requirement::Depth(name, of) => {
                let is_pad = |of: DepthOf| of == DepthOf::Thickness;
                let found =
                    reached.iter().find(|own| own.0 == *name && is_pad(own.1) == is_pad(*of));
                let known = found.filter(|own| own.2.is_finite());
                known.map(|own| own.2).ok_or_else(|| Cause::no_value(name, None))
            }
            Requirement::Ceiling(Aim::Measure(key), _) => whole(run, key),
            Requirement::Ceiling(Aim::Number(at), _) => Ok(values[*at]),
            Requirement::Ceiling(Aim::Given(own), _) => Ok(*own),
        });
        each.collect()
    }

    /// What the aim of a design that was not evaluated may be at least.
    pub(super) fn least_aim(&self, values: &[f64]) -> f64 {
        match self.aim {
            Aim::Number(at) => values[*at],
            Aim::Given(value) => *value,
            Aim::Measure(_) => f64::NEG_INFINITY,
        }
    }

    /// How many aims a design has.
    pub(super) fn aims(&self) -> usize {
        match self.aim {
            Aim::Number(_) | Aim::Given(_) => 1,
            Aim::Measure(_) => self.tests.len(),
        }
    }

    pub(super) fn tests(&self) -> usize {
        self.tests.len()
    }
}

/// Without estimates of errors; at this tolerance where none is given.
fn differenced(settings: &SolveSettings, rtol: f64) -> SolveSettings {
    let mut own = settings.clone();
    own.estimate = false;
    own.accuracy.neglect_below = None;
    own.rtol = own.rtol.or(Some(rtol));
    own
}

/// Why there is no scene.
fn cause(error: DesignError) -> Cause {
    match error {
        DesignError::Run(error) => error.into(),
        error => Cause::scene(error.to_string()),
    }
}

/// The value of a measure; infinite where it is, as a peak is where speeds jump.
fn value(run: &RunReport, key: &str) -> Result<f64, Cause> {
    let measure = run.measure(key);
    let infinite = measure.is_some_and(MeasureReport::is_infinite).then_some(f64::INFINITY);
    let found = measure.and_then(|own| own.value).or(infinite);
    found.ok_or_else(|| Cause::no_value(key, Some(run)))
}

/// The same where it does not grow any more.
fn whole(run: &RunReport, key: &str) -> Result<f64, Cause> {
    let is_cut = run.measure(key).is_some_and(|own| run.is_so_far(own));
    if is_cut { Err(Cause::cut(key)) } else { value(run, key) }
}

/// The same of what is limited: what exceeds its limit already does so whatever comes.
fn judged(run: &RunReport, limit: &Limit) -> Result<f64, Cause> {
    let found = value(run, &limit.key)?;
    let is_exceeded = limit.bound.judge(found, None, false) == Judgement::Fail;
    if is_exceeded && matches!(limit.bound, Bound::Max(_)) {
        Ok(found)
    } else {
        whole(run, &limit.key)
    }
}

/// How far each pad, and each law that ends, is pressed in parts of its thickness or its last point.
fn reaches(run: &RunReport) -> Vec<(String, DepthOf, f64)> {
    let part = |deformation: usize, whole: f64| run.deepest(deformation) / whole;
    let mut all = Vec::new();
    for own in &run.assembly.connections {
        let pad = own
            .thickness
            .map(|whole| (own.name.clone(), DepthOf::Thickness, part(own.deformation, whole)));
        let parts = run.assembly.primitives.get(own.primitives.clone()).unwrap_or(&[]);
        let laws = parts.iter().filter_map(|own| {
            let (_, last) = own.element.range()?;
            let of = if own.element.ends_at_equator() { DepthOf::Radius } else { DepthOf::Law };
            (last > 0.0 && last.is_finite())
                .then(|| (own.name.to_string(), of, part(own.deformation, last)))
        });
        all.extend(pad.into_iter().chain(laws));
    }
    all
}

#[cfg(test)]
mod tests {
    use dashpot_network::{
        Network, Node,
        elements::{RateSpring, Spring},
        part,
    };

    use super::*;

    #[test]
    fn tolerance_that_a_law_does_not_get_through_is_tried_at_the_first_design_alone() {
        // Near its deepest point the rate changes its sign, and so the law: at 1e-9 bdf finds no step there.
        let pose = |values: &[f64]| {
            let mut network = Network::new();
            let head = network.add_node(Node::mass("head", values[0]).moving(4.0));
            let law =
                RateSpring { force: 2e3, at: 1e-2, exponent: 1.0, gain: 0.2, reference_rate: 0.1 };
            let pad = part(law) + part(Spring { stiffness: 8e4 });
            network.connect("pad", head, network.ground(), pad);
            Ok(ScenePoint { network, settings: SolveSettings::lasting(0.04) })
        };
        let aim = Aim::Measure("pad.peak-deformation".to_owned());
        let tests: [&PoseAt<'_>; 1] = [&pose];
        let evaluator = Evaluator::new(&tests, &aim, None, &[5.0]).unwrap();
        assert_eq!(evaluator.fine, &FINE[1..]);
        // What is tried in vain takes the budget before: the first that is tried gets through.
        let point = pose(&[3.0]).unwrap();
        let own = evaluator.limited(&point, evaluator.fine[0]).unwrap();
        assert_eq!(own.solver.work, evaluator.solved(&point).unwrap().solver.work);
    }
}
