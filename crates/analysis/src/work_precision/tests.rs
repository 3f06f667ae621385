//! Tests of the whole: against exact values, and against further solutions.

use dashpot_dae::{Silent, Statistics};
use dashpot_network::{Model, Network, Node, dashpot, elements::PowerDashpot, part, spring};

use super::*;
use crate::Solve;

/// The thesis' reference case with the padding's series dashpot as given.
fn impact(series: Model) -> Network {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 10.0).moving(10.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    let kelvin = Model::parallel([spring(20e6), dashpot(4e3)]);
    network.connect("padding", head, panel, Model::series([spring(20e6), series, kelvin]));
    let mount = Model::parallel([spring(50e6), dashpot(1e4)]);
    network.connect("mount", panel, network.ground(), mount);
    network
}

fn settings() -> SolveSettings {
    SolveSettings::lasting(0.02)
}

fn ladder(methods: &[&str]) -> Ladder {
    let methods = methods.iter().map(|method| Choice::named(method).unwrap()).collect();
    Ladder { methods, repeats: Some(1), ..Ladder::default() }
}

fn report(network: &Network, ladder: &Ladder) -> CostReport {
    work_precision(network, &settings(), ladder, &mut Silent).unwrap()
}

/// The relative errors of the peak force, by tolerance.
fn of_peak_force(report: &CostReport, method: &str) -> Vec<f64> {
    let at =
        report.measures.iter().position(|measure| measure.key == "padding.peak-force").unwrap();
    let points = report.points.iter().filter(|point| point.method == method);
    points.map(|point| point.measures[at].deviation.unwrap().value).collect()
}

#[test]
fn errors_are_the_distances_from_the_exact_solution() {
    let network = impact(dashpot(6e3));
    let methods = ["bdf", "tr-bdf2", "esdirk34", "tsit45", "exact"];
    let report = report(&network, &ladder(&methods));
    assert_eq!(
        (report.reference.method, report.reference.witness),
        ("exact", Some(("bdf", 1e-12)))
    );
    assert!(report.reference.measure_agreement.unwrap() < 1e-8, "{:?}", report.reference);
    for method in &methods[..4] {
        let errors = of_peak_force(&report, method);
        assert_eq!(errors.len(), 9, "{method}");
        for (error, rtol) in errors.iter().zip(&ladder(&[]).rtols) {
            // The peak force of the thesis, to eleven digits.
            let exact = 38_359.411_601;
            let own = SolveSettings { rtol: Some(*rtol), ..settings() }.by_name(method).unwrap();
            let own = network.solve_with(&own).unwrap();
            let value = own.measure("padding.peak-force").unwrap().value.unwrap();
            let direct = (value / exact - 1.0).abs();
            assert!((error - direct).abs() < 2e-11, "{method} {rtol}: {error}");
        }
        // Eight decades of tolerance, of which a method of low order gives its share only.
        assert!(errors[8] < 1e-4 * errors[0].max(errors[1]), "{method}: {errors:?}");
        let state = |cost_point: &&CostPoint| cost_point.method == *method;
        let states: Vec<f64> =
            report.points.iter().filter(state).map(|point| point.state.unwrap().value).collect();
        assert!(states[8] < 1e-4 * states[0].max(states[1]), "{method}: {states:?}");
    }
    let exact = report.points.last().unwrap();
    assert_eq!((exact.method, exact.rtol), ("exact", None));
    let all = exact.measures.iter().filter_map(|measure| measure.deviation);
    let worst = all
        .map(|own| (own.value, own.known_within))
        .fold((0.0_f64, 0.0_f64), |one, own| (one.0.max(own.0), one.1.max(own.1)));
    assert!(worst.0 <= 0.0 && worst.1 > 0.0 && worst.1 < 1e-10, "{worst:?}");
    assert!(exact.state.unwrap().at_most() < 1e-10);
    assert!(report.failures.is_empty(), "{:?}", report.failures);
}

#[test]
fn counts_and_errors_repeat_to_the_bit() {
    let network = impact(dashpot(6e3));
    let ladder = Ladder { rtols: vec![1e-4, 1e-7], ..ladder(&["bdf", "tsit45"]) };
    let all = || -> Vec<_> {
        let points = report(&network, &ladder).points.into_iter();
        points.map(|point| (point.work, point.state, point.events, point.measures)).collect()
    };
    let once = all();
    assert_eq!(once, all());
    assert!(once.iter().all(|own| own.0.accepted > 10 && own.0.rhs_calls > own.0.accepted));
    let finest = once.last().map(|own| own.0.accepted);
    assert!(finest > once.get(2).map(|own| own.0.accepted), "{finest:?}");
}

#[test]
fn without_an_exact_solution_two_families_agree_and_the_rest_is_judged_by_that() {
    let network = impact(part(PowerDashpot { force: 3e4, at: 5.0, exponent: 0.7 }));
    let report = report(&network, &ladder(&["exact", "bdf", "esdirk34"]));
    let reference = &report.reference;
    assert_eq!((reference.method, reference.rtol), ("bdf", Some(1e-12)));
    assert_eq!(reference.witness, Some(("esdirk34", 1e-12)));
    assert!(reference.why_not_exact.is_some());
    let agreement = reference.measure_agreement.unwrap();
    assert!(agreement > 0.0 && agreement < 1e-7, "{agreement:e}");
    // A tolerance at which a method fails is another matter.
    let declined = report.failures.iter().filter(|failure| failure.rtol.is_none());
    assert_eq!(declined.map(|declined| declined.method).collect::<Vec<_>>(), ["exact"]);
    // Nothing is said to be better than the agreement.
    let best = report.points.iter().map(|point| point.worst(&report.asked)).fold(1.0, f64::min);
    assert!(best >= agreement && best < 1e-6, "{best:e} {agreement:e}");
}

#[test]
fn a_solution_of_too_many_steps_ends_its_method_and_is_listed() {
    let network = impact(dashpot(6e3));
    let ladder =
        Ladder { most_steps: 200, rtols: vec![1e-3, 1e-6, 1e-9, 1e-11], ..ladder(&["bdf"]) };
    let report = report(&network, &ladder);
    let rtols: Vec<_> = report.points.iter().filter_map(|point| point.rtol).collect();
    assert_eq!(rtols, [1e-3, 1e-6]);
    let [failure] = &report.failures[..] else { panic!("{:?}", report.failures) };
    assert_eq!((failure.rtol, failure.ends), (Some(1e-9), true));
    let error = &failure.error;
    let is_told = matches!(error, RunError::Solve(SolveError::TooManySteps { steps: 201, .. }));
    assert!(is_told, "{error}");
}

#[test]
fn more_work_than_there_may_be_is_left_out_and_listed() {
    let network = impact(dashpot(6e3));
    let ladder = |most_work| Ladder { most_work, ..ladder(&["bdf", "tr-bdf2"]) };
    let report = report(&network, &ladder(40_000));
    assert_eq!(report.reference.method, "exact");
    assert!(!report.points.is_empty());
    let is_too_much =
        |cost_failure: &&CostFailure| matches!(cost_failure.error, RunError::TooMuchWork { .. });
    let left_out: Vec<_> = report.failures.iter().filter(is_too_much).collect();
    assert!(!left_out.is_empty() && left_out.iter().all(|own| own.ends), "{:?}", report.failures);
    // Where the judges themselves are too much, there is nothing to compare with.
    let error = work_precision(&network, &settings(), &ladder(100), &mut Silent).unwrap_err();
    assert!(matches!(error, RunError::TooMuchWork { most: 100, .. }), "{error}");
}

#[test]
fn the_cheapest_is_the_quickest_that_is_good_enough() {
    let network = impact(dashpot(6e3));
    let mut report = report(&network, &ladder(&["bdf"]));
    // Times as they would be on a machine that takes a microsecond for a step.
    for point in &mut report.points {
        point.time.median = 1e-6 * point.work.accepted as f64;
    }
    let target = 1e-4;
    let cheapest = report.cheapest(target).unwrap().clone();
    assert!(cheapest.worst(&report.asked) <= target);
    let coarser = report.points.iter().filter(|point| point.rtol > cheapest.rtol);
    assert!(coarser.clone().count() > 0);
    assert!(coarser.into_iter().all(|own| own.worst(&report.asked) > target));
    let ratio = report.next_digit(target).unwrap();
    let finer = report.cheapest(0.1 * target).unwrap().work.accepted as f64;
    assert!((ratio - finer / cheapest.work.accepted as f64).abs() < 1e-12);
    assert_eq!(report.cheapest(1e-30), None);
}

#[test]
fn what_cannot_be_asked_for_is_refused() {
    let network = impact(dashpot(6e3));
    let refused =
        |ladder: Ladder| work_precision(&network, &settings(), &ladder, &mut Silent).unwrap_err();
    assert!(matches!(Choice::named("rk4"), Err(RunError::UnknownMethod { .. })));
    let measures = vec!["padding.beauty".to_owned()];
    let own = Ladder { measures, ..ladder(&["bdf"]) };
    assert!(matches!(refused(own), RunError::UnknownMeasure { .. }));
    for own in [
        Ladder { rtols: vec![0.1], ..ladder(&["bdf"]) },
        Ladder { rtols: Vec::new(), ..ladder(&["bdf"]) },
        Ladder { repeats: Some(0), ..ladder(&["bdf"]) },
    ] {
        assert!(matches!(refused(own), RunError::InvalidSetting { .. }));
    }
}

#[test]
fn work_carries_no_clock() {
    let network = impact(dashpot(6e3));
    let ladder = Ladder { rtols: vec![1e-4], ..ladder(&["bdf"]) };
    let point = report(&network, &ladder).points.remove(0);
    assert_eq!(point.work, Statistics { wall: std::time::Duration::ZERO, ..point.work });
    assert!(point.time.median >= point.integration.median && point.integration.median > 0.0);
}
