//! Balances that do not close are told with time and place.

use dashpot_dae::{Dense, Method, Signal, Silent, SolveError, System, Trajectory};
use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};

use super::super::*;
use crate::{Place, Solve, Warning, run::attempts::none_gets_through};

/// The exact method, but for one output.
#[derive(Debug)]
struct Faulty {
    output: usize,
    factor: f64,
}

#[derive(Debug)]
struct Scaled {
    inner: Box<dyn Dense>,
    output: usize,
    factor: f64,
}

impl Dense for Scaled {
    fn signal(&self, system: &System, output: usize) -> Signal {
        let signal = self.inner.signal(system, output);
        if output == self.output { signal.scaled(self.factor) } else { signal }
    }

    fn sample(&self, system: &System, times: &[f64]) -> Vec<f64> {
        self.inner.sample(system, times)
    }
}

impl Method for Faulty {
    fn name(&self) -> &'static str {
        "faulty"
    }

    fn summary(&self) -> &'static str {
        "one output is off"
    }

    fn applies(&self, _: &System, _: &Run) -> Result<String, SolveError> {
        Ok(String::new())
    }

    fn is_exact(&self) -> bool {
        true
    }

    fn integrate(
        &self,
        system: &System,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Trajectory, SolveError> {
        let right = methods::Exact.integrate(system, run, observer)?;
        let dense = Scaled { inner: right.dense, output: self.output, factor: self.factor };
        Ok(Trajectory { dense: Box::new(dense), ..right })
    }
}

/// 10 kg at 10 m/s onto a spring with a dashpot beside it.
fn struck(damping: f64) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let ground = network.ground();
    let pad = Model::parallel([part(Spring { stiffness: 1e6 }), part(Dashpot { damping })]);
    network.connect("pad", head, ground, pad);
    network
}

fn by_faulty(factor: f64) -> Result<RunReport, RunError> {
    let settings = SolveSettings::lasting(0.02);
    let assembly = Arc::new(struck(2e3).compile(settings.duration).unwrap());
    let run = Run::to(settings.duration);
    let selected = select(&assembly, &[], &[]).unwrap();
    let dashpot =
        assembly.primitives.iter().find(|primitive| primitive.element.kind() == "dashpot").unwrap();
    let faulty = Faulty { output: dashpot.force, factor };
    let task = Task {
        assembly: &assembly,
        settings: &settings,
        selected: &selected,
        method: &faulty,
        is_judged: true,
    };
    let outcome = task.run(&run, &mut Silent).unwrap();
    report(&assembly, &[], &task, &run, outcome)
}

#[test]
fn small_fault_is_a_warning_that_names_time_and_element() {
    assert!(
        by_faulty(1.0)
            .unwrap()
            .warnings
            .iter()
            .all(|warning| warning.code() != "energy-not-closed")
    );
    let report = by_faulty(1.005).unwrap();
    let closes = |own: &String| own.contains("does not close");
    let warning = report.warnings.iter().map(Warning::to_string).find(closes).unwrap();
    assert!(warning.contains("is too much, half of it from"), "{warning}");
    assert!(warning.contains("in the element `pad`"), "{warning}");
}

#[test]
fn gross_fault_fails_the_run_and_names_time_and_element() {
    let failure = by_faulty(1.05).unwrap_err();
    let RunError::EnergyLost { method: "exact", leak: Some(leak), .. } = &failure else {
        panic!("{failure}")
    };
    assert_eq!(leak.place, Place::Element("pad".to_owned()));
    assert!(failure.to_string().contains("most of that in the element `pad`"), "{failure}");
}

#[test]
fn methods_that_damp_or_excite_are_caught_with_time_and_place() {
    // ζ = 10⁻⁴, 250 periods, of which `bdf` damps the motion at the one tolerance and blows it up
    // at the other, the loosest that methods take.
    for (rtol, sign) in [(1e-3, 1.0), (1e-1, -1.0)] {
        let settings = SolveSettings {
            rtol: Some(rtol),
            estimate: false,
            ..SolveSettings::lasting(5.0).by_name("bdf").unwrap()
        };
        let failure = struck(0.632).solve_with(&settings).unwrap_err();
        let RunError::EnergyLost { method: "bdf", closure, leak: Some(leak) } = &failure else {
            panic!("{failure}")
        };
        assert!(sign * closure > 0.01 && sign * leak.missing > 0.0, "{failure}");
        // What decays does so from the start, what grows later on.
        let (begin, end) = leak.window;
        assert!(if sign > 0.0 { begin < 0.5 } else { end > 2.5 }, "{failure}");
        assert!(end - begin < 2.5, "{failure}");
    }
}

#[test]
fn where_every_method_gets_stuck_all_are_named() {
    let stuck = |method| SolveError::StepTooSmall { method, time: 0.5, unknown: "x".to_owned() };
    let both = [stuck("bdf"), stuck("tr-bdf2")].map(RunError::Solve);
    let [first, last] = both.clone();
    let error = none_gets_through(Some(first), last, vec!["esdirk34", "tr-bdf2"]);
    let told = error.to_string();
    assert!(told.starts_with("the step of `bdf` became too small at 0.5 s"), "{told}");
    assert!(told.ends_with("; `esdirk34` and `tr-bdf2` fail, too"), "{told}");
    // That `exact` does not apply is not what they fail for.
    let declines = SolveError::NotApplicable { method: "exact", reason: "not linear".to_owned() };
    let first = Some(RunError::Solve(declines));
    let error = none_gets_through(first, stuck("bdf").into(), vec!["bdf"]);
    let RunError::NoneGetsThrough { error: SolveError::StepTooSmall { .. }, others } = &error
    else {
        panic!("{error}")
    };
    assert!(others.is_empty() && !error.to_string().contains("too,"), "{error}");
    let [_, alone] = both;
    assert_eq!(none_gets_through(None, alone.clone(), Vec::new()), alone);
}
