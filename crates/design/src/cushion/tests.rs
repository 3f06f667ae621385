use std::ops::ControlFlow;

use dashpot_analysis::{SolveSettings, sweep::ScenePoint};
use dashpot_network::{Network, Node, dashpot, effects::Stop, spring};

use super::*;

const G0: f64 = dashpot_units::STANDARD_GRAVITY;
const AREA: f64 = 0.04;
const MODULUS: f64 = 1e5;

fn posed(thickness: f64, damping: f64, stop: Option<f64>) -> ScenePoint {
    let mut network = Network::new();
    let platen = network.add_node(Node::mass("platen", 8.0).dropped(0.6));
    let ground = network.ground();
    let size = AREA / thickness;
    let model = if damping > 0.0 {
        spring(MODULUS * size) | dashpot(damping * size)
    } else {
        spring(MODULUS * size)
    };
    let pad = network.connect("pad", platen, ground, model);
    (pad.thickness, pad.area) = (Some(thickness), Some(AREA));
    if let Some(part) = stop {
        network.add_effect(Stop {
            element: "pad".to_owned(),
            at: Some(part * thickness),
            restitution: 0.0,
            stiffness: Some(2e6),
            damping: 0.0,
        });
    }
    ScenePoint { network, settings: SolveSettings::lasting(0.1) }
}

fn asked() -> Asked {
    Asked {
        heights: vec![0.3, 0.6],
        thicknesses: vec![0.03, 0.06],
        stresses: Vec::new(),
        limit: None,
        over: None,
        row: None,
        creep: Vec::new(),
        threads: 2,
    }
}

fn curves(asked: &Asked, damping: f64, stop: Option<f64>) -> Cushion {
    let pose = |thickness: f64| Ok(posed(thickness, damping, stop));
    let platen = Platen::of(&pose(0.05).unwrap().network, None, None).unwrap();
    cushion(&platen, asked, &pose, &mut |_, _| ControlFlow::Continue(())).unwrap()
}

fn near(own: f64, right: f64, part: f64) {
    assert!((own / right - 1.0).abs() <= part, "{own} for {right}");
}

/// G of a linear cushion.
fn closed(height: f64, thickness: f64, stress: f64) -> f64 {
    1.0 + (1.0 + 2.0 * MODULUS * height / (stress * thickness)).sqrt()
}

#[test]
fn the_curve_of_a_linear_cushion_is_its_closed_form() {
    let stresses: Vec<f64> = (0..12).map(|at| 200.0 * 1.6_f64.powi(at)).collect();
    let own = curves(&Asked { stresses: stresses.clone(), ..asked() }, 0.0, None);
    assert_eq!((own.curves.len(), own.work.points), (4, 48));
    assert_eq!(own.platen.assumed, [Assumed::Gravity, Assumed::Separation]);
    for curve in &own.curves {
        for (point, stress) in curve.points.iter().zip(&stresses) {
            let right = closed(curve.height, curve.thickness, *stress);
            near(point.peak / G0, right, 1e-10);
            near(point.strain, right * stress / MODULUS, 1e-10);
            let is_through = right * stress / MODULUS > 1.0;
            let known = if is_through { Known::PressedThrough } else { Known::Whole };
            assert_eq!(point.known, known, "{point:?}");
        }
        near(curve.floor.unwrap() / G0, 1.0 + curve.height / curve.thickness, 1e-9);
    }
}

#[test]
fn the_best_stress_of_a_linear_cushion_presses_it_flat() {
    let own = curves(&asked(), 0.0, None);
    for curve in &own.curves {
        let best = curve.best.unwrap();
        // y = t: σ (h + t) = E t/2.
        let right = 0.5 * MODULUS * curve.thickness / (curve.height + curve.thickness);
        assert_eq!(best.place, Place::EndOfKnown);
        near(best.point.stress, right, 1e-5);
        let ends = [curve.points[0].stress, curve.points[curve.points.len() - 1].stress];
        assert!(ends[0] < right && right < ends[1], "{ends:?} about {right}");
    }
}

#[test]
fn a_limit_is_kept_from_its_root_to_what_is_known() {
    let limit = 40.0 * G0;
    let own = curves(&Asked { limit: Some(limit), ..asked() }, 0.0, None);
    for curve in &own.curves {
        // (G − 1)² = 1 + 2 E h/(σ t).
        let root = 2.0 * MODULUS * curve.height / (curve.thickness * (39.0 * 39.0 - 1.0));
        let flat = 0.5 * MODULUS * curve.thickness / (curve.height + curve.thickness);
        match curve.passing {
            Some(passing) => {
                near(passing.stress[0], root, 1e-5);
                near(passing.stress[1], flat, 1e-5);
                assert_eq!(passing.ends, [Reach::Limit, Reach::Known]);
            }
            None => assert!(root > flat, "{root} {flat}"),
        }
    }
    assert!(own.curves.iter().any(|own| own.passing.is_some()));
}

#[test]
fn the_thinnest_cushion_is_the_root_of_the_closed_form() {
    let limit = 40.0 * G0;
    let over = [2e3, 3e3];
    let own = curves(&Asked { limit: Some(limit), over: Some(over), ..asked() }, 0.0, None);
    for answer in &own.thinnest {
        let (thickness, worst) = answer.over_all.unwrap();
        // The lowest stress has the largest peak, the highest one presses the deepest.
        let of_limit = 2.0 * MODULUS * answer.height / (over[0] * (39.0 * 39.0 - 1.0));
        let of_depth = answer.height / (0.5 * MODULUS / over[1] - 1.0);
        let right = of_limit.max(of_depth).max(0.03);
        near(thickness, right, 1e-5);
        assert!(thickness >= right && worst.peak + worst.error <= limit, "{thickness} {right}");
        near(worst.peak / G0, closed(answer.height, right, over[0]), 1e-4);
        near(worst.stress, over[0], 1e-12);
        assert_eq!(answer.is_first, of_limit.max(of_depth) <= 0.03);
    }
}

#[test]
fn a_stop_is_a_part_of_the_scene_and_is_told() {
    let own = curves(&asked(), 300.0, Some(0.7));
    for curve in &own.curves {
        for point in &curve.points {
            let right = match point.strain {
                own if own >= 1.0 => Known::PressedThrough,
                own if own > 0.7 => Known::OnStop,
                _ => Known::Whole,
            };
            assert_eq!((point.known, point.is_usable()), (right, point.strain < 1.0), "{point:?}");
            assert!(point.peak >= curve.floor.unwrap() * (1.0 - 1e-9) || point.strain > 0.7);
        }
        let best = curve.best.unwrap();
        let usable = || curve.points.iter().filter(|own| own.is_usable());
        assert!(usable().all(|own| own.peak >= best.point.peak * (1.0 - 1e-9)), "{best:?}");
        assert!(usable().any(|own| own.known == Known::OnStop));
    }
    // What does not meet the stop is instantiated as if there were none.
    let free =
        own.curves.iter().flat_map(|own| &own.points).filter(|own| own.known == Known::Whole);
    let free = free.count();
    assert!(own.work.instantiated > 0 && own.work.instantiated <= free, "{:?} {free}", own.work);
}

#[test]
fn what_is_no_cushion_says_why() {
    let of = |network: &Network| Platen::of(network, None, None).unwrap_err();
    let mut network = posed(0.05, 0.0, None).network;
    let own = network.node_named("platen").unwrap();
    let ground = network.ground();
    network.connect("cable", own, ground, spring(1.0));
    assert!(matches!(of(&network), NoCushion::Hangs { .. }));
    let mut network = Network::new();
    let (platen, ground) =
        (network.add_node(Node::mass("platen", 8.0).dropped(0.6)), network.ground());
    assert!(matches!(of(&network), NoCushion::NotOnePad { .. }));
    network.connect("pad", platen, ground, spring(1e4)).thickness = Some(0.05);
    assert!(matches!(of(&network), NoCushion::NoArea { .. }));
    network.add_node(Node::mass("other", 1.0).moving(1.0));
    assert!(matches!(of(&network), NoCushion::NotOneBody { .. }));
    let named = Platen::of(&posed(0.05, 0.0, None).network, Some("plate"), None);
    assert!(matches!(named, Err(NoCushion::Unknown { .. })));
}

fn in_a_row(
    model: impl Fn(f64) -> dashpot_network::Model + Sync,
    between: f64,
    drops: usize,
) -> Vec<f64> {
    let pose = |thickness: f64| {
        let mut network = Network::new();
        let platen = network.add_node(Node::mass("platen", 8.0).dropped(0.3));
        let ground = network.ground();
        let pad = network.connect("pad", platen, ground, model(AREA / thickness));
        (pad.thickness, pad.area) = (Some(thickness), Some(AREA));
        Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
    };
    let platen = Platen::of(&pose(0.06).unwrap().network, None, None).unwrap();
    let asked = Asked {
        heights: vec![0.3],
        thicknesses: vec![0.06],
        stresses: vec![1e3],
        row: Some(Row { drops, between }),
        ..asked()
    };
    let own = cushion(&platen, &asked, &pose, &mut |_, _| ControlFlow::Continue(())).unwrap();
    let curve = &own.curves[0];
    let [row] = &curve.repeated[..] else { panic!("one point") };
    near(row.peaks[0], curve.points[0].peak, 1e-6);
    row.peaks.clone()
}

#[test]
fn what_an_elastic_cushion_does_is_the_same_each_time() {
    let peaks = in_a_row(|size| spring(MODULUS * size) | dashpot(200.0 * size), 10.0, 3);
    peaks.iter().for_each(|own| near(*own, peaks[0], 1e-6));
}

#[test]
fn the_memory_of_a_branch_decays_with_the_time_between() {
    // Free of load the spring and the branch beside it go back with c (1/k + 1/k1).
    let (k1, c1) = (5e4, 1e5);
    let delay = c1 * (1.0 / MODULUS + 1.0 / k1);
    let model = |size: f64| spring(MODULUS * size) | (spring(k1 * size) + dashpot(c1 * size));
    let second = |between: f64| {
        let own = in_a_row(model, between, 2);
        own[1] / own[0] - 1.0
    };
    let [soon, late] = [2.0, 2.0 + delay].map(second);
    near(late / soon, (-1.0_f64).exp(), 0.02);
    assert!(second(60.0).abs() < 1e-6 && soon.abs() > 1e-5, "{soon}");
}

#[test]
fn a_lasting_set_lengthens_the_next_fall() {
    // A dashpot in a row gives way by ∫ F dt/c, which is the momentum over c, and stays.
    let c = 4e5;
    let own = in_a_row(|size| spring(MODULUS * size) + dashpot(c * size), 5.0, 2);
    assert!(own[1] > own[0], "{own:?}");
    let mass = 1e3 * AREA / G0;
    let impulse = 2.0 * mass * (2.0 * G0 * 0.3_f64).sqrt();
    let set = impulse / (c * AREA / 0.06);
    let longer = closed(0.3 + set, 0.06, 1e3) / closed(0.3, 0.06, 1e3);
    near(own[1] / own[0] - 1.0, longer - 1.0, 0.1);
}
