//! The accuracy that is asked for: found by the program, paid for, and kept.

use dashpot::{
    analysis::{Accuracy, RunReport, Solve},
    scene::{ReadOptions, read},
};

use super::{
    METHODS, SEED, most_outside,
    trial::{Case, beside},
};

/// Scenes of each accuracy.
const SCENES: usize = 32;

/// What a report says of measures that are not as good as wanted.
fn admits(report: &RunReport) -> bool {
    let says = ["accuracy-not-reached", "undecided"];
    report.warnings.iter().any(|warning| says.contains(&warning.code()))
}

/// Solves the scenes by the method that the program chooses, and by one that it does not, and holds
/// what it says of accuracy against the truth.
fn accuracy_is_kept(wish: impl Fn(&mut Accuracy)) {
    let (mut judged, mut reached, mut outside) = (0, 0, Vec::new());
    for at in 0..SCENES {
        let case = Case::new(SEED + 1, at);
        for method in ["auto", METHODS[at / 2 % 3]] {
            let mut settings = case.drawn.scene.settings(method).unwrap();
            wish(&mut settings.accuracy);
            let accuracy = settings.accuracy.clone();
            let known = case.solve(&settings).map(|report| (case.truth(), report));
            let Ok((Some(truth), report)) = known else { continue };
            let name = format!("{} {at} by {method}", case.drawn.kind);
            if report.solver.method != "exact" {
                assert!(report.solver.solves_for_error >= 1, "{name}: nothing to take bars from");
                assert!(!report.solver.wall_for_error.is_zero(), "{name}: bars cost time");
            }
            for found in report.measures.iter().filter(|found| found.value.is_some()) {
                let bar = found.error.unwrap_or_else(|| panic!("{name}: {} has no bar", found.key));
                let true_size = truth[&found.key].0.unwrap_or(0.0).abs().max(found.size);
                let is_good = bar <= 1.01 * accuracy.of(&found.key) * true_size;
                // What cannot be told from zero has no size of its own.
                let is_zero = found.value.is_some_and(|value| value.abs() <= bar);
                reached += usize::from(is_good);
                assert!(is_good || is_zero || admits(&report), "{name}: {found:?}");
            }
            let Some(own) = beside(truth, &report) else { continue };
            judged += 1;
            outside.extend(own.outside.first().map(|own| format!("{name}: {own}")));
        }
    }
    assert!(judged > SCENES, "only {judged} could be judged");
    assert!(reached > 8 * judged, "only {reached} measures in {judged} runs");
    assert!(outside.len() <= most_outside(judged), "of {judged}: {outside:?}");
}

#[test]
fn one_percent_is_kept() {
    accuracy_is_kept(|accuracy| accuracy.default = 1e-2);
}

#[test]
fn one_in_a_thousand_is_kept_without_asking() {
    accuracy_is_kept(|_| {});
}

#[test]
fn one_in_ten_thousand_is_kept() {
    accuracy_is_kept(|accuracy| accuracy.default = 1e-4);
}

#[test]
fn another_method_is_tried_where_the_first_one_does_not_reach_it() {
    // At the tolerances that this takes the steps of `dop853` become too small at the start.
    let text = "[nodes]\n\
        head = { mass = \"10.83 g\", velocity = \"0.5035 m/s\" }\n\
        [elements.pad]\n\
        between = [\"head\", \"ground\"]\n\
        parallel = [{ stiffening-spring = { stiffness = \"0.8567 N/m\", limit = \"25.8 mm\" } }, \
        { series = [{ bumper = { force = \"0.1049 N\", at = \"29.65 mm\", restitution = 0.532, \
        speed = \"0.5035 m/s\", exponent = 1 } }, { bumper = { force = \"4.102 mN\", \
        at = \"29.65 mm\", restitution = 0.461, speed = \"0.5035 m/s\", exponent = 2 } }] }]\n\
        [effects]\n\
        gravity = { start = \"unloaded\" }\n\
        separation.pad = { at = \"head\" }\n\
        [measures]\n\
        head = [{ kind = \"end-velocity\", window = \"run\" }, { kind = \"end-position\", window = \"run\" }]\n\
        pad = [{ kind = \"peak-force\", window = \"run\" }]\n\
        [run]\n\
        duration = \"0.9251 s\"\n";
    let scene = read(text, &ReadOptions::default()).unwrap().value;
    let mut settings = scene.settings("auto").unwrap();
    let wanted = 3e-7;
    settings.accuracy.default = wanted;
    settings.budget = 200_000_000;
    let report = scene.network.solve_with(&settings).unwrap();
    assert_ne!(report.solver.method, "dop853");
    assert!(report.solver.why.contains("does not reach"), "{}", report.solver.why);
    // It has half of the work where others may follow.
    let mut alone = settings.by_name("dop853").unwrap();
    alone.budget /= 2;
    let first = scene.network.solve_with(&alone).unwrap();
    assert!(admits(&first), "{:?}", first.solver);
    let pairs = report.measures.iter().zip(&first.measures);
    let errors: Vec<_> = pairs
        .filter_map(|(own, first)| {
            let size = first.value?.abs();
            Some((own.error? / size, first.error? / size))
        })
        .collect();
    println!("{errors:?}");
    assert!(errors.iter().all(|&(own, first)| own <= 1.5 * first.max(wanted)), "{errors:?}");
    assert!(errors.iter().any(|&(own, first)| own < first && first > wanted), "{errors:?}");
}

#[test]
fn a_wish_for_one_measure_is_kept_beside_the_others() {
    let case = (0..).step_by(2).map(|at| Case::new(SEED + 1, at));
    let mut cases = case.filter(|case| case.drawn.kind == "impact");
    for case in cases.by_ref().take(4) {
        let mut settings = case.drawn.scene.settings("bdf").unwrap();
        let rough = case.solve(&settings).unwrap();
        settings.accuracy.by_measure.insert("pad.peak-deformation".to_owned(), 1e-6);
        let fine = case.solve(&settings).unwrap();
        let truth = case.truth().unwrap()["pad.peak-deformation"].0.unwrap();
        let found = fine.measure("pad.peak-deformation").unwrap();
        let bar = found.error.unwrap();
        assert!(bar <= 1.01e-6 * truth.abs() || admits(&fine), "{found:?}");
        assert!((found.value.unwrap() - truth).abs() <= bar, "{found:?} is {truth}");
        assert!(fine.solver.rtol < rough.solver.rtol, "it takes a finer tolerance");
        assert!(fine.solver.solves_for_error > rough.solver.solves_for_error);
    }
}
