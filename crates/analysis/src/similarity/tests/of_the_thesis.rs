//! The groups of the thesis.

use super::*;

#[test]
fn reference_has_the_groups_that_the_thesis_prints() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups();
    close(groups.a, 80.0 / 3.0, 1e-14);
    close(groups.b, 200.0 / 3.0, 1e-14);
    close(groups.c, 8.0, 1e-14);
    close(groups.d, 80.0, 1e-14);
    close(groups.alpha, 0.2, 1e-14);
    close(groups.beta, 2.0, 1e-14);
    close(groups.gamma, 0.1, 1e-14);
    assert!((groups.gravity, groups.share) == (0.0, 1.0));
    close(impact.scales.time(), 2e-3, 1e-15);
    let [p1, p2, p3, p4] = impact.ratios();
    close(groups.a, (1.0 + p1 + p2) * p3 / p1, 1e-15);
    close(groups.c, p3 / p4, 1e-15);
}

#[test]
fn gravity_and_a_mass_on_the_face_make_two_more_groups() {
    let mut network = reference();
    network.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
    network.add_effect(Face { element, mass: 2.5, at, touch: Touch::Moving });
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    close(groups.share, 0.8, 1e-15);
    close(groups.gravity, 9.8 * 0.02 / 100.0, 1e-14);
    // Twelve parameters of rank three: nine groups.
    let all = Groups::of(&network).unwrap();
    assert_eq!((all.groups.len() + all.references.len(), all.rank(), all.groups.len()), (12, 3, 9));
}

#[test]
fn any_model_that_is_a_burgers_model_from_outside_has_its_groups() {
    // Appendix A: two Maxwell elements in parallel.
    let mut network = reference();
    let (k1, c1, k2, c2) = (2e7_f64, 4e3, 2e7, 6e3);
    let alpha = 0.5 * (k2 / c2 + k2 / c1 + k1 / c1);
    let beta = (alpha * alpha - k1 * k2 / (c1 * c2)).sqrt();
    let k3 = k2 * (k1 / c1 - alpha + beta) / (2.0 * beta);
    let k4 = k2 - k3;
    let branches = [(k3, k3 / (alpha - beta)), (k4, k4 / (alpha + beta))];
    let branches = branches.map(|(k, c)| Tree::series([spring(k), dashpot(c)]));
    network.set_model(0, Tree::parallel(branches));
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    close(groups.a, 80.0 / 3.0, 1e-12);
    close(groups.d, 80.0, 1e-12);
}

#[test]
fn groups_lead_back_to_the_parameters_where_there_is_a_padding() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups();
    let again = impact.with_groups(&groups).unwrap();
    for (found, own) in [
        (again.padding.k1, 2e7),
        (again.padding.c1, 4e3),
        (again.padding.k2, 2e7),
        (again.padding.c2, 6e3),
        (again.support.mass, 100.0),
        (again.support.stiffness, 5e7),
        (again.support.damping, 1e4),
    ] {
        close(found, own, 1e-12);
    }
    // The printed groups are truncated: they stand for K1 = 20.13 MN/m and C1 = 4027 N s/m.
    let printed = groups.with("a", 26.6).unwrap().with("b", 66.66).unwrap();
    let printed = impact.with_groups(&printed).unwrap();
    close(printed.padding.k1, 20.13e6, 5e-4);
    close(printed.padding.c1, 4027.0, 5e-4);
    let solved = FourParameterImpact::of(&printed.network()).unwrap().groups();
    close(solved.a, 26.6, 1e-12);
    close(solved.b, 66.66, 1e-12);
}

#[test]
fn paddings_exist_within_the_ranges_and_not_beyond() {
    let impact = FourParameterImpact::of(&reference()).unwrap();
    let groups = impact.groups().with("a", 26.6).unwrap().with("b", 66.66).unwrap();
    let [a, b, c, d] = groups.ranges().0;
    let (from, to) = c.unwrap();
    close(from, 3.361, 2e-4);
    close(to, 28.562, 2e-5);
    let ends = [("a", a.map(|own| (own.0, 1e3))), ("b", b), ("c", c), ("d", d)];
    for (name, range) in ends {
        let (from, to) = range.unwrap();
        for (value, exists) in [
            (from + 1e-6 * to, true),
            (to * (1.0 - 1e-6), true),
            (from * (1.0 - 1e-6), false),
            (to * (1.0 + 1e-6), name == "a"),
        ] {
            let found = impact.with_groups(&groups.with(name, value).unwrap());
            assert_eq!(found.is_ok(), exists, "{name} = {value}");
        }
    }
    let none = groups.with("a", 10.0).unwrap();
    assert!(none.ranges().0[2..].iter().all(Option::is_none));
    assert!(matches!(impact.with_groups(&none), Err(SimilarityError::NoPadding { .. })));
    assert!(groups.with("f", 1.0).is_err());
}

#[test]
fn other_forms_are_told_from_that_of_the_thesis() {
    let reason = |network: &Network| match FourParameterImpact::of(network) {
        Err(SimilarityError::OtherForm { reason }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(reason(&mixed()).contains("load"));
    let mut network = reference();
    network.set_model(0, spring(1e6));
    assert!(reason(&network).contains("four-parameter"));
    let mut network = reference();
    network.set_model(1, Tree::series([spring(1e6), dashpot(1e3)]));
    assert!(reason(&network).contains("in parallel"));
}
