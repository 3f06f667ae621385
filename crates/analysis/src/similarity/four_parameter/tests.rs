use dashpot_network::{
    Network, Start,
    effects::Separation,
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::{Branch, Tree};

use super::*;
use crate::{Solve, SolveSettings, similarity::Inventory};

fn chapter_4() -> FourParameterImpact {
    let network = FourParameterGroups::of(
        &ImpactScales::CHAPTER_4,
        &FourParameterPadding::CHAPTER_4,
        &FourParameterSupport::CHAPTER_4,
    )
    .network(&ImpactScales::CHAPTER_4);
    FourParameterImpact::of(&network.unwrap()).unwrap()
}

/// The largest force φ of the thesis' equations 2.20 to 2.22 by the classical Runge–Kutta method.
fn largest_force(four_parameter_groups: &FourParameterGroups) -> f64 {
    let rate = |[_, speed, eta, eta_rate, force, force_rate]: [f64; 6]| {
        let zeta_rate = four_parameter_groups.gravity - four_parameter_groups.share * force;
        let eta_curve = -four_parameter_groups.alpha * eta_rate - four_parameter_groups.beta * eta
            + four_parameter_groups.gamma * force;
        let deformation_rate = speed - eta_rate;
        let force_curve = -four_parameter_groups.a * force_rate - four_parameter_groups.b * force
            + four_parameter_groups.c * (zeta_rate - eta_curve)
            + four_parameter_groups.d * deformation_rate;
        [speed, zeta_rate, eta_rate, eta_curve, force_rate, force_curve]
    };
    let step = 1e-3;
    let moved = |y: [f64; 6], k: [f64; 6], by: f64| std::array::from_fn(|at| y[at] + by * k[at]);
    let mut y = [0.0, 1.0, 0.0, 0.0, 0.0, four_parameter_groups.c];
    let mut largest = 0.0_f64;
    for _ in 0..3000 {
        let k1 = rate(y);
        let k2 = rate(moved(y, k1, 0.5 * step));
        let k3 = rate(moved(y, k2, 0.5 * step));
        let k4 = rate(moved(y, k3, step));
        let mean = std::array::from_fn(|at| (k1[at] + 2.0 * (k2[at] + k3[at]) + k4[at]) / 6.0);
        y = moved(y, mean, step);
        largest = largest.max(y[4]);
    }
    largest
}

#[test]
fn networks_of_groups_solve_the_equations_of_the_thesis() {
    let impact = chapter_4();
    let scales = impact.scales;
    for (gravity, share) in [(0.0, 1.0), (0.1, 1.0), (0.0, 0.5), (0.1, 0.5), (0.3, 0.25)] {
        let groups = FourParameterGroups { gravity, share, ..impact.groups() };
        let expected = largest_force(&groups) * scales.force();
        let networks = [
            groups.put_into(&impact.network()).unwrap(),
            impact.with_groups(&groups).unwrap().network(),
            groups.network(&scales).unwrap(),
        ];
        for network in networks {
            let found = FourParameterImpact::of(&network).unwrap().groups();
            assert!((found.gravity - gravity).abs() < 1e-15 && (found.share - share).abs() < 1e-15);
            let settings = SolveSettings::lasting(0.006).by_name("exact").unwrap();
            let report = network.solve_with(&settings).unwrap();
            let peak = report.measure("padding.peak-force").unwrap().value.unwrap();
            // The peak lies between steps of 1e-3, so it is seen to some 1e-6.
            assert!((peak / expected - 1.0).abs() < 3e-6, "A = {gravity}: {peak} {expected}");
        }
    }
}

#[test]
fn groups_that_stay_change_nothing_of_a_scene() {
    let mut network = chapter_4().network();
    let maxwell = |stiffness, damping| {
        let spring = part(Spring { stiffness });
        Tree::series([spring, part(Dashpot { damping })])
    };
    network.set_model(0, Tree::parallel([maxwell(1e7, 2e3), maxwell(2e7, 7e3)]));
    let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
    network.add_effect(Separation { element: element.clone(), at: at.clone(), restitution: 0.3 });
    network.add_effect(Face { element, mass: 0.5, at, touch: Touch::Impact });
    network.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Unloaded });
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    let again = groups.put_into(&network).unwrap();
    assert_eq!(Inventory::of(&again).unwrap(), Inventory::of(&network).unwrap());
    // Only the numbers of what is asked for change; what the effects say stays.
    let other = groups.with("B", 0.5).unwrap().with("A", 0.1).unwrap();
    let again = other.put_into(&network).unwrap();
    let (before, after) = (Inventory::of(&network).unwrap(), Inventory::of(&again).unwrap());
    assert_eq!(before.structure, after.structure);
    for quantity in &before.quantities {
        let found = after.quantity(&quantity.name).unwrap().value;
        match quantity.name.as_str() {
            "face.padding.mass" => assert!((found - 10.0).abs() < 1e-13),
            "gravity.value" => assert!((found - 0.1 * 100.0 / 0.02).abs() < 1e-10),
            name => assert_eq!(found.to_bits(), quantity.value.to_bits(), "{name}"),
        }
    }
}

#[test]
fn the_drawing_of_a_padding_stays() {
    let mut network = chapter_4().network();
    let kelvin = Tree::Parallel(vec![
        Branch::new("dashpot", part(Dashpot { damping: 4e3 })),
        Branch::new("spring", part(Spring { stiffness: 2e7 })),
    ]);
    let maxwell = Tree::series([part(Dashpot { damping: 6e3 }), part(Spring { stiffness: 2e7 })]);
    let drawn = Tree::Series(vec![Branch::new("kelvin", kelvin), Branch::new("maxwell", maxwell)]);
    network.set_model(0, drawn);
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    let again = groups.with("a", 30.0).unwrap().with("b", 60.0).unwrap();
    let network = again.put_into(&network).unwrap();
    let inventory = Inventory::of(&network).unwrap();
    let value = |name: &str| inventory.quantity(name).unwrap().value;
    // q = 30 − 60·8/80 − 80/8 = 14.
    assert!((value("padding.kelvin.spring") / (2e8 / 14.0) - 1.0).abs() < 1e-12);
    assert!((value("padding.kelvin.dashpot") / (4e4 / 14.0) - 1.0).abs() < 1e-12);
    assert!((value("padding.maxwell.2.spring") / 2e7 - 1.0).abs() < 1e-12, "{inventory:?}");
}

#[test]
fn speed_at_touch_stays_under_another_gravity() {
    let mut network = Network::new();
    let own = chapter_4();
    let head = network.add_node(Node::mass("head", 10.0).dropped(5.0));
    let panel = network.add_node(Node::mass("panel", 100.0));
    network.connect("padding", head, panel, own.padding.model()).thickness = Some(0.02);
    network.connect("mount", panel, network.ground(), own.support.mount());
    network.add_effect(weight(10.0));
    let groups = FourParameterImpact::of(&network).unwrap().groups();
    assert!((groups.gravity - 0.002).abs() < 1e-16);
    let start = |gravity: f64| {
        let again = groups.with("A", gravity).unwrap().put_into(&network).unwrap();
        again.nodes().find(|node| node.1.name == "head").unwrap().1.start
    };
    assert!(matches!(start(0.004), Start::Drop(height) if (height - 2.5).abs() < 1e-12));
    assert!(matches!(start(0.0), Start::Velocity(speed) if (speed - 10.0).abs() < 1e-12));
    assert_eq!(start(groups.gravity), Start::Drop(5.0));
}

#[test]
fn groups_out_of_their_range_are_refused_by_name() {
    let groups = chapter_4().groups();
    for (name, value) in [
        ("A", f64::NAN),
        ("B", 2.0),
        ("B", 0.0),
        ("B", -1.0),
        ("a", -3.0),
        ("b", 0.0),
        ("c", f64::INFINITY),
        ("d", -1.0),
        ("alpha", -1.0),
        ("beta", -0.1),
        ("gamma", 0.0),
    ] {
        let wrong = groups.with(name, value).unwrap().validate().unwrap_err();
        let said = wrong.to_string();
        assert!(
            matches!(wrong, SimilarityError::GroupOutOfRange { name: own, .. } if own == name),
            "{said}"
        );
        assert!(said.contains(&format!("group {name} is {value}")), "{said}");
    }
    for (name, value) in [("A", -0.1), ("B", 1.0), ("alpha", 0.0), ("beta", 0.0)] {
        groups.with(name, value).unwrap().validate().unwrap();
    }
    let none = groups.with("a", 9.0).unwrap().validate().unwrap_err().to_string();
    assert!(none.contains("a > 16.667; no b; no c; no d"), "{none}");
    let none = groups.with("c", 40.0).unwrap().validate().unwrap_err().to_string();
    assert!(none.contains("3.3509 < c < 28.649"), "{none}");
}
