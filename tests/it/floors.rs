//! What no pad can beat, against linear programmes and random pads.

use crate::{
    cli::{json, out, run as command},
    random_networks::Dice,
};
use dashpot::{
    analysis::{
        MeasureWish, Solve, SolveSettings,
        measures::{Hic15, PeakAcceleration, PeakForce, SeverityIndex},
    },
    design::floor::{Judged, floors},
    network::{
        Model, Network, Node, dashpot,
        effects::{Gravity, GravityStart, Separation},
        elements::{CubicSpring, Foam, HystereticFoam, PowerDashpot},
        parameters::WindowWish,
        part, spring,
    },
    units::STANDARD_GRAVITY,
};

/// What a linear programme on 240 steps is off by, where windows of impulse are judged at the limit of no steps: there
/// errors fall as the length of the steps to this power.
const PROGRAMME: f64 = 5e-5;
const ORDER: f64 = 1.6;
/// Tangents in place of powers, and a travel that is kept at the ends of steps alone, take more from a severity index.
const TANGENTS: f64 = 1e-3;

#[test]
fn the_floors_are_those_of_linear_programmes() {
    for row in include_str!("floors_reference.csv").lines().skip(1) {
        let row: Vec<&str> = row.split(',').collect();
        let all: Vec<f64> = row.iter().skip(1).map(|own| own.parse().unwrap()).collect();
        let [mass, speed, gravity, travel, cap, under, stiffness, damping] = all[..8] else {
            unreachable!()
        };
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", mass).moving(speed));
        let mut below = network.ground();
        if under > 0.0 {
            below = network.add_node(Node::mass("panel", under));
        }
        if stiffness > 0.0 {
            network.connect("mount", below, network.ground(), spring(stiffness) | dashpot(damping));
        }
        network.connect("pad", head, below, spring(1e6)).thickness = Some(travel);
        if gravity > 0.0 {
            network.add_effect(Gravity { acceleration: gravity, start: GravityStart::Equilibrium });
        }
        let floors = floors(&network, 0.1, &[]).unwrap();
        let exponent = 2.5;
        let judged =
            [Judged::PeakAcceleration, Judged::Hic { cap }, Judged::SeverityIndex { exponent }];
        for (judged, right) in judged.into_iter().zip(all[8..].chunks(2)) {
            let own = floors.stroke.floor(judged).unwrap();
            let (right, room) = match judged {
                Judged::Hic { .. } => {
                    (right[1] + (right[1] - right[0]) / (2_f64.powf(ORDER) - 1.0), PROGRAMME)
                }
                Judged::SeverityIndex { .. } => (right[1], TANGENTS),
                _ => (right[1], PROGRAMME),
            };
            let off = own.value / right - 1.0;
            println!("{} {judged:?}: {} for {right}, {off:.1e}", &row[0], own.value);
            assert!(off.abs() < room, "{} {judged:?}: {own:?} for {right}", &row[0]);
        }
    }
}

/// A pad of one law or of two in series, some of them beside a dashpot.
fn pad(dice: &mut Dice) -> Model {
    let law = |dice: &mut Dice| -> Model {
        let size = 1e5 * dice.decades(2.0);
        match dice.below(6) {
            0 => spring(size),
            1 => spring(size) + dashpot(30.0 * size / 1e3),
            2 => spring(size) | (spring(3.0 * size) + dashpot(size / 300.0)),
            3 => {
                let cubic = 1e4 * size * dice.decades(2.0);
                part(CubicSpring { stiffness: size, cubic })
            }
            4 => {
                let foam = Foam {
                    modulus: 20.0 * size,
                    plateau: size,
                    densification: 0.2 * size,
                    exponent: 2.0,
                    thickness: 0.04,
                    area: 0.005,
                };
                part(HystereticFoam { foam, set: 0.5, unloading_exponent: 2.0 })
            }
            _ => {
                let exponent = 0.5 + dice.unit();
                part(PowerDashpot { force: 0.02 * size, at: 1.0, exponent })
            }
        }
    };
    let one = law(dice);
    let two = if dice.below(3) == 0 { one + law(dice) } else { one };
    if dice.below(2) == 0 { two | dashpot(300.0 * dice.decades(2.0)) } else { two }
}

#[test]
fn no_pad_and_no_stack_is_below_its_floor() {
    pads(120);
}

#[test]
#[ignore = "a campaign: half a minute"]
fn no_pad_and_no_stack_of_a_thousand_is_below_its_floor() {
    pads(1000);
}

fn pads(count: usize) {
    let mut dice = Dice(21);
    let window = WindowWish::Run;
    let (mut judged, mut closest) = (0, f64::INFINITY);
    for at in 0..count {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 5.0).moving(2.0 + 4.0 * dice.unit()));
        let mut below = network.ground();
        if dice.below(3) == 0 {
            below = network.add_node(Node::mass("panel", 10.0 * dice.decades(1.0)));
            let mount = spring(1e6 * dice.decades(2.0)) | dashpot(1e3);
            network.connect("mount", below, network.ground(), mount);
        }
        let model = pad(&mut dice);
        network.connect("pad", head, below, model).thickness = Some(0.04);
        if dice.below(2) == 0 {
            let start = GravityStart::Equilibrium;
            network.add_effect(Gravity { acceleration: STANDARD_GRAVITY, start });
        }
        if dice.below(2) == 0 {
            let at = Some("head".to_owned());
            network.add_effect(Separation { element: "pad".to_owned(), at, restitution: 0.0 });
        }
        let mut settings = SolveSettings { estimate: false, ..SolveSettings::lasting(0.1) };
        settings.measures = vec![
            MeasureWish::new("pad", PeakForce { window }),
            MeasureWish::new("head", PeakAcceleration { window }),
            MeasureWish::new("head", SeverityIndex { exponent: 2.5, window }),
            MeasureWish::new("head", Hic15 { window }),
        ];
        let Ok(run) = network.solve_with(&settings) else { continue };
        let Ok(floors) = floors(&network, 0.1, &[]) else { panic!("{at}: no floor") };
        let Some(deepest) = floors.deepest(&run) else { continue };
        for own in run.measures.iter().filter(|own| own.window_wish == Some(window)) {
            let (Some(value), Some(floor)) = (own.value, floors.of(own, Some(deepest))) else {
                continue;
            };
            // A run that ends before the body can be stopped says nothing.
            if floor.time > run.trajectory.t_end {
                continue;
            }
            let part = value / floor.value;
            // Runs are wanted to 0.1 %.
            assert!(part > 1.0 - 3e-3, "{at} {}: {part} {floor:?}", own.key);
            closest = closest.min(part);
            judged += 1;
        }
    }
    assert!(judged > 3 * count && closest < 1.1, "{judged} {closest}");
}

#[test]
fn a_run_tells_its_floors_on_demand() {
    let text = out(&command(&["run", "--floor", "--plot", "never"]));
    println!("{text}");
    let object = json(&["run", "--floor", "--json"]);
    let floor = &object["runs"][0]["floor"];
    assert_eq!((&floor["of"], &floor["pad"]), (&"thickness".into(), &"padding".into()));
    let own = &floor["measures"]["head.peak-acceleration"];
    let (value, ratio) = (own["value"].as_f64().unwrap(), own["ratio"].as_f64().unwrap());
    // On a fixed support it would be v0²/(2 D) = 2500 m/s².
    assert!(value < 2500.0 && value > 2250.0 && ratio > 1.0, "{own}");
    let peak = &object["runs"][0]["measures"]["head.peak-acceleration"];
    assert!((peak["value"].as_f64().unwrap() / value / ratio - 1.0).abs() < 1e-12);
    let plain = json(&["run", "--json"]);
    assert!(plain["runs"][0].get("floor").is_none());
}
