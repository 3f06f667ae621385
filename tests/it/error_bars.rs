//! Error bars of BDF against the exact solution, on random networks from a fixed seed.

use dashpot::{
    analysis::{SolveSettings, solve},
    dae::Silent,
};

use crate::{
    random_networks::{Dice, Recipe},
    thesis::reference,
};

#[test]
fn the_truth_lies_inside_the_bars_in_99_of_100_random_networks() {
    let mut dice = Dice(20);
    let (mut networks, mut measures, mut outside) = (0, 0, Vec::new());
    while networks < 150 {
        let recipe = Recipe::draw(&mut dice, 8.0);
        let radians = recipe.radians();
        if !(0.5..300.0).contains(&radians) {
            continue;
        }
        let (network, duration) = (recipe.build(), recipe.duration());
        let settings = SolveSettings::lasting(duration);
        let Ok(exact) = solve(&network, &settings.clone().by("exact"), &mut Silent) else {
            continue;
        };
        let bdf = solve(&network, &settings.by("bdf"), &mut Silent).unwrap();
        networks += 1;
        for truth in &exact.measures {
            let found = bdf.measure(&truth.key).unwrap();
            let (Some(a), Some(b)) = (truth.value, found.value) else { continue };
            let bar = found.error.unwrap() + truth.error.unwrap();
            measures += 1;
            if (a - b).abs() > bar {
                outside.push(format!(
                    "{} of network {networks}: {:.1} bars",
                    truth.key,
                    (a - b).abs() / bar
                ));
            }
            assert!(
                (a - b).abs() <= 10.0 * bar,
                "{} of network {networks}: {a} {b} {bar:e}",
                truth.key
            );
        }
    }
    assert!(measures > 600, "only {measures} measures");
    assert!(outside.len() * 100 <= measures, "{} of {measures}: {outside:?}", outside.len());
}

#[test]
fn bdf_is_inside_its_own_bars_on_both_reference_cases_at_three_tolerances() {
    for damping in [1e4, 1e7] {
        let network = reference(damping);
        let settings = SolveSettings::lasting(0.02);
        let exact = solve(&network, &settings.clone().by("exact"), &mut Silent).unwrap();
        let mut bars = Vec::new();
        for rtol in [1e-5, 1e-7, 1e-9] {
            let settings = SolveSettings { rtol: Some(rtol), ..settings.clone().by("bdf") };
            let bdf = solve(&network, &settings, &mut Silent).unwrap();
            assert_eq!(bdf.solver.solves_for_error, 2);
            for truth in &exact.measures {
                let found = bdf.measure(&truth.key).unwrap();
                let gap = (found.value.unwrap() - truth.value.unwrap()).abs();
                let bar = found.error.unwrap() + truth.error.unwrap();
                assert!(gap <= bar, "{} at {rtol:e}: {gap:e} beyond {bar:e}", truth.key);
            }
            let force = bdf.measure("padding.peak-force").unwrap();
            bars.push(force.error.unwrap());
        }
        assert!(bars[1] < bars[0] && bars[2] < 0.01 * bars[0], "the bars do not shrink: {bars:?}");
    }
}
